"""Parameters from measurements: found within the errors stated, with slopes that are right."""

from __future__ import annotations

import dataclasses
import os
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.base.arrays import FloatArray
from cdcr.identification import Frequencies, Motion, Parameter, Poses
from cdcr.identification.fit import prepared
from measured import BY_LENGTH, NOISE, ROBOT, pulls, tips

SEEDS = 100 if int(os.environ.get("CDCR_RANDOM_TESTS", "0")) else 6
FAR = 4.5  # standard errors: one in 150,000 draws is farther
SLOPE = 2e-6  # relative, of slopes by the implicit function against solved equilibria
SLOPE_RUN = 2e-3  # of slopes by forward differences of runs

MODULUS, MASS, TILT, OFFSET = 66e9, 0.0035, (0.03, -0.02), 0.004  # true ones
SOUGHT: dict[str, Any] = {
    "sections[*].youngs_modulus": None,
    "sections[*].disk_mass": {"high": 0.02},
    "base tilt": None,
    "tip offset x": None,
}


def true_robot() -> cdcr.Robot:
    from cdcr.identification.setup import rotation

    section = replace(ROBOT.sections[0], youngs_modulus=MODULUS, disk_mass=MASS)
    robot = replace(ROBOT, sections=(section, section))
    tool = np.eye(4)
    tool[0, 3] = OFFSET
    turned = {"base_orientation": rotation((*TILT, 0.0)), "tool": tool}
    fields = {item.name: getattr(robot, item.name) for item in dataclasses.fields(robot)}
    return cdcr.Robot(**fields | turned)


def scores(seed: int, robot: cdcr.Robot) -> FloatArray:
    """Return errors of the estimates in standard errors."""
    commands = pulls(25)
    poses = Poses(commands, tip=tips(robot, commands, NOISE, seed), noise=NOISE)
    found = cdcr.identify(poses, ROBOT, SOUGHT)
    truth = [MODULUS, MASS, *TILT, OFFSET]
    return np.array([
        (one.value - true) / one.standard_error
        for one, true in zip(found.estimates, truth, strict=True)
    ])  # fmt: skip


def test_errors_are_as_large_as_they_are_said_to_be() -> None:
    robot = true_robot()
    every = np.array([scores(seed, robot) for seed in range(SEEDS)])
    assert np.abs(every).max() < FAR
    # The mean square of so many standard normal numbers is 1 +- sqrt(2/size).
    assert abs(np.mean(every**2) - 1.0) < FAR * np.sqrt(2.0 / every.size)
    within = (np.abs(every) < 1.96).mean()
    assert within > 0.95 - FAR * np.sqrt(0.05 * 0.95 / every.size)


@pytest.mark.parametrize("robot", [ROBOT, BY_LENGTH], ids=["tension", "length"])
def test_slopes_are_those_of_solved_equilibria(robot: cdcr.Robot) -> None:
    commands, told = pulls(8), np.full(6, 0.5)
    if robot is BY_LENGTH:  # pulled, and let slack
        commands = np.random.default_rng(3).uniform(-2e-3, 2e-3, (8, 6))
        told = cdcr.Model(robot).rest_command()
    push = cdcr.Wrench(section=0, force=(0.02, 0.05, 0.0))
    nothing = np.zeros((8, 3))
    poses = Poses(
        commands,
        tip=nothing,
        markers={(0, 0.5): nothing},
        tension=np.zeros((8, 6)),
        length=np.zeros((8, 6)),
        q=np.zeros((8, 4)),
        wrenches=push,
        pulled=robot is BY_LENGTH,
    )
    vibrations = Frequencies([1.0, 1.0, 1.0], damping_ratio=[0.1, 0.1, 0.1], command=told)
    sought = dict.fromkeys([
        "sections[:].youngs_modulus", "sections[0].length", "scale sections[*].cable_radius",
        "cables.stiffness" if robot is BY_LENGTH else "payload", "sections[1].cable_rotation",
        "base tilt", "base yaw", "base position", "tip offset", "marker offset", "gravity[2]",
        "command_offset[*]", "sections[0].command_gain", "sections[*].damping",
        "sections[1].cable_angles[2]",
    ])  # fmt: skip
    if robot is ROBOT:  # two unknowns may not be the same number
        del sought["sections[1].cable_angles[2]"]
    else:
        del sought["sections[1].cable_rotation"]
    problem = prepared([poses, vibrations], robot, sought)
    x = np.full(len(problem.unknowns), 0.05)
    found, h = problem.jacobian(x), 1e-5
    for k in range(x.size):
        step = h * np.eye(x.size)[k]
        solved = (problem.residuals(x + step) - problem.residuals(x - step)) / (2.0 * h)
        assert np.abs(found[:, k] - solved).max() <= SLOPE * (1.0 + np.abs(solved).max()), (
            problem.unknowns[k].quantity.name
        )


