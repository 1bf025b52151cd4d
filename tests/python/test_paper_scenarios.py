"""The paper's figures as scenarios: their numbers, beside closed forms where there are any."""

import math
from typing import Any

import numpy as np
import pytest

import cdcr
from scenario_runs import told

# To the digits in which the numbers are stated.
DIGITS = {0: 0.5, 1: 0.05, 2: 0.005, 3: 0.0005}
REL = 1e-12  # closed forms of a few operations
PATH_ERROR = 1e-6  # of a robot led by finely sampled tensions [rad]
FIGURES = {
    "factors-backbone": 2,
    "factors-backbone-rotation": 3,
    "factors-disks": 4,
    "factors-disks-rotation": 5,
    "kinetic-energy-terms": 6,
    "gravity-ratio": 7,
    "free-oscillation": 8,
    "step-tension": 9,
    "two-cables": 10,
    "block-diagram": 11,
    "circle-tracking": 12,
    "plane-tracking": 13,
    "pid": 14,
}
PICTURES = (*list(FIGURES)[:6], "block-diagram")  # in which nothing runs


def to_digits(value: float, digits: int) -> Any:
    return pytest.approx(value, abs=DIGITS[digits], rel=0.0)


def test_scenarios_come_in_the_order_of_the_papers_figures() -> None:
    names = cdcr.scenarios.names()
    assert list(names[: len(FIGURES)]) == list(FIGURES)
    assert all(cdcr.scenarios.get(name).paper_figure is None for name in names[len(FIGURES) :])
    for name, number in FIGURES.items():
        scenario = cdcr.scenarios.get(name)
        assert scenario.paper_figure == number
        assert f"Fig. {number}" in scenario.source


def test_where_nothing_runs() -> None:
    for name in FIGURES:
        scenario, run, _ = told(name)
        assert scenario.has_run == (name not in PICTURES)
        if run is not None:
            assert run.success
            assert run.t[-1] == scenario.t_end
    with pytest.raises(ValueError, match=r"^nothing runs in the scenario 'gravity-ratio': it is "):
        cdcr.scenarios.get("gravity-ratio").simulate()


def test_keys_of_findings_are_unique() -> None:
    for name in FIGURES:
        scenario = cdcr.scenarios.get(name)
        run = scenario.simulate(t_end=0.5) if scenario.has_run else None
        keys = [metric.key for metric in scenario.summary(run)]
        assert len(set(keys)) == len(keys)
        assert keys


@pytest.mark.parametrize(
    ("name", "factor", "error", "digits"),
    [
        ("factors-backbone", "H1_derived", 0.045, 3),
        ("factors-backbone", "H2_derived", -12.0, 0),
        ("factors-backbone-rotation", "H4_derived", -41.0, 0),
        ("factors-disks", "H6_derived", -14.0, 0),
        ("factors-disks-rotation", "H8_derived", -51.0, 0),
    ],
)
def test_errors_of_the_taylor_factors(name: str, factor: str, error: float, digits: int) -> None:
    assert told(name)[2][f"{factor}_error"] == to_digits(error, digits)


def test_printed_factors_are_told_where_they_differ() -> None:
    disks = told("factors-disks")[2]
    assert disks["H5_derived_0"] == pytest.approx(0.633325, rel=REL)
    assert disks["H5_printed_0"] == pytest.approx(disks["H5_derived_0"] / 2, rel=REL)
    assert disks["H6_printed_end"] == pytest.approx(disks["H6_derived_end"] / 2, rel=REL)
    backbone, rotation = told("factors-backbone-rotation")[2], told("factors-disks-rotation")[2]
    assert backbone["H3_derived_end"] == pytest.approx(1 / 3, rel=REL)
    assert rotation["H7_derived_end"] == pytest.approx(77 / 20, rel=REL)
    assert backbone["H3_printed_end"] > 1.5 * backbone["H3_derived_end"]
    assert rotation["H7_printed_end"] > 1.5 * rotation["H7_derived_end"]
    assert not any("printed" in key for key in told("factors-backbone")[2])
    assert "H4_printed_0" not in backbone
    assert "H8_printed_0" not in rotation


def test_errors_of_the_inertias() -> None:
    found = told("kinetic-energy-terms")[2]
    assert found["M11_derived_error"] == to_digits(0.056, 3)
    assert found["M11_printed_error"] == to_digits(0.056, 3)
    assert found["M22_derived_error"] == to_digits(-13.8, 1)
    assert found["M22_printed_error"] == to_digits(-12.6, 1)


