"""The result of a run: its arrays, what is derived from them, how it introduces itself."""

import dataclasses

import numpy as np
import pytest

import cdcr

# Rounding of sums and products of a few numbers near 1.
ROUNDING = 1e-14
# Dormand-Prince at rtol 1e-12 over 20 s keeps the energy to 1e-10 of its size.
DRIFT = 1e-9


@pytest.fixture(scope="module")
def free_run() -> cdcr.Trajectory:
    """Undamped, no tension, from 45 degrees with a sideways push."""
    model = cdcr.Model(cdcr.robots.amouri2020())
    t = np.linspace(0.0, 20.0, 401)
    return cdcr.simulate(
        model, [np.pi / 4, 0.0], [0.0, 2.0], t=t, method="dopri5", rtol=1e-12, atol=1e-14
    )


def test_arrays_are_read_only(free_run: cdcr.Trajectory) -> None:
    names = ["t", "q", "qd", "tension", "theta", "phi", "tip"]
    names += ["kinetic_energy", "potential_energy", "energy", "energy_error"]
    for name in names:
        with pytest.raises(ValueError, match="read-only"):
            getattr(free_run, name)[...] = 0.0


def test_fields_cannot_be_replaced(free_run: cdcr.Trajectory) -> None:
    with pytest.raises(dataclasses.FrozenInstanceError):
        free_run.t = np.zeros(3)  # type: ignore[misc]


def test_arrays_are_copies(free_run: cdcr.Trajectory) -> None:
    t = free_run.t.copy()
    run = dataclasses.replace(free_run, t=t)
    t[0] = 7.0
    assert run.t[0] == 0.0


def test_derived_arrays_are_computed_once(free_run: cdcr.Trajectory) -> None:
    for name in ("theta", "phi", "tip", "kinetic_energy", "potential_energy", "energy"):
        assert getattr(free_run, name) is getattr(free_run, name)


def test_shapes(free_run: cdcr.Trajectory) -> None:
    n = len(free_run)
    assert n == 401
    shapes = {"t": (n,), "q": (n, 2), "qd": (n, 2), "tension": (n, 3), "theta": (n, 1)}
    shapes |= {"phi": (n, 1), "tip": (n, 3), "energy": (n,), "energy_error": (n,)}
    for name, shape in shapes.items():
        array = getattr(free_run, name)
        assert array.shape == shape, name
        assert array.dtype == np.float64, name


def test_angles_are_q_and_continuous(free_run: cdcr.Trajectory) -> None:
    x = free_run.theta * np.cos(free_run.phi)
    y = free_run.theta * np.sin(free_run.phi)
    np.testing.assert_allclose(np.hstack([x, y]), free_run.q, rtol=0.0, atol=10 * ROUNDING)
    assert np.ptp(free_run.phi) > 2 * np.pi  # several turns, not folded into one
    assert np.max(np.abs(np.diff(free_run.phi, axis=0))) < np.pi


def test_tip_and_energies_are_the_models(free_run: cdcr.Trajectory) -> None:
    model = free_run.model
    for i in (0, 133, 400):
        q, qd = free_run.q[i], free_run.qd[i]
        np.testing.assert_allclose(free_run.tip[i], model.tip(q)[1], rtol=ROUNDING, atol=ROUNDING)
        assert free_run.kinetic_energy[i] == pytest.approx(
            model.kinetic_energy(q, qd), rel=ROUNDING
        )
        assert free_run.potential_energy[i] == pytest.approx(
            model.potential_energy(q), rel=ROUNDING
        )
    np.testing.assert_array_equal(
        free_run.energy, free_run.kinetic_energy + free_run.potential_energy
    )


def test_energy_drift_is_as_documented(free_run: cdcr.Trajectory) -> None:
    change = np.abs(free_run.energy - free_run.energy[0])
    scale = max(abs(free_run.energy[0]), free_run.kinetic_energy.max())
    assert free_run.energy_drift == change.max() / scale
    assert 0.0 < free_run.energy_drift < DRIFT


def test_energy_drift_sees_damping() -> None:
    model = cdcr.Model(cdcr.robots.amouri2020(damping=9.12e-4))
    run = cdcr.simulate(model, [0.5, 0.0], [0.0, 0.0], t=np.linspace(0.0, 60.0, 11))
    assert run.energy_drift == pytest.approx(1.0, abs=0.01)  # all of it is gone


def test_energy_drift_at_rest_is_zero() -> None:
    model = cdcr.Model(cdcr.robots.amouri2020())
    run = cdcr.simulate(model, [0.0, 0.0], [0.0, 0.0], t=[0.0, 1.0])
    assert run.energy_drift == 0.0


def test_repr_says_what_matters(free_run: cdcr.Trajectory) -> None:
    text = repr(dataclasses.replace(free_run, method="dopri5"))
    assert text == (
        "<Trajectory: 401 samples, t = 0 to 20 s, 1 section, 3 cables, dopri5, status ok>"
    )


def test_a_failed_run_keeps_its_samples_and_tells_why(free_run: cdcr.Trajectory) -> None:
    run = cdcr.simulate(
        free_run.model, [0.5, 0.0], [0.0, 0.0], t=np.linspace(0.0, 10.0, 101), max_steps=50
    )
    assert not run.success
    assert run.status is cdcr.Status.step_limit
    assert 0 < len(run) < 101
    assert len(run.energy) == len(run.tip) == len(run)
    assert f"status step_limit: {run.message}" in repr(run)


def test_arrays_that_do_not_fit_are_refused(free_run: cdcr.Trajectory) -> None:
    with pytest.raises(ValueError, match=r"^qd must have shape \(401, 2\), got \(400, 2\)$"):
        dataclasses.replace(free_run, qd=free_run.qd[:-1])
    with pytest.raises(ValueError, match=r"^tension must have shape \(401, 3\), got \(401, 2\)$"):
        dataclasses.replace(free_run, tension=free_run.tension[:, :2])
    names = ("t", "q", "qd", "tension", "command")
    nothing = {name: getattr(free_run, name)[:0] for name in names}
    with pytest.raises(ValueError, match=r"^a run must have at least one sample, got none\. "):
        dataclasses.replace(free_run, **nothing)
