"""
Robots that are never quite as described
========================================

A robot built to a drawing differs from it: stiffness by some per cent, cables a little off their
radius, damping that nobody knows. Does a controller that was tuned on the drawing hold its robot?
Two thousand robots, each with numbers of its own, answer in one call.

Look at how far the angles of rest without a controller lie apart, and where those with it lie.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import cdcr

drawing = cdcr.robots.amouri2020(damping=0.01)
model = cdcr.Model(drawing)
section = drawing.sections[0]

# %%
# Two thousand robots
# -------------------
# Each number is drawn for each robot. Nothing is described twice: the paths are those of
# ``cdcr.sweep``.

N = 2000
rng = np.random.default_rng(1)
robots = {
    "sections.1.youngs_modulus": section.youngs_modulus * rng.normal(1.0, 0.05, N),
    "sections.1.cable_radius": section.cable_radius * rng.normal(1.0, 0.02, N),
    "sections.1.damping": section.damping * rng.uniform(0.5, 2.0, N),
}
STEP, STEPS = 0.02, 400

# %%
# Without a controller
# --------------------
# The tension that bends the robot of the drawing to 30 degrees.

target = np.array([np.radians(30.0), 0.0])
pull = model.allocate(model.potential_gradient(target))
still = [0.0, 0.0]
run = {"parameters": robots, "step": STEP, "steps": STEPS, "method": "dopri5", "rtol": 1e-6}
loose = cdcr.rollout(model, still, still, tension=pull, record_every=STEPS, **run)

# %%
# With one that was tuned on the drawing
# --------------------------------------

pid = cdcr.Pid(model, kp=0.3, ki=2.0, kd=0.05, period=STEP)
pid.reference = target
held = cdcr.rollout(model, still, still, controller=pid, record_every=2, **run)

apart = np.degrees(loose.q[:, -1, 0] - target[0])
second = np.searchsorted(held.t, 1.0)
left = np.degrees(np.linalg.norm(held.q - target, axis=2))  # of each robot at each time
print(f"{len(loose)} robots, {len(loose.failures) + len(held.failures)} runs failed")
print(f"without a controller: {np.std(apart):.2f} deg about 30 deg")
print(f"with it: at most {np.max(left[:, second]):.2f} deg off after 1 s, 0 in the end")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (one, all_of_them) = plt.subplots(1, 2, figsize=(9, 3.8))
one.hist(30.0 + apart, bins=60, color="0.6")
one.axvline(30.0, color="black", linewidth=1)
one.set(xlabel="angle of rest without a controller [deg]", ylabel="robots")
bands = np.degrees(np.quantile(held.q[:, :, 0], [0.0, 0.05, 0.5, 0.95, 1.0], axis=0))
all_of_them.fill_between(held.t, bands[0], bands[-1], alpha=0.2, label="all robots")
all_of_them.fill_between(held.t, bands[1], bands[-2], alpha=0.4, label="nine of ten")
all_of_them.plot(held.t, bands[2], label="median")
all_of_them.set(xlim=(0, 2), xlabel="time [s]", ylabel="angle with a controller [deg]")
all_of_them.legend(loc="lower right")
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
