"""Small vibrations about a shape."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cdcr.base.arrays import FloatArray

if TYPE_CHECKING:
    from cdcr.model.model import Model


@dataclass(frozen=True, eq=False, repr=False)
class Modes:
    """Answer of `Model.modes`: cpp/several-sections.md eqs. (44), (45).

    Attributes
    ----------
    model : Model
        The robot.
    q : (..., d) array
        The shape it vibrates about [rad].
    frequency : (..., d) array
        Natural frequencies of the undamped robot, increasing [rad/s]; 0 where the robot does not
        come back.
    squared_frequency : (..., d) array
        Their squares [rad^2/s^2], negative in the directions in which the robot is unstable.
    shape : (..., d, d) array
        A mode shape in each column, of unit modal mass: shape.T @ M @ shape = 1 [rad/(m sqrt(kg))].
    damping_ratio : (..., d) array
        Of each mode alone, 1 is critical; 0 where the frequency is 0 [-].
    eigenvalues : (..., 2d) complex array
        Of the damped robot, couplings of the modes included, by magnitude [1/s].
    stable : bool or (...) array of bool
        Whether every small motion stays small.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
    >>> modes = model.modes([0.0, 0.0], [0.0, 0.0, 0.0])
    >>> modes.frequency_hz.round(3), modes.damping_ratio.round(3)
    (array([1.448, 1.448]), array([0.125, 0.125]))
    """

    model: Model
    q: FloatArray
    frequency: FloatArray
    squared_frequency: FloatArray
    shape: FloatArray
    damping_ratio: FloatArray
    eigenvalues: NDArray[np.complex128]
    stable: bool | NDArray[np.bool_]

    @property
    def frequency_hz(self) -> FloatArray:
        """Natural frequencies (..., d) [Hz]."""
        return self.frequency / (2.0 * math.pi)

    @property
    def damped_frequency(self) -> FloatArray:
        """Frequencies (..., 2d) of the damped robot, one of each eigenvalue [rad/s]."""
        return np.abs(self.eigenvalues.imag)

    @property
    def decay_rate(self) -> FloatArray:
        """Rates (..., 2d) at which these motions decay, one of each eigenvalue [1/s]."""
        return -self.eigenvalues.real

    def plot(self, count: int = 4, **options: Any) -> Any:
        """Draw the first modes. Needs the extra ``plot``.

        Parameters
        ----------
        count : int
            Modes to draw at most, the slowest first.
        **options
            As in `cdcr.plotting.plot_modes`.

        Returns
        -------
        Figure

        Examples
        --------
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.three_sections())
        >>> len(model.modes([0.0] * 6, [0.0] * 9).plot(count=2).axes)
        2
        """
        from cdcr.plotting import plot_modes

        return plot_modes(self, count, **options)

    def __repr__(self) -> str:
        if self.frequency.ndim > 1:
            return f"<Modes at shapes of leading dimensions {self.frequency.shape[:-1]}>"
        shown = ", ".join(f"{f:.4g}" for f in self.frequency_hz[:4])
        more = ", ..." if len(self.frequency) > 4 else ""
        return f"<Modes at {shown}{more} Hz, {'' if self.stable else 'not '}stable>"
