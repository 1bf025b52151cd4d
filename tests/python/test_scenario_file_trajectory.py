"""Motions in a scenario file: the tensions they need, and what these make the robot do."""

import math
import warnings
from pathlib import Path

import numpy as np
import pytest

import cdcr
from cdcr.motion.inverse import inverse_run
from cdcr.motion.reference import Reference
from cdcr.scenarios import Scenario
from cdcr.scenarios.file.reader import load_scenario
from cdcr.scenarios.file.trajectory import read_trajectory
from description import without_lines

# The motion's own arithmetic [rad], [rad/s], [rad/s^2], and what follows from it [N].
ROUNDING = 1e-13
# Of runs at a tolerance of 1e-10 a step under tensions found anew at each evaluation [rad].
PATH = 1e-9
# Derivatives by central differences over 1e-4 s: their error is of the order of 1e-8.
DIFFERENCES = 1e-6

HEAD = 'robot = "amouri2020"\nt_end = 10\noutput.num_samples = 51\nintegrator.method = "dopri5"\n'
CIRCLE = 'shape = "circle"\ntheta_deg = 15\nturns_per_second = 0.1\n'
SAMPLED = np.linspace(0.0, 10.0, 41)
SHAPES = [
    CIRCLE + "phi = 0.5\n",
    'shape = "line"\ntheta_rate = 0.1\ntheta_deg = -10\nphi = 0.3\n',
    'shape = "swing"\namplitude_deg = 20\nfrequency = 0.2\nphi_deg = 70\n',
    'shape = "move"\ntheta = 0.5\nphi_deg = 90\nstart = 1\nduration = 5\n',
]


def load(folder: Path, trajectory: str, head: str = HEAD) -> Scenario:
    path = folder / "track.toml"
    path.write_text(f"{head}[trajectory]\n{trajectory}", encoding="utf-8")
    return load_scenario(path)


def refusal(folder: Path, trajectory: str, head: str = HEAD) -> str:
    with pytest.raises(ValueError, match="t") as caught:
        load(folder, trajectory, head)
    path = folder / "track.toml"
    return "\n".join(without_lines(caught.value, path)).removeprefix(str(path))


def value(scenario: Scenario, key: str, run: cdcr.Trajectory | None = None) -> float:
    told = scenario.summary(run or scenario.simulate())
    return {one.key: one.value for one in told}[key]


def test_a_circle_needs_the_tensions_of_inverse_dynamics(tmp_path: Path) -> None:
    scenario = load(tmp_path, CIRCLE)
    run = scenario.simulate()
    t = np.linspace(0.0, 10.0, 51)
    circle = Reference.from_angles(t, math.pi / 12, lambda t: math.pi / 5 * t)
    plain = inverse_run(scenario.model, circle)
    np.testing.assert_allclose(run.q, circle.q, atol=ROUNDING)
    # The spline of phi is good to about 1e-9 in its second derivative.
    np.testing.assert_allclose(run.tension, plain.tension, atol=1e-7)
    assert run.method == "inverse dynamics"
    assert run.stats.steps == 0
    assert value(scenario, "tension_1_max_N") == pytest.approx(5.754, abs=5e-4)
    assert run.tension[0, 0] == pytest.approx(4.984, abs=5e-4)
    with pytest.raises(ValueError, match=r"without simulate = true, so it takes no rtol$"):
        scenario.simulate(rtol=1e-6)


@pytest.mark.parametrize("shape", SHAPES)
def test_rates_of_a_shape_are_those_of_its_angles(tmp_path: Path, shape: str) -> None:
    scenario = load(tmp_path, shape)
    h = 1e-4
    for t in (0.7, 3.3, 8.0):
        motion = scenario.input_source.motion  # type: ignore[union-attr]
        (before, here, after), rates, accelerations = motion(np.array([t - h, t, t + h]))
        np.testing.assert_allclose((after - before) / (2 * h), rates[1], atol=DIFFERENCES)
        change = (after - 2 * here + before) / h**2
        np.testing.assert_allclose(change, accelerations[1], atol=DIFFERENCES)