def test_eq_21_as_printed_would_make_the_straight_robot_differ_by_direction() -> None:
    from cdcr.paper.claims.printed import printed_inertia

    theta = 1e-4
    M11, M22 = printed_inertia(np.array([theta]), cdcr.robots.amouri2020())
    assert M11[0] == pytest.approx(4.8186e-3, abs=5e-8)
    assert M22[0] / theta**2 == pytest.approx(5.8670e-3, abs=5e-8)


def test_gravity() -> None:
    found = told("gravity-ratio")[2]
    assert found["ratio_0"] == to_digits(23.8, 1)
    assert found["ratio_end"] == to_digits(21.0, 1)
    assert found["theta_no_gravity_deg"] == to_digits(14.978, 3)
    assert found["theta_upright_linear_deg"] == to_digits(19.7, 1)
    assert found["theta_hanging_linear_deg"] == to_digits(12.1, 1)
    # What is linearised is not far off at such angles, and gravity weakens with bending.
    assert 19.5 < found["theta_upright_deg"] < found["theta_upright_linear_deg"]
    assert found["theta_hanging_linear_deg"] < found["theta_hanging_deg"] < 12.2


def test_gravity_ratio_is_continuous_at_the_straight_robot() -> None:
    from cdcr.scenarios.studies.gravity_ratio import energy_ratio, stiffness

    start = 1.0 - stiffness("upright") / stiffness("no gravity")
    near = energy_ratio(1e-3, "upright")[0]
    assert -near == pytest.approx(start, rel=1e-6)
    assert energy_ratio(1.0, "hanging") == pytest.approx(-energy_ratio(1.0, "upright"), rel=1e-9)
    section, g = cdcr.robots.amouri2020().sections[0], 9.81
    # Weight of elements at x, which sink by l x^3 theta^2 / 6, over K theta^2 / 2.
    cubes = section.backbone_mass / 4 + section.disk_mass * sum((k / 10) ** 3 for k in range(1, 11))
    assert start == pytest.approx(cubes * g * section.length / 3 / section.stiffness, rel=1e-9)


def test_free_oscillation() -> None:
    from cdcr.scenarios.studies.free_oscillation import LOOSE

    _, run, found = told("free-oscillation")
    assert found["amplitude_start_deg"] == pytest.approx(45.0, rel=REL)
    assert found["amplitude_end_deg"] == pytest.approx(45.0, rel=1e-7)
    assert found["settling_linear_s"] == to_digits(37.68, 2)
    assert found["settling_s"] == pytest.approx(37.68, abs=0.35)  # half a swing
    assert np.all(run.phi == 0.0)
    # No integrator, however loose, settles as the paper's robot does.
    loose = [value for key, value in found.items() if key.startswith("end_")]
    assert len(loose) == len(LOOSE)
    assert min(loose) > 30.0
    assert max(abs(value - 45.0) for value in loose) > 0.5


def test_step_tension_settles_nowhere_but_swings_about_14_978() -> None:
    assert told("step-tension")[2]["theta_static_deg"] == to_digits(14.978, 3)


def test_two_cables() -> None:
    from cdcr.scenarios.studies.two_cables import settled

    scenario, run, found = told("two-cables")
    assert "ours" in scenario.source
    for name, phi in (("cable_1", 0.0), ("cables_1_and_2", 60.0), ("cable_2", 120.0)):
        assert found[f"{name}_theta_deg"] == to_digits(14.978, 3)
        assert found[f"{name}_phi_deg"] == pytest.approx(phi, abs=1e-9)
        theta, length = math.radians(found[f"{name}_theta_deg"]), 0.802
        reach = length * (1.0 - math.cos(theta)) / theta
        assert found[f"{name}_x_m"] == pytest.approx(reach * math.cos(math.radians(phi)), abs=1e-12)
        assert found[f"{name}_z_m"] == pytest.approx(length * math.sin(theta) / theta, rel=REL)
    # Moving and settled agree until the first pull, and differ after.
    distance = np.linalg.norm(run.q - settled(run), axis=1)
    assert np.all(distance[run.t <= 1.0] == 0.0)
    assert distance.max() > math.radians(3.0)
    assert np.all(run.tension[:, 2] == 0.0)


def test_circle_tracking() -> None:
    _, run, found = told("circle-tracking")
    for cable in (1, 2, 3):
        assert found[f"tension_{cable}_max"] == to_digits(5.754, 3)
    assert found["tension_1_start"] == to_digits(4.984, 3)
    assert found["tension_2_start"] == pytest.approx(0.0, abs=1e-12)
    assert np.all(run.tension >= 0.0)
    assert found["error_deg"] < 0.05
    assert found["error_fine_rad"] < PATH_ERROR
    np.testing.assert_allclose(np.rad2deg(run.theta), 15.0, atol=0.05)


