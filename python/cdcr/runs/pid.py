"""Controllers: C++ objects that a run asks for tensions once each period."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from cdcr import _core
from cdcr.base.check import Check
from cdcr.base.keywords import by_keyword
from cdcr.model.model import Model

_NUMBERS = ("kp", "ki", "kd", "period", "min_tension", "max_tension")
_SWITCHES = ("feed_forward", "anti_windup")


@by_keyword
class Pid(_core.Pid):
    """PID loop on the coordinates; its output is a generalised force, allocated to tensions.

    Q = dU/dq(ref) + kp (ref - q) + ki int (ref - q) dt - kd qd, evaluated every `period` and held
    in between. The gains are the same for every coordinate, so no direction is preferred.

    Parameters
    ----------
    model : Model
        The robot controlled.
    kp, ki, kd : float
        Gains [N m/rad], [N m/(rad s)], [N m s/rad], each >= 0.
    period : float, optional
        Sampling period [s].
    feed_forward : bool, optional
        Add the force that holds the reference still (elastic and weight).
    anti_windup : bool, optional
        Stop integrating what the tension limits cannot give.
    min_tension, max_tension : float, optional
        Limits of every tension [N]. A negative `min_tension` describes an ideal actuator that can
        push, which no cable does.
    cables : sequence of int, optional
        Indices of the cables that may be used; all by default.

    Attributes
    ----------
    reference : (d,) array
        Coordinates to reach and hold; straight until set.
    integral : (d,) array
        Accumulated error [rad s].

    Raises
    ------
    ValueError
        For a gain, period, limit or reference out of its range.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
    >>> pid = cdcr.Pid(model, kp=2.0, ki=4.0, kd=0.3, min_tension=0.5)
    >>> pid.reference = [0.4, 0.2]
    >>> run = cdcr.simulate(model, [0, 0], [0, 0], t=[0.0, 10.0], controller=pid)
    >>> run.q[-1].round(4)
    array([0.4, 0.2])
    """

    def __init__(
        self,
        model: Model,
        *,
        kp: float,
        ki: float = 0.0,
        kd: float = 0.0,
        period: float = 1e-3,
        feed_forward: bool = True,
        anti_windup: bool = True,
        min_tension: float = 0.0,
        max_tension: float = float("inf"),
        cables: Sequence[int] | None = None,
    ) -> None:
        given: dict[str, Any] = {"kp": kp, "ki": ki, "kd": kd, "period": period}
        given |= {"feed_forward": feed_forward, "anti_windup": anti_windup}
        given |= {"min_tension": min_tension, "max_tension": max_tension}
        check = Check()
        for name in _NUMBERS:
            given[name] = check.number(name, given[name], "a number")
        for name in _SWITCHES:
            if not isinstance(given[name], (bool, np.bool_)):
                check.refuse(name, "True or False", given[name])
        if cables is not None:
            must = "a sequence of indices of cables"
            chosen = check.items("cables", cables, must)
            given["cables"] = [
                check.whole(f"cables[{i}]", cable, "the index of a cable")
                for i, cable in enumerate(chosen)
            ]
        check.done()
        super().__init__(model, **given)
