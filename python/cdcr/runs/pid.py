"""The PID loop: a C++ object that a run asks for commands once each period."""

from __future__ import annotations

import math
from collections.abc import Sequence

from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.check import require_kind
from cdcr.base.keywords import by_keyword
from cdcr.model.model import Model
from cdcr.runs.limits import checked


@by_keyword
class Pid(_core.Pid):
    """PID loop on the coordinates; its output is a generalised force, allocated to the cables.

    Q = dU/dq(ref) + kp (ref - q) + ki int (ref - q) dt + kd (rate of ref - qd), evaluated every
    `period` and held in between. A gain that is a number is the same for every coordinate, so that
    no direction is preferred. Cables driven by length get the lengths at which they pull with the
    tensions found.

    Parameters
    ----------
    model : Model
        The robot that it reckons with.
    kp, ki, kd : float, (d,) or (d, d) array_like
        Gains [N m/rad], [N m/(rad s)], [N m s/rad]; numbers >= 0.
    period : float, optional
        Sampling period [s].
    feed_forward : bool, optional
        Add the force that holds the reference still (elastic and weight).
    anti_windup : bool, optional
        Stop integrating what the limits cannot give.
    min_tension, max_tension : float, optional
        Limits of every tension [N]. A negative `min_tension` describes an ideal actuator that can
        push, which no cable does.
    cables : sequence of int, optional
        Indices of the cables that may be used; all by default.
    pretension : (num_cables,) array_like, optional
        Least tension of each cable [N], where that is above `min_tension`.
    max_rate : float, optional
        Largest rate of a command, > 0 [N/s], [m/s].
    filter : float, optional
        Time constant of the derivative [s], which is then that of the measured q; by default the
        measured rate is taken.

    Attributes
    ----------
    reference : (d,) array
        Coordinates to reach and hold; the shape at rest until set.
    path : ReferencePath
        A motion to follow in place of one reference.
    integral : (d,) array
        Accumulated error [rad s].
    diagnostics : dict
        Numbers about the last update.

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

    __slots__ = ()  # a misspelt attribute is an error

    def __init__(
        self,
        model: Model,
        *,
        kp: ArrayLike,
        ki: ArrayLike = 0.0,
        kd: ArrayLike = 0.0,
        period: float = 1e-3,
        feed_forward: bool = True,
        anti_windup: bool = True,
        min_tension: float = 0.0,
        max_tension: float = math.inf,
        cables: Sequence[int] | None = None,
        pretension: ArrayLike | None = None,
        max_rate: float = math.inf,
        filter: float = 0.0,
    ) -> None:
        options = checked(
            {
                "period": period,
                "min_tension": min_tension,
                "max_tension": max_tension,
                "max_rate": max_rate,
                "filter": filter,
            },
            gains={"kp": kp, "ki": ki, "kd": kd},
            switches={"feed_forward": feed_forward, "anti_windup": anti_windup},
            others={"pretension": pretension},
            cables=cables,
        )
        require_kind("model", model, Model)
        super().__init__(model, options)

    def __repr__(self) -> str:
        """Say the gains, where they are numbers."""
        options = self.options
        gains = ", ".join(
            f"{name} {options[name]:g}" if isinstance(options[name], float) else f"{name} array"
            for name in ("kp", "ki", "kd")
        )
        return f"<Pid: {gains}, period {self.period:g} s>"
