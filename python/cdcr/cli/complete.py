"""What a shell offers for an argument that has been begun."""

from __future__ import annotations

from pathlib import Path

from typer import Context

FILMS = ("mp4", "gif", "html")
SIZES = ("journal", "slide")


def methods(incomplete: str) -> list[str]:
    """Return the integrators that begin so."""
    from cdcr import _core

    return _begun(tuple(_core.Method.__members__), incomplete)


def films(incomplete: str) -> list[str]:
    """Return the formats of films that begin so."""
    return _begun(FILMS, incomplete)


def formats(incomplete: str) -> list[str]:
    """Return the formats of files of a run that begin so."""
    from cdcr.scenarios.scenario import FILES

    return _begun(tuple(FILES), incomplete)


def metrics(incomplete: str) -> list[str]:
    """Return the metrics of a sweep that begin so, after those with commas before."""
    from cdcr.sweeps import METRICS

    given, comma, begun = incomplete.rpartition(",")
    return [f"{given}{comma}{name}" for name in _begun(tuple(METRICS), begun)]


def parameters(context: Context, incomplete: str) -> list[str]:
    """Return the numbers of the scenario on the line that begin so."""
    from cdcr.sweeps.jobs import file_source
    from cdcr.sweeps.paths import numbers

    # What stands before an option without its value is not told apart yet.
    scenario = context.params.get("scenario") or next(iter(context.args), "")
    try:
        table = file_source(scenario, ()).table
    except (OSError, ValueError):
        return []
    return _begun(tuple(numbers(table)), incomplete)


def samples(incomplete: str) -> list[str]:
    """Return the kinds of samples that begin so."""
    from cdcr.sweeps.design import SAMPLED

    return _begun(tuple(f"{kind}:" for kind in SAMPLED), incomplete)


def schedulers(incomplete: str) -> list[str]:
    """Return the scheduler that has a name, where it begins so."""
    return _begun(("local",), incomplete)


def sizes(incomplete: str) -> list[str]:
    """Return the names of sizes that begin so."""
    return _begun(SIZES, incomplete)


def kinds_of_files(incomplete: str) -> list[str]:
    """Return the kinds of files that begin so."""
    return _begun(("robot", "scenario"), incomplete)


def scenario_names(incomplete: str) -> list[str]:
    """Return the scenarios of the package that begin so."""
    from cdcr import scenarios

    return _begun(scenarios.names(), incomplete)


def robot_names(incomplete: str) -> list[str]:
    """Return the robots of the package that begin so."""
    from cdcr import robots

    return _begun(robots.names(), incomplete)


def scenarios(incomplete: str) -> list[str]:
    """Return scenarios and files that begin so."""
    return [*scenario_names(incomplete), *toml_files(incomplete)]


def robots(incomplete: str) -> list[str]:
    """Return robots and files that begin so."""
    return [*robot_names(incomplete), *toml_files(incomplete)]


def shown(incomplete: str) -> list[str]:
    """Return what can be viewed and begins so: robots, scenarios, their files and those of runs."""
    names = {*robot_names(incomplete), *scenario_names(incomplete)}
    return [*sorted(names), *_files(incomplete, (".nc", ".toml"))]


def toml_files(incomplete: str) -> list[str]:
    """Return the TOML files that begin so, and the folders, from which one goes on."""
    return _files(incomplete, (".toml",))


def _files(incomplete: str, suffixes: tuple[str, ...]) -> list[str]:
    folder, slash, begun = incomplete.rpartition("/")
    try:
        found = sorted(Path(f"{folder}{slash}" or ".").iterdir())
    except OSError:
        return []
    shown = [one for one in found if one.name.startswith(begun) and not one.name.startswith(".")]
    names = [
        f"{one.name}/" if one.is_dir() else one.name
        for one in shown
        if one.is_dir() or one.suffix in suffixes
    ]
    return [f"{folder}{slash}{name}" for name in names]


def _begun(names: tuple[str, ...], incomplete: str) -> list[str]:
    return [name for name in names if name.startswith(incomplete)]
