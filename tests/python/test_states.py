"""Functions of one state take arrays of states, and give what each state alone gives."""

import math
import re
from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import cdcr

# What each takes of a state, and its core shape with d coordinates, m cables and n sections.
FUNCTIONS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "mass_matrix": (("q",), ("dd",)),
    "bias": (("q", "qd"), ("d",)),
    "forward_dynamics": (("q", "qd", "tension"), ("d",)),
    "inverse_dynamics": (("q", "qd", "qdd"), ("d",)),
    "base_wrench": (("q", "qd", "qdd"), ("6",)),
    "linearize": (("q", "qd", "tension"), ("ss", "sm")),
    "derivatives": (("q", "qd", "tension"), ("dd", "dd", "dm", "d16")),
    "kinetic_energy": (("q", "qd"), ("",)),
    "potential_energy": (("q",), ("",)),
    "potential_gradient": (("q",), ("d",)),
    "potential_hessian": (("q",), ("dd",)),
    "tip": (("q",), ("33", "3")),
    "tips": (("q",), ("3",)),
    "cable_lengths": (("q",), ("m",)),
    "cable_tensions": (("q", "qd", "tension"), ("m",)),
    "tensions_along": (("q", "qd", "tension"), ("nm",)),
    "cable_force": (("q", "qd", "tension"), ("d",)),
    "friction_power": (("q", "qd", "tension"), ("",)),
    "cable_energy": (("q", "tension"), ("",)),
    "static_stiffness": (("q", "tension"), ("dd",)),
    "commands": (("q", "tension"), ("m",)),
    "modes": (("q", "tension"), ("d", "d", "d", "dd", "d", "s")),
    "pose": (("q",), ("33", "3")),
    "jacobian": (("q",), ("6d",)),
    "tip_jacobian": (("q",), ("6d",)),
    "kinematic_hessian": (("q",), ("6dd",)),
    "tip_hessian": (("q",), ("6dd",)),
    "wrench_force": (("q",), ("d",)),
}
# Those that work on several states of arcs at once, to rounding: over the largest entry, ten times
# what is seen.
LANES = (
    *("mass_matrix", "bias", "forward_dynamics", "inverse_dynamics", "kinetic_energy"),
    *("potential_energy", "potential_gradient", "tip", "tips", "pose", "jacobian", "tip_jacobian"),
    "cable_lengths",
)
ROUNDING = 1e-12
MORE: dict[str, Any] = {
    "derivatives": (cdcr.Wrench(section=0, force=(0.1, 0.2, 0.0), frame="local"),),
    "pose": (0, 0.3),
    "jacobian": (0, 0.3),
    "kinematic_hessian": (0, 0.3),
    "wrench_force": (cdcr.Wrench(section=0, force=(0.1, 0.2, 0.0)),),
}


def one_section() -> cdcr.Robot:
    robot = cdcr.robots.amouri2020(gravity=(1.0, 2.0, -9.81), damping=1e-3)
    section = replace(robot.sections[0], cable_friction=0.2)
    return replace(robot, sections=(section,))


def three_sections() -> cdcr.Robot:
    spring = cdcr.Cable(radius=0.01, angle=0.3, end_section=1, stiffness=2e3, damping=1.0)
    return replace(cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81)), cables=(spring,))


@pytest.fixture(scope="module", params=[one_section, three_sections])
def model(request: pytest.FixtureRequest) -> cdcr.Model:
    return cdcr.Model(request.param())


def states(model: cdcr.Model, **leading: tuple[int, ...]) -> dict[str, NDArray[np.float64]]:
    """Arrays of states with these leading dimensions."""
    random = np.random.default_rng(3)
    sizes = dict.fromkeys(("q", "qd", "qdd"), model.num_coordinates) | {"tension": model.num_cables}
    return {
        name: random.uniform(0.0 if name == "tension" else -1.5, 1.5, (*before, sizes[name]))
        for name, before in leading.items()
    }


def answers(model: cdcr.Model, name: str, arguments: list[Any]) -> tuple[Any, ...]:
    found = getattr(model, name)(*arguments, *MORE.get(name, ()))
    if isinstance(found, cdcr.Modes):
        return tuple(getattr(found, item.name) for item in fields(found)[1:-1])
    return found if isinstance(found, tuple) else (found,)


def core_shape(model: cdcr.Model, letters: str) -> tuple[int, ...]:
    d, n, m = model.num_coordinates, model.num_sections, model.num_cables
    return tuple(
        {"d": d, "n": n + 1, "m": m, "s": 2 * d, "1": 1, "3": 3, "6": 6}[c] for c in letters
    )


