"""Scenario files: a user's run in TOML, for ``cdcr run FILE.toml``.

    robot = "amouri2020"            # a known robot, a robot file, or a table [robot] with sections
    t_end = 10.0                    # [s]
    tension = [5.0, 0.0, 0.0]       # of each cable [N]; or tables, see `cdcr new`

    [initial]                       # straight and at rest without it
    theta_deg = [45.0]              # of each section; or theta [rad], or q [rad]
    phi_deg = [0.0]

In place of tension there may be a [trajectory] or a [controller], and tables [[wrenches]] beside
any of them. ``cdcr new FILE`` writes a file
that shows everything. Files named in it are found from the folder it is in.
"""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from cdcr import robots
from cdcr.files.toml import read_toml, refuse, schema_errors
from cdcr.model.model import Model
from cdcr.robot.file import robot_from_table
from cdcr.robot.robot import Robot
from cdcr.scenarios.file.controller import read_controller
from cdcr.scenarios.file.shapes import TensionShapes
from cdcr.scenarios.file.tension import read_tension
from cdcr.scenarios.file.trajectory import read_trajectory
from cdcr.scenarios.file.values import bending_vector, error_prefix, length_errors, rival_errors
from cdcr.scenarios.file.wrenches import read_wrenches
from cdcr.scenarios.scenario import FILES, Scenario

# Keys that a file has in common with Scenario.
_COMMON = ("title", "description", "source", "formulation", "t_end", "num_samples", "method")
_OPTIONS = ("rtol", "atol", "step", "max_step", "max_steps")
_INPUTS = ("tension", "trajectory", "controller")


def load_scenario(path: str | PathLike[str]) -> Scenario:
    """Return the scenario of a file, named as the file without its suffix.

    Raises
    ------
    FileNotFoundError
        Where the file, or one it names, does not exist.
    ValueError
        Naming file, key and what is allowed, for everything else that is wrong with it.
    """
    from cdcr.scenarios.file.schema import ScenarioTable

    file = Path(path)
    table = read_toml(file, "scenario file")
    refuse(str(file), schema_errors(ScenarioTable, table))
    refuse(str(file), _input_errors(table))
    robot = _robot(table["robot"], file)
    with error_prefix(str(file)):
        model = Model(robot, formulation=table.get("formulation", "exact"))
    given: dict[str, Any] = {"title": file.stem, "description": "", "source": str(file)}
    given |= {name: table[name] for name in (*_COMMON, *_OPTIONS) if name in table}
    given |= _output(table.get("output", {}), table, file)
    given |= _input(table, model, file)
    given["wrenches"] = read_wrenches(table.get("wrenches", ()), model, file)
    if "initial" in table or "q0" not in given:
        q0, qd0 = initial_state(table.get("initial", {}), len(robot.sections), file)
        given |= {"q0": q0, "qd0": qd0}
    return Scenario(name=file.stem, robot=robot, **given)


def _input_errors(table: Mapping[str, Any]) -> list[str]:
    found = []
    given = [name for name in _INPUTS if name in table]
    if len(given) > 1:
        got = " and ".join(given)
        found.append(f"there must be only one of tension, trajectory and controller, got {got}")
    fed = table.get("trajectory", {}).get("feed_back", False)
    if "trajectory" in table and "initial" in table and not fed:
        found.append(
            "initial needs feed_back = true in [trajectory]; without it nothing starts anywhere"
        )
    if "trajectory" in table and "wrenches" in table and not fed:
        found.append(
            "wrenches need feed_back = true in [trajectory]; without it nothing is simulated"
        )
    return found


def _input(table: Mapping[str, Any], model: Model, file: Path) -> dict[str, Any]:
    """Return the fields of a scenario that say what moves the robot."""
    if "controller" in table:
        loop = read_controller(table["controller"], model, file)
        return {"controller": loop, "summarize": loop.summarize, "plot": loop.plot}
    if "trajectory" in table:
        motion = read_trajectory(table["trajectory"], model.num_sections, table["t_end"], file)
        q0, qd0 = motion.start()
        fields = {
            "input_source": motion,
            "summarize": motion.summarize,
            "plot": motion.plot,
            "q0": q0,
            "qd0": qd0,
        }
        return fields if motion.feed_back else fields | {"method": "inverse dynamics"}
    tension = read_tension(table.get("tension"), model, file)
    return {"input_source" if isinstance(tension, TensionShapes) else "tension": tension}


def _output(output: Mapping[str, Any], table: Mapping[str, Any], file: Path) -> dict[str, Any]:
    from cdcr.scenarios.file.schema import OutputTable

    found = schema_errors(OutputTable, output, "output")
    if "num_samples" in output and "num_samples" in table:
        found.append("num_samples must stand at the top or in [output], not in both")
    refuse(str(file), found)
    fields: dict[str, Any] = {}
    if "num_samples" in output:
        fields["num_samples"] = output["num_samples"]
    if "files" in output:
        # In the order in which files are written, the picture first; one named twice is one file.
        fields["files"] = tuple(FILES[name] for name in FILES if name in output["files"])
    return fields


def _robot(value: str | dict[str, Any], file: Path) -> Robot:
    if isinstance(value, dict):
        return robot_from_table(Robot, value, where=f"{file}, [robot]")
    if value.endswith(".toml"):
        return Robot.load(file.parent / value)
    with error_prefix(f"{file}, robot"):
        return robots.get(value)


def initial_state(
    table: Mapping[str, Any], num_sections: int, file: Path
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return q0 and qd0 from an [initial] table."""
    from cdcr.scenarios.file.schema import InitialTable

    found = schema_errors(InitialTable, table, "initial") + rival_errors(table, "initial")
    refuse(str(file), found)
    refuse(str(file), length_errors(table, num_sections, "initial"))
    qd = table.get("qd", [0.0] * (2 * num_sections))
    return bending_vector(table, num_sections), tuple(map(float, qd))
