"""Controllers designed with what others have: python-control and SciPy. Extra ``control``.

`Model.to_statespace` gives the linear system about a state.
"""

from cdcr.control._lqr import lqr
from cdcr.control._nonlinear import nonlinear_system

__all__ = ["lqr", "nonlinear_system"]
