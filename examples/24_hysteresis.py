"""
Hysteresis
==========

Where cables rub, a robot does not come back the way it went. ``cdcr.quasi_static`` follows commands
slowly, without time: each cable sticks or slides from one sample to the next. Three sections, one
cable of the last pulled and let go by ever less.

Look at the loops: each lies within the one before, and where the command turns the robot first
stands still. Friction at the entry makes them wider, most of all at small tensions.
"""

import sys
from dataclasses import replace
from itertools import pairwise

import matplotlib.pyplot as plt
import numpy as np

import cdcr

# %%
# The robots
# ----------
# Three sections whose cables rub in their holes, and at the entry too.

smooth = cdcr.robots.three_sections()


def rubbing(**fields):
    return cdcr.Model(replace(smooth, sections=[replace(one, **fields) for one in smooth.sections]))


models = {
    "no friction": cdcr.Model(smooth),
    "in the holes": rubbing(cable_friction=0.25),
    "at the entry too": rubbing(cable_friction=0.25, cable_entry_friction=0.3),
}

# %%
# The way
# -------
# Cable 1 of the last section, up to 6 N and back by ever less; the others are held at 1 N.

turns = [1.0, 6.0, 1.5, 5.0, 2.0, 4.0, 3.0]
ways = [np.linspace(a, b, 50) for a, b in pairwise(turns)]
pull = np.concatenate(ways)
command = np.ones((len(pull), 9))
command[:, 6] = pull
runs = {name: cdcr.quasi_static(model, command) for name, model in models.items()}

# %%
# What friction does
# ------------------

away = {name: np.linalg.norm(run.tip[:, :2], axis=1) for name, run in runs.items()}
for name in runs:
    rests = [
        np.interp(3.5, np.sort(way), there[np.argsort(way)])
        for way, there in zip(ways, np.split(away[name], len(ways)), strict=True)
    ]
    print(f"{name}: on {len(ways)} ways to 3.5 N the tip rests {1e3 * np.ptp(rests):.1f} mm apart")
sticks = np.mean(runs["in the holes"].sliding[:, 6] == 0)
print(f"with friction in the holes the cable sticks {100 * sticks:.0f} % of the way")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
for name, run in runs.items():
    left.plot(pull, 1e3 * away[name], label=name)
    right.plot(pull, run.end_tension[:, 6], label=name)
left.set(xlabel="tension of cable 7 [N]", ylabel="tip away from the axis [mm]")
right.set(xlabel="tension of cable 7 at the drive [N]", ylabel="tension at its end [N]")
left.legend()
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
