"""What a search for bending vectors found."""

from __future__ import annotations

from dataclasses import dataclass

from cdcr.base.arrays import FloatArray


@dataclass(frozen=True, eq=False, slots=True, repr=False)
class InverseKinematics:
    """Answer of `Model.inverse_kinematics`: cpp/README.md eq. (7), cpp/several-sections.md (48).

    Attributes
    ----------
    q : (d,) array
        Bending vectors [rad], always finite and within max_theta.
    position : (3,) array
        Tip position reached [m].
    rotation : (3, 3) array
        Tip orientation reached, a rotation matrix in the base frame.
    distance : float
        From the point asked for [m].
    angle : float
        From the orientation asked for [rad]; 0 where none was.
    residual : float
        What the search makes small, sqrt(distance^2 + (orientation_weight angle)^2) [m].
    reachable : bool
        Whether the residual is within the tolerance.
    seeds : int
        Starts tried; 0 for the closed form of one section.
    iterations : int
        Steps tried, from all starts together.
    message : str
        Why not, in one sentence; empty when reachable.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> goal = model.inverse_kinematics([0.5, 0.0, 0.9])
    >>> goal.reachable, round(goal.distance, 3)
    (False, 0.259)
    """

    q: FloatArray
    position: FloatArray
    rotation: FloatArray
    distance: float
    angle: float
    residual: float
    reachable: bool
    seeds: int
    iterations: int
    message: str

    def __repr__(self) -> str:
        q = ", ".join(f"{value:.6g}" for value in self.q)
        end = "reached" if self.reachable else f"not reached: {self.message}"
        return f"<InverseKinematics: q = [{q}], {end}>"
