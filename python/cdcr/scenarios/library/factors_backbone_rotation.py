"""Rotation of the backbone: H3 and H4 (Fig. 3)."""

from cdcr.robots import amouri2020
from cdcr.scenarios.scenario import Scenario, paper_source

SCENARIO = Scenario(
    name="factors-backbone-rotation",
    title="Rotation of the backbone: H₃ and H₄",
    description=(
        "H3 belongs to thetad^2 and H4 to phid^2 in the backbone's kinetic energy of rotation, "
        "eq. (14). From eqs. (3) and (4) H3 is the constant 1/3; the printed eq. (25) varies, "
        "since a factor s/l was dropped when t_s was differentiated. Eq. (26) for H4 is correct."
    ),
    source=paper_source("Fig. 3"),
    robot=amouri2020(),
)