def swing(robot: cdcr.Robot, t: FloatArray, noise: float, seed: int) -> FloatArray:
    """Return the tip of a robot let go under 3 N on cable 1 [m]."""
    model = cdcr.Model(robot)
    q0 = model.equilibrium([3.0, 0, 0, 0, 0, 0])
    run = cdcr.simulate(model, q0, np.zeros(4), t=t, tension=np.zeros(6), method="dopri5")
    return run.tip + np.random.default_rng(seed).normal(0.0, noise, run.tip.shape)


def test_a_motion_tells_damping_stiffness_and_the_clock() -> None:
    section = replace(ROBOT.sections[0], youngs_modulus=63e9, damping=3e-4)
    t = np.arange(0.0, 1.0, 0.01)
    late = 0.004  # [s], of the clock of the camera
    tip = swing(replace(ROBOT, sections=(section, section)), t, 0.0, 0)
    seen = np.array([np.interp(t - late, t, one) for one in tip.T]).T
    seen += np.random.default_rng(2).normal(0.0, NOISE / 10, seen.shape)
    motion = Motion(t, np.zeros(6), tip=seen, start=[3.0, 0, 0, 0, 0, 0], method="dopri5")
    names = ["sections[*].youngs_modulus", "sections[*].damping", "time shift"]
    found = cdcr.identify(motion, ROBOT, dict.fromkeys(names))
    assert found["sections[*].youngs_modulus"] == pytest.approx(63e9, rel=2e-3)
    assert found["sections[*].damping"] == pytest.approx(3e-4, rel=3e-2)
    assert found["time shift"] == pytest.approx(late, abs=3e-4)  # lines between samples of seen
    problem = prepared([motion], ROBOT, dict.fromkeys(names))
    x, h = np.zeros(3), 1e-3
    slopes = problem.jacobian(x)
    for k in range(3):
        step = h * np.eye(3)[k]
        solved = (problem.residuals(x + step) - problem.residuals(x - step)) / (2.0 * h)
        assert np.abs(slopes[:, k] - solved).max() < SLOPE_RUN * np.abs(solved).max()


def test_samples_just_after_a_kink_of_the_commands() -> None:
    """Where columns of the sensitivities have just begun to grow their errors are rounding."""
    t = np.array([0.0, 0.01, 0.02])
    told = 2.0 + 2.0 * np.sin(np.outer(t, np.arange(1.0, 7.0)) + np.arange(6.0))
    motion = Motion(t, told, tip=np.zeros((3, 3)))
    sought = {"sections[:].damping": None, "time shift": None}
    problem = prepared([motion], ROBOT, sought)
    wanted = problem.jacobian(np.zeros(3))
    found = problem.jacobian(np.array([0.0, 0.0, -1e-4]))  # a microsecond, in sizes of it
    assert np.abs(found - wanted).max() < 1e-3 * np.abs(wanted).max()


