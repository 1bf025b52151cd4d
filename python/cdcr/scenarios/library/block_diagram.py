"""How data flow through the library, in place of the paper's Simulink diagram (Fig. 11)."""

from cdcr.robots import amouri2020
from cdcr.scenarios.scenario import Scenario, paper_source

SCENARIO = Scenario(
    name="block-diagram",
    title="How data flow: forward, inverse, and in a loop",
    description=(
        "The paper's Fig. 11 is its Simulink model. In its place, this is the flow of data in this "
        "library: tensions make the robot move (forward dynamics), a motion asks for tensions "
        "(inverse dynamics), and a controller closes the loop."
    ),
    source=paper_source("section 5.3 and Fig. 11") + "; diagram ours",
    robot=amouri2020(),
)