def test_plane_tracking() -> None:
    _, run, found = told("plane-tracking")
    assert found["tension_1_end"] == to_digits(41.6, 1)
    assert found["tension_2_end"] == to_digits(20.8, 1)
    assert found["tension_3_peak"] == pytest.approx(0.0, abs=1e-12)
    assert found["error_fine_rad"] < PATH_ERROR
    assert run.theta[-1, 0] == pytest.approx(cdcr.taylor_range, abs=1e-6)
    np.testing.assert_allclose(np.rad2deg(run.phi[1:]), 30.0, atol=1e-3)


@pytest.mark.parametrize("name", ["circle-tracking", "plane-tracking"])
def test_rates_of_a_path_are_its_derivatives(name: str) -> None:
    scenario = cdcr.scenarios.get(name)
    path: Any = scenario.input_source
    h = 1e-4
    t = np.array([0.7 - h, 0.7, 0.7 + h])
    motion = path.reference(t)
    rate = (motion.q[2] - motion.q[0]) / (2 * h)
    acceleration = (motion.qd[2] - motion.qd[0]) / (2 * h)
    np.testing.assert_allclose(motion.qd[1], rate, atol=1e-7)
    np.testing.assert_allclose(motion.qdd[1], acceleration, atol=1e-7)
    first = path.reference(np.array([0.0, 1.0]))
    np.testing.assert_array_equal(scenario.q0, first.q[0])
    np.testing.assert_array_equal(scenario.qd0, first.qd[0])


def test_pid_readings() -> None:
    _, _, found = told("pid")
    assert 2.0 <= found["radians_plain_unlimited_end_deg"] <= 2.1
    assert found["degrees_plain_unlimited_end_deg"] == to_digits(13.9, 1)
    assert found["degrees_plain_unlimited_min_N"] == to_digits(-1.3, 1)
    assert found["moment_plain_unlimited_end_deg"] == to_digits(13.8, 1)
    for reading in ("radians", "degrees", "moment"):
        assert found[f"{reading}_forward_unlimited_end_deg"] == to_digits(15.53, 2)
    assert found["degrees_forward_unlimited_settling_s"] == to_digits(0.44, 2)
    assert found["radians_forward_unlimited_settling_s"] == to_digits(4.6, 1)
    assert found["radians_forward_unlimited_peak_deg"] == to_digits(27.4, 1)
    # Without a settling time: what never comes within 2 %.
    assert "radians_plain_settling_s" not in found
    assert "degrees_plain_settling_s" not in found


def test_the_recommended_loop_never_pushes_and_is_the_run() -> None:
    _, run, found = told("pid")
    assert found["degrees_forward_min_N"] >= 0.0
    assert found["degrees_forward_end_deg"] == to_digits(15.53, 2)
    assert found["degrees_forward_settling_s"] < 0.5
    assert np.all(run.tension >= 0.0)
    assert np.all(run.tension[:, 1:] == 0.0)
    assert np.rad2deg(run.theta[-1, 0]) == pytest.approx(found["degrees_forward_end_deg"], abs=1e-6)


@pytest.mark.parametrize("name", FIGURES)
def test_every_scenario_draws_labelled_axes(name: str) -> None:
    pytest.importorskip("matplotlib")
    scenario, run, _ = told(name)
    figure: Any = scenario.figure(run)
    assert figure.get_suptitle() == scenario.title
    shown = [axes for axes in figure.axes if axes.axison]
    assert bool(shown) == (name != "block-diagram")
    for axes in shown:
        shared = axes.get_shared_y_axes().get_siblings(axes)
        below = [other for other in figure.axes if other.get_subplotspec() is not None]
        labels = [other.get_ylabel() for other in shared]
        assert any(label.endswith("]") for label in labels), labels
        if axes.name == "3d":
            assert (axes.get_xlabel(), axes.get_zlabel()) == ("x [m]", "z [m]")
        else:
            column = [o for o in below if o.get_position().x0 == axes.get_position().x0]
            assert any(o.get_xlabel().endswith("]") for o in column or [axes])


@pytest.mark.parametrize("name", [name for name in FIGURES if name not in PICTURES])
def test_every_run_may_be_shorter_and_still_be_told_and_drawn(name: str) -> None:
    pytest.importorskip("matplotlib")
    scenario = cdcr.scenarios.get(name)
    run = scenario.simulate(t_end=0.4)
    assert run.success
    assert scenario.summary(run)
    assert scenario.figure(run).axes
