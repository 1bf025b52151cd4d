"""
A controller of one's own
=========================

A controller is a class with a method ``update``: the state goes in, the tensions come out, once
each period. This one inverts the dynamics (computed torque): with the acceleration chosen freely,
the error obeys an equation of one's own choice.

Look at the error: it decays as the equation says, until the sampling of the loop shows.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import cdcr

model = cdcr.Model(cdcr.robots.amouri2020(gravity=(0, 0, -9.81), damping=5e-3))

# %%
# The motion to follow
# --------------------
# The tip goes round a circle in 3 s: bent by 40 deg, the direction turning.

reference = cdcr.Reference.from_angles(
    np.linspace(0.0, 5.0, 501), np.deg2rad(40.0), lambda t: 2.0 * np.pi / 3.0 * t
)

# %%
# The controller
# --------------
# The error e = q - q_ref obeys e'' + 2 w e' + w^2 e = 0.

w = 6.0  # [rad/s]


class ComputedTorque(cdcr.Controller):
    """Tensions for the acceleration that makes the error decay."""

    def update(self, t, q, qd):
        q_ref, qd_ref, qdd_ref = reference.evaluate(t)
        qdd = qdd_ref - 2.0 * w * (qd - qd_ref) - w**2 * (q - q_ref)
        return model.allocate(model.inverse_dynamics(q, qd, qdd), min_tension=0.5)


# %%
# The run
# -------
# It begins straight and at rest, so far off.

straight = np.zeros(2)
run = cdcr.simulate(
    model, straight, straight, t=reference.t, controller=ComputedTorque(2e-3), method="dopri5"
)
error = np.degrees(np.linalg.norm(run.q - reference.q, axis=1))
e0, v0 = -reference.q[0], -reference.qd[0]
t = run.t[:, None]
chosen = np.degrees(np.linalg.norm((e0 + (v0 + w * e0) * t) * np.exp(-w * t), axis=1))
late = 1e3 * np.linalg.norm(run.tip - model.tips(reference.q), axis=1)[run.t >= 3].max()
print(f"error after 0.5 s: {error[50]:.2f} deg, chosen: {chosen[50]:.2f} deg")
print(f"second round: tip within {late:.2f} mm of its circle")
print(f"largest tension: {run.tension.max():.1f} N")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
left.plot(*1e3 * run.tip[:, :2].T, label="tip")
left.plot(*1e3 * model.tips(reference.q)[:, :2].T, color="0.2", linestyle=":", label="reference")
left.set(xlabel="x [mm]", ylabel="y [mm]", aspect="equal")
left.legend(loc="lower center", bbox_to_anchor=(0.5, 0.15))
right.semilogy(run.t, error, label="run")
right.semilogy(run.t, chosen, color="0.5", linestyle="--", label="as chosen")
right.set(xlabel="time [s]", ylabel="error of the bending vector [deg]", ylim=(1e-3, 1e2))
right.legend()
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
