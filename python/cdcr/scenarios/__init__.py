"""Ready-made runs and pictures: the robot, what is done to it, a summary and a figure.

A new scenario is one new file in ``library`` that defines ``SCENARIO``; its name is the file's,
with dashes for underscores.
"""

from __future__ import annotations

from importlib import import_module
from pkgutil import iter_modules

from cdcr.base.check import nearest
from cdcr.scenarios import library
from cdcr.scenarios.scenario import Scenario

__all__ = ["Scenario", "get", "names"]

# The order of the origin paper's figures, then robots of several sections; others come after.
_ORDER = (
    "factors-backbone",
    "factors-backbone-rotation",
    "factors-disks",
    "factors-disks-rotation",
    "kinetic-energy-terms",
    "gravity-ratio",
    "free-oscillation",
    "step-tension",
    "two-cables",
    "block-diagram",
    "circle-tracking",
    "plane-tracking",
    "pid",
    "three-sections",
    "hanging-arm",
    "payload-drop",
    "pull-release",
    "length-drive",
    "subdivision",
)


def names() -> tuple[str, ...]:
    """Return the names of all scenarios, in the order of the origin paper's figures."""
    files = (
        module.name for module in iter_modules(library.__path__) if not module.name.startswith("_")
    )
    found = {name.replace("_", "-") for name in files}
    ordered = [name for name in _ORDER if name in found]
    return (*ordered, *sorted(found.difference(ordered)))


def get(name: str) -> Scenario:
    """Return the scenario of that name.

    Parameters
    ----------
    name : str
        One of `names`.

    Returns
    -------
    Scenario

    Raises
    ------
    ValueError
        For an unknown name, with the known ones.
    """
    known = names()
    if name not in known:
        raise ValueError(
            f"there is no scenario {name!r}.{nearest(name, known)} Known: {', '.join(known)}"
        )
    scenario: Scenario = import_module(f"{library.__name__}.{name.replace('-', '_')}").SCENARIO
    return scenario
