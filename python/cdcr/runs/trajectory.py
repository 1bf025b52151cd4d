"""What a run returns: its samples, how it ended, and what people do with them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr.base.arrays import FloatArray, ReadOnlyArrays, finite, read_only
from cdcr.base.check import count, require_kind
from cdcr.model.model import Model
from cdcr.runs.events import EventRecord, SlackEvent
from cdcr.runs.pictures import Pictures

if TYPE_CHECKING:
    from os import PathLike
    from pathlib import Path

    import pandas  # type: ignore[import-untyped]
    import xarray

    from cdcr._core import Stats, Status
    from cdcr.runs.export import Quantity


@dataclass(frozen=True, eq=False, repr=False)
class Trajectory(Pictures, ReadOnlyArrays):
    """A run, sampled: one row for each output time reached. All arrays are read-only.

    Parameters
    ----------
    model : Model
        The robot that ran.
    t : ndarray, shape (N,)
        Output times [s].
    q, qd : ndarray, shape (N, d)
        Coordinates and their rates, base to tip: bending and twist in rad, stretch in m.
    tension : ndarray, shape (N, num_cables)
        Cable tensions at the base [N]; at a jump, the value after it.
    status : Status
        How the run ended; anything but ``ok`` leaves the samples up to there.
    message : str
        Empty when all went well; else when the run stopped, why, and what to try.
    stats : Stats
        What the run cost.
    method : str
        The integration method, where known.
    command : ndarray, shape (N, num_cables), optional
        What was asked of the cables: tensions [N], lengths [m] of those driven by length.
    slack_events : tuple of SlackEvent
        When length-driven cables turned slack or taut.
    events : tuple of EventRecord
        The events of `simulate`, in the order of time.
    deflection : ndarray, shape (N, num_cables), optional
        Of cables whose friction remembers, against where they stick [m].
    channels : mapping of str to sequence of Quantity, optional
        What else files of the run tell over time, by topic; `cdcr.Loop.run` gives it.
    sensitivities, rate_sensitivities : mapping of str to (N, d, k) array
        Derivatives of q [rad] and of qd [rad/s] by what `simulate` was asked for: by the name
        given, with k = d columns for "q0" and "qd0", num_cables for "tension", one for a number of
        the robot, in SI units. netCDF files keep them, CSV files do not.
    """

    model: Model
    t: FloatArray
    q: FloatArray
    qd: FloatArray
    tension: FloatArray
    status: Status
    message: str
    stats: Stats
    method: str = ""
    command: FloatArray = None  # type: ignore[assignment]  # the tensions
    slack_events: tuple[SlackEvent, ...] = ()
    events: tuple[EventRecord, ...] = ()
    deflection: FloatArray | None = None
    channels: Mapping[str, Sequence[Quantity]] = field(default_factory=dict)
    sensitivities: Mapping[str, FloatArray] = field(default_factory=dict)
    rate_sensitivities: Mapping[str, FloatArray] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Take copies nobody else can write to, and check that they fit together."""
        require_kind("model", self.model, Model)
        if self.command is None:
            object.__setattr__(self, "command", self.tension)
        rows = np.size(finite(self.t, "t"))
        states, pulls = (rows, self.model.num_coordinates), (rows, self.model.num_cables)
        shapes = {"t": (rows,), "q": states, "qd": states, "tension": pulls, "command": pulls}
        for name, shape in shapes.items():
            array = np.array(finite(getattr(self, name), name))
            if array.shape != shape:
                raise ValueError(f"{name} must have shape {shape}, got {array.shape}")
            object.__setattr__(self, name, read_only(array))
        if self.deflection is not None:
            array = np.array(finite(self.deflection, "deflection"))
            if array.shape != pulls:
                raise ValueError(f"deflection must have shape {pulls}, got {array.shape}")
            object.__setattr__(self, "deflection", read_only(array))
        if rows == 0:
            raise ValueError(f"a run must have at least one sample, got none. {self.message}")

    @classmethod
    def _of_core(cls, **given: Any) -> Trajectory:
        """Return a run of the core's arrays, which fit together and nobody can write to."""
        if len(given["t"]) == 0:
            return cls(**given)  # refuses it
        run = cls.__new__(cls)
        run.__dict__.update(given, channels={})
        return run

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.t)

    def __repr__(self) -> str:
        """Say what a person wants to know first."""
        parts = [
            count(len(self), "sample"),
            f"t = {self.t[0]:g} to {self.t[-1]:g} s",
            count(self.model.num_sections, "section"),
            count(self.model.num_cables, "cable"),
        ]
        parts += [self.method] if self.method else []
        end = f": {self.message}" if self.message else ""
        return f"<Trajectory: {', '.join(parts)}, status {self.status.name}{end}>"

    @property
    def success(self) -> bool:
        """Whether it reached its last output time, or an event that ends it."""
        return self.status.name in ("ok", "event")

    @cached_property  # it writes to __dict__, which a frozen dataclass leaves open
    def _polar(self) -> tuple[FloatArray, FloatArray]:
        theta, phi = self.model.polar(self.q, continuous=True)
        return read_only(theta), read_only(phi)

    @property
    def theta(self) -> FloatArray:
        """Bending angles (N, n) [rad]; negative after a swing through straight.

        Of the first bending vector of each section; zero where its bending is locked.
        """
        return self._polar[0]

    @property
    def phi(self) -> FloatArray:
        """Orientation angles (N, n) [rad], continuous along the run; of the same vectors."""
        return self._polar[1]

    @cached_property
    def tip(self) -> FloatArray:
        """Tip positions (N, 3) in the base frame [m]."""
        return read_only(self.model.tips(self.q))

    @cached_property
    def kinetic_energy(self) -> FloatArray:
        """Kinetic energy (N,) [J]."""
        return read_only(self.model.kinetic_energy(self.q, self.qd))

    @cached_property
    def potential_energy(self) -> FloatArray:
        """Elastic energy plus weight (N,) [J]; the weight's is zero at the base."""
        return read_only(self.model.potential_energy(self.q))

    @cached_property
    def energy(self) -> FloatArray:
        """Total mechanical energy (N,) [J]."""
        return read_only(self.kinetic_energy + self.potential_energy)

    @cached_property
    def cable_energy(self) -> FloatArray:
        """Energy in the springs of cables driven by length (N,) [J]; not part of `energy`."""
        return read_only(self.model.cable_energy(self.q, self.command))

    @cached_property
    def friction_power(self) -> FloatArray:
        """Heat that friction of the cables makes (N,) [W], never negative."""
        if not self.model.num_deflections:
            return read_only(self.model.friction_power(self.q, self.qd, self.command))
        if self.deflection is None:
            raise ValueError(
                "this run does not hold what its friction remembered: simulate it again"
            )
        return read_only(self.model.friction_power(self.q, self.qd, self.command, self.deflection))

    @property
    def energy_error(self) -> FloatArray:
        """Relative change of the total energy since the start (N,) [1].

        (E - E[0]) / max(abs(E[0]), largest kinetic energy of the run); zero for a robot at rest
        with E[0] = 0. An error only where nothing feeds or drains the robot: no damping, no
        tension.
        """
        scale = max(abs(self.energy[0]), np.max(self.kinetic_energy))
        return read_only((self.energy - self.energy[0]) / (scale or 1.0))

    @property
    def energy_drift(self) -> float:
        """Largest magnitude of ``energy_error`` [1]."""
        return float(np.max(np.abs(self.energy_error)))

    def to_xarray(self) -> xarray.Dataset:
        """Return the run as a Dataset with named dimensions and units. Needs the extra ``data``.

        Dimensions, each with its labels: ``time`` [s], ``section`` (1, 2, ... from the base),
        ``component`` of a bending vector ("x", "y"), ``cable`` (1, 2, ... section by section) and
        ``axis`` of the base frame ("x", "y", "z"). Variables: ``q`` [rad] and ``qd`` [rad/s]
        (time, section, component), where sections are more than arcs (time, ``coordinate``), which
        ``model.coordinate_names`` labels; ``theta`` and ``phi`` (time, section) [rad], ``tension``
        (time, cable) [N], ``tip`` (time, axis) [m], ``kinetic_energy``, ``potential_energy`` and
        ``energy`` (time) [J]; where cables are driven by length also ``command`` (time, cable), [N]
        or [m], and ``cable_energy`` (time) [J]; of sensitivities ``dq_dNAME`` and ``dqd_dNAME``
        (time, ``of_coordinate``), with ``by_coordinate`` or ``cable`` where NAME is many. Each has
        attributes ``units`` and ``long_name``; those of the Dataset tell robot, formulation,
        method, how the run ended and what it cost.

        Returns
        -------
        xarray.Dataset
        """
        from cdcr.runs import export

        return export.to_xarray(self)

    def to_dataframe(self) -> pandas.DataFrame:
        """Return the run as a table with a row for each time, which is the index [s].

        The columns are those of the CSV file that `save` writes, such as ``q1_x [rad]``. Needs
        pandas, which comes with the extra ``data``.
        """
        from cdcr.runs import export

        return export.to_dataframe(self)

    def save(self, path: str | PathLike[str], *, overwrite: bool = False) -> Path:
        """Write the run to netCDF (``.nc``), CSV (``.csv``) or an MCAP log (``.mcap``).

        In SI units, every bit of every number; netCDF needs the extra ``data``, MCAP the extra
        ``mcap``. The file appears only when it is complete. An MCAP log, which Foxglove opens, has
        JSON messages with schemas: numbers on ``/state``, ``/tension``, ``/energy``, named as the
        columns of a CSV file, ``/tip_pose`` (foxglove.PoseInFrame), ``/tf``, the ends of all
        sections (foxglove.FrameTransforms), and ``/backbone`` for a 3D panel
        (foxglove.SceneUpdate). `load` reads the other two. A run of a closed loop also tells what
        the controller asked for, was told and follows, what was measured and estimated, and how
        long it took: in an MCAP log on ``/tension``, ``/estimate``, ``/reference``, ``/sensors``
        and ``/timing``.

        Parameters
        ----------
        path : path-like
            The file, ending in ``.nc``, ``.csv`` or ``.mcap``, in a folder that exists.
        overwrite : bool
            Whether an existing file may be replaced.

        Returns
        -------
        Path
            The file written.

        Raises
        ------
        ValueError
            For another suffix, or times below 0 s in an MCAP log, which has none.
        FileExistsError
            If the file exists and ``overwrite`` is false.
        FileNotFoundError
            If the folder is missing.
        """
        from cdcr.runs import save

        return save.save(self, path, overwrite=overwrite)

    @classmethod
    def load(cls, path: str | PathLike[str], *, model: Model | None = None) -> Trajectory:
        """Read a run from a file, as `save` writes it.

        Parameters
        ----------
        path : path-like
            The file, ending in ``.nc`` (extra ``data``) or ``.csv``.
        model : Model, optional
            The model that ran. A netCDF file has its own; a CSV file has none, nor how the run
            ended, its method, cost and slack events: ``run.message`` says so.

        Returns
        -------
        Trajectory

        Raises
        ------
        ValueError
            For another suffix, a CSV file without `model`, or a file that is no run of it.
        FileNotFoundError
            If there is no such file.
        """
        from cdcr.runs.load import load

        fields = load(path, model)
        events = tuple(SlackEvent(*event) for event in fields.pop("slack_events"))
        return cls(**fields, slack_events=events)
