"""Translation of the disks: H5 and H6 (Fig. 4)."""

from cdcr.robots import amouri2020
from cdcr.scenarios.scenario import Scenario, paper_source

SCENARIO = Scenario(
    name="factors-disks",
    title="Translation of the disks: H₅ and H₆",
    description=(
        "H5 belongs to thetad^2 and H6 to phid^2 in the disks' kinetic energy of translation, "
        "eq. (15), summed over ten disks. The printed eqs. (27) and (28) give exactly half of what "
        "eq. (15) needs; (28) also lacks a cosine, put back here."
    ),
    source=paper_source("Fig. 4"),
    robot=amouri2020(),
)
