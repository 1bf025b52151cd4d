"""Whether a controller is one, and for this robot: the core knows those written in C++."""

from __future__ import annotations

from cdcr import _core
from cdcr.base.check import count, require_kind
from cdcr.model.memory import other_drive
from cdcr.model.model import Model


def require_controller(controller: object, model: Model) -> None:
    """Refuse what is no controller, and one of the package that is written for another robot.

    Such a one says so by an attribute `_made_for`; those of users may reckon with any model.
    """
    require_kind("controller", controller, _core.Controller)
    made_for = getattr(controller, "_made_for", None)
    if not isinstance(made_for, Model):
        return
    sizes = [(one.num_coordinates, one.num_cables) for one in (made_for, model)]
    if sizes[0] != sizes[1]:
        was, has = (f"{count(d, 'coordinate')} and {count(c, 'cable')}" for d, c in sizes)
        raise ValueError(f"the controller was made for a robot of {was}, but the model has {has}")
    differs = other_drive(made_for, model)
    if differs is not None:
        raise ValueError(f"the controller was made for a robot driven otherwise: {differs}")
