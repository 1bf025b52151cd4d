"""What leaves a process: every public result and exception, by pickle and by copy."""

import copy
import multiprocessing
import pickle
from collections.abc import Callable
from functools import cache, partial
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr import _core

MODEL = cdcr.Model(cdcr.robots.three_sections())
T = np.linspace(0.0, 1.0, 21)


def pickled(protocol: int, thing: Any) -> Any:
    return pickle.loads(pickle.dumps(thing, protocol))


WAYS: dict[str, Callable[[Any], Any]] = {
    f"protocol {p}": partial(pickled, p) for p in range(pickle.HIGHEST_PROTOCOL + 1)
}
WAYS |= {"copy": copy.copy, "deepcopy": copy.deepcopy}


class Bang(cdcr.Controller):
    """Pulls one cable, then none."""

    def __init__(self, pull: float) -> None:
        super().__init__(period=0.25)
        self.pull = pull
        self.calls = 0

    def update(self, t: float, q: Any, qd: Any) -> list[float]:
        self.calls += 1
        return [self.pull * (t < 0.5)] + [0.0] * 8


def swing(t: float) -> float:
    return 0.3 * float(np.sin(t))


def turn(t: float) -> float:
    return 2.0 * t


def bent(t: float) -> list[float]:
    return [swing(t), 0.1] * 3


def pid() -> cdcr.Pid:
    made = cdcr.Pid(MODEL, kp=1.0, ki=2.0, kd=0.1, period=0.01, max_tension=30.0, cables=range(9))
    made.reference = np.full(6, 0.1)
    made.update(0.0, np.zeros(6), np.zeros(6))
    return made


def simulator() -> cdcr.Simulator:
    made = cdcr.Simulator(MODEL, step=1e-4, substeps=2)
    made.reset(np.full(6, 0.1), np.zeros(6), time=0.7)
    for _ in range(3):
        made.step(np.ones(9))
    return made


def infeasible(force: Any) -> cdcr.InfeasibleError:
    with pytest.raises(cdcr.InfeasibleError) as caught:
        MODEL.allocate(force, max_tension=1.0)
    return caught.value


def convergence() -> cdcr.ConvergenceError:
    with pytest.raises(cdcr.ConvergenceError) as caught:
        MODEL.equilibrium(np.full(9, 1e6) * np.arange(9))
    return caught.value


def inverse_run() -> cdcr.InverseRun:
    return cdcr.inverse_run(MODEL, REFERENCE, infeasible="nearest")


def loop_run() -> cdcr.LoopRun:
    loop = cdcr.Loop(MODEL, pid(), step=0.01)
    loop.reset(np.zeros(6), np.zeros(6))
    return loop.run(0.05)


