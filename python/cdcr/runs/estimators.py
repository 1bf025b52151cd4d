"""States and forces from measurements: Kalman filters and an observer, C++ objects."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.arrays import finite
from cdcr.base.check import Check, as_tuple, require_kind
from cdcr.base.keywords import by_keyword
from cdcr.model.memory import other_drive, remembers, warn_of_memory
from cdcr.model.model import Model
from cdcr.model.stability import warn_of_long_steps
from cdcr.runs.limits import told
from cdcr.runs.parts import Actuator, Sensor, as_dicts, read_place


def _kalman(
    model: Model,
    *,
    sensors: Sensor | Sequence[Sensor],
    actuators: Actuator | Sequence[Actuator],
    acceleration_noise: ArrayLike,
    start: ArrayLike | None,
    force_at: tuple[int, float] | None,
    variants: Model | Sequence[Model],
    substeps: int,
    **numbers: Any,
) -> dict[str, Any]:
    """Return options as the core takes them, or refuse what is of another kind."""
    require_kind("model", model, Model)
    check = Check()
    given: dict[str, Any] = {
        name: check.number(name, value, "a number") for name, value in numbers.items()
    }
    given["substeps"] = check.whole("substeps", substeps, "a whole number >= 1")
    given["force_at"] = read_place(check, force_at)
    check.done()
    wanted = "a cdcr.Model or a sequence of them"
    models = (variants,) if isinstance(variants, Model) else as_tuple("variants", variants, wanted)
    for i, variant in enumerate(models):
        require_kind(f"variants[{i}]", variant, Model)
        differs = other_drive(model, variant)
        if differs is not None:
            raise ValueError(f"variants[{i}]: {differs}")
    rubs = next(filter(remembers, (model, *models)), model)
    warn_of_memory(rubs, "the filter", stacklevel=4)
    warn_of_long_steps(
        model, given["period"] / max(1, given["substeps"]), "the filter", stacklevel=4
    )
    noise = np.atleast_1d(finite(acceleration_noise, "acceleration_noise"))
    return given | {
        "sensors": as_dicts("sensors", sensors, Sensor),
        "actuators": as_dicts("actuators", actuators, Actuator),
        "acceleration_noise": noise,
        "start": start,
        "variants": list(models),
    }


@by_keyword
class ExtendedKalman(_core.ExtendedKalman):
    """Extended Kalman filter on the model: the state from any of the robot's sensors.

    It goes on by Runge-Kutta steps of the model and its exact Jacobian; sensors are heard as they
    tell, at their own periods, and late ones at the time of their measurement: the filter then
    stands as far back as the latest sensor is late, and the state is reckoned to now. Beside
    coordinates and rates it estimates, where asked, a force on the backbone, and parameters: of
    each of the `variants`, models with one parameter changed, the share of that change. It warns
    where cables or drives remember, and where its steps are too long to be stable.

    Parameters
    ----------
    model : Model
        The robot that it reckons with.
    sensors : Sensor or sequence of Sensor
        What is measured, with noise > 0; those of the loop, in their order.
    period : float, optional
        Time between updates [s].
    substeps : int, optional
        Runge-Kutta steps in each.
    actuators : Actuator or sequence of Actuator, optional
        Between command and cables, reckoned with as in a loop.
    acceleration_noise : float or (d,) array_like, optional
        Unknown accelerations: root of the density of white noise on each coordinate [rad/s^1.5].
    start : (d,) array_like, optional
        Estimate of the coordinates at reset [rad]; by default what `reset` is told.
    deviation, rate_deviation : float, optional
        Standard deviations of coordinates and rates there [rad], [rad/s].
    force_at : (int, float), optional
        A section and a fraction of its length, at which a force is estimated [N].
    force_noise, force_deviation : float, optional
        Of its random walk [N/s^0.5]; at reset, about zero [N].
    variants : Model or sequence of Model, optional
        The model with one parameter changed in each. Exact for payloads, moduli, densities and
        coefficients of damping; inertia must be positive for all shares in doubt.
    share_noise, share_deviation : float, optional
        Of the random walk of each share [1/s^0.5]; at reset, about zero [1].

    Raises
    ------
    ValueError
        For what is out of its range, sensors without noise, periods and delays that are no whole
        numbers of the filter's periods.
    TypeError
        For a model, a sensor or an actuator that is none.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.three_sections(damping=5e-3))
    >>> sensors = cdcr.Sensor(kind="lengths", noise=1e-5)
    >>> kalman = cdcr.ExtendedKalman(model, sensors=sensors, force_at=(2, 1.0), force_noise=0.05)
    >>> controller = cdcr.ComputedTorque(model, min_tension=1.0)
    >>> loop = cdcr.Loop(model, controller, sensors=sensors, estimator=kalman)
    >>> loop.reset([0.1] * 6, [0] * 6)
    >>> run = loop.run(1.0, wrenches=cdcr.Wrench(section=2, force=[0.2, 0.0, 0.0]))
    >>> bool(abs(run.estimated["force_x"][-1] - 0.2) < 0.02)
    True
    """

    __slots__ = ()  # a misspelt attribute is an error

    def __init__(
        self,
        model: Model,
        *,
        sensors: Sensor | Sequence[Sensor],
        period: float = 1e-3,
        substeps: int = 1,
        actuators: Actuator | Sequence[Actuator] = (),
        acceleration_noise: ArrayLike = 1.0,
        start: ArrayLike | None = None,
        deviation: float = 0.1,
        rate_deviation: float = 0.1,
        force_at: tuple[int, float] | None = None,
        force_noise: float = 1.0,
        force_deviation: float = 1.0,
        variants: Model | Sequence[Model] = (),
        share_noise: float = 0.0,
        share_deviation: float = 0.3,
    ) -> None:
        options = _kalman(
            model,
            sensors=sensors,
            period=period,
            substeps=substeps,
            actuators=actuators,
            acceleration_noise=acceleration_noise,
            start=start,
            deviation=deviation,
            rate_deviation=rate_deviation,
            force_at=force_at,
            force_noise=force_noise,
            force_deviation=force_deviation,
            variants=variants,
            share_noise=share_noise,
            share_deviation=share_deviation,
        )
        super().__init__(model, options)

    def __repr__(self) -> str:
        """Say how many sensors it hears."""
        return told("ExtendedKalman", self.period, {"sensors": len(self.options["sensors"])})


@by_keyword
class UnscentedKalman(_core.UnscentedKalman):
    """Unscented Kalman filter on the model: as `ExtendedKalman`, by points in place of Jacobians.

    Points about the estimate move and are measured one by one, which follows what bends within the
    spread of the estimate, at several times the cost.

    Parameters
    ----------
    model : Model
        The robot that it reckons with.
    sensors, period, substeps, actuators, acceleration_noise, start : optional
        As in `ExtendedKalman`.
    deviation, rate_deviation, force_at, force_noise, force_deviation : optional
        As in `ExtendedKalman`.
    variants, share_noise, share_deviation : optional
        As in `ExtendedKalman`.
    spread, beta, kappa : float, optional
        Points stand at spread (n + kappa)^(1/2) standard deviations, with n states; beta weighs the
        middle in covariances.

    Raises
    ------
    ValueError
        For what is out of its range.
    TypeError
        For a model, a sensor or an actuator that is none.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020(damping=0.02))
    >>> sensors = cdcr.Sensor(kind="tip", noise=1e-3)
    >>> kalman = cdcr.UnscentedKalman(model, sensors=sensors, start=[0.0, 0.0], deviation=0.3)
    >>> loop = cdcr.Loop(model, cdcr.Pid(model, kp=1.0), sensors=sensors, estimator=kalman)
    >>> loop.reset([0.3, 0.0], [0.0, 0.0])
    >>> run = loop.run(0.5)
    >>> bool(abs(run.told_q[-1] - run.trajectory.q[-1]).max() < 0.01)
    True
    """

    __slots__ = ()  # a misspelt attribute is an error

    def __init__(
        self,
        model: Model,
        *,
        sensors: Sensor | Sequence[Sensor],
        period: float = 1e-3,
        substeps: int = 1,
        actuators: Actuator | Sequence[Actuator] = (),
        acceleration_noise: ArrayLike = 1.0,
        start: ArrayLike | None = None,
        deviation: float = 0.1,
        rate_deviation: float = 0.1,
        force_at: tuple[int, float] | None = None,
        force_noise: float = 1.0,
        force_deviation: float = 1.0,
        variants: Model | Sequence[Model] = (),
        share_noise: float = 0.0,
        share_deviation: float = 0.3,
        spread: float = 1.0,
        beta: float = 2.0,
        kappa: float = 0.0,
    ) -> None:
        options = _kalman(
            model,
            sensors=sensors,
            period=period,
            substeps=substeps,
            actuators=actuators,
            acceleration_noise=acceleration_noise,
            start=start,
            deviation=deviation,
            rate_deviation=rate_deviation,
            force_at=force_at,
            force_noise=force_noise,
            force_deviation=force_deviation,
            variants=variants,
            share_noise=share_noise,
            share_deviation=share_deviation,
            spread=spread,
            beta=beta,
            kappa=kappa,
        )
        super().__init__(model, options)

    def __repr__(self) -> str:
        """Say how many sensors it hears."""
        return told("UnscentedKalman", self.period, {"sensors": len(self.options["sensors"])})


@by_keyword
class MomentumObserver(_core.MomentumObserver):
    """Forces that the model knows nothing of, from the change of momentum, without accelerations.

    What it tells is the generalised force behind a lag of first order, and the force on one place
    that explains it best. The state it leaves as it is told: by sensors of coordinates and rates,
    or by another estimator. It warns where cables or drives remember.

    Parameters
    ----------
    model : Model
        The robot that it reckons with.
    bandwidth : float, optional
        Of what it tells, > 0 [rad/s]: the higher, the more noise.
    period : float, optional
        Time between updates [s].
    force_at : (int, float), optional
        A section and a fraction of its length, where one force is what there is.
    damping : float, optional
        Of the inverse that finds it, over the robot's length, > 0 [1/rad].
    actuators : Actuator or sequence of Actuator, optional
        Between command and cables, reckoned with as in a loop.
    states : Estimator, optional
        Tells the state, in place of sensors of it.

    Attributes
    ----------
    generalized_force : (d,) array
        [N m].
    force : (3,) array
        In the base frame [N].

    Raises
    ------
    ValueError
        For what is out of its range.
    TypeError
        For a model, an actuator or an estimator that is none.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020(damping=0.02))
    >>> observer = cdcr.MomentumObserver(model, force_at=(0, 1.0))
    >>> controller = cdcr.ComputedTorque(model, min_tension=1.0)
    >>> loop = cdcr.Loop(model, controller, estimator=observer)
    >>> loop.reset([0.1, 0.0], [0.0, 0.0])
    >>> _ = loop.run(0.5, wrenches=cdcr.Wrench(section=0, force=[0.2, 0.1, 0.0]))
    >>> observer.force[:2].round(3)
    array([0.196, 0.098])
    """

    __slots__ = ()  # a misspelt attribute is an error

    def __init__(
        self,
        model: Model,
        *,
        bandwidth: float = 30.0,
        period: float = 1e-3,
        force_at: tuple[int, float] | None = None,
        damping: float = 1e-2,
        actuators: Actuator | Sequence[Actuator] = (),
        states: _core.Estimator | None = None,
    ) -> None:
        require_kind("model", model, Model)
        if states is not None:
            require_kind("states", states, _core.Estimator)
        warn_of_memory(model, "the observer", stacklevel=3)
        check = Check()
        numbers = {"bandwidth": bandwidth, "period": period, "damping": damping}
        options: dict[str, Any] = {
            name: check.number(name, value, "a number") for name, value in numbers.items()
        }
        options["force_at"] = read_place(check, force_at)
        check.done()
        options |= {"actuators": as_dicts("actuators", actuators, Actuator), "states": states}
        super().__init__(model, options)

    def __copy__(self) -> MomentumObserver:
        """Return a copy that asks a copy of the other estimator, which each moves on by itself."""
        return copy.deepcopy(self, {id(self.model): self.model})

    def __repr__(self) -> str:
        """Say the bandwidth."""
        return told("MomentumObserver", self.period, {"bandwidth": self.options["bandwidth"]})
