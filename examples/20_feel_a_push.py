"""
Feel a push
===========

Something pushes the tip of an arm while it moves. No sensor sees it, but the motion does: where
accelerations are not those of the model, a force is missing. Accelerations are linear in wrenches,
so that their derivatives at each sampled state, all in one call, give the force that is.

Look at the push as it was and as it is felt: it comes and goes with no delay, since no filter is
needed where the slopes are exact.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import cdcr

model = cdcr.Model(cdcr.robots.three_sections(gravity=(0, 0, -9.81)))

# %%
# What happens
# ------------
# The arm, bent by one cable, swings under three; on the way a push comes and goes.
# Straight, it would not feel a push along itself.

t = np.linspace(0.0, 2.0, 2001)
tension = [4.0, 0, 0, 2.0, 0, 0, 1.0, 0, 0]
size = np.array([0.1, -0.2, 0.05])  # [N]
times = np.linspace(0.5, 1.5, 101)
course = np.sin(np.pi * (times - 0.5)) ** 2
push = cdcr.Wrench(section=2, force=tuple(size), profile=(times, course))
bent = model.equilibrium([4.0, *[0.0] * 8])
run = cdcr.simulate(
    model, bent, np.zeros(6), t=t, tension=tension, wrenches=push, method="dopri5", rtol=1e-9
)

# %%
# What is measured
# ----------------
# Shapes and rates, once a millisecond; accelerations are differences of the rates.

qdd = np.gradient(run.qd, t, axis=0, edge_order=2)

# %%
# What is felt
# ------------
# The force that explains best what the model does not.

slopes = model.derivatives(run.q, run.qd, tension, cdcr.Wrench(section=2)).dqdd_dwrench
by_force = slopes[:, :, 0, :3]  # of each state, accelerations by the force at the tip
missing = qdd - model.forward_dynamics(run.q, run.qd, tension)
felt = np.squeeze(np.linalg.pinv(by_force) @ missing[:, :, None], axis=2)

true = np.outer(np.interp(t, times, course), size)
error = np.linalg.norm(felt - true, axis=1)
print(f"largest push: {np.linalg.norm(true, axis=1).max():.3f} N")
print(f"felt within {1e3 * error[1:-1].max():.1f} mN at every millisecond")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (top, bottom) = plt.subplots(2, 1, sharex=True, figsize=(7, 5))
top.plot(t, 1e3 * run.tip, label=["x", "y", "z"])
top.set(ylabel="tip [mm]", ylim=(-700, 900))
top.legend(loc="upper right", ncols=3)
for k, name in enumerate("xyz"):
    bottom.plot(t, felt[:, k], color=f"C{k}", label=f"{name}, felt")
    bottom.plot(t, true[:, k], color="black", linestyle=":", label="true" if k == 2 else None)
bottom.set(xlabel="time [s]", ylabel="force at the tip [N]")
bottom.legend(loc="lower right", ncols=2)
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
