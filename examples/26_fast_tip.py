"""
The fastest tip: tensions over time by a gradient
=================================================

How fast can the tip be after half a second, with no cable pulled by more than 2 N? A constant pull
swings the arm once. To do better each cable has its own tension in each hundredth of a second: 300
numbers. The gradient of the speed by all of them comes from one way back through the motion.

Look at the tensions found: nearly all are at a bound, as optimal control has it of such problems;
the arm swings to and fro before.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import minimize

import cdcr

part = cdcr.robots.amouri2020(damping=1e-4).sections[0]
model = cdcr.Model(cdcr.Robot(sections=[part, part], gravity=(0, 0, 9.81), payload=0.01))
largest, steps, held = 2.0, 500, 10  # [N]; steps of a millisecond, and for how many tensions hold
rest = np.zeros(4)
motion_options = {"step": 1e-3, "steps": steps, "record_every": held}


# %%
# The cost is the speed of the tip along x at the end, J qd, less a little for bending too far. Its
# derivative by the coordinates needs that of the Jacobian.


def cost(motion):
    q, qd = motion.q[-1], motion.qd[-1]
    by_q, by_qd = np.zeros_like(motion.q), np.zeros_like(motion.q)
    by_qd[-1] = -model.tip_jacobian(q)[0]
    by_q[-1] = -model.tip_hessian(q)[0].T @ qd
    far = np.maximum(np.abs(motion.q) - 2.0, 0.0)  # [rad]
    by_q += 2 * far * np.sign(motion.q)
    return by_qd[-1] @ qd + (far**2).sum(), {"q": by_q, "qd": by_qd}


def value(pulls):
    tension = np.repeat(pulls.reshape(-1, 6), held, axis=0)
    found = cdcr.gradient(model, rest, rest, tension, cost, **motion_options)
    return found.value, found.tension.reshape(-1, held, 6).sum(axis=1).ravel()


# %%
# From a constant pull of half of what is allowed.

start = np.tile([largest / 2, 0, 0, largest / 2, 0, 0], steps // held)
search = minimize(
    value, start, jac=True, method="L-BFGS-B", bounds=[(0, largest)] * start.size,
    options={"maxiter": 40},
)  # fmt: skip
pulls = search.x.reshape(-1, 6)

# %%
# The motions, by a method of their own.

t = np.linspace(0, 0.5, 251)
table = cdcr.TensionTable(np.arange(steps // held) * held * 1e-3, pulls, "previous")
swing = cdcr.simulate(model, rest, rest, t=t, tension=table)
once = cdcr.simulate(model, rest, rest, t=t, tension=[largest, 0, 0, largest, 0, 0])


def speed(run):
    return np.einsum("rd,rd->r", model.tip_jacobian(run.q)[:, 0], run.qd)


best = speed(swing)[-1]
bound = np.mean((pulls < 1e-3) | (pulls > largest - 1e-3))
print(
    f"speed of the tip: {best:.2f} m/s; under a constant pull {speed(once).max():.2f} m/s at most"
)
print(f"{search.nfev} gradients by {start.size} tensions; {bound:.0%} of these are at a bound")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (top, bottom) = plt.subplots(2, 1, sharex=True, figsize=(7, 5), layout="constrained")
top.plot(t, speed(once), color="0.6", label="a constant pull")
top.plot(t, speed(swing), color="C0", label="tensions found")
top.set(ylabel="speed of the tip [m/s]")
top.legend()
image = bottom.imshow(
    pulls.T, aspect="auto", extent=(0, 0.5, 6.5, 0.5), cmap="viridis", interpolation="nearest"
)
bottom.set(xlabel="time [s]", ylabel="cable", yticks=range(1, 7))
bottom.grid(visible=False)
fig.colorbar(image, ax=[top, bottom], label="tension [N]")
cdcr.plotting.show_or_save(fig, sys.argv[1:])
