"""The origin paper beside the model: its factors, its inertia and its polar equations of motion.

Amouri, Mahfoudi, Zaatri (2020), doi 10.46604/ijeti.2020.4422, one section; "paper eq." below is an
equation of theirs, E1 to E8 are its errors, listed in cpp/README.md.
"""

from typing import TYPE_CHECKING, Any

from cdcr.paper._factors import Factors, factors, inertia, taylor_coefficients
from cdcr.paper._polar import PolarModel

if TYPE_CHECKING:
    from cdcr.paper._audit import Claim, audit

__all__ = [
    "Claim",
    "Factors",
    "PolarModel",
    "audit",
    "factors",
    "inertia",
    "taylor_coefficients",
]


def __getattr__(name: str) -> Any:
    """Load the audit when it is asked for."""
    if name in ("Claim", "audit"):
        from cdcr.paper import _audit

        return getattr(_audit, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return __all__
