"""
Learn to reach
==============

Thirty-two policies at a time try to bring the tip to random targets, and augmented random search
(Mania, Guy, Recht 2018, arXiv:1803.07055) takes from what they earn the next one to vary. It knows
nothing of the robot: a policy is a matrix that turns what is observed into three tensions.

Look at the learning curve: it still climbs at the end, and the tip already stops near its targets.
It shows targets that the search never sees.
"""

import sys

import gymnasium
import matplotlib.pyplot as plt
import numpy as np

import cdcr.gym

ROUNDS, LOOK = 60, 3  # and every how many rounds the policy is examined
DIRECTIONS, BEST = 16, 8  # in which the policy is varied, both ways, and that count
TARGETS, STEPS = 4, 60  # of each policy, and steps of 0.02 s for each target
NOISE, RATE = 0.2, 0.1

# %%
# What a policy earns
# -------------------
# All policies go after the same targets, all at once. The reward of a step is minus the distance of
# tip and target in lengths of the robot, and a little for tension.

envs = gymnasium.make_vec("cdcr/Reach-v0", num_envs=2 * DIRECTIONS * TARGETS)
scale = np.array([1, 1, 0.1, 0.1, 1, 1, 1, 1, 1, 1])  # q, qd [rad/s], tip, what is missing


def attempt(policies, seeds):
    """Rewards of all attempts, summed, and their distances in every step [m]."""
    each = np.repeat(policies, len(seeds), axis=0)
    observed, _ = envs.reset(seed=np.tile(seeds, len(policies)).tolist())
    earned, distances = np.zeros(len(each)), []
    for _ in range(STEPS):
        features = np.column_stack([observed * scale, np.ones(len(each))])
        action = np.einsum("kij,kj->ki", each, features).clip(-1, 1)
        observed, reward, _, _, info = envs.step(action.astype(np.float32))
        earned += reward
        distances.append(info["distance"])
    return earned.reshape(len(policies), -1), np.array(distances)


def examine(policy):
    """Mean earnings and distances of a policy, at 128 targets that it never learns from."""
    earned, distances = attempt([policy], 10_000 + np.arange(envs.num_envs))
    return earned.mean(), distances


# %%
# The search
# ----------
# Directions that earned more one way than the other move the policy that way.

rng = np.random.default_rng(0)
policy = np.zeros((3, 11))
policy[:, -1] = -0.5  # a quarter of the largest tension in each cable
curve, (_, before) = [examine(policy)[0]], examine(policy)
for done in range(1, ROUNDS + 1):
    direction = rng.normal(size=(DIRECTIONS, *policy.shape))
    varied = [*(policy + NOISE * direction), *(policy - NOISE * direction)]
    earned, _ = attempt(varied, rng.integers(10_000, size=TARGETS))
    pair = earned.mean(axis=1).reshape(2, DIRECTIONS)
    best = np.argsort(pair.max(axis=0))[-BEST:]
    gain = (pair[0] - pair[1])[best] / (BEST * pair[:, best].std())
    policy += RATE * np.einsum("k,kij->ij", gain, direction[best])
    if done % LOOK == 0:
        curve.append(examine(policy)[0])
_, after = examine(policy)
hours = ROUNDS * envs.num_envs * STEPS * 0.02 / 3600
print(f"learned from {hours:.1f} h of the robot's time")
print(f"mean reward of {STEPS} steps: {curve[0]:.1f} before, {curve[-1]:.1f} after")
print(f"distance at the end: {before[-1].mean():.3f} m before, {after[-1].mean():.3f} m after")

# %%
# The picture
# -----------

plt.style.use(cdcr.plotting.STYLE)
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
left.plot(LOOK * np.arange(len(curve)), curve)
left.set(xlabel="rounds", ylabel=f"mean reward of {STEPS} steps [-]")
t = 0.02 * np.arange(1, STEPS + 1)
for name, distances, color in (("before", before, "0.5"), ("after", after, "C0")):
    right.plot(t, np.median(distances, axis=1), color=color, label=f"{name}, median")
    low, high = np.quantile(distances, [0.1, 0.9], axis=1)
    right.fill_between(t, low, high, color=color, alpha=0.2, label="80 % of targets")
right.set(xlabel="time [s]", ylabel="distance of tip and target [m]", ylim=(0, None))
right.legend()
fig.tight_layout()
cdcr.plotting.show_or_save(fig, sys.argv[1:])
