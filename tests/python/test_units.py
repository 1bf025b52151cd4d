"""Numbers that look like those of another unit: a warning asks."""

import math
import re
import warnings
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr

SECTION = cdcr.robots.amouri2020(damping=0.02).sections[0]


def robot(**changes: Any) -> cdcr.Robot:
    return cdcr.Robot(sections=[SECTION, replace(SECTION, **changes)])


def test_angles_of_cables_in_degrees() -> None:
    with pytest.warns(UserWarning, match="degrees") as caught:
        robot(cable_angles=[0, 90, 180, 270])
    assert str(caught[0].message) == (
        "section 2: cable_angles[1] = 90 rad is more than a full turn: is it in degrees? In a "
        "file, cable_angles_deg takes them; in Python, math.radians(90)"
    )
    assert caught[0].filename == __file__
    cable = cdcr.Cable(radius=0.02, angle=-120.0, end_section=0)
    with pytest.warns(UserWarning, match=r"^cable 1 of cables: angle = -120 rad .* angle_deg"):
        cdcr.Robot(sections=[SECTION], cables=[cable])


@pytest.mark.parametrize("modulus", [0.05, 9.5, 50.0, 999.0])
def test_a_modulus_in_gigapascals(modulus: float) -> None:
    with pytest.warns(UserWarning, match=r"^section 2: youngs_modulus = .* is it in GPa\?"):
        robot(youngs_modulus=modulus)
    with pytest.warns(UserWarning, match=r"^section 2: shear_modulus = .* is it in GPa\?"):
        robot(shear_modulus=modulus)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"length": 800.0}, "section 2: length = 800 m looks like millimetres: lengths are in m"),
        (
            {"length": 800.0, "backbone_diameter": 5.0, "cable_radius": 19.0},
            "section 2: length = 800 m looks like millimetres: lengths are in m",
        ),
        (
            {"cable_radius": 19.0},
            "section 2: cable_radius = 19 m, of a robot 1.604 m long, looks like millimetres: "
            "lengths are in m",
        ),
        (
            {"disk_diameter": 40.0},
            "section 2: disk_diameter = 40 m, of a robot 1.604 m long, looks like millimetres: "
            "lengths are in m",
        ),
        (
            {"backbone_mass": 32.4},
            "section 2: backbone_mass = 32.4 kg makes the backbone denser than any material: is it "
            "in g? Masses are in kg",
        ),
        (
            {"backbone_diameter": 5.0},
            "section 2: backbone_diameter = 5 m, of a robot 1.604 m long, looks like millimetres: "
            "lengths are in m",
        ),
        (
            {"backbone_diameter": 0.9},
            "section 2: backbone_diameter = 0.9 m, of a robot 1.604 m long, looks like "
            "millimetres: lengths are in m",
        ),
        (
            {"disk_mass": 12.0},
            "section 2: disk_mass = 12 kg makes disks denser than any material: is it in g? Masses "
            "are in kg",
        ),
        (
            {"cable_friction": 30.0},
            "section 2: cable_friction = 30 is more than any materials have: is it in per cent?",
        ),
    ],
)
def test_lengths_masses_and_friction(changes: dict[str, float], sentence: str) -> None:
    with pytest.warns(UserWarning, match="section 2") as caught:
        robot(**changes)
    assert [str(one.message) for one in caught] == [sentence]


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        (
            {"cables": [cdcr.Cable(radius=(10.0, 12.0), angle=(0.0, 0.0), end_section=0)]},
            "cable 1 of cables: radius = 12 m, of a robot 0.802 m long, looks like millimetres: ",
        ),
        (
            {"payload": 0.01, "payload_position": (0.0, 3.0, 4.0)},
            "payload_position = 5 m, of a robot 0.802 m long, looks like millimetres: lengths are",
        ),
        (
            {"tool": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 100], [0, 0, 0, 1]]},
            "the place of tool = 100 m, of a robot 0.802 m long, looks like millimetres: lengths",
        ),
        (
            {"gravity": (0.0, 0.0, -9810.0)},
            "gravity = 9810 m/s^2 is more than a hundred times the earth's: is it in mm/s^2?",
        ),
    ],
)
def test_what_stands_beside_the_sections(changes: dict[str, Any], sentence: str) -> None:
    with pytest.warns(UserWarning, match=re.escape(sentence)) as caught:
        cdcr.Robot(sections=[SECTION], **changes)
    (told,) = [str(one.message) for one in caught]
    assert told.startswith(sentence)


