"""Rollouts of more motions than fit into memory, written as they are done."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.arrays import finite
from cdcr.base.check import Check
from cdcr.base.extras import require
from cdcr.files.new_file import file_path
from cdcr.files.new_folder import new_folder
from cdcr.model.model import Model
from cdcr.runs.rollout import agree, rollout
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
        The other arguments of `rollout`. A function as controller sees the motions of a chunk;
        ``progress`` is told of all chunks together.

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
        whole = {"model": model, "q0": q0, "qd0": qd0, "tension": tension, **options}
        for given in _chunks(size, whole):
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


def _chunks(size: int, whole: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield the arguments of each chunk: what there is of each motion in parts, the rest whole."""
    given = dict(whole)
    if isinstance(given.get("wrenches"), Iterable):
        given["wrenches"] = tuple(given["wrenches"])  # each chunk goes through them
    sizes = {}
    for name in ("q0", "qd0", "tension", "command"):
        if given.get(name) is not None and not callable(given[name]):
            given[name] = finite(given[name], name)
            sizes[name] = len(given[name]) if given[name].ndim > 1 else 1
    for name in ("model", "controller"):
        if isinstance(given.get(name), Sequence):
            sizes[name] = len(given[name])
    of_each = given.get("parameters")
    if isinstance(of_each, Mapping):
        of_each = {name: finite(one, f"parameters[{name!r}]") for name, one in of_each.items()}
        given["parameters"] = of_each
        sizes |= {f"parameters[{name!r}]": np.size(one) for name, one in of_each.items()}
    count = agree(**sizes)
    told = given.get("progress")
    for first in range(0, max(count, 1), size):
        cut = partial(_cut, count=count, part=slice(first, first + size))
        part = given | {
            name: cut(given[name]) for name in sizes if sizes[name] > 1 and name in given
        }
        if isinstance(of_each, Mapping):
            part["parameters"] = {name: cut(one) for name, one in of_each.items()}
        if callable(told):
            part["progress"] = partial(_tell, told, first)
        yield part


def _cut(things: Any, count: int, part: slice) -> Any:
    """Return a part of what there is of each motion, or what is of all of them."""
    return things[part] if count != 1 and np.ndim(things) > 0 and len(things) == count else things


def _tell(progress: Callable[[int], object], before: int, ended: int) -> None:
    """Tell how many motions have ended in this chunk and those before."""
    progress(before + ended)


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
