"""Notebooks run, as code and in Jupyter, and find what other means find.

CDCR_ALL_NOTEBOOKS=1 runs each of them in Jupyter too; the nightly script does, and `make docs` runs
them for their pages.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest

import cdcr

nbclient = pytest.importorskip("nbclient", reason="nbclient runs notebooks")
nbformat = pytest.importorskip("nbformat", reason="nbformat reads notebooks")

FOLDER = Path(__file__).parents[2] / "examples" / "notebooks"
NAMES = sorted(path.stem for path in FOLDER.glob("*.ipynb"))
LONGEST = 120  # a cell may take [s]


@pytest.fixture
def agg() -> Iterator[None]:
    """Draw into no window, and leave Matplotlib as it was."""
    mpl.use("Agg")
    with mpl.rc_context():
        yield
    from matplotlib import pyplot

    pyplot.close("all")


def read(name: str) -> Any:
    return nbformat.read(FOLDER / f"{name}.ipynb", as_version=4)


def run_code(name: str) -> dict[str, Any]:
    """Run the code of a notebook in this process; return its names."""
    cells = [cell.source for cell in read(name).cells if cell.cell_type == "code"]
    lines = [line for line in "\n".join(cells).splitlines() if not line.startswith("%")]
    names: dict[str, Any] = {}
    exec(compile("\n".join(lines), name, "exec"), names)
    return names


@pytest.mark.parametrize("name", NAMES)
def test_a_notebook_is_kept_without_what_it_prints(name: str) -> None:
    for cell in read(name).cells:
        assert not cell.get("outputs")
        assert cell.get("execution_count") is None


@pytest.mark.skipif(not os.environ.get("CDCR_ALL_NOTEBOOKS"), reason="CDCR_ALL_NOTEBOOKS=1 runs it")
@pytest.mark.parametrize("name", NAMES)
def test_a_notebook_runs_in_jupyter(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("JUPYTER_RUNTIME_DIR", str(tmp_path))
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path))
    notebook = read(name)
    nbclient.NotebookClient(notebook, kernel_name="python3", timeout=LONGEST).execute()
    outputs = [out for cell in notebook.cells for out in cell.get("outputs", ())]
    assert not [out for out in outputs if out.get("name") == "stderr"]
    pictures = [out for out in outputs if "image/png" in out.get("data", {})]
    assert len(pictures) >= 2


def test_first_steps(agg: None) -> None:
    found = run_code("first-steps")
    run, section = found["run"], found["robot"].sections[0]
    # Of the work of the cable the damping takes a part.
    heat = section.damping * np.trapezoid((run.qd**2).sum(axis=1), run.t)
    assert found["work"] - run.energy[-1] == pytest.approx(heat, rel=1e-4)
    directions = [[1, np.cos(2 * np.pi / 3)], [0, np.sin(2 * np.pi / 3)]]
    moment = section.cable_radius * np.array(directions) @ [12.0, 4.0]
    np.testing.assert_allclose(found["q"], moment / section.stiffness, rtol=1e-9)


def tip_of_arcs(robot: cdcr.Robot, q: Any) -> tuple[Any, Any]:
    """Orientation and place of the tip of a chain of circular arcs."""
    R, p = np.eye(3), np.zeros(3)
    for section, (x, y) in zip(robot.sections, np.reshape(q, (-1, 2)), strict=True):
        theta, phi = np.hypot(x, y), np.arctan2(y, x)
        turn = np.array(
            [[np.cos(phi), -np.sin(phi), 0], [np.sin(phi), np.cos(phi), 0], [0, 0, 1.0]]
        )
        s, c = np.sin(theta), np.cos(theta)
        p = p + R @ turn @ np.array([1 - c, 0, s]) * section.length / theta
        R = R @ turn @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]) @ turn.T
    return R, p


def test_several_sections(agg: None) -> None:
    found = run_code("several-sections")
    model, place = found["model"], found["place"]
    _, p = tip_of_arcs(model.robot, found["found"].q)
    np.testing.assert_allclose(p, place, rtol=0, atol=1e-8)
    R, p = tip_of_arcs(model.robot, found["upright"].q)
    np.testing.assert_allclose(p, place, rtol=0, atol=1e-8)
    np.testing.assert_allclose(R, np.eye(3), rtol=0, atol=1e-8)
    # Small motions of the equation of motion without its dampers.
    M, K = model.mass_matrix(found["back"]), model.potential_hessian(found["back"])
    squared = np.linalg.eigvals(np.linalg.solve(M, K)).real
    np.testing.assert_allclose(found["modes"].frequency ** 2, np.sort(squared), rtol=1e-6)
    assert found["hold"].min() == pytest.approx(0.5)


def test_control_and_identification(agg: None) -> None:
    found = run_code("control-and-identification")
    np.testing.assert_allclose(found["estimate"], found["TRUE"], rtol=0.05)
    late = found["reference"].t >= 4.0
    alone, closed = (found["off"][name][late].max() for name in ("plan alone", "with feedback"))
    assert closed < 0.2 < alone
