"""Measurements made up: a robot with values that a fit does not know, and noise."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import cdcr
from cdcr.base.arrays import FloatArray

LENGTH = cdcr.Section(
    length=0.1,
    backbone_mass=0.004,
    backbone_diameter=1e-3,
    youngs_modulus=60e9,
    num_disks=5,
    disk_mass=0.002,
    disk_diameter=0.02,
    cable_radius=8e-3,
    cable_angles=[0.0, 2.0943951, 4.1887902],
    damping=2e-4,
)
ROBOT = cdcr.Robot(sections=[LENGTH, LENGTH], gravity=(0.0, 0.0, -9.81))
BY_LENGTH = replace(
    ROBOT,
    sections=tuple(replace(one, cable_stiffness=2e4) for one in ROBOT.sections),
    payload=0.005,
)
NOISE = 1e-3  # [m]


def pulls(number: int, seed: int = 0, high: float = 4.0) -> FloatArray:
    """Return tensions (number, 6) [N], two cables slack in each section."""
    drawn = np.random.default_rng(seed)
    tension = np.zeros((number, 6))
    for row in tension:
        for section in (0, 3):
            row[section + drawn.integers(3)] = drawn.uniform(0.2, high)
    return tension


def tips(robot: cdcr.Robot, commands: FloatArray, noise: float = 0.0, seed: int = 0) -> FloatArray:
    """Return tips (N, 3) at rest [m]."""
    model = cdcr.Model(robot)
    q = np.array([model.equilibrium(command) for command in commands])
    tip: FloatArray = model.tips(q)
    return tip + np.random.default_rng(seed).normal(0.0, noise, tip.shape) if noise else tip
