"""Cables that a section's own fields do not describe."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

from cdcr import _core
from cdcr.base.check import Check
from cdcr.base.keywords import by_keyword
from cdcr.base.quantity import quantity


@by_keyword
@dataclass(frozen=True, kw_only=True)
class Cable:
    """One cable, from the base through the holes of all sections up to the end of its last one.

    A cable with a stiffness is driven by length: its command is a length [m], and a spring of that
    stiffness lies between cable and drive, which pulls and never pushes. One without is driven by
    tension: its command is a tension [N]. Ranges are checked by the Robot that the cable is for.

    Parameters
    ----------
    radius : float
        Distance from backbone to cable [m], > 0.
    angle : float
        Angle about Z, from X [rad].
    end_section : int
        Index of the section, from 0, at whose end the cable ends; files count from 1.
    stiffness : float, default 0
        Of the cable and its drive [N/m], >= 0; 0 for a cable driven by tension.
    damping : float, default 0
        Along with a stiffness [N s/m], >= 0.
    friction : float or None, default None
        Coulomb's coefficient in all of its holes, >= 0; None for that of each section.

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
    """

    radius: float = quantity("from backbone to cable", "m", "> 0")
    angle: float = quantity("about Z, from X", "rad", "a finite number of rad")
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

    if TYPE_CHECKING:  # to a type checker all fields have a default

        def __init__(
            self,
            *,
            radius: float,
            angle: float,
            end_section: int,
            stiffness: float = ...,
            damping: float = ...,
            friction: float | None = ...,
        ) -> None: ...

    def __post_init__(self) -> None:
        """Keep every value as a plain float or int, or refuse it."""
        Check().keep(self)

    @property
    def length_driven(self) -> bool:
        """Whether its command is a length [m], not a tension [N]."""
        return self.stiffness > 0.0

    def _to_core(self) -> _core.Cable:
        return _core.Cable(**{item.name: getattr(self, item.name) for item in fields(self)})
