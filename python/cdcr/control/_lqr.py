"""The linear quadratic regulator about a state of rest."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cdcr.base.arrays import FloatArray, finite
from cdcr.base.check import Check, require_kind
from cdcr.base.extras import require
from cdcr.model.model import Model

SYMMETRY = 1e-9  # largest difference across the diagonal, over the largest entry
DEFINITE = 1e-12  # smallest eigenvalue of a definite matrix, over the largest
REST = 1e-3  # how far from rest is still rest [rad, m]
DECAY = 1e-9  # smallest damping ratio that is none of rounding
NO_GAIN = (
    "no gain makes all motions decay: a motion without damping is reached by no cable, or Q does "
    "not see it; add damping, cables or weight"
)


def lqr(
    model: Model,
    q: ArrayLike,
    tension: ArrayLike,
    Q: ArrayLike,
    R: ArrayLike,
    period: float | None = None,
) -> FloatArray:
    """Gain of the linear quadratic regulator about a state of rest. Needs SciPy, extra ``control``.

    The command ``tension - K @ (x - x0)``, x = (q, qd), x0 = (q, 0), makes the integral of
    x' Q x + u' R u least, of the linear system of `Model.to_statespace` where x and u are
    differences. With a period the command is held in between, and the same integral is least.

    The gain knows no limits, and cables only pull: keep what it asks for at 0 N and above. About
    tensions of 0 N half of it is lost, so choose `tension` with a pull that all cables of a section
    share; that changes no shape where they are evenly spaced. A cable driven by length that hangs
    slack there has no effect, and a row of zeros. Where the robot does not rest at `q` under
    `tension`, it comes to rest beside it; a warning says how far its rest is from there.

    Parameters
    ----------
    model : Model
        The robot.
    q : (d,) array_like
        The shape to hold [rad].
    tension : (num_cables,) array_like
        Cable tensions there [N]; lengths [m] of cables driven by length.
    Q : float, (2d,) or (2d, 2d) array_like
        Weight of the state (q, qd), in units of the cost over [rad^2] and [rad^2/s^2]: one number,
        a diagonal, or a symmetric matrix; no eigenvalue may be negative.
    R : float, (num_cables,) or (num_cables, num_cables) array_like
        Weight of the commands, over [N^2] or [m^2], likewise; every eigenvalue must be > 0.
    period : float, optional
        Sampling period [s], > 0; None for continuous time.

    Returns
    -------
    (num_cables, 2d) array
        The gain K [N/rad], [N s/rad]; [m/rad], [m s/rad] for cables driven by length.

    Raises
    ------
    ValueError
        For weights of a wrong shape, unsymmetric or not definite, a period that is none, a robot
        without cables or inertia, and where no gain makes all motions decay: a motion without
        damping that no cable reaches or no weight sees; or where a long period, or weights far
        apart in size, leave no digits.
    ImportError
        Where SciPy is missing.

    Examples
    --------
    >>> import cdcr
    >>> import numpy as np
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> tension = [3.0, 1.0, 1.0]
    >>> q = model.equilibrium(tension)
    >>> K = cdcr.control.lqr(model, q, tension, Q=1.0, R=0.01)
    >>> A, B = model.linearize(q, [0.0, 0.0], tension)
    >>> bool(np.all(np.linalg.eigvals(A - B @ K).real < 0.0))
    True
    """
    require_kind("model", model, Model)
    if model.num_cables == 0:
        raise ValueError("a regulator needs cables, and this robot has none")
    states, inputs = 2 * model.num_coordinates, model.num_cables
    weight = np.zeros((states + inputs, states + inputs))  # of state and command together
    weight[:states, :states] = _weight("Q", Q, states, definite=False)
    weight[states:, states:] = _weight("R", R, inputs, definite=True)
    shape = finite(q, "q")
    if shape.shape != (model.num_coordinates,):
        raise ValueError(f"q must have shape ({model.num_coordinates},), got {shape.shape}")
    A, B = model.linearize(shape, np.zeros(model.num_coordinates), tension)
    linalg: Any = require("scipy.linalg", "control")
    if period is not None:
        period = _checked_period(period)
    try:
        with np.errstate(all="ignore"):  # what comes of it is looked at
            K = _gain(linalg, A, B, weight, period)
    except ValueError:  # of SciPy, LinAlgError too
        K = None
    if K is None:
        raise ValueError(_no_gain(A, period))
    _warn_without_rest(model, shape, tension, A)
    return np.asarray(K, dtype=np.float64)


def _warn_without_rest(model: Model, q: FloatArray, tension: ArrayLike, A: FloatArray) -> None:
    """Warn where the robot would not stay at q, and say how far off its rest is."""
    d = model.num_coordinates
    qdd = model.forward_dynamics(q, np.zeros(d), tension)
    off = np.abs(np.linalg.lstsq(A[d:, :d], qdd, rcond=None)[0])
    k = int(np.argmax(off))
    if off[k] > REST:
        warnings.warn(
            f"the robot does not rest at q under tension, so the regulator will not hold it there: "
            f"q[{k}] is some {off[k]:.2g} from its rest, model.equilibrium(tension)",
            UserWarning,
            stacklevel=3,
        )


def _gain(
    linalg: Any, A: FloatArray, B: FloatArray, weight: FloatArray, period: float | None
) -> FloatArray | None:
    """Return the gain, or None where it leaves a motion that does not decay."""
    states = len(A)
    if period is not None:
        A, B, weight = _sampled(linalg, A, B, weight, period)
    Q, S, R = weight[:states, :states], weight[:states, states:], weight[states:, states:]
    if period is None:
        P = linalg.solve_continuous_are(A, B, Q, R, s=S)
        K = np.linalg.solve(R, B.T @ P)
    else:
        P = linalg.solve_discrete_are(A, B, Q, R, s=S)
        K = np.linalg.solve(R + B.T @ P @ B, B.T @ P @ A + S.T)
    poles = np.linalg.eigvals(A - B @ K).astype(np.complex128)
    if period is not None:
        poles = np.log(poles[poles != 0.0])
    return np.asarray(K) if _decay(poles) else None


def _decay(poles: NDArray[np.complex128]) -> bool:
    return bool(np.all(poles.real < -DECAY * np.abs(poles)))


def _no_gain(A: FloatArray, period: float | None) -> str:
    """Say why there is no gain: motions that nothing ends, or numbers too far apart."""
    poles = np.linalg.eigvals(A).astype(np.complex128)
    if not _decay(poles):
        return NO_GAIN
    told = "no gain can be computed, although all motions decay by themselves: "
    if period is None:
        return f"{told}Q and R must be nearer to each other in size"
    decay = 1.0 / np.max(-poles.real)
    return (
        f"{told}period must be shorter beside the {decay:.3g} s in which the fastest of them "
        f"decays, got {period:g} s, or Q and R nearer to each other in size"
    )


def _sampled(
    linalg: Any, A: FloatArray, B: FloatArray, weight: FloatArray, period: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return A, B from one sample to the next, and the cost in between, by one exponential.

    C. F. Van Loan, Computing integrals involving the matrix exponential, 1978, doi
    10.1109/TAC.1978.1101743.
    """
    states, size = len(A), len(weight)
    motion = np.zeros((size, size))  # of state and held command together
    motion[:states] = np.hstack([A, B])
    both = np.block([[-motion.T, weight], [np.zeros_like(motion), motion]])
    grown = linalg.expm(both * period)
    step = grown[size:, size:]
    cost = step.T @ grown[:size, size:]
    return step[:states, :states], step[:states, states:], (cost + cost.T) / 2.0


