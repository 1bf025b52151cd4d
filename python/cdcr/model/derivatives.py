"""How accelerations change with all they depend on."""

from __future__ import annotations

from typing import NamedTuple

from cdcr.base.arrays import FloatArray


class Derivatives(NamedTuple):
    """Answer of `Model.derivatives`: cpp/derivatives.md eq. (71).

    Attributes
    ----------
    dqdd_dq : (..., d, d) array
        Of the accelerations, in rows, by the coordinates [1/s^2].
    dqdd_dqd : (..., d, d) array
        By their rates [1/s].
    dqdd_dtension : (..., d, num_cables) array
        By the tensions [rad/(s^2 N)]; by lengths [rad/(s^2 m)] for cables driven by length.
    dqdd_dwrench : (..., d, k, 6) array
        By force [N] and moment [N m] of each of the k wrenches, in its own frame.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.three_sections())
    >>> push = cdcr.Wrench(section=2, force=(0.0, 0.0, 0.0))
    >>> slopes = model.derivatives([0.3] * 6, [0.0] * 6, [1.0] * 9, push)
    >>> [slope.shape for slope in slopes]
    [(6, 6), (6, 6), (6, 9), (6, 1, 6)]
    """

    dqdd_dq: FloatArray
    dqdd_dqd: FloatArray
    dqdd_dtension: FloatArray
    dqdd_dwrench: FloatArray

    def __repr__(self) -> str:
        """Say the shapes."""
        shapes = ", ".join(f"{name} {array.shape}" for name, array in self._asdict().items())
        return f"<Derivatives: {shapes}>"
