"""Arguments that NumPy would make numbers of, though they are none: refused wherever numbers go."""

import datetime
import re
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr import plotting

MODEL = cdcr.Model(cdcr.robots.amouri2020())
ZEROS, T = np.zeros(2), np.array([0.0, 0.01])
MASK = [True, False]

# Two entries of each kind, and how a refusal calls them; None where NumPy itself cannot.
NO_NUMBERS: dict[str, tuple[Any, str | None]] = {
    "masked": (np.ma.array([0.1, 0.2], mask=MASK), "MaskedArray with masked entries"),
    "masked entry": ([np.ma.masked, 0.2], "list with masked entries"),
    "durations": (np.array([1, 2], "m8[ms]"), "ndarray of timedelta64[ms]"),
    "listed durations": ([np.timedelta64(1, "ns")] * 2, "list of timedelta64[ns]"),
    "Python's durations": ([datetime.timedelta(1)] * 2, "list of timedelta"),
    "durations as objects": (np.array([np.timedelta64(1, "ns"), 1.0], object), None),
    "dates": (np.array(["2020", "2021"], "M8[Y]"), "ndarray of datetime64[Y]"),
    "complex": (np.array([0.1, 0.2 + 0j]), "ndarray of complex128"),
    "listed complex": ([0.1, 0.2 + 0j], "list of complex128"),
    "complex objects": (np.array([0.1, 0.2j], object), "ndarray of complex"),
    "text": (["0.1", "0.2"], "list of text"),
    "bytes": ([b"0.1", b"0.2"], "list of text"),
    "text as objects": (np.array([0.1, "0.2"], object), "ndarray of str"),
    "nothing": ([0.1, None], "list of NoneType"),
    "records": (np.array([(0.1,), (0.2,)], [("a", float)]), "ndarray of void64"),
    "too large": ([0.1, 10**400], "list with a number too large for float64"),
    "a set": ({0.1, 0.2}, "set"),
}

# Each takes two numbers; a robot of two cables does not matter here.
CALLS: dict[str, Callable[[Any], object]] = {
    "q": lambda x: MODEL.tip(x),
    "qd": lambda x: MODEL.kinetic_energy(ZEROS, x),
    "rows of q": lambda x: MODEL.tips([x]) if isinstance(x, list) else MODEL.tips(x),
    "polar": cdcr.polar,
    "bending": lambda x: cdcr.bending(x, 0.0),
    "q0": lambda x: cdcr.simulate(MODEL, x, ZEROS, t=T),
    "t": lambda x: cdcr.simulate(MODEL, ZEROS, ZEROS, t=x),
    "table": lambda x: cdcr.simulate(MODEL, ZEROS, ZEROS, t=T, tension=(x, np.zeros((2, 3)))),
    "break_points": lambda x: cdcr.simulate(
        MODEL, ZEROS, ZEROS, t=T, tension=lambda t: [0.0, 0.0, 0.0], break_points=x
    ),
    "profile": lambda x: cdcr.simulate(
        MODEL, ZEROS, ZEROS, t=T, wrenches=cdcr.Wrench(section=0, profile=(x, [1.0, 1.0]))
    ),
    "force": lambda x: MODEL.allocate(x),
    "step": lambda x: cdcr.Simulator(MODEL).reset(ZEROS, x),
    "linearize": lambda x: MODEL.linearize(x, ZEROS, np.zeros(3)),
    "modes": lambda x: MODEL.modes(x, np.zeros(3)),
    "reference": lambda x: cdcr.Reference.from_samples(x, np.zeros((2, 2))),
    "subdivide": lambda x: cdcr.subdivide_state(MODEL.robot, 2, x),
    "factors": lambda x: cdcr.paper.factors(x),
    "trajectory": lambda x: cdcr.Trajectory(
        model=MODEL,
        t=x,
        q=np.zeros((2, 2)),
        qd=np.zeros((2, 2)),
        tension=np.zeros((2, 3)),
        status=cdcr.Status.ok,
        message="",
        stats=cdcr.simulate(MODEL, ZEROS, ZEROS, t=[0.0]).stats,
    ),
    "picture": lambda x: plotting.plot_robot(MODEL, x),
}


@pytest.mark.parametrize("kind", NO_NUMBERS)
@pytest.mark.parametrize("call", CALLS)
def test_what_is_no_number_is_refused(call: str, kind: str) -> None:
    value, called = NO_NUMBERS[kind]
    got = "" if called is None else f", got {re.escape(called)}$"
    with pytest.raises(ValueError, match=f"must be numbers.*{got}"):
        CALLS[call](value)


@pytest.mark.parametrize("kind", NO_NUMBERS)
def test_descriptions_refuse_them_too(kind: str) -> None:
    value, _ = NO_NUMBERS[kind]
    about: dict[str, Any] = {"length": 0.8, "backbone_mass": 0.03, "youngs_modulus": 9.5e9}
    about |= {"backbone_diameter": 0.005, "cable_radius": 0.02}
    with pytest.raises(ValueError, match=r"^cable_angles"):
        cdcr.Section(**about, cable_angles=value)


@pytest.mark.parametrize(
    "value", [np.timedelta64(800, "ms"), np.timedelta64(1, "ns"), np.ma.masked, 1j, "0.8", 10**400]
)
def test_a_description_refuses_one_that_is_no_number(value: Any) -> None:
    with pytest.raises(ValueError, match=r"^radius must be a number"):
        cdcr.Cable(radius=value, angle=0.0, end_section=0)
    with pytest.raises(ValueError, match=r"^section must be a whole number"):
        cdcr.Wrench(section=value)


@pytest.mark.parametrize(
    "value",
    [
        np.ma.array([0.25, 0.5], mask=False),
        np.array([0.25, 0.5], np.float16),
        np.array([0.25, 0.5], np.longdouble),
        [Fraction(1, 4), Decimal("0.5")],
        np.array([0.25, np.float32(0.5)], object),
        (0.25, np.array(0.5)),
        np.array([[0.25, 9.0, 0.5]])[0, ::2],
    ],
)
def test_real_numbers_of_any_type_are_taken(value: Any) -> None:
    np.testing.assert_array_equal(MODEL.tip(value)[1], MODEL.tip([0.25, 0.5])[1])
    np.testing.assert_array_equal(cdcr.polar(value), cdcr.polar([0.25, 0.5]))


def test_a_list_that_holds_itself_is_refused() -> None:
    endless: list[Any] = []
    endless.append(endless)
    with pytest.raises(ValueError, match=r"^q must be numbers"):
        MODEL.tip(endless)
