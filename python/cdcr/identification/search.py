"""The search for the least sum of squares from one start, by SciPy, and where it ends."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, NoReturn

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.identification.data import UnsolvedError
from cdcr.identification.problem import Problem
from cdcr.identification.uncertainty import told_part

LOSS_SCALE = 2.0  # deviations beyond which a robust loss counts less
SETTLED = 1e-3  # step, in standard errors, that is not worth taking
KEPT = 0.3  # standard errors that the search may have moved while derivatives are kept
# Those of SciPy, for what a step in standard errors does not end: robust losses, values at bounds.
TOLERANCES = {"xtol": 1e-9, "ftol": 1e-10, "gtol": 1e-10}


class _EndedError(Exception):
    """The search has settled, or it is where it may not be."""


def search(problem: Problem, start: FloatArray, options: dict[str, Any], optimise: Any) -> Any:
    """Return what least squares find from a start, None where the model has no answer there.

    Where it comes to the edge of what the model answers it ends there, without success.

    SciPy's search within bounds goes slowly even where they are far: they are left aside until a
    step leads beyond one.
    """
    problem.forget()
    inside = np.clip(start, problem.low, problem.high)
    first = problem.residuals(inside)
    if not np.isfinite(first).all():
        return None
    scaled = {"x_scale": "jac", "method": "trf", **TOLERANCES, **options}
    if options["loss"] != "linear":
        scaled["f_scale"] = LOSS_SCALE * _spread(first, problem)
    free = _Steps(problem, inside, linear=options["loss"] == "linear")
    found = free.search(optimise, scaled, bounded=False)
    if found is None:
        scaled["max_nfev"] = max(options["max_nfev"] - free.evaluations, 1)
        held = _Steps(problem, free.x, linear=free.linear)
        found = held.search(optimise, scaled, bounded=True)
    return found


def _spread(residuals: FloatArray, problem: Problem) -> float:
    """Return the size of residuals, one where all noise is given."""
    middle = float(np.median(np.abs(residuals)))
    return 1.0 if problem.noise_is_given or not middle else 1.4826 * middle


class _Steps:
    """Residuals and derivatives as SciPy asks for them, which tell when a search has settled.

    A step of Gauss and Newton is, counted in standard errors, as long as the part of the residuals
    that the derivatives can make up for, over the misfit.
    """

    def __init__(self, problem: Problem, start: FloatArray, *, linear: bool) -> None:
        self.problem, self.x, self.linear = problem, start, linear
        self.evaluations = 0
        self.bounded = self.left = False
        self.trouble = ""  # why there are no derivatives at x
        self._at = start  # of the derivatives
        self._slopes: FloatArray | None = None

    def search(self, optimise: Any, options: dict[str, Any], *, bounded: bool) -> Any:
        """Return what is found; None where a search without bounds has left them."""
        self.bounded = bounded
        problem, shift = self.problem, 1.0
        bounds = (problem.low + shift, problem.high + shift) if bounded else (-np.inf, np.inf)
        try:
            # Counted from one: the first step of SciPy's is as long as the start is large.
            found = optimise(
                lambda y: self.residuals(y - shift), self.x + shift,
                jac=lambda y: self.jacobian(y - shift), bounds=bounds, **options,
            )  # fmt: skip
        except _EndedError:
            nowhere = bool(self.trouble) and self._slopes is None
            return None if self.left or nowhere else self._settled()
        found.x = found.x - shift
        return found

    def residuals(self, x: FloatArray) -> FloatArray:
        """Return residuals at x, or end a search that has left the bounds."""
        problem = self.problem
        if not self.bounded and ((x < problem.low) | (x > problem.high)).any():
            self.left = True
            self._end()
        self.evaluations += 1
        return problem.residuals(x)

    def jacobian(self, x: FloatArray) -> FloatArray:
        """Return derivatives at x, or some found close by; end a search that has settled."""
        self.x = x.copy()
        residuals = self.problem.residuals(x)
        freedom = max(residuals.size - x.size, 1)
        misfit = float(np.sqrt(residuals @ residuals / freedom))
        if self.problem.noise_is_given:
            misfit = max(misfit, 1.0)
        moved = np.inf if self._slopes is None else np.linalg.norm(self._slopes @ (x - self._at))
        slopes = self._slopes
        if slopes is None or not self.linear or moved > KEPT * misfit:
            slopes = self._differentiate()
        if self.linear and np.linalg.norm(told_part(slopes, residuals)) <= SETTLED * misfit:
            self._end()
        return slopes

    def _differentiate(self) -> FloatArray:
        """Return derivatives at x; where the model has none, as at its limits, the search ends."""
        try:
            slopes = self.problem.jacobian(self.x)
        except (UnsolvedError, ValueError) as error:
            self.trouble = str(error)
            self._end()
        self._slopes, self._at = slopes, self.x
        return slopes

    def _end(self) -> NoReturn:
        raise _EndedError

    def _settled(self) -> Any:
        """Return what was found, as SciPy would."""
        fun = self.problem.residuals(self.x)
        message = f"a further step is shorter than {SETTLED:g} standard errors"
        if self.trouble:
            message = f"it came to the edge of what the model answers: {self.trouble}"
        return SimpleNamespace(
            x=self.x, fun=fun, jac=self._slopes, cost=0.5 * float(fun @ fun),
            success=not self.trouble, message=message,
            active_mask=np.zeros(self.x.size, int),
        )  # fmt: skip
