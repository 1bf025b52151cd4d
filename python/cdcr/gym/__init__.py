"""Robots as environments of Gymnasium, to learn controllers in. Extra ``gym``.

``import cdcr.gym`` registers them: ``cdcr/Reach-v0``, ``cdcr/Track-v0``,
``cdcr/ReachThreeSections-v0`` and ``cdcr/TrackThreeSections-v0``. ``gymnasium.make`` and
``gymnasium.make_vec`` take every keyword of `RobotEnv`; ``make_vec`` makes a `RobotVectorEnv`.

Examples
--------
>>> import gymnasium
>>> import cdcr.gym
>>> env = gymnasium.make("cdcr/Reach-v0", action="length")
>>> observation, info = env.reset(seed=1)
>>> observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
>>> sorted(info)
['distance', 'is_success', 'reward_control', 'reward_distance']
"""
# ruff: noqa: E402 - the extra is asked for before its first import, so that one sentence says so

from cdcr.base.extras import require

require("gymnasium", "gym")

from cdcr.gym._env import RobotEnv
from cdcr.gym._registration import register
from cdcr.gym._vector import RobotVectorEnv

__all__ = ["RobotEnv", "RobotVectorEnv"]

register()
