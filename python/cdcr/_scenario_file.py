"""Scenario files: a user's run in TOML, for ``cdcr run FILE.toml``.

    robot = "amouri2020"            # a known robot, a robot file, or a table [robot] with sections
    t_end = 10.0                    # [s]
    tension = [5.0, 0.0, 0.0]       # of each cable [N]; or a table, see below

    [initial]                       # straight and at rest without it
    theta_deg = [45.0]              # of each section; or theta [rad], or q [rad]
    phi_deg = [0.0]

    [tension]                       # over time: in place
    t = [0.0, 1.0, 2.0]             # [s]
    rows = [[0.0, 0.0, 0.0], [5.0, 0.0, 0.0], [5.0, 5.0, 0.0]]
    interpolation = "previous"      # or "linear"

    [tension]                       # over time: from a file with the columns t, cable 1, ...
    file = "tension.csv"

Files named in it are found from the folder it is in.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from cdcr import robots
from cdcr._coordinates import bending
from cdcr._model import Model
from cdcr._robot import Robot
from cdcr._robot_file import load_robot, robot_from_table
from cdcr._simulate import TensionTable, tension_input
from cdcr._tension_file import read_tension_csv
from cdcr._toml import complaints, read_toml, refuse, shown_toml
from cdcr.scenarios import Scenario

_ANGLES = ("theta", "theta_deg", "phi", "phi_deg")
_RIVALS = (("theta", "theta_deg"), ("phi", "phi_deg"), *(("q", angle) for angle in _ANGLES))
# Keys that a file has in common with Scenario.
_COMMON = ("title", "description", "source", "formulation", "t_end", "num_samples", "method")
_OPTIONS = ("rtol", "atol", "step", "max_step", "max_steps")


def load_scenario(path: str | PathLike[str]) -> Scenario:
    """Return the scenario of a file, named as the file without its suffix.

    Raises
    ------
    FileNotFoundError
        Where the file, or one it names, does not exist.
    ValueError
        Naming file, key and what is allowed, for everything else that is wrong with it.
    """
    from cdcr._scenario_schema import ScenarioTable

    file = Path(path)
    table = read_toml(file, "scenario file")
    refuse(str(file), complaints(ScenarioTable, table))
    robot = _robot(table["robot"], file)
    with _said_by(str(file)):
        model = Model(robot, formulation=table.get("formulation", "exact"))
    q0, qd0 = initial_state(table.get("initial", {}), len(robot.sections), file)
    given: dict[str, Any] = {"title": file.stem, "description": "", "source": str(file)}
    given |= {name: table[name] for name in (*_COMMON, *_OPTIONS) if name in table}
    return Scenario(
        name=file.stem,
        robot=robot,
        q0=q0,
        qd0=qd0,
        tension=_tension(table.get("tension"), model, file),
        **given,
    )


def _robot(value: str | dict[str, Any], file: Path) -> Robot:
    if isinstance(value, dict):
        return robot_from_table(value, where=f"{file}, [robot]")
    if value.endswith(".toml"):
        return load_robot(file.parent / value)
    with _said_by(f"{file}, robot"):
        return robots.get(value)


@contextmanager
def _said_by(where: str) -> Iterator[None]:
    """Begin what is refused inside with where it stands."""
    try:
        yield
    except ValueError as error:
        raise ValueError(f"{where}: {error}") from None


def initial_state(
    table: Mapping[str, Any], num_sections: int, file: Path
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return q0 and qd0 from an [initial] table."""
    from cdcr._scenario_schema import InitialTable

    found = complaints(InitialTable, table, "initial")
    for one, other in _RIVALS:
        if one in table and other in table:
            found.append(f"initial must have {one} or {other}, not both")
    refuse(str(file), found)
    for key, value in table.items():
        wanted = num_sections * (2 if key in ("q", "qd") else 1)
        if len(value) != wanted:
            found.append(
                f"initial.{key} must have {_count(wanted, 'number')} for a robot with "
                f"{_count(num_sections, 'section')}, got {shown_toml(value)}"
            )
    refuse(str(file), found)
    straight = [0.0] * num_sections
    theta = table.get("theta", np.deg2rad(table.get("theta_deg", straight)))
    phi = table.get("phi", np.deg2rad(table.get("phi_deg", straight)))
    q0 = table.get("q", bending(theta, phi).tolist())
    return tuple(map(float, q0)), tuple(map(float, table.get("qd", 2 * straight)))


def _tension(value: Any, model: Model, file: Path) -> tuple[float, ...] | TensionTable:
    if isinstance(value, dict):
        return _tension_over_time(value, model, file)
    num_cables = model.num_cables
    tension = [0.0] * num_cables if value is None else value
    if len(tension) != num_cables:
        wanted = f"tension must have {_count(num_cables, 'number')}, one for each cable"
        refuse(str(file), [f"{wanted}, got {shown_toml(value)}"])
    return tuple(map(float, tension))


def _tension_over_time(table: dict[str, Any], model: Model, file: Path) -> TensionTable:
    from cdcr._scenario_schema import TensionFile, TensionRows

    refuse(str(file), complaints(TensionFile if "file" in table else TensionRows, table, "tension"))
    if "file" in table:
        where = str(file.parent / table["file"])
        t, rows = read_tension_csv(Path(where), model.num_cables)
    else:
        where = f"{file}, [tension]"
        t, rows = table["t"], table["rows"]
        refuse(where, _row_complaints(t, rows, model.num_cables))
    tension = TensionTable(t, rows, table.get("interpolation", "linear"))
    with _said_by(where):
        tension_input(model, tension)
    return tension


def _row_complaints(t: list[float], rows: list[list[float]], num_cables: int) -> list[str]:
    if len(rows) != len(t):
        return [f"rows must be as many as t, {len(t)}, got {len(rows)}"]
    return [
        f"rows[{i}] must have {_count(num_cables, 'number')}, one for each cable, got {len(row)}"
        for i, row in enumerate(rows)
        if len(row) != num_cables
    ]


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" + ("" if number == 1 else "s")
