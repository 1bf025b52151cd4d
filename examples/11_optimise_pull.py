"""
Optimise a pull with SciPy
==========================

How should a cable be pulled so that the robot, from straight and at rest, arrives at 25 degrees
after half a second and stands still? SciPy's SLSQP varies the tension at eleven times; the run says
where the robot ends. Of all pulls that arrive, the smoothest is sought.

Look at what follows the half second: nothing moves. The same tension all at once leaves a swing of
25 degrees to both sides.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import minimize

import cdcr

model = cdcr.Model(cdcr.robots.amouri2020())  # without damping: a swing would stay

# %%
# The task
# --------

DURATION = 0.5  # [s]
knots = np.linspace(0.0, DURATION, 11)
goal = np.array([np.deg2rad(25.0), 0.0])
hold = model.allocate(model.potential_gradient(goal))[0]  # [N], on cable 1


def table(pull):
    """Tensions of all cables over time: lines from knot to knot, then hold."""
    return knots, np.column_stack([pull, np.zeros((knots.size, 2))])


def miss(pull):
    """Bending angle [rad] and rate [rad/s] by which the end misses the goal."""
    t = [0.0, DURATION]
    run = cdcr.simulate(model, [0, 0], [0, 0], t=t, tension=table(pull), method="dopri5")
    return [run.q[-1, 0] - goal[0], run.qd[-1, 0]]


# %%
# The optimisation
# ----------------
# It begins with a ramp. The first tension is zero and the last one holds the goal, so that nothing
# jumps; in between a cable can pull and not push.

ramp = np.linspace(0.0, hold, knots.size)
found = minimize(
    lambda pull: np.sum(np.diff(pull) ** 2),
    ramp,
    method="SLSQP",
    bounds=[(0.0, 0.0), *[(0.0, 20.0)] * 9, (hold, hold)],
    constraints={"type": "eq", "fun": miss},
)
pull = found.x
print(f"{found.message}, after {found.nit} iterations")
rate = np.abs(np.diff(pull) / np.diff(knots)).max()
print(f"hold: {hold:.2f} N, fastest change on the way: {rate:.1f} N/s")

# %%
# The proof
# ---------
# Two more seconds under the tension that holds.

t = np.linspace(0.0, 2.5, 501)
at_once = cdcr.simulate(model, [0, 0], [0, 0], t=t, tension=[hold, 0, 0])
optimal = cdcr.simulate(model, [0, 0], [0, 0], t=t, tension=table(pull))
swing = {
    name: np.degrees(np.abs(run.q[t >= DURATION, 0] - goal[0]).max())
    for name, run in (("all at once", at_once), ("optimised", optimal))
}
for name, size in swing.items():
    print(f"{name}: swing of {size:.4f} deg is left")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (top, bottom) = plt.subplots(2, 1, sharex=True, figsize=(7, 5))
for name, run in (("all at once", at_once), ("optimised", optimal)):
    top.plot(t, np.degrees(run.q[:, 0]), label=name)
    bottom.plot(t, run.tension[:, 0])
bottom.plot(knots, pull, ".", color="C1")
top.axvline(DURATION, color="0.5", linestyle="--")
top.set(ylabel="bending angle [deg]", ylim=(-3, 65))
bottom.set(xlabel="time [s]", ylabel="tension of cable 1 [N]")
top.legend(loc="upper right", ncols=2)
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
