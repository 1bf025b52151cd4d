"""What a wrong argument is answered with."""

from __future__ import annotations

from collections.abc import Callable

import pytest


def is_refused(call: Callable[[], object], sentence: str) -> None:
    """Check that a call raises a TypeError or ValueError that begins with this sentence."""
    with pytest.raises((TypeError, ValueError)) as caught:
        call()
    assert str(caught.value).startswith(sentence)
