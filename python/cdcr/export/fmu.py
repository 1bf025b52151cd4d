"""FMUs: a robot packed for co-simulation by FMI 2 or 3."""

from __future__ import annotations

import hashlib
import io
import platform
import sys
import zipfile
from collections.abc import Iterator
from dataclasses import fields
from importlib import metadata
from numbers import Integral
from os import PathLike
from pathlib import Path

import numpy as np

from cdcr import _core
from cdcr.base.check import Check, count, format_value, require_kind
from cdcr.export.fmu_description import IDENTIFIER, model_description
from cdcr.export.fmu_variables import variables
from cdcr.files.new_file import file_path, new_file
from cdcr.model.model import Model
from cdcr.robot.cable import Cable
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section

LIBRARY = Path(_core.__file__).with_name("_fmu.so")
# Where FMI has the shared object of a machine; FMI 2 names no folder for other processors.
_FOLDERS = {2: {"x86_64": "linux64"}, 3: {"x86_64": "x86_64-linux", "aarch64": "aarch64-linux"}}
_TABLES = {"sections", "cables"}
# What a field is called in bindings/fmu/setup_file.cpp where it holds pairs.
_PAIRS = {"radius": "radii", "angle": "angles"}


def write_fmu(
    robot: Robot,
    path: str | PathLike[str],
    *,
    fmi: int = 3,
    step: float | None = None,
    overwrite: bool = False,
) -> None:
    """Write a robot as an FMU for co-simulation, which needs neither Python nor a compiler.

    Inputs are the tension of each cable [N], or its length [m] where it is driven by length;
    parameters gravity and the state at the start; outputs the state, position and orientation of
    the tip, and length and tension of each cable. The FMU runs on Linux, on processors like the one
    it is written on. It saves and restores its state and gives derivatives by state and inputs,
    which are exact.

    Parameters
    ----------
    robot : Robot
        The robot, which must have inertia.
    path : str or path
        The file, whose name ends in .fmu; it appears whole or not at all. Its stem is the name of
        the model.
    fmi : {3, 2}, optional
        Version of the standard.
    step : float, optional
        Fixed step of Runge-Kutta 4 within a communication step [s]. By default Dormand-Prince 5(4)
        with the default tolerances of ``cdcr.simulate``.
    overwrite : bool, default False
        Whether a file of that name may be replaced.

    Raises
    ------
    ValueError
        For a `fmi`, a `step` or a name that is none, and for a robot without inertia.
    OSError
        Where the file exists and is not to be replaced, there is no such folder, or this is not a
        system for which there are FMUs.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import cdcr
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "arm.fmu")
    ...     cdcr.export.write_fmu(cdcr.robots.amouri2020(), file)
    ...     file.stat().st_size > 1e5
    True
    """
    content = fmu_bytes(robot, file_path(path), fmi=fmi, step=step)
    with new_file(file_path(path), overwrite=overwrite) as part:
        part.write_bytes(content)


def fmu_bytes(robot: Robot, file: Path, *, fmi: int = 3, step: float | None = None) -> bytes:
    """Return what `write_fmu` writes; the name of the file is that of the model."""
    require_kind("robot", robot, Robot)
    if not isinstance(fmi, Integral) or isinstance(fmi, bool) or fmi not in _FOLDERS:
        raise ValueError(f"fmi must be 2 or 3, got {format_value(fmi)}")
    if file.suffix != ".fmu":
        raise ValueError(f"the file name must end in .fmu, got {file.name!r}")
    if step is not None:
        check = Check()
        step = check.number("step", step, "a number > 0 s and finite", above=0.0)
        check.done()
    folder = _folder(fmi)
    model = Model(robot)
    if model.num_deflections or any(cable.backlash for cable in robot.all_cables):
        raise ValueError(
            "an FMU keeps no memory of friction and of play: presliding_stiffness and backlash "
            "must be 0"
        )
    _core.Simulator(model)  # refuses a robot without inertia
    lines = list(setup_lines(robot, step))
    told = "\n".join([_core.__version__, str(fmi), *lines])
    token = hashlib.sha256(told.encode()).hexdigest()
    about = _about(robot, step)
    description = model_description(
        variables(model), fmi=fmi, name=file.stem, about=about, token=token, step=step
    )
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        _add(archive, "modelDescription.xml", description)
        _add(archive, f"binaries/{folder}/{IDENTIFIER}.so", LIBRARY.read_bytes())
        setup = "\n".join([f"token {token}", *lines, ""])
        _add(archive, "resources/setup.txt", setup.encode())
        for name, text in _licenses():
            _add(archive, f"documentation/licenses/{name}", text)
    return content.getvalue()


def _folder(fmi: int) -> str:
    machine = platform.machine()
    if sys.platform != "linux" or machine not in _FOLDERS[fmi]:
        known = ", ".join(_FOLDERS[fmi])
        raise OSError(
            f"FMUs of FMI {fmi} can be written on Linux with {known}, "
            f"this is {sys.platform} with {machine}"
        )
    if not LIBRARY.is_file():
        raise OSError(f"cdcr was built without {LIBRARY.name}, which goes into FMUs")
    return _FOLDERS[fmi][machine]


def _about(robot: Robot, step: float | None) -> str:
    how = "Dormand-Prince 5(4)" if step is None else f"Runge-Kutta 4 with steps of {step:g} s"
    parts = f"{count(len(robot.sections), 'section')} and {count(robot.num_cables, 'cable')}"
    return f"Cable-driven continuum robot of {parts}, by {how}"


def setup_lines(robot: Robot, step: float | None = None) -> Iterator[str]:
    """Yield what bindings/fmu/setup_file.cpp reads: a key and its numbers in each line."""
    if step is not None:
        yield _line("rk4_step", step)
    yield from _field_lines(robot)
    for section in robot.sections:
        yield "section"
        yield from _field_lines(section)
    for cable in robot.cables:
        yield "cable"
        yield from _field_lines(cable)


def _field_lines(thing: Robot | Section | Cable) -> Iterator[str]:
    for name in (item.name for item in fields(thing)):
        value = getattr(thing, name)
        if name == "backbone_diameter" and isinstance(value, tuple):
            yield _line(name, value[0])
            yield _line("backbone_tip_diameter", value[1])
        elif name in _PAIRS and isinstance(value, tuple):
            yield _line(_PAIRS[name], value)
        elif name.endswith("_order"):
            yield _line(name, -1 if value is None else value)  # -1: locked
        elif name not in _TABLES:
            yield _line(name, value)


def _line(key: str, value: object) -> str:
    numbers = [] if value is None else np.ravel(np.asarray(value, dtype=np.float64)).tolist()
    return " ".join([key, *map(_exactly, numbers)])


def _exactly(number: float) -> str:
    """Return 0x1ap-4 for 1.625: exact, and without a point, which not every locale has."""
    numerator, denominator = number.as_integer_ratio()
    return f"{numerator:#x}p-{denominator.bit_length() - 1}"


def _licenses() -> Iterator[tuple[str, bytes]]:
    """Yield the licences of what is in the shared object, by name."""
    for file in metadata.files("cdcr") or ():
        if "licenses" in file.parts:
            yield file.name, file.read_binary()


def _add(archive: zipfile.ZipFile, name: str, content: bytes) -> None:
    """Add a file without a date, so that the same robot gives the same bytes."""
    entry = zipfile.ZipInfo(name)
    entry.external_attr = (0o755 if name.endswith(".so") else 0o644) << 16
    archive.writestr(entry, content, zipfile.ZIP_DEFLATED)
