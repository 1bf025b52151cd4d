"""The picture of a sweep shows its numbers."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import cdcr
from swept import pulled

pytest.importorskip("xarray")
pytest.importorskip("matplotlib")


def test_one_parameter_is_a_line(monkeypatch: pytest.MonkeyPatch) -> None:
    found = cdcr.sweep(pulled, {"pull": [3.0, 1.0, 2.0]}, metrics=["peak_theta", "steps"])
    left, right = cdcr.sweeps.plot(found).axes
    x, y = left.lines[0].get_data()
    np.testing.assert_array_equal(x, [1.0, 2.0, 3.0])
    np.testing.assert_array_equal(y, np.sort(found.peak_theta.values))
    assert (left.get_ylabel(), right.get_ylabel()) == ("peak theta [rad]", "steps")


def test_a_grid_of_two_is_a_map_whose_holes_are_told() -> None:
    def holed(run: cdcr.Trajectory) -> float:
        return float("nan") if run.tension[0, 0] > 1.5 else 1.0

    damping = np.geomspace(1e-3, 1e-1, 5)
    found = cdcr.sweep(pulled, {"pull": [2.0, 1.0], "damping": damping}, metrics=[holed])
    axes, bar = cdcr.sweeps.plot(found).axes
    (mesh,) = axes.collections
    field: Any = mesh.get_array()
    np.testing.assert_array_equal(np.isnan(np.ma.filled(field, np.nan)).all(axis=1), [False, True])
    assert axes.get_title(loc="left") == "grey: no value of 5 of 10 runs"
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", "linear")
    assert bar.get_ylabel() == "holed"
    edges = mesh.get_coordinates()  # type: ignore[attr-defined]
    np.testing.assert_allclose(np.sqrt(edges[0, :-1, 0] * edges[0, 1:, 0]), damping)


def test_more_is_parallel_coordinates_with_indices() -> None:
    box = {"pull": (1.0, 2.0), "damping": (0.005, 0.02)}
    found = cdcr.sweep(pulled, box, samples="saltelli:8", metrics=["peak_theta", "steps"])
    figure = cdcr.sweeps.plot(found)
    lines, _, *bars = figure.axes
    (drawn,) = lines.collections
    assert len(drawn.get_segments()) == 32  # type: ignore[attr-defined]
    assert [label.get_text() for label in lines.get_xticklabels()] == [
        *("pull", "damping", "peak theta\n[rad]", "steps"),
    ]
    indices = cdcr.sweeps.sobol_indices(found)
    for axes, name in zip(bars, ("peak_theta", "steps"), strict=True):
        widths = [bar.get_width() for bar in axes.patches]  # type: ignore[attr-defined]
        one = indices.sel(metric=name)
        np.testing.assert_array_equal(widths, [*one.first_order.values, *one.total_order.values])


@pytest.mark.parametrize(
    ("size", "inches"), [((12.7, 8.0), (5.0, 3.15)), ("journal", (3.35, None))]
)
def test_sizes(size: Any, inches: tuple[float, float | None]) -> None:
    rows = np.random.default_rng(0).uniform([1.0, 0.01], [2.0, 0.02], (5, 2))
    found = cdcr.sweep(pulled, ["pull", "damping"], samples=rows, metrics="peak_theta")
    width, height = cdcr.sweeps.plot(found, size=size).get_size_inches()
    assert width == pytest.approx(inches[0], abs=0.01)
    if inches[1]:
        assert height == pytest.approx(inches[1], abs=0.01)
    with pytest.raises(ValueError, match="size must be"):
        cdcr.sweeps.plot(found, size="poster")
