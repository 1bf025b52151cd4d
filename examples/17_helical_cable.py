"""
A helical cable
===============

A cable that winds round the backbone bends a robot towards another direction at each place, and
twists it against its winding. One that winds once all the way round bends it nowhere in sum: its
tip moves sideways, and points where it did.

Look at the lines on the disks: straight cables leave them parallel, a helical one turns each of
them further than the one before.
"""

import sys
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

import cdcr

section = cdcr.Section(
    length=0.2,
    backbone_mass=0.012,
    backbone_diameter=0.008,
    youngs_modulus=30e6,
    shear_modulus=10e6,
    num_disks=8,
    disk_mass=0.0015,
    disk_diameter=0.03,
    bending_order=4,
    twist_order=2,
)
radius, pull = 0.012, 2.0  # [m], [N]

# %%
# Cables that wind more and more
# ------------------------------
# A pair of angles is that at the base and at the tip of each section passed.

turns = np.array([0.0, 0.25, 0.5, 1.0])
models, shapes = [], []
for turn in turns:
    cable = cdcr.Cable(radius=radius, angle=[(0.0, 2 * np.pi * turn)], end_section=0)
    models.append(cdcr.Model(cdcr.Robot(sections=[section], cables=[cable])))
    shapes.append(models[-1].equilibrium([pull]))

row = models[0].coordinate_names.index("t1")
twists = [q[row] for q in shapes]
leaning = [np.arccos(model.tip(q)[0][2, 2]) for model, q in zip(models, shapes, strict=True)]
for turn, twist, angle in zip(turns, twists, leaning, strict=True):
    print(f"{turn:.2f} turns: twist {np.degrees(twist):6.2f} deg, tip leans by", end=" ")
    print(f"{np.degrees(angle):5.2f} deg")

# %%
# The force of a cable depends on the shape
# -----------------------------------------
# So the actuation matrix needs one, and so does the allocation of tensions.

model, q = models[2], shapes[2]
before, after = model.actuation_matrix(model.rest_shape)[row, 0], model.actuation_matrix(q)[row, 0]
print(f"1 N twists with {1e3 * before:.3f} mN m, pulled by 2 N with {1e3 * after:.3f} mN m")

# %%
# A helix out of a helix
# ----------------------
# Uniform bending and twist make a helix of the backbone itself: its tip is known in closed form.

even = cdcr.Model(cdcr.Robot(sections=[replace(section, bending_order=0, twist_order=0)]))
bent, twisted = 2.0, 5.0  # [rad]
tip = even.tip([bent, 0.0, twisted])[1]
print(f"tip of a rod bent by {bent:g} and twisted by {twisted:g} rad:", tip.round(5), "m")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig = plt.figure(figsize=(9, 3.4))
for k, (turn, model, q) in enumerate(zip(turns, models, shapes, strict=True)):
    axes = fig.add_subplot(1, 4, k + 1, projection="3d")
    cdcr.plotting.plot_robot(model, q, axes)
    axes.set(xlim=(-0.02, 0.08), ylim=(-0.03, 0.07), zlim=(0.0, 0.2))
    axes.set_title(f"turns: {turn:g}", y=1.1, fontsize=11)
    axes.set_box_aspect((0.1, 0.1, 0.2), zoom=1.1)
    axes.set(xticks=[0.0, 0.05], yticks=[0.0, 0.05])
    if k < 3:
        axes.set_zlabel("")
fig.subplots_adjust(left=0.0, right=0.9, bottom=0.06, top=0.95, wspace=0.15)
cdcr.plotting.show_or_save(fig, sys.argv[1:])
