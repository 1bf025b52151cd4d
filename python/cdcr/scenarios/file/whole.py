"""Scenario files as one table that needs no other file, so that it can travel to other machines."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from cdcr.files.toml import read_toml
from cdcr.robot.file import robot_table
from cdcr.runs.command import TensionTable
from cdcr.scenarios.file.reader import load_scenario, scenario_from_table
from cdcr.scenarios.file.trajectory import read_csv
from cdcr.scenarios.scenario import Scenario

__all__ = ["scenario_from_table", "whole_table"]


def whole_table(path: str | PathLike[str]) -> dict[str, Any]:
    """Return the table of a scenario file with every field of its robot, and its CSV files as rows.

    Raises
    ------
    FileNotFoundError
        Where the file, or one it names, does not exist.
    ValueError
        For everything else that is wrong with it, as `load_scenario` does.
    """
    file = Path(path)
    scenario = load_scenario(file)
    table = read_toml(file, "scenario file")
    table["robot"] = robot_table(scenario.robot)
    tension, motion = table.get("tension"), table.get("trajectory", {})
    if isinstance(tension, dict) and "file" in tension:
        table["tension"] = _without_file(tension, _rows(scenario))
    if "file" in motion:
        t, rows = read_csv(file.parent / motion["file"], scenario.model)
        samples = {key: values.tolist() for key, values in rows.items()}
        table["trajectory"] = _without_file(motion, {"t": list(t)} | samples)
    return table


def _without_file(table: Mapping[str, Any], rows: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in table.items() if key != "file"} | dict(rows)


def _rows(scenario: Scenario) -> dict[str, Any]:
    tension = scenario.tension
    assert isinstance(tension, TensionTable)
    return {"t": np.asarray(tension.t).tolist(), "rows": np.asarray(tension.tension).tolist()}
