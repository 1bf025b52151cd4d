"""Translation of the backbone: H1 and H2 (Fig. 2)."""

from cdcr.robots import amouri2020
from cdcr.scenarios.scenario import Scenario, paper_source

SCENARIO = Scenario(
    name="factors-backbone",
    title="Translation of the backbone: H₁ and H₂",
    description=(
        "H1 belongs to thetad^2 and H2 to phid^2 in the backbone's kinetic energy of translation, "
        "eq. (9). Eqs. (10) to (13) are printed correctly; cut after theta^4, H1 is good to "
        "0.045 % at 3 pi/5, H2 only to 12 %."
    ),
    source=paper_source("Fig. 2"),
    robot=amouri2020(),
)
