"""Ready-made runs and pictures: the robot, what is done to it, a summary and a figure.

A new scenario is one new file NAME.toml in ``library``, a scenario file as users write them,
without ``t_end`` where nothing runs. Findings and a picture of its own are ``summarize`` and
``plot`` of modules of that name in ``studies`` and ``figures``, with underscores for dashes.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from cdcr.base.check import known_name
from cdcr.files.toml import read_toml
from cdcr.scenarios import library
from cdcr.scenarios.scenario import Scenario

__all__ = ["Scenario", "get", "names", "source_file"]

# Numbers of the origin paper's figures, in their order, then robots of several sections.
_FIGURES = {
    "factors-backbone": 2,
    "factors-backbone-rotation": 3,
    "factors-disks": 4,
    "factors-disks-rotation": 5,
    "kinetic-energy-terms": 6,
    "gravity-ratio": 7,
    "free-oscillation": 8,
    "step-tension": 9,
    "two-cables": 10,
    "block-diagram": 11,
    "circle-tracking": 12,
    "plane-tracking": 13,
    "pid": 14,
    "three-sections": None,
    "hanging-arm": None,
    "payload-drop": None,
    "pull-release": None,
    "hysteresis": None,
    "length-drive": None,
    "subdivision": None,
    "helical-cable": None,
    "twist-under-load": None,
    "tapered-arm": None,
    "precurved-tube": None,
    "regulation": None,
    "circle-control": None,
    "three-section-tracking": None,
    "motor-limits": None,
    "estimator": None,
    "contact-force": None,
}
# Modules of studies and figures that serve several scenarios.
_SHARED = {
    **{name: "factors" for name in _FIGURES if name.startswith("factors-")},
    **dict.fromkeys(("circle-tracking", "plane-tracking"), "tracking"),
    **dict.fromkeys(("hanging-arm", "payload-drop"), "release"),
}


def names() -> tuple[str, ...]:
    """Return the names of all scenarios, in the order of the origin paper's figures.

    Examples
    --------
    >>> import cdcr.scenarios
    >>> cdcr.scenarios.names()[6:9]
    ('free-oscillation', 'step-tension', 'two-cables')
    """
    found = {path.stem for path in _folder().glob("*.toml")}
    return (*(name for name in _FIGURES if name in found), *sorted(found - _FIGURES.keys()))


def get(name: str) -> Scenario:
    """Return the scenario of that name.

    Parameters
    ----------
    name : str
        One of `names`, with dashes or underscores.

    Returns
    -------
    Scenario

    Raises
    ------
    ValueError
        For an unknown name, with the known ones.

    Examples
    --------
    >>> import cdcr.scenarios
    >>> cdcr.scenarios.get("step-tension").title
    '5 N on cable 1 of the straight robot at rest'
    """
    name = known_name("scenario", name, names())
    table = _table(name)
    if "t_end" in table:
        from cdcr.scenarios.file.reader import load_scenario

        scenario = load_scenario(_file(name))
    else:
        from cdcr.scenarios.file.robot import read_robot

        robot = read_robot(table["robot"], _file(name))
        scenario = Scenario(name=name, **table | {"robot": robot})
    module = _SHARED.get(name, name.replace("-", "_"))
    return replace(scenario, paper_figure=_FIGURES.get(name), **_attached(module))


def source_file(name: str) -> Path:
    """Return the scenario file of that name, which comes with the package.

    Parameters
    ----------
    name : str
        One of `names`, of a scenario in which something runs.

    Returns
    -------
    Path

    Raises
    ------
    ValueError
        For an unknown name, or a scenario in which nothing runs, with those to choose from.

    Examples
    --------
    >>> import cdcr.scenarios
    >>> cdcr.scenarios.source_file("pid").name
    'pid.toml'
    """
    files = [known for known in names() if "t_end" in _table(known)]
    pictures = {known for known in names() if known not in files}
    if str(name).replace("_", "-") in pictures:
        raise ValueError(
            f"nothing runs in the scenario {name!r}: it is a picture of the model alone. Scenarios "
            f"in which something runs: {', '.join(files)}"
        )
    return _file(known_name("scenario", name, files))


def _folder() -> Path:
    return Path(library.__path__[0])


def _file(name: str) -> Path:
    return _folder() / f"{name}.toml"


def _table(name: str) -> dict[str, Any]:
    return read_toml(_file(name), "scenario file")


def _attached(module: str) -> dict[str, Any]:
    """Return the findings and the picture that a scenario has in place of those of every run."""
    study, picture = f"{__name__}.studies.{module}", f"{__name__}.figures.{module}"
    found: dict[str, Any] = {}
    if find_spec(study):
        found["summarize"] = import_module(study).summarize
    if find_spec(picture):  # which knows Matplotlib
        found["plot"] = partial(_draw, picture)
    return found


def _draw(picture: str, scenario: Scenario, run: Any) -> Any:
    return import_module(picture).plot(scenario, run)
