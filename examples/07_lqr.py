"""
LQR
===

Nine cables hold three sections against gravity; a knock sets them swinging. ``Model.linearize``
gives the exact A and B about the shape, and the Riccati equation of SciPy the gain that brings the
robot back with little extra tension.

Look at the tip: without control it swings on for seconds; with it the knock is over in one swing.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np
from scipy.linalg import solve_continuous_are

import cdcr

# %%
# The shape to hold
# -----------------
# Each cable with at least 1 N, so that feedback may take some away.

model = cdcr.Model(cdcr.robots.three_sections(gravity=(0, 0, -9.81)))
theta, phi = np.deg2rad([30, 40, 30]), np.deg2rad([0, 60, 120])
shape = cdcr.bending(theta, phi)
hold = model.allocate(model.potential_gradient(shape), min_tension=1.0)

# %%
# The gain
# --------
# An angle of 0.1 rad costs as much as 1 N of extra tension.

A, B = model.linearize(shape, np.zeros_like(shape), hold)
Q = np.diag([100.0] * 6 + [0.0] * 6)
R = np.eye(9)
K = np.linalg.solve(R, B.T @ solve_continuous_are(A, B, Q, R))
before, after = np.linalg.eigvals(A), np.linalg.eigvals(A - B @ K)
print(f"slowest decay: {-before.real.max():.2f} 1/s without, {-after.real.max():.2f} 1/s with LQR")

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
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
for name, distance in off.items():
    left.plot(t, distance, label=name)
left.set(xlabel="time [s]", ylabel="tip off its place [mm]")
left.legend()
for j, pull in enumerate(runs["LQR"].tension.T):
    label = f"ends at section {j // 3 + 1}" if j % 3 == 0 else None
    right.plot(t, pull - hold[j], color=f"C{j // 3}", linewidth=1, label=label)
right.set(xlabel="time [s]", ylabel="tension more than held, LQR [N]", xlim=(0, 1))
right.legend(title="cable")
fig.tight_layout()
fig.savefig(sys.argv[1]) if len(sys.argv) > 1 else plt.show()
