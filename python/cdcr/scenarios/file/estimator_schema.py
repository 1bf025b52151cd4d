"""What the table [loop.estimator] of a scenario file may hold."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel

from cdcr.scenarios.file.schema import STRICT, Finite, needed, optional


class _EstimatorTable(BaseModel):
    """What the tables of all types have in common."""

    model_config = STRICT

    period: float = optional(
        "a number > 0 [s]", "between updates; a step unless given", gt=0.0, allow_inf_nan=False
    )
    actuators: bool = optional(
        "true or false", "whether it reckons with the actuators of the loop; true by default"
    )
    force_at: list[float] = optional(
        "the number of a section, from 1, and a fraction of its length",
        "a place at which a force is estimated",
        min_length=2,
        max_length=2,
    )


class KalmanTable(_EstimatorTable):
    """The [loop.estimator] table of type "extended-kalman" or "unscented-kalman"."""

    type: Literal["extended-kalman", "unscented-kalman"] = needed(
        '"extended-kalman" or "unscented-kalman"', "kind of estimator"
    )
    substeps: int = optional("a whole number > 0", "Runge-Kutta steps in each period", gt=0)
    acceleration_noise: float = optional(
        "a number >= 0 [rad/s^1.5]",
        "root of the density of unknown accelerations",
        ge=0.0,
        allow_inf_nan=False,
    )
    start: list[Finite] = optional(
        "an array of numbers [rad]", "estimate of the coordinates at first; the truth by default"
    )
    deviation: float = optional(
        "a number >= 0 [rad]", "standard deviation of them", ge=0.0, allow_inf_nan=False
    )
    rate_deviation: float = optional(
        "a number >= 0 [rad/s]", "standard deviation of the rates", ge=0.0, allow_inf_nan=False
    )
    force_noise: float = optional(
        "a number >= 0 [N/s^0.5]", "of the force's random walk", ge=0.0, allow_inf_nan=False
    )
    force_deviation: float = optional(
        "a number >= 0 [N]", "standard deviation of the force", ge=0.0, allow_inf_nan=False
    )
    variants: list[dict[str, Finite]] = optional(
        'an array of tables, such as {payload = 0.05} or {"sections.1.youngs_modulus" = 1e11}',
        "robots with other numbers; of each the share of that difference is estimated",
        min_length=1,
    )
    share_noise: float = optional(
        "a number >= 0 [1/s^0.5]", "of a share's random walk", ge=0.0, allow_inf_nan=False
    )
    share_deviation: float = optional(
        "a number >= 0", "standard deviation of a share", ge=0.0, allow_inf_nan=False
    )


class ObserverTable(_EstimatorTable):
    """The [loop.estimator] table of type "momentum-observer"."""

    type: Literal["momentum-observer"] = needed('"momentum-observer"', "kind of estimator")
    bandwidth: float = optional(
        "a number > 0 [rad/s]", "of what it tells", gt=0.0, allow_inf_nan=False
    )
    damping: float = optional(
        "a number > 0 [1/rad]",
        "of the inverse that finds a force, over the robot's length",
        gt=0.0,
        allow_inf_nan=False,
    )
    states: dict[str, Any] = optional(
        "a table of a Kalman filter", "what tells it the state, in place of sensors of it"
    )


# Tables of [loop.estimator] by their type.
ESTIMATORS: dict[str, type[BaseModel]] = {
    "extended-kalman": KalmanTable,
    "unscented-kalman": KalmanTable,
    "momentum-observer": ObserverTable,
}
