"""What rubs or remembers in a robot, and who knows nothing of it."""

from __future__ import annotations

import warnings

from cdcr import _core
from cdcr.model.model import Model


def remembers(model: _core.Model) -> bool:
    """Return whether its motion depends on more than coordinates, rates and commands."""
    return model.num_deflections > 0 or model.has_backlash


def warn_of_memory(model: Model, who: str, *, stacklevel: int) -> None:
    """Warn those that know no more than coordinates and rates, of a robot that remembers."""
    instead = {
        "friction by the sliding speed in place of presliding_stiffness": model.num_deflections,
        "drives without their backlash": model.has_backlash,
    }
    taken = " and ".join(words for words, has in instead.items() if has)
    if taken:
        warnings.warn(
            f"{who} knows nothing of what cables and drives remember: it takes {taken}",
            UserWarning,
            stacklevel=stacklevel + 1,
        )


def warn_of_friction(model: Model, who: str, *, stacklevel: int) -> None:
    """Warn those that find tensions for a motion as if the cables of the robot did not rub."""
    if model.has_friction:
        warnings.warn(
            f"{who} leaves out the friction of the cables: with it the motion takes other tensions",
            UserWarning,
            stacklevel=stacklevel + 1,
        )


def other_drive(model: Model, other: Model) -> str | None:
    """Return the first cable that another model of as many drives otherwise, and how."""
    pairs = zip(model.robot.all_cables, other.robot.all_cables, strict=False)
    for j, (one, its) in enumerate(pairs):
        if one.length_driven != its.length_driven:
            how = ("tension", "length")
            return (
                f"cable {j + 1} must be driven by {how[one.length_driven]}, "
                f"got one driven by {how[its.length_driven]}"
            )
    return None
