"""What a build of cdcr lacks by choice is no failure of its tests."""

from __future__ import annotations

from collections.abc import Generator

import pytest

from cdcr import _core

REFUSED = "needs CVODE, and this cdcr was built without it"


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
