"""What an object says of itself fits on a screen, in a terminal and in a notebook."""

from collections.abc import Callable
from xml.etree import ElementTree

import numpy as np
import pytest

import cdcr
from cdcr import plotting

SCREEN = 1800  # characters
ROBOT = cdcr.robots.three_sections()
MODEL = cdcr.Model(ROBOT)
ONE = cdcr.Model(cdcr.robots.amouri2020())
TIP = cdcr.Sensor(kind="tip", noise=1e-3)
T = np.linspace(0.0, 1.0, 101)


def run() -> cdcr.Trajectory:
    return cdcr.simulate(ONE, [0.1, 0.2], [0.0, 0.0], t=T, method="dopri5")


def reference() -> cdcr.Reference:
    return cdcr.Reference.from_angles(T, 0.3, lambda t: t)


def simulator() -> cdcr.Simulator:
    made = cdcr.Simulator(ONE, step=1e-3)
    made.reset([0.1, 0.2], [0.0, 0.0], 2.0)
    return made


THINGS: dict[str, Callable[[], object]] = {
    "robot": lambda: ROBOT,
    "parts": lambda: ROBOT.subdivide(10),
    "section": lambda: ROBOT.sections[0],
    "cable": lambda: ROBOT.all_cables[0],
    "wrench": lambda: cdcr.Wrench(section=0),
    "model": lambda: MODEL,
    "run": run,
    "stats": lambda: run().stats,
    "simulator": simulator,
    "equilibrium": lambda: cdcr.Model(ROBOT.subdivide(10)).find_equilibrium(np.zeros(9)),
    "allocation": lambda: MODEL.find_tension(np.zeros(6)),
    "modes": lambda: MODEL.modes(np.zeros(6), np.zeros(9)),
    "reference": reference,
    "inverse run": lambda: cdcr.inverse_run(ONE, reference()),
    "inverse kinematics": lambda: MODEL.inverse_kinematics([0.1, 0.1, 0.6]),
    "pid": lambda: cdcr.Pid(MODEL, kp=1.0),
    "derivatives": lambda: MODEL.derivatives(np.zeros(6), np.zeros(6), np.zeros(9)),
    "computed torque": lambda: cdcr.ComputedTorque(MODEL, kp=np.ones(6)),
    "state feedback": lambda: cdcr.StateFeedback(MODEL, gain=np.zeros((9, 12))),
    "task space": lambda: cdcr.TaskSpace(MODEL),
    "extended filter": lambda: cdcr.ExtendedKalman(MODEL, sensors=TIP),
    "unscented filter": lambda: cdcr.UnscentedKalman(MODEL, sensors=TIP),
    "observer": lambda: cdcr.MomentumObserver(MODEL),
    "loop": lambda: cdcr.Loop(MODEL, cdcr.TaskSpace(MODEL)),
    "table": lambda: cdcr.TensionTable(T, np.zeros((101, 9))),
    "scenario": lambda: cdcr.scenarios.get("step-tension"),
    "factors": lambda: cdcr.paper.factors(T),
    "polar model": lambda: cdcr.paper.PolarModel(cdcr.robots.amouri2020()),
}


@pytest.mark.parametrize("name", THINGS)
def test_a_repr_fits_on_a_screen(name: str) -> None:
    text = repr(THINGS[name]())
    assert 0 < len(text) <= SCREEN
    assert " object at 0x" not in text


def test_what_the_core_says() -> None:
    assert repr(simulator()) == "<Simulator at t = 2 s, period 0.001 s, q = [0.1, 0.2]>"
    assert repr(cdcr.Pid(ONE, kp=2.0, kd=0.5)) == "<Pid: kp 2, ki 0, kd 0.5, period 0.001 s>"
    torque = cdcr.ComputedTorque(MODEL, kp=np.ones(6))
    assert repr(torque) == "<ComputedTorque: kp of shape (6,), kd 20, period 0.001 s>"
    loop = cdcr.Loop(ONE, cdcr.Pid(ONE, kp=1.0), estimator=cdcr.MomentumObserver(ONE))
    assert repr(loop) == "<Loop at t = 0 s, Pid, MomentumObserver, status not_started>"
    found = repr(ONE.find_equilibrium([0.0, 0.0, 0.0]))
    assert found == "<Equilibrium at q = [0, 0], stable, residual 0 N m, status ok>"
    nearest = repr(ONE.find_tension([0.19, 0.0], 0.0, 5.0))
    assert nearest.startswith("<Allocation: tension [5, ")
    assert "not feasible, distance" in nearest


def test_a_robot_in_a_notebook() -> None:
    html = ROBOT._repr_html_()
    tree = ElementTree.fromstring(f"<div>{html}</div>")
    assert len(tree.findall("./table/tbody/tr")) == 3
    cells = [*tree.iter("th"), *tree.iter("td")]
    assert len(cells) == 6 + 3 * 6
    assert all("padding" in cell.get("style", "") for cell in cells)
    lines = tree.findall(".//{http://www.w3.org/2000/svg}line")
    assert len(lines) == 3 + 6 + 5 + 4  # backbones and disks
    assert max(float(line.get("x2", "")) for line in lines) == 480.0


def test_a_run_and_a_figure_in_a_notebook(monkeypatch: pytest.MonkeyPatch) -> None:
    picture = plotting.plot_run(run())._repr_png_()
    assert picture.startswith(b"\x89PNG")
    html = run()._repr_html_()
    assert '<img src="data:image/png;base64,' in html
    assert "&lt;Trajectory: 101 samples" in html

    def plot(_: cdcr.Trajectory) -> None:
        raise ImportError("as without the extra")

    monkeypatch.setattr(cdcr.Trajectory, "plot", plot)
    assert run()._repr_html_().startswith("<div>&lt;Trajectory")
