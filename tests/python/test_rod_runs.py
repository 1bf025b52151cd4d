"""A run of a rod: its angles, columns and files, the tensions of a motion, its signals."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import cdcr
from cdcr.model.rest import at_rest
from cdcr.model.signals import find_outputs
from cdcr.scenarios.file.reader import load_scenario

# Least squares of numbers near 1 on a force of some N m.
ALLOCATED = 1e-9

HELIX = cdcr.Cable(radius=0.015, angle=[(0.0, 1.5)], end_section=0)
ROBOT = cdcr.robots.amouri2020(damping=0.02)
ROD = replace(ROBOT.sections[0], bending_order=1, stretch_order=0, stretch_damping=30.0, nodes=6)
MODEL = cdcr.Model(replace(ROBOT, sections=(ROD,), cables=(HELIX,)))
Q0 = np.array([0.3, 0.1, 0.05, -0.02, 1e-4])


@pytest.fixture(scope="module")
def run() -> cdcr.Trajectory:
    return cdcr.simulate(
        MODEL, Q0, np.zeros(5), t=[0.0, 1e-3, 2e-3], tension=[2.0, 0.0, 0.0, 1.0], method="dopri5"
    )


def test_columns_have_the_names_of_the_coordinates(run: cdcr.Trajectory, tmp_path: Path) -> None:
    run.save(tmp_path / "run.csv")
    header = (tmp_path / "run.csv").read_text().split("\n")[0].split(",")
    assert header[1:6] == ["q1_x [rad]", "q1_y [rad]", "q1_x_1 [rad]", "q1_y_1 [rad]", "e1 [m]"]
    assert header[10] == "ed1 [m/s]"
    again = cdcr.Trajectory.load(tmp_path / "run.csv", model=MODEL)
    assert np.array_equal(again.q, run.q)
    assert np.array_equal(again.qd, run.qd)
    assert run.theta.shape == (3, 1)
    assert run.theta[0, 0] == pytest.approx(np.hypot(0.3, 0.1))


def test_a_dataset_labels_the_coordinates(run: cdcr.Trajectory, tmp_path: Path) -> None:
    pytest.importorskip("xarray", reason="needs the extra data")
    data = run.to_xarray()
    assert data.q.dims == ("time", "coordinate")
    assert tuple(data.coordinate.values) == MODEL.coordinate_names
    assert data.qd.units == "rad/s or m/s"
    run.save(tmp_path / "run.nc")
    again = cdcr.Trajectory.load(tmp_path / "run.nc")
    assert again.model.robot == MODEL.robot
    assert np.array_equal(again.q, run.q)


def test_tensions_of_a_motion_are_those_where_it_is() -> None:
    q = Q0 * np.array([1.0, 1.0, 0.0, 0.0, 0.0])
    tension = [3.0, 1.0, 0.5, 2.0]
    force = MODEL.actuation_matrix(q) @ tension
    found = MODEL.find_tension(force, q=q)
    assert np.abs(MODEL.actuation_matrix(q) @ found.tension - force).max() <= ALLOCATED
    assert np.array_equal(MODEL.allocate(force, q=q), found.tension)
    with pytest.raises(ValueError, match="q must be given: the actuation matrix"):
        MODEL.allocate(force)
    still = cdcr.Reference.from_angles([0.0, 1.0], 0.2, 0.0)
    needed = cdcr.inverse_run(MODEL, still.on(MODEL), infeasible="nearest")
    given = MODEL.actuation_matrix(needed.q[0]) @ needed.tension[0]
    assert needed.force_error[0] == pytest.approx(np.linalg.norm(given - needed.force[0]))
    with pytest.raises(ValueError, match=r"reference.q must have shape \(2, 5\)"):
        cdcr.inverse_run(MODEL, still)


def test_signals_are_named_and_differentiated() -> None:
    (lengths, rates) = find_outputs(["lengths", "qd"])
    assert rates.names(MODEL) == ["qd1_x", "qd1_y", "qd1_x_1", "qd1_y_1", "ed1"]
    step = 1e-6
    ends = [MODEL.cable_lengths(Q0 + step * one) for one in np.vstack([np.eye(5), -np.eye(5)])]
    slopes = (np.array(ends[:5]) - np.array(ends[5:])).T / (2.0 * step)
    assert np.abs(lengths.derivative(MODEL, Q0)[:, :5] - slopes).max() <= 1e-8


def test_rest_tells_of_bending_and_twist() -> None:
    twisted = replace(ROD, twist_order=0, shear_modulus=3e9, rest_twist=0.5)
    rest = at_rest(replace(ROBOT, sections=(twisted,)))
    assert rest.words == "straight, twisted by 28.65 deg"
    assert rest.stable
    assert rest.is_nondegenerate


def test_what_no_cable_can_hold_is_told_in_one_line(tmp_path: Path) -> None:
    cable = cdcr.robots.amouri2020().sections[0].cable_angles
    rod = replace(ROD, bending_order=3, stretch_order=None, cable_angles=cable)
    model = cdcr.Model(replace(ROBOT, sections=(rod,), gravity=(0.0, 0.0, -9.81)))
    bent = cdcr.Reference.from_angles([0.0, 1.0], 0.2, 0.0).on(model)
    with pytest.raises(cdcr.InfeasibleError) as caught:
        model.allocate(np.arange(8.0) / 3.0)
    assert "; the nearest force is [" in str(caught.value)
    with pytest.raises(ValueError, match="no cable pulls that way, the nearest force") as asked:
        cdcr.inverse_run(model, bent)
    assert "\n" not in f"{caught.value}{asked.value}"
    model.robot.save(tmp_path / "rod.toml")
    file = tmp_path / "move.toml"
    file.write_text(
        'robot = "rod.toml"\nt_end = 1.0\n[trajectory]\nshape = "circle"\ntheta = 0.2\n'
        "turns_per_second = 0.1\n"
    )
    with pytest.raises(ValueError, match=r"\(no cable pulls that way\), nor at 1000 more of 1001"):
        load_scenario(file).simulate()
