"""True and False are no numbers, and nothing but these is a switch."""

import ast
import importlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr import _core
from cdcr.base.calls import _kind

MODEL = cdcr.Model(cdcr.robots.amouri2020())
ZERO, NOTHING = [0.0, 0.0], [0.0, 0.0, 0.0]
REFERENCE = cdcr.Reference(
    t=np.arange(2.0), q=np.zeros((2, 2)), qd=np.zeros((2, 2)), qdd=np.zeros((2, 2))
)
PATH = cdcr.ReferencePath.constant(NOTHING)
TRUTH = {"Python": True, "NumPy": np.True_, "array": np.array(True)}


def simulator() -> cdcr.Simulator:
    return cdcr.Simulator(MODEL)


def circle(turns: Any = 1.0, duration: Any = 1.0, rest: Any = True) -> cdcr.ReferencePath:
    return cdcr.ReferencePath.circle([0.0, 0.0, 0.8], [0.01, 0.0, 0.0], [0.0, 0.01, 0.0], turns,
                                     duration, rest)  # fmt: skip


NUMBERS: dict[str, Callable[[Any], object]] = {
    "step of Simulator": lambda x: cdcr.Simulator(MODEL, step=x),
    "substeps of Simulator": lambda x: cdcr.Simulator(MODEL, substeps=x),
    "time of Simulator": lambda x: simulator().reset(ZERO, ZERO, x),
    "period of Controller": lambda x: cdcr.Controller(x),
    "t of Pid": lambda x: cdcr.Pid(MODEL, kp=1.0).update(x, ZERO, ZERO),
    "time of Loop": lambda x: cdcr.Loop(MODEL, cdcr.Pid(MODEL, kp=1.0)).reset(ZERO, ZERO, x),
    "fraction of pose": lambda x: MODEL.pose(ZERO, 0, x),
    "section of pose": lambda x: MODEL.pose(ZERO, x, 1.0),
    "fraction of jacobian": lambda x: MODEL.jacobian(ZERO, 0, fraction=x),
    "min_tension of allocate": lambda x: MODEL.allocate(ZERO, x),
    "max_tension of find_tension": lambda x: MODEL.find_tension(ZERO, max_tension=x),
    "tolerance of the search": lambda x: MODEL.inverse_kinematics([0.0, 0.0, 0.8], tolerance=x),
    "seeds of the search": lambda x: MODEL.inverse_kinematics([0.0, 0.0, 0.8], seeds=x),
    "max_theta of the search": lambda x: MODEL.inverse_kinematics([0.0, 0.0, 0.8], max_theta=x),
    "turns of a circle": lambda x: circle(x),
    "duration of a circle": lambda x: circle(1.0, x),
    "delay of a path": PATH.delayed,
    "t of a path": PATH.evaluate,
    "t of a reference": REFERENCE.evaluate,
    "t of a wrench": cdcr.Wrench(section=0, profile=lambda t: t).at,
    "theta of bending": lambda x: cdcr.bending(x, 0.0),
    "steps of Stats": lambda x: cdcr.Stats(steps=x),
    "stiff of Stats": lambda x: cdcr.Stats(stiff=x),
    "orientation_weight of TaskSpace": lambda x: cdcr.TaskSpace(MODEL, orientation_weight=x),
    "acceleration_noise of a filter": lambda x: cdcr.ExtendedKalman(
        MODEL, sensors=cdcr.Sensor(kind="tip", noise=1.0), acceleration_noise=x
    ),
    "rtol of simulate": lambda x: cdcr.simulate(MODEL, ZERO, ZERO, t=[0.0, 0.01], rtol=x),
    "max_steps of simulate": lambda x: cdcr.simulate(MODEL, ZERO, ZERO, t=[0, 0.01], max_steps=x),
    "motion of a rollout": cdcr.rollout(MODEL, [ZERO, ZERO], ZERO, step=1e-3, steps=1).model_of,
    "kp of Pid": lambda x: cdcr.Pid(MODEL, kp=x),
    "step of gradient": lambda x: cdcr.gradient(
        MODEL, ZERO, ZERO, NOTHING, lambda m: (0.0, {}), step=x, steps=1, parameters="payload"
    ),
    "fmi of an FMU": lambda x: cdcr.export.write_fmu(MODEL.robot, "here.fmu", fmi=x),
}


