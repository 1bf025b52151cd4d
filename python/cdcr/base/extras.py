"""Optional dependencies: imported when used, with an error that says how to get them."""

import importlib
from contextlib import suppress
from types import ModuleType


def require(module: str, extra: str) -> ModuleType:
    """Import an optional module.

    Parameters
    ----------
    module : str
        Name of the module, such as ``"matplotlib.figure"``.
    extra : str
        The extra of this package that installs it, such as ``"plot"``.

    Returns
    -------
    ModuleType

    Raises
    ------
    ImportError
        With the command that installs the extra.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        package = module.partition(".")[0]
        raise ImportError(
            f'{package} is needed for this and could not be imported: pip install "cdcr[{extra}]"'
        ) from error


def find_ffmpeg() -> str | None:
    """Return the program ffmpeg: that on the PATH, or that of the package imageio-ffmpeg."""
    import shutil  # slow to load

    found = shutil.which("ffmpeg")
    if found is None:
        with suppress(ImportError, RuntimeError):  # not installed, or without its program
            found = str(importlib.import_module("imageio_ffmpeg").get_ffmpeg_exe())
    return found
