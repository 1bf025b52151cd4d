"""What controllers take alike: gains, limits of the cables, periods."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cdcr.base.arrays import finite
from cdcr.base.check import Check, require_truth


def checked(
    numbers: dict[str, Any],
    *,
    gains: dict[str, ArrayLike] | None = None,
    switches: dict[str, bool] | None = None,
    others: dict[str, Any] | None = None,
    cables: Sequence[int] | None = None,
) -> dict[str, Any]:
    """Return options as the core takes them, or refuse what is of another kind."""
    check = Check()
    given: dict[str, Any] = {}
    for name, gain in (gains or {}).items():
        if isinstance(gain, (list, tuple)) or (isinstance(gain, np.ndarray) and gain.ndim > 0):
            given[name] = finite(gain, name)
        else:
            given[name] = check.number(name, gain, "a number")
    for name, value in numbers.items():
        given[name] = check.number(name, value, "a number")
    for name, switch in (switches or {}).items():
        require_truth(name, switch)
        given[name] = bool(switch)
    given["cables"] = []
    if cables is not None:
        chosen = check.items("cables", cables, "a sequence of indices of cables")
        if isinstance(cables, (list, tuple)) and not cables:
            check.refuse("cables", "a sequence of one index or more", cables)
        given["cables"] = [
            check.whole(f"cables[{i}]", cable, "the index of a cable")
            for i, cable in enumerate(chosen)
        ]
    check.done()
    return given | (others or {})


def told(kind: str, period: float, values: Mapping[str, Any]) -> str:
    """Return what a controller or an estimator says of itself; of arrays, their shapes."""
    words = [
        f"{name} {value:g}"
        if isinstance(value, float)
        else f"{name} of shape {np.shape(value)}"
        if isinstance(value, (list, tuple, np.ndarray))
        else f"{name} {value}"
        for name, value in values.items()
    ]
    return f"<{kind}: {', '.join([*words, f'period {period:g} s'])}>"