@pytest.mark.parametrize("kind", TRUTH)
@pytest.mark.parametrize("name", NUMBERS)
def test_a_truth_value_is_no_number(name: str, kind: str) -> None:
    with pytest.raises((TypeError, ValueError)) as caught:
        NUMBERS[name](TRUTH[kind])
    sentence = str(caught.value)
    assert sentence.startswith(f"{name.split()[0]} must be "), sentence
    assert "got " in sentence


@pytest.mark.parametrize("one", [1, 1.0, np.float64(1.0), np.float32(1.0), np.int64(1)])
def test_numbers_of_numpy_are_numbers(one: Any) -> None:
    cdcr.Simulator(MODEL, step=one)
    np.testing.assert_array_equal(MODEL.pose(ZERO, 0, one)[1], MODEL.tip(ZERO)[1])
    # Beside a switch, at which the core looks twice.
    assert circle(one, np.array(1.0), True).end == circle(1.0, one, np.True_).end == 1.0
    if not isinstance(one, (float, np.floating)):
        cdcr.Simulator(MODEL, substeps=one)


SWITCHES: dict[str, Callable[[Any, Path], object]] = {
    "feed_forward": lambda x, _: cdcr.Pid(MODEL, kp=1.0, feed_forward=x),
    "rest_to_rest": lambda x, _: circle(rest=x),
    "throw": lambda x, _: MODEL.allocate(ZERO, throw=x),
    "throw of equilibrium": lambda x, _: MODEL.equilibrium(throw=x),
    "throw of quasi_static": lambda x, _: cdcr.quasi_static(MODEL, [NOTHING], throw=x),
    "throw of simulate": lambda x, _: cdcr.simulate(MODEL, ZERO, ZERO, t=[0.0, 0.01], throw=x),
    "continuous": lambda x, _: cdcr.polar([ZERO, ZERO], continuous=x),
    "continuous of a model": lambda x, _: MODEL.polar([ZERO, ZERO], continuous=x),
    "orientation": lambda x, _: cdcr.check_path(MODEL, PATH, num_samples=5, orientation=x),
    "overwrite": lambda x, tmp: MODEL.robot.save(tmp / "robot.toml", overwrite=x),
    "overwrite of C": lambda x, tmp: cdcr.export.write_c(MODEL.robot, tmp, overwrite=x),
    "casadi": lambda x, tmp: cdcr.export.write_c(MODEL.robot, tmp / "c", casadi=x),
}


@pytest.mark.parametrize("value", [np.array([1, 2]), np.array([True]), 1, "no", None], ids=repr)
@pytest.mark.parametrize("name", SWITCHES)
def test_a_switch_is_true_or_false(name: str, value: Any, tmp_path: Path) -> None:
    with pytest.raises(TypeError) as caught:
        SWITCHES[name](value, tmp_path)
    assert str(caught.value).startswith(f"{name.split()[0]} must be True or False, got ")


@pytest.mark.parametrize("name", SWITCHES)
def test_switches_of_numpy_are_switches(name: str, tmp_path: Path) -> None:
    if name == "orientation":  # of a path that has none
        return
    SWITCHES[name](np.True_, tmp_path)


def stubs() -> Iterator[tuple[str, Any, str, str]]:
    """Each number and switch that a function of the core takes, as its stub has it."""
    folder = Path(importlib.import_module("cdcr").__path__[0])
    for file in sorted(folder.glob("_core*.pyi")):
        for node in ast.parse(file.read_text()).body:
            if not isinstance(node, ast.ClassDef) or not hasattr(_core, node.name):
                continue
            owner = getattr(_core, node.name)
            for function in node.body:
                if not isinstance(function, ast.FunctionDef) or function.args.kwarg:
                    continue
                if function.decorator_list and "staticmethod" not in ast.unparse(function):
                    continue
                public = getattr(cdcr, node.name, owner)
                found = getattr(public, function.name.strip("_"), getattr(owner, function.name))
                if "**fields" in (found.__doc__ or ""):
                    continue
                for argument in function.args.args + function.args.kwonlyargs:
                    kind = argument.annotation and ast.unparse(argument.annotation)
                    plain = str(kind).removesuffix(" | None")
                    if plain in ("int", "float", "bool"):
                        yield f"{node.name}.{function.name}", found, argument.arg, plain


def test_the_docstring_says_of_each_number_what_the_stub_says() -> None:
    """Where the sentences about arguments come from."""
    asked = list(stubs())
    assert len(asked) > 40
    for name, function, argument, kind in asked:
        assert _kind(function.__doc__ or "", argument) == kind, (name, argument)
