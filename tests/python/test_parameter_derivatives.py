"""Derivatives with respect to numbers of the robot: 80 digits, closed forms, differences."""

import json
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr

CASES: list[dict[str, Any]] = json.loads(
    (Path(__file__).parents[1] / "data" / "parameter_derivatives.json").read_text(encoding="utf-8")
)
ROUNDING = 2e-11  # of the largest of a column: differences of eighth order of lengths and diameters
SMALL_STEP = 1e-7  # relative error of central differences of fourth order, of the tests


def changed(robot: cdcr.Robot, path: str, factor: float = 1.0, by: float = 0.0) -> cdcr.Robot:
    """Return a robot with one number changed; of all sections where the path says so."""
    words = path.split(".")
    if words[0] == "payload":
        return replace(robot, payload=robot.payload * factor + by)
    sections = list(robot.sections)
    picked = range(len(sections)) if words[1] == "*" else [int(words[1]) - 1]
    for i in picked:
        value = getattr(sections[i], words[2]) * factor + by
        sections[i] = replace(sections[i], **{words[2]: value})
    return replace(robot, sections=tuple(sections))


def difference(function: Callable[[float], Any], value: float, share: float = 1e-3) -> Any:
    """Return the derivative by a number of that size: central, of fourth order."""
    step = share * value
    near = function(step) - function(-step)
    far = function(2 * step) - function(-2 * step)
    return (8 * near - far) / (12 * step)


@pytest.mark.parametrize("case", CASES, ids=["one section", "two sections"])
def test_80_digits(case: dict[str, Any]) -> None:
    """Made of mass elements at 80 digits, tests/data/parameter_derivatives.py."""
    sections = [cdcr.Section(**one) for one in case["robot"]["sections"]]
    robot = cdcr.Robot(
        sections=sections, gravity=case["robot"]["gravity"], payload=case["robot"]["payload"]
    )
    model = cdcr.Model(robot)
    state = case["q"], case["qd"], case["tension"]
    assert model.forward_dynamics(*state) == pytest.approx(
        [float(one) for one in case["qdd"]], rel=1e-12
    )
    paths = list(case["dqdd"])
    slopes = model.parameter_derivatives(*state, paths)
    assert slopes.shape == (model.num_coordinates, len(paths))
    for k, path in enumerate(paths):
        wanted = np.array([float(one) for one in case["dqdd"][path]])
        assert slopes[:, k] == pytest.approx(wanted, abs=ROUNDING * abs(wanted).max()), path


ROBOTS = {
    "friction and springs": cdcr.Robot(
        sections=[
            cdcr.Section(
                length=0.3, backbone_mass=0.03, backbone_diameter=1e-3, youngs_modulus=6e10,
                disk_mass=3e-3, disk_diameter=0.02, num_disks=6, cable_radius=8e-3,
                cable_angles=[0.1, 2.2, 4.3], damping=2e-3, cable_friction=0.3,
                cable_stiffness=4e3, cable_damping=3.0,
            )
        ] * 2,
        gravity=(0.0, 1.0, -9.81),
        payload=0.02,
    ),
    "rods": cdcr.Robot(
        sections=[
            cdcr.Section(
                length=0.3, backbone_mass=0.03, backbone_diameter=1.2e-3, youngs_modulus=6e10,
                disk_mass=3e-3, disk_diameter=0.02, num_disks=6, cable_radius=8e-3,
                cable_angles=[0.1, 2.2, 4.3], damping=2e-3, bending_order=1, twist_order=0,
                shear_modulus=2.3e10,
            )
        ],
        gravity=(0.0, 1.0, -9.81),
        payload=0.02,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize(
    "path",
    ["length", "youngs_modulus", "cable_radius", "disk_diameter", "backbone_mass", "payload"],
)
def test_differences(name: str, path: str) -> None:
    """Rods and rubbing cables under a wrench, against accelerations of rebuilt robots."""
    robot = ROBOTS[name]
    full = path if path == "payload" else f"sections.*.{path}"
    model = cdcr.Model(robot)
    rng = np.random.default_rng(5)
    q, qd = rng.uniform(-0.4, 0.4, (2, model.num_coordinates))
    rest = model.rest_command()
    command = np.where(rest > 0, 0.95 * rest, 2.0)
    push = cdcr.Wrench(section=0, force=(0.3, -0.2, 0.1), fraction=0.6)

    def accelerations(by: float) -> Any:
        return cdcr.Model(changed(robot, full, by=by)).forward_dynamics(q, qd, command, push)

    size = robot.payload if path == "payload" else getattr(robot.sections[0], path)
    wanted = difference(accelerations, size)
    found = model.parameter_derivatives(q, qd, command, full, push)[:, 0]
    assert found == pytest.approx(wanted, abs=SMALL_STEP * abs(wanted).max())


def test_many_states_at_once() -> None:
    """An answer for each state, as the functions of one state give it."""
    model = cdcr.Model(cdcr.robots.three_sections())
    q = np.random.default_rng(1).uniform(-1, 1, (4, 6))
    paths = ["sections.2.length", "payload", "gravity.z"]
    all_at_once = model.parameter_derivatives(q, q[0], np.ones(9), paths)
    assert all_at_once.shape == (4, 6, 3)
    for one, slopes in zip(q, all_at_once, strict=True):
        assert np.array_equal(slopes, model.parameter_derivatives(one, q[0], np.ones(9), paths))


def test_equilibrium_in_closed_form() -> None:
    """Without weight q = r l F e/(E I), a power of each number."""
    robot = cdcr.robots.amouri2020()
    model = cdcr.Model(robot)
    pull = [3.0, 1.0, 0.5]
    q = model.equilibrium(pull)
    powers = {"youngs_modulus": -1, "cable_radius": 1, "length": 1, "backbone_diameter": -4}
    for name, power in powers.items():
        slope = model.equilibrium_derivatives(q, pull, f"sections.1.{name}")[:, 0]
        value = getattr(robot.sections[0], name)
        assert slope * value == pytest.approx(power * q, rel=1e-11)


def test_equilibrium_under_weight() -> None:
    """Against equilibria of rebuilt robots."""
    robot = cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81), payload=0.05)
    model = cdcr.Model(robot)
    pull = np.linspace(1.0, 2.0, 9)
    q = model.equilibrium(pull)
    for path, size in {"payload": 0.05, "sections.2.length": robot.sections[1].length}.items():

        def rest(by: float, path: str = path) -> Any:
            return cdcr.Model(changed(robot, path, by=by)).equilibrium(pull, q)

        wanted = difference(rest, size)
        found = model.equilibrium_derivatives(q, pull, path)[:, 0]
        assert found == pytest.approx(wanted, abs=SMALL_STEP * abs(wanted).max())


