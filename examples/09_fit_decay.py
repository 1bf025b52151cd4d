"""
Fit a stiffness and a damping to a decay
========================================

Pluck a robot, film how it swings, and ask which Young's modulus and which damping give that swing.
The measurement here is made up: a run with values that the fit does not know, seen by a camera at
60 pictures a second with noise of a third of a degree, whose clock is 20 ms ahead.

Look at the residuals: they are noise, without a wave that would tell of a wrong model.
"""

import sys
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

import cdcr

# %%
# The measurement
# ---------------

paper = cdcr.robots.amouri2020(gravity=(0, 0, -9.81), damping=0.02)  # numbers of a data sheet
pluck = [np.deg2rad(35.0), 0.0]  # let go from here, at rest
t = np.arange(0.0, 6.0, 1.0 / 60.0)

TRUE = 10.4e9, 0.012  # [Pa], [N m s/rad]
NOISE, LATE = np.deg2rad(1 / 3), 0.02  # [rad], [s]
true = replace(paper.sections[0], youngs_modulus=TRUE[0], damping=TRUE[1])
model = cdcr.Model(replace(paper, sections=[true]))
run = cdcr.simulate(model, pluck, [0, 0], t=np.append(0.0, t[2:] - LATE))
seen = np.vstack([[pluck], run.q])  # the first pictures show it held
seen = seen + np.random.default_rng(1).normal(0.0, NOISE, seen.shape)

# %%
# The fit
# -------
# A motion says what was asked of the robot, how it began, and what was seen. The clock is one
# more unknown.

motion = cdcr.identification.Motion(t, [0, 0, 0], q=seen, start=(pluck, [0, 0]), method="dopri5")
paths = ["sections[*].youngs_modulus", "sections[*].damping", "time shift"]
found = cdcr.identify(motion, paper, dict.fromkeys(paths))
modulus, damping, shift = (found[path] for path in paths)
errors = np.array([one.standard_error for one in found.estimates])
spread = errors[:2] / [modulus, damping]  # relative
deviation = found.residuals[0].noise
print(f"Young's modulus: {modulus / 1e9:.3f} GPa +- {100 * spread[0]:.2f} % (made with 10.4)")
print(f"damping: {1e3 * damping:.2f} mN m s/rad +- {100 * spread[1]:.1f} % (made with 12)")
print(f"clock: {1e3 * shift:.1f} ms ahead +- {1e3 * errors[2]:.1f} (made with 20)")
print(f"residuals: {np.degrees(deviation):.3f} deg, the noise of the camera")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (top, bottom) = plt.subplots(
    2, 1, sharex=True, figsize=(7, 4.5), gridspec_kw={"height_ratios": [3, 1]}
)
sheet = cdcr.simulate(cdcr.Model(paper), pluck, [0, 0], t=t)
top.plot(t, np.degrees(seen[:, 0]), ".", color="0.5", markersize=3, label="measured")
top.plot(t, np.degrees(sheet.q[:, 0]), "--", color="C1", linewidth=1, label="data sheet")
top.plot(t, np.degrees(found.predict(motion)["q"][:, 0]), label="fitted")
top.set(ylabel="bending angle [deg]")
top.legend(ncols=3, loc="upper right")
bottom.plot(t, np.degrees(found.residuals[0].values[:, 0]), ".", color="0.5", markersize=3)
bottom.set(xlabel="time [s]", ylabel="residual [deg]")
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
