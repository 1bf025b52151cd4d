"""Ready-made runs, each with its robot, its inputs, its summary and its picture.

A new scenario is one new file here that defines ``SCENARIO``; its name is the file's, with
dashes for underscores.
"""

from __future__ import annotations

from importlib import import_module
from pkgutil import iter_modules

from cdcr._fields import nearest
from cdcr.scenarios._scenario import Scenario

__all__ = ["Scenario", "get", "names"]


def names() -> tuple[str, ...]:
    """Return the names of all scenarios."""
    files = (module.name for module in iter_modules(__path__) if not module.name.startswith("_"))
    return tuple(sorted(name.replace("_", "-") for name in files))


def get(name: str) -> Scenario:
    """Return the scenario of that name.

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
    scenario: Scenario = import_module(f"{__name__}.{name.replace('-', '_')}").SCENARIO
    return scenario
