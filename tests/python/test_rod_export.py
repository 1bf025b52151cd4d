"""Rods as FMUs, which move as in cdcr; chains of rigid links are made of arcs, tubes included."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.export.arcs import as_solid_arcs

# A dozen roundings.
REL = 1e-13

ROBOT = cdcr.robots.amouri2020(damping=0.01)
(SECTION,) = ROBOT.sections
HELIX = cdcr.Cable(radius=0.02, angle=[(0.0, 1.0)], end_section=0)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"sections": [replace(SECTION, stretch_order=0)]}, "section 1 is more than that"),
        ({"sections": [replace(SECTION, rest_twist=0.1)]}, "section 1 is more than that"),
        ({"cables": [HELIX]}, "cable 1 of cables does not run so"),
    ],
)
def test_no_chain_of_rigid_links_is_made_of_rods(
    change: dict[str, Any], sentence: str, tmp_path: Path
) -> None:
    robot = replace(ROBOT, **change)
    with pytest.raises(ValueError, match=f"a chain of rigid links can be made .*{sentence}"):
        cdcr.export.write_mjcf(robot, tmp_path / "arm.xml")


def test_a_rod_that_bends_alone_is_a_chain_of_links(tmp_path: Path) -> None:
    mujoco: Any = pytest.importorskip("mujoco", reason="needs MuJoCo, group test")
    rod = replace(SECTION, bending_order=3, nodes=24)
    robot = replace(ROBOT, sections=(rod,), gravity=(0.0, 0.0, 9.81))
    cdcr.export.write_mjcf(robot, tmp_path / "rod.xml", links=10)
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "rod.xml"))
    data = mujoco.MjData(model)
    data.ctrl[:] = [4.0, 0.0, 1.0]
    for _ in range(4000):  # to rest: it is stopped where it is fastest
        mujoco.mj_step(model, data)
        if data.qvel @ data.qacc < 0.0:
            data.qvel[:] = 0.0
    assert abs(data.qacc).max() < 0.1
    wanted = cdcr.Model(robot)
    p = wanted.tip(wanted.equilibrium([4.0, 0.0, 1.0]))[1]
    assert np.linalg.norm(data.site("tip").xpos - p) < 1e-3 * robot.length
    arc = cdcr.Model(replace(robot, sections=(SECTION,)))
    bent = arc.tip(arc.equilibrium([4.0, 0.0, 1.0]))[1]
    assert np.linalg.norm(bent - p) > 4e-3 * robot.length  # which an arc is not


def test_a_rod_that_twists_vibrates_as_its_links_do(tmp_path: Path) -> None:
    """Bent by its cables, with a payload beside its tip, which twists it."""
    mujoco: Any = pytest.importorskip("mujoco", reason="needs MuJoCo, group test")
    tube = replace(SECTION, backbone_inner_diameter=0.003, shear_modulus=2e8, nodes=24)
    twisting = replace(tube, bending_order=3, twist_order=2, twist_damping=1e-5)
    robot = replace(
        ROBOT,
        sections=(twisting,),
        gravity=(0.0, 0.0, 9.81),
        payload=0.02,
        payload_position=(0.04, 0.0, 0.0),
        payload_inertia=((1e-6, 0.0, 0.0), (0.0, 1e-5, 0.0), (0.0, 0.0, 1e-5)),
    )
    cdcr.export.write_mjcf(robot, tmp_path / "rod.xml", links=20)
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "rod.xml"))
    data = mujoco.MjData(model)
    assert model.njnt == 60
    wound = model.joint("twist1_7")
    assert wound.stiffness[0] == pytest.approx(
        20 * 2e8 * 2.0 * tube.second_moment_of_area / tube.length
    )
    assert wound.damping[0] == pytest.approx(20 * 1e-5)
    tension = np.array([1.0, 0.0, 4.0])
    data.ctrl[:] = tension

    def force(angles: np.ndarray) -> np.ndarray:
        data.qpos[:] = angles
        mujoco.mj_forward(model, data)
        return np.array(data.qfrc_passive + data.qfrc_actuator - data.qfrc_bias)

    def stiffness(angles: np.ndarray) -> np.ndarray:
        steps = 1e-6 * np.eye(model.nv)
        return np.transpose([(force(angles - e) - force(angles + e)) / 2e-6 for e in steps])

    angles = np.zeros(model.nv)
    for _ in range(20):
        angles = angles + np.linalg.solve(stiffness(angles), force(angles))
    assert np.abs(force(angles)).max() < 1e-8
    mass = np.zeros((model.nv, model.nv))
    for row, unit in zip(mass, np.eye(model.nv), strict=True):
        mujoco.mj_mulM(model, data, row, unit)
    found = np.sort(np.sqrt(np.linalg.eigvals(np.linalg.solve(mass, stiffness(angles))).real))

    def first(section: cdcr.Section) -> np.ndarray:
        wanted = cdcr.Model(replace(robot, sections=(section,)))
        return wanted.modes(wanted.equilibrium(tension), tension).frequency[:3]

    off = found[:3] / first(twisting) - 1.0
    print(f"first frequencies {found[:3]} rad/s, off by {off}")
    assert np.abs(off).max() < 5e-3
    locked = first(replace(twisting, twist_order=None))
    assert np.abs(locked / first(twisting) - 1.0).max() > 0.03  # which twist does


def test_a_tube_is_told_as_the_solid_arc_that_moves_alike() -> None:
    tube = replace(SECTION, backbone_inner_diameter=0.003, bending_stiffness=0.2)
    robot = replace(ROBOT, sections=(replace(tube, material_damping=0.02),))
    solid = as_solid_arcs(robot, "it")
    assert solid.sections[0].backbone_inner_diameter == 0.0
    q, qd, tension = [0.5, 0.3], [1.0, -2.0], [5.0, 1.0, 0.0]
    found = cdcr.Model(solid).forward_dynamics(q, qd, tension)
    wanted = cdcr.Model(robot).forward_dynamics(q, qd, tension)
    assert np.abs(found - wanted).max() <= REL * np.abs(wanted).max()
    assert as_solid_arcs(ROBOT, "it") == ROBOT


ROD = cdcr.Section(
    length=0.3,
    backbone_mass=0.02,
    backbone_diameter=(0.006, 0.004),
    backbone_inner_diameter=0.001,
    youngs_modulus=2e8,
    shear_modulus=7e7,
    bending_order=1,
    twist_order=0,
    stretch_order=0,
    damping=1e-3,
    twist_damping=1e-4,
    stretch_damping=0.5,
    material_damping=1e-3,
    rest_bending=(0.2, -0.1),
    nodes=7,
)
LOCKED = replace(ROD, bending_order=None, twist_order=None, stretch_order=None)
CABLES = (
    replace(HELIX, stiffness=500.0, damping=1.0),
    cdcr.Cable(radius=[(0.012, 0.006)] * 3, angle=2.0, end_section=2),
    cdcr.Cable(radius=0.01, angle=1.0, start_section=1, end_section=2, friction=0.1),
)
RODS = cdcr.Robot(sections=(ROD, LOCKED, ROD), cables=CABLES, gravity=(0.3, -0.2, -9.81))
SAME_RUN = 1e-9  # two runs of dopri5 with other steps
DIFFERENCES = 1e-6  # of central differences, relative


@pytest.mark.parametrize("fmi", [2, 3])
def test_an_fmu_of_rods_moves_as_cdcr_does(fmi: int, tmp_path: Path) -> None:
    pytest.importorskip("fmpy", reason="FMUs are tested by fmpy")
    from fmu import Fmu

    model = cdcr.Model(RODS)
    d = model.num_coordinates
    fmu = Fmu(RODS, tmp_path, fmi=fmi)
    q0 = 0.05 * np.cos(np.arange(float(d)))
    q0[[name.startswith("e") for name in model.coordinate_names]] *= 0.01
    command = np.array([model.cable_lengths(q0)[0] - 0.01, 1.0, 2.0])
    inputs = [f"{'length' if j == 0 else 'tension'}[{j + 1}]" for j in range(3)]
    q, qd = fmu.names("q"), fmu.names("qd")
    fmu.begin({f"q_start[{i + 1}]": q0[i] for i in range(d)})
    fmu.set(dict(zip(inputs, command, strict=True)))
    for k in range(5):
        fmu.slave.doStep(currentCommunicationPoint=0.02 * k, communicationStepSize=0.02)
    run = cdcr.simulate(
        model, q0, np.zeros(d), t=[0.0, 0.1], command=command, method="dopri5", rtol=1e-10
    )
    assert np.abs(fmu.get(q) - run.q[-1]).max() <= SAME_RUN
    lengths = fmu.get(fmu.names("cable_length"))
    assert lengths == pytest.approx(model.cable_lengths(fmu.get(q)), rel=REL)

    # By q of the tension of a damped cable that winds, whose slope changes with the shape.
    slope = fmu.jacobian(["cable_tension[1]"], q)[0]
    at, rates, step = fmu.get(q), fmu.get(qd), 1e-6

    def tension(shape: np.ndarray) -> float:
        rate = -model.actuation_matrix(shape)[:, 0] @ rates
        return float(500.0 * (model.cable_lengths(shape)[0] - command[0]) + 1.0 * rate)

    wanted = [(tension(at + step * e) - tension(at - step * e)) / (2.0 * step) for e in np.eye(d)]
    assert np.abs(slope - wanted).max() <= DIFFERENCES * np.abs(wanted).max()
