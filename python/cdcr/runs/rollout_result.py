"""What a rollout returns: the rows of all its motions, and which failed."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field
from functools import cached_property
from numbers import Integral
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cdcr import _core
from cdcr.base.arrays import FloatArray, ReadOnlyArrays, read_only
from cdcr.base.check import MAX_INT, Check, count, format_value
from cdcr.base.extras import require
from cdcr.model.model import Model
from cdcr.runs.parameters import Variation
from cdcr.runs.stats import STATS, make_stats
from cdcr.runs.trajectory import Trajectory

if TYPE_CHECKING:
    import xarray

    from cdcr._core import Stats, Status


class RolloutFailure(NamedTuple):
    """A motion that did not reach its end.

    Attributes
    ----------
    motion : int
        Its index.
    status : Status
        How it ended.
    message : str
        When it stopped, why, and what to try.
    """

    motion: int
    status: Status
    message: str


@dataclass(frozen=True, eq=False, repr=False)
class Rollout(ReadOnlyArrays):
    """Many motions of a robot, or of robots that differ in numbers. All arrays are read-only.

    ``rollout[i]`` is motion i as a `Trajectory`, with the rows that it reached. Its tensions are
    NaN for cables whose drive has play: rows do not tell where in it the drive stands.

    Parameters
    ----------
    models : tuple of Model
        The robot of all motions, or one for each.
    t : ndarray, shape (R,)
        Times of the rows [s].
    q, qd : ndarray, shape (N, R, d)
        Coordinates and their rates, base to tip; NaN from where a motion failed.
    command : ndarray, shape (N, R, num_cables)
        What was asked of the cables: tensions [N], lengths [m] of those driven by length.
    failures : tuple of RolloutFailure
        The motions that did not reach their end, in order; the others did.
    stats : Stats
        What all of them cost together.
    method : str
        The integration method.
    parameters : dict of str to ndarray, shape (N,)
        Numbers of the robot that differ from motion to motion, by path; in SI units [kg], [m] ..
    """

    models: tuple[Model, ...]
    t: FloatArray
    q: FloatArray
    qd: FloatArray
    command: FloatArray
    failures: tuple[RolloutFailure, ...]
    stats: Stats
    method: str
    parameters: Mapping[str, FloatArray] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Keep others from writing to the arrays."""
        for array in (self.t, self.q, self.qd, self.command):
            read_only(array)

    @property
    def model(self) -> Model:
        """The robot, or the first of them."""
        return self.models[0]

    def model_of(self, motion: int) -> Model:
        """Return the model of one motion.

        Parameters
        ----------
        motion : int
            Its index; negative ones count from the last.

        Returns
        -------
        Model

        Raises
        ------
        TypeError, ValueError
            For what is no whole number.
        IndexError
            Where there is no such motion.
        """
        check = Check()
        wanted = check.whole("motion", motion, "a whole number", low=-MAX_INT, high=MAX_INT)
        check.done()
        try:
            i = range(self.num_motions)[wanted]
        except IndexError:
            there = count(self.num_motions, "motion")
            raise IndexError(f"there is no motion {motion}: there are {there}, from 0") from None
        if self.parameters:
            return Variation(self.model, self.parameters).model_of(i)
        return self.models[i if len(self.models) > 1 else 0]

    @property
    def num_motions(self) -> int:
        """How many motions there are."""
        return len(self.q)

    @property
    def success(self) -> bool:
        """Whether all reached their end."""
        return not self.failures

    @cached_property
    def status(self) -> NDArray[np.object_]:
        """How each motion ended (N,), as `Status`."""
        status = np.full(self.num_motions, _core.Status.ok, dtype=object)
        for failure in self.failures:
            status[failure.motion] = failure.status
        status.setflags(write=False)
        return status

    def __len__(self) -> int:
        """Return the number of motions."""
        return self.num_motions

    def __repr__(self) -> str:
        """Say what a person wants to know first."""
        parts = [count(self.num_motions, "motion"), f"{count(len(self.t), 'row')} each"]
        parts.append(f"t = {self.t[0]:g} to {self.t[-1]:g} s")
        robots = self.num_motions if self.parameters else len(self.models)
        parts += [count(robots, "robot"), self.method]
        failed = f"{len(self.failures)} failed" if self.failures else "all ok"
        return f"<Rollout: {', '.join(parts)}, {failed}>"

    def __iter__(self) -> Iterator[Trajectory]:
        """Go through the motions."""
        return (self[i] for i in range(self.num_motions))

    def __getitem__(self, motion: int) -> Trajectory:
        """Return a motion, by its index, as `Trajectory`; its `stats` are not kept.

        Raises
        ------
        IndexError
            For an index out of range.
        TypeError
            For what is no index, such as a slice.
        ValueError
            For a motion that did not begin.
        """
        if not isinstance(motion, Integral):
            got = format_value(motion)
            raise TypeError(f"a motion is asked for by its index, a whole number, got {got}")
        if not -self.num_motions <= motion < self.num_motions:
            raise IndexError(f"there are {count(self.num_motions, 'motion')}, got index {motion}")
        i = int(motion) % self.num_motions
        model = self.model_of(i)
        reached = int(np.isfinite(self.q[i]).all(axis=1).sum())
        q, qd, command = (rows[i, :reached] for rows in (self.q, self.qd, self.command))
        failed = [failure for failure in self.failures if failure.motion == i]
        run = Trajectory(
            model=model,
            t=self.t[:reached],
            q=q,
            qd=qd,
            tension=model.cable_tensions(q, qd, command) if reached else command,
            status=failed[0].status if failed else _core.Status.ok,
            message=failed[0].message if failed else "",
            stats=make_stats(),
            method=self.method,
            command=command,
        )
        if model.has_backlash:
            loose = [cable.backlash > 0.0 for cable in model.robot.all_cables]
            object.__setattr__(run, "tension", read_only(np.where(loose, np.nan, run.tension)))
        return run

    def to_xarray(self) -> xarray.Dataset:
        """Return the rows as a Dataset with named dimensions and units. Needs the extra ``data``.

        Dimensions and labels are those of `Trajectory.to_xarray`, and before them ``motion``, from
        0. Variables: ``q`` [rad], ``qd`` [rad/s] (motion, time, section, component), where sections
        are more than arcs (motion, time, ``coordinate``); ``command`` (motion, time, cable) [N] or
        [m]; ``status`` (motion), its name; and each of `parameters` (motion), by its path.

        Returns
        -------
        xarray.Dataset
        """
        from cdcr.runs import export

        xr: Any = require("xarray", "data")
        data = {}
        for name, values, what in (
            ("q", self.q, "coordinates"),
            ("qd", self.qd, "rates of the coordinates"),
            ("command", self.command, "what was asked of the cables"),
        ):
            dims, units = export.dims_and_units(self.model, name)
            pairs = (*values.shape[:2], values.shape[2] // 2, 2)  # also where there is no motion
            shaped = values.reshape(pairs) if len(dims) == 2 else values
            about = {"units": units, "long_name": what}
            data[name] = (("motion", "time", *dims), shaped, about)
        for path, numbers in self.parameters.items():
            data[path] = (("motion",), numbers, {"long_name": "number of the robot"})
        names = np.array([one.name for one in self.status], dtype=str)
        data["status"] = (("motion",), names, {"long_name": "how the motion ended"})
        labels = export.coordinates(self.model, self.t)
        used = {"motion"}.union(*(one[0] for one in data.values()))
        coords = {"motion": ("motion", np.arange(self.num_motions), {"long_name": "motion"})} | {
            name: (name, values, {"units": units, "long_name": long_name})
            for name, (values, units, long_name) in labels.items()
            if name in used
        }
        return xr.Dataset(data, coords, self._attributes())  # type: ignore[no-any-return]

    def _attributes(self) -> dict[str, Any]:
        """Where the numbers come from."""
        return {
            "title": "Motions of a cable-driven continuum robot",
            "cdcr_version": _core.__version__,
            "method": self.method,
            "formulation": self.model.formulation,
            "robot": json.dumps(asdict(self.model.robot)),
            "failures": json.dumps(
                [[one.motion, one.status.name, one.message] for one in self.failures]
            ),
            **{name: getattr(self.stats, name) for name in STATS},
        }
