"""The equations of motion as a nonlinear system of python-control."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.check import Check, require_kind
from cdcr.base.extras import require
from cdcr.model.memory import warn_of_memory
from cdcr.model.model import Model
from cdcr.model.signals import find_outputs, input_names, state_names
from cdcr.model.wrench import Wrench


def nonlinear_system(
    model: Model,
    outputs: str | Sequence[str] = ("q", "qd"),
    *,
    wrenches: Wrench | Sequence[Wrench] = (),
    min_tension: float = 0.0,
    max_tension: float = math.inf,
) -> Any:
    """Equations of motion as a system of python-control. Needs the extra ``control``.

    Its signals have the names of `Model.to_statespace`, its values are whole, not differences:
    the state is (q, qd), the inputs are commands. Python is called at every evaluation, which makes
    simulations slow; those of `simulate` are not.

    Parameters
    ----------
    model : Model
        The robot.
    outputs : str or sequence of str, optional
        Any of "q" [rad], "qd" [rad/s], "tip", the position in the base frame [m], and "lengths" of
        the cables [m]; the whole state by default.
    wrenches : Wrench or sequence of Wrench, optional
        Constant forces and moments on the backbone.
    min_tension, max_tension : float, optional
        Limits [N], 0 <= min_tension <= max_tension. Inputs that are tensions are brought within
        them, as drives do it, so that a linear controller may ask for more, or for a push.

    Returns
    -------
    control.NonlinearIOSystem
        In continuous time.

    Raises
    ------
    ValueError
        For unknown outputs, limits out of order and a robot without inertia; in a simulation, for
        a state that is none.
    ImportError
        Where python-control is missing.

    Warns
    -----
    UserWarning
        Where cables or drives remember, of which it knows nothing.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
    >>> system = cdcr.control.nonlinear_system(model, outputs="tip")
    >>> system.input_labels, system.output_labels
    (['tension1', 'tension2', 'tension3'], ['tip_x', 'tip_y', 'tip_z'])
    """
    require_kind("model", model, Model)
    chosen = find_outputs(outputs)
    low, high = _limits(min_tension, max_tension)
    rest = np.zeros(model.num_coordinates)
    model.linearize(rest, rest, model.rest_command())  # refuses a robot without inertia
    control: Any = require("control", "control")
    warn_of_memory(model, "a system of python-control", stacklevel=2)
    by_tension = np.array([not cable.length_driven for cable in model.robot.all_cables], dtype=bool)
    split = model.num_coordinates

    def update(t: float, x: FloatArray, u: FloatArray, params: object) -> FloatArray:
        command = np.where(by_tension, np.clip(u, low, high), u)
        qdd = model.forward_dynamics(x[:split], x[split:], command, wrenches)
        return np.concatenate([x[split:], qdd])

    def output(t: float, x: FloatArray, u: FloatArray, params: object) -> FloatArray:
        return np.concatenate([one.values(model, x[:split], x[split:]) for one in chosen])

    return control.nlsys(
        update,
        output,
        states=state_names(model),
        inputs=input_names(model),
        outputs=[name for one in chosen for name in one.names(model)],
    )


def _limits(min_tension: object, max_tension: object) -> tuple[float, float]:
    check = Check()
    low = check.number("min_tension", min_tension, "a number >= 0 N")
    high = check.number("max_tension", max_tension, "a number >= min_tension")
    check.done()
    if not 0.0 <= low <= high:
        raise ValueError(
            f"limits must be 0 <= min_tension <= max_tension, got {low:g} N and {high:g} N"
        )
    return low, high
