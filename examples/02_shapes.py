"""
Shape under tensions
====================

Three cables pull and cannot push, and yet they bend a section in any direction. Given the
direction, ``Model.allocate`` finds the smallest tensions; given tensions, ``Model.equilibrium``
finds the shape.

Look at the polar plot: where a cable lies in the direction of bending it does the work alone.
Halfway between two cables both have to pull as much as that one did, so the sum doubles.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import cdcr

model = cdcr.Model(cdcr.robots.amouri2020())  # one section of 0.8 m

# %%
# Bent by 60 degrees in every direction
# -------------------------------------
# Without weight the moment is stiffness times angle, the same in every direction.

phi = np.deg2rad(np.arange(0, 361, 5))
stiffness = model.robot.sections[0].stiffness
tension = np.array([model.allocate(stiffness * cdcr.bending(np.pi / 3, p)) for p in phi])
shapes = np.array([model.equilibrium(pull) for pull in tension])

theta, _ = cdcr.polar(shapes)
total = tension.sum(axis=1)
print(f"bent by {np.degrees(theta.min()):.3f} to {np.degrees(theta.max()):.3f} deg")
print(f"largest tension: {tension.max():.2f} N, 30 deg beside a cable")
print(f"sum of tensions: {total.min():.2f} to {total.max():.2f} N")

# %%
# How far one cable bends it
# --------------------------
# The angle is proportional to the tension, however far the robot is bent.

angles = [cdcr.polar(model.equilibrium([pull, 0.0, 0.0]))[0] for pull in (10.0, 20.0, 40.0)]
print("10, 20, 40 N on cable 1: " + ", ".join(f"{np.degrees(a):.1f}" for a in angles) + " deg")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig = plt.figure(figsize=(9, 4))
space = fig.add_subplot(1, 2, 1, projection="3d")
for q in shapes[:-1:6]:
    cdcr.plotting.plot_robot(model, q, space, alpha=0.35)
space.plot(*model.tips(shapes).T, color="0.4", linewidth=1)

axes = fig.add_subplot(1, 2, 2, projection="polar")
for j, pull in enumerate(tension.T):
    axes.plot(phi, pull, label=f"cable {j + 1}")
axes.set_title("tension [N] over the direction of bending")
axes.set_rlabel_position(60)
axes.legend(loc="lower left", bbox_to_anchor=(1.0, -0.12))
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
