"""Files for ``cdcr identify``: a robot, what is sought, and what was measured.

    robot = "robot.toml"                # or a known robot

    [parameters]                        # sections and cables count from 1
    "sections[*].youngs_modulus" = {low = 20e9, high = 90e9}
    "base tilt" = {}

    [[poses]]
    file = "pulls.csv"                  # columns: cable 1 [N], .., tip x [mm], ..
    noise = 0.001                       # [m]

Files named in it are found from the folder it is in.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cdcr import robots
from cdcr.files.refusals import named_by, with_lines
from cdcr.files.toml import Faults, read_toml, refuse, schema_errors
from cdcr.identification.data import Data
from cdcr.identification.fit import fit, places_of
from cdcr.identification.frequencies import Frequencies
from cdcr.identification.motions import Motion
from cdcr.identification.parameter import unknowns_of
from cdcr.identification.poses import Poses
from cdcr.identification.result import Identified
from cdcr.identification.setup import Place, plain_setup
from cdcr.robot.robot import Robot

if TYPE_CHECKING:
    from pydantic import BaseModel

_OPTIONS = ("loss", "starts", "seed")


@dataclass(frozen=True, eq=False)
class Task:
    """What a file asks for."""

    robot: Robot
    parameters: Mapping[str, Any]
    data: tuple[Data, ...]
    options: Mapping[str, Any]
    folds: int | None

    def run(self) -> Identified:
        """Return what is found."""
        return fit(self.data, self.robot, self.parameters, first=1, **self.options)


def load_task(path: str | PathLike[str]) -> Task:
    """Return what a file asks for, its measurements read.

    Raises
    ------
    FileNotFoundError
        Where the file, or one it names, does not exist.
    ValueError
        Naming file, key or row and column of what is wrong.
    """
    file = Path(path)
    table = read_toml(file, "file for cdcr identify")
    with with_lines(file):
        return _task(file, table)


def _task(file: Path, table: dict[str, Any]) -> Task:
    from cdcr.identification.schema import FrequenciesTable, MotionTable, PosesTable, TaskTable

    refuse(str(file), schema_errors(TaskTable, table))
    robot = _robot(table["robot"], file)
    kinds: dict[str, tuple[type[BaseModel], Callable[..., Data]]] = {
        "poses": (PosesTable, Poses.load),
        "motions": (MotionTable, Motion.load),
        "frequencies": (FrequenciesTable, _frequencies),
    }
    faults, data = Faults(), []
    for key, (schema, make) in kinds.items():
        for i, one in enumerate(table.get(key, [])):
            at = f"{key}[{i}]"
            with faults.kept():
                refuse(str(file), schema_errors(schema, one, at))
                with named_by(f"{file}: {at}"):
                    data.append(_data(one, make, robot, file.parent))
    faults.done()
    if not data:
        raise ValueError(f"{file}: there must be a table [[poses]], [[motions]] or [[frequencies]]")
    with named_by(str(file)):
        unknowns_of(table["parameters"], robot, plain_setup(robot, places_of(data)), first=1)
    options = {key: table[key] for key in _OPTIONS if key in table}
    return Task(robot, table["parameters"], tuple(data), options, table.get("folds"))


def _robot(name: str, file: Path) -> Robot:
    if name.endswith(".toml"):
        with named_by(f"{file}, robot"):
            return Robot.load(file.parent / name)
    try:
        return robots.get(name)
    except ValueError as error:
        raise ValueError(f"{file}: robot: {error}") from None


def _data(table: Mapping[str, Any], make: Callable[..., Data], robot: Robot, folder: Path) -> Data:
    given = dict(table)
    if "markers" in given:
        given["markers"] = [_place(one, robot) for one in given["markers"]]
    if "file" not in given:
        return make(**given)
    return make(folder / given.pop("file"), robot, **given)


def _place(pair: list[float], robot: Robot) -> Place:
    count = len(robot.sections)
    if len(pair) != 2 or pair[0] not in range(1, count + 1) or not 0.0 <= pair[1] <= 1.0:
        raise ValueError(
            f"markers must be an array of pairs, a section from 1 to {count} and a fraction from 0 "
            f"to 1, got {pair}"
        )
    return int(pair[0]) - 1, pair[1]


def _frequencies(**given: Any) -> Frequencies:
    if "mode" in given:
        given["mode"] = [number - 1 for number in given["mode"]]
    return Frequencies(**given)
