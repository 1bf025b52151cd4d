"""Cables driven by length, from Python: springs that never push, slack events, refusals."""

import re
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr import _core

METHODS = ("auto", "rk4", "dopri5", "dop853", "bdf", "adams")
ZEROS = np.zeros(2)


def refuses(sentence: str) -> Any:
    return pytest.raises(ValueError, match=f"^{re.escape(sentence)}$")


def driven(stiffness: float = 5e3, damping: float = 1.0) -> cdcr.Model:
    robot = cdcr.robots.amouri2020(damping=0.02)
    section = replace(robot.sections[0], cable_stiffness=stiffness, cable_damping=damping)
    return cdcr.Model(replace(robot, sections=(section,)))


@pytest.fixture(scope="module")
def model() -> cdcr.Model:
    return driven()


def test_a_long_cable_pulls_nothing_and_a_short_one_as_its_spring(model: cdcr.Model) -> None:
    q, qd = [0.3, -0.1], np.array([0.2, 0.1])
    length, rate = model.cable_lengths(q), -model.actuation_matrix().T @ qd
    np.testing.assert_array_equal(model.cable_tensions(q, ZEROS, length + 1e-9), np.zeros(3))
    np.testing.assert_allclose(
        model.cable_tensions(q, qd, length - 1e-2), 5e3 * 1e-2 + rate, rtol=1e-12
    )
    assert model.cable_energy(q, length + 1e-9) == 0.0
    np.testing.assert_allclose(model.cable_energy(q, length - 1e-2), 0.75, rtol=1e-12)


@pytest.mark.parametrize("method", METHODS)
def test_the_straight_robot_rests_under_its_lengths(model: cdcr.Model, method: Any) -> None:
    run = cdcr.simulate(model, ZEROS, ZEROS, t=[0.0, 0.25, 0.5], method=method)
    np.testing.assert_array_equal(run.q, np.zeros((3, 2)))
    np.testing.assert_array_equal(run.tension, np.zeros((3, 3)))
    np.testing.assert_array_equal(run.command, np.tile(model.rest_command(), (3, 1)))
    assert run.slack_events == ()


def test_a_damped_run_comes_to_rest_where_the_equilibrium_is(model: cdcr.Model) -> None:
    command = model.cable_lengths([0.5, 0.2]) - 20.0 / 5e3
    run = cdcr.simulate(model, ZEROS, ZEROS, t=[0.0, 20.0], tension=command)
    assert run.success
    np.testing.assert_allclose(run.q[-1], model.equilibrium(command), rtol=0, atol=1e-8)


def test_slack_events_are_told(model: cdcr.Model) -> None:
    run = cdcr.simulate(model, [0.4, 0.1], ZEROS, t=np.linspace(0.0, 1.0, 11), method="bdf")
    assert len(run.slack_events) > 5
    for cable in range(3):
        mine = [event for event in run.slack_events if event.cable == cable]
        assert all(a.slack != b.slack and a.time < b.time for a, b in pairwise(mine))
    explicit = cdcr.simulate(model, [0.4, 0.1], ZEROS, t=np.linspace(0.0, 1.0, 11), method="dopri5")
    np.testing.assert_allclose(run.q, explicit.q, rtol=0, atol=1e-6)


LENGTH = "m (the length commanded of a length-driven cable)"


@pytest.mark.parametrize(
    ("command", "sentence"),
    [
        ([-0.1, 0.8, 0.8], f"tension[0] (cable 1) must be >= 0 {LENGTH}, got -0.1"),
        ([0.8, np.nan, 0.8], "tension[1] (cable 2) must be finite, got nan"),
        ([0.8, 0.8, np.inf], "tension[2] (cable 3) must be finite, got inf"),
    ],
)
def test_bad_lengths_are_refused_and_all_goes_on(
    model: cdcr.Model, command: list[float], sentence: str
) -> None:
    q = [0.1, 0.2]
    for call in (
        lambda: model.forward_dynamics(q, ZEROS, command),
        lambda: model.cable_tensions(q, ZEROS, command),
        lambda: model.cable_energy(q, command),
        lambda: model.equilibrium(command),
        lambda: cdcr.simulate(model, q, ZEROS, t=[0.0, 0.1], tension=command),
    ):
        with refuses(sentence):
            call()
    sim = cdcr.Simulator(model, step=1e-4)
    sim.reset(q, ZEROS)
    with refuses(sentence):
        sim.step(command)
    np.testing.assert_array_equal(sim.q, q)
    assert sim.step(model.rest_command()) == cdcr.Status.ok


def test_a_function_of_lengths_is_checked_too(model: cdcr.Model) -> None:
    with pytest.raises(ValueError, match=r"-1.* at t = 0 s$"):
        cdcr.simulate(model, ZEROS, ZEROS, t=[0.0, 0.1], tension=lambda t: [-1.0, 0.8, 0.8])
    rest = model.rest_command()
    run = cdcr.simulate(model, ZEROS, ZEROS, t=[0.0, 0.1], tension=lambda t: rest)
    np.testing.assert_array_equal(run.q, np.zeros((2, 2)))


def test_the_energy_of_the_springs_balances_and_is_saved(tmp_path: Path) -> None:
    robot = cdcr.robots.amouri2020()  # nothing dissipates
    section = replace(robot.sections[0], cable_stiffness=5e3)
    model = cdcr.Model(replace(robot, sections=(section,)))
    t = np.linspace(0.0, 1.0, 201)
    run = cdcr.simulate(model, [0.4, 0.1], ZEROS, t=t, method="dopri5", rtol=1e-12)
    total = run.energy + run.cable_energy
    assert np.ptp(run.cable_energy) > 0.5 * total[0]  # kept by the springs for most of a swing
    np.testing.assert_allclose(total, total[0], rtol=1e-8)
    assert not run.friction_power.any()
    header = run.save(tmp_path / "run.csv").read_text().splitlines()
    names = next(line for line in header if not line.startswith("#"))
    assert "cable_energy" in names
    assert "command" in names


def test_what_ends_a_run_is_told_of_either_drive(model: cdcr.Model) -> None:
    """Commands are lengths here: no advice may be about tensions alone."""
    for status in cdcr.Status:
        sentence = _core.status_message(status).replace("tensions or lengths", "")
        assert "tension" not in sentence, sentence
    short = np.array(model.rest_command()) - [0.3, 0.0, 0.0]
    run = cdcr.simulate(model, ZEROS, ZEROS, t=[0.0, 1.0], tension=short)
    assert run.status is cdcr.Status.bending_limit
    assert "pull the cables less, or lessen whatever else bends it" in run.message
