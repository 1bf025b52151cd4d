"""
Which tolerance matters, on a cluster
=====================================

A robot is built with tolerances: a few per cent of Young's modulus, one of the backbone's diameter.
Which of them decides where the tip comes to rest under 5 N, and which how far it swings? A sweep
over samples of all of them tells by Sobol indices, and Dask shares the runs out.

Look at the bars: the diameter, made most precisely, matters most for the place of rest, as it
enters with its fourth power; damping matters for the swing alone. They are estimates, the second of
each pair the surer.
"""

import sys

import distributed
import matplotlib.pyplot as plt
import numpy as np
from scipy import stats

import cdcr

# %%
# What varies
# -----------
# Numbers of the scenario ``step-tension`` by their paths in its file, with distributions of SciPy.

section = cdcr.robots.amouri2020().sections[0]


def normal(value, share):
    """Normal about a value, with a standard deviation of a share of it."""
    return stats.norm(value, share * value)


tolerances = {
    "sections.1.youngs_modulus": normal(section.youngs_modulus, 0.03),
    "sections.1.backbone_diameter": normal(section.backbone_diameter, 0.01),
    "sections.1.cable_radius": normal(section.cable_radius, 0.02),
    "sections.1.damping": stats.uniform(0.015, 0.02),  # 0.015 to 0.035 N m s/rad
}

# %%
# The runs
# --------
# Samples "saltelli:64" are 64 for each parameter and two more, which Sobol indices need. Here
# threads of this process compute; on a cluster the client is ``distributed.Client("tcp://...")``,
# or ``cdcr.sweep(..., scheduler="tcp://...")`` makes one. With ``path="tolerances.nc"`` the sweep
# would go on where it was interrupted.

with distributed.Client(processes=False, dashboard_address=None) as client:
    found = cdcr.sweep(
        "step-tension",
        tolerances,
        samples="saltelli:64",
        metrics=["final_theta", "peak_theta"],
        executor=client,
    )

angle = np.degrees(found.final_theta.values)
print(
    f"{found.sizes['run']} runs: at rest at {angle.mean():.2f} deg, give or take {angle.std():.2f}"
)

# %%
# What matters
# ------------

indices = cdcr.sweeps.sobol_indices(found)
for metric in indices.metric.values:
    shares = indices.total_order.sel(metric=metric)
    first = shares.idxmax().item()
    print(f"{metric}: {100 * shares.max().item():.0f} % of the variance by {first}")

# %%
# The picture
# -----------
# ``cdcr.sweeps.plot(found)`` draws these bars under parallel coordinates of all runs.

plt.style.use(cdcr.plotting.STYLE)
fig, panels = plt.subplots(1, 2, figsize=(9, 3.2), sharey=True)
names = [name.split(".")[-1].replace("_", " ") for name in tolerances]
place = np.arange(len(names))
for axes, metric in zip(panels, indices.metric.values, strict=True):
    one = indices.sel(metric=metric)
    axes.barh(place - 0.2, one.first_order, 0.36, label="by itself")
    axes.barh(place + 0.2, one.total_order, 0.36, label="with the others")
    axes.set(xlabel="share of the variance", title=metric.replace("_", " "), xlim=(0, 1))
    axes.grid(visible=False, axis="y")
panels[0].set_yticks(place, names)
panels[0].invert_yaxis()
panels[0].legend(loc="lower right")
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
