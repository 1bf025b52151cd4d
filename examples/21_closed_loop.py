"""
A closed loop with motors and sensors
=====================================

Computed torque along a circle, with motors that lag, sensors that are late and noisy, and a loop
that closes all of it in C++: ``cdcr.Loop``. The controller knows how late its commands are, and
reckons so far ahead.

Look at the errors: ideal motors and sensors leave less than a microradian; late ones cost more, and
thirty times more again where the controller does not know of them.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import cdcr

# %%
# The robot and what it is to follow
# ----------------------------------
# Once round in 4 s, from rest to rest. Whether the robot can is told before.

model = cdcr.Model(cdcr.robots.amouri2020(gravity=(0, 0, -9.81), damping=5e-3))
circle = cdcr.ReferencePath.circle([0, 0], [0.3, 0], [0, 0.3], turns=1.0, duration=4.0)
print(cdcr.check_path(model, circle, min_tension=1.0, max_tension=20.0))

# %%
# Three loops
# -----------
# Motors with a lag of 2 ms, sensors 1 ms late; a command holds for 1 ms, so that its middle is 0.5
# ms away.

motors = cdcr.Actuator(time_constant=2e-3)
sensors = [cdcr.Sensor(kind=kind, delay=1e-3) for kind in ("coordinates", "rates")]
loops = {
    "ideal": ({}, {}),
    "late": ({"actuators": motors, "sensors": sensors}, {}),
    "late, and known to be": (
        {"actuators": motors, "sensors": sensors},
        {"lead": 2.5e-3, "delay": 1e-3},
    ),
}
errors = {}
for name, (around, known) in loops.items():
    controller = cdcr.ComputedTorque(model, kp=64.0, kd=16.0, min_tension=1.0, **known)
    controller.path = circle
    loop = cdcr.Loop(model, controller, **around)
    hold = model.allocate(model.potential_gradient([0.3, 0]), min_tension=1.0)
    loop.reset([0.3, 0], [0, 0], command=hold)
    run = loop.run(5.0, record_every=10, throw=True).trajectory
    wanted = np.array([circle.evaluate(t)[0] for t in run.t])
    errors[name] = np.linalg.norm(run.q - wanted, axis=1)
    print(f"{name}: largest error {1e6 * errors[name].max():.3g} urad")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
left.plot(*run.q.T)
left.set(xlabel="$q_x$ [rad]", ylabel="$q_y$ [rad]", aspect="equal")
for name, error in errors.items():
    right.plot(run.t, np.maximum(1e6 * error, 1e-3), label=name)
right.set(xlabel="time [s]", ylabel="error [urad]", yscale="log")
right.legend()
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