def test_frequencies_and_poses_together_tell_what_neither_does() -> None:
    # Poses by tension without weight tell E I, frequencies then the mass.
    light = replace(ROBOT, gravity=(0.0, 0.0, 0.0))
    section = replace(light.sections[0], youngs_modulus=70e9, disk_mass=0.003)
    true = replace(light, sections=(section, section))
    commands = pulls(6)
    poses = Poses(commands, tip=tips(true, commands), noise=1e-4)
    hz = cdcr.Model(true).modes(np.zeros(4), np.zeros(6)).frequency_hz
    vibration = Frequencies(hz[[0, 2]], command=np.zeros(6), mode=[0, 2], noise=1e-2)
    sought = dict.fromkeys(["sections[*].youngs_modulus", "sections[*].disk_mass"])
    alone = cdcr.identify(poses, light, sought)
    assert alone.untold == ["all sections: disk_mass"]
    assert np.isinf(alone.estimates[1].standard_error)
    both = cdcr.identify([poses, vibration], light, sought)
    assert both.untold == []
    assert both["sections[*].youngs_modulus"] == pytest.approx(70e9, rel=1e-6)
    assert both["sections[*].disk_mass"] == pytest.approx(0.003, rel=1e-5)


def test_what_only_a_mix_of_parameters_changes_is_told_together() -> None:
    light = replace(ROBOT, gravity=(0.0, 0.0, 0.0))
    commands = pulls(6)
    poses = Poses(commands, tip=tips(light, commands, NOISE), noise=NOISE)
    names = ["sections[*].youngs_modulus", "sections[*].cable_radius"]  # their ratio bends
    found = cdcr.identify(poses, light, dict.fromkeys(names))
    assert found.untold == [
        "all sections: youngs_modulus with all sections: cable_radius (together)"
    ]
    assert "cannot tell" in found.report()
    known = {names[0]: None, names[1]: {"prior": (8e-3, 1e-5)}}
    assert cdcr.identify(poses, light, known).untold == []


def test_a_prior_counts_as_one_more_measurement() -> None:
    commands = pulls(5)
    poses = Poses(commands, tip=tips(ROBOT, commands), noise=NOISE)
    path = "sections[*].youngs_modulus"
    free = cdcr.identify(poses, ROBOT, {path: None}).estimates[0]
    told = cdcr.identify(poses, ROBOT, {path: Parameter(prior=(63e9, free.standard_error))})
    assert told[path] == pytest.approx(0.5 * (60e9 + 63e9), rel=1e-3)  # as sure as the poses


def test_bounds_hold_and_are_told() -> None:
    commands = pulls(5)
    poses = Poses(commands, tip=tips(ROBOT, commands), noise=NOISE)
    found = cdcr.identify(
        poses, ROBOT, {"sections[*].youngs_modulus": (Parameter(high=55e9, start=50e9))}
    )
    assert found["sections[*].youngs_modulus"] == pytest.approx(55e9, rel=1e-6)
    assert found.estimates[0].at_bound
    assert "at its bound" in found.report()


def test_a_robust_loss_bears_outliers() -> None:
    commands = pulls(20)
    tip = tips(ROBOT, commands, NOISE, 1)
    tip[::7] += 0.05  # a marker taken for another
    poses = Poses(commands, tip=tip, noise=NOISE)
    errors = {}
    for loss in ("linear", "cauchy"):
        found = cdcr.identify(poses, ROBOT, {"sections[*].youngs_modulus": None}, loss=loss)
        errors[loss] = abs(found.estimates[0].value / 60e9 - 1.0)
    assert errors["cauchy"] < 0.01 < errors["linear"]


def test_other_starts_find_what_one_does_not() -> None:
    # From a cable turned by half a turn the robot bends away from where it should.
    commands = pulls(6)
    poses = Poses(commands, tip=tips(ROBOT, commands), noise=NOISE)
    path = "base yaw"
    asked = {path: Parameter(start=3.0, low=-3.1, high=3.1)}
    assert abs(float(cdcr.identify(poses, ROBOT, asked, starts=6)[path])) < 1e-6


def test_noise_is_found_where_none_is_given() -> None:
    commands = pulls(40)
    robot = true_robot()
    poses = Poses(
        commands, tip=tips(robot, commands, NOISE, 5), length=lengths(robot, commands, 1e-4)
    )
    found = cdcr.identify(poses, ROBOT, SOUGHT)
    tip, length = found.residuals
    assert not tip.noise_given
    # 120 and 240 numbers: 6 and 5 % each.
    assert tip.noise == pytest.approx(NOISE, rel=0.3)
    assert length.noise == pytest.approx(1e-4, rel=0.25)
    assert found.misfit == pytest.approx(1.0, abs=0.1)


