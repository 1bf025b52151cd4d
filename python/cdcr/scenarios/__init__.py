"""Ready-made runs and pictures: the robot, what is done to it, a summary and a figure.

A new scenario is one new file in ``library``, and its name that of the file: NAME.toml, a scenario
file as users write them; or, where nothing runs, a module that defines ``SCENARIO``. Findings and
a picture of its own are ``summarize`` and ``plot`` of modules of that name in ``studies`` and
``figures``, with underscores for dashes.
"""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from cdcr.base.check import require_known
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
    "length-drive": None,
    "subdivision": None,
}
# Modules of studies and figures that serve several scenarios.
_SHARED = {
    **{name: "factors" for name in _FIGURES if name.startswith("factors-")},
    **dict.fromkeys(("circle-tracking", "plane-tracking"), "tracking"),
    **dict.fromkeys(("hanging-arm", "payload-drop"), "release"),
}


def names() -> tuple[str, ...]:
    """Return the names of all scenarios, in the order of the origin paper's figures."""
    files = [path for path in _folder().iterdir() if path.suffix in (".py", ".toml")]
    found = {path.stem.replace("_", "-") for path in files if path.stem != "__init__"}
    return (*(name for name in _FIGURES if name in found), *sorted(found - _FIGURES.keys()))


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
    require_known("scenario", name, names())
    file, module = _folder() / f"{name}.toml", name.replace("-", "_")
    if file.exists():
        from cdcr.scenarios.file.reader import load_scenario

        scenario = load_scenario(file)
    else:
        scenario = import_module(f"{library.__name__}.{module}").SCENARIO
    return replace(
        scenario, paper_figure=_FIGURES.get(name), **_attached(_SHARED.get(name, module))
    )


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
        For an unknown name, or a scenario that is not a file, with those that are.
    """
    file = _folder() / f"{name}.toml"
    if not file.exists():
        files = [known for known in names() if (_folder() / f"{known}.toml").exists()]
        if name in names():
            raise ValueError(
                f"the scenario {name!r} is no file: it is a picture of the model alone, made in "
                f"Python. Files: {', '.join(files)}"
            )
        require_known("scenario", name, files)
    return file


def _folder() -> Path:
    return Path(library.__path__[0])


def _attached(module: str) -> dict[str, Any]:
    """Return the findings and the picture that a scenario has in place of those of every run."""
    study, picture = f"{__name__}.studies.{module}", f"{__name__}.figures.{module}"
    found: dict[str, Any] = {}
    if find_spec(study):
        found["summarize"] = import_module(study).summarize
    if find_spec(picture):  # which knows Matplotlib
        found["plot"] = lambda scenario, run: import_module(picture).plot(scenario, run)
    return found
