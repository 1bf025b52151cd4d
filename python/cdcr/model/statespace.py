"""Linear systems about a state, whose signals have names, as python-control takes them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.arrays import FloatArray, finite
from cdcr.base.check import format_value, known_name
from cdcr.base.extras import require

if TYPE_CHECKING:
    from cdcr.model.model import Model
    from cdcr.model.wrench import Wrench


class Output(NamedTuple):
    """What a system may give out: names, values, and derivatives with respect to q and qd."""

    names: Callable[[Model], list[str]]
    values: Callable[[Model, FloatArray, FloatArray], FloatArray]
    derivative: Callable[[Model, FloatArray], FloatArray]  # (k, 4n)


def _components(name: str) -> Callable[[Model], list[str]]:
    return lambda model: [
        f"{name}{i + 1}_{axis}" for i in range(model.num_sections) for axis in "xy"
    ]


def _of_shape(derivative: FloatArray) -> FloatArray:
    """Return a derivative (k, 4n) of what does not depend on qd, from that (k, 2n) by q."""
    return np.hstack([derivative, np.zeros_like(derivative)])


_OUTPUTS = {
    "q": Output(
        _components("q"),
        lambda model, q, qd: q,
        lambda model, q: np.eye(len(q), 2 * len(q)),
    ),
    "qd": Output(
        _components("qd"),
        lambda model, q, qd: qd,
        lambda model, q: np.eye(len(q), 2 * len(q), len(q)),
    ),
    "tip": Output(
        lambda model: [f"tip_{axis}" for axis in "xyz"],
        lambda model, q, qd: model.tip(q)[1],
        lambda model, q: _of_shape(model.jacobian(q, model.num_sections - 1, 1.0)[:3]),
    ),
    "lengths": Output(
        lambda model: [f"length{j + 1}" for j in range(model.num_cables)],
        lambda model, q, qd: model.cable_lengths(q),
        lambda model, q: _of_shape(-model.actuation_matrix().T),
    ),
}


def state_names(model: Model) -> list[str]:
    """Return the names of the 4n states: q1_x, q1_y, ..., then qd1_x, qd1_y, ..."""
    return _OUTPUTS["q"].names(model) + _OUTPUTS["qd"].names(model)


def input_names(model: Model) -> list[str]:
    """Return the names of the inputs: tension1, ..., or command1 of a cable driven by length."""
    cables = model.robot.all_cables
    return [
        f"{'command' if cable.length_driven else 'tension'}{j + 1}"
        for j, cable in enumerate(cables)
    ]


def find_outputs(outputs: str | Sequence[str]) -> list[Output]:
    """Return the outputs of these names, or refuse one that is none."""
    names: object = [outputs] if isinstance(outputs, str) else outputs
    if not (isinstance(names, Sequence) and names):
        raise ValueError(f"outputs must be names of outputs, got {format_value(outputs)}")
    found = [known_name("output", name, tuple(_OUTPUTS)) for name in names]
    if len(set(found)) < len(found):
        raise ValueError(f"outputs must differ from each other, got {format_value(outputs)}")
    return [_OUTPUTS[name] for name in found]


class StateSpaceModel(_core.Model):
    """The model of the core, and its linear systems."""

    def to_statespace(
        self,
        q: ArrayLike | None = None,
        tension: ArrayLike | None = None,
        outputs: str | Sequence[str] = ("q", "qd"),
        *,
        qd: ArrayLike | None = None,
        wrenches: Wrench | Sequence[Wrench] = (),
    ) -> Any:
        """Linear system about a state, for python-control. Needs the extra ``control``.

        xd = A x + B u, y = C x from `linearize`, cpp/README.md eq. (19): x, u and y are differences
        from the state, the tensions and the outputs here. About an equilibrium that is the motion
        beside it. Where the robot does not rest or stay under these tensions, the system tells how
        two motions that begin near this state part at first; it leaves out the acceleration that
        both have there, ``forward_dynamics(q, qd, tension)``, and holds only as long as they are
        near it: linearise anew on the way.

        Parameters
        ----------
        q : (2n,) array_like, optional
            The shape [rad]; by default the equilibrium under these tensions and wrenches.
        tension : (num_cables,) array_like, optional
            Cable tensions [N]; lengths [m] for cables driven by length. None: no tension, the
            lengths of the straight robot.
        outputs : str or sequence of str, optional
            Any of "q" [rad], "qd" [rad/s], "tip", the position in the base frame [m], and
            "lengths" of the cables [m]; the whole state by default.
        qd : (2n,) array_like, optional
            Rates [rad/s]; zero by default.
        wrenches : Wrench or sequence of Wrench, optional
            Constant forces and moments on the backbone.

        Returns
        -------
        control.StateSpace
            States ``q1_x``, ``q1_y``, ..., ``qd1_x``, ...; inputs ``tension1``, ..., or
            ``command1`` of a cable driven by length; outputs ``tip_x``, ``length1``, ...

        Raises
        ------
        ValueError
            For unknown outputs, arguments that are no states or commands, and a robot without
            inertia there.
        ImportError
            Where python-control is missing.

        Examples
        --------
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
        >>> system = model.to_statespace(tension=[5.0, 0.0, 0.0], outputs=["tip"])
        >>> system.output_labels
        ['tip_x', 'tip_y', 'tip_z']
        >>> print(f"{abs(system['tip_x', 'tension1'].dcgain()):.4f} m/N")
        0.0206 m/N
        """
        chosen = find_outputs(outputs)
        control: Any = require("control", "control")
        model = cast("Model", self)
        command = model.rest_command() if tension is None else tension
        shape = model.equilibrium(command, wrenches=wrenches) if q is None else finite(q, "q")
        if shape.shape != (model.num_coordinates,):
            raise ValueError(f"q must have shape ({model.num_coordinates},), got {shape.shape}")
        rates = np.zeros(model.num_coordinates) if qd is None else qd
        A, B = model.linearize(shape, rates, command, wrenches)
        C = np.vstack([output.derivative(model, shape) for output in chosen])
        return control.StateSpace(
            *(A, B, C, np.zeros((len(C), model.num_cables))),
            states=state_names(model),
            inputs=input_names(model),
            outputs=[name for output in chosen for name in output.names(model)],
        )
