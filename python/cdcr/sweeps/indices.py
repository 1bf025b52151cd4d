"""Sobol indices of a sweep: what share of the scatter of a metric each parameter makes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr.base.extras import require
from cdcr.sweeps.result import metric_names, parameter_names, require_sweep

if TYPE_CHECKING:
    import xarray


def sobol_indices(result: xarray.Dataset) -> xarray.Dataset:
    """Return the Sobol indices of each metric of a sweep over samples "saltelli:N".

    Parameters
    ----------
    result : Dataset
        What `cdcr.sweep` returned, or a file of it.

    Returns
    -------
    xarray.Dataset
        ``first_order`` and ``total_order`` (metric, parameter) [1]: the share of a metric's
        variance that a parameter makes by itself, and with all others together. By
        `scipy.stats.sobol_indices`; NaN where any run has no value of the metric, or all the same.

    Raises
    ------
    ValueError
        For a sweep over other samples.
    TypeError
        For what is no sweep.

    Examples
    --------
    >>> import cdcr
    >>> found = cdcr.sweep(
    ...     "step-tension",
    ...     {"payload": (0.0, 0.02), "tension.1": (2.0, 6.0)},
    ...     samples="saltelli:8",
    ...     metrics="peak_theta",
    ...     jobs=1,
    ... )
    >>> matters = cdcr.sweeps.sobol_indices(found).total_order.sel(metric="peak_theta")
    >>> ["payload", "tension.1"][int(matters.values.argmax())]
    'tension.1'
    """
    require_sweep(result)
    stats: Any = require("scipy.stats", "sweep")
    xr: Any = require("xarray", "sweep")
    parameters = parameter_names(result)
    kind = result.attrs.get("samples")
    if kind != "saltelli":
        raise ValueError(f"Sobol indices need samples 'saltelli:N', and this sweep is of {kind!r}")
    metrics = metric_names(result)
    number = result.sizes["run"] // (len(parameters) + 2)
    found = np.full((2, len(metrics), len(parameters)), np.nan)
    for i, name in enumerate(metrics):
        values = result[name].values.reshape(-1, 1, number)  # of A, B, and A with each from B
        if np.ptp(values) == 0.0 or not np.all(np.isfinite(values)):
            continue  # no variance to share out
        if len(parameters) == 1:
            found[:, i] = 1.0  # all of it is that of the one, which SciPy does not take
        else:
            parts = {"f_A": values[0], "f_B": values[1], "f_AB": values[2:]}
            indices = stats.sobol_indices(func=parts, n=number)
            found[:, i] = np.atleast_1d(indices.first_order), np.atleast_1d(indices.total_order)
    dims = ("metric", "parameter")
    about = {"first_order": "by itself", "total_order": "with all others"}
    data = {
        key: (dims, values, {"units": "1", "long_name": f"share of the variance, {words}"})
        for (key, words), values in zip(about.items(), found, strict=True)
    }
    dataset: xarray.Dataset = xr.Dataset(data, {"metric": metrics, "parameter": parameters})
    return dataset
