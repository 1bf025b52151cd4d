"""Places by arc length."""

import math

import numpy as np
import pytest

import cdcr
from description import refusal

Q = np.array([0.5, 0.3, -0.8, 0.4, 0.2, -1.1])


def test_a_place_by_arc_length_goes_wherever_a_place_goes() -> None:
    whole = cdcr.robots.three_sections()
    model, lengths = cdcr.Model(whole), [section.length for section in whole.sections]
    assert whole.locate(0.0) == (0, 0.0)
    assert whole.locate(lengths[0]) == (0, 1.0)
    assert whole.locate(np.float64(sum(lengths))) == (2, 1.0)
    section, fraction = whole.locate(lengths[0] + 0.25 * lengths[1])
    assert section == 1
    assert fraction == pytest.approx(0.25, rel=1e-14)
    p = np.array([model.pose(Q, *whole.locate(s))[1] for s in np.linspace(0, whole.length, 400)])
    walked = np.linalg.norm(np.diff(p, axis=0), axis=1)
    np.testing.assert_allclose(walked, whole.length / 399, rtol=1e-4)  # chords of bent pieces
    assert model.jacobian(Q, *whole.locate(0.1)).shape == (6, 6)


@pytest.mark.parametrize("s", [-0.1, 0.803, math.inf, math.nan])
def test_there_is_no_place_beyond_the_robot(s: float) -> None:
    told = f"s must be 0 to 0.802 m, the length of the robot, got {s:g}"
    assert refusal(lambda s: cdcr.robots.amouri2020().locate(s), s=s) == [told]


def test_an_arc_length_is_a_number() -> None:
    said = ["s must be a number in m, got 'tip' (str)"]
    assert refusal(lambda s: cdcr.robots.amouri2020().locate(s), s="tip") == said
