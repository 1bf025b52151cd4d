"""
Two pulls that leave no swing
=============================

A pull of a cable, made at once, bends the arm and leaves it swinging for seconds. Another pull
first, for a part of a period, and the arm arrives at rest. Which one? Sensitivities say how the
state at the end changes with the tensions of each pull, so that a few steps of a search find it.

Look at the swing after the step, and at how quietly the arm ends under the two pulls.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import least_squares

import cdcr

model = cdcr.Model(cdcr.robots.amouri2020(damping=2e-4, gravity=(0, 0, 9.81), payload=0.02))
target = model.equilibrium([4.0, 2.0, 0.0])
hold = np.array([4.0, 2.0, 0.0])

# %%
# The first pull lasts 0.35 s, the second as long; then the arm is held where it should be.

t = np.linspace(0.0, 0.35, 71)
options = {"t": t, "method": "dop853", "rtol": 1e-9, "atol": 1e-10}
speed = np.sqrt(model.elastic_stiffness[0, 0] / model.mass_matrix(target)[0, 0])  # [1/s]


def end(pulls):
    """State after two pulls, and its derivatives by their tensions."""
    still = [0.0, 0.0]
    first = cdcr.simulate(
        model, still, still, tension=pulls[:3], sensitivities="tension", **options
    )
    start, by = (first.q[-1], first.qd[-1]), ["q0", "qd0", "tension"]
    second = cdcr.simulate(model, *start, tension=pulls[3:], sensitivities=by, **options)

    def both(run, name):
        return np.vstack([run.sensitivities[name][-1], run.rate_sensitivities[name][-1]])

    by_start = np.hstack([both(second, "q0"), both(second, "qd0")])  # the chain rule
    slopes = np.hstack([by_start @ both(first, "tension"), both(second, "tension")])
    return first, second, slopes


# %%
# Four numbers at the end shall be zero, and tensions as near to the last as they may.

near = 1e-3  # weight of that [rad/N]


def residuals(pulls):
    _, second, _ = end(pulls)
    miss = np.concatenate([second.q[-1] - target, second.qd[-1] / speed])
    return np.concatenate([miss, near * (pulls - np.tile(hold, 2))])


def jacobian(pulls):
    slopes = end(pulls)[2]
    slopes[2:] /= speed
    return np.vstack([slopes, near * np.eye(6)])


found = least_squares(residuals, np.tile(hold, 2) / 2, jacobian, bounds=(0.0, 12.0))
first, second, _ = end(found.x)
after = cdcr.simulate(
    model, second.q[-1], second.qd[-1], t=np.linspace(0, 1.3, 261), tension=hold, method="dop853"
)
step = cdcr.simulate(model, [0, 0], [0, 0], t=np.linspace(0, 2, 401), tension=hold)

swing = np.degrees(np.ptp(step.theta[step.t > 0.7]))
rest = np.degrees(np.ptp(after.theta))
print("pulls:", found.x[:3].round(2), "then", found.x[3:].round(2), "N")
print(f"found in {found.nfev} runs of {found.njev} with derivatives")
print(f"the arm swings by {swing:.1f} deg after the step, by {rest:.3f} deg after the two pulls")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (top, bottom) = plt.subplots(2, 1, sharex=True, figsize=(7, 5))
top.plot(step.t, np.degrees(step.theta), color="0.6", label="a step")
times = np.concatenate([first.t, second.t + 0.35, after.t + 0.7])
theta = np.concatenate([first.theta, second.theta, after.theta])
top.plot(times, np.degrees(theta), color="C0", label="two pulls")
top.axhline(np.degrees(cdcr.polar(target)[0]), color="black", linestyle=":", label="the place")
top.set(ylabel="bending angle [deg]", ylim=(-4, 17))
top.legend(loc="lower right", ncols=3)
for k in range(3):
    pull = np.repeat([found.x[k], found.x[3 + k], hold[k]], 2)
    bottom.plot([0, 0.35, 0.35, 0.7, 0.7, 2.0], pull, color=f"C{k}", label=f"cable {k + 1}")
bottom.set(xlabel="time [s]", ylabel="tension [N]", ylim=(-0.2, 5))
bottom.legend(loc="upper right", ncols=3)
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