def test_what_the_shapes_are(tmp_path: Path) -> None:
    circle, line, swing, move = (load(tmp_path, shape).simulate() for shape in SHAPES)
    t = circle.t
    np.testing.assert_allclose(circle.q, cdcr.bending(np.pi / 12, 0.5 + np.pi / 5 * t[:, None]))
    bent = 0.1 * t[:, None] - math.radians(10)
    np.testing.assert_allclose(line.q, cdcr.bending(bent, 0.3), atol=ROUNDING)
    bent = math.radians(20) * np.sin(0.4 * np.pi * t[:, None])
    np.testing.assert_allclose(swing.q, cdcr.bending(bent, math.radians(70)), atol=ROUNDING)
    np.testing.assert_array_equal(move.q[t <= 1.0], 0.0)
    np.testing.assert_allclose(move.q[t >= 6.0], [[0.0, 0.5]] * 21, atol=ROUNDING)
    np.testing.assert_allclose(move.q[t == 3.6], [[0.0, 0.5 * (0.52**3 * 3.8224)]], atol=ROUNDING)


@pytest.mark.parametrize("shape", SHAPES)
def test_the_tensions_lead_the_robot_along(tmp_path: Path, shape: str) -> None:
    scenario = load(tmp_path, shape + "simulate = true\n")
    run = scenario.simulate(t_end=5.0)
    assert run.success
    assert run.stats.steps > 0
    asked = load(tmp_path, shape).simulate(t_end=5.0)
    np.testing.assert_allclose(run.q, asked.q, atol=PATH)
    assert value(scenario, "path_error_rad", run) < PATH


def test_tensions_joined_by_lines_lead_less_well(tmp_path: Path) -> None:
    errors = [
        value(load(tmp_path, f"{CIRCLE}simulate = true\nstep = {step}\n"), "path_error_rad")
        for step in (0.2, 0.1)
    ]
    assert errors[0] > 2.0 * errors[1]
    assert 1e-4 < errors[0] < 2e-3


def test_a_start_off_the_path_is_kept(tmp_path: Path) -> None:
    head = HEAD + "initial = {q = [0, 0]}\n"
    scenario = load(tmp_path, CIRCLE + "simulate = true\n", head)
    assert scenario.q0 == (0.0, 0.0)
    run = scenario.simulate(t_end=1.0, num_samples=21)
    assert value(scenario, "path_error_rad", run) > math.radians(14.9)


@pytest.mark.parametrize("kind", ["theta_deg", "theta", "q"])
@pytest.mark.parametrize("in_csv", [False, True])
def test_samples(tmp_path: Path, kind: str, in_csv: bool) -> None:
    t = SAMPLED
    theta, phi = 0.05 * t, 0.5 + 0.1 * t
    q = cdcr.bending(theta[:, None], phi[:, None])
    columns = {
        "theta_deg": ("theta_deg 1,phi_deg 1", np.rad2deg([theta, phi]).T),
        "theta": ("theta 1,phi 1", np.stack([theta, phi], axis=1)),
        "q": ("q 1 x,q 1 y", q),
    }
    header, rows = columns[kind]
    if in_csv:
        lines = [",".join(map(repr, row)) for row in np.column_stack([t, rows]).tolist()]
        (tmp_path / "path.csv").write_text("\n".join([f"t,{header}", *lines]))
        text = 'file = "path.csv"\n'
    elif kind == "q":
        text = f"t = {t.tolist()}\nq = {q.tolist()}\n"
    else:
        other = kind.replace("theta", "phi")
        text = f"t = {t.tolist()}\n{kind} = {rows[:, 0].tolist()}\n{other} = {rows[:, 1].tolist()}"
    scenario = load(tmp_path, text)
    run = scenario.simulate()
    exact = cdcr.bending(0.05 * run.t[:, None], 0.5 + 0.1 * run.t[:, None])
    # Splines of angles are exact here; those of q are not quite.
    np.testing.assert_allclose(run.q, exact, atol=1e-8 if kind == "q" else ROUNDING)
    if kind == "q":
        assert 0.0 < value(scenario, "acceleration_error") < 1e-3