def test_a_small_robot_in_many_parts_and_a_long_one_are_not_asked() -> None:
    long = replace(SECTION, length=50.0, backbone_diameter=0.05, backbone_mass=200.0)
    short = replace(SECTION, length=0.03)  # its disks are wider than it is long
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        cdcr.Robot(sections=[long])
        cdcr.Robot(sections=[short])


def test_a_file_asks_too(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    cdcr.robots.amouri2020().save(path)
    path.write_text(path.read_text().replace("9500000000.0", "9.5"))
    with pytest.warns(UserWarning, match=r"is it in GPa\?"):
        cdcr.Robot.load(path)


def test_a_file_asks_about_a_shear_modulus(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    cdcr.Robot(sections=[replace(SECTION, shear_modulus=27e9)]).save(path)
    path.write_text(path.read_text().replace("27000000000.0", "27.0"))
    with pytest.warns(UserWarning, match=r"section 1: shear_modulus = 27 Pa .* is it in GPa\?"):
        cdcr.Robot.load(path)


def driven() -> cdcr.Model:
    return cdcr.Model(cdcr.Robot(sections=[replace(SECTION, cable_stiffness=5e3)]))


class Hold(cdcr.Controller):
    """Asks for the same at all times."""

    def __init__(self, command: list[float]) -> None:
        super().__init__(period=1e-4)
        self.command = command

    def update(self, t: float, q: Any, qd: Any) -> list[float]:
        """Return it."""
        return self.command


def looped(model: cdcr.Model, command: list[float]) -> None:
    loop = cdcr.Loop(model, Hold(command), step=1e-4)
    loop.reset(np.zeros(2), np.zeros(2))
    loop.run(2e-4)


def step_at_rest(model: cdcr.Model, command: list[float]) -> None:
    with suppress(cdcr.ConvergenceError):
        cdcr.stable_step(model, tension=command)


@pytest.mark.parametrize("tension", [[0.0, 0.0, 0.0], [0.802, 5.0, 0.0], [9.0, 0.802, 0.802]])
def test_newtons_for_a_cable_driven_by_length(tension: list[float]) -> None:
    model, zeros = driven(), np.zeros(2)
    calls: list[Any] = [
        lambda: cdcr.simulate(model, zeros, zeros, t=[0.0, 1e-3], tension=tension),
        lambda: cdcr.simulate(model, zeros, zeros, t=[0.0, 1e-3], tension=lambda t: tension),
        lambda: model.equilibrium(tension, throw=False),
        lambda: model.find_equilibrium(tension),
        lambda: step_at_rest(model, tension),
        lambda: cdcr.quasi_static(model, [tension], throw=False),
        lambda: cdcr.quasi_static(model, np.array([model.rest_command(), tension]), throw=False),
        lambda: cdcr.rollout(model, zeros, zeros, step=1e-4, steps=2, tension=tension),
        lambda: looped(model, tension),
    ]
    for call in calls:
        told = r"driven by length .* is that a tension \[N\]\?"
        with pytest.warns(UserWarning, match=told) as caught:
            call()
        assert {one.filename for one in caught} == {__file__}


def test_what_is_sound_is_not_asked_about() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        robot(cable_angles=[-2.0 * math.pi, 2.0 * math.pi, math.radians(359.0)])
        robot(youngs_modulus=1e3, shear_modulus=1e3)
        model, zeros = driven(), np.zeros(2)
        for length in (model.rest_command(), [0.802, 0.79, 8.0]):
            cdcr.simulate(model, zeros, zeros, t=[0.0, 1e-3], tension=length)
            model.find_equilibrium(length)
            model.equilibrium(length, throw=False)
            cdcr.quasi_static(model, np.array([length]), throw=False)
            cdcr.rollout(model, zeros, zeros, step=1e-4, steps=2, tension=length)
            looped(model, list(length))
        cdcr.simulate(cdcr.Model(robot()), np.zeros(4), np.zeros(4), t=[0.0], tension=np.zeros(6))
