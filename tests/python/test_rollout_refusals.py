"""What a rollout refuses, and in which words."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import cdcr
from pull_back import Spring, pull_back

MODEL = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
N, STEPS = 5, 20
Q0, QD0 = np.zeros((N, 2)), np.zeros((N, 2))
PULLS = np.ones((N, STEPS, 3))
PID = cdcr.Pid(MODEL, kp=1.0)
RUN: dict[str, Any] = {"step": 2.0**-7, "steps": STEPS}

REFUSED: list[tuple[dict[str, Any], type[Exception], str]] = [
    ({"model": 3}, TypeError, "model must be a cdcr.Model, or a sequence of them, got int"),
    (
        {"model": [MODEL, None]},
        TypeError,
        r"model\[1\] \(motion 2\) must be a cdcr.Model, got None",
    ),
    ({"q0": np.zeros(3)}, ValueError, r"q0 must have shape \(2,\) or \(N, 2\), got \(3,\)"),
    (
        {"q0": np.full((N, 2), 9.0)},
        ValueError,
        r"q0\[0\] \(motion 1\) must bend each section by at",
    ),
    (
        {"tension": np.ones((3, 3))},
        ValueError,
        "as many motions of each, or one for all, got 5 of q0",
    ),
    (
        {"tension": -PULLS},
        ValueError,
        "tension of motion 1, step 1, cable 1 must be finite and >= 0",
    ),
    ({"tension": PULLS[:, :7]}, ValueError, "a row for each step, got"),
    (
        {"tension": np.zeros(4)},
        ValueError,
        r"tension must have shape \(3,\), \(N, 3\) or \(N, 20, 3\)",
    ),
    ({"tension": pull_back}, TypeError, "a function of the states of all motions is a controller"),
    ({"tension": PULLS, "controller": pull_back}, ValueError, "give one of tension, command and"),
    ({"controller": 3}, TypeError, "controller must be a cdcr.Pid, a list of them or a function"),
    ({"controller": "abc"}, TypeError, "a list of them or a function, got str"),
    ({"controller": []}, ValueError, "a list of them or a function, got no one"),
    (
        {"controller": [PID, None, PID, PID, PID]},
        TypeError,
        r"controller\[1\] \(motion 2\) must be a cdcr.Controller, got NoneType",
    ),
    (
        {"controller": Spring(0.1)},
        TypeError,
        "a controller written in Python cannot drive a rollout",
    ),
    ({"controller": lambda t, q, qd: q}, ValueError, r"must give commands of shape \(5, 3\)"),
    ({"control_every": 5}, ValueError, "control_every is for a function as controller"),
    ({"model": []}, TypeError, "or a sequence of them, got no one"),
    ({"command": np.ones((3, 3))}, ValueError, "5 of q0, 5 of qd0, 3 of command"),
    ({"steps": 2**40}, ValueError, "a whole number >= 0 and at most 2147483647, got 1099511627776"),
    (
        {"parameters": {"gravity.z": np.ones(N), "gravity.3": np.ones(N)}},
        ValueError,
        "parameters 'gravity.z' and 'gravity.3' lead to the same number: give one of them",
    ),
    ({"parameters": {3: np.ones(N)}}, TypeError, "parameters must be paths, such as 'sections.1"),
    (
        {"parameters": {"sections.1.num_disks": np.full(N, 3.5)}},
        ValueError,
        r"parameters\['sections.1.num_disks'\] must be whole numbers, got 3.5",
    ),
    ({"controller": pull_back, "control_every": 3}, ValueError, "control_every must divide the 20"),
    ({"parameters": {"payloads": np.ones(N)}}, ValueError, "Did you mean 'payload'?"),
    ({"parameters": "payload"}, TypeError, "parameters must be a mapping of paths to arrays, got"),
    ({"parameters": []}, TypeError, "parameters must be a mapping of paths to arrays, got list"),
    ({"wrenches": None}, ValueError, "wrenches must be a sequence of cdcr.Wrench, got None"),
    ({"parameters": {"payload": 1.0}}, ValueError, r"must have shape \(N,\), got \(\)"),
    ({"parameters": {"payload": -np.ones(N)}}, ValueError, "motion 1: payload must be"),
    ({"parameters": {"payload": np.ones(3)}}, ValueError, "5 of q0, 5 of qd0, 3 of parameters"),
    (
        {"parameters": {"payload": np.ones(N), "gravity.x": np.ones(2)}},
        ValueError,
        "parameters must have as many values of each, got 5 of payload, 2 of gravity.x",
    ),
    (
        {"model": [MODEL] * N, "parameters": {"payload": np.ones(N)}},
        ValueError,
        "parameters are those of one model, give either them or several models",
    ),
    ({"record_every": 3}, ValueError, "record_every must be a divisor of the 20 steps, got 3"),
    ({"step": 0.0}, ValueError, "step must be a number > 0 s, got 0.0"),
    ({"steps": -1}, ValueError, "steps must be a whole number >= 0, got -1"),
    ({"progress": 3}, TypeError, "progress must be a function of a number, got int"),
    (
        {"wrenches": (one for one in [cdcr.Wrench(section=0, profile=lambda t: t)])},
        ValueError,
        "the profile of a wrench on a rollout must be a table, got a function",
    ),
    (
        {"wrenches": cdcr.Wrench(section=0, profile=lambda t: t)},
        ValueError,
        "the profile of a wrench on a rollout must be a table, got a function",
    ),
]


@pytest.mark.parametrize(("given", "kind", "sentence"), REFUSED)
def test_bad_arguments_are_refused(
    given: dict[str, Any], kind: type[Exception], sentence: str
) -> None:
    arguments = {"model": MODEL, "q0": Q0, "qd0": QD0, **RUN} | given
    with pytest.raises(kind, match=sentence):
        cdcr.rollout(**arguments)


def test_models_are_those_of_motions_that_there_are() -> None:
    alike = cdcr.rollout(MODEL, Q0, QD0, **RUN)
    differ = cdcr.rollout(MODEL, Q0, QD0, parameters={"payload": [0.01]}, **RUN)
    for runs in (alike, differ):
        assert runs.model_of(-1).robot == runs.model_of(len(Q0) - 1).robot
        for motion in (len(Q0), -len(Q0) - 1):
            with pytest.raises(
                IndexError, match=f"there is no motion {motion}: there are {len(Q0)} m"
            ):
                runs.model_of(motion)
