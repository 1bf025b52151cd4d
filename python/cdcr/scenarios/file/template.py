"""The scenario file that ``cdcr new`` writes: it runs as it is and shows everything else.

In template.toml, sentences begin with ``# ``; what can be switched on begins with ``#`` alone.
"""

from __future__ import annotations

from pathlib import Path

from cdcr.robot.cable import Cable
from cdcr.robot.file import robot_lines
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section


def template() -> str:
    """Return the text of the file; every field of a robot is in it."""
    text = Path(__file__).with_suffix(".toml").read_text(encoding="utf-8")
    return text.replace("#[robot]\n#sections = []\n", _robot())


def _robot() -> str:
    """Return a robot with every field there is, switched off."""
    section = Section(
        length=0.8,
        backbone_mass=0.03,
        backbone_diameter=0.005,
        youngs_modulus=9.5e9,
        disk_mass=0.01,
        disk_diameter=0.08,
        num_disks=10,
        cable_radius=0.035,
        cable_angles=(0.0, 2.0),
        damping=1e-3,
    )
    cable = Cable(radius=0.035, angle=4.0, end_section=0, friction=0.0)
    lines = robot_lines(Robot(sections=[section], cables=[cable]), all_fields=True)
    text = "".join(f"#{line}\n" for line in ["[robot]", *lines] if line)
    return text.replace("#[[", "#[[robot.")
