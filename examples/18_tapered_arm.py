"""
A tapered arm
=============

An arm that is thinner towards its tip is stiff where it carries most, and light where it moves
most. One section holds it: diameters at base and tip, and a bending that varies along it.

Look at the frequencies: halving the tip's diameter raises the first, although the arm is softer
everywhere. Two bending vectors are enough for it; three bring the sag within one per cent.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import cdcr

LENGTH, BASE, MODULUS, DENSITY = 0.3, 0.01, 5e6, 1100.0  # [m], [m], [Pa], [kg/m^3]


def arm(tip: float, order: int) -> cdcr.Robot:
    """An arm of one material that sticks out sideways, its cable converging with it."""
    volume = np.pi / 12 * LENGTH * (BASE**2 + BASE * tip + tip**2)
    section = cdcr.Section(
        length=LENGTH,
        backbone_mass=DENSITY * volume,
        backbone_diameter=(BASE, tip),
        youngs_modulus=MODULUS,
        bending_order=order,
        damping=2e-4,
    )
    cable = cdcr.Cable(radius=[(0.008, 0.8 * tip)], angle=0.0, end_section=0)
    return cdcr.Robot(sections=[section], cables=[cable], gravity=(-9.81, 0.0, 0.0))


# %%
# Frequencies over the taper
# --------------------------
# Without weight, of small motions about straight.

tips = np.linspace(0.3, 1.0, 15) * BASE
frequency = {}
for order in (0, 1, 4):
    models = [cdcr.Model(arm(tip, order)).with_gravity([0, 0, 0]) for tip in tips]
    frequency[order] = [m.modes(m.rest_shape, [0.0]).frequency_hz[0] for m in models]
half = np.argmin(np.abs(tips - 0.5 * BASE))
print(f"tip half as wide: {frequency[4][half]:.3f} Hz; as wide: {frequency[4][-1]:.3f} Hz")

# %%
# How far a small load pulls its tip down
# ---------------------------------------
# Beside its weight, which bends it most near the base.

load, moved = 1e-3, {}  # [N]
for order in (0, 1, 2, 3, 4):
    model = cdcr.Model(arm(0.5 * BASE, order)).with_gravity([0, 0, 0])
    pull = cdcr.Wrench(section=0, force=(-load, 0.0, 0.0))
    moved[order] = -model.tip(model.equilibrium([0.0], wrenches=pull))[1][0]
print("1 mN moves the tip by " + ", ".join(f"{1e3 * one:.4f}" for one in moved.values()) + " mm")

# %%
# The tension that lifts it
# -------------------------

model = cdcr.Model(arm(0.5 * BASE, 4))
tensions = np.linspace(0.0, 1.2, 7)
shapes = np.array([model.equilibrium([tension]) for tension in tensions])
heights = model.tips(shapes)[:, 0]
print(f"its tip hangs {-1e3 * heights[0]:.1f} mm, pulled with 1.2 N it is at {heights[-1]:.3f} m")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
for order, line in zip(frequency, ("--", "-.", "-"), strict=True):
    left.plot(tips / BASE, frequency[order], line, label=f"bending order {order}")
left.set(xlabel="diameter of the tip over that of the base", ylabel="first frequency [Hz]")
left.legend()
for tension, q in zip(tensions[::2], shapes[::2], strict=True):
    line = np.array([model.pose(q, 0, x)[1] for x in np.linspace(0.0, 1.0, 50)])
    right.plot(line[:, 2], line[:, 0], label=f"{tension:.1f} N")
right.set(xlabel="z [m]", ylabel="height x [m]", aspect="equal")
right.legend(title="tension")
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
