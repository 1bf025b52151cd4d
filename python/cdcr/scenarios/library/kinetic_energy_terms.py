"""The inertias M11 and M22, whole and cut after theta^4 (Fig. 6)."""

from cdcr.robots import amouri2020
from cdcr.scenarios.scenario import Scenario, paper_source

SCENARIO = Scenario(
    name="kinetic-energy-terms",
    title="Terms of the kinetic energy: M₁₁ and M₂₂, exact and cut after θ⁴",
    description=(
        "Twice the kinetic energy is M11 thetad^2 + M22 phid^2, eq. (21) with the factors of "
        "eq. (9) and the masses of Table 1. The paper finds Taylor polynomials good to 0.05 %: "
        "that holds, nearly, for M11 (0.056 % at 3 pi/5), but M22 is 13.8 % too small there, or "
        "12.6 % in eq. (21) as printed, which lacks the 1/3 and 1/4 of eq. (9)."
    ),
    source=paper_source("section 4.1.4 and Fig. 6"),
    robot=amouri2020(),
)
