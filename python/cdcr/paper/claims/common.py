"""What one row of the audit is, and the robot and the model that all rows are about."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from functools import lru_cache
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from cdcr._core import taylor_range
from cdcr.base.keywords import by_keyword
from cdcr.model.model import Model
from cdcr.robots import amouri2020

Verdict = Literal["holds", "holds in part", "does not hold", "cannot be checked"]
VERDICTS: tuple[Verdict, ...] = ("holds", "holds in part", "does not hold", "cannot be checked")

ROBOT = amouri2020()  # Table 1, without gravity and damping
SECTION = ROBOT.sections[0]
EDGE = taylor_range  # the paper's range of bending angles, 3 pi/5 [rad]
GRAVITY = 9.81  # [m/s^2]
PULL = 5.0  # the tension on cable 1 of Fig. 9 [N]
PRINTED_ANGLE = 15.53  # where Fig. 9 settles, by the text [deg]

# Of a rod slice per rod and of a thin disk about a diameter [kg m^2].
ROD_INERTIA = SECTION.backbone_mass * SECTION.diameters[0] ** 2 / 16.0
DISK_INERTIA = SECTION.disk_mass * SECTION.disk_diameter**2 / 16.0

# Of formulas that say the same, each in its own order of operations: some hundred roundings.
SAME = 1e-11


@by_keyword
@dataclass(frozen=True, kw_only=True)
class Claim:
    """A claim of the paper beside what its own equations give.

    Attributes
    ----------
    name : str
        Short and unique; that of the function which computes the row, with dashes.
    where : str
        Section, equation, table or figure of the paper.
    claim : str
        What the paper says.
    computed : str
        What follows from its equations (1) to (4) and Table 1, with the numbers.
    verdict : {"holds", "holds in part", "does not hold", "cannot be checked"}
        What the one says about the other.
    sources : tuple of str
        Which of the known errors E1 to E8 the row is about.
    values : dict of str to float
        The numbers computed, in the units of the sentence.

    Examples
    --------
    >>> import cdcr.paper
    >>> told = {"name": "sum", "where": "p. 1", "claim": "1 + 1 = 2"}
    >>> claim = cdcr.paper.Claim(**told, computed="2", verdict="holds", values={})
    >>> claim.verdict
    'holds'
    """

    name: str = ""
    where: str
    claim: str
    computed: str
    verdict: Verdict
    values: dict[str, float]
    sources: tuple[str, ...] = ()

    def as_dict(self) -> dict[str, Any]:
        """Return the row as JSON has it.

        Examples
        --------
        >>> import cdcr.paper
        >>> told = {"name": "sum", "where": "p. 1", "claim": "1 + 1 = 2"}
        >>> claim = cdcr.paper.Claim(**told, computed="2", verdict="holds", values={})
        >>> claim.as_dict()["computed"]
        '2'
        """
        return asdict(self)


def numbers(**values: Any) -> dict[str, float]:
    """Return values as plain floats."""
    return {name: float(value) for name, value in values.items()}


def holds_if(condition: Any) -> Verdict:
    """Return a verdict that has nothing between."""
    return "holds" if bool(condition) else "does not hold"


def gap(a: ArrayLike, b: ArrayLike) -> float:
    """Return the largest difference of two arrays, over the largest entry if that is above one."""
    first, second = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    scale = max(1.0, float(np.max(np.abs(second))))
    return float(np.max(np.abs(first - second))) / scale


def excess(approximate: Any, exact: Any) -> float:
    """Return the error of an approximation in per cent."""
    return 100.0 * float(approximate / exact - 1.0)


def tiny(value: Any) -> str:
    """Return a rounding error as text."""
    return f"{float(value):.0e}" if value else "0"


@lru_cache(maxsize=1)
def model() -> Model:
    """Return the exact model of Table 1."""
    return Model(ROBOT)
