"""The [loop.estimator] table of scenario files."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from cdcr._core import Estimator
from cdcr.model.model import Model
from cdcr.runs.estimators import ExtendedKalman, MomentumObserver, UnscentedKalman
from cdcr.runs.parameters import Variation
from cdcr.runs.parts import Actuator, Sensor
from cdcr.scenarios.file.trajectory import kind_errors
from cdcr.scenarios.file.values import error_prefix

_FILTERS = {"extended-kalman": ExtendedKalman, "unscented-kalman": UnscentedKalman}


@dataclass(frozen=True, eq=False)
class EstimatorMaker:
    """An estimator to be made for a model and a loop."""

    kind: str
    options: dict[str, Any]
    states: EstimatorMaker | None = None

    def __call__(
        self, model: Model, sensors: Sequence[Sensor], actuators: Sequence[Actuator]
    ) -> Estimator:
        """Return the estimator."""
        options = dict(self.options)
        if options.pop("actuators"):
            options["actuators"] = actuators
        if "variants" in options:
            options["variants"] = [
                _variant(model, one, f"variants[{i}]") for i, one in enumerate(options["variants"])
            ]
        if self.kind in _FILTERS:
            made: Estimator = _FILTERS[self.kind](model, sensors=sensors, **options)
            return made
        states = None if self.states is None else self.states(model, sensors, actuators)
        return MomentumObserver(model, states=states, **options)


def _variant(model: Model, numbers: dict[str, float], at: str) -> Model:
    """Return the model of a robot with other numbers at some paths."""
    if not numbers:
        raise ValueError(f"{at} must have a number of the robot")
    with error_prefix(at):
        return Variation(model, {path: [value] for path, value in numbers.items()}).model_of(0)


def read_estimator(table: dict[str, Any], model: Model, step: float, at: str) -> EstimatorMaker:
    """Return the maker of an estimator, or refuse the table with its key and value."""
    from cdcr.scenarios.file.estimator_schema import ESTIMATORS

    found = kind_errors(ESTIMATORS, table, at, "type")
    if found:
        raise ValueError("\n".join(found))
    options = {"period": step, "actuators": True} | table
    kind, states = options.pop("type"), options.pop("states", None)
    if states is not None and states.get("type") not in _FILTERS:
        known = " or ".join(f'"{name}"' for name in _FILTERS)
        raise ValueError(f"{at}.states must have the type {known}, got {states.get('type')!r}")
    if "force_at" in options:
        section, fraction = options["force_at"]
        if section not in range(1, model.num_sections + 1):
            wanted = f"a section, 1 to {model.num_sections}, and a fraction"
            raise ValueError(f"{at}.force_at must be {wanted}, got {table['force_at']}")
        options["force_at"] = int(section) - 1, fraction
    inner = None if states is None else read_estimator(states, model, step, f"{at}.states")
    return EstimatorMaker(kind, options, inner)
