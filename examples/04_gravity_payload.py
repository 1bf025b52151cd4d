"""
Gravity and payload
===================

An arm that is clamped horizontally sags under its own weight and what it carries. A section of
constant curvature is too stiff for that, since a loaded beam bends more at its base than at its
tip; ``Robot.subdivide`` cuts the section into parts that bend on their own.

Look at the dashed lines: with one part the tip sags a quarter less for a small load than with
eight.
"""

import sys
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

import cdcr

# %%
# Clamped horizontally
# --------------------
# The columns of the base's orientation are the axes of the first section: its x axis, where cable 1
# lies, points up, and its z axis, along which the straight robot lies, points along x.

horizontal = [[0, 0, 1], [0, -1, 0], [1, 0, 0]]
weight = (0.0, 0.0, -9.81)  # [m/s^2]
arm = replace(cdcr.robots.amouri2020(gravity=weight), base_orientation=horizontal)

# %%
# Rest under a payload
# --------------------

payloads = [0.0, 0.02, 0.05, 0.1]  # [kg]
PARTS = (1, 8)
rest = {}
for payload in payloads:
    for parts in PARTS:
        model = cdcr.Model(replace(arm, payload=payload).subdivide(parts))
        rest[payload, parts] = model, model.equilibrium()
sag = {key: -model.tip(q)[1][2] for key, (model, q) in rest.items()}
for payload in payloads:
    coarse, fine = (1e3 * sag[payload, parts] for parts in PARTS)
    print(
        f"{1e3 * payload:3.0f} g: tip sags {coarse:.0f} mm with one part, {fine:.0f} mm with eight"
    )

# %%
# Lifted by cable 1
# -----------------
# What holds the straight arm against its weight and 50 g at the tip.

model = cdcr.Model(replace(arm, payload=0.05))
lift = model.allocate(model.potential_gradient([0.0, 0.0]))
print(f"held straight with 50 g: {lift[0]:.1f} N on cable 1")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, axes = plt.subplots(figsize=(7, 4.5))
for k, payload in enumerate(payloads):
    for parts in PARTS:
        model, q = rest[payload, parts]
        places = [(i, x) for i in range(parts) for x in np.linspace(0, 1, 17)]
        x, _, z = np.array([model.pose(q, *place)[1] for place in places]).T
        label = f"{1e3 * payload:.0f} g at the tip" if parts > 1 else None
        axes.plot(x, z, color=f"C{k}", linestyle="-" if parts > 1 else "--", label=label)
axes.plot([], [], "--", color="0.4", label="one part")
axes.set(xlabel="x [m]", ylabel="z [m]", aspect="equal")
axes.legend()
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
