"""Arguments of another kind than asked for: a sentence that names the item, nothing else."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any, cast

import numpy as np
import pytest

import cdcr
from cdcr.base.calls import explain
from refusals import is_refused

MODEL = cdcr.Model(cdcr.robots.amouri2020())
ZERO = [0.0, 0.0]
TIP = cdcr.Sensor(kind="tip")
REFERENCE = cdcr.Reference(
    t=np.arange(2.0), q=np.zeros((2, 2)), qd=np.zeros((2, 2)), qdd=np.zeros((2, 2))
)
NONE = cast("Any", None)


def run(**arguments: Any) -> cdcr.Trajectory:
    model = arguments.pop("model", MODEL)
    return cdcr.simulate(model, ZERO, ZERO, t=[0.0, 0.01], **arguments)


CASES: dict[str, tuple[Callable[[], object], str]] = {
    "scenario": (
        lambda: cdcr.scenarios.get(cast("Any", 1)),
        "the name of a scenario must be a string, got 1 (int). Known: ",
    ),
    "robot": (
        lambda: cdcr.robots.get(cast("Any", [])),
        "the name of a robot must be a string, got [] (list). Known: ",
    ),
    "formulation": (lambda: cdcr.Model(MODEL.robot, cast("Any", [])), "formulation must be one of"),
    "stable_step": (lambda: cdcr.stable_step(NONE), "model must be a cdcr.Model, got NoneType"),
    "robot of a wrench": (
        lambda: cdcr.subdivide_wrench(NONE, 2, cdcr.Wrench(section=0, force=(1.0, 0.0, 0.0))),
        "robot must be a cdcr.Robot, got NoneType",
    ),
    "wrench of parts": (
        lambda: cdcr.subdivide_wrench(MODEL.robot, 2, NONE),
        "wrench must be a cdcr.Wrench, got NoneType",
    ),
    "wrenches of parts": (
        lambda: cdcr.subdivide_wrench(MODEL.robot, 2, cast("Any", [])),
        "wrench must be a cdcr.Wrench, got list",
    ),
    "text without dimensions": (
        lambda: MODEL.pose(ZERO, 0, cast("Any", np.array("1_0"))),
        "fraction must be a number, got array('1_0'",
    ),
    "text of a keyword": (
        lambda: cdcr.Simulator(MODEL, step=cast("Any", np.array(b"1"))),
        "step must be a number, got array(b'1'",
    ),
    "text for coordinates": (
        lambda: MODEL.pose(cast("Any", np.array("1_0")), 0, 1.0),
        "q must be numbers of shape (..., 2), got ndarray",
    ),
    "progress of an audit": (
        lambda: cdcr.paper.audit(cast("Any", 5)),
        "progress must be a function of a number, got int",
    ),
    "simulate": (lambda: run(model=None), "model must be a cdcr.Model, got NoneType"),
    "least tension": (
        lambda: MODEL.allocate(ZERO, cast("Any", "a")),
        "min_tension must be a number, got 'a' (str)",
    ),
    "largest tension": (
        lambda: cdcr.inverse_run(MODEL, REFERENCE, max_tension=cast("Any", [1.0])),
        "max_tension must be a number [N], got [1.0] (list)",
    ),
    "method of allocate": (
        lambda: MODEL.allocate(ZERO, method=cast("Any", 3)),
        "method must be a string, got 3 (int)",
    ),
    "seeds": (
        lambda: MODEL.inverse_kinematics([0.0, 0.0, 0.8], seeds=cast("Any", 1.5)),
        "seeds must be a whole number, got 1.5 (float)",
    ),
    "many seeds": (
        lambda: MODEL.inverse_kinematics([0.0, 0.0, 0.8], seeds=10**40),
        "seeds must be a whole number of at most 2147483647 in size, got 1000",
    ),
    "many steps": (
        lambda: cdcr.rollout(MODEL, ZERO, ZERO, step=1.0, steps=10**12),
        "steps must be a whole number >= 0 and at most 2147483647, got 1000000000000 (int)",
    ),
    "sensitivities": (
        lambda: run(sensitivities=5),
        "sensitivities must be names, such as 'q0', 'tension' or 'payload', got 5",
    ),
    "paths of a gradient": (
        lambda: cdcr.gradient(
            MODEL, ZERO, ZERO, [0.0] * 3, lambda m: (0.0, {}), step=1.0, steps=1, parameters=NONE
        ),
        "parameters must be a path or a sequence of paths, got None (NoneType)",
    ),
    "variants": (
        lambda: cdcr.ExtendedKalman(MODEL, sensors=TIP, variants=NONE),
        "variants must be a cdcr.Model or a sequence of them, got None (NoneType)",
    ),
    "data": (
        lambda: cdcr.identify(NONE, MODEL.robot, {}),
        "data must be Poses, a Motion or Frequencies, or a sequence of these, got NoneType",
    ),
    "large noise": (
        lambda: cdcr.identification.Poses([[0.0] * 3], tip=[[0.0] * 3], noise=10**400),
        "noise of tip must be a number > 0 and finite, got 1000",
    ),
    "name of exported C": (
        lambda: cdcr.export.write_c(MODEL.robot, "here", name=NONE),
        "name must be an identifier of C, got None (NoneType)",
    ),
    "no path": (
        lambda: MODEL.robot.save("robot\0.toml"),
        "path must be the path of a file, got 'robot\\x00.toml' (str)",
    ),
    "huge limit": (
        lambda: MODEL.allocate(ZERO, max_tension=10**400),
        "max_tension must be a number of at most 1.797693135e+308 in size, got 1000",
    ),
    "tolerance": (
        lambda: MODEL.inverse_kinematics([0.0, 0.0, 0.8], tolerance=cast("Any", "fine")),
        "tolerance must be a number, got 'fine' (str)",
    ),
    "events": (
        lambda: run(events=3),
        "events must be a function or a sequence of functions, got 3 (int)",
    ),
    "gain": (
        lambda: cdcr.Pid(MODEL, kp=cast("Any", "a"), kd=1.0),
        "kp must be a number, got 'a' (str)",
    ),
    "switch": (
        lambda: cdcr.Pid(MODEL, kp=1.0, anti_windup=cast("Any", 1)),
        "anti_windup must be True or False, got 1 (int)",
    ),
    "cables": (
        lambda: cdcr.Pid(MODEL, kp=1.0, cables=cast("Any", [0, "b"])),
        "cables[1] must be the index of a cable, got 'b' (str)",
    ),
    "inverse_run": (
        lambda: cdcr.inverse_run(NONE, NONE),
        "model must be a cdcr.Model, got NoneType",
    ),
    "Trajectory": (
        lambda: cdcr.Trajectory(cast("Any", 1), *[NONE] * 7),
        "model must be a cdcr.Model, got int",
    ),
    "Pid": (lambda: cdcr.Pid(NONE, kp=1.0), "model must be a cdcr.Model, got NoneType"),
    "Simulator": (lambda: cdcr.Simulator(NONE), "model must be a cdcr.Model, got NoneType"),
    "controller": (lambda: run(controller=5), "controller must be a cdcr.Controller, got int"),
    "progress": (lambda: run(progress=5), "progress must be a function of time, got int"),
    "method": (lambda: run(method=np.ones(2)), "method must be one of 'rk4', 'dopri5', 'bdf'"),
    "wrenches": (lambda: run(wrenches=MODEL.robot), "wrenches must be a sequence of cdcr.Wrench"),
    "wrenches of a state": (
        lambda: MODEL.equilibrium([0.0] * 3, wrenches=cast("Any", MODEL.robot)),
        "wrenches must be a sequence of cdcr.Wrench, got Robot",
    ),
    "huge": (lambda: run(tension=[10**400, 0, 0]), "tension must be numbers of shape (3,), got"),
    "huge time": (
        lambda: cdcr.Reference(cast("Any", [0, 10**400]), *[NONE] * 3),
        "t must be numbers, got",
    ),
    "rtol": (lambda: run(rtol="a"), "rtol must be a number, got 'a' (str)"),
    "step": (lambda: run(step=10**400), "step must be a number, got 1000"),
    "max_steps": (
        lambda: run(max_steps=10**40),
        "max_steps must be a whole number 1 to 9223372036854775807, got 1000",
    ),
    "break_points": (
        lambda: run(tension=lambda t: [0.0] * 3, break_points=5),
        "break_points must be a sequence of times, got 5 (int)",
    ),
    "frame": (
        lambda: cdcr.Wrench(section=0, frame=cast("Any", np.ones(2))),
        "frame must be 'base' or 'local', got",
    ),
    "interpolation": (
        lambda: cdcr.TensionTable([0.0], [[0.0] * 3], cast("Any", np.ones(2))),
        "interpolation must be 'linear' or 'previous', got",
    ),
    "pose": (
        lambda: cast("Any", MODEL).pose(ZERO),
        "pose(): missing a required argument: 'section'",
    ),
    "too many": (
        lambda: cast("Any", MODEL).pose(ZERO, 0, 1.0, 2),
        "pose(): too many positional arguments",
    ),
    "keyword": (
        lambda: cast("Any", MODEL).tip(ZERO, speed=1.0),
        "tip(): got an unexpected keyword argument 'speed'",
    ),
    "fraction": (
        lambda: MODEL.jacobian(ZERO, 0, cast("Any", "1")),
        "fraction must be a number, got '1' (str)",
    ),
    "duration": (
        lambda: cdcr.Simulator(MODEL, step=cast("Any", np.timedelta64(1, "ms"))),
        "step must be a number, got np.timedelta64(1,'ms') (timedelta64)",
    ),
    "constructor": (
        lambda: cast("Any", cdcr.Simulator)(),
        "Simulator(): missing a required argument: 'model'",
    ),
    "another self": (
        lambda: cast("Any", cdcr.Model).tip(5, ZERO),
        "tip() takes arguments of other kinds than q list",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_the_sentence_names_what_is_wrong(name: str) -> None:
    is_refused(*CASES[name])


def test_functions_that_numpy_has_vectorised() -> None:
    plain = run(tension=lambda t: [1.0 + t, 0.0, 0.0])
    of_time = np.vectorize(lambda t: np.array([1.0 + t, 0.0, 0.0]), signature="()->(n)")
    of_state = np.vectorize(
        lambda t, q, qd: np.array([1.0 + t, 0.0, 0.0]), signature="(),(m),(m)->(n)"
    )
    for function in (of_time, of_state):
        np.testing.assert_array_equal(run(tension=function).q, plain.q)
    wrench = cdcr.Wrench(section=0, force=(0.1, 0.0, 0.0))
    factor = np.vectorize(lambda t: 1.0 + t)
    np.testing.assert_array_equal(
        run(wrenches=replace(wrench, profile=factor)).q,
        run(wrenches=replace(wrench, profile=lambda t: 1.0 + t)).q,
    )


def test_inverse_dynamics_beside_wrenches() -> None:
    model = cdcr.Model(cdcr.robots.three_sections())
    random = np.random.default_rng(3)
    q, qd = random.uniform(-1.0, 1.0, (2, 4, 6))
    tension = random.uniform(0.0, 5.0, (4, 9))
    wrenches = [
        cdcr.Wrench(section=1, fraction=0.4, force=(0.1, -0.2, 0.3), moment=(0.0, 0.01, 0.0)),
        cdcr.Wrench(section=2, force=(0.0, 0.2, 0.1), frame="local"),
    ]
    qdd = model.forward_dynamics(q, qd, tension, wrenches)
    force = model.inverse_dynamics(q, qd, qdd, wrenches)
    expected = tension @ model.actuation_matrix().T
    # Recursions of a hundred operations, on accelerations of some thousand rad/s^2.
    np.testing.assert_allclose(force, expected, rtol=0.0, atol=1e-11)
    np.testing.assert_array_equal(
        model.inverse_dynamics(q, qd, qdd, []), model.inverse_dynamics(q, qd, qdd)
    )


@pytest.mark.parametrize(
    ("function", "arguments", "sentence"),
    [
        (cdcr.Model.pose, ([0.1, 0.0], "tip", 1.0), "section must be a whole number, got 'tip'"),
        (cdcr.Model.pose, ([0.1, 0.0], 0, "end"), "fraction must be a number, got 'end' (str)"),
        (cdcr.Model.forward_dynamics, ([0.1, 0.0],), "forward_dynamics(): missing a required "),
        (cdcr.Model.rest_command, ([0.1, 0.0],), "rest_command(): too many positional arguments"),
    ],
)
def test_what_the_core_refuses_can_be_explained(
    function: Callable[..., Any], arguments: tuple[Any, ...], sentence: str
) -> None:
    with pytest.raises(TypeError):
        function(MODEL, *arguments)
    assert explain(function, (MODEL, *arguments), {}).startswith(sentence)
