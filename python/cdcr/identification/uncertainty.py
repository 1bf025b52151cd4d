"""How well data tell parameters: covariance, and what they cannot tell."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cdcr.base.arrays import FloatArray

LOST = 1e-7  # of the largest singular value: smaller ones are rounding, and tell nothing
UNTOLD = 1.0  # deviation of a direction, in sizes of its parameters, that tells nothing of use
SHARE = 0.3  # of a direction that a parameter must have to be named


def told_part(jacobian: FloatArray, residuals: FloatArray) -> FloatArray:
    """Return the part of residuals that a change of the parameters makes up for."""
    sides, values, _ = np.linalg.svd(jacobian, full_matrices=False)
    found: FloatArray = residuals @ sides[:, values > LOST * max(values[0], 1e-300)]
    return found


@dataclass(frozen=True, eq=False)
class Uncertainty:
    """What the derivatives of residuals say, in sizes of the parameters.

    Attributes
    ----------
    singular_values : (n,) array
        Of the derivatives, largest first; one over each is the deviation of its direction.
    directions : (n, n) array
        In each row a direction, of length one.
    covariance : (n, n) array
        Infinite for what takes part in a direction that is not told at all.
    """

    singular_values: FloatArray
    directions: FloatArray
    covariance: FloatArray

    @classmethod
    def of(cls, jacobian: FloatArray, factor: float = 1.0) -> Uncertainty:
        """Return it for derivatives (rows, n) of residuals whose variance is `factor`."""
        n = jacobian.shape[1]
        _, found, directions = np.linalg.svd(jacobian, full_matrices=jacobian.shape[0] < n)
        values = np.zeros(n)
        values[: found.size] = found / np.sqrt(factor)
        told = values > LOST * max(values[0], 1e-300)
        scaled = directions[told] / values[told, None]
        covariance = scaled.T @ scaled
        lost = (np.abs(directions[~told]) > 1e-6).any(axis=0)
        covariance[lost, :] = covariance[:, lost] = np.nan
        covariance[lost, lost] = np.inf
        return cls(values, directions, covariance)

    @property
    def deviations(self) -> FloatArray:
        """Standard deviations (n,)."""
        found: FloatArray = np.sqrt(np.diag(self.covariance))
        return found

    @property
    def correlation(self) -> FloatArray:
        """Correlation (n, n); NaN beside what is not told."""
        spread = self.deviations
        with np.errstate(invalid="ignore"):
            found: FloatArray = self.covariance / np.outer(spread, spread)
        np.fill_diagonal(found, 1.0)
        return found

    def untold(self, names: list[str]) -> list[str]:
        """Name what the data cannot tell, a sentence for each direction."""
        found = []
        for value, direction in zip(self.singular_values, self.directions, strict=True):
            if value > 1.0 / UNTOLD and value > LOST * self.singular_values[0]:
                continue
            parts = np.flatnonzero(np.abs(direction) > SHARE * np.abs(direction).max())
            told = " with ".join(names[k] for k in parts)
            found.append(told if len(parts) == 1 else f"{told} (together)")
        return found
