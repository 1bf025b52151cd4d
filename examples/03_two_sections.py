"""
Two sections with a cable running through
=========================================

The cables of the second section run through the first and bend it too. A robot is steered section
by section only when the cables of the first make up for that: ``Model.allocate`` does it for all at
once.

Look at the bars: a cable of the second section bends the first just as far.
"""

import sys
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

import cdcr

# %%
# The robot
# ---------
# Two equal sections; the cables of the second are turned by 60 degrees, so that none meet. One more
# cable, described by itself, runs nearer to the backbone from the base to the tip.

cables = np.deg2rad([0, 120, 240])
first = cdcr.Section(
    length=0.25,
    backbone_mass=5.1e-3,
    backbone_diameter=2e-3,
    youngs_modulus=60e9,
    disk_mass=2.1e-3,
    disk_diameter=0.036,
    num_disks=5,
    cable_radius=0.015,
    cable_angles=cables,
)
second = replace(first, cable_angles=cables + np.pi / 3)
through = cdcr.Cable(radius=0.008, angle=np.pi, end_section=1)
robot = cdcr.Robot(sections=[first, second], cables=[through])
model = cdcr.Model(robot)

# %%
# One cable bends both sections
# -----------------------------

pulls = np.zeros(model.num_cables)
pulls[3] = 6.0  # [N], the first cable of the second section
coupled = model.equilibrium(pulls)

# %%
# The second section alone
# ------------------------
# Asked for: the shape. ``potential_gradient`` is the generalised force that holds it.

wanted = np.concatenate([[0.0, 0.0], coupled[2:]])
tension = model.allocate(model.potential_gradient(wanted))
alone = model.equilibrium(tension)

# %%
# The cable by itself
# -------------------
# It has its place in every command after the cables of the sections.

pulls = np.zeros(model.num_cables)
pulls[6] = 6.0
inner = model.equilibrium(pulls)

shapes = {"cable 4 alone": coupled, "section 2 alone": alone, "cable 7 alone": inner}
for name, q in shapes.items():
    print(f"{name}: bent by {np.degrees(cdcr.polar(q)[0]).round(2)} deg")
print(f"tensions for section 2 alone: {tension.round(2)} N")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig = plt.figure(figsize=(9, 4.5))
space = fig.add_subplot(1, 2, 1, projection="3d")
bars = fig.add_subplot(1, 2, 2, ylabel="bending angle [deg]")
for k, (name, q) in enumerate(shapes.items()):
    cdcr.plotting.plot_robot(model, q, space)
    space.text(*model.tip(q)[1] + [0, 0, 0.03], name, ha="center", fontsize=9)
    bars.bar([k - 0.2, k + 0.2], np.degrees(cdcr.polar(q)[0]), 0.35, color=["C0", "C1"])
bars.set_xticks(range(len(shapes)), shapes)
bars.legend(bars.patches[:2], ["section 1", "section 2"])
fig.tight_layout()
fig.subplots_adjust(bottom=0.17)
cdcr.plotting.show_or_save(fig, sys.argv[1:])
