"""
Length drives and friction
==========================

Most drives wind cables to a length; between drive and robot lies the spring of the cable. A command
is then a length [m], and tensions follow from it. In the holes of the disks cables rub: what
arrives at the end of the section is less than what the drive pulls with.

Look at the loop: the drives are told exactly what the robot needs without friction, and yet it
stays behind on the way out and on the way back; it turns back later than they do.
"""

import sys
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

import cdcr

# %%
# The robot
# ---------
# The robot of the paper with cables of 2 N/mm, with and without friction in its holes.

paper = cdcr.robots.amouri2020(damping=5e-3)
driven = replace(paper.sections[0], cable_stiffness=2e3, cable_damping=2.0)
models = {
    mu: cdcr.Model(replace(paper, sections=[replace(driven, cable_friction=mu)]))
    for mu in (0.0, 0.2)
}

# %%
# Winding and unwinding
# ---------------------
# One and a half slow swings from 60 to -60 deg. ``Model.allocate`` gives the tensions of each
# shape, none below 5 N so that all cables stay taut; ``Model.commands`` gives the lengths for both.

period = 30.0  # [s]
t = np.linspace(0.0, 1.5 * period, 901)
asked = np.pi / 3 * np.cos(2 * np.pi * t / period)
shapes = np.column_stack([asked, np.zeros_like(t)])
ideal = models[0.0]
tension = [ideal.allocate(moment, min_tension=5.0) for moment in ideal.potential_gradient(shapes)]
lengths = ideal.commands(shapes, tension)
runs = {
    mu: cdcr.simulate(model, shapes[0], [0, 0], t=t, command=(t, lengths))
    for mu, model in models.items()
}

# %%
# What friction does
# ------------------

for mu, run in runs.items():
    error = np.degrees(np.abs(run.q[:, 0] - asked)).max()
    print(f"friction coefficient {mu}: up to {error:.2f} deg off")
rubbing = runs[0.2]
heat = rubbing.friction_power.mean() * t[-1]
print(f"heat in the holes: {heat:.3f} J, largest tension: {rubbing.tension.max():.1f} N")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
for mu, run in runs.items():
    left.plot(np.degrees(asked), np.degrees(run.q[:, 0] - asked), label=f"coefficient {mu:g}")
left.set(xlabel="bending angle asked for [deg]", ylabel="angle reached less asked for [deg]")
left.legend(title="friction")
for j, pull in enumerate(rubbing.tension.T):
    right.plot(t, pull, label=f"cable {j + 1}", linestyle=["-", "-", "--"][j])
right.set(xlabel="time [s]", ylabel="tension at the base, with friction [N]", ylim=(0, 32))
right.legend(loc="upper center", ncols=3)
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