@pytest.mark.parametrize("name", FUNCTIONS)
@pytest.mark.parametrize(
    "leading",
    [
        {"q": (4,), "qd": (4,), "qdd": (4,), "tension": (4,)},
        {"q": (4, 1), "qd": (3,), "qdd": (1, 3), "tension": ()},
        {"q": (), "qd": (2, 1, 3), "qdd": (4, 1), "tension": (4, 3)},
        {"q": (1,), "qd": (1,), "qdd": (1,), "tension": (1,)},
        {"q": (0,), "qd": (), "qdd": (1,), "tension": (0,)},
        {"q": (2, 0), "qd": (1, 1), "qdd": (0,), "tension": (2, 1)},
    ],
)
def test_an_array_of_states_gives_what_each_gives_alone(
    model: cdcr.Model, name: str, leading: dict[str, tuple[int, ...]]
) -> None:
    takes, gives = FUNCTIONS[name]
    arrays = list(states(model, **{key: leading[key] for key in takes}).values())
    together = np.broadcast_shapes(*(array.shape[:-1] for array in arrays))
    full = [np.broadcast_to(array, (*together, array.shape[-1])) for array in arrays]
    found = answers(model, name, arrays)
    for one, letters in zip(found, gives, strict=True):
        assert np.shape(one) == (*together, *core_shape(model, letters))
    for index in np.ndindex(*together):
        alone = answers(model, name, [array[index] for array in full])
        for one, expected in zip(found, alone, strict=True):
            error = ROUNDING * np.max(np.abs(expected), initial=0.0) if name in LANES else 0.0
            np.testing.assert_allclose(np.asarray(one)[index], expected, rtol=0.0, atol=error)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_one_state_has_no_leading_dimension(model: cdcr.Model, name: str) -> None:
    takes, gives = FUNCTIONS[name]
    found = answers(model, name, list(states(model, **dict.fromkeys(takes, ())).values()))
    for one, letters in zip(found, gives, strict=True):
        assert type(one) is (np.ndarray if letters else float)
        assert np.shape(one) == core_shape(model, letters)


def with_tool() -> cdcr.Robot:
    tool = (
        (0.0, -1.0, 0.0, 0.01), (1.0, 0.0, 0.0, 0.02), (0.0, 0.0, 1.0, 0.03), (0.0, 0.0, 0.0, 1.0)
    )  # fmt: skip
    robot = cdcr.robots.three_sections(gravity=(1.0, 2.0, -9.81), payload=0.02)
    return replace(robot, tool=tool, base_position=(0.1, 0.2, 0.3))


def rod() -> cdcr.Robot:
    robot = cdcr.robots.amouri2020(gravity=(0.0, 0.0, -9.81))
    return replace(robot, sections=(replace(robot.sections[0], bending_order=1),))


@pytest.mark.parametrize("name", LANES)
@pytest.mark.parametrize(
    "robot", [cdcr.robots.amouri2020(), cdcr.robots.three_sections(), with_tool(), rod()]
)
def test_many_states_in_lanes_are_single_states_to_rounding(robot: cdcr.Robot, name: str) -> None:
    """As many as leave a rest; straight and much bent side by side; some arguments for all."""
    plain = cdcr.Model(robot)
    takes = FUNCTIONS[name][0]
    arrays = list(states(plain, **dict.fromkeys(takes, (11,))).values())
    arrays[0][::3] *= 1e-3
    arrays[-1 if len(arrays) > 1 else 0][1] *= 2.0
    for given in (arrays, [arrays[0], *(array[0] for array in arrays[1:])]):
        found = answers(plain, name, given)
        for i in range(11):
            rows = [array[i] if array.ndim == 2 else array for array in given]
            for one, expected in zip(found, answers(plain, name, rows), strict=True):
                error = ROUNDING * np.max(np.abs(expected))
                np.testing.assert_allclose(one[i], expected, rtol=0.0, atol=error)
    for one in answers(plain, name, [array[:0] for array in arrays]):
        assert len(one) == 0


@pytest.mark.parametrize("name", LANES)
def test_a_state_has_the_same_bits_next_to_any_other(name: str) -> None:
    """And wherever it stands among them."""
    plain = cdcr.Model(cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81)))
    arrays = list(states(plain, **dict.fromkeys(FUNCTIONS[name][0], (9,))).values())
    forth = answers(plain, name, arrays)
    back = answers(plain, name, [array[::-1] for array in arrays])
    for one, other in zip(forth, back, strict=True):
        np.testing.assert_array_equal(one, other[::-1])


