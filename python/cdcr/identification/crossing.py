"""Fits without a part of the data, which they then predict."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.identification.channels import whole

if TYPE_CHECKING:
    from cdcr.identification.data import Data
    from cdcr.identification.result import Identified, Residual


@dataclass(frozen=True, eq=False)
class CrossValidation:
    """Errors of prediction.

    Attributes
    ----------
    held_out : mapping of str to float
        RMS of what was left out of a fit and then predicted, by data and channel.
    used : mapping of str to float
        RMS of what was used, for comparison.
    values : (folds, n) array
        Estimates of each fit.
    """

    held_out: Mapping[str, float]
    used: Mapping[str, float]
    values: FloatArray


def cross_validate(found: Identified, folds: int) -> CrossValidation:
    """Return errors of prediction of the robot that was found."""
    most = max(len(one) for one in found.data)
    if most < 2:
        raise ValueError("cross-validation needs at least two rows of measurements, got 1")
    whole("folds", folds, 2, most)
    values: list[list[float]] = []
    squares: dict[str, list[tuple[float, int]]] = {}
    with_all: dict[str, list[tuple[float, int]]] = {}
    for error in found.residuals:
        with_all.setdefault(_name(error), []).append(_square(error))
    for fold in range(folds):
        used: list[Data] = []
        left: list[Data] = []
        for one in found.data:
            out = np.arange(len(one)) * folds // len(one) == fold
            used += [one._rows(~out)] if not out.all() else []
            left += [one._rows(out)] if out.any() else []
        again = found._refit(used)
        values.append([one.value for one in again.estimates])
        for one in left:
            for error in again.errors(one):
                squares.setdefault(_name(error), []).append(_square(error))
    return CrossValidation(_rms(squares), _rms(with_all), np.array(values))


def _rms(squares: Mapping[str, list[tuple[float, int]]]) -> dict[str, float]:
    """Return the root mean square of each channel, over all data of its name."""
    return {
        name: float(np.sqrt(sum(s for s, _ in pairs) / sum(n for _, n in pairs)))
        for name, pairs in squares.items()
        if sum(n for _, n in pairs)
    }


def _name(error: Residual) -> str:
    return f"{error.data}: {error.channel}"


def _square(error: Residual) -> tuple[float, int]:
    rows = int(np.isfinite(error.values).all(axis=1).sum())
    return (rows * error.rms**2, rows) if rows else (0.0, 0)
