"""The JSON schema of scenario files, from the schemas of their tables."""

from __future__ import annotations

from typing import Any

from cdcr import _core, robots
from cdcr.files.json_schema import Schema, document, one_of_keys, table_schema
from cdcr.robot.json_schema import changes_schema, robot_schema, section_schema
from cdcr.scenarios.file import control_schema as control
from cdcr.scenarios.file import estimator_schema as estimators
from cdcr.scenarios.file import schema as tables
from cdcr.scenarios.file import shape_schema as shapes
from cdcr.scenarios.file.values import RIVALS


def scenario_file_schema() -> Schema:
    """Return what a scenario file may hold, as JSON schema.

    What depends on the robot, such as how many numbers an array must have, is left to
    ``cdcr validate``.
    """
    angles = one_of_keys(*RIVALS)
    reference = table_schema(tables.ReferenceTable) | angles
    scenario = table_schema(
        tables.ScenarioTable,
        robot=_robot(),
        formulation={"enum": [name.replace("_", "-") for name in _core.Formulation.__members__]},
        initial=table_schema(tables.InitialTable) | angles,
        tension=_tension(),
        wrenches=_array(_wrench()),
        trajectory=_trajectory(),
        controller=_controller(reference),
        loop=_loop(),
        integrator=table_schema(tables.IntegratorTable),
        output=table_schema(tables.OutputTable),
    )
    inputs = ("tension", "trajectory"), ("tension", "controller"), ("trajectory", "controller")
    return document("A scenario of a cable-driven continuum robot (cdcr)", scenario) | one_of_keys(
        *inputs
    )


def _controller(reference: Schema) -> Schema:
    motion: Schema = {"anyOf": _shapes(control.MOTIONS)}
    kinds = []
    for name, table in control.CONTROLLERS.items():
        held = {"reference": reference} if "reference" in table.model_fields else {}
        kinds.append(table_schema(table, type={"const": name}, motion=motion, **held))
    return {"anyOf": kinds}


def _loop() -> Schema:
    actuator = table_schema(control.ActuatorTable, winch=table_schema(control.WinchTable))
    sensor = table_schema(control.SensorTable)
    return table_schema(
        control.LoopTable,
        actuators=_array(actuator, minItems=1),
        sensors=_array(sensor, minItems=1),
        estimator={"anyOf": _estimators()},
    )


def _estimators() -> list[Schema]:
    filters: list[Schema] = [table_schema(estimators.KalmanTable)]
    return [*filters, table_schema(estimators.ObserverTable, states=filters[0])]


def _array(items: Schema, **limits: Any) -> Schema:
    return {"type": "array", "items": items} | limits


def _robot() -> Schema:
    changed = changes_schema()
    extra = table_schema(
        tables.RobotChanges,
        name={"enum": _names()},
        each_section=section_schema(partial=True),
    )
    changed["properties"] |= {key: extra["properties"][key] for key in ("name", "each_section")}
    changed["required"] = ["name"]
    return {
        "anyOf": [
            {"enum": _names()},
            {"type": "string", "pattern": r"\.toml$"},
            robot_schema(),
            changed,
        ]
    }


def _names() -> list[str]:
    """Return the names of robots, which may have dashes too."""
    found = robots.names()
    return [*found, *(name.replace("_", "-") for name in found if "_" in name)]


def _shapes(known: dict[str, Any], **replaced: Schema) -> list[Schema]:
    return [table_schema(table, shape={"const": name}, **replaced) for name, table in known.items()]


def _tension() -> Schema:
    shape: Schema = {"anyOf": _shapes(shapes.TENSION_SHAPES)}
    hold = table_schema(tables.HoldTable) | one_of_keys(*RIVALS)
    return {
        "anyOf": [
            _array({"type": "number", "minimum": 0}),
            _array(shape, minItems=1),
            table_schema(tables.TensionRows),
            table_schema(tables.TensionHold, hold=hold),
            table_schema(tables.TensionSampled, shapes=_array(shape, minItems=1)),
            table_schema(tables.TensionFile),
        ]
    }


def _wrench() -> Schema:
    some = {"anyOf": [{"required": ["force"]}, {"required": ["moment"]}]}
    pairs = {"times": ["factors"], "factors": ["times"], "interpolation": ["times"]}
    return table_schema(tables.WrenchTable) | some | {"dependencies": pairs}


def _trajectory() -> Schema:
    samples = table_schema(shapes.TrajectorySamples) | one_of_keys(*RIVALS)
    return {
        "anyOf": [
            *_shapes(shapes.TRAJECTORY_SHAPES),
            samples,
            table_schema(shapes.TrajectoryFile),
        ]
    }
