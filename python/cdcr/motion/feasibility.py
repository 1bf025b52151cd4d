"""Whether a robot can follow a path, told before a run: workspace, tensions, rates."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cdcr import _core
from cdcr.base.arrays import FloatArray
from cdcr.base.check import Check, require_kind, require_truth
from cdcr.base.rotations import rotation_of
from cdcr.model.memory import warn_of_friction
from cdcr.model.model import Model


@dataclass(frozen=True, eq=False, repr=False)
class PathReport:
    """What following a path takes.

    Parameters
    ----------
    sentences : tuple of str
        What the robot cannot do, each with the first time at which it cannot; empty: nothing.
    t : (N,) array
        Times looked at [s].
    q : (N, d) array
        Coordinates along the path; of a path of the tip those found by inverse kinematics.
    tension : (N, num_cables) array
        Least-norm tensions within the limits [N].
    rate : float
        Largest rate of a tension [N/s].

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> path = cdcr.ReferencePath.spline([0.0, 1.0], [[0.0, 0.0], [0.5, 0.0]])
    >>> cdcr.check_path(model, path, max_tension=5.0)
    <PathReport: tensions of at most 5 N cannot give the motion from t = 0.52 s on>
    """

    sentences: tuple[str, ...]
    t: FloatArray
    q: FloatArray
    tension: FloatArray
    rate: float

    @property
    def feasible(self) -> bool:
        """Whether the robot can follow the path."""
        return not self.sentences

    def __repr__(self) -> str:
        """Say what it cannot, or what it takes."""
        if self.sentences:
            return f"<PathReport: {'; '.join(self.sentences)}>"
        most = float(np.max(self.tension, initial=0.0))
        return f"<PathReport: feasible, up to {most:.4g} N and {self.rate:.4g} N/s>"


def check_path(
    model: Model,
    path: _core.ReferencePath,
    *,
    min_tension: float = 0.0,
    max_tension: float = math.inf,
    max_rate: float = math.inf,
    num_samples: int = 201,
    orientation: bool = False,
) -> PathReport:
    """Tell before a run whether a robot can follow a path, and what that takes.

    Inverse dynamics along the path, at samples of it: what happens between them is not looked at.

    Parameters
    ----------
    model : Model
        The robot.
    path : ReferencePath
        Of its coordinates (d) or, where it has three values and the robot has not, of its tip.
    min_tension, max_tension : float, optional
        Limits of every tension [N].
    max_rate : float, optional
        Largest rate of a tension [N/s].
    num_samples : int, optional
        How many times are looked at.
    orientation : bool, optional
        Whether it is of the tip's pose: six values, the position and a rotation vector.

    Returns
    -------
    PathReport

    Raises
    ------
    ValueError
        For a path of another size, or an argument out of its range.

    Warns
    -----
    UserWarning
        When cables rub, whose friction is left out.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> circle = cdcr.ReferencePath.circle([0, 0], [0.26, 0], [0, 0.26], 1.0, 10.0)
    >>> cdcr.check_path(model, circle)
    <PathReport: feasible, up to 5.718 N and 6.264 N/s>
    """
    require_kind("model", model, Model)
    require_kind("path", path, _core.ReferencePath)
    check = Check()
    low = check.number("min_tension", min_tension, "a number")
    high = check.number("max_tension", max_tension, "a number")
    fastest = check.number("max_rate", max_rate, "a number > 0 N/s")
    samples = check.whole("num_samples", num_samples, "a whole number 5 to 1000000", 5, 1000000)
    if not fastest > 0.0 and not check.sentences:
        check.refuse("max_rate", "a number > 0 N/s", max_rate)
    check.done()
    require_truth("orientation", orientation)
    size = model.num_coordinates
    if path.size not in ((6,) if orientation else (size, 3)):
        wanted = "6 values of the tip's pose" if orientation else f"{size} values, or 3 of the tip"
        raise ValueError(f"path must have {wanted}, got {path.size}")
    warn_of_friction(model, "check_path", stacklevel=2)
    t = np.linspace(path.start, max(path.end, path.start + 1.0), samples)
    values = np.array([path.evaluate(time) for time in t])
    told: list[str] = []
    if path.size == size and not orientation:
        q, qd, qdd = values.transpose(1, 0, 2)
    else:
        q, told = _of_tip(model, t, values[:, 0])
        qd, qdd = _differences(t, q)
    bent = model.polar(q)[0].max(axis=1) > _core.max_bending
    told += _first(t, bent, "a section would bend by more than 3 pi")
    q = np.where(bent[:, np.newaxis], 0.0, q)
    tension = np.zeros((samples, model.num_cables))
    missed = np.zeros(samples, dtype=bool)
    for i in range(samples):
        where = None if model.has_constant_actuation else q[i]
        force = model.inverse_dynamics(q[i], qd[i], qdd[i])
        found = model.find_tension(force, low, high, q=where)
        tension[i], missed[i] = found.tension, not found.feasible
    limits = f"at most {high:g} N" if low == 0.0 else f"{low:g} to {high:g} N"
    told += _first(t, missed & ~bent, f"tensions of {limits} cannot give the motion")
    rates = np.abs(np.diff(tension, axis=0)).max(axis=1, initial=0.0) / np.diff(t)
    told += _first(t, rates > fastest, f"tensions would change by more than {fastest:g} N/s")
    return PathReport(tuple(told), t, q, tension, float(rates.max()))


def _first(t: FloatArray, wrong: FloatArray, sentence: str) -> list[str]:
    at = np.flatnonzero(wrong)
    return [f"{sentence} from t = {t[at[0]]:.4g} s on"] if at.size else []


def _of_tip(model: Model, t: FloatArray, places: FloatArray) -> tuple[FloatArray, list[str]]:
    """Return coordinates for places of the tip, or its poses, and the first out of reach."""
    q = np.zeros((t.size, model.num_coordinates))
    for i, place in enumerate(places):
        turned = rotation_of(place[3:]) if place.size == 6 else None
        found = model.inverse_kinematics(place[:3], turned, q0=q[i - 1] if i else None)
        q[i] = found.q
        if not found.reachable:
            q[i:] = found.q
            return q, [f"the tip cannot reach the path at t = {t[i]:.4g} s: {found.message}"]
    return q, []


def _differences(t: FloatArray, q: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return rates and accelerations of samples."""
    qd = np.gradient(q, t, axis=0, edge_order=2)
    return qd, np.gradient(qd, t, axis=0, edge_order=2)
