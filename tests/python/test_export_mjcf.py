"""Models of MuJoCo: at rest, about rest and in motion they are the robot cut into as many parts.

`pytest -s` prints how near they are.
"""

import dataclasses
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import cdcr
from cdcr.export.links import Chain as Links
from cdcr.export.mjcf import mjcf_text

mujoco: Any = pytest.importorskip("mujoco", reason="its models are compared with MuJoCo itself")

Array = NDArray[np.float64]
LINKS = 10
# Relative to the robot's length, of tips and cables, and to themselves, of frequencies: what the
# help of write_mjcf says.
TIP, LENGTH, FREQUENCY = 5e-3, 5e-4, 1e-2
ORDER = 3.4  # of an error with twice the links: 4 but for what is higher
MOTION = 1e-2  # of the tip relative to the robot's length, after most of a swing


class Chain:
    """A robot in MuJoCo."""

    def __init__(self, robot: cdcr.Robot, links: int = LINKS) -> None:
        self.model = mujoco.MjModel.from_xml_string(mjcf_text(robot, Path("a.xml"), links=links))
        self.data = mujoco.MjData(self.model)
        mujoco.mj_resetDataKeyframe(self.model, self.data, 0)

    def force(self, angles: Array) -> Array:
        data = self.data
        data.qpos[:], data.qvel[:] = angles, 0.0
        mujoco.mj_forward(self.model, data)
        total = np.zeros_like(angles)
        total[:] = data.qfrc_passive + data.qfrc_actuator - data.qfrc_bias
        return total

    def stiffness(self, angles: Array) -> Array:
        steps = 1e-6 * np.eye(self.model.nv)
        columns = [(self.force(angles - e) - self.force(angles + e)) / 2e-6 for e in steps]
        return np.transpose(np.array(columns, dtype=np.float64))

    def rest(self, commands: Array) -> Array:
        """Angles at rest, by Newton's method from the straight robot, commands growing."""
        angles, straight = np.zeros(self.model.nv), self.data.ctrl.copy()
        for share in (0.25, 0.5, 0.75, 1.0):
            self.data.ctrl[:] = straight + share * (commands - straight)
            for _ in range(20):
                change = np.linalg.solve(self.stiffness(angles), self.force(angles))
                angles = angles + change
                if np.abs(change).max() < 1e-8:
                    break
        assert np.abs(self.force(angles)).max() < 1e-8
        return angles

    def frequencies(self, angles: Array) -> Array:
        stiffness = self.stiffness(angles)
        mass = np.zeros_like(stiffness)
        for column, unit in zip(mass.T, np.eye(self.model.nv), strict=True):
            product = np.zeros(self.model.nv)
            mujoco.mj_mulM(self.model, self.data, product, unit)
            column[:] = product
        eigenvalues = np.linalg.eigvals(np.linalg.solve(mass, stiffness))
        assert np.abs(eigenvalues.imag).max() < 1e-3 * np.abs(eigenvalues).max()
        return np.array(np.sort(np.sqrt(eigenvalues.real)))


def hanging() -> tuple[cdcr.Robot, list[float]]:
    return cdcr.robots.amouri2020(gravity=(0.0, 0.0, 9.81)), [12.0, 0.0, 2.0]


def upright() -> tuple[cdcr.Robot, list[float]]:
    robot = cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81), payload=0.005)
    return robot, [3.0, 0.0, 0.0, 2.0, 0.0, 0.0, 1.0, 0.0, 0.0]