@cache
def identified() -> cdcr.identification.Identified:
    pulls = np.array([[1.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
    tips = ARM.tip([ARM.equilibrium(pull) for pull in pulls])[1]
    poses = cdcr.identification.Poses(pulls, tip=1.001 * tips, noise=1e-3)
    return cdcr.identify(poses, ARM.robot, STIFFNESS)


@cache
def design() -> cdcr.identification.Design:
    candidates = np.eye(3) + 1.0
    return cdcr.identification.informative_commands(ARM.robot, STIFFNESS, candidates, noise=1e-3)


def mpc() -> cdcr.control.Mpc:
    pytest.importorskip("piqp", reason="the extra mpc is not installed")
    made = cdcr.control.Mpc(ARM, max_tension=20.0, horizon=3)
    made.update(0.0, np.zeros(2), np.zeros(2))
    return made


ARM = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
STIFFNESS = {"sections[*].youngs_modulus": None}
WINCH = cdcr.Winch(drum_radius=0.01, inertia=1e-6, bandwidth=50.0)
TIP = cdcr.Sensor(kind="tip", noise=1e-3)
PATH = cdcr.ReferencePath.spline([0.0, 1.0], [np.zeros(6), np.full(6, 0.1)])
REFERENCE = cdcr.Reference.from_functions(T, bent)
RUN = cdcr.simulate(MODEL, np.full(6, 0.1), np.zeros(6), t=T[:3])
PUBLIC: dict[str, Callable[[], Any]] = {
    "Actuator": lambda: cdcr.Actuator(time_constant=0.1, winch=WINCH),
    "Cable": lambda: cdcr.Cable(radius=0.01, angle=0.0, end_section=0),
    "Controller": lambda: Bang(2.0),
    "ConvergenceError": convergence,
    "Derivatives": lambda: MODEL.derivatives(np.zeros(6), np.zeros(6), np.ones(9)),
    "Equilibrium": lambda: MODEL.find_equilibrium(np.ones(9)),
    "Allocation": lambda: MODEL.find_tension(np.full(6, 1e3), max_tension=1.0),
    "ExtendedKalman": lambda: cdcr.ExtendedKalman(MODEL, sensors=TIP, variants=MODEL),
    "UnscentedKalman": lambda: cdcr.UnscentedKalman(MODEL, sensors=TIP, force_at=(0, 1.0)),
    "MomentumObserver": lambda: cdcr.MomentumObserver(MODEL, force_at=(1, 0.5)),
    "InfeasibleError": lambda: infeasible(np.full(6, 1e3)),
    "InverseKinematics": lambda: MODEL.inverse_kinematics([0.1, 0.0, 0.3]),
    "InverseRun": inverse_run,
    "Model": lambda: MODEL,
    "Modes": lambda: MODEL.modes(np.zeros(6), np.zeros(9)),
    "PathReport": lambda: cdcr.check_path(MODEL, PATH, num_samples=5),
    "Pid": pid,
    "ComputedTorque": lambda: cdcr.ComputedTorque(MODEL, kp=np.ones(6), max_tension=20.0),
    "StateFeedback": lambda: cdcr.StateFeedback(MODEL, gain=np.ones((9, 12))),
    "TaskSpace": lambda: cdcr.TaskSpace(MODEL, pretension=np.ones(9)),
    "QuasiStatic": lambda: cdcr.quasi_static(MODEL, np.ones((2, 9))),
    "ReferencePath": lambda: PATH,
    "ReferencePath of a circle": lambda: cdcr.ReferencePath.circle([0.0], [1.0], [2.0], 1.0, 2.0),
    "LoopRun": loop_run,
    "Sensor": lambda: cdcr.Sensor(kind="curvature", places=[(0, 0.5)]),
    "Winch": lambda: WINCH,
    "Reference of functions": lambda: REFERENCE,
    "Reference of angles": lambda: cdcr.Reference.from_angles(T, swing, turn),
    "Reference of a constant": lambda: cdcr.Reference.from_angles(T, 0.2, turn),
    "Reference of samples": lambda: cdcr.Reference.from_samples(T, REFERENCE.q),
    "Reference of derivatives": lambda: cdcr.Reference(T, REFERENCE.q, REFERENCE.qd, REFERENCE.qdd),
    "Robot": lambda: MODEL.robot,
    "Gradient": lambda: cdcr.gradient(
        MODEL,
        np.zeros(6),
        np.zeros(6),
        np.ones(9),
        lambda motion: (1.0, {"q": motion.q}),
        step=1e-3,
        steps=2,
    ),
    "Rollout": lambda: cdcr.rollout(MODEL, np.zeros(6), np.zeros(6), step=0.001, steps=2),
    "RolloutFailure": lambda: cdcr.RolloutFailure(3, cdcr.Status.bending_limit, "It bent."),
    "Section": lambda: MODEL.robot.sections[0],
    "Simulator": simulator,
    "Simulator not started": lambda: cdcr.Simulator(MODEL),
    "SlackEvent": lambda: cdcr.SlackEvent(0.1, 2, True),
    "Stats": lambda: RUN.stats,
    "Status": lambda: cdcr.Status.bending_limit,
    "TensionTable": lambda: cdcr.TensionTable(T, np.ones((21, 9))),
    "Trajectory": lambda: RUN,
    "Wrench": lambda: cdcr.Wrench(section=1, force=(0.0, 0.1, 0.0), profile=swing),
    "Scenario": lambda: cdcr.scenarios.get("three-sections"),
    "Identified": identified,
    "CrossValidation": cache(lambda: identified().cross_validate(folds=2)),
    "Design": design,
    "Parameter": lambda: cdcr.identification.Parameter(start=2.0, low=1.0),
    "Poses": lambda: cdcr.identification.Poses(np.ones((2, 3)), tip=np.ones((2, 3)), noise=0.1),
    "Motion": lambda: cdcr.identification.Motion(
        T, np.ones(3), q=np.ones((21, 2)), start=[1.0] * 3
    ),
    "Frequencies": lambda: cdcr.identification.Frequencies([2.0], command=np.ones(3), noise=0.1),
    "Mpc": mpc,
    "Claim": lambda: cdcr.paper.Claim(
        name="sum", where="p. 1", claim="1", computed="2", verdict="holds", values={"sum": 2.0}
    ),
    "Factors": lambda: cdcr.paper.factors(0.3),
    "PolarModel": lambda: cdcr.paper.PolarModel(ARM.robot),
    "RunMetric of the end": lambda: cdcr.sweeps.METRICS["final_tip_x"],
    "RunMetric of the whole": lambda: cdcr.sweeps.METRICS["peak_theta"],
    "RunMetric of speeds": lambda: cdcr.sweeps.METRICS["peak_tip_speed"],
}


def content(thing: Any, depth: int = 3) -> Any:
    """Everything that can be read off a thing, in plain values."""
    if isinstance(thing, np.ndarray):
        return thing.shape, thing.dtype.str, thing.tobytes(), thing.flags.writeable
    if isinstance(thing, (bool, int, float, str, type(None), cdcr.Status)):
        return thing
    if isinstance(thing, (list, tuple)):
        return [content(one, depth) for one in thing]
    if callable(thing) or depth == 0:
        return type(thing).__name__
    if isinstance(thing, BaseException):
        return str(thing), thing.args, content(list(thing.__dict__.values()), depth - 1)
    names = [name for name in dir(type(thing)) if not name.startswith("_")]
    names += [name for name in getattr(thing, "__dict__", {}) if not name.startswith("_")]
    plain = {}
    for name in names:
        if name not in ("plot", "frequency_hz") and not callable(getattr(type(thing), name, None)):
            plain[name] = content(getattr(thing, name), depth - 1)
    return type(thing).__name__, plain


def test_every_public_class_is_here() -> None:
    parts = (cdcr, cdcr.control, cdcr.identification, cdcr.paper, cdcr.scenarios, cdcr.sweeps)
    public = {name: getattr(part, name) for part in parts for name in part.__all__}
    classes = {name for name, thing in public.items() if isinstance(thing, type)}
    assert classes - {"Loop", "LoopLog"} <= {name.split()[0] for name in PUBLIC}


@pytest.mark.parametrize("name", cdcr.sweeps.METRICS)
def test_a_copied_metric_computes_the_same(name: str) -> None:
    metric = cdcr.sweeps.METRICS[name]
    for way in WAYS.values():
        np.testing.assert_equal(way(metric).function(RUN), metric.function(RUN))


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", PUBLIC)
def test_pickles_and_copies_say_the_same(name: str, way: str) -> None:
    thing = PUBLIC[name]()
    assert content(WAYS[way](thing)) == content(thing)


@pytest.mark.parametrize("way", WAYS)
def test_a_copied_simulator_goes_on_alike_and_by_itself(way: str) -> None:
    one = simulator()
    other = WAYS[way](one)
    before = other.time
    for _ in range(5):
        assert one.step(np.ones(9)) is cdcr.Status.ok
    assert other.time == before
    for _ in range(5):
        assert other.step(np.ones(9)) is cdcr.Status.ok
    assert other.time == one.time
    np.testing.assert_array_equal(other.q, one.q)
    assert WAYS[way](cdcr.Simulator(MODEL)).step(np.ones(9)) is cdcr.Status.not_started


@pytest.mark.parametrize("way", WAYS)
def test_a_copied_reference_moves_alike(way: str) -> None:
    for name in PUBLIC:
        if name.startswith("Reference"):
            reference = PUBLIC[name]()
            np.testing.assert_array_equal(
                WAYS[way](reference).evaluate(0.123), reference.evaluate(0.123)
            )


def test_a_copied_pid_goes_on_alike() -> None:
    one = pid()
    other = copy.deepcopy(one)
    state = np.full(6, 0.02), np.full(6, -0.1)
    np.testing.assert_array_equal(other.update(0.01, *state), one.update(0.01, *state))
    np.testing.assert_array_equal(other.integral, one.integral)
    other.reset()
    assert np.any(one.integral)


@pytest.mark.parametrize("way", WAYS)
def test_what_the_core_keeps_to_itself_refuses_with_a_sentence(way: str) -> None:
    loop = cdcr.Loop(MODEL, pid(), step=0.01)  # its controller is in it
    for private in (_core.Loads(), _core.Options(), MODEL.robot._to_core(), loop):
        with pytest.raises(TypeError) as caught:
            WAYS[way](private)
        assert str(caught.value) == (
            f"a cdcr {type(private).__name__} can be neither pickled nor copied: make another of "
            "what it was made of"
        )


def test_what_no_constructor_has_filled_refuses_with_a_sentence() -> None:
    bound = [thing for thing in vars(_core).values() if isinstance(thing, type(_core.Model))]
    assert len(bound) > 12
    for cls in [*bound, cdcr.Pid, cdcr.Model, Bang]:
        empty = cls.__new__(cls)  # type: ignore[call-overload]
        for name in dir(_core.Model) if cls is cdcr.Model else dir(cls):
            member = getattr(cls, name)
            if name.startswith("_") or not isinstance(member, property):
                continue
            if cls is not cdcr.Model or name not in ("robot", "formulation"):
                with pytest.raises(TypeError, match="is empty: its __init__ has not been called"):
                    getattr(empty, name)
    for run in (
        lambda: cdcr.simulate(
            MODEL, np.zeros(6), np.zeros(6), t=[0.0, 1.0], controller=Bang.__new__(Bang)
        ),
        lambda: cdcr.Simulator(cdcr.Model.__new__(cdcr.Model)),
        lambda: pickle.dumps(cdcr.Pid.__new__(cdcr.Pid)),
    ):
        with pytest.raises(TypeError, match="is empty: its __init__ has not been called"):
            run()


@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
def test_pools_hand_on_answers_and_exceptions(method: str) -> None:
    allocate = partial(MODEL.allocate, max_tension=1.0)
    with multiprocessing.get_context(method).Pool(1) as pool:
        possible = 1e-3 * np.arange(6.0)
        (found,) = pool.map_async(allocate, [possible]).get(timeout=120)
        np.testing.assert_array_equal(found, allocate(possible))
        with pytest.raises(cdcr.InfeasibleError) as caught:
            pool.map_async(allocate, [possible, np.full(6, 1e3)]).get(timeout=120)
    expected = infeasible(np.full(6, 1e3))
    assert str(caught.value) == str(expected)
    np.testing.assert_array_equal(caught.value.tension, expected.tension)
    assert caught.value.limiting == expected.limiting
