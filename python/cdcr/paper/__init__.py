"""The origin paper beside the model: its factors, its inertia and its polar equations of motion.

Amouri, Mahfoudi, Zaatri (2020), doi 10.46604/ijeti.2020.4422, one section; "paper eq." below is an
equation of theirs, E1 to E8 are its errors, listed in cpp/README.md.
"""

from cdcr.paper._factors import Factors, factors, inertia, taylor_coefficients
from cdcr.paper._polar import PolarModel

__all__ = ["Factors", "PolarModel", "factors", "inertia", "taylor_coefficients"]


def __dir__() -> list[str]:
    return __all__