def sideways() -> tuple[cdcr.Robot, list[float]]:
    """A base that lies, a payload beside its tip, and a cable of its own."""
    robot = cdcr.robots.amouri2020(gravity=(0.0, 0.0, -2.0), payload=0.01)
    robot = dataclasses.replace(
        robot,
        base_orientation=((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
        base_position=(0.1, -0.2, 0.3),
        tool=((0, 0, 1, 0.02), (1, 0, 0, 0), (0, 1, 0, 0.05), (0, 0, 0, 1)),
        payload_position=(0.03, 0.02, 0.05),
        payload_inertia=((2e-5, 1e-6, 0.0), (1e-6, 3e-5, 0.0), (0.0, 0.0, 2e-5)),
        cables=(cdcr.Cable(radius=0.01, angle=1.0, end_section=0),),
    )
    return robot, [1.0, 0.0, 5.0, 4.0]


def by_length() -> tuple[cdcr.Robot, list[float]]:
    robot = cdcr.robots.amouri2020(gravity=(0.0, 0.0, -1.0), damping=0.02)
    section = dataclasses.replace(robot.sections[0], cable_stiffness=2e3, cable_damping=2.0)
    return dataclasses.replace(robot, sections=(section,)), [0.795, 0.803, 0.81]


Case = Callable[[], tuple[cdcr.Robot, list[float]]]
CASES = pytest.mark.parametrize("case", [hanging, upright, sideways, by_length])


def errors(case: Case, links: int) -> tuple[float, float, float]:
    """Of tip, cable lengths and frequencies, beside the robot cut into ten parts a section."""
    robot, commands = case()
    found = Chain(robot, links)
    angles = found.rest(np.array(commands))
    tip, lengths = found.data.site("tip").xpos.copy(), found.data.ten_length.copy()
    model = cdcr.Model(robot.subdivide(LINKS))
    q = model.equilibrium(commands)
    frequency = found.frequencies(angles)[:4] / model.modes(q, commands).frequency[:4]
    R, p = model.tip(q)
    found.force(angles)
    assert np.abs(found.data.site("tip").xmat.reshape(3, 3) - R).max() < 5.0 * TIP
    return (
        float(np.linalg.norm(tip - p) / robot.length),
        float(np.abs(lengths - model.cable_lengths(q)).max() / robot.length),
        float(np.abs(frequency - 1.0).max()),
    )


@CASES
def test_rest_and_vibration(case: Case) -> None:
    tip, length, frequency = errors(case, LINKS)
    print(f"{case.__name__}: tip {tip:.2%}, cables {length:.3%}, frequencies {frequency:.2%}")
    assert tip < TIP
    assert length < LENGTH
    assert frequency < FREQUENCY


@pytest.mark.parametrize("case", [hanging, by_length])
def test_twice_the_links_have_a_quarter_of_the_error(case: Case) -> None:
    robot, commands = case()
    tips = []
    for links in (8, 16, 32):
        found = Chain(robot, links)
        found.rest(np.array(commands))
        tips.append(found.data.site("tip").xpos.copy())
    assert np.linalg.norm(tips[1] - tips[0]) > ORDER * np.linalg.norm(tips[2] - tips[1])


def test_angles_of_hinges_add_up_to_q() -> None:
    robot, tension = cdcr.robots.three_sections(), [1.0, 0.5, 0, 0, 1.0, 0, 0.2, 0, 0.4]
    angles = Chain(robot).rest(np.array(tension))
    model = Chain(robot).model
    total = dict.fromkeys(["1x", "1y", "2x", "2y", "3x", "3y"], 0.0)
    for j in range(model.njnt):
        name = model.joint(j).name  # bend1_3x: section 1, part 3
        total[name[4] + name[-1]] += angles[model.joint(j).qposadr[0]]
    q = cdcr.Model(robot).equilibrium(tension)  # no gravity: arcs
    assert np.array(list(total.values())) == pytest.approx(q, abs=0.02 * np.abs(q).max())


def test_motion_is_that_of_the_robot() -> None:
    robot = cdcr.robots.amouri2020(gravity=(0.0, 0.0, 9.81), damping=0.005)
    found = Chain(robot)
    found.data.ctrl[:] = [8.0, 0.0, 3.0]
    model = cdcr.Model(robot.subdivide(LINKS))
    zero = np.zeros(model.num_coordinates)
    times = [0.0, 0.15, 0.3, 0.6]
    run = cdcr.simulate(model, zero, zero, t=times, tension=[8.0, 0.0, 3.0])
    assert np.abs(run.tip - run.tip[0]).max() > 0.2 * robot.length
    for time, tip in zip(times[1:], run.tip[1:], strict=True):
        while found.data.time < time - 0.5 * found.model.opt.timestep:
            mujoco.mj_step(found.model, found.data)
        error = np.linalg.norm(found.data.site("tip").xpos - tip) / robot.length
        print(f"t = {time} s: tip {error:.2%}")
        assert error < MOTION


def test_a_cable_driven_by_length_pulls_and_never_pushes() -> None:
    robot, _ = by_length()
    found = Chain(robot)
    found.data.ctrl[:] = [0.79, 0.85, 0.85]
    found.force(np.zeros(found.model.nv))
    straight = robot.length
    assert found.data.actuator_force[0] == pytest.approx(2e3 * (0.79 - straight))
    assert np.array_equal(found.data.actuator_force[1:], [0.0, 0.0])


def test_nothing_moves_without_tension_and_gravity() -> None:
    found = Chain(dataclasses.replace(by_length()[0], gravity=(0.0, 0.0, 0.0)))
    assert np.abs(found.force(np.zeros(found.model.nv))).max() < 1e-12
    for _ in range(10):
        mujoco.mj_step(found.model, found.data)
    assert np.abs(found.data.qpos).max() < 1e-12


@CASES
def test_links_have_the_mass_of_the_robot(case: Case) -> None:
    robot, _ = case()
    for links in (1, 3, 7):
        bodies = Links(robot, links).links
        assert sum(link.mass for link in bodies) == pytest.approx(robot.mass, rel=1e-12)
        moment = sum(
            link.mass * (link.center + np.array([0.0, 0.0, link.start])) for link in bodies
        )
        straight = np.zeros(2 * len(robot.sections))
        weight = [cdcr.Model(robot).with_gravity(-e).potential_energy(straight) for e in np.eye(3)]
        turned = np.array(robot.base_orientation) @ moment
        turned += robot.mass * np.array(robot.base_position)
        assert turned == pytest.approx(weight, abs=1e-12)


def test_cables_have_their_pretension() -> None:
    section = dataclasses.replace(by_length()[0].sections[0], cable_pretension=3.0)
    robot = cdcr.Robot(sections=[section])
    chain = Chain(robot)
    chain.force(np.zeros(chain.model.nv))
    model = cdcr.Model(robot)
    wanted = model.cable_tensions([0.0, 0.0], [0.0, 0.0], model.rest_command())
    assert -chain.data.actuator_force == pytest.approx(wanted, rel=1e-9)
    assert wanted == pytest.approx(3.0)


@pytest.mark.parametrize(
    ("field", "left"),
    [
        ("cable_friction", "friction of cables"),
        ("cable_entry_friction", "friction of cables"),
        ("cable_viscosity", "friction of cables"),
        ("cable_backlash", "play of drives"),
    ],
)
def test_what_is_left_out_is_told(field: str, left: str, tmp_path: Path) -> None:
    change: dict[str, Any] = {field: 1e-3}
    section = dataclasses.replace(by_length()[0].sections[0], **change)
    with pytest.warns(UserWarning, match=f"leaves the {left} out"):
        cdcr.export.write_mjcf(cdcr.Robot(sections=[section]), tmp_path / "a.xml")


def test_refusals(tmp_path: Path) -> None:
    robot = cdcr.robots.three_sections()
    file = tmp_path / "a.xml"
    for links in (0, 107, 2.5):
        with pytest.raises(
            ValueError, match="links must be a whole number 1 to 106 for 3 sections"
        ):
            cdcr.export.write_mjcf(robot, file, links=links)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"must end in \.xml, got 'a\.mjb'"):
        cdcr.export.write_mjcf(robot, tmp_path / "a.mjb")
    with pytest.raises(
        ValueError, match="joint 1 of section 1 has none; give the section a backbone_mass"
    ):
        cdcr.export.write_mjcf(cdcr.robots.rao2021(), file)
    assert list(tmp_path.iterdir()) == []
    cdcr.export.write_mjcf(robot, file)
    with pytest.raises(FileExistsError, match="overwrite=True"):
        cdcr.export.write_mjcf(robot, file)


def test_bends_to_the_limit_and_no_further() -> None:
    """A pulled cable shortens to where the joints end: its sites do not pass each other."""
    robot = cdcr.robots.amouri2020()
    found = Chain(robot)
    bend = math.pi / LINKS
    last = None
    for share in np.linspace(0.0, 1.0, 21):
        found.force(np.full(found.model.nv, share * bend))
        shortest = found.data.ten_length.min()
        assert last is None or shortest < last
        last = shortest
