"""Robots: sections from base to tip, and what acts on them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from itertools import chain
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cdcr import _core
from cdcr.base.check import Check
from cdcr.base.keywords import by_keyword
from cdcr.base.quantity import quantity
from cdcr.robot.cable import Cable
from cdcr.robot.filed import Filed
from cdcr.robot.parts import Parts, cable_of_parts, part_counts, parts_of
from cdcr.robot.section import Section
from cdcr.robot.shown import Shown
from cdcr.robot.units import ask_about_robot

Vector = tuple[float, float, float]
Matrix = tuple[Vector, Vector, Vector]  # three rows
Row = tuple[float, float, float, float]
Transform = tuple[Row, Row, Row, Row]

SCREEN = 1600  # characters

_ZERO: Vector = (0.0, 0.0, 0.0)


@by_keyword
@dataclass(frozen=True, kw_only=True)
class Robot(Filed, Shown):
    """A cable-driven continuum robot: its sections from base to tip, and what acts on all of them.

    Parameters
    ----------
    sections : sequence of Section
        From base to tip, 1 to 32 of them.
    gravity : sequence of float, default (0, 0, 0)
        Gravity in the base frame [m/s^2]; (0, 0, -9.81) for a robot that stands upright.
    payload : float, default 0
        Mass at the tip [kg], >= 0.
    cables : sequence of Cable, default ()
        Up to 64 cables beside those of the sections, which come first in every command.
    base_orientation : (3, 3) array_like, default identity
        Rotation matrix of the first section in the base frame, in which gravity and all results
        are expressed. The straight robot points along its third column.
    base_position : sequence of float, default (0, 0, 0)
        Where the first section begins, in the base frame [m].
    payload_position : sequence of float, default (0, 0, 0)
        Centre of mass of the payload in the frame of the tip [m].
    payload_inertia : (3, 3) array_like, default zero
        Of the payload about its centre of mass, in the frame of the tip [kg m^2].
    sliding_speed : float, default 1e-3
        Speed at which a cable counts as sliding, for friction [m/s], > 0.
    tool : (4, 4) array_like, default identity
        A frame without mass that the tip carries, in the frame at the end of the last section: its
        rotation matrix, beside it its position [m], and 0, 0, 0, 1 below. It is what
        ``Model.tip``, its Jacobian and ``Model.inverse_kinematics`` speak of.
    presliding_stiffness : float, default 0
        Of a cable that sticks, against where it sticks [N/m], >= 0: friction then remembers, and
        sticks at rest. 0: friction by the sliding speed, without memory.

    Raises
    ------
    ValueError
        With one sentence for each field that is out of its range, one a line.

    Examples
    --------
    >>> import dataclasses
    >>> import cdcr
    >>> section = cdcr.Section(length=0.8, backbone_mass=0.03, backbone_diameter=0.005,
    ...                        youngs_modulus=9.5e9, cable_radius=0.02, cable_angles=[0, 2, 4])
    >>> robot = cdcr.Robot(sections=[section])
    >>> dataclasses.replace(robot, payload=0.1).payload
    0.1
    """

    sections: tuple[Section, ...] = quantity(
        "base to tip", "", "a sequence of 1 to 32 cdcr.Section", kind=Section
    )
    gravity: Vector = quantity(
        "in the base frame",
        "m/s^2",
        "three numbers in m/s^2",
        kind="vector",
        each="a number in m/s^2",
        default=_ZERO,
    )
    payload: float = quantity("mass at the tip", "kg", ">= 0", default=0.0)
    cables: tuple[Cable, ...] = quantity(
        "beside those of the sections",
        "",
        "a sequence of 0 to 64 cdcr.Cable",
        kind=Cable,
        default=(),
        advanced=True,
    )
    base_orientation: Matrix = quantity(
        "rotation of the first section, by rows",
        "",
        "three rows of three numbers",
        kind="matrix",
        default=((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
        advanced=True,
    )
    base_position: Vector = quantity(
        "where the first section begins",
        "m",
        "three numbers in m",
        kind="vector",
        each="a number in m",
        default=_ZERO,
        advanced=True,
    )
    payload_position: Vector = quantity(
        "centre of mass, in the tip frame",
        "m",
        "three numbers in m",
        kind="vector",
        each="a number in m",
        default=_ZERO,
        advanced=True,
    )
    payload_inertia: Matrix = quantity(
        "about its centre of mass",
        "kg m^2",
        "three rows of three numbers in kg m^2",
        kind="matrix",
        default=(_ZERO, _ZERO, _ZERO),
        advanced=True,
    )
    sliding_speed: float = quantity(
        "of a cable, for friction", "m/s", "> 0", default=1e-3, advanced=True
    )
    tool: Transform = quantity(
        "frame of the tool in that of the tip, by rows",
        "",
        "four rows of four numbers",
        kind="transform",
        default=(
            (1.0, 0.0, 0.0, 0.0),
            (0.0, 1.0, 0.0, 0.0),
            (0.0, 0.0, 1.0, 0.0),
            (0.0, 0.0, 0.0, 1.0),
        ),
        advanced=True,
    )
    presliding_stiffness: float = quantity(
        "of a cable that sticks", "N/m", ">= 0", default=0.0, advanced=True
    )

    if TYPE_CHECKING:  # any sequence goes in, a tuple comes out

        def __init__(
            self,
            *,
            sections: Sequence[Section],
            gravity: Sequence[float] | NDArray[np.floating[Any]] = ...,
            payload: float = ...,
            cables: Sequence[Cable] = ...,
            base_orientation: ArrayLike = ...,
            base_position: Sequence[float] | NDArray[np.floating[Any]] = ...,
            payload_position: Sequence[float] | NDArray[np.floating[Any]] = ...,
            payload_inertia: ArrayLike = ...,
            sliding_speed: float = ...,
            tool: ArrayLike = ...,
            presliding_stiffness: float = ...,
        ) -> None: ...

    def __post_init__(self) -> None:
        """Keep every value as a plain float or tuple, or refuse it."""
        check = Check()
        check.keep(self)
        check.done(self._to_core().violations())
        ask_about_robot(self)

    def __repr__(self) -> str:
        """Say what one would type, or what it is where that does not fit on a screen."""
        text = ", ".join(f"{item.name}={getattr(self, item.name)!r}" for item in fields(self))
        if len(text) <= SCREEN:
            return f"Robot({text})"
        return (
            f"<Robot: {len(self.sections)} sections, {self.length:g} m, {self.mass:g} kg, "
            f"{self.num_cables} cables>"
        )

    def _repr_html_(self) -> str:
        from cdcr.robot.notebook import robot_html

        return robot_html(self)

    @property
    def mass(self) -> float:
        """Mass of all sections and the payload [kg]."""
        return sum(section.mass for section in self.sections) + self.payload

    @property
    def length(self) -> float:
        """Arc length of all sections together [m]."""
        return sum(section.length for section in self.sections)

    @property
    def num_cables(self) -> int:
        """Number of all cables, those of sections first."""
        return sum(len(section.cable_angles) for section in self.sections) + len(self.cables)

    @property
    def all_cables(self) -> tuple[Cable, ...]:
        """Every cable in the order of the commands: section by section, then `cables`."""
        return tuple(map(_as_described, self._to_core().all_cables()))

    def locate(self, s: float) -> tuple[int, float]:
        """Return the place at an arc length from the base, as section and fraction.

        What takes a place takes both: ``model.pose(q, *robot.locate(0.3))``.

        Parameters
        ----------
        s : float
            Arc length along the backbone [m], 0 to ``robot.length``.

        Returns
        -------
        section : int
            Index of the section; where two meet, of the one that ends there.
        fraction : float
            Of its length, 0 to 1.

        Raises
        ------
        ValueError
            For what is no number, and no place on the robot.

        Examples
        --------
        >>> import cdcr
        >>> robot = cdcr.robots.amouri2020().subdivide(2)
        >>> robot.locate(0.6015)
        (1, 0.5)
        """
        check = Check()
        arc_length = check.number("s", s, "a number in m")
        check.done()
        return self._to_core().locate(arc_length)

    def subdivide(self, parts: Parts) -> Robot:
        """Return the same robot with every section cut into equal parts.

        Every disk stays where it is, and cables run as they did through all parts of a section,
        which keep its orders and taper on. The more parts, the nearer the robot comes to a beam
        that bends freely. ``cdcr.subdivide_state`` and ``cdcr.merge_state`` take states there and
        back.

        Parameters
        ----------
        parts : int or sequence of int
            Parts of every section, or of each one, base to tip; each 1 to 32, and no more than 32
            of all together.

        Returns
        -------
        Robot

        Raises
        ------
        ValueError
            Where `parts` is not that.

        Examples
        --------
        >>> import cdcr
        >>> robot = cdcr.robots.amouri2020().subdivide(5)
        >>> len(robot.sections), robot.sections[0].num_disks, robot.num_cables
        (5, 2, 3)
        """
        counts = part_counts(len(self.sections), parts)
        cut = [parts_of(*pair) for pair in zip(self.sections, counts, strict=True)]
        cables = [cable_of_parts(cable, counts) for cable in self.cables]
        return replace(self, sections=tuple(chain.from_iterable(cut)), cables=tuple(cables))

    def _to_core(self) -> _core.Robot:
        plain = {item.name: getattr(self, item.name) for item in fields(self)}
        plain["sections"] = [section._to_core() for section in self.sections]
        plain["cables"] = [cable._to_core() for cable in self.cables]
        return _core.Robot(**plain)


def _as_described(cable: _core.Cable) -> Cable:
    given = {item.name: getattr(cable, item.name) for item in fields(Cable)}
    given["radius"] = cable.radii or cable.radius
    given["angle"] = cable.angles or cable.angle
    return Cable(**given)
