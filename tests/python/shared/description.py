"""What a description refuses."""

from __future__ import annotations

from typing import Any

import pytest


def refusal(kind: Any, **fields: Any) -> list[str]:
    """The sentences with which a description of that kind refuses the fields."""
    with pytest.raises(ValueError) as caught:  # noqa: PT011 - the text is what the caller asserts
        kind(**fields)
    return str(caught.value).split("\n")
