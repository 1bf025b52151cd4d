"""
Own robot and step response
===========================

A robot is described by what one can measure on it: lengths, masses, diameters, Young's modulus and
where the cables run. Here is a section of 40 cm with a backbone of Nitinol, eight printed disks and
three cables; one cable is pulled at once, and held.

Look at the tip: it swings to nearly twice the angle at which it comes to rest, which statics alone
would not tell.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import cdcr

# %%
# The robot
# ---------
# All numbers are in SI units. ``robot.save("my-robot.toml")`` would write them to a file.

section = cdcr.Section(
    length=0.4,  # [m]
    backbone_mass=8.1e-3,  # [kg]
    backbone_diameter=2e-3,  # [m]
    youngs_modulus=60e9,  # [Pa]
    disk_mass=2.1e-3,
    disk_diameter=0.036,
    num_disks=8,
    cable_radius=0.015,
    cable_angles=np.deg2rad([0, 120, 240]),
    damping=5e-4,  # [N m s/rad]
)
robot = cdcr.Robot(sections=[section])
model = cdcr.Model(robot)
print(f"bending stiffness: {section.stiffness:.4f} N m/rad, mass: {1e3 * robot.mass:.1f} g")

# %%
# The step
# --------
# From straight and at rest, 4 N on cable 1.

tension = [4.0, 0.0, 0.0]  # [N]
run = cdcr.simulate(model, [0, 0], [0, 0], t=np.linspace(0, 3, 1501), tension=tension)
rest = model.equilibrium(tension)

theta_rest = cdcr.polar(rest)[0]
overshoot = run.theta.max() / theta_rest - 1
modes = model.modes(rest, tension)
print(f"at rest: {np.degrees(theta_rest):.2f} deg, overshoot: {100 * overshoot:.0f} %")
print(f"vibrates at {modes.frequency_hz[0]:.3f} Hz, damping ratio {modes.damping_ratio[0]:.3f}")

# %%
# The picture
# -----------
# Functions of cdcr that draw take axes of yours, so that one picture can hold several.

plt.style.use(cdcr.plotting.STYLE)
fig = plt.figure(figsize=(9, 4))
space = run.plot_robot([0.0, 0.14, 3.0], ax=fig.add_subplot(1, 2, 1, projection="3d"))
space.legend(loc="center right", bbox_to_anchor=(0.0, 0.5))

axes = fig.add_subplot(1, 2, 2, xlabel="time [s]", ylabel="bending angle [deg]")
axes.plot(run.t, np.degrees(run.theta))
axes.axhline(np.degrees(theta_rest), color="0.5", linestyle="--", label="at rest")
axes.legend()
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
