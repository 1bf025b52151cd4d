"""Numbers as files and command lines hold them."""

import math

import pytest

from cdcr.base.decimals import number, whole


@pytest.mark.parametrize(
    ("text", "value"),
    [("1", 1.0), (" -1.5e-3\t", -1.5e-3), ("+.5", 0.5), ("5.", 5.0), ("1e400", math.inf)],
)
def test_plain_decimals_are_numbers(text: str, value: float) -> None:
    assert number(text) == value


@pytest.mark.parametrize(
    "text", ["", "1_0", "\u0661", "\uff11", "0x10", "nan", "inf", "1 0", "1,0"]
)
def test_anything_else_is_none(text: str) -> None:
    assert math.isnan(number(text))
    assert whole(text) is None


def test_whole_numbers() -> None:
    assert [whole(one) for one in ("7", "-7", "1e6", "2.0")] == [7, -7, 1_000_000, 2]
    assert whole(str(2**63)) == 2**63  # which no double holds beside 2**63 - 1
    assert [whole(one) for one in ("1.5", "1e16", "1e400", "9" * 5000)] == [None] * 4
