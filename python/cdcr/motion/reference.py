"""Reference motions: what the robot is to do, with its rates and accelerations."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.arrays import FloatArray, ReadOnlyArrays, finite, read_only
from cdcr.base.check import count, require_kind
from cdcr.model.model import Model
from cdcr.motion import splines
from cdcr.motion.placed import placed
from cdcr.motion.splines import Motion, Pair, TimeFunction

Angle: TypeAlias = "ArrayLike | TimeFunction"


@dataclass(frozen=True, eq=False, repr=False)
class Reference(ReadOnlyArrays):
    """A smooth motion to follow, sampled: one row for each time. All arrays are read-only.

    Made by `from_samples`, `from_functions` or `from_angles`; missing derivatives come from quintic
    splines (extra ``track``).

    Parameters
    ----------
    t : (N,) array_like
        Times, at least two, strictly increasing [s].
    q, qd, qdd : (N, d) array_like
        Coordinates, base to tip, their rates and accelerations: bending vectors [rad], [rad/s],
        [rad/s^2] of a robot of arcs, see `on` for others.
    derivative_error : tuple of float, optional
        Estimated largest error of qd [rad/s] and qdd [rad/s^2] where they come from splines; zero
        where they were given. The estimate is the change that splines through every other sample
        make, so it errs on the high side.
    motion : callable, optional
        The motion at any times (M,) within those of `t`: an array (3, M, d) of q, qd, qdd. By
        default the quintic through q, qd and qdd at the samples on either side.

    Raises
    ------
    ValueError
        If the shapes do not fit, a value is not finite or the times do not increase.

    Examples
    --------
    >>> import numpy as np
    >>> import cdcr
    >>> t = np.linspace(0.0, 10.0, 51)
    >>> circle = cdcr.Reference.from_angles(t, np.pi / 12, lambda t: np.pi / 5 * t)
    >>> circle
    <Reference: 51 samples, t = 0 to 10 s, 2 coordinates>
    """

    t: FloatArray
    q: FloatArray
    qd: FloatArray
    qdd: FloatArray
    derivative_error: tuple[float, float] = (0.0, 0.0)
    motion: Motion | None = None

    def __post_init__(self) -> None:
        """Take copies nobody else can write to, and check that they fit together."""
        t = splines.checked_times(self.t)
        q = splines.checked_samples("q", self.q, t.size, "d")
        arrays = {"t": t, "q": q}
        for name in ("qd", "qdd"):
            arrays[name] = splines.checked_samples(name, getattr(self, name), t.size, q.shape[1])
        for name, array in arrays.items():
            object.__setattr__(self, name, read_only(array))

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.t)

    def __repr__(self) -> str:
        """Say what a person wants to know first."""
        size = count(self.q.shape[1], "coordinate")
        return f"<Reference: {len(self)} samples, t = {self.t[0]:g} to {self.t[-1]:g} s, {size}>"

    @classmethod
    def from_samples(
        cls, t: ArrayLike, q: ArrayLike, qd: ArrayLike | None = None, qdd: ArrayLike | None = None
    ) -> Reference:
        """Make a reference of samples.

        Parameters
        ----------
        t : (N,) array_like
            Times, strictly increasing [s]; at least 11 where derivatives are missing.
        q : (N, d) array_like
            Coordinates, base to tip; of arcs their bending vectors [rad].
        qd, qdd : (N, d) array_like, optional
            Their rates [rad/s] and accelerations [rad/s^2].

        Returns
        -------
        Reference

        Examples
        --------
        >>> import numpy as np
        >>> import cdcr
        >>> t = np.linspace(0.0, 2.0, 41)
        >>> q = np.column_stack([0.1 * t**2, 0.0 * t])
        >>> cdcr.Reference.from_samples(t, q).qdd[20].round(3) + 0.0
        array([0.2, 0. ])
        """
        times = splines.checked_times(t)
        values = splines.checked_samples("q", q, times.size, "d")
        rates = None if qd is None else splines.checked_samples("qd", qd, *values.shape)
        accelerations = None if qdd is None else splines.checked_samples("qdd", qdd, *values.shape)
        if rates is not None and accelerations is not None:
            return cls(times, values, rates, accelerations)
        pair = splines.of_samples(times, values if rates is None else rates)
        given = [values, rates, accelerations]
        fine, coarse = (splines.filled(given, spline(times)) for spline in pair)
        alone = rates is None and accelerations is None
        motion = pair.fine if alone else None
        return cls(times, fine[0], fine[1], fine[2], splines.change(fine, coarse), motion)

    @classmethod
    def from_functions(
        cls,
        t: ArrayLike,
        q: TimeFunction,
        qd: TimeFunction | None = None,
        qdd: TimeFunction | None = None,
    ) -> Reference:
        """Make a reference of functions of time.

        Parameters
        ----------
        t : (N,) array_like
            Times, strictly increasing [s]. Where derivatives are missing, the functions are called
            at some thousand times between the first and the last.
        q : callable
            ``q(t)`` returns the coordinates (d,).
        qd, qdd : callable, optional
            Their rates [rad/s] and accelerations [rad/s^2].

        Returns
        -------
        Reference

        Examples
        --------
        >>> import numpy as np
        >>> import cdcr
        >>> t = np.linspace(0.0, 2.0, 21)
        >>> swing = cdcr.Reference.from_functions(t, lambda t: np.array([0.3 * np.sin(t), 0.0]))
        >>> swing.qd[0].round(3)
        array([0.3, 0. ])
        """
        times = splines.checked_times(t)
        named = (("q", q), ("qd", qd), ("qdd", qdd))

        if qd is not None and qdd is not None:
            motion = splines.Functions(named, None)
            return cls._of(times, Pair(motion, motion))
        name, base = ("q", q) if qd is None else ("qd", qd)
        pair = splines.of_function(times, name, base)
        return cls._of(times, Pair(*(splines.Functions(named, spline) for spline in pair)))

    @classmethod
    def from_angles(cls, t: ArrayLike, theta: Angle, phi: Angle) -> Reference:
        """Make a reference of bending and orientation angles.

        Parameters
        ----------
        t : (N,) array_like
            Times, strictly increasing [s].
        theta, phi : float, (N,) or (N, n) array_like, or callable
            Angles [rad]: constant; or samples at the times, at least 11 of them; or ``f(t)``
            returning a number or (n,). Where the robot swings through straight let theta change its
            sign, so that phi stays smooth. Full turns that samples of phi jump by are undone.

        Returns
        -------
        Reference

        Examples
        --------
        >>> import numpy as np
        >>> import cdcr
        >>> cdcr.Reference.from_angles(np.linspace(0, 10, 51), np.pi / 12, lambda t: np.pi / 5 * t)
        <Reference: 51 samples, t = 0 to 10 s, 2 coordinates>
        """
        times = splines.checked_times(t)
        bending = splines.of_angle(times, "theta", theta)
        orientation = splines.of_angle(times, "phi", phi)

        return cls._of(times, Pair(*map(splines.Angles, bending, orientation)))

    @classmethod
    def _of(cls, times: FloatArray, pair: Pair) -> Reference:
        """Sample the finer of two motions; their difference tells its error."""
        error = (0.0, 0.0)
        if pair.fine is not pair.coarse:
            between = np.sort(np.concatenate([times, (times[1:] + times[:-1]) / 2.0]))
            error = splines.change(pair.fine(between), pair.coarse(between))
        q, qd, qdd = pair.fine(times)
        return cls(times, q, qd, qdd, error, pair.fine)

    @cached_property
    def _angles(self) -> tuple[FloatArray, FloatArray]:
        return _core.polar_along(self.q)

    @property
    def theta(self) -> FloatArray:
        """Bending angles (N, n) of a robot of arcs [rad]; negative after a swing through straight.

        Of other robots ``model.polar(reference.q, continuous=True)``.
        """
        return self._angles[0]

    @property
    def phi(self) -> FloatArray:
        """Orientation angles (N, n) [rad], continuous along the motion."""
        return self._angles[1]

    def at(self, t: ArrayLike) -> Reference:
        """Return the same motion at other times.

        Parameters
        ----------
        t : (M,) array_like
            Times within its own, at least two [s].

        Returns
        -------
        Reference

        Examples
        --------
        >>> import numpy as np
        >>> import cdcr
        >>> circle = cdcr.Reference.from_angles([0.0, 5.0, 10.0], 0.3, lambda t: np.pi / 5 * t)
        >>> circle.at([2.5, 7.5]).q.round(3) + 0.0
        array([[ 0. ,  0.3],
               [ 0. , -0.3]])
        """
        times = splines.checked_times(t)
        q, qd, qdd = self.evaluate(times)
        return Reference(times, q, qd, qdd, self.derivative_error, self.motion or self._quintic)

    def on(self, model: Model) -> Reference:
        """Return this motion of bending vectors as one of a robot whose sections are more.

        Parameters
        ----------
        model : Model
            The robot, of as many sections; they bend evenly, without twist and stretch.

        Returns
        -------
        Reference
            Of the model's coordinates; the same one for a robot of arcs.

        Raises
        ------
        ValueError
            For another number of sections, or where one is to bend whose bending is locked.

        Examples
        --------
        >>> import dataclasses
        >>> import cdcr
        >>> robot = cdcr.robots.amouri2020()
        >>> rod = dataclasses.replace(robot.sections[0], bending_order=1)
        >>> model = cdcr.Model(dataclasses.replace(robot, sections=[rod]))
        >>> circle = cdcr.Reference.from_angles([0.0, 5.0, 10.0], 0.3, lambda t: 0.6 * t)
        >>> circle.on(model)
        <Reference: 3 samples, t = 0 to 10 s, 4 coordinates>
        """
        require_kind("model", model, Model)
        wanted = 2 * model.num_sections
        if self.q.shape[1] != wanted:
            raise ValueError(
                f"a motion of bending vectors must have {wanted} coordinates for this model, got "
                f"{self.q.shape[1]}"
            )
        motion = None if self.motion is None else placed(self.motion, model)
        q, qd, qdd = map(model.coordinates, (self.q, self.qd, self.qdd))
        return Reference(self.t, q, qd, qdd, self.derivative_error, motion)

    def evaluate(self, t: ArrayLike) -> FloatArray:
        """Return q, qd and qdd at times within those of the reference.

        Parameters
        ----------
        t : float or (M,) array_like
            Times [s].

        Returns
        -------
        (3, d) or (3, M, d) array
            In order [rad], [rad/s], [rad/s^2].

        Raises
        ------
        ValueError
            For a time outside the reference.

        Examples
        --------
        >>> import cdcr
        >>> ramp = cdcr.Reference.from_angles([0.0, 1.0, 2.0], lambda t: 0.1 * t, 0.0)
        >>> ramp.evaluate(1.5).round(3) + 0.0
        array([[0.15, 0.  ],
               [0.1 , 0.  ],
               [0.  , 0.  ]])
        """
        times = finite(t, "t")
        if times.ndim > 1:
            raise ValueError(f"t must be a number or have shape (M,), got {times.shape}")
        first, last = self.t[0], self.t[-1]
        slack = 1e-12 * max(abs(first), abs(last))  # of an integrator's last stage
        outside = (times < first - slack) | (times > last + slack)
        if np.any(outside):
            raise ValueError(
                f"t must lie within the reference, {first:g} to {last:g} s, got "
                f"{np.atleast_1d(times[outside])[0]:g} s"
            )
        inside = np.clip(np.atleast_1d(times), first, last)
        found = (self.motion or self._quintic)(inside)
        return found[:, 0] if times.ndim == 0 else found

    @cached_property
    def _quintic(self) -> Motion:
        """Motion between the samples where none was given."""
        return splines.quintic(self.t, self.q, self.qd, self.qdd)
