"""Controllers that reckon with a model: C++ objects that a run asks once each period."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.arrays import finite
from cdcr.base.check import require_kind
from cdcr.base.keywords import by_keyword
from cdcr.model.model import Model
from cdcr.runs.limits import checked, told


def _limits(min_tension: float, max_tension: float, max_rate: float) -> dict[str, Any]:
    return {"min_tension": min_tension, "max_tension": max_tension, "max_rate": max_rate}


@by_keyword
class ComputedTorque(_core.ComputedTorque):
    """Inverse dynamics and PD: errors die away as e'' + kd e' + kp e = 0.

    Q = M (qdd_ref + kd (qd_ref - qd) + kp (ref - q)) + h, reckoned for the middle of the period
    over which commands are held. Where cables cannot give any force, as those of rods cannot, the
    error of what they move obeys that equation, B^T q, where B is constant.

    Parameters
    ----------
    model : Model
        The robot that it reckons with.
    kp, kd : float, (d,) or (d, d) array_like, optional
        The square of a natural frequency [1/s^2], and twice a damping ratio times it [1/s].
    period : float, optional
        Sampling period [s].
    lead : float, optional
        How far ahead it reckons [s]: half a period unless given, more where actuators are late.
    delay : float, optional
        How old measurements are [s], >= 0.
    min_tension, max_tension, cables, pretension, max_rate : optional
        Limits of the cables, as in `Pid`.

    Attributes
    ----------
    reference, path, diagnostics
        As in `Pid`.

    Raises
    ------
    ValueError
        For a gain, period, limit or reference out of its range, or a robot without inertia.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> controller = cdcr.ComputedTorque(model, kp=64.0, kd=16.0)
    >>> controller.reference = [0.4, 0.2]
    >>> run = cdcr.simulate(model, [0, 0], [0, 0], t=[0.0, 4.0], controller=controller)
    >>> run.q[-1].round(4)
    array([0.4, 0.2])
    """

    __slots__ = ()  # a misspelt attribute is an error

    def __init__(
        self,
        model: Model,
        *,
        kp: ArrayLike = 100.0,
        kd: ArrayLike = 20.0,
        period: float = 1e-3,
        lead: float | None = None,
        delay: float = 0.0,
        min_tension: float = 0.0,
        max_tension: float = math.inf,
        cables: Sequence[int] | None = None,
        pretension: ArrayLike | None = None,
        max_rate: float = math.inf,
    ) -> None:
        numbers = {"period": period, "delay": delay, **_limits(min_tension, max_tension, max_rate)}
        if lead is not None:
            numbers["lead"] = lead
        options = checked(
            numbers, gains={"kp": kp, "kd": kd}, others={"pretension": pretension}, cables=cables
        )
        require_kind("model", model, Model)
        super().__init__(model, {"lead": None} | options)

    def __repr__(self) -> str:
        """Say the gains."""
        options = self.options
        gains = {name: options[name] for name in ("kp", "kd")}
        return told("ComputedTorque", self.period, gains)


@by_keyword
class StateFeedback(_core.StateFeedback):
    """A linear law on the state, u = u_ref - K (x - x_ref) with x = (q, qd), within limits.

    Its gain is that of `cdcr.control.lqr`, or any other. Commands beyond the limits are replaced by
    the nearest tensions within them that bend the robot alike.

    Parameters
    ----------
    model : Model
        The robot that it reckons with.
    gain : (num_cables, 2d) array_like
        K [N/rad], [N s/rad]; [m/rad], [m s/rad] of cables driven by length.
    command : (num_cables,) array_like, optional
        Commands u_ref [N], [m]; by default those that hold the reference still.
    period : float, optional
        Sampling period [s].
    min_tension, max_tension, cables, pretension, max_rate : optional
        Limits of the cables, as in `Pid`.

    Attributes
    ----------
    reference, path, diagnostics
        As in `Pid`.

    Raises
    ------
    ValueError
        For a gain of another shape, a period, limit or reference out of its range.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
    >>> hold = model.allocate(model.bias([0.4, 0.2], [0, 0]), min_tension=1.0)
    >>> K = cdcr.control.lqr(model, [0.4, 0.2], hold, Q=[100, 100, 1, 1], R=0.01)
    >>> controller = cdcr.StateFeedback(model, gain=K, min_tension=1.0)
    >>> controller.reference = [0.4, 0.2]
    >>> run = cdcr.simulate(model, [0, 0], [0, 0], t=[0.0, 4.0], controller=controller)
    >>> run.q[-1].round(4)
    array([0.4, 0.2])
    """

    __slots__ = ()  # a misspelt attribute is an error

    def __init__(
        self,
        model: Model,
        *,
        gain: ArrayLike,
        command: ArrayLike | None = None,
        period: float = 1e-3,
        min_tension: float = 0.0,
        max_tension: float = math.inf,
        cables: Sequence[int] | None = None,
        pretension: ArrayLike | None = None,
        max_rate: float = math.inf,
    ) -> None:
        options = checked(
            {"period": period, **_limits(min_tension, max_tension, max_rate)},
            others={"pretension": pretension, "gain": gain, "command": command},
            cables=cables,
        )
        require_kind("model", model, Model)
        super().__init__(model, options)

    def __repr__(self) -> str:
        """Say the gains."""
        options = self.options
        gains = {name: options[name] for name in ("gain",)}
        return told("StateFeedback", self.period, gains)


@by_keyword
class TaskSpace(_core.TaskSpace):
    """Moves the tip along a reference: inverse of its Jacobian, posture, inverse dynamics.

    The inverse is damped, so that motions stay bounded where the tip cannot be moved, as along the
    straight robot. What the tip leaves free goes to a posture. With `orientation_weight` the tip is
    turned too; where coordinates are too few for both, the weight says what counts how much.

    Parameters
    ----------
    model : Model
        The robot that it reckons with.
    kp, kd : float, (3,) or (3, 3) array_like, optional
        Of the tip's error [1/s^2] and its rate [1/s]; with orientation (6,) or (6, 6).
    orientation_weight : float or (3,) array_like, optional
        What a radian is worth in metres, about all axes of the tip or about each [m/rad]; without
        it the tip turns as it likes. Zero lets it turn about that axis.
    posture : (d,) array_like, optional
        Coordinates to be near to; by default the shape at rest.
    posture_kp, posture_kd : float, optional
        Of the posture [1/s^2], [1/s].
    damping : float, optional
        Of the inverse, over the robot's length, > 0 [1/rad].
    period : float, optional
        Sampling period [s].
    lead : float, optional
        How far ahead it reckons [s], as in `ComputedTorque`.
    delay : float, optional
        How old measurements are [s], >= 0.
    min_tension, max_tension, cables, pretension, max_rate : optional
        Limits of the cables, as in `Pid`.

    Attributes
    ----------
    reference : (3,) or (6,) array
        Position of the tip in the base frame [m], with orientation its rotation vector after that
        [rad]; those of the shape at rest until set.
    path, diagnostics
        As in `Pid`.

    Raises
    ------
    ValueError
        For a gain, period, limit or reference out of its range, or a robot without inertia.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.three_sections(damping=0.02))
    >>> controller = cdcr.TaskSpace(model, damping=1e-3, min_tension=0.5)
    >>> goal = model.tip([0.5, 0.0, 0.2, 0.1, 0.1, 0.3])[1]
    >>> controller.reference = goal
    >>> run = cdcr.simulate(model, [0.1] * 6, [0] * 6, t=[0.0, 4.0], controller=controller)
    >>> bool(abs(run.tip[-1] - goal).max() < 1e-4)
    True

    A pose, which three sections just reach, from near it:

    >>> R, p = model.tip([0.5, 0.0, 0.2, 0.1, 0.1, 0.3])
    >>> controller = cdcr.TaskSpace(model, orientation_weight=0.3, damping=3e-3, min_tension=0.5)
    >>> controller.reference = [*p, *cdcr.rotation_vector(R)]
    >>> near = [0.4, 0.1, 0.2, 0.1, 0.1, 0.2]
    >>> run = cdcr.simulate(model, near, [0] * 6, t=[0.0, 4.0], controller=controller)
    >>> bool(abs(run.q[-1] - [0.5, 0.0, 0.2, 0.1, 0.1, 0.3]).max() < 1e-3)
    True
    """

    __slots__ = ()  # a misspelt attribute is an error

    def __init__(
        self,
        model: Model,
        *,
        kp: ArrayLike = 100.0,
        kd: ArrayLike = 20.0,
        orientation_weight: ArrayLike | None = None,
        posture: ArrayLike | None = None,
        posture_kp: float = 25.0,
        posture_kd: float = 10.0,
        damping: float = 1e-2,
        period: float = 1e-3,
        lead: float | None = None,
        delay: float = 0.0,
        min_tension: float = 0.0,
        max_tension: float = math.inf,
        cables: Sequence[int] | None = None,
        pretension: ArrayLike | None = None,
        max_rate: float = math.inf,
    ) -> None:
        numbers = {} if lead is None else {"lead": lead}
        weight = None
        if orientation_weight is not None:
            weight = np.atleast_1d(finite(orientation_weight, "orientation_weight"))
        options = checked(
            {
                **numbers,
                "posture_kp": posture_kp,
                "posture_kd": posture_kd,
                "damping": damping,
                "delay": delay,
                "period": period,
                **_limits(min_tension, max_tension, max_rate),
            },
            gains={"kp": kp, "kd": kd},
            others={
                "pretension": pretension,
                "posture": posture,
                "orientation_weight": weight,
            },
            cables=cables,
        )
        require_kind("model", model, Model)
        super().__init__(model, {"lead": None} | options)

    def __repr__(self) -> str:
        """Say the gains."""
        options = self.options
        gains = {name: options[name] for name in ("kp", "kd")}
        return told("TaskSpace", self.period, gains)