def _weight(name: str, value: ArrayLike, size: int, *, definite: bool) -> FloatArray:
    """Return a weight as a symmetric matrix, or refuse it."""
    given = finite(value, name)
    if given.shape not in ((), (size,), (size, size)):
        raise ValueError(
            f"{name} must be a number or have shape ({size},) or ({size}, {size}), "
            f"got {given.shape}"
        )
    matrix = given if given.ndim == 2 else np.diag(np.broadcast_to(given, size))
    largest = np.max(np.abs(matrix))
    if np.max(np.abs(matrix - matrix.T)) > SYMMETRY * largest:
        raise ValueError(f"{name} must be symmetric, and differs from its transpose")
    matrix = matrix / 2.0 + matrix.T / 2.0
    least = np.min(np.linalg.eigvalsh(matrix))
    if definite and least <= DEFINITE * largest:
        raise ValueError(f"{name} must be positive definite, its least eigenvalue is {least:.3g}")
    if least < -DEFINITE * largest:
        raise ValueError(
            f"{name} must be positive semidefinite, its least eigenvalue is {least:.3g}"
        )
    return np.asarray(matrix)


def _checked_period(period: float) -> float:
    check = Check()
    found = check.number("period", period, "a number > 0 s and finite, or None", above=0.0)
    check.done()
    return found
