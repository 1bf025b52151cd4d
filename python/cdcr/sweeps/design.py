"""Which values a sweep takes: a grid, or samples of a box, as rows with a value per parameter."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import prod
from typing import Any, Literal, Protocol, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from cdcr.base.arrays import MAX_SAMPLES, FloatArray, finite
from cdcr.base.check import Check, format_value, is_iterable, nearest, short
from cdcr.base.decimals import whole
from cdcr.base.extras import require

Kind = Literal["grid", "rows", "sobol", "lhs", "random", "saltelli"]
SAMPLED = ("sobol", "lhs", "random", "saltelli")
_POWER_OF_TWO = ("sobol", "saltelli")  # whose balance others would break
_SHAPE = "KIND:NUMBER, of " + ", ".join(SAMPLED)


class Distribution(Protocol):
    """What has a quantile function, such as the frozen distributions of `scipy.stats`."""

    def ppf(self, q: FloatArray) -> FloatArray:
        """Return the values below which shares q of it lie."""


Values: TypeAlias = "ArrayLike | Distribution"


@dataclass(frozen=True, eq=False)
class Design:
    """The values of a sweep.

    Parameters
    ----------
    kind : str
        "grid", "rows" of the user's own, "sobol", "lhs", "random" or "saltelli".
    names : tuple of str
        The parameters.
    rows : (N, d) array
        Their values, a row for each run.
    axes : tuple of (n_i,) array
        The values along each parameter of a grid, whose last one changes fastest; else empty.
    """

    kind: Kind
    names: tuple[str, ...]
    rows: FloatArray
    axes: tuple[FloatArray, ...] = ()


def make_design(
    parameters: Mapping[str, Values] | Iterable[str], samples: str | ArrayLike | None, seed: int
) -> Design:
    """Return the values of a sweep, as `cdcr.sweep` takes them, or refuse them in a sentence."""
    if isinstance(parameters, str) or not is_iterable(parameters):
        got = format_value(parameters)
        raise ValueError(f"parameters must be a mapping from names to values, got {got}")
    names = tuple(parameters)
    for name in names:
        if not isinstance(name, str):
            raise ValueError(f"a parameter must have a name, got {format_value(name)}")
    if not names:
        raise ValueError("a sweep must have a parameter, got none")
    twice = next((one for i, one in enumerate(names) if one in names[:i]), None)
    if twice is not None:
        raise ValueError(f"parameter {twice!r} must be given once, got it twice")
    check = Check()
    check.whole("seed", seed, "a whole number >= 0", low=0)
    check.done()
    if samples is not None and not isinstance(samples, str):
        return Design("rows", names, _own_rows(names, samples))
    if not isinstance(parameters, Mapping):
        got = format_value(parameters)
        raise ValueError(f"parameters must be a mapping from names to values, got {got}")
    if samples is None:
        axes = tuple(_axis(name, parameters[name]) for name in names)
        _refuse_too_many(prod(axis.size for axis in axes))
        rows = np.stack([one.ravel() for one in np.meshgrid(*axes, indexing="ij")], axis=1)
        return Design("grid", names, rows, axes)
    kind, number = _kind_and_number(samples, len(names))
    shares = _shares(kind, number, len(names), seed)
    columns = [_quantiles(name, parameters[name], shares[:, i]) for i, name in enumerate(names)]
    return Design(kind, names, np.stack(columns, axis=1))


def _own_rows(names: tuple[str, ...], samples: ArrayLike) -> FloatArray:
    rows = np.array(finite(samples, "samples"))
    if rows.ndim != 2 or rows.shape[1] != len(names) or not len(rows):
        must = f"a row of {len(names)} values for each run, one of each parameter"
        raise ValueError(f"samples must have {must}, got an array of shape {rows.shape}")
    _refuse_too_many(len(rows))
    return rows


def _axis(name: str, values: Values) -> FloatArray:
    if hasattr(values, "ppf"):
        raise ValueError(f"parameter {name!r} has a distribution, which needs samples: {_SHAPE}")
    axis = np.array(finite(values, f"parameter {name!r}"))
    if axis.ndim != 1 or not axis.size:
        raise ValueError(
            f"parameter {name!r} must have a sequence of values, got {format_value(values)}"
        )
    if np.unique(axis).size < axis.size:
        raise ValueError(f"parameter {name!r} must have each value once, got {axis.tolist()}")
    return axis


def _refuse_too_many(number: int) -> None:
    if number > MAX_SAMPLES:
        raise ValueError(f"a sweep must have at most {MAX_SAMPLES} runs, got {number}")


def _kind_and_number(samples: str, d: int) -> tuple[Kind, int]:
    kind, _, text = samples.partition(":")
    if kind not in SAMPLED:
        guess = nearest(kind, SAMPLED)
        end = f".{guess}" if guess else ""
        raise ValueError(f"samples must be {_SHAPE}, got {short(samples)}{end}")
    number = whole(text) or 0
    if number < 1:
        raise ValueError(f"samples must be {_SHAPE}, got {short(samples)}")
    if kind in _POWER_OF_TWO and number & (number - 1):
        upper = 1 << number.bit_length()
        near = f"{upper // 2} and {upper} are the nearest"
        raise ValueError(f"samples of {kind} must be a power of 2, got {number}; {near}")
    _refuse_too_many(number * (d + 2 if kind == "saltelli" else 1))
    return kind, number  # type: ignore[return-value]  # one of SAMPLED


def _shares(kind: Kind, number: int, d: int, seed: int) -> FloatArray:
    """Return points (N, d) of the unit cube.

    Those of "saltelli" are A and B, `number` points each, then A once for each parameter with its
    values from B (Saltelli and others, Computer Physics Communications 181, 2010).
    """
    if kind == "random":
        return np.random.default_rng(seed).random((number, d))
    qmc: Any = require("scipy.stats", "sweep").qmc
    rng = np.random.default_rng(seed)
    if kind == "lhs":
        return np.asarray(qmc.LatinHypercube(d, rng=rng).random(number))
    if kind == "sobol":
        return np.asarray(qmc.Sobol(d, rng=rng).random(number))
    points = np.asarray(qmc.Sobol(2 * d, rng=rng).random(number))
    a, b = points[:, :d], points[:, d:]
    mixed = [np.where(np.arange(d) == i, b, a) for i in range(d)]
    return np.concatenate([a, b, *mixed])


def _quantiles(name: str, values: Values, shares: FloatArray) -> FloatArray:
    """Return the values of a parameter at shares of its distribution."""
    if hasattr(values, "ppf"):
        found = np.asarray(values.ppf(shares), dtype=np.float64)
    else:
        pair = np.array(finite(values, f"parameter {name!r}"))
        if pair.shape != (2,) or pair[0] >= pair[1]:
            must = "two numbers, from low to high, or a distribution with ppf"
            got = format_value(values)
            raise ValueError(f"parameter {name!r} must have {must} where it is sampled, got {got}")
        found = pair[0] + shares * (pair[1] - pair[0])
    if not np.all(np.isfinite(found)):
        raise ValueError(f"parameter {name!r} must have a distribution of finite values")
    return found