def test_numbers_at_their_bounds() -> None:
    """No payload, no damping, a disk at the tip: one side is left, and is enough."""
    robot = cdcr.robots.amouri2020(gravity=(0.0, 0.0, -9.81))
    disks = replace(robot.sections[0], disk_positions=(0.5, 1.0), num_disks=2)
    model = cdcr.Model(replace(robot, sections=(disks,)))
    state = [0.7, 0.2], [1.0, -2.0], [1.0, 0.0, 0.0]
    by_damping, by_payload, by_place = model.parameter_derivatives(
        *state, ["sections.1.damping", "payload", "sections.1.disk_positions.2"]
    ).T
    mass = model.mass_matrix(state[0])
    assert mass @ by_damping == pytest.approx([-1.0, 2.0], rel=1e-12)
    heavy = cdcr.Model(replace(model.robot, payload=1e-7))
    qdd = model.forward_dynamics(*state)
    change = (heavy.forward_dynamics(*state) - qdd) / 1e-7
    assert by_payload == pytest.approx(change, rel=1e-3)
    inner = replace(disks, disk_positions=(0.5, 1.0 - 1e-6))
    there = cdcr.Model(replace(robot, sections=(inner,))).forward_dynamics(*state)
    assert by_place == pytest.approx((qdd - there) / 1e-6, rel=1e-3)


@pytest.mark.parametrize(
    ("path", "sentence"),
    [
        ("sections.1.youngs_modulos", r"there is no parameter .* Did you mean"),
        ("sections.1.num_disks", "is a whole number, which has no derivative"),
        ("sections.1.cable_stiffness", "parameter sections.1.cable_stiffness: .* another kind"),
    ],
)
def test_refusals(path: Any, sentence: str) -> None:
    """Paths of nothing, of whole numbers, of what a cable is."""
    model = cdcr.Model(cdcr.robots.amouri2020())
    with pytest.raises(ValueError, match=sentence):
        model.parameter_derivatives([0.1, 0.0], [0.0, 0.0], [1.0, 0.0, 0.0], path)


@pytest.mark.parametrize("path", [[1], 1, None])
def test_what_is_no_path(path: Any) -> None:
    """A number is none, alone and among others."""
    model = cdcr.Model(cdcr.robots.amouri2020())
    with pytest.raises(TypeError, match=r"parameters must be paths, such as .*, got (1|None)"):
        model.equilibrium_derivatives([0.1, 0.0], [1.0, 0.0, 0.0], path)


def test_angles_of_cables() -> None:
    """The moment of a cable turns with its angle."""
    robot = cdcr.robots.amouri2020()
    model = cdcr.Model(robot)
    path = "sections.1.cable_angles.2"
    slope = model.parameter_derivatives([0.0, 0.0], [0.0, 0.0], [0.0, 2.0, 0.0], path)[:, 0]
    angle, radius = robot.sections[0].cable_angles[1], robot.sections[0].cable_radius
    moment = 2.0 * radius * np.array([-math.sin(angle), math.cos(angle)])
    assert model.mass_matrix([0.0, 0.0]) @ slope == pytest.approx(moment, rel=1e-11)