def two_sections() -> cdcr.Model:
    return cdcr.Model(cdcr.robots.rao2021())


def test_samples_of_two_sections(tmp_path: Path) -> None:
    rows = [[0.02 * t, 0.03 * t] for t in SAMPLED.tolist()]
    motion = read_trajectory({"t": SAMPLED.tolist(), "theta": rows}, two_sections(), 10.0, tmp_path)
    q, qd, _ = motion.motion(np.array([5.0, 10.0]))
    np.testing.assert_allclose(q, [[0.1, 0.0, 0.15, 0.0], [0.2, 0.0, 0.3, 0.0]], atol=ROUNDING)
    np.testing.assert_allclose(qd, [[0.02, 0.0, 0.03, 0.0]] * 2, atol=ROUNDING)


def test_a_shape_for_each_of_two_sections(tmp_path: Path) -> None:
    table = {"shape": "circle", "theta": [0.1, 0.2], "turns_per_second": 0.1, "phi_deg": [0, 90]}
    q0, qd0 = read_trajectory(table, two_sections(), 10.0, tmp_path).start()
    np.testing.assert_allclose(q0, [0.1, 0.0, 0.0, 0.2], atol=ROUNDING)
    speed = 0.2 * math.pi
    np.testing.assert_allclose(qd0, [0.0, 0.1 * speed, -0.2 * speed, 0.0], atol=ROUNDING)


def test_limits_of_tension(tmp_path: Path) -> None:
    taut = load(tmp_path, CIRCLE + "min_tension = 2\n").simulate()
    assert taut.tension.min() == pytest.approx(2.0, abs=ROUNDING)
    narrow = CIRCLE + "max_tension = 5.5\n"
    with pytest.raises(ValueError, match=r"track\.toml, \[trajectory\]: at t = \S+ s the motion "):
        load(tmp_path, narrow).simulate()
    scenario = load(tmp_path, narrow + 'infeasible = "nearest"\n')
    assert scenario.simulate().tension.max() == pytest.approx(5.5, abs=ROUNDING)
    assert value(scenario, "infeasible") > 0


def test_out_of_reach_names_time_and_cables(tmp_path: Path) -> None:
    text = 'shape = "line"\ntheta_rate_deg = 3\nphi = 0\nmax_tension = 4\n'
    with pytest.raises(ValueError, match="motion") as caught:
        load(tmp_path, text).simulate()
    # 1 N bends by 2.9955 deg: 4 N are too little from 11.98 deg on, at the sample after 3.99 s.
    assert "at t = 4 s the motion cannot be had with tensions from 0 to 4 N" in str(caught.value)
    assert "(limited by cables 1, 2, 3), nor at 30 more of 51 samples" in str(caught.value)


def test_what_refuses_a_motion_names_file_and_table(tmp_path: Path) -> None:
    start = r"^.*track\.toml, \[trajectory\]: "
    with pytest.raises(
        ValueError,
        match=start.replace(r", \[", r", line 5, \[") + r"the reference bends section 1 by ",
    ):
        load(tmp_path, CIRCLE.replace("15", "600")).simulate()
    scenario = load(tmp_path, f"t = {SAMPLED.tolist()}\ntheta = {[0.1] * 41}\n")
    with pytest.raises(ValueError, match=start + "t must lie within the reference, 0 to 10 s"):
        scenario.simulate(t_end=11.0)


def test_a_taylor_formulation_warns_once(tmp_path: Path) -> None:
    text = 'shape = "line"\ntheta_rate_deg = 12\nsimulate = true\n'
    scenario = load(tmp_path, text, HEAD + 'formulation = "taylor"\n')
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        scenario.summary(scenario.simulate())
    assert [str(one.message)[:21] for one in caught] == ["formulation 'taylor' "]


