"""A robot file as people write it, and how the tests read and change it."""

from __future__ import annotations

from pathlib import Path

import cdcr

FILE = """\
gravity = [0, 0, -9.81]
payload = 0.1

[[sections]]
length = 0.8
backbone_mass = 0.03
backbone_diameter = 0.005
youngs_modulus = 9.5e9
disk_mass = 0.008
disk_diameter = 0.04
num_disks = 10
cable_radius = 0.019
cable_angles = [0.0, 2.0, 4.0]
damping = 1e-3
"""


def load(folder: Path, text: str) -> cdcr.Robot:
    path = folder / "robot.toml"
    path.write_text(text, encoding="utf-8")
    return cdcr.Robot.load(path)


def replaced(old: str, new: str) -> str:
    assert old in FILE
    return FILE.replace(old, new)
