"""Many runs that differ in parameters: on all cores, or on a cluster; restartable.

`cdcr.sweep` runs them, `METRICS` are the numbers that it keeps of each by name, `plot` draws
them, and `sobol_indices` tells which parameters matter.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from cdcr.base.extras import require
from cdcr.sweeps.indices import sobol_indices
from cdcr.sweeps.metrics import METRICS, RunMetric
from cdcr.sweeps.run import sweep

if TYPE_CHECKING:
    from cdcr.sweeps.figures import plot

__all__ = ["METRICS", "RunMetric", "plot", "sobol_indices", "sweep"]


def __getattr__(name: str) -> Any:
    """Load Matplotlib when a picture is asked for."""
    if name == "plot":
        require("matplotlib", "plot")
        from cdcr.sweeps.figures import plot

        return plot
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