def lengths(robot: cdcr.Robot, commands: FloatArray, noise: float) -> FloatArray:
    model = cdcr.Model(robot)
    q = np.array([model.equilibrium(command) for command in commands])
    return model.cable_lengths(q) + np.random.default_rng(9).normal(0.0, noise, (len(q), 6))


def test_parts_left_out_are_predicted_as_well_as_noise_allows() -> None:
    commands = pulls(24)
    robot = true_robot()
    poses = Poses(commands, tip=tips(robot, commands, NOISE, 5))
    crossed = cdcr.identify(poses, ROBOT, SOUGHT).cross_validate(4)
    assert crossed.values.shape == (4, 5)
    # Three coordinates; 5 parameters from 54 numbers add a tenth.
    assert crossed.held_out["poses: tip"] == pytest.approx(np.sqrt(3.0) * NOISE, rel=0.4)
    other = Poses(pulls(30, seed=8), tip=tips(robot, pulls(30, seed=8)))
    assert cdcr.identify(poses, ROBOT, SOUGHT).errors(other)[0].rms < NOISE


def test_the_most_telling_pulls_tell_as_much_as_is_said() -> None:
    candidates = pulls(30)
    design = cdcr.identification.informative_commands(
        ROBOT, SOUGHT, candidates, noise=NOISE, number=8
    )
    assert len(set(design.order.tolist())) == 8
    assert np.all(np.diff(design.standard_error[2:], axis=0) <= 1e-12)
    poses = Poses(design.command, tip=tips(ROBOT, design.command), noise=NOISE)
    found = cdcr.identify(poses, ROBOT, SOUGHT)
    stated = [one.standard_error for one in found.estimates]
    np.testing.assert_allclose(design.standard_error[-1], stated, rtol=1e-3)
    others = np.random.default_rng(0).permutation(30)[:8]
    poses = Poses(candidates[others], tip=tips(ROBOT, candidates[others]), noise=NOISE)
    by_chance = cdcr.identify(poses, ROBOT, SOUGHT).covariance
    size = np.diag([1e9, 1e-3, 1e-2, 1e-2, 1e-3])  # numbers of size one
    inverse = np.linalg.inv(size)
    assert np.linalg.det(inverse @ found.covariance @ inverse) < np.linalg.det(
        inverse @ by_chance @ inverse
    )


def test_the_picture_shows_the_path_of_the_tip_measured_and_predicted() -> None:
    pytest.importorskip("matplotlib")
    commands = pulls(6)
    seen = tips(ROBOT, commands, NOISE, 1)
    found = cdcr.identify(Poses(commands, tip=seen), ROBOT, {"sections[*].youngs_modulus": None})
    paths = found.plot().axes[-3:]
    model = seen + found.residuals[0].values
    for axes, (first, second) in zip(paths, ((0, 1), (0, 2), (1, 2)), strict=True):
        assert axes.get_xlabel() == f"tip {'xyz'[first]} [mm]"
        for line, places in zip(axes.lines, (seen, model), strict=True):
            np.testing.assert_allclose(
                np.array(line.get_xydata(), float), 1e3 * places[:, [first, second]]
            )


def test_a_motion_that_did_not_begin_at_rest_is_told_so() -> None:
    """One that a pull sets going from the straight robot, given without its start."""
    model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
    t, pull = np.linspace(0.0, 0.5, 51), [5.0, 0.0, 0.0]
    run = cdcr.simulate(model, [0.0, 0.0], [0.0, 0.0], t=t, tension=pull)
    sought = {"sections[*].youngs_modulus": None}

    def told(**start: Any) -> str:
        motion = cdcr.identification.Motion(t, pull, q=run.q, noise=1e-3, **start)
        return cdcr.identify(motion, model.robot, sought).report()

    sentence = "off in q: without a start it is at rest under its first command."
    assert sentence in told()
    assert sentence not in told(start=([0.0, 0.0], [0.0, 0.0]))
