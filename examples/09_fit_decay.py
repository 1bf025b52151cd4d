"""
Fit a stiffness and a damping to a decay
========================================

Pluck a robot, film how it swings, and ask which Young's modulus and which damping give that swing.
The measurement here is made up: a run with values that the fit does not know, seen by a camera at
60 pictures a second with noise of a third of a degree.

Look at the residuals: they are noise, without a wave that would tell of a wrong model.
"""

import sys
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import least_squares

import cdcr

# %%
# The decay as a function of what is sought
# -----------------------------------------

paper = cdcr.robots.amouri2020(gravity=(0, 0, -9.81))
pluck = np.deg2rad([35.0, 0.0])  # let go from here, at rest
t = np.arange(0.0, 6.0, 1.0 / 60.0)


def decay(modulus, damping):
    """Bending angle [rad] over time of the robot with that backbone."""
    section = replace(paper.sections[0], youngs_modulus=modulus, damping=damping)
    model = cdcr.Model(replace(paper, sections=[section]))
    return cdcr.simulate(model, pluck, [0, 0], t=t).q[:, 0]


# %%
# The measurement
# ---------------

TRUE = 10.4e9, 0.012  # [Pa], [N m s/rad]
NOISE = np.deg2rad(1 / 3)
measured = decay(*TRUE) + np.random.default_rng(1).normal(0.0, NOISE, t.size)

# %%
# The fit
# -------
# Beginning at the numbers of a data sheet. In logarithms both unknowns are of the size one, and
# neither can become negative.

start = np.log([9.5e9, 0.02])
fit = least_squares(lambda x: decay(*np.exp(x)) - measured, start)
modulus, damping = np.exp(fit.x)
deviation = np.sqrt(2.0 * fit.cost / (t.size - 2))
spread = np.sqrt(np.diag(np.linalg.inv(fit.jac.T @ fit.jac))) * deviation  # relative
print(f"Young's modulus: {modulus / 1e9:.3f} GPa +- {100 * spread[0]:.2f} % (made with 10.4)")
print(f"damping: {1e3 * damping:.2f} mN m s/rad +- {100 * spread[1]:.1f} % (made with 12)")
print(f"residuals: {np.degrees(deviation):.3f} deg, the noise of the camera")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (top, bottom) = plt.subplots(
    2, 1, sharex=True, figsize=(7, 4.5), gridspec_kw={"height_ratios": [3, 1]}
)
top.plot(t, np.degrees(measured), ".", color="0.5", markersize=3, label="measured")
top.plot(t, np.degrees(decay(*np.exp(start))), "--", color="C1", linewidth=1, label="data sheet")
top.plot(t, np.degrees(decay(modulus, damping)), label="fitted")
top.set(ylabel="bending angle [deg]")
top.legend(ncols=3, loc="upper right")
bottom.plot(t, np.degrees(fit.fun), ".", color="0.5", markersize=3)
bottom.set(xlabel="time [s]", ylabel="residual [deg]")
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
