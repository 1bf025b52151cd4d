"""Scenario files: a user's run in TOML, for ``cdcr run FILE.toml``.

    robot = "amouri2020"            # a known robot, a robot file, or a table [robot] with sections
    t_end = 10.0                    # [s]
    tension = [5.0, 0.0, 0.0]       # of each cable [N]; or tables, see `cdcr new`

    [integrator]
    method = "dopri5"               # or "auto", "dop853", "bdf", "adams", "rk4", "rosenbrock"

    [initial]                       # straight and at rest without it
    theta_deg = [45.0]              # of each section; or theta [rad], or q [rad]
    phi_deg = [0.0]

In place of tension there may be a [trajectory] or a [controller], and tables [[wrenches]] beside
any of them. ``cdcr new FILE`` writes a file that shows everything, ``cdcr new FILE --from NAME``
one of the package. Files named in it are found from the folder it is in.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.files.refusals import with_lines
from cdcr.files.toml import Faults, read_toml, refuse, schema_errors
from cdcr.model.model import Model
from cdcr.runs.command import TensionTable
from cdcr.runs.simulate import DEFAULT_METHOD, FIXED_STEP, integrator_options
from cdcr.scenarios.file.controller import read_controller
from cdcr.scenarios.file.loop import ClosedLoop, check_run, read_loop
from cdcr.scenarios.file.robot import read_robot
from cdcr.scenarios.file.shapes import TensionShapes
from cdcr.scenarios.file.start import read_start
from cdcr.scenarios.file.tension import read_tension
from cdcr.scenarios.file.tracking import TrackedMotion
from cdcr.scenarios.file.trajectory import read_trajectory
from cdcr.scenarios.file.values import error_prefix
from cdcr.scenarios.file.wrenches import read_wrenches
from cdcr.scenarios.scenario import FILES, Scenario

# Keys that a file has in common with Scenario.
_COMMON = ("title", "description", "source", "formulation", "t_end")
# Keys that stood at the top once.
_MOVED = dict.fromkeys(("method", "rtol", "atol", "step", "max_step", "max_steps"), "integrator")
_MOVED["num_samples"] = "output"
NUM_CHECKED = 1001  # samples of a motion that are looked at before it runs
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
    file = Path(path)
    table = read_toml(file, "scenario file")
    if "sections" in table and not {"robot", "t_end"} & table.keys():
        raise ValueError(
            f"{file} is a robot file: `cdcr info` and `cdcr view` take it, or name it in a scenario"
        )
    with with_lines(file):
        return scenario_from_table(table, file)


def scenario_from_table(table: dict[str, Any], file: Path) -> Scenario:
    """Return the scenario of the table of a file; it may be changed, and the file need not exist.

    Raises
    ------
    ValueError
        As `load_scenario` does, without lines.
    """
    from cdcr.scenarios.file.schema import ScenarioTable

    refuse(
        str(file),
        [f"{key} must stand in [{home}]" for key, home in _MOVED.items() if key in table],
    )
    faults = Faults()
    with faults.kept():
        refuse(str(file), schema_errors(ScenarioTable, table))
    if not faults:
        motion = table.get("trajectory", {})
        if "feed_back" in motion and "simulate" not in motion:
            motion["simulate"] = motion.pop("feed_back")  # its old name
        with faults.kept():
            refuse(str(file), _input_errors(table))
        with faults.kept():
            refuse(str(file), _step_errors(table))
    can_go_on = not faults
    given: dict[str, Any] = {"title": file.stem, "description": "", "source": str(file)}
    given |= {name: table[name] for name in _COMMON if name in table}
    with faults.kept():
        given |= _integrator(_table(table, "integrator"), file)
    with faults.kept():
        given |= _output(_table(table, "output"), file)
    if can_go_on:
        with faults.kept():
            given["robot"] = robot = read_robot(table["robot"], file)
            with error_prefix(str(file)):
                model = Model(robot, formulation=table.get("formulation", "exact"))
            given |= _of_model(table, model, file, given["t_end"])
    faults.done()
    loop = given.get("input_source")
    if isinstance(loop, ClosedLoop):
        check_run(table, loop, given.get("num_samples", Scenario.num_samples), file)
    return Scenario(name=file.stem, **given)


def _table(table: Mapping[str, Any], key: str) -> dict[str, Any]:
    """Return a table in a table, empty where there is none, or something else, told already."""
    found = table.get(key, {})
    return found if isinstance(found, dict) else {}


def _of_model(table: Mapping[str, Any], model: Model, file: Path, t_end: float) -> dict[str, Any]:
    """Return the fields of a scenario that depend on its model."""
    faults = Faults()
    given: dict[str, Any] = {"t_end": t_end}
    with faults.kept():
        given |= _input(table, model, file)
    with faults.kept():
        given["wrenches"] = read_wrenches(table.get("wrenches", ()), model, file)
    if "initial" in table or "q0" not in given:
        with faults.kept():
            command = _first_command(given)
            q0, qd0 = read_start(table.get("initial", {}), model, command, file)
            given |= {"q0": q0, "qd0": qd0}
    faults.done()
    return given


def _integrator(table: Mapping[str, Any], file: Path) -> dict[str, Any]:
    from cdcr.scenarios.file.schema import IntegratorTable

    refuse(str(file), schema_errors(IntegratorTable, table, "integrator"))
    is_fixed = table.get("method") in FIXED_STEP
    pointless = [key for key in ("rtol", "atol", "max_step") if is_fixed and key in table]
    refuse(
        str(file),
        [
            f"integrator.{key} is none of {table['method']}, whose steps are all step"
            for key in pointless
        ],
    )
    with error_prefix(f"{file}, [integrator]"):
        integrator_options(**{"method": DEFAULT_METHOD} | dict(table))
    return dict(table)


def _first_command(given: Mapping[str, Any]) -> Callable[[Model], FloatArray] | None:
    """Return what gives the commands (num_cables,) at t = 0, None where a controller does."""
    if "controller" in given:
        return None
    source, tension = given.get("input_source"), given.get("tension")
    if isinstance(source, TrackedMotion):
        return source.first_command
    if isinstance(source, TensionShapes):
        return lambda model: source(0.0)
    if callable(tension):
        return lambda model: _first_row(tension(model, given["t_end"]))
    if isinstance(tension, TensionTable):
        return lambda model: _first_row(tension)
    return lambda model: np.array(tension)


def _first_row(table: TensionTable) -> FloatArray:
    t, rows = np.asarray(table.t, dtype=np.float64), np.asarray(table.tension, dtype=np.float64)
    if table.interpolation == "previous":
        return np.asarray(rows[max(0, int(np.searchsorted(t, 0.0, side="right")) - 1)])
    return np.array([np.interp(0.0, t, column) for column in rows.T])


def _input_errors(table: Mapping[str, Any]) -> list[str]:
    found = []
    given = [name for name in _INPUTS if name in table]
    if len(given) > 1:
        got = " and ".join(given)
        found.append(f"there must be only one of tension, trajectory and controller, got {got}")
    if "loop" in table and "controller" not in table:
        found.append("loop needs a controller, and there is none")
    if "loop" in table and "integrator" in table:
        found.append("there must be only one of loop and integrator: a loop has steps of its own")
    motion = table.get("trajectory", {})
    if "feed_back" in motion:
        found.append("trajectory must have simulate or feed_back, its old name, not both")
    if "trajectory" in table and not motion.get("simulate", False):
        needs = "simulate = true in [trajectory]; without it nothing"
        if "initial" in table:
            found.append(f"initial needs {needs} starts anywhere")
        if "wrenches" in table:
            found.append(f"wrenches need {needs} is simulated")
    return found


def _step_errors(table: Mapping[str, Any]) -> list[str]:
    """Return a sentence for each step that is longer than the run."""
    steps = {home: _table(table, home).get("step") for home in ("integrator", *_INPUTS)}
    t_end = table["t_end"]
    return [
        f"{home}.step must be at most t_end, {t_end:g} s, got {step:g}"
        for home, step in steps.items()
        if isinstance(step, (int, float)) and step > t_end
    ]


def _input(table: Mapping[str, Any], model: Model, file: Path) -> dict[str, Any]:
    """Return the fields of a scenario that say what moves the robot."""
    if "controller" in table:
        loop = read_controller(table["controller"], model, file)
        shown = {"summarize": loop.summarize, "plot": loop.plot}
        if "loop" not in table:
            return {"controller": loop} | shown
        closed = read_loop(table["loop"], loop, model, file)
        fixed = {"method": closed.options.get("method", "rk4"), "step": closed.step}
        return {"controller": loop, "input_source": closed} | shown | fixed
    if "trajectory" in table:
        t_end = table["t_end"]
        motion = read_trajectory(table["trajectory"], model, t_end, file)
        motion.check(model, np.linspace(0.0, t_end, NUM_CHECKED))
        q0, qd0 = motion.start()
        fields = {
            "input_source": motion,
            "summarize": motion.summarize,
            "plot": motion.plot,
            "q0": q0,
            "qd0": qd0,
        }
        return fields if motion.simulate else fields | {"method": "inverse dynamics"}
    tension = read_tension(table.get("tension"), model, table["t_end"], file)
    return {"input_source" if isinstance(tension, TensionShapes) else "tension": tension}


def _output(output: Mapping[str, Any], file: Path) -> dict[str, Any]:
    from cdcr.scenarios.file.schema import OutputTable

    refuse(str(file), schema_errors(OutputTable, output, "output"))
    fields = {key: value for key, value in output.items() if key != "files"}
    if "files" in output:
        # In the order in which files are written, the picture first; one named twice is one file.
        fields["files"] = tuple(FILES[name] for name in FILES if name in output["files"])
    return fields
