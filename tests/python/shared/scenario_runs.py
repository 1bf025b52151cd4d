"""A scenario with its run and what it tells, computed once for all tests."""

from __future__ import annotations

from functools import cache
from typing import Any

import cdcr
from cdcr.scenarios import Scenario


@cache
def told(name: str) -> tuple[Scenario, Any, dict[str, float]]:
    """The scenario, its run, None where nothing runs, and the values of its summary by key."""
    scenario = cdcr.scenarios.get(name)
    run = scenario.simulate() if scenario.has_run else None
    return scenario, run, {metric.key: metric.value for metric in scenario.summary(run)}
