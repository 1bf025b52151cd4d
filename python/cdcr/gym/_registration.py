"""The environments that Gymnasium knows by name."""

from __future__ import annotations

import gymnasium

EPISODE = 200  # steps


def register() -> None:
    """Tell Gymnasium of the environments, once."""
    for task in ("reach", "track"):
        for suffix, robot in (("", "amouri2020"), ("ThreeSections", "three_sections")):
            name = f"cdcr/{task.capitalize()}{suffix}-v0"
            if name not in gymnasium.registry:
                gymnasium.register(
                    name,
                    entry_point="cdcr.gym:RobotEnv",
                    vector_entry_point="cdcr.gym:RobotVectorEnv",
                    max_episode_steps=EPISODE,
                    kwargs={"task": task, "robot": robot},
                )
