"""Pictures of what cannot be drawn are refused in a sentence."""

import re
from typing import Any

import pytest
from matplotlib.figure import Figure

import cdcr


@pytest.fixture(scope="module")
def run() -> cdcr.Trajectory:
    model = cdcr.Model(cdcr.robots.amouri2020())
    return cdcr.simulate(model, [0.1, 0.0], [0.0, 0.0], t=[0.0, 0.1])


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"num": 0}, "num must be a whole number 1 to 100, got 0 (int)"),
        ({"num": 10**9}, "num must be a whole number 1 to 100, got 1000000000 (int)"),
        ({"num": 2.5}, "num must be a whole number 1 to 100, got 2.5 (float)"),
        ({"times": []}, "times must have shape (M,) with M 1 to 100, got (0,)"),
        ({"times": [[0.0]]}, "times must have shape (M,) with M 1 to 100, got (1, 1)"),
        (
            {"ax": Figure().add_subplot()},
            "ax must be an Axes3D, as projection='3d' makes one, got Axes",
        ),
    ],
)
def test_wrong_arguments_of_pictures(
    arguments: dict[str, Any], sentence: str, run: cdcr.Trajectory
) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}$"):
        run.plot_robot(**arguments)


@pytest.mark.parametrize("alpha", [None, -0.1, 1.5, "x", 10**400])
def test_wrong_opacities(alpha: Any, run: cdcr.Trajectory) -> None:
    with pytest.raises(ValueError, match=r"^alpha must be a number 0 to 1, got "):
        cdcr.plotting.plot_robot(run.model, [0.1, 0.0], alpha=alpha)


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda run: cdcr.plotting.plot_run(run.model), "run must be a cdcr.Trajectory, got Model"),
        (
            lambda run: cdcr.plotting.plot_run_robot(run.t),
            "run must be a cdcr.Trajectory, got ndarray",
        ),
        (lambda run: cdcr.plotting.plot_robot(run, [0.0, 0.0]), "model must be a cdcr.Model, got "),
        (
            lambda run: cdcr.plotting.animate(run.model, "a.gif"),
            "run must be a cdcr.Trajectory, got ",
        ),
        (lambda run: cdcr.plotting.plot_modes(run.model), "modes must be a cdcr.Modes, got Model"),
        (lambda run: cdcr.plotting.plot_identified(run), "fit must be a mapping with channels, "),
        (lambda run: cdcr.plotting.plot_identified({}), "fit must be a mapping with channels, "),
    ],
)
def test_pictures_of_something_else(call: Any, sentence: str, run: cdcr.Trajectory) -> None:
    with pytest.raises(TypeError, match=f"^{re.escape(sentence)}"):
        call(run)
