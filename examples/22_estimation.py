"""
A state from cable lengths, and a push on the tip
=================================================

Three sections are bent by a controller that is told what an extended Kalman filter makes of noisy
cable lengths and a camera 10 ms late. After half a second something pushes the tip, and the filter,
which estimates a force there too, finds it.

Look at the error when the push begins: until the force is found the filter is wrong about where the
robot goes, and for as long as the camera is late it cannot know.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import cdcr

# %%
# Sensors and a filter
# --------------------

model = cdcr.Model(cdcr.robots.three_sections(damping=5e-3))
sensors = [
    cdcr.Sensor(kind="lengths", noise=1e-5),
    cdcr.Sensor(kind="tip", noise=1e-3, period=0.01, delay=0.01, seed=2),
]
kalman = cdcr.ExtendedKalman(
    model,
    sensors=sensors,
    start=[0.0] * 6,
    deviation=0.1,
    force_at=(2, 1.0),
    force_noise=0.3,
    force_deviation=0.1,
)

# %%
# A loop, and a push after half a second
# --------------------------------------

controller = cdcr.ComputedTorque(model, kp=36.0, kd=12.0, min_tension=1.0)
controller.reference = [0.4, 0.1, 0.3, 0.0, 0.2, -0.2]
loop = cdcr.Loop(model, controller, sensors=sensors, estimator=kalman)
loop.reset([0.05] * 6, [0.0] * 6)
push = np.array([0.3, -0.2, 0.0])
runs = [loop.run(0.5, throw=True)]
runs.append(loop.run(1.0, wrenches=cdcr.Wrench(section=2, force=tuple(push)), throw=True))
t = np.concatenate([run.trajectory.t for run in runs])
off = np.concatenate([np.abs(run.told_q - run.trajectory.q).max(axis=1) for run in runs])
names = ("force_x", "force_y", "force_z")
force = np.vstack([np.transpose([run.estimated[name] for name in names]) for run in runs])
error = np.linalg.norm(force[-1] - push) / np.linalg.norm(push)
print(f"coordinates: off by {off[1]:.3f} rad at first, {off[-500:].max():.4f} rad at the end")
print(f"force at the end: {force[-1].round(3)} N, off by {100 * error:.1f} %")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
left.plot(t, np.rad2deg(off))
left.set(xlabel="time [s]", ylabel="largest error of the coordinates [deg]", yscale="log")
for i, axis in enumerate("xyz"):
    (line,) = right.plot(t, force[:, i], label=f"$f_{axis}$")
    right.plot(t, np.where(t < 0.5, 0.0, push[i]), color=line.get_color(), linestyle=":")
right.set(xlabel="time [s]", ylabel="force on the tip [N], dotted: truth")
right.legend()
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
