"""A fit in words: tables for people, TOML for the record."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from datetime import datetime, timezone
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import cdcr._core as core
from cdcr.files.new_file import file_path, new_file
from cdcr.identification.motions import Motion
from cdcr.robot.file import robot_lines

if TYPE_CHECKING:
    from cdcr.identification.result import Identified

FAR_OFF = 10.0  # standard deviations by which a motion begins elsewhere


def report(found: Identified) -> str:
    """Return the estimates and what is left over as a table."""
    lines = [_row("parameter", "estimate", "standard error", "began at", "unit")]
    for one in found.estimates:
        error = "not told" if math.isinf(one.standard_error) else f"{one.standard_error:.2g}"
        end = f"{one.unit}, at its bound" if one.at_bound else one.unit
        lines.append(_row(one.name, f"{one.value:.6g}", error, f"{one.start:.6g}", end))
    lines += ["", _row("left over", "RMS", "noise", "", "unit")]
    for left in found.residuals:
        noise = f"{left.noise:.3g}" + ("" if left.noise_given else " found")
        lines.append(_row(f"{left.data}, {left.channel}", f"{left.rms:.4g}", noise, "", left.unit))
    if found.untold:
        lines += ["", "The data cannot tell: " + "; ".join(found.untold) + "."]
    if found.misfit > 2.0:
        lines += [
            "",
            f"What is left over is {math.sqrt(found.misfit):.2g} times the noise stated: the model "
            "misses something. The standard errors are grown by as much.",
            *_wrong_starts(found),
        ]
    if not found.success:
        lines += ["", f"The search ended early: {found.message}"]
    return "\n".join(line.rstrip() for line in lines)


def _wrong_starts(found: Identified) -> Iterator[str]:
    """Say which motions, taken to begin at rest, began somewhere else."""
    at_rest = [one.name for one in found.data if isinstance(one, Motion) and one.start is None]
    for left in found.residuals:
        off = float(np.nanmax(np.abs(left.values[:1]), initial=0.0))
        if left.data in at_rest and off > FAR_OFF * left.noise:
            yield (
                f"{left.data} begins {off:.2g} {left.unit} off in {left.channel}: without a start "
                "it is at rest under its first command."
            )


def _row(name: str, value: str, error: str, start: str, unit: str) -> str:
    return f"{name:<34} {value:>12} {error:>14} {start:>12}  {unit}"


def provenance(found: Identified) -> list[tuple[str, Any]]:
    """Return where estimates come from, as keys and values."""
    pairs: list[tuple[str, Any]] = [
        ("cdcr", core.__version__),
        ("date", datetime.now(timezone.utc).date().isoformat()),
        ("loss", found.loss),
        ("misfit", found.misfit),
        ("starts", len(found.costs)),
        ("evaluations", found.evaluations),
    ]
    return pairs


def provenance_comments(found: Identified) -> list[str]:
    """Return the same as comments, for the head of a robot file."""
    lines = [f"# {key}: {value}" for key, value in provenance(found)]
    lines += [f"# {one.name} = {one.value!r} +- {one.standard_error:.2g} {one.unit}".rstrip()
              for one in found.estimates]  # fmt: skip
    for one in found.data:
        if one.source:
            lines.append(f"# from {one.source['file']}, SHA-256 {one.source['sha256']}")
    return ["# Identified from measurements:", *lines]


def text(found: Identified) -> str:
    """Return estimates, errors, provenance and the robot as TOML."""
    lines = ["# Parameters of a robot, identified from measurements.", "", "[provenance]"]
    lines += [_pair(key, value) for key, value in provenance(found)]
    for one in found.data:
        lines += ["", "[[data]]", _pair("name", one.name), _pair("rows", len(one))]
        lines += [_pair(key, value) for key, value in one.source.items()]
    for number in found.estimates:
        lines += ["", "[[parameters]]"]
        for key in ("path", "name", "unit", "value", "standard_error", "start", "low", "high"):
            lines.append(_pair(key, getattr(number, key)))
        if number.prior is not None:
            lines.append(_pair("prior", list(number.prior)))
    lines += ["", "[uncertainty]"]
    lines.append(_pair("singular_values", found.uncertainty.singular_values.tolist()))
    lines.append(_pair("correlation", found.correlation.tolist()))
    lines.append(_pair("not_told", found.untold))
    for left in found.residuals:
        lines += ["", "[[residuals]]"]
        for key in ("data", "channel", "unit", "rms", "noise", "noise_given"):
            lines.append(_pair(key, getattr(left, key)))
    setup = found.setup
    lines += ["", "[laboratory]"]
    for key in ("command_offset", "command_gain", "marker_offset", "time_shift"):
        lines.append(_pair(key, _listed(getattr(setup, key))))
    lines += ["", "[robot]"]
    lines += [
        line.replace("[[", "[[robot.", 1) if line.startswith("[[") else line
        for line in robot_lines(found.robot)
    ]
    return "\n".join(lines) + "\n"


def _listed(value: Any) -> Any:
    return [_listed(one) for one in value] if isinstance(value, tuple) else value


def _pair(key: str, value: Any) -> str:
    return f"{key} = {_value(value)}"


def _value(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, bool):
        return str(value).lower()
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else repr(value)


def save(found: Identified, path: str | PathLike[str], *, overwrite: bool) -> Path:
    """Write the TOML file; see Identified.save."""
    file = file_path(path)
    with new_file(file, overwrite=overwrite) as part:
        part.write_text(text(found), encoding="utf-8", newline="\n")
    return file
