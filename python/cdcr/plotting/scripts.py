"""What a script does with its picture."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from matplotlib.figure import Figure

from cdcr.base.check import as_tuple
from cdcr.files.new_file import new_file

MISTAKEN = 2  # exit code of a command line that cannot be done


def show_or_save(figure: Figure, arguments: Sequence[str]) -> None:
    """Save a picture where the command line of a script says, or show it in a window.

    Parameters
    ----------
    figure : Figure
        The picture; to be shown, one of pyplot.
    arguments : sequence of str
        ``sys.argv[1:]``: a file name, whose suffix says the format, and which is replaced where it
        exists; or none.

    Raises
    ------
    SystemExit
        With code 2, after one sentence to stderr, where the file cannot be written.
    TypeError
        For what is no figure, and arguments that are no sequence.

    Examples
    --------
    >>> import sys
    >>> import cdcr.plotting
    >>> figure = cdcr.plotting.plot_robot(cdcr.Model(cdcr.robots.amouri2020()), [0.5, 0.0]).figure
    >>> cdcr.plotting.show_or_save(figure, sys.argv[1:])  # doctest: +SKIP
    """
    if not isinstance(figure, Figure):
        raise TypeError(f"figure must be a Matplotlib figure, got {type(figure).__name__}")
    arguments = as_tuple("arguments", arguments, "a sequence of str, as sys.argv[1:]")
    if not arguments:
        from matplotlib import pyplot

        pyplot.show()
        return
    path = Path(arguments[0])
    try:
        formats = figure.canvas.get_supported_filetypes()
        suffix = path.suffix.lower().removeprefix(".")
        if len(arguments) > 1 or suffix not in formats:
            told = "give one file for the picture, whose name ends in .png, .pdf, .svg or the like"
            raise ValueError(f"{told}, got {' '.join(arguments)!r}")
        with new_file(path, overwrite=True) as part:
            figure.savefig(part, format=suffix)
    except (OSError, ValueError) as error:
        told = str(error)
        if isinstance(error, OSError) and error.filename is not None:
            told = f"{error.filename}: {error.strerror}"
        print(f"{Path(sys.argv[0]).name}: {told}", file=sys.stderr)
        raise SystemExit(MISTAKEN) from None
