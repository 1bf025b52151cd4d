"""Scenarios about cables and subdivision: what they tell holds by other means."""

from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr import _core
from cdcr.scenarios.studies import length_drive, pull_release, subdivision
from cdcr.scenarios.studies.energy import integral
from scenario_runs import told

TABLE = 1e-3  # the trapezoidal rule on samples; the runs themselves are far better
SMEARED = 0.05  # friction turns over a small range of speeds, not at once
ROTARY = 1e-3, 3e-3, 6e-3  # rotary inertia, absent from the Ritz beam, lowers the three modes


def test_integral_of_straight_lines_is_exact() -> None:
    x = np.array([0.0, 1.0, 4.0])
    assert integral(2.0 * x, x) == 16.0
    assert integral(np.stack([x, 1.0 + x], axis=1), x[:, None]) == pytest.approx([8.0, 12.0])


def test_friction_takes_the_area_of_the_loop() -> None:
    _, run, found = told("pull-release")
    assert run.success
    assert found["friction_power_J"] > 0.9 * found["loop_J"] > 0.0
    assert abs(found["difference"]) < TABLE
    assert np.all(pull_release.friction_power(run) >= 0.0)
    # Both cycles start and end straight, so they take as much.
    half = len(run) // 2 + 1
    power = pull_release.friction_power(run)
    first, second = (float(integral(power[s], run.t[s])) for s in (slice(half), slice(half, None)))
    assert second == pytest.approx(first, rel=SMEARED)


def test_capstan_bounds_the_tension_and_gives_the_dead_band() -> None:
    _, run, found = told("pull-release")
    assert found["ratio"] == pytest.approx(found["capstan"], rel=TABLE)
    assert found["capstan"] < 0.95  # else the test would tell nothing
    assert found["dead_band_N"] == pytest.approx(found["dead_band_expected_N"], rel=SMEARED)
    bound = pull_release.coefficients(run)[0] * np.abs(run.theta[:, 0])
    taut = run.tension[:, 0] > 0.0
    ratio = pull_release.beyond(run)[taut] / run.tension[taut, 0]
    assert np.all(np.abs(np.log(ratio)) <= bound[taut] + 1e-12)


def test_without_friction_there_is_no_loop() -> None:
    scenario, run, found = told("pull-release")
    smooth = pull_release.frictionless(scenario, float(run.t[-1]))
    area = float(integral(smooth.tension[:, 0], pull_release.pulled(smooth)))
    assert np.all(np.abs(pull_release.friction_power(smooth)) < 1e-12)
    assert area < 0.1 * found["loop_J"]  # what is left is damping
    damped = pull_release.coefficients(run)[1] * float(
        integral(np.sum(smooth.qd**2, axis=1), smooth.t)
    )
    assert area == pytest.approx(damped, rel=TABLE)
    # It follows its static equilibrium: K theta = F r.
    section = smooth.model.robot.sections[0]
    static = smooth.tension[:, 0] * section.cable_radius / section.stiffness
    assert np.max(np.abs(smooth.theta[:, 0] - static)) < np.deg2rad(0.5)


def test_longer_lag_comes_with_friction() -> None:
    _, run, _ = told("pull-release")
    up = int(np.searchsorted(run.t, 0.5 * pull_release.RAMP))
    down = int(np.searchsorted(run.t, 1.5 * pull_release.RAMP))
    assert run.tension[up, 0] == pytest.approx(run.tension[down, 0], rel=1e-2)
    assert run.theta[up, 0] < 0.95 * run.theta[down, 0]


def test_cables_driven_by_length_hold_their_shape() -> None:
    _, run, found = told("length-drive")
    assert run.success
    assert found["balance"] < TABLE
    assert 1.0 < found["error_held_deg"] <= found["error_max_deg"] < 15.0
    # Held long enough to be at rest: the same as the equilibrium under those lengths.
    held = int(np.searchsorted(run.t, length_drive.BACK))
    rest = run.model.equilibrium(run.command[held], run.q[held])
    np.testing.assert_allclose(run.q[held], rest, atol=2e-3)


def test_stiffer_cables_come_nearer() -> None:
    scenario, _, found = told("length-drive")
    # Ten times as stiff without slack: a tenth of the error or less, as slack cables do not help.
    assert found["stiffer_slack"] == 0.0
    assert found["stiffer_error_held_deg"] < found["error_held_deg"] / 9.0
    run = length_drive.stiffer(scenario, scenario.t_end)
    lengths = np.array([run.model.cable_lengths(q) for q in run.q])
    stretch = run.tension / 2e5
    assert np.max(np.abs(lengths - run.command - stretch)) < 1e-5  # springs and a little damping


@pytest.mark.skipif(not _core.with_cvode, reason="CVODE alone tells when cables turn slack")
def test_slack_cables_pull_nothing_and_events_come_in_pairs() -> None:
    _, run, found = told("length-drive")
    assert found["slack"] >= 3.0
    assert np.all(run.tension >= 0.0)
    for cable in range(run.model.num_cables):
        turns = [event.slack for event in run.slack_events if event.cable == cable]
        assert turns == [k % 2 == 0 for k in range(len(turns))]
        times = [event.time for event in run.slack_events if event.cable == cable]
        for start, end in zip(times[::2], times[1::2], strict=True):
            inside = (run.t > start) & (run.t < end)
            assert np.all(run.tension[inside, cable] == 0.0)


