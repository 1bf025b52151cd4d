"""
A loop at 1 kHz
===============

``Simulator`` stands where the real robot will stand: once each period the loop reads the state,
computes tensions and hands them over. It keeps no record and integrates by fixed steps, so that a
period always costs the same. ``examples/cpp/control_loop.cpp`` is the same loop in C++.

Look at the second second: somebody pushes the tip, and the loop holds against it.
"""

import sys
import time

import matplotlib.pyplot as plt
import numpy as np

import cdcr

model = cdcr.Model(cdcr.robots.amouri2020(gravity=(0, 0, -9.81), damping=5e-3))
PERIOD = 1e-3  # [s]

# %%
# What to hold
# ------------

goal = cdcr.bending(np.deg2rad(30.0), 0.0)
hold = model.potential_gradient(goal)  # [N m]
KP, KD = 2.0, 0.3  # [N m/rad], [N m s/rad]
push = cdcr.Wrench(section=0, force=(0.0, 0.5, 0.0))  # at the tip [N]

# %%
# The loop
# --------
# A loop with a real robot would wait for its clock once a period.

simulator = cdcr.Simulator(model, step=PERIOD)
simulator.reset(goal, [0.0, 0.0])
log, cost = [], []
for k in range(3000):
    start = time.perf_counter()
    moment = hold + KP * (goal - simulator.q) - KD * simulator.qd
    tension = model.allocate(moment, min_tension=0.5)
    status = simulator.step(tension, push if 1000 <= k < 2000 else ())
    cost.append(time.perf_counter() - start)
    if status is not cdcr.Status.ok:
        raise SystemExit(f"period {k}: {status}")
    log.append([simulator.time, *simulator.q, *tension])
t, q, tension = np.split(np.array(log), [1, 3], axis=1)

# %%
# What it did, and how long it took
# ---------------------------------

off = np.degrees(q - goal)
print(f"pushed: {np.hypot(*off[1999]):.3f} deg off; a second later: {np.hypot(*off[-1]):.4f} deg")
print(f"largest tension: {tension.max():.2f} N")
print(f"a period took {1e6 * np.median(cost):.0f} us of the 1000 us that it has (median)")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (top, bottom) = plt.subplots(2, 1, sharex=True, figsize=(7, 5))
for axes in (top, bottom):
    axes.axvspan(1.0, 2.0, color="0.92")
top.plot(t, off, label=["x", "y"])
top.set(ylabel="off its goal [deg]")
top.legend(title="component", loc="upper right")
bottom.plot(t, tension, label=["cable 1", "cable 2", "cable 3"])
bottom.set(xlabel="time [s] (shaded: 0.5 N on the tip)", ylabel="tension [N]")
bottom.legend(loc="upper right")
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
