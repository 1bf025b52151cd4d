"""
Events and files
================

Tensions come from a file that a drive has logged, robot and run go to files and come back. Two
events are looked for on the way: each turn of the swing, and the tip touching a shelf, where the
run ends.

Look at the dots: they lie where the angle turns, between the samples too.
"""

import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import cdcr

folder = tempfile.TemporaryDirectory()
files = Path(folder.name)

# %%
# The robot as a file
# -------------------

cdcr.robots.amouri2020(damping=5e-3).save(files / "robot.toml")
model = cdcr.Model(cdcr.Robot.load(files / "robot.toml"))

# %%
# Tensions of a file
# ------------------
# A column of times and one for each cable. Each row holds until the next.

rows = ["t,cable 1,cable 2,cable 3", "0,4,0,0", "1,8,0,0", "2,12,0,0", "3,20,0,0"]
(files / "drive.csv").write_text("\n".join(rows))
pull = cdcr.TensionTable.load(files / "drive.csv", model, interpolation="previous")

# %%
# Events
# ------
# Functions of time and state that go through zero; attributes as SciPy's ``solve_ivp`` has them.

SHELF = 0.6  # height [m]


def turns(t, q, qd):
    return q @ qd


def touches(t, q, qd):
    return model.tip(q)[1][2] - SHELF


touches.direction = -1  # from above
touches.terminal = True

t = np.linspace(0.0, 6.0, 301)
run = cdcr.simulate(model, [0, 0], [0, 0], t=t, tension=pull, events=[turns, touches])
turning = [event for event in run.events if event.event == 0]
touch = run.events[-1]
speed = np.linalg.norm(model.jacobian(touch.q, 0, 1.0)[:3] @ touch.qd)
print(f"{len(turning)} turns before the tip touches the shelf at {touch.time:.4f} s")
print(f"it arrives there at {speed:.3f} m/s, the run ends: {run.status.name}")

# %%
# The run as a file
# -----------------
# Every bit of every number comes back. A ``.nc`` file keeps the robot too.

run.save(files / "run.csv")
again = cdcr.Trajectory.load(files / "run.csv", model=model)
print(f"read back: {len(again)} samples, equal: {np.array_equal(again.q, run.q)}")
folder.cleanup()

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4), width_ratios=[3, 2])
left.plot(run.t, np.degrees(run.theta))
angles = [np.degrees(np.hypot(*event.q)) for event in turning]
left.plot([event.time for event in turning], angles, "o", label="turns")
left.plot(touch.time, np.degrees(np.hypot(*touch.q)), "D", label="touches the shelf")
left.set(xlabel="time [s]", ylabel="bending angle [deg]")
left.legend()
tip = np.array([*run.tip, model.tip(touch.q)[1]])
right.plot(tip[:, 0], tip[:, 2], label="path of the tip")
right.plot(tip[-1, 0], tip[-1, 2], "D", color="C2")
right.axhline(SHELF, color="0.5", linestyle="--", label="shelf")
right.set(xlabel="x [m]", ylabel="z [m]")
right.legend()
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