def test_wanted_shapes_start_and_end_straight() -> None:
    scenario = cdcr.scenarios.get("length-drive")
    wanted = length_drive.wanted(scenario, [0.0, length_drive.GO, length_drive.BACK, 9.0])
    assert np.all(wanted[[0, 1, 3]] == 0.0)
    shape = cdcr.bending(np.deg2rad([25.0, 45.0, 65.0]), np.deg2rad([30.0, -50.0, 10.0]))
    np.testing.assert_array_equal(wanted[2], np.ravel(shape))


def ritz(terms: int = 14) -> Any:
    """Beam frequencies [rad/s] by Ritz: deflections x^2, x^3, ... of backbone and point disks.

    Orthogonal polynomials for the curvature keep the matrices well conditioned.
    """
    s = cdcr.robots.amouri2020().sections[0]
    curvature = [np.polynomial.Legendre.basis(k, domain=[0.0, 1.0]) for k in range(terms)]
    deflection = [w.integ(2, lbnd=0.0) for w in curvature]
    nodes, weights = np.polynomial.legendre.leggauss(2 * terms)
    x, weights = (1.0 + nodes) / 2.0, weights / 2.0
    bent = np.array([w(x) for w in curvature])
    swung = np.array([w(x) for w in deflection])
    held = np.array([w(np.arange(1, s.num_disks + 1) / s.num_disks) for w in deflection])
    stiffness = s.stiffness * (bent * weights) @ bent.T
    mass = s.backbone_mass * (swung * weights) @ swung.T + s.disk_mass * held @ held.T
    squared = np.linalg.eigvals(np.linalg.solve(stiffness, mass * s.length**2))
    return np.sort(1.0 / np.sqrt(squared.real[squared.real > 1e-12]))


def test_frequencies_are_those_of_an_independent_beam() -> None:
    beam = ritz()
    for mode, rotary in enumerate(ROTARY):
        assert subdivision.beam()[mode] == pytest.approx(beam[mode], rel=rotary)
        assert subdivision.beam()[mode] < beam[mode]
    _, _, found = told("subdivision")
    stated = (25.0, 4.75, 2.05, 1.14, 0.73)
    for parts, percent in enumerate(stated, start=1):
        assert found[f"excess_1_of_{parts}"] == pytest.approx(percent, abs=0.006)


def test_frequencies_fall_towards_the_beam_with_order_two() -> None:
    for mode in range(subdivision.SHOWN):
        over = [subdivision.excess(parts)[mode] for parts in subdivision.COUNTS[mode:]]
        assert np.all(np.diff(over) < 0.0)
        assert over[-1] > 0.0
        assert subdivision.order(mode) == pytest.approx(2.0, abs=0.2)
    assert subdivision.order(0) == pytest.approx(2.0, abs=0.02)


def test_step_responses_come_together() -> None:
    _, _, found = told("subdivision")
    assert found["step_1_mm"] > 2.0 * found["step_2_mm"] > 4.0 * found["step_4_mm"] > 0.0
    # One part swings about F r / K, as fast as the frequency says.
    run = subdivision.responses()[1]
    top = run.t[np.argmax(run.theta[:, 0])]
    assert top == pytest.approx(np.pi / subdivision.frequencies(1)[0], rel=0.02)


@pytest.mark.parametrize("name", ["pull-release", "length-drive", "subdivision"])
def test_pictures_name_their_axes_with_units(name: str) -> None:
    pytest.importorskip("matplotlib")
    _, run, _ = told(name)
    figure = cdcr.scenarios.get(name).figure(run)
    labels = [axes.get_ylabel() for axes in figure.axes if axes.name != "3d"]
    assert len(labels) >= 3
    for label in labels:
        assert label.endswith("]") or label == "tension of cable"


@pytest.mark.parametrize("name", ["pull-release", "length-drive"])
def test_short_runs_are_told_and_drawn_too(name: str) -> None:
    pytest.importorskip("matplotlib")
    scenario = cdcr.scenarios.get(name)
    run = scenario.simulate(t_end=0.2)
    assert scenario.summary(run)
    scenario.figure(run)


def test_friction_that_remembers_neither_creeps_nor_leaves_its_way() -> None:
    _, run, found = told("hysteresis")
    assert run.success
    assert found["creep_deg"] < 0.01 < 0.1 < found["creep_forgetting_deg"]
    assert found["behind_deg"] < 0.01 * float(np.degrees(np.max(run.theta)))
    # What the cable gave is stored, damped or heat of friction, of which none is negative.
    assert np.min(run.friction_power) >= -1e-12
    damped = run.model.robot.sections[0].damping * float(integral(np.sum(run.qd**2, axis=1), run.t))
    gained = float(run.energy[-1] - run.energy[0])
    assert found["work_J"] == pytest.approx(found["friction_J"] + damped + gained, rel=1e-2)
