"""Values of the parameters of a sweep as the command line writes them: PATH=0:0.1:20."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from cdcr.base import decimals
from cdcr.base.arrays import FloatArray
from cdcr.base.extras import require

_GRID = "LOW:HIGH:COUNT, LOW:HIGH:COUNT:log or numbers with commas"
_SAMPLED = "LOW:HIGH, LOW:HIGH:log or normal:MEAN:SD where --samples is given"
_MOST = 1_000_000  # values of one parameter


def grid(text: str) -> tuple[str, FloatArray]:
    """Return a parameter and its values, or refuse what is none."""
    path, values = _split(text)
    if ":" not in values:
        return path, np.array([_number(text, one, _GRID) for one in values.split(",")])
    parts, is_log = _parts(values)
    if len(parts) != 3:
        _refuse(text, _GRID)
    low, high = (_number(text, one, _GRID) for one in parts[:2])
    count = decimals.whole(parts[2]) or 0
    if not 2 <= count <= _MOST:
        _refuse(text, f"{_GRID}, with a COUNT of 2 to {_MOST}")
    _check_range(text, low, high, is_log)
    return path, np.geomspace(low, high, count) if is_log else np.linspace(low, high, count)


def sampled(text: str) -> tuple[str, Any]:
    """Return a parameter and its range or distribution, or refuse what is none."""
    path, values = _split(text)
    parts, is_log = _parts(values)
    if parts[0] == "normal" and len(parts) == 3:
        mean, deviation = (_number(text, one, _SAMPLED) for one in parts[1:])
        if deviation <= 0.0:
            _refuse(text, "normal:MEAN:SD with SD > 0")
        return path, require("scipy.stats", "sweep").norm(mean, deviation)
    if len(parts) != 2:
        _refuse(text, _SAMPLED)
    low, high = (_number(text, one, _SAMPLED) for one in parts)
    _check_range(text, low, high, is_log)
    if is_log:
        return path, require("scipy.stats", "sweep").loguniform(low, high)
    return path, (low, high)


def _split(text: str) -> tuple[str, str]:
    path, equals, values = text.partition("=")
    if not path or not equals:
        raise ValueError(f"--param must be PATH=VALUES, got {text!r}")
    return path, values


def _parts(values: str) -> tuple[list[str], bool]:
    parts = values.split(":")
    is_log = len(parts) > 1 and parts[-1] == "log"
    return (parts[:-1] if is_log else parts), is_log


def _number(text: str, one: str, must: str) -> float:
    value = decimals.number(one)
    if not math.isfinite(value):
        _refuse(text, must)
    return value


def _check_range(text: str, low: float, high: float, is_log: bool) -> None:
    if low >= high:
        _refuse(text, "values with LOW below HIGH")
    if is_log and low <= 0.0:
        _refuse(text, "values with LOW above 0 where they are log")


def _refuse(text: str, must: str) -> None:
    path = text.partition("=")[0]
    raise ValueError(f"--param {path} must have {must}, got {text!r}")
