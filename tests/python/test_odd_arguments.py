"""Arguments of odd shapes and sizes: a sentence that names the item, and a short one."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest

import cdcr
from refusals import is_refused

MODEL = cdcr.Model(cdcr.robots.amouri2020())
NONE = cast("Any", None)
ZERO = [0.0, 0.0]
PATH = cdcr.ReferencePath.spline([0.0, 1.0], [ZERO, [0.1, 0.0]])
ARRAY = cast("Any", np.array(1.0))  # can be gone through no more than a number


def run(**arguments: Any) -> cdcr.Trajectory:
    return cdcr.simulate(MODEL, ZERO, ZERO, t=[0.0, 0.01], **arguments)


def gradient(**arguments: Any) -> cdcr.Gradient:
    usual: dict[str, Any] = {"q0": ZERO, "qd0": ZERO, "tension": [0.0] * 3, "step": 1e-3}
    given = usual | {"steps": 1} | arguments
    return cdcr.gradient(MODEL, cost=lambda motion: (0.0, {}), **given)


def identified(path: str) -> object:
    pose = cdcr.identification.Poses([[0.0] * 3], tip=[[0.0, 0.0, 0.8]])
    return cdcr.identify(pose, MODEL.robot, {path: None})


def updated(measurements: object) -> object:
    sensor = cdcr.Sensor(kind="tip", noise=1e-3)
    filter_ = cdcr.ExtendedKalman(MODEL, sensors=[sensor], period=1e-3)
    return filter_.update(cast("Any", measurements), [0.0] * 3)


def circle(**change: Any) -> cdcr.ReferencePath:
    usual: dict[str, Any] = {"center": [0.0] * 3, "x": [0.1, 0.0, 0.0], "y": [0.0, 0.1, 0.0]}
    return cdcr.ReferencePath.circle(**{**usual, "turns": 1.0, "duration": 1.0, **change})


CASES: dict[str, tuple[Callable[[], object], str]] = {
    "wrenches without dimensions": (
        lambda: run(wrenches=np.array(1.0)),
        "wrenches must be a sequence of cdcr.Wrench, got array(1.) (ndarray)",
    ),
    "wrenches of a rollout": (
        lambda: cdcr.rollout(MODEL, ZERO, ZERO, step=1.0, steps=1, wrenches=ARRAY),
        "wrenches must be a sequence of cdcr.Wrench, got array(1.) (ndarray)",
    ),
    "parameters without dimensions": (
        lambda: MODEL.parameter_derivatives(ZERO, ZERO, [0.0] * 3, ARRAY),
        "parameters must be paths, such as 'sections.1.youngs_modulus', got array(1.)",
    ),
    "sensitivities without dimensions": (
        lambda: run(sensitivities=ARRAY),
        "sensitivities must be names, such as 'q0', 'tension' or 'payload', got array(1.)",
    ),
    "data without dimensions": (
        lambda: cdcr.identify(ARRAY, MODEL.robot, {}),
        "data must be Poses, a Motion or Frequencies, or a sequence of these, got ndarray",
    ),
    "one of a sweep's parameters": (
        lambda: cdcr.sweep("step-tension", ARRAY, metrics="steps"),
        "parameters must be a mapping from names to values, got array(1.) (ndarray)",
    ),
    "start of a gradient": (
        lambda: gradient(q0=5.0),
        "q0 must have shape (2,), got ()",
    ),
    "rates of a gradient": (
        lambda: gradient(qd0=[[0.0, 0.0]]),
        "qd0 must have shape (2,), got (1, 2)",
    ),
    "step of a gradient": (
        lambda: gradient(step=None),
        "step must be a number > 0 s and finite, got None (NoneType)",
    ),
    "rate of a path": (
        lambda: cdcr.check_path(MODEL, PATH, max_rate=float("nan")),
        "max_rate must be a number > 0 N/s, got nan (float)",
    ),
    "negative rate of a path": (
        lambda: cdcr.check_path(MODEL, PATH, max_rate=-5.0),
        "max_rate must be a number > 0 N/s, got -5.0 (float)",
    ),
    "rates of a linear system": (
        lambda: MODEL.to_statespace(ZERO, qd=[ZERO, ZERO]),
        "qd must have shape (2,), got (2, 2)",
    ),
    "tensions of a linear system": (
        lambda: MODEL.to_statespace(ZERO, [[0.0] * 3] * 2),
        "tension must have shape (3,), got (2, 3)",
    ),
    "outputs of a linear system": (
        lambda: MODEL.to_statespace(ZERO, outputs=cast("Any", [5])),
        "the name of an output must be a string, got 5 (int)",
    ),
    "version of FMI": (
        lambda: cdcr.export.write_fmu(MODEL.robot, "never.fmu", fmi=cast("Any", [3])),
        "fmi must be 2 or 3, got [3] (list)",
    ),
    "measurements without dimensions": (
        lambda: updated(ARRAY),
        "measurements must be a sequence of arrays or None, one for each sensor",
    ),
    "what one sensor tells": (
        lambda: updated(ZERO),
        "measurements[0] must have shape (3,), got ()",
    ),
    "method that is no text": (
        lambda: cdcr.Loop(MODEL, cdcr.Pid(MODEL, kp=1.0), method=cast("Any", "a\udc80")),
        r"method must be 'rk4' or 'rosenbrock', got 'a\udc80'",
    ),
    "center of a path": (
        lambda: circle(center=[0.0]),
        "center must have shape (3,), got (1,)",
    ),
    "turns of a path": (
        lambda: circle(turns=1e308),
        "values, rates and accelerations of a path must be finite all along it, but are not with "
        "1e+308 turns in a duration of 1 s",
    ),
    "section of a path": (
        lambda: identified("sections[1].length"),
        "parameter 'sections[1].length': [1] must be 0, * or :",
    ),
}


def test_words_that_are_no_utf8_end_no_process() -> None:
    def breaks(_: float) -> list[float]:
        raise TypeError("a \udc80")

    with pytest.raises(TypeError, match="a "):
        run(tension=breaks)
    named: dict[str, Any] = {"\udc80": 1}
    with pytest.raises((TypeError, UnicodeEncodeError)):
        MODEL.pose(ZERO, 0, **named)


@pytest.mark.parametrize("name", CASES)
def test_the_sentence_names_what_is_wrong(name: str) -> None:
    is_refused(*CASES[name])


@pytest.mark.parametrize(
    "call",
    [
        lambda: cdcr.Robot(sections=cast("Any", [0.0] * 1000)),
        lambda: cdcr.Robot(sections=MODEL.robot.sections, tool=cast("Any", [0.0] * 1000)),
        lambda: cdcr.Sensor(kind="curvature", places=cast("Any", [0.0] * 1000)),
        lambda: cdcr.Sensor(kind=cast("Any", [0.0] * 1000)),
        lambda: cdcr.Model(MODEL.robot, "exact" * 1000),
        lambda: run(method="rk4" * 1000),
        lambda: cdcr.Loop(MODEL, cdcr.Pid(MODEL, kp=1.0), method=cast("Any", "rk4" * 1000)),
        lambda: cdcr.ExtendedKalman(
            MODEL,
            sensors=[cdcr.Sensor(kind="tip", noise=1e-3)],
            period=1e-3,
            acceleration_noise=[0.0] * 1000,
        ),
        lambda: cdcr.Pid(MODEL, kp=1.0, cables=cast("Any", [0.5] * 1000)),
        lambda: MODEL.robot.subdivide(cast("Any", [0.5] * 1000)),
    ],
)
def test_a_refusal_is_short_whatever_is_given(call: Callable[[], object]) -> None:
    with pytest.raises(ValueError, match="must be") as caught:
        call()
    told = str(caught.value).split("\n")
    assert len(told) <= 21
    assert len(set(told)) == len(told)
    assert max(map(len, told)) < 200
    assert (told[-1] == "and 980 more values must be other than given") == (len(told) > 1)


def test_what_is_asked_of_pictures(tmp_path: Path) -> None:
    plotting = pytest.importorskip("cdcr.plotting")
    scenario, other = cdcr.scenarios.get("step-tension"), cdcr.Model(cdcr.robots.three_sections())
    plain = run()
    long = cdcr.simulate(other, [0.0] * 6, [0.0] * 6, t=[0.0, 0.01])
    film = tmp_path / "film.gif"
    for call, sentence in (
        (lambda: plotting.resize(None, "journal"), "figure must be a Matplotlib figure, got None"),
        (lambda: plotting.show_or_save(5, []), "figure must be a Matplotlib figure, got int"),
        (lambda: plotting.show_or_save(plain.plot(), 5), "arguments must be a sequence of str"),
        (lambda: scenario.figure(), "run must be a cdcr.Trajectory, got NoneType"),
        (lambda: scenario.summary(cast("Any", 5)), "run must be a cdcr.Trajectory, got int"),
        (lambda: scenario.summary(long), "run must be one of a robot of 2 coordinates, got 6"),
        (lambda: plain.animate(film, progress=cast("Any", "x")), "progress must be a function of"),
        (lambda: plain.animate(film, fps=5e-324), "fps must be at least 0.01, got 5e-324"),
        (lambda: plotting.resize(plain.plot(), (1, 2)), "size must be 'journal' (8.5 cm wide), "),
        (
            lambda: cdcr.sweep("step-tension", {"payload": [0.0]}, metrics="steps", seed=NONE),
            "seed must be a whole number >= 0, got None",
        ),
    ):
        with pytest.raises((TypeError, ValueError)) as caught:
            call()
        assert str(caught.value).startswith(sentence)
    assert plain.animate(film, fps=0.01, speed=1e308) == film  # one picture, at the start


def test_a_size_without_room_for_a_picture_is_told() -> None:
    plotting = pytest.importorskip("cdcr.plotting")
    long = cdcr.Model(cdcr.robots.three_sections())
    figure = cdcr.simulate(long, [0.1] * 6, [0.0] * 6, t=[0.0, 0.01]).plot()
    with pytest.warns(UserWarning, match=r"^20 x 3 cm has no room for all of this picture$"):
        plotting.resize(figure, (20, 3))
    figure.canvas.draw()  # without a warning
