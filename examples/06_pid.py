"""
PID
===

A sampled PID loop on the bending vector: ``Pid`` turns the error into a moment and shares it out
over the cables within their limits. It feeds forward what its model needs at the reference, and the
robot here carries 30 g that this model does not know.

Look at the end of the curves: without its integral the loop leaves an error, with it none.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import cdcr

# %%
# The robot and what the controller knows of it
# ---------------------------------------------

weight = (0.0, 0.0, -9.81)
known = cdcr.Model(cdcr.robots.amouri2020(gravity=weight, damping=5e-3))
real = cdcr.Model(cdcr.robots.amouri2020(gravity=weight, damping=5e-3, payload=0.03))

# %%
# The loop
# --------
# 100 times a second, each tension between 0.2 and 30 N. A controller makes the method of
# integration begin anew each period: ``"dopri5"`` does that at least cost.

goal = cdcr.bending(np.pi / 4, np.pi / 6)  # 45 deg, towards a place between cables 1 and 2
t = np.linspace(0.0, 6.0, 1201)
runs = {}
for name, ki in (("kp, kd", 0.0), ("kp, ki, kd", 2.0)):
    pid = cdcr.Pid(known, kp=1.0, ki=ki, kd=0.25, period=0.01, min_tension=0.2, max_tension=30.0)
    pid.reference = goal
    runs[name] = cdcr.simulate(real, [0, 0], [0, 0], t=t, controller=pid, method="dopri5")

# %%
# What it reaches
# ---------------

tip = real.tip(goal)[1]
distance = {name: 1e3 * np.linalg.norm(run.tip - tip, axis=1) for name, run in runs.items()}
for name, off in distance.items():
    late = t[np.nonzero(off > 5.0)[0][-1]]
    arrived = f"within 5 mm after {late:.2f} s" if late < t[-1] else "never within 5 mm"
    print(f"{name}: tip {off[-1]:.3f} mm off at the end, {arrived}")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
for name, run in runs.items():
    left.plot(t, np.degrees(run.theta), label=name)
left.axhline(45.0, color="0.5", linestyle="--", label="goal")
left.set(xlabel="time [s]", ylabel="bending angle [deg]")
left.legend()
for j, pull in enumerate(runs["kp, ki, kd"].tension.T):
    right.plot(t, pull, label=f"cable {j + 1}", drawstyle="steps-post")
right.set(xlabel="time [s]", ylabel="tension with kp, ki, kd [N]", xlim=(0, 3))
right.legend()
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
