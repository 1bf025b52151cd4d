"""Which values a sweep takes, and the shares of variance that some of them tell."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy import stats  # type: ignore[import-untyped]

import cdcr
from cdcr.sweeps.design import make_design
from swept import TIMES, end_x, pulled

pytest.importorskip("xarray")

SHARES = 0.1  # error of Sobol indices from 1024 points; those of a product are worst
MODEL = cdcr.Model(cdcr.robots.amouri2020())


def test_a_grid_has_all_pairs_and_its_last_parameter_changes_fastest() -> None:
    rows = make_design({"a": [1, 2], "b": [3, 4, 5]}, None, 0).rows
    assert rows.tolist() == [[1, 3], [1, 4], [1, 5], [2, 3], [2, 4], [2, 5]]


def test_sobol_points_are_those_of_scipy() -> None:
    rows = make_design({"a": (0.0, 1.0), "b": (-2.0, 2.0)}, "sobol:64", 5).rows
    points = stats.qmc.Sobol(2, rng=np.random.default_rng(5)).random(64)
    np.testing.assert_array_equal(rows, stats.qmc.scale(points, [0.0, -2.0], [1.0, 2.0]))


def test_normal_samples_are_those_of_scipy() -> None:
    mean, deviation = [1.0, -1.0], [0.1, 2.0]
    normal = {name: stats.norm(*pair) for name, *pair in zip("ab", mean, deviation, strict=True)}
    rows = make_design(normal, "sobol:64", 5).rows
    engine = stats.qmc.Sobol(2, rng=np.random.default_rng(5))
    same = stats.qmc.MultivariateNormalQMC(mean, np.diag(np.square(deviation)), engine=engine)
    # SciPy moves its shares away from 0 and 1 a little.
    np.testing.assert_allclose(rows, same.random(64), rtol=1e-7, atol=1e-7)


@pytest.mark.parametrize("seed", [0, 1])
def test_a_latin_hypercube_has_one_point_in_each_layer(seed: int) -> None:
    rows = make_design({"a": (0.0, 10.0), "b": (0.0, 1.0)}, "lhs:10", seed).rows
    assert sorted(np.floor(rows[:, 0]).tolist()) == list(range(10))
    assert sorted(np.floor(10 * rows[:, 1]).tolist()) == list(range(10))


def test_a_seed_repeats_and_another_does_not() -> None:
    box = {"a": (0.0, 1.0)}
    for kind in ("sobol:4", "lhs:4", "random:4", "saltelli:4"):
        first, again, other = (make_design(box, kind, seed).rows for seed in (3, 3, 4))
        np.testing.assert_array_equal(first, again)
        assert np.all(first != other)


def still(**values: float) -> cdcr.Trajectory:
    """A robot at rest, whose state tells the values it is asked for."""
    q = np.zeros((TIMES.size, 2))
    q[-1] = values["a"], values["b"]
    status, stats_ = cdcr.Status.ok, cdcr.Stats()
    pull = np.full((TIMES.size, 3), values["c"])
    return cdcr.Trajectory(MODEL, TIMES, q, 0 * q, pull, status, "", stats_)


def test_sobol_indices_of_a_sum_are_the_shares_of_its_variance() -> None:
    """The variance of a uniform number is that of its width squared, over 12."""

    def weighted(run: cdcr.Trajectory) -> float:
        (a, b), c = run.q[-1], run.tension[-1, 0]
        return float(a + 2.0 * b + 0.0 * c)

    def product(run: cdcr.Trajectory) -> float:
        (a, b), _ = run.q[-1], 0
        return float((a - 0.5) * (b - 0.5))

    found = cdcr.sweep(
        still,
        {"a": (0.0, 1.0), "b": (0.0, 1.0), "c": (0.0, 1.0)},
        samples="saltelli:1024",
        metrics=[weighted, product],
    )
    assert found.sizes["run"] == 1024 * 5
    indices = cdcr.sweeps.sobol_indices(found)
    # Of a sum each parameter acts by itself, of a product of centred ones only with the other.
    expected: dict[str, Any] = {
        "weighted": ([0.2, 0.8, 0.0], [0.2, 0.8, 0.0]),
        "product": ([0] * 3, [1, 1, 0]),
    }
    for name, (first, total) in expected.items():
        one = indices.sel(metric=name)
        np.testing.assert_allclose(one.first_order, first, atol=SHARES)
        np.testing.assert_allclose(one.total_order, total, atol=SHARES)


def test_indices_of_a_metric_that_a_run_lacks_are_none() -> None:
    def holed(run: cdcr.Trajectory) -> float:
        return float("nan") if run.q[-1, 0] > 0.9 else 1.0

    box = {"a": (0.0, 1.0), "b": (0.0, 1.0), "c": (0.0, 1.0)}
    found = cdcr.sweep(still, box, samples="saltelli:16", metrics=[holed])
    assert np.all(np.isnan(cdcr.sweeps.sobol_indices(found).total_order))
    with pytest.raises(ValueError, match=r"need samples 'saltelli:N', and this sweep is of 'lhs'"):
        cdcr.sweeps.sobol_indices(cdcr.sweep(still, box, samples="lhs:4", metrics=[holed]))


def test_samples_follow_their_distributions() -> None:
    box = {"a": (2.0, 3.0), "b": stats.loguniform(1e-3, 1e-1)}
    for kind in ("sobol:64", "lhs:50", "random:50", "saltelli:16"):
        rows = make_design(box, kind, 0).rows
        assert np.all((rows >= [2.0, 1e-3]) & (rows <= [3.0, 1e-1]))
        assert np.sum(rows[:, 1] < 1e-2) == pytest.approx(len(rows) / 2, rel=0.4)


def test_one_parameter_makes_all_of_the_variance() -> None:
    def still(run: cdcr.Trajectory) -> float:
        """The same in all runs."""
        return 1.0

    found = cdcr.sweep(pulled, {"pull": (1.0, 2.0)}, samples="saltelli:4", metrics=[end_x, still])
    indices = cdcr.sweeps.sobol_indices(found)
    for shares in (indices.first_order, indices.total_order):
        np.testing.assert_array_equal(shares, [[1.0], [np.nan]])


@pytest.mark.parametrize("thing", [None, 3, "sweep.nc", {}])
def test_what_is_no_sweep_has_no_indices_and_no_picture(thing: Any) -> None:
    for use in (cdcr.sweeps.sobol_indices, cdcr.sweeps.plot):
        with pytest.raises(TypeError, match=r"result must be a Dataset of cdcr.sweep, or one read"):
            use(thing)
