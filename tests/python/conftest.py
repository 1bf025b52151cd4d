"""Examples that Hypothesis draws are the same in every run; what a build lacks is no failure.

CDCR_RANDOM_TESTS=N draws other examples each time, N times as many; the nightly script does.
"""

from __future__ import annotations

import os
from collections.abc import Generator

import pytest
from hypothesis import settings

from cdcr import _core

EXAMPLES = 60
FACTOR = int(os.environ.get("CDCR_RANDOM_TESTS", "0"))
REFUSED = "needs CVODE, and this cdcr was built without it"

settings.register_profile(
    "cdcr",
    derandomize=not FACTOR,
    database=None,
    deadline=None,
    print_blob=bool(FACTOR),
    max_examples=EXAMPLES * max(1, FACTOR),
)
settings.load_profile("cdcr")


@pytest.hookimpl(wrapper=True)
def skip_what_needs_cvode() -> Generator[None]:
    """Skip a test, or its fixture, that asks for a method of CVODE where there is none."""
    try:
        yield
    except Exception as error:
        if not _core.with_cvode and REFUSED in str(error):
            pytest.skip(REFUSED)
        raise


pytest_runtest_setup = pytest_runtest_call = skip_what_needs_cvode
