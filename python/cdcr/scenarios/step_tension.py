"""The paper's first forward dynamic response (Fig. 9)."""

from cdcr.robots import amouri2020
from cdcr.scenarios._scenario import Scenario

SCENARIO = Scenario(
    name="step-tension",
    title="5 N on cable 1 of the straight robot at rest",
    description=(
        "The robot of Table 1 stands straight and at rest; from t = 0 on, cable 1 pulls with 5 N. "
        "The equations of the paper have no damping, so the robot swings about its static "
        "equilibrium of 14.98 deg for ever, between straight and twice that angle. In the paper's "
        "Fig. 9 it settles, at 15.53 deg, which these equations cannot give. phi stays 0."
    ),
    source="Amouri, Mahfoudi, Zaatri (2020), section 5.2 and Fig. 9, doi 10.46604/ijeti.2020.4422",
    paper_figure=9,
    robot=amouri2020(),
    q0=(0.0, 0.0),
    qd0=(0.0, 0.0),
    tension=(5.0, 0.0, 0.0),
    t_end=10.0,
    num_samples=1001,
)
