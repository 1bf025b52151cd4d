"""Examples that Hypothesis draws are the same in every run; what a build lacks is no failure.

The files that take longest begin first, so that side by side none is left alone at the end.

CDCR_RANDOM_TESTS=N draws other examples each time, N times as many; the nightly script does.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Generator, Iterator
from pathlib import Path

import pytest
from hypothesis import settings

import cdcr
from cdcr import _core
from example_script import Example

LONGEST = {
    "test_cli",
    "test_cli_new",
    "test_cli_run",
    "test_completion",
    "test_example_learning",
    "test_examples",
    "test_examples_control",
    "test_exit",
    "test_figures",
    "test_inverse_kinematics",
    "test_new_file",
    "test_notebooks",
    "test_paper_polar",
    "test_picture_sizes",
    "test_processes",
    "test_run_ends",
    "test_view_server",
}
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


def pytest_configure(config: pytest.Config) -> None:
    """Let a build without CVODE say that bdf would pay; other warnings are errors."""
    if not _core.with_cvode:
        config.addinivalue_line(
            "filterwarnings", "ignore:.*auto takes bdf there, which this cdcr was built without"
        )


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Put what takes longest first, in the order of before."""
    items.sort(key=lambda item: item.path.stem not in LONGEST)


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Draw empty pictures, of few pixels, where pictures do not matter."""
    figure = pytest.importorskip("matplotlib.figure")
    empty = {"figsize": (0.1, 0.1)}
    monkeypatch.setattr(
        cdcr.scenarios.Scenario, "figure", lambda self, run, **_: figure.Figure(**empty)
    )


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


@pytest.fixture
def example(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> Iterator[Example]:
    monkeypatch.setattr(sys, "argv", [])
    mpl = pytest.importorskip("matplotlib")
    mpl.use("Agg")
    with mpl.rc_context():
        yield Example(tmp_path / "picture.png", capsys)
    from matplotlib import pyplot

    pyplot.close("all")
