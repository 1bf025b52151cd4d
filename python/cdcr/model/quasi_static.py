"""A robot that follows commands slowly: at rest at each, friction remembering the way."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cdcr import _core
from cdcr.base.arrays import FloatArray, ReadOnlyArrays, read_only
from cdcr.base.check import count, require_kind, require_truth
from cdcr.model.memory import other_drive
from cdcr.model.model import Model
from cdcr.model.statics import ConvergenceError
from cdcr.robot.units import ask_about_commands

if TYPE_CHECKING:
    from cdcr.model.wrench import Wrench


@dataclass(frozen=True, eq=False)
class QuasiStatic(ReadOnlyArrays):
    """What `quasi_static` returns: a row for each sample reached. All arrays are read-only.

    Parameters
    ----------
    model : Model
        The robot.
    command : ndarray, shape (T, num_cables)
        What was asked of the cables: tensions [N], lengths [m] of those driven by length.
    q : ndarray, shape (T, d)
        Where it rests [rad].
    tension, end_tension : ndarray, shape (T, num_cables)
        Of the cables at their drives and at their ends [N].
    friction : ndarray, shape (T, num_cables)
        The difference of these: positive where a cable was last pulled in [N].
    sliding : ndarray of int, shape (T, num_cables)
        What each cable does from the sample before [1]: 1 is pulled in, -1 paid out, 0 sticks.
    deflection : ndarray, shape (T, num_cables)
        Of cables against where they stick [m].
    felt : ndarray, shape (T, num_cables)
        Commands behind the play of the drives [N], [m].
    iterations : int
        Newton steps in all.
    status : Status
        Anything but ``ok`` leaves the samples up to there.
    message : str
        Empty when all went well.

    Examples
    --------
    >>> import cdcr
    >>> run = cdcr.quasi_static(cdcr.Model(cdcr.robots.amouri2020()), [[0, 0, 0], [5, 0, 0]])
    >>> run
    <QuasiStatic: 2 samples, status ok>
    >>> run.q.round(4)[1] + 0.0
    array([0.2614, 0.    ])
    """

    model: Model
    command: FloatArray
    q: FloatArray
    tension: FloatArray
    end_tension: FloatArray
    friction: FloatArray
    sliding: NDArray[np.int32]
    deflection: FloatArray
    felt: FloatArray
    iterations: int
    status: _core.Status
    message: str

    def __post_init__(self) -> None:
        """Let nobody write to the arrays."""
        for name in ("command", "q", "tension", "end_tension", "friction", "deflection", "felt"):
            object.__setattr__(self, name, read_only(getattr(self, name)))
        self.sliding.flags.writeable = False

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.q)

    def __repr__(self) -> str:
        """Say how many samples there are and how it ended."""
        return f"<QuasiStatic: {len(self)} samples, status {self.status.name}>"

    @cached_property
    def tip(self) -> FloatArray:
        """Position of the tip (T, 3) [m]."""
        return read_only(self.model.tips(self.q))


def quasi_static(
    model: Model,
    command: ArrayLike,
    *,
    q0: ArrayLike | None = None,
    wrenches: Sequence[Wrench] | Wrench = (),
    after: QuasiStatic | None = None,
    throw: bool = True,
) -> QuasiStatic:
    """Follow commands so slowly that the robot is at rest at each, with friction that remembers.

    From sample to sample each cable sticks or slides, without time: pulled and let go, the robot
    does not come back the way it went. A cable that sticks gives way by `presliding_stiffness` of
    the robot, or hardly where that is zero. Without friction these are the points
    of rest that `Model.equilibrium` finds. cpp/friction.md eqs. (113) to (115).

    Parameters
    ----------
    model : Model
        The robot.
    command : (T, num_cables) array_like
        Tensions [N], lengths [m] of cables driven by length, followed one after another.
    q0 : (d,) array_like, optional
        Near which it rests at the first command [rad], where friction is new: it has not slid.
    wrenches : Wrench or sequence of Wrench, optional
        Constant loads.
    after : QuasiStatic, optional
        A run to go on from, with what its friction and its drives remember.
    throw : bool, default True
        Whether to raise where a sample has no rest; else `status` and `message` tell.

    Returns
    -------
    QuasiStatic

    Raises
    ------
    ValueError
        For commands out of range, and an `after` of another robot or of no sample.
    ConvergenceError
        Where a sample has no rest.

    Examples
    --------
    >>> import cdcr
    >>> import numpy as np
    >>> section = cdcr.Section(length=0.8, backbone_mass=0.03, backbone_diameter=0.005,
    ...                        youngs_modulus=9.5e9, cable_radius=0.02, cable_angles=[0.0],
    ...                        cable_friction=0.3)
    >>> model = cdcr.Model(cdcr.Robot(sections=[section]))
    >>> run = cdcr.quasi_static(model, [[0.0], [5.0], [10.0], [9.5], [5.0], [0.0]])
    >>> run.sliding[:, 0].tolist()
    [0, 1, 1, 0, -1, -1]
    """
    require_kind("model", model, Model)
    require_truth("throw", throw)
    q, deflection, felt = q0, None, None
    if after is not None:
        require_kind("after", after, QuasiStatic)
        if q0 is not None:
            raise ValueError("give either q0 or after, not both")
        if not len(after):
            raise ValueError("after must have reached a sample to go on from, got a run of none")
        if after.q.shape[1] != model.num_coordinates or after.felt.shape[1] != model.num_cables:
            raise ValueError(
                "after must be a run of this robot, got one of "
                f"{count(after.q.shape[1], 'coordinate')} and {count(after.felt.shape[1], 'cable')}"
            )
        differs = other_drive(model, after.model)
        if differs is not None:
            raise ValueError(f"after must be a run of this robot: {differs}")
        q, deflection, felt = after.q[-1], after.deflection[-1], after.felt[-1]
    found = _core.quasi_static(model, command, q, deflection, felt, wrenches)
    reached = len(found["q"])
    every = np.array(command, dtype=np.float64)
    ask_about_commands(model.robot, every)
    asked = every[:reached]
    run = QuasiStatic(model=model, command=asked, **found)
    if throw and run.status is not _core.Status.ok:
        raise ConvergenceError(run.message)
    return run
