"""Controllers in a scenario file: the loop they make, and what may not be written."""

import math
from pathlib import Path

import numpy as np
import pytest

import cdcr
from cdcr.scenarios import Scenario
from cdcr.scenarios.file.reader import load_scenario
from description import without_lines

HEAD = 'robot = "amouri2020"\nt_end = 2\noutput.num_samples = 201\nintegrator.method = "dopri5"\n'
PID = 'type = "pid"\nkp = 2.0\nki = 0.5\nkd = 0.3\n'
BENT = "[controller.reference]\ntheta_deg = [15]\nphi_deg = [60]\n"


def load(folder: Path, controller: str) -> Scenario:
    path = folder / "loop.toml"
    path.write_text(f"{HEAD}[controller]\n{controller}", encoding="utf-8")
    return load_scenario(path)


def plain(reference: tuple[float, float], **options: object) -> cdcr.Trajectory:
    model = cdcr.Model(cdcr.robots.amouri2020())
    pid = cdcr.Pid(model, **options)  # type: ignore[arg-type]
    pid.reference = reference
    t = np.linspace(0.0, 2.0, 201)
    return cdcr.simulate(model, [0.0, 0.0], [0.0, 0.0], t=t, controller=pid, method="dopri5")


def test_a_loop_runs_as_the_same_call_in_python(tmp_path: Path) -> None:
    run = load(tmp_path, PID + BENT).simulate()
    bent = cdcr.bending(math.radians(15), math.radians(60))
    same = plain((bent[0], bent[1]), kp=2.0, ki=0.5, kd=0.3)
    np.testing.assert_array_equal(run.q, same.q)


def test_everything_a_loop_may_have(tmp_path: Path) -> None:
    text = (
        'type = "pid"\nkp = 1\nkd = 0.2\nki = 0.1\nperiod = 0.01\nfeed_forward = false\n'
        "anti_windup = false\nmin_tension = -inf\nmax_tension = 8\ncables = [1, 2]\n"
        "[controller.reference]\nq = [0.1, 0.2]\n"
    )
    run = load(tmp_path, text).simulate()
    options = {
        "kp": 1.0,
        "kd": 0.2,
        "ki": 0.1,
        "period": 0.01,
        "feed_forward": False,
        "anti_windup": False,
        "min_tension": -math.inf,
        "max_tension": 8.0,
        "cables": [0, 1],
    }
    np.testing.assert_array_equal(run.q, plain((0.1, 0.2), **options).q)
    np.testing.assert_array_equal(run.tension[:, 2], 0.0)
    assert run.tension[:, :2].max() > 0.0


def test_a_second_run_is_the_same(tmp_path: Path) -> None:
    scenario = load(tmp_path, PID + BENT)
    np.testing.assert_array_equal(scenario.simulate().q, scenario.simulate().q)


def test_straight_is_held_without_a_reference(tmp_path: Path) -> None:
    run = load(tmp_path, PID).simulate()
    np.testing.assert_array_equal(run.q, 0.0)


def test_what_a_loop_tells(tmp_path: Path) -> None:
    scenario = load(tmp_path, PID + BENT)
    run = scenario.simulate()
    found = {one.key: one.value for one in scenario.summary(run)}
    bent = cdcr.bending(math.radians(15), math.radians(60))
    error = np.linalg.norm(run.q - bent, axis=1)
    assert found["error_end_deg"] == math.degrees(error[-1])
    assert found["tension_max_N"] == run.tension.max()
    settled = run.t >= found["settling_s"]
    assert np.all(error[settled] <= 0.02 * error[0])
    assert error[np.argmax(settled) - 1] > 0.02 * error[0]


