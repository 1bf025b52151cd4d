"""Controllers made with python-control and SciPy, extra ``control``, and PIQP, extra ``mpc``.

`Model.to_statespace` gives the linear system about a state.
"""

from cdcr.control._lqr import lqr
from cdcr.control._mpc import Mpc
from cdcr.control._nonlinear import nonlinear_system

__all__ = ["Mpc", "lqr", "nonlinear_system"]
