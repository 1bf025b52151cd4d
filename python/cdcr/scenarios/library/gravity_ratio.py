"""What gravity does to the robot (Fig. 7)."""

from cdcr.robots import amouri2020
from cdcr.scenarios.scenario import Scenario, paper_source

SCENARIO = Scenario(
    name="gravity-ratio",
    title="Gravitational over elastic energy, and what gravity does to the equilibrium at 5 N",
    description=(
        "The paper neglects gravity, finding its energy below 0.27 % of the elastic one. With the "
        "masses of Table 1 and g = 9.81 m/s^2 it is 23.8 % near straight and 21.0 % at 3 pi/5, "
        "so 0.27 was perhaps a ratio, read as per cent. Under 5 N on cable 1 the robot bends by "
        "14.98 deg without gravity, about 20 deg standing upright and 12 deg hanging."
    ),
    source=paper_source("section 4.2 and Fig. 7"),
    robot=amouri2020(),
)