@pytest.mark.parametrize("robot", [cdcr.robots.three_sections(), with_tool(), rod()])
def test_hessians_are_derivatives_of_jacobians(robot: cdcr.Robot) -> None:
    """By differences of fourth order; those of positions are symmetric."""
    plain = cdcr.Model(robot)
    q = states(plain, q=())["q"]
    d, last = plain.num_coordinates, plain.num_sections - 1
    h = 1e-3 * np.eye(d)

    def difference(function: Any) -> Any:
        near, far = (function(q + k * h) - function(q - k * h) for k in (1, 2))
        return np.moveaxis((8 * near - far) / 12e-3, 0, -1)

    for found, wanted in (
        (plain.tip_hessian(q), difference(plain.tip_jacobian)),
        (
            plain.kinematic_hessian(q, last, 0.4),
            difference(lambda q: plain.jacobian(q, last, 0.4)),
        ),
    ):
        np.testing.assert_allclose(found, wanted, rtol=0.0, atol=1e-9 * np.abs(wanted).max())
        position = found[:3]
        error = 1e-13 * np.abs(position).max()
        np.testing.assert_allclose(position, position.swapaxes(1, 2), rtol=0.0, atol=error)


def test_any_layout_of_an_array_will_do(model: cdcr.Model) -> None:
    q = states(model, q=(6, 4))["q"]
    for view in (q[::2], q[:, ::-1], q.transpose(1, 0, 2), np.asfortranarray(q), q.tolist()):
        np.testing.assert_array_equal(
            model.potential_gradient(view), model.potential_gradient(np.array(view))
        )
    every = np.broadcast_to(q[0], q.shape)
    np.testing.assert_allclose(model.tips(every)[3], model.tips(q[0]), rtol=0.0, atol=ROUNDING)


def test_old_names_are_the_same_functions() -> None:
    assert cdcr.Model.kinetic_energies is cdcr.Model.kinetic_energy
    assert cdcr.Model.potential_energies is cdcr.Model.potential_energy


def test_the_gradient_is_that_of_the_energy(model: cdcr.Model) -> None:
    q = states(model, q=(5,))["q"]
    step = 1e-6 * np.eye(model.num_coordinates)
    slope = (
        model.potential_energy(q[:, None] + step) - model.potential_energy(q[:, None] - step)
    ) / 2e-6
    np.testing.assert_allclose(model.potential_gradient(q), slope, rtol=1e-7, atol=1e-8)
    turned = (
        model.potential_gradient(q[:, None] + step) - model.potential_gradient(q[:, None] - step)
    ) / 2e-6
    np.testing.assert_allclose(model.potential_hessian(q), turned, rtol=1e-7, atol=1e-8)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (
            ([[0.0, 0.0]] * 2, [[0.0, 0.0]] * 3),
            "qd must have shape (..., 2) with leading dimensions that broadcast with (2,), "
            "got (3, 2)",
        ),
        (
            (np.zeros((4, 1, 2)), np.zeros((3, 5, 2))),
            "qd must have shape (..., 2) with leading dimensions that broadcast with (4, 1), "
            "got (3, 5, 2)",
        ),
        (
            (np.zeros((4, 3)), np.zeros((4, 2))),
            "q must have shape (..., 2), got (4, 3)",
        ),
        (
            ([[0.0, 0.0], [math.inf, 0.0]], [0.0, 0.0]),
            "q[1, 0] (section 1) must be finite, got inf",
        ),
        (
            ([[0.0, 0.0], [6.0, 8.0]], [0.0, 0.0]),
            "q[1] must bend each section by at most 3 pi rad, got 10 rad in section 1",
        ),
        (([0.0, 0.0], [[0.0], [1.0, 2.0]]), "qd must be numbers of shape (..., 2), got list"),
    ],
)
def test_arrays_that_are_no_states_are_refused(arguments: tuple[Any, Any], sentence: str) -> None:
    model = cdcr.Model(one_section())
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}$"):
        model.kinetic_energy(*arguments)


def test_a_cable_that_pushes_is_named_with_its_state() -> None:
    model = cdcr.Model(one_section())
    sentence = "tension[1, 2] (cable 3) must be >= 0 N (a cable cannot push), got -1"
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}$"):
        model.cable_energy([0.0, 0.0], [[0.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
