"""Cables that a section's own fields do not describe."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

from cdcr import _core
from cdcr.base.arrays import FloatArray
from cdcr.base.check import Check
from cdcr.base.keywords import by_keyword
from cdcr.base.quantity import quantity, told

Pairs = tuple[tuple[float, float], ...]


@by_keyword
@dataclass(frozen=True, kw_only=True)
class Cable:
    """One cable, from the base through the holes of all sections up to the end of its last one.

    A cable with a stiffness is driven by length: its command is a length [m], and a spring of that
    stiffness lies between cable and drive, which pulls and never pushes. One without is driven by
    tension: its command is a tension [N]. Ranges are checked by the Robot that the cable is for.

    It runs straight where radius and angle are numbers. Where they are pairs it converges or winds:
    both then change evenly with the arc length from the base of each section passed to its tip.

    Parameters
    ----------
    radius : float or sequence of (float, float)
        Distance from backbone to cable [m], > 0; or one (base, tip) pair for each section passed.
    angle : float or sequence of (float, float)
        Angle about Z, from X [rad]; or one (base, tip) pair for each section passed.
    end_section : int
        Index of the section, from 0, at whose end the cable ends; files count from 1.
    stiffness : float, default 0
        Of the cable and its drive [N/m], >= 0; 0 for a cable driven by tension.
    damping : float, default 0
        Along with a stiffness [N s/m], >= 0.
    friction : float or None, default None
        Coulomb's coefficient in all of its holes, >= 0; None for that of each section.
    start_section : int, default 0
        Index of the section, from 0, at whose base the cable begins; files count from 1.
    entry_friction : float, default 0
        Coulomb friction where the cable enters the robot [N], >= 0.
    sheath_friction : float, default 0
        Coefficient of a sheath before the entry times the angle that it turns by, >= 0.
    viscosity : float, default 0
        Viscous friction at the entry [N s/m], >= 0.
    pretension : float, default 0
        Pull at the length commanded [N], >= 0; of cables driven by length.
    backlash : float, default 0
        Play of the drive [m], >= 0; of cables driven by length.

    Raises
    ------
    ValueError
        With one sentence for each field that is not of its type, one a line.

    Examples
    --------
    >>> import cdcr
    >>> section = cdcr.Section(length=0.2, backbone_mass=0.01, backbone_diameter=0.002,
    ...                        youngs_modulus=60e9, num_disks=5)
    >>> cables = [cdcr.Cable(radius=0.01, angle=0.0, end_section=1, stiffness=5e4)]
    >>> cdcr.Robot(sections=[section, section], cables=cables).num_cables
    1

    A helix of one turn, and a cable that converges to half its distance:

    >>> helix = cdcr.Cable(radius=0.01, angle=[(0.0, 6.283)], end_section=0)
    >>> cone = cdcr.Cable(radius=[(0.01, 0.005)], angle=0.0, end_section=0)
    >>> helix.straight, cone.angle
    (False, 0.0)
    """

    radius: Any = quantity(
        "from backbone to cable",
        "m",
        "a number in m, or one (base, tip) pair for each section passed",
        kind="route",
        each="a number in m",
    )
    angle: Any = quantity(
        "about Z, from X",
        "rad",
        "a number of rad, or one (base, tip) pair for each section passed",
        kind="route",
        each="a number of rad",
    )
    end_section: int = quantity(
        "number of the section where it ends, from 1",
        "",
        "the index of a section, from 0",
        kind="section",
    )
    stiffness: float = quantity("driven by length", "N/m", ">= 0", default=0.0, advanced=True)
    damping: float = quantity("of the drive by length", "N s/m", ">= 0", default=0.0, advanced=True)
    friction: float | None = quantity(
        "coefficient in its holes",
        "",
        "a number >= 0 and finite, or None",
        kind="number or none",
        default=None,
        advanced=True,
    )
    start_section: int = quantity(
        "number of the section at whose base it begins, from 1",
        "",
        "the index of a section, from 0",
        kind="section",
        default=0,
        advanced=True,
    )
    entry_friction: float = quantity("at the entry", "N", ">= 0", default=0.0, advanced=True)
    sheath_friction: float = quantity(
        "mu of a sheath times its turning", "", ">= 0", default=0.0, advanced=True
    )
    viscosity: float = quantity(
        "viscous friction at the entry", "N s/m", ">= 0", default=0.0, advanced=True
    )
    pretension: float = quantity("driven by length", "N", ">= 0", default=0.0, advanced=True)
    backlash: float = quantity(
        "play of the drive by length", "m", ">= 0", default=0.0, advanced=True
    )

    if TYPE_CHECKING:  # to a type checker all fields have a default

        def __init__(
            self,
            *,
            radius: float | Sequence[Sequence[float]] | Sequence[float] | FloatArray,
            angle: float | Sequence[Sequence[float]] | Sequence[float] | FloatArray,
            end_section: int,
            stiffness: float = ...,
            damping: float = ...,
            friction: float | None = ...,
            start_section: int = ...,
            entry_friction: float = ...,
            sheath_friction: float = ...,
            viscosity: float = ...,
            pretension: float = ...,
            backlash: float = ...,
        ) -> None: ...

    def __repr__(self) -> str:
        """Say what one would type, without what is left at its default of what few need."""
        return told(self)

    def __post_init__(self) -> None:
        """Keep every value as a plain float or int, or refuse it."""
        Check().keep(self)

    @property
    def length_driven(self) -> bool:
        """Whether its command is a length [m], not a tension [N]."""
        return self.stiffness > 0.0

    @property
    def straight(self) -> bool:
        """Whether radius and angle are the same all along."""
        return all(
            isinstance(value, float) or len({end for pair in value for end in pair}) <= 1
            for value in (self.radius, self.angle)
        )

    def route(self, section: int) -> tuple[tuple[float, float], tuple[float, float]]:
        """Return radius [m] and angle [rad] at base and tip of a section that it passes.

        Parameters
        ----------
        section : int
            Its index, ``start_section`` to ``end_section``.

        Returns
        -------
        radius, angle : (float, float)
            At the base and at the tip.

        Examples
        --------
        >>> import cdcr
        >>> cdcr.Cable(radius=0.01, angle=[(0.0, 3.0)], end_section=0).route(0)
        ((0.01, 0.01), (0.0, 3.0))
        """
        k = section - self.start_section

        def ends(value: float | Pairs) -> tuple[float, float]:
            return (value, value) if isinstance(value, float) else value[k]

        return ends(self.radius), ends(self.angle)

    @property
    def farthest(self) -> float:
        """Largest distance from the backbone on its way [m]."""
        radius = self.radius
        return radius if isinstance(radius, float) else max(max(pair) for pair in radius)

    def _to_core(self) -> _core.Cable:
        return _core.Cable(**{item.name: getattr(self, item.name) for item in fields(self)})
