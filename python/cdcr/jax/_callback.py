"""A function of JAX that calls Python, once for a whole batch, with the derivatives it gives."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.model.maps import ExactMap, Rows

NO_SECOND = "cdcr has no second derivatives: JAX asked for those of {}"
NO_X64 = (
    'cdcr computes in double precision: call jax.config.update("jax_enable_x64", True) before '
    "anything of JAX computes"
)


def function_of(exact: ExactMap) -> Callable[..., Any]:
    """Return the function of JAX of a map: of arrays (..., size), whose leading sizes broadcast."""
    gives = list(exact.gives.values())
    blocks = [(*shape, by) for shape in gives for by in exact.takes.values()]

    @jax.custom_jvp
    def slopes(*given: Any) -> Any:
        return _call(exact.slopes, blocks, given)

    @slopes.defjvp
    def refuse(primals: Any, tangents: Any) -> Any:
        raise NotImplementedError(NO_SECOND.format(exact.name))

    @jax.custom_jvp
    def values(*given: Any) -> Any:
        return _call(exact.values, gives, given)

    @values.defjvp
    def along(primals: Any, tangents: Any) -> Any:
        """Sum the products of slopes and tangents, of which JAX makes the reverse itself."""
        found = iter(slopes(*primals))
        sums = [sum(_product(next(found), tangent) for tangent in tangents) for _ in exact.gives]
        return values(*primals), tuple(sums)

    def function(*args: Any, **kwargs: Any) -> Any:
        config: Any = jax.config
        if not config.jax_enable_x64:
            raise ValueError(NO_X64)
        found = values(*_broadcast(exact, args, kwargs))
        return found[0] if len(found) == 1 else found

    function.__name__ = function.__qualname__ = exact.name
    return function


def _product(slope: Any, tangent: Any) -> Any:
    """Return slope (..., *answer, size) times tangent (..., size)."""
    leading = tangent.ndim - 1
    between = (1,) * (slope.ndim - leading - 1)
    return jnp.sum(slope * tangent.reshape(*tangent.shape[:-1], *between, -1), axis=-1)


def _call(function: Rows, shapes: Sequence[tuple[int, ...]], given: Sequence[Any]) -> Any:
    """Call a function of rows; under vmap once, with all rows in the leading dimensions."""
    leading = given[0].shape[:-1]
    struct: Any = jax.ShapeDtypeStruct
    wanted = tuple(struct((*leading, *shape), jnp.float64) for shape in shapes)

    def on_rows(*arrays: Any) -> tuple[FloatArray, ...]:
        some = [np.asarray(array, dtype=np.float64) for array in arrays]
        now = some[0].shape[:-1]
        found = function(*(one.reshape(math.prod(now), one.shape[-1]) for one in some))
        pairs = zip(found, shapes, strict=True)
        return tuple(answer.reshape(*now, *shape) for answer, shape in pairs)

    return jax.pure_callback(on_rows, wanted, *given, vmap_method="broadcast_all")


def _broadcast(exact: ExactMap, args: tuple[Any, ...], kwargs: dict[str, Any]) -> list[Any]:
    """Return the arguments as arrays of the same leading dimensions, or refuse them."""
    names = list(exact.takes)
    given = dict(zip(names, args, strict=False)) | kwargs
    if len(args) + len(kwargs) != len(names) or set(given) != set(names):
        told = ", ".join([*(str(i + 1) for i in range(len(args))), *kwargs]) or "none"
        raise TypeError(f"{exact.name} takes ({', '.join(names)}), got arguments {told}")
    arrays = [jnp.asarray(given[name], dtype=jnp.float64) for name in names]
    for name, array in zip(names, arrays, strict=True):
        size = exact.takes[name]
        if array.ndim == 0 or array.shape[-1] != size:
            raise ValueError(f"{name} must have shape (..., {size}), got {array.shape}")
    try:
        leading = jnp.broadcast_shapes(*(array.shape[:-1] for array in arrays))
    except ValueError:
        shapes = ", ".join(str(array.shape) for array in arrays)
        raise ValueError(
            f"leading dimensions of {', '.join(names)} must broadcast, got shapes {shapes}"
        ) from None
    return [jnp.broadcast_to(array, (*leading, array.shape[-1])) for array in arrays]
