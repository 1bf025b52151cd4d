"""What a description refuses."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest


def refusal(kind: Any, **fields: Any) -> list[str]:
    """The sentences with which a description of that kind refuses the fields."""
    with pytest.raises(ValueError) as caught:  # noqa: PT011 - the text is what the caller asserts
        kind(**fields)
    return str(caught.value).split("\n")


def without_lines(error: object, file: Path) -> list[str]:
    """The sentences of a refusal, without the lines of the file that they are about."""
    line = rf"^({re.escape(str(file))}), line \d+(?=, |: )"
    return [re.sub(line, r"\1", one) for one in str(error).split("\n")]
