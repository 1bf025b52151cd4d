"""
LQR with python-control
=======================

Nine cables hold three sections against gravity; a knock sets them swinging. ``cdcr.control.lqr``
gives the gain that brings the robot back with little extra tension, and ``Model.to_statespace`` the
linear system about the shape, as python-control takes it.

Look at the tip: without control it swings on for seconds, with it the knock is over in one swing,
and the linear system of python-control says so beforehand.
"""

import sys

import control
import matplotlib.pyplot as plt
import numpy as np

import cdcr

# %%
# The shape to hold
# -----------------
# Each cable with at least 1 N, so that feedback may take some away.

model = cdcr.Model(cdcr.robots.three_sections(gravity=(0, 0, -9.81)))
shape = cdcr.bending(np.deg2rad([30, 40, 30]), np.deg2rad([0, 60, 120]))
hold = model.allocate(model.potential_gradient(shape), min_tension=1.0)

# %%
# The gain
# --------
# An angle of 0.1 rad costs as much as 1 N of extra tension.

Q = np.array([100.0] * 6 + [0.0] * 6)
K = cdcr.control.lqr(model, shape, hold, Q=Q, R=1.0)
system = model.to_statespace(shape, hold, outputs="tip")
closed = control.ss(system.A - system.B @ K, system.B, system.C, system.D)
slowest = {"without": system.poles().real.max(), "with LQR": closed.poles().real.max()}
print("slowest decay: " + ", ".join(f"{-pole:.2f} 1/s {name}" for name, pole in slowest.items()))

# %%
# The knock
# ---------
# 0.5 N on the tip for 30 ms, on the nonlinear robot. Tensions that feedback would make negative are
# zero: cables do not push.


class StateFeedback(cdcr.Controller):
    """Tensions that hold the shape, less the gain times what the state is off by."""

    def __init__(self, gain):
        super().__init__(period=2e-3)  # [s]
        self.gain = gain

    def update(self, t, q, qd):
        return np.maximum(0.0, hold - self.gain @ np.concatenate([q - shape, qd]))


knock = cdcr.Wrench(section=2, force=(0, 0.5, 0), profile=([0, 0.03, 0.031], [1, 1, 0]))
t = np.linspace(0, 4, 801)
options = {"wrenches": knock, "method": "dopri5"}
runs = {
    name: cdcr.simulate(model, shape, 0 * shape, t=t, controller=StateFeedback(gain), **options)
    for name, gain in (("held", 0 * K), ("LQR", K))
}
off = {name: 1e3 * np.linalg.norm(run.tip - run.tip[0], axis=1) for name, run in runs.items()}
for name, distance in off.items():
    print(
        f"{name}: tip up to {distance.max():.0f} mm off, {distance[t >= 2].max():.2f} mm after 2 s"
    )

# %%
# What python-control says
# ------------------------
# The closed loop from the state after the knock on.

after = 7  # the sample at 35 ms
state = np.concatenate([runs["LQR"].q[after] - shape, runs["LQR"].qd[after]])
linear = control.initial_response(closed, t[after:] - t[after], state)
expected = 1e3 * np.linalg.norm(linear.outputs, axis=0)

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
for name, distance in off.items():
    left.plot(t, distance, label=name)
left.plot(t[after:], expected, color="0.3", linestyle=":", label="LQR, linear")
left.set(xlabel="time [s]", ylabel="tip off its place [mm]")
left.legend()
for j, pull in enumerate(runs["LQR"].tension.T):
    label = f"ends at section {j // 3 + 1}" if j % 3 == 0 else None
    right.plot(t, pull - hold[j], color=f"C{j // 3}", linewidth=1, label=label)
right.set(xlabel="time [s]", ylabel="tension more than held, LQR [N]", xlim=(0, 1))
right.legend(title="cable")
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
