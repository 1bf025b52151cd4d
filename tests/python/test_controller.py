"""Controllers written in Python, and what a controller may drive."""

import threading
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import cdcr

MODEL = cdcr.Model(cdcr.robots.amouri2020(damping=5e-3))
Q0, QD0 = [0.3, -0.1], [0.0, 0.0]
T = np.linspace(0.0, 0.5, 11)


class Proportional(cdcr.Controller):
    """What a Pid with kp alone gives, by hand."""

    def __init__(self, kp: float, period: float = 0.02) -> None:
        super().__init__(period)
        self.kp = kp
        self.seen: list[float] = []
        self.resets = 0

    def reset(self) -> None:
        self.resets += 1
        self.seen.clear()

    def update(self, t: float, q: Any, qd: Any) -> Any:
        self.seen.append(t)
        return MODEL.allocate(-self.kp * q)


@pytest.mark.parametrize("method", ["bdf", "rk4"])
def test_a_class_of_ones_own_drives_a_run_as_pid_does(method: Any) -> None:
    own = Proportional(0.4)
    assert isinstance(own, cdcr.Controller)
    assert own.period == 0.02
    pid = cdcr.Pid(MODEL, kp=0.4, period=0.02, feed_forward=False)
    for _ in range(2):
        found = cdcr.simulate(MODEL, Q0, QD0, t=T, controller=own, method=method)
        expected = cdcr.simulate(MODEL, Q0, QD0, t=T, controller=pid, method=method)
        assert found.success
        np.testing.assert_array_equal(found.q, expected.q)
        np.testing.assert_array_equal(found.tension, expected.tension)
        np.testing.assert_allclose(own.seen, np.arange(26) * 0.02, rtol=0.0, atol=1e-12)
    assert own.resets == 2


def test_a_controller_may_command_lengths() -> None:
    section = replace(MODEL.robot.sections[0], damping=0.05, cable_stiffness=500.0)
    model = cdcr.Model(cdcr.Robot(sections=[section]))

    class Shorten(cdcr.Controller):
        def update(self, t: float, q: Any, qd: Any) -> Any:
            return model.rest_command() - [0.002, 0.0, 0.0]

    run = cdcr.simulate(model, [0.0, 0.0], QD0, t=[0.0, 0.1], controller=Shorten(0.01))
    expected = cdcr.simulate(
        model, [0.0, 0.0], QD0, t=[0.0, 0.1], command=model.rest_command() - [0.002, 0.0, 0.0]
    )
    np.testing.assert_allclose(run.q, expected.q, rtol=0.0, atol=1e-7)
    assert run.tension[-1, 0] > 0.0


class PatienceError(Exception):
    pass


def test_what_its_methods_raise_leaves_the_run_as_it_is() -> None:
    error = PatienceError("enough")

    class Tired(cdcr.Controller):
        early = False

        def reset(self) -> None:
            if self.early:
                raise error

        def update(self, t: float, q: Any, qd: Any) -> Any:
            if t > 0.1:
                raise error
            return [0.0, 0.0, 0.0]

    for early in (False, True):
        tired = Tired(0.01)
        tired.early = early
        for _ in range(2):
            with pytest.raises(PatienceError) as caught:
                cdcr.simulate(MODEL, Q0, QD0, t=T, controller=tired)
            assert caught.value is error


@pytest.mark.parametrize(
    ("value", "sentence"),
    [
        ([0.0, 0.0], r"update must (have|be numbers of) shape \(3,\), got \(2,\)"),
        ([0.0, -1.0, 0.0], r"update\[1\] \(cable 2\) must be >= 0 \(a cable cannot push\), got -1"),
        ([0.0, np.nan, 0.0], r"update\[1\] \(cable 2\) must be finite, got nan"),
        (None, r"update must (have|be numbers of) shape \(3,\)"),
    ],
)
def test_what_it_gives_is_checked(value: Any, sentence: str) -> None:
    class Wrong(cdcr.Controller):
        def update(self, t: float, q: Any, qd: Any) -> Any:
            return value

    with pytest.raises(ValueError, match=f"^the value of the controller's {sentence}"):
        cdcr.simulate(MODEL, Q0, QD0, t=T, controller=Wrong(0.01))


def test_what_it_lacks_is_named() -> None:
    class Idle(cdcr.Controller):
        pass

    with pytest.raises(NotImplementedError, match=r"needs a method update\(self, t, q, qd\)"):
        cdcr.simulate(MODEL, Q0, QD0, t=T, controller=Idle(0.01))
    for period in (0.0, -1.0, np.nan, np.inf):
        with pytest.raises(ValueError, match=r"period must be > 0 s and finite, got"):
            cdcr.Controller(period)


@pytest.mark.parametrize(("made_for", "drives"), [(1, 2), (2, 1)])
def test_a_pid_for_a_robot_of_other_sizes_is_refused(made_for: int, drives: int) -> None:
    section = MODEL.robot.sections[0]
    bare = cdcr.Section(length=0.2, backbone_mass=0.01, backbone_diameter=1e-3, youngs_modulus=1e10)
    models = {
        1: cdcr.Model(cdcr.Robot(sections=[section])),
        2: cdcr.Model(cdcr.Robot(sections=[section, bare])),
    }
    zero = np.zeros(2 * drives)
    with pytest.raises(ValueError, match="controller was made for a robot of") as caught:
        cdcr.simulate(
            models[drives],
            zero,
            zero,
            t=[0.0, 0.05],
            controller=cdcr.Pid(models[made_for], kp=1.0, ki=1.0),
        )
    assert str(caught.value) == (
        f"the controller was made for a robot of {2 * made_for} coordinates and 3 cables, but the "
        f"model has {2 * drives} coordinates and 3 cables"
    )


def test_one_controller_drives_one_run_at_a_time() -> None:
    pid = cdcr.Pid(MODEL, kp=0.4, period=0.02)
    expected = cdcr.simulate(MODEL, Q0, QD0, t=T, controller=pid)
    inside, go_on = threading.Event(), threading.Event()
    found: list[cdcr.Trajectory] = []

    def wait(t: float) -> None:
        inside.set()
        assert go_on.wait(60.0)

    def work() -> None:
        found.append(cdcr.simulate(MODEL, Q0, QD0, t=T, controller=pid, progress=wait))

    thread = threading.Thread(target=work)
    thread.start()
    assert inside.wait(60.0)
    try:
        with pytest.raises(ValueError, match="drives another run at this moment: make one for"):
            cdcr.simulate(MODEL, Q0, QD0, t=T, controller=pid)
    finally:
        go_on.set()
        thread.join()
    np.testing.assert_array_equal(found[0].q, expected.q)
    assert cdcr.simulate(MODEL, Q0, QD0, t=T, controller=pid).success


def test_a_simulator_and_a_pid_tell_their_model() -> None:
    assert cdcr.Pid(MODEL, kp=1.0).model is MODEL
    assert cdcr.Simulator(MODEL).model is MODEL
