"""Rollouts of more motions than fit into memory, written as they are done."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.arrays import finite
from cdcr.base.check import Check
from cdcr.base.extras import require
from cdcr.files.new_file import file_path
from cdcr.files.new_folder import new_folder
from cdcr.model.model import Model
from cdcr.runs.rollout import rollout
from cdcr.runs.rollout_result import Rollout
from cdcr.runs.stats import STATS, total

ZARR_FORMAT = 2  # in which strings are specified
_STATUS = f"<U{max(len(name) for name in _core.Status.__members__)}"


def rollout_to_zarr(
    path: str | PathLike[str],
    model: Model | Sequence[Model],
    q0: ArrayLike,
    qd0: ArrayLike,
    tension: ArrayLike | None = None,
    *,
    chunk: int = 4096,
    overwrite: bool = False,
    **options: Any,
) -> Path:
    """Run many motions as `rollout` does, and write them to Zarr, so many at a time.

    Memory is needed for one chunk, not for all. The folder is what `Rollout.to_xarray` of all of
    them would give: ``xarray.open_zarr(path)`` reads of it what is used. It appears when it is
    complete; Ctrl-C and other signals leave nothing.

    Parameters
    ----------
    path : path-like
        The folder, ending in ``.zarr``, in one that exists. Needs the extra ``zarr``.
    model, q0, qd0, tension
        As in `rollout`.
    chunk : int, optional
        Motions that are run and written together.
    overwrite : bool, optional
        Whether an existing folder may be replaced.
    **options
        The other arguments of `rollout`. A function as controller sees the motions of a chunk.

    Returns
    -------
    Path
        The folder.

    Raises
    ------
    ValueError
        For another suffix, and as `rollout` does.
    FileExistsError
        If the folder exists and ``overwrite`` is false.
    FileNotFoundError
        If the one that it goes into is missing.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import numpy as np
    >>> import xarray
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> pulls = np.linspace(0.0, 5.0, 1000)[:, None] * [1.0, 0.0, 0.0]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = cdcr.rollout_to_zarr(
    ...         Path(folder) / "runs.zarr", model, [0, 0], [0, 0], tension=pulls,
    ...         step=1e-3, steps=1000, record_every=100, chunk=256,
    ...     )
    ...     xarray.open_zarr(path).q.isel(time=-1).shape
    (1000, 1, 2)
    """
    require("zarr", "zarr")
    check = Check()
    size = check.whole("chunk", chunk, "a whole number >= 1", low=1)
    check.done()
    folder = file_path(path)
    if folder.suffix != ".zarr":
        raise ValueError(f"the folder's name must end in .zarr, got {folder.name!r}")
    with new_folder(folder, overwrite=overwrite) as part:
        done = 0
        costs, failures = [], []
        whole = {"q0": q0, "qd0": qd0, "tension": tension, **options}
        for given in _chunks(size, model, whole):
            runs = rollout(**given)
            if any(one.status is _core.Status.interrupted for one in runs.failures):
                raise KeyboardInterrupt
            _append(runs, part, done, size)
            failures += [[done + one.motion, one.status.name, one.message] for one in runs.failures]
            costs.append(runs.stats)
            done += len(runs)
        cost = {name: getattr(total(costs), name) for name in STATS}
        _note(part, {"failures": json.dumps(failures), **cost})
    return folder


def _chunks(
    size: int, model: Model | Sequence[Model], options: Mapping[str, Any]
) -> Iterator[dict[str, Any]]:
    """Yield the arguments of each chunk: what there is of each motion in parts, the rest whole."""
    given = options.get("parameters")
    parameters = {
        name: finite(values, f"parameters[{name!r}]")
        for name, values in (given.items() if isinstance(given, Mapping) else ())
    }
    arrays = {
        name: finite(options[name], name)
        for name in ("q0", "qd0", "tension", "command")
        if options.get(name) is not None and not callable(options[name])
    }
    lists = {
        name: things
        for name, things in (("model", model), ("controller", options.get("controller")))
        if isinstance(things, Sequence)
    }
    several = [len(one) for one in lists.values()]
    several += [len(one) for one in parameters.values() if one.ndim > 0]
    several += [len(one) for one in arrays.values() if one.ndim > 1]
    count = next((size for size in several if size != 1), 1)

    for first in range(0, max(count, 1), size):
        chosen = slice(first, first + size)
        part = {"model": model, **options}
        part |= {
            name: one[chosen] if one.ndim > 1 and len(one) == count else one
            for name, one in arrays.items()
        }
        part |= {name: one[chosen] if len(one) == count else one for name, one in lists.items()}
        if parameters:
            part["parameters"] = {
                name: one[chosen] if one.ndim and len(one) == count else one
                for name, one in parameters.items()
            }
        yield part


def _append(runs: Rollout, part: Path, first: int, chunk: int) -> None:
    data = runs.to_xarray()
    data = data.assign_coords(motion=data.motion + first)
    data["status"] = data.status.astype(_STATUS)
    if first > 0:
        data.to_zarr(part, append_dim="motion")
        return
    sizes = {name: [chunk, *one.shape[1:]] for name, one in data.items()}
    encoding = {str(name): {"chunks": shape} for name, shape in sizes.items()}
    data.to_zarr(part, zarr_format=ZARR_FORMAT, encoding=encoding)


def _note(part: Path, attributes: Mapping[str, Any]) -> None:
    """Write what is known of all motions, where each chunk has written what it knew."""
    zarr: Any = require("zarr", "zarr")
    group = zarr.open_group(part, mode="a")
    group.attrs.update(attributes)
    zarr.consolidate_metadata(part)
