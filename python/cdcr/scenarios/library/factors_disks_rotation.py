"""Rotation of the disks: H7 and H8 (Fig. 5)."""

from cdcr.robots import amouri2020
from cdcr.scenarios.scenario import Scenario, paper_source

SCENARIO = Scenario(
    name="factors-disks-rotation",
    title="Rotation of the disks: H₇ and H₈",
    description=(
        "H7 belongs to thetad^2 and H8 to phid^2 in the disks' kinetic energy of rotation, "
        "eq. (16), summed over ten disks. From eqs. (3) and (4) H7 is the constant 77/20; the "
        "printed eq. (29) varies. Eq. (30) for H8 is correct, but cut after theta^4 it is wrong by "
        "half at 3 pi/5; the paper, too, says that H8 stands out."
    ),
    source=paper_source("Fig. 5"),
    robot=amouri2020(),
)
