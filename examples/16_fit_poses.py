"""
Identify an arm from thirty poses
=================================

Two sections hang from a base that is not quite level. Which pulls tell most about stiffness and
base, what do thirty of them say, and does the arm found predict pulls that it has not seen? The
measurements are made up: an arm with values that the fit does not know, and a tip seen to 1 mm.

Look at where the chosen pulls bring the tip, and at how soon ten of them tell as much as thirty
drawn by chance.
"""

import sys
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

import cdcr

# %%
# What is known, and the arm that is measured
# -------------------------------------------

known = cdcr.Robot(
    sections=[
        cdcr.Section(
            length=0.15, backbone_mass=0.004, backbone_diameter=1.2e-3, youngs_modulus=60e9,
            num_disks=6, disk_mass=0.002, disk_diameter=0.02, cable_radius=8e-3,
            cable_angles=np.deg2rad([0.0, 120.0, 240.0]),
        )
    ] * 2,
    gravity=(0.0, 0.0, 9.81),  # down along it
)  # fmt: skip
TRUE = 67e9, 0.04  # Young's modulus [Pa], turn of the base about X [rad]
NOISE = 1e-3  # [m]
first, second = (replace(one, youngs_modulus=TRUE[0]) for one in known.sections)
c, s = np.cos(TRUE[1]), np.sin(TRUE[1])
turn = [[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]
measured = replace(known, sections=[first, second], base_orientation=turn)
model = cdcr.Model(measured)
draw = np.random.default_rng(2)


def tips(pulls):
    """Where the tip is seen [m]."""
    shapes = np.array([model.equilibrium(pull) for pull in pulls])
    return model.tips(shapes) + draw.normal(0.0, NOISE, (len(pulls), 3))


# %%
# Which pulls tell most
# ---------------------

paths = ["sections[*].youngs_modulus", "base tilt"]
asked = dict.fromkeys(paths)
could = draw.uniform(0.0, 3.0, (200, 6)) * (draw.uniform(size=(200, 6)) < 0.4)
design = cdcr.identification.informative_commands(known, asked, could, noise=NOISE, number=10)
error = design.standard_error[-1, 0]
print(f"ten chosen pulls promise {error / 1e9:.2f} GPa")

# %%
# The fit, and pulls that it has not seen
# ---------------------------------------

by_choice = cdcr.identification.Poses(design.command, tip=tips(design.command), noise=NOISE)
by_chance = cdcr.identification.Poses(could[:30], tip=tips(could[:30]), noise=NOISE)
found = cdcr.identify(by_choice, known, asked)
other = cdcr.identify(by_chance, known, asked)
print(f"and give {found[paths[0]] / 1e9:.2f} +- {found.estimates[0].standard_error / 1e9:.2f} GPa")
print(f"thirty by chance: +- {other.estimates[0].standard_error / 1e9:.2f} GPa (made with 67)")
ahead = found.errors(by_chance)[0]
print(f"thirty pulls predicted to {1e3 * ahead.rms:.2f} mm RMS, noise {1e3 * NOISE * 3**0.5:.2f}")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (left, right) = plt.subplots(1, 2, figsize=(8, 3.8))
for name, poses, color in (("by chance", by_chance, "0.6"), ("chosen", by_choice, "C1")):
    left.plot(*(1e3 * poses.tip[:, :2].T), "o", color=color, markersize=4, label=name)
left.set(xlabel="tip x [mm]", ylabel="tip y [mm]", aspect="equal")
left.legend()
right.semilogy(np.arange(1, 11), design.standard_error[:, 0] / 1e9, "o-", color="C1")
right.axhline(other.estimates[0].standard_error / 1e9, color="0.6")
right.text(10, other.estimates[0].standard_error / 1e9, "thirty by chance", ha="right", va="bottom")
right.set(xlabel="chosen pulls", ylabel="standard error of the modulus [GPa]")
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
