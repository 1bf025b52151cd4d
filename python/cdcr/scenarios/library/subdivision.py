"""One section cut into more and more parts: towards the beam it stands for."""

from cdcr.robots import amouri2020
from cdcr.scenarios.scenario import Scenario, paper_source

SCENARIO = Scenario(
    name="subdivision",
    title="One section cut into parts of constant curvature approaches the beam",
    description=(
        "A section of constant curvature can bend in one way only, so it vibrates 25 % faster "
        "than the beam it stands for, and has no second mode at all. Cut into parts, each of "
        "constant curvature, the robot of Table 1 comes near: two parts are 5 % off, four 1 %. "
        "The beam here is the same robot in the limit of many parts, extrapolated from 16 and 32. "
        "The responses to a step of 5 N on cable 1 are lightly damped."
    ),
    source=paper_source("Table 1") + "; parts, damping and step ours",
    robot=amouri2020(),
)
