"""A wrench: what it takes, what it refuses, and what it is at a time."""

import re
from typing import Any

import numpy as np
import pytest

import cdcr

NAN, INF = np.nan, np.inf
Q, QD = np.array([0.3, -0.2, 0.1, 0.4]), np.array([1.0, 0.5, -2.0, 1.0])


def refuses(sentence: str) -> Any:
    return pytest.raises(ValueError, match=f"^{re.escape(sentence)}$")


@pytest.fixture(scope="module")
def model() -> cdcr.Model:
    return cdcr.Model(cdcr.robots.amouri2020().subdivide(2))


def test_values_are_kept_as_plain_numbers() -> None:
    wrench = cdcr.Wrench(
        section=np.int64(1), fraction=np.float32(0.5), force=np.array([1, 2, 3]), moment=[0, 1, 0]
    )
    assert (wrench.section, wrench.fraction, wrench.force) == (1, 0.5, (1.0, 2.0, 3.0))
    assert type(wrench.section) is int
    assert type(wrench.force[0]) is float
    assert wrench.moment == (0.0, 1.0, 0.0)
    assert wrench.frame == "base"


@pytest.mark.parametrize(
    ("fields", "sentence"),
    [
        ({"section": 0.5}, "section must be a whole number >= 0, got 0.5 (float)"),
        ({"section": -1}, "section must be a whole number >= 0, got -1 (int)"),
        ({"section": True}, "section must be a whole number >= 0, got True (bool)"),
        ({"fraction": "end"}, "fraction must be a number 0 to 1, got 'end' (str)"),
        ({"force": 5.0}, "force must be three numbers of N, got 5.0 (float)"),
        ({"force": (1.0, 2.0)}, "force must be three numbers of N, got (1.0, 2.0) (tuple)"),
        ({"force": None}, "force must be three numbers of N, got None (NoneType)"),
        ({"force": (1.0, "a", 0.0)}, "force[1] must be a number of N, got 'a' (str)"),
        (
            {"moment": [1.0] * 4},
            "moment must be three numbers of N m, got [1.0, 1.0, 1.0, 1.0] (list)",
        ),
        ({"frame": "world"}, "frame must be 'base' or 'local', got 'world' (str)"),
        (
            {"interpolation": "cubic"},
            "interpolation must be 'linear' or 'previous', got 'cubic' (str)",
        ),
        (
            {"profile": 3.0},
            "profile must be a pair (times, factors), a callable or None, got 3.0 (float)",
        ),
        ({"break_points": 1.0}, "break_points must be a sequence of times, got 1.0 (float)"),
        (
            {"force": 1.0, "moment": (1.0,)},
            "force must be three numbers of N, got 1.0 (float)\n"
            "moment must be three numbers of N m, got (1.0,) (tuple)",
        ),
    ],
)
def test_bad_fields_get_a_sentence_each(fields: dict[str, Any], sentence: str) -> None:
    with refuses(sentence):
        cdcr.Wrench(**({"section": 0} | fields))


@pytest.mark.parametrize(
    ("fields", "sentence"),
    [
        ({"section": 2}, "wrenches[1].section must be 0 to 1, got 2"),
        ({"fraction": 1.5}, "wrenches[1].fraction must be 0 to 1, got 1.5"),
        ({"fraction": NAN}, "wrenches[1].fraction must be 0 to 1, got nan"),
        (
            {"force": (0.0, NAN, 1.0)},
            "wrenches[1].force must be three finite numbers of N, got [  0 nan   1]",
        ),
        (
            {"moment": (INF, 0.0, 0.0)},
            "wrenches[1].moment must be three finite numbers of N m, got [inf   0   0]",
        ),
    ],
)
def test_the_model_names_the_wrench_it_cannot_take(
    model: cdcr.Model, fields: dict[str, Any], sentence: str
) -> None:
    good = cdcr.Wrench(section=0)
    bad = [good, cdcr.Wrench(**({"section": 0} | fields))]
    tension = np.zeros(model.num_cables)
    with refuses(sentence):
        model.forward_dynamics(Q, QD, tension, wrenches=bad)
    with refuses(sentence):
        model.equilibrium(tension, wrenches=bad)
    with refuses(sentence):
        cdcr.simulate(model, Q, QD, t=[0.0, 0.1], wrenches=bad)
    sim = cdcr.Simulator(model)
    sim.reset(Q, QD)
    with refuses(sentence):
        sim.step(tension, bad)
    np.testing.assert_array_equal(sim.q, Q)
    assert np.isfinite(model.forward_dynamics(Q, QD, tension, wrenches=[good])).all()
    assert sim.step(tension, [good]) == cdcr.Status.ok


@pytest.mark.parametrize(
    ("wrenches", "got"),
    [
        (5, "wrenches must be a sequence of cdcr.Wrench"),
        ([1.0], "wrenches[0] must be a cdcr.Wrench"),
    ],
)
def test_what_is_no_wrench(model: cdcr.Model, wrenches: Any, got: str) -> None:
    tension = np.zeros(model.num_cables)
    with pytest.raises(ValueError, match=f"^{re.escape(got)}, got "):
        model.forward_dynamics(Q, QD, tension, wrenches=wrenches)
    with pytest.raises(ValueError, match=f"^{re.escape(got)}, got "):
        cdcr.simulate(model, Q, QD, t=[0.0, 0.1], wrenches=wrenches)


def test_functions_of_a_state_take_no_profile(model: cdcr.Model) -> None:
    growing = cdcr.Wrench(section=0, force=(1.0, 0.0, 0.0), profile=([0.0, 2.0], [0.0, 1.0]))
    tension = np.zeros(model.num_cables)
    with pytest.raises(ValueError, match=r"^wrenches\[0\] has a profile"):
        model.forward_dynamics(Q, QD, tension, wrenches=[growing])
    now = growing.at(0.5)
    assert now.force == (0.25, 0.0, 0.0)
    assert now.profile is None
    by_hand = cdcr.Wrench(section=0, force=(0.25, 0.0, 0.0))
    np.testing.assert_array_equal(
        model.forward_dynamics(Q, QD, tension, wrenches=[now]),
        model.forward_dynamics(Q, QD, tension, wrenches=[by_hand]),
    )


def test_a_wrench_at_a_time() -> None:
    one: dict[str, Any] = {"section": 0, "force": (2.0, 0.0, 0.0), "moment": (0.0, 4.0, 0.0)}
    table = ([1.0, 2.0], [3.0, -1.0])
    linear = cdcr.Wrench(**one, profile=table)
    held = cdcr.Wrench(**one, profile=table, interpolation="previous")
    called = cdcr.Wrench(**one, profile=lambda t: t * t)
    assert [linear.at(t).force[0] for t in (0.0, 1.5, 2.0, 9.0)] == [6.0, 2.0, -2.0, -2.0]
    assert [held.at(t).force[0] for t in (0.0, 1.5, 2.0, 9.0)] == [6.0, 6.0, -2.0, -2.0]
    assert called.at(3.0).moment == (0.0, 36.0, 0.0)
