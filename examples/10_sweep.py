"""
A sweep on all cores
====================

A pull in two steps can set a robot down without a swing, when the second step comes as the first
swing ends. How large should the first step be, and when should the second come? Two thousand runs
tell, shared out over the cores.

Look at the dark spot: it lies where the theory of input shaping says, and shows what being off
costs.
"""

import sys
from concurrent.futures import ThreadPoolExecutor

import matplotlib.pyplot as plt
import numpy as np

import cdcr

model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
FINAL = np.array([8.0, 0.0, 0.0])  # [N]
rest = model.equilibrium(FINAL)

# %%
# What theory says
# ----------------
# For a linear oscillator with the pole -a + i w: a first step of 1/(1 + exp(-a pi/w)), and the
# second after pi/w, half a period. The robot swings in the x-z plane: of its state (q, qd) the two
# components along x.

A, _ = model.linearize(rest, [0.0, 0.0], FINAL)
pole = np.linalg.eigvals(A[::2, ::2])[0]
half_period = np.pi / abs(pole.imag)
first = 1.0 / (1.0 + np.exp(pole.real * half_period))
print(f"theory: {100 * first:.1f} % at once, the rest after {half_period:.4f} s")

# %%
# One run
# -------


def residual(share, wait):
    """Largest distance from rest [rad] in the two seconds after the second step."""
    pull = cdcr.TensionTable([0.0, wait], [share * FINAL, FINAL], "previous")
    t = np.concatenate([[0.0], wait + np.linspace(0.0, 2.0, 101)])
    run = cdcr.simulate(model, [0, 0], [0, 0], t=t, tension=pull, method="dopri5")
    return np.linalg.norm(run.q[1:] - rest, axis=1).max()


# %%
# All of them
# -----------
# ``cdcr.simulate`` lets other threads work while it computes, the more of the time the longer the
# runs are. Tensions, events and controllers that are Python functions keep the others waiting: for
# those take processes.

shares = np.linspace(0.3, 0.75, 46)
waits = half_period * np.linspace(0.6, 1.4, 45)
cases = [(share, wait) for share in shares for wait in waits]
with ThreadPoolExecutor() as pool:
    left_over = np.array(list(pool.map(residual, *zip(*cases, strict=True))))

best_share, best_wait = cases[np.argmin(left_over)]
print(
    f"best of {len(cases)} runs: {100 * best_share:.1f} % at once, the rest after {best_wait:.4f} s"
)
print(
    f"swing left: {np.degrees(left_over.min()):.2f} deg, {np.degrees(residual(1, 0.1)):.1f} at once"
)

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, axes = plt.subplots(figsize=(7, 4.5))
field = np.degrees(left_over.reshape(len(shares), len(waits)))
filled = axes.contourf(waits, 100 * shares, field, levels=np.arange(0, 17, 1), cmap="cividis")
axes.plot(half_period, 100 * first, "+", color="white", markersize=14, label="theory")
axes.legend(labelcolor="white")
axes.grid(visible=False)
axes.set(xlabel="second step after [s]", ylabel="first step [% of the whole]")
fig.colorbar(filled, label="swing left [deg]")
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
