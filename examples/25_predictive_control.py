"""
Nonlinear predictive control within limits
==========================================

The tip of an arm of three sections goes round a circle that needs more than the 8 N which its
cables may have. A predictive controller looks 0.4 s ahead, and finds the tensions within the limit
that keep the tip nearest; one that does not look ahead cuts off what it asks for.

Look at the tensions: the controller rides on the limit, and loses millimetres where the other loses
centimetres. And at the time of an update, which bounds how often it can be asked.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import cdcr

# %%
# The robot and what it is to follow
# ----------------------------------
# Once round in 3 s, from rest to rest. What the limit allows is told before.

most = 8.0  # [N]
model = cdcr.Model(cdcr.robots.three_sections(gravity=(0, 0, -9.81)))
circle = cdcr.ReferencePath.circle(
    [0, 0, 0.66], [0.25, 0, 0], [0, 0.25, 0], turns=1.0, duration=3.0
)
start = model.inverse_kinematics(circle.evaluate(0.0)[0]).q
print(cdcr.check_path(model, circle, max_tension=most, num_samples=61))

# %%
# Two controllers
# ---------------
# Twenty steps of 20 ms ahead, two hundred times a second.


class Timed(cdcr.control.Mpc):
    def update(self, t, q, qd):
        tension = super().update(t, q, qd)
        took.append(self.diagnostics["duration"])
        return tension


predictive = Timed(model, max_tension=most, period=5e-3, step=0.02, substeps=2)
plain = cdcr.TaskSpace(model, posture=start, damping=1e-3, max_tension=most)
t = np.linspace(0.0, 3.5, 701)
wanted = np.array([circle.evaluate(at)[0] for at in t])
took, runs, errors = [], {}, {}
for name, controller in (("predictive", predictive), ("task space", plain)):
    controller.path = circle
    run = cdcr.simulate(model, start, np.zeros(6), t=t, controller=controller, method="rk4")
    runs[name], errors[name] = run, 1e3 * np.linalg.norm(run.tip - wanted, axis=1)
    print(f"{name}: at most {errors[name].max():.1f} mm off, {run.tension.max():.2f} N")
print(f"an update takes {1e3 * np.median(took):.1f} ms: {1 / np.median(took):.0f} a second")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, axes = plt.subplot_mosaic("ab;ac", figsize=(10, 5), layout="constrained")
axes["a"].plot(*wanted[:, :2].T, color="black", linestyle=":", label="wanted")
for name, run in runs.items():
    axes["a"].plot(*run.tip[:, :2].T, label=name)
    axes["b"].plot(t, errors[name], label=name)
axes["a"].set(xlabel="x of the tip [m]", ylabel="y of the tip [m]", aspect="equal")
axes["a"].legend(loc="center")
axes["b"].set(ylabel="off the circle [mm]", ylim=(-2, 80), xticklabels=[])
axes["b"].legend(loc="upper left")
for section, color in enumerate(("C3", "C4", "C5")):
    pulls = runs["predictive"].tension[:, 3 * section : 3 * section + 3]
    lines = axes["c"].plot(t, pulls, color=color, linewidth=1)
    lines[0].set_label(f"section {section + 1}")
axes["c"].axhline(most, color="black", linestyle=":", label="limit")
axes["c"].set(xlabel="time [s]", ylabel="tensions, predictive [N]", ylim=(-0.2, 11))
axes["c"].legend(loc="upper center", ncols=4, fontsize="small", columnspacing=1)
cdcr.plotting.show_or_save(fig, sys.argv[1:])
