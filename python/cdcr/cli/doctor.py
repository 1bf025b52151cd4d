"""What ``cdcr doctor`` tells: versions, processor, extras, and whether all is well."""

from __future__ import annotations

import importlib.metadata
import platform
import re
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import typer
from rich.console import Console
from rich.table import Table
from rich.text import Text

import cdcr
from cdcr import _core
from cdcr.base.extras import find_ffmpeg
from cdcr.base.processes import usable
from cdcr.cli.plain import AsJson, print_json, told_plainly
from cdcr.cli.run import DelayedBar
from cdcr.cli.self_test import Outcome, self_test, step_time
from cdcr.cli.tables import new_table

commands = typer.Typer()

# What the extras give; of those not here the packages are told alone.
GIVES = {
    "plot": "pictures and films",
    "data": "xarray, netCDF files",
    "cli": "the command cdcr",
    "track": "motions from samples",
    "control": "python-control",
    "casadi": "functions for optimisers",
    "jax": "functions under jit, vmap and grad",
    "mpc": "predictive control",
    "identify": "parameters from measurements",
    "gym": "environments of Gymnasium",
    "mcap": "logs for Foxglove",
    "view": "the live view in the browser",
}
# Instructions on vectors, narrow to wide, as Linux names them.
_VECTORS = ("sse4_2", "avx", "fma", "avx2", "avx512f", "asimd", "sve")


def examine(console: Console) -> dict[str, Any]:
    """Return everything that is told, as JSON has it; `ok` is whether all is well."""
    extras = {name: _extra(name, packages) for name, packages in _extras().items()}
    checks, start = [], time.perf_counter()
    able = {
        kind: not extras[name]["missing"] if name in extras else False
        for kind, name in (("pictures", "plot"), ("netcdf", "data"))
    }
    with DelayedBar(console, "self-test", 12.0) as bar:
        for done, outcome in enumerate(self_test(**able), start=1):
            checks.append(outcome)
            bar(min(done, 12.0))
    return {
        "ok": all(outcome.ok for outcome in checks),
        "versions": _versions(),
        "processor": _processor(),
        "blas": _blas(),
        "cvode": _core.with_cvode,
        "ffmpeg": find_ffmpeg(),
        "extras": extras,
        "self_test": [_as_dict(outcome) for outcome in checks],
        "self_test_s": time.perf_counter() - start,
        "simulator_step_s": step_time(),
    }


def _versions() -> dict[str, str]:
    return {
        "cdcr": cdcr.__version__,
        "Python": platform.python_version(),
        "NumPy": np.__version__,
        "pydantic": importlib.metadata.version("pydantic"),
        "system": platform.platform(),
    }


def _processor() -> dict[str, Any]:
    try:
        told = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace")
    except OSError:
        told = ""
    name = re.search(r"^model name\s*: (.*)$", told, re.MULTILINE)
    flags = re.search(r"^(?:flags|Features)\s*: (.*)$", told, re.MULTILINE)
    known = flags[1].split() if flags else []
    return {
        "name": name[1] if name else platform.processor() or platform.machine(),
        "machine": platform.machine(),
        "usable": usable(),
        "vector_instructions": [one for one in _VECTORS if one in known],
    }


def _blas() -> str:
    """Return the library behind NumPy's products of matrices."""
    try:
        about: Any = np.show_config(mode="dicts")
        blas = about["Build Dependencies"]["blas"]
    except (TypeError, KeyError):  # NumPy before 1.25
        return "not told by this NumPy"
    return f"{blas['name']} {blas.get('version', '')}".strip()


def _extras() -> dict[str, list[str]]:
    """Return the packages that each extra of the installed cdcr asks for."""
    found: dict[str, list[str]] = {}
    try:
        asked = importlib.metadata.requires("cdcr") or []
    except importlib.metadata.PackageNotFoundError:  # run from a folder of sources
        asked = []
    for one in asked:
        extra = re.search(r"""extra == ['"]([\w-]+)['"]""", one)
        package = re.match(r"[\w.-]+", one)
        if extra and package and package[0] != "cdcr":
            found.setdefault(extra[1], []).append(package[0])
    return found


def _extra(name: str, packages: list[str]) -> dict[str, Any]:
    versions = {package: _version(package) for package in packages}
    return {
        "gives": GIVES.get(name, ""),
        "packages": versions,
        "missing": [package for package, version in versions.items() if version is None],
    }


def _version(package: str) -> str | None:
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return None


def _as_dict(outcome: Outcome) -> dict[str, Any]:
    return {
        "name": outcome.name,
        "ok": outcome.ok,
        "residual": outcome.residual,
        "tolerance": outcome.tolerance,
        "failure": outcome.failure,
    }


def print_report(console: Console, told: dict[str, Any]) -> None:
    """Print what was found as tables."""
    console.print(_pairs("This machine", _machine(told)))
    console.print(_pairs("Extras of cdcr", _told_extras(told["extras"])))
    table = new_table("Self-test", "", "off by", "allowed", "")
    for check in told["self_test"]:
        off = check["failure"] or f"{check['residual']:.1e}"
        table.add_row(check["name"], Text(off), f"{check['tolerance']:.0e}", _mark(check["ok"]))
    console.print(table)
    console.print(f"Took {told['self_test_s']:.1f} s. ", end="")
    console.print("All is well." if told["ok"] else Text("Something is wrong.", style="bold red"))


def _machine(told: dict[str, Any]) -> Iterator[tuple[str, str]]:
    yield from told["versions"].items()
    processor = told["processor"]
    yield "processor", f"{processor['name']}, {processor['machine']}"
    yield "processors to use", str(processor["usable"])
    yield "vector instructions", ", ".join(processor["vector_instructions"]) or "not known"
    yield "BLAS of NumPy", told["blas"]
    yield (
        "SUNDIALS",
        (
            "built in: methods bdf and adams"
            if told["cvode"]
            else "not built in: no methods bdf and adams"
        ),
    )
    yield "ffmpeg", told["ffmpeg"] or "not found: no films in .mp4"
    yield "a step of Simulator", f"{1e6 * told['simulator_step_s']:.2f} us, one section"
    yield "program", sys.executable


def _told_extras(extras: dict[str, Any]) -> Iterator[tuple[str, str]]:
    for name, extra in extras.items():
        packages = ", ".join(
            f"{package} {version}" if version else f"{package} missing"
            for package, version in extra["packages"].items()
        )
        gives = f"{extra['gives']}: " if extra["gives"] else ""
        advice = f'; pip install "cdcr[{name}]"' if extra["missing"] else ""
        yield name, f"{gives}{packages}{advice}"
    if not extras:
        yield "not known", "cdcr runs from a folder of sources, not as an installed package"


def _pairs(title: str, rows: Iterator[tuple[str, str]]) -> Table:
    table = new_table(title, "")
    table.add_column("")
    table.show_header = False
    for name, value in rows:
        table.add_row(Text(name), Text(value))
    return table


def _mark(ok: bool) -> Text:
    return Text("ok") if ok else Text("wrong", style="bold red")


@commands.command("doctor", short_help="Tell what is installed, and test that it works.")
def doctor_command(as_json: AsJson = False) -> None:
    """Tell versions, processor and extras; compare a few seconds of computing with known numbers.

    Exit code 1 where something is wrong; an extra that is not installed is not.
    """
    with told_plainly():
        told = examine(Console(stderr=True))
        if as_json:
            print_json(told)
        else:
            print_report(Console(), told)
    if not told["ok"]:
        raise typer.Exit(1)