@pytest.mark.parametrize(
    ("trajectory", "sentence"),
    [
        ("simulate = true\n", ": trajectory must have one of shape, t or file"),
        (
            CIRCLE + "t = [0]\n",
            ": trajectory must have one of shape, t or file, got shape and t",
        ),
        (
            CIRCLE.replace("circle", "circel"),
            ': trajectory.shape must be one of "circle", "line", "swing", "move", '
            "got 'circel' (string). Did you mean 'circle'?",
        ),
        (
            CIRCLE + "turn_per_second = 1\n",
            ": trajectory.turn_per_second is not a known key. Did you mean 'turns_per_second'? "
            "Known keys: min_tension, max_tension, infeasible, simulate, shorter, step, shape, "
            "phi, phi_deg, theta, theta_deg, turns_per_second",
        ),
        (
            CIRCLE.replace("15", "[15, 15]"),
            ": trajectory.theta_deg must be a number, or an array with 1 number, "
            "got [15, 15] (array)",
        ),
        (CIRCLE + "theta = 1\n", ": trajectory must have theta or theta_deg, not both"),
        (
            CIRCLE.replace("theta_deg = 15\n", ""),
            ": trajectory must have theta or theta_deg",
        ),
        (
            CIRCLE + "min_tension = 3\nmax_tension = 2\n",
            ": trajectory.max_tension must be at least min_tension, 3 N, got 2",
        ),
        (
            CIRCLE + "infeasible = 'ignore'\n",
            ': trajectory.infeasible must be "raise" or "nearest", got \'ignore\' (string)',
        ),
        (
            f"t = {list(range(1, 13))}\ntheta = {[0.1] * 12}\n",
            ": trajectory must reach over the run, 0 to 10 s, got 1 to 12 s",
        ),
        ("t = [0, 10]\nphi = [0, 1]\n", ": trajectory must have q, theta or theta_deg beside t"),
        (
            "t = [0, 10]\ntheta = [0, 1, 2]\n",
            ": trajectory.theta must have as many rows as t, 2, got 3",
        ),
        (
            "t = [0, 10]\nq = [[0, 1], [2]]\n",
            ": trajectory.q[1] must have 2 numbers for this robot, got [2] (array)",
        ),
        (
            "t = [0, 10]\ntheta = [0, 1]\n",
            ", [trajectory]: derivatives by spline need at least 11 samples, got 2: give more, "
            "or the derivatives",
        ),
    ],
)
def test_what_is_wrong_with_a_trajectory(tmp_path: Path, trajectory: str, sentence: str) -> None:
    assert refusal(tmp_path, trajectory) == sentence


def test_a_start_where_nothing_is_simulated(tmp_path: Path) -> None:
    assert refusal(tmp_path, CIRCLE, HEAD + "initial = {q = [0, 0]}\n") == (
        ": initial needs simulate = true in [trajectory]; without it nothing starts anywhere"
    )


def test_the_old_name_of_simulate(tmp_path: Path) -> None:
    scenario = load(tmp_path, CIRCLE + "feed_back = true\n")
    assert {"path_error_rad"} < {one.key for one in scenario.summary(scenario.simulate(t_end=0.1))}
    assert refusal(tmp_path, CIRCLE + "feed_back = true\nsimulate = true\n") == (
        ": trajectory must have simulate or feed_back, its old name, not both"
    )


def test_a_csv_file_with_other_columns(tmp_path: Path) -> None:
    (tmp_path / "path.csv").write_text("t,theta\n0,1\n")
    with pytest.raises(ValueError, match="columns") as caught:
        load(tmp_path, "file = 'path.csv'\n")
    assert str(caught.value) == (
        f"{tmp_path / 'track.toml'}, line 6, trajectory.file: "
        f"{tmp_path / 'path.csv'}, line 1: the columns must be t, theta_deg 1, phi_deg 1; "
        "or t, theta 1, phi 1; or t, q 1 x, q 1 y, got t, theta"
    )
    with pytest.raises(
        FileNotFoundError, match=r"trajectory\.file: there is no trajectory file .*no\.csv$"
    ):
        load(tmp_path, "file = 'no.csv'\n")