def test_a_picture_shows_the_reference(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    scenario = load(tmp_path, PID + BENT)
    figure = scenario.figure(scenario.simulate())
    heights = [np.asarray(line.get_ydata())[0] for line in figure.axes[1].get_lines()]
    assert np.min(np.abs(np.subtract(heights, 15.0))) < 1e-9


@pytest.mark.parametrize(
    ("controller", "sentence"),
    [
        (
            'type = "pd"\nkp = 1\n',
            ': controller.type must be one of "pid", "computed-torque", "lqr", "task-space", got '
            "'pd' (string). Did you mean 'pid'?",
        ),
        (
            "kp = 1\n",
            ': controller.type is missing; it must be one of "pid", "computed-torque", "lqr", '
            '"task-space"',
        ),
        (
            PID + "kpp = 1\n",
            ": controller.kpp is not a known key. Did you mean 'kp'? Known keys: period, "
            "min_tension, max_tension, max_rate, pretension, cables, motion, reference, type, kp, "
            "ki, kd, feed_forward, anti_windup, filter",
        ),
        (
            PID.replace("2.0", "-2"),
            ": controller.kp must be a number >= 0 [N m/rad], got -2 (integer)",
        ),
        (
            PID + "cables = [0]\n",
            ": controller.cables[0] must be the number of a cable, 1 to 3, got 0",
        ),
        (PID + "cables = [1, 1]\n", ": controller.cables[1] must differ from those before, got 1"),
        (
            PID + "feed_forward = 1\n",
            ": controller.feed_forward must be true or false, got 1 (integer)",
        ),
        (
            PID + BENT.replace("[15]", "[15, 20]"),
            ": controller.reference.theta_deg must have 1 number for a robot with 1 section, "
            "got [15, 20] (array)",
        ),
        (
            PID + BENT + "theta = [1]\n",
            ": controller.reference must have theta or theta_deg, not both",
        ),
        (
            PID + BENT + "thetta = [1]\n",
            ": controller.reference.thetta is not a known key. Did you mean 'theta'? "
            "Known keys: q, theta, theta_deg, phi, phi_deg",
        ),
    ],
)
def test_what_is_wrong_with_a_controller(tmp_path: Path, controller: str, sentence: str) -> None:
    with pytest.raises(ValueError, match="controller") as caught:
        load(tmp_path, controller)
    path = tmp_path / "loop.toml"
    assert without_lines(caught.value, path) == [f"{path}{sentence}"]


@pytest.mark.parametrize(
    "wrong",
    [
        "min_tension = 3\nmax_tension = 2\n",
        "max_tension = nan\n",
        "[controller.reference]\nq = [20, 0]\n",
    ],
)
def test_what_the_core_refuses_names_file_and_table(tmp_path: Path, wrong: str) -> None:
    with pytest.raises(
        ValueError,
        match=r"loop\.toml, line \d+(, \[controller\]: |: controller\.reference\.q must)",
    ):
        load(tmp_path, PID + wrong)


CIRCLE = (
    '[controller.motion]\nshape = "circle"\ncenter = [0, 0]\nx = [0.2, 0]\ny = [0, 0.2]\n'
    "turns = 1\nduration = 2\n"
)
LOOP = HEAD.replace('integrator.method = "dopri5"\n', "") + "[loop]\nstep = 0.001\n"


def closed(folder: Path, text: str) -> Scenario:
    path = folder / "loop.toml"
    path.write_text(text, encoding="utf-8")
    return load_scenario(path)


@pytest.mark.parametrize(
    "controller",
    [
        'type = "computed-torque"\nkp = 400\nkd = 40\n',
        'type = "lqr"\nstate_weight = 1000\nrate_weight = 1\ncommand_weight = 0.01\n'
        "min_tension = 2\n",
        'type = "pid"\nkp = 5\nkd = 0.5\npretension = [1, 1, 1]\n',
    ],
)
def test_every_controller_follows_a_motion_with_or_without_a_loop(
    tmp_path: Path, controller: str
) -> None:
    path = cdcr.ReferencePath.circle([0, 0], [0.2, 0], [0, 0.2], 1.0, 2.0)
    start = "[initial]\nq = [0.2, 0]\n"
    for head in (HEAD, LOOP):
        scenario = closed(tmp_path, f"{head}{start}[controller]\n{controller}{CIRCLE}")
        run = scenario.simulate()
        wanted = np.array([path.evaluate(t)[0] for t in run.t])
        assert np.abs(run.q - wanted).max() < 0.02
        found = {one.key: one.value for one in scenario.summary(run)}
        assert found["error_max_deg"] == pytest.approx(
            math.degrees(np.linalg.norm(run.q - wanted, axis=1).max())
        )


def test_a_loop_runs_as_the_same_loop_in_python(tmp_path: Path) -> None:
    text = (
        LOOP + '[[loop.actuators]]\ntime_constant = 0.01\n[[loop.sensors]]\nkind = "coordinates"\n'
        "noise = 0.001\nseed = 4\n[controller]\n" + PID + BENT
    )
    run = closed(tmp_path, text).simulate()
    model = cdcr.Model(cdcr.robots.amouri2020())
    pid = cdcr.Pid(model, kp=2.0, ki=0.5, kd=0.3)
    pid.reference = cdcr.bending(math.radians(15), math.radians(60))
    loop = cdcr.Loop(
        model,
        pid,
        actuators=cdcr.Actuator(time_constant=0.01),
        sensors=cdcr.Sensor(kind="coordinates", noise=0.001, seed=4),
    )
    loop.reset([0, 0], [0, 0])
    np.testing.assert_array_equal(run.q, loop.run(2.0, record_every=10).trajectory.q)


def test_a_motion_of_a_file_is_the_spline_through_its_points(tmp_path: Path) -> None:
    (tmp_path / "path.csv").write_text("t,q1_x,q1_y\n0,0,0\n1,0.2,0.1\n2,0.1,0.3\n")
    motion = '[controller.motion]\nshape = "file"\nfile = "path.csv"\n'
    scenario = closed(tmp_path, LOOP + '[controller]\ntype = "computed-torque"\n' + motion)
    run = scenario.simulate()
    path = cdcr.ReferencePath.spline([0.0, 1.0, 2.0], [[0.0, 0.0], [0.2, 0.1], [0.1, 0.3]])
    wanted = np.array([path.evaluate(t)[0] for t in run.t])
    np.testing.assert_allclose(run.q, wanted, atol=1e-4)
    with pytest.raises(FileNotFoundError, match="file of a motion"):
        closed(tmp_path, LOOP + "[controller]\n" + PID + motion.replace("path", "no"))


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (LOOP, "loop needs a controller, and there is none"),
        (
            HEAD + "[loop]\n[controller]\n" + PID,
            "there must be only one of loop and integrator: a loop has steps of its own",
        ),
        (
            LOOP + "[controller]\n" + PID + CIRCLE + BENT,
            "controller must have motion or reference, not both",
        ),
        (
            LOOP + "[controller]\n" + PID + CIRCLE.replace("[0.2, 0]", "[0.2]"),
            "controller.motion.x must have 2 numbers, as the reference has",
        ),
        (
            LOOP + "[controller]\n" + PID + CIRCLE.replace("circle", "round"),
            'controller.motion.shape must be one of "circle", "helix", "polygon", "spline", '
            "\"file\", got 'round' (string)",
        ),
        (
            LOOP.replace("0.001", "0.0007") + "[controller]\n" + PID,
            "the controller's period must be a whole number of steps of 0.0007 s",
        ),
        (
            LOOP + '[[loop.sensors]]\nkind = "gps"\n[controller]\n' + PID,
            'sensors[0].kind must be "coordinates", "rates"',
        ),
        (
            LOOP + "[[loop.actuators]]\nlag = 1\n[controller]\n" + PID,
            "actuators[0].lag is not a known key",
        ),
        (
            LOOP.replace("201", "302") + "[controller]\n" + PID,
            "samples of a closed loop must be whole numbers of its steps of 0.001 s apart, "
            "got 0.00664452 s: num_samples = 251 would do",
        ),
        (
            LOOP
            + "[[wrenches]]\nsection = 1\nforce = [1, 0, 0]\ntimes = [0, 1]\nfactors = [0, 1]\n"
            + "[controller]\n"
            + PID,
            "wrenches[0].times must be left out, and factors: in a loop wrenches are constant",
        ),
    ],
)
def test_what_is_wrong_with_a_loop(tmp_path: Path, text: str, sentence: str) -> None:
    with pytest.raises(ValueError, match="loop") as caught:
        closed(tmp_path, text)
    assert sentence in str(caught.value)
