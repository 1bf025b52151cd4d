"""What the picture of the flow of data stands for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from cdcr.scenarios.metrics import Metric

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario


def summarize(scenario: Scenario, run: None) -> tuple[Metric, ...]:
    """Return the sizes of what flows."""
    model = scenario.model
    return (
        Metric("num_coordinates", "coordinates q", model.num_coordinates, ""),
        Metric("num_cables", "cables", model.num_cables, ""),
    )
