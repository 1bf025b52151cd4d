"""``cdcr info`` and what it computes: rest, frequencies, stiffness and the largest stable step."""

import dataclasses
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.model.stability import stable_step

pytest.importorskip("typer")

from cdcr.cli.info import mode_rows
from cdcr.model.rest import at_rest
from command import cdcr_

REL = 1e-9  # eigenvalues and differences of well-conditioned matrices
SMALL = 1e-6  # a motion whose square is negligible [rad]
PULL = 1e-4  # a small pull, by newton or by 10 um

TABLE_1 = cdcr.robots.amouri2020()
UPRIGHT = (0.0, 0.0, -9.81)


def printed(*args: object) -> str:
    result = cdcr_("info", *args)
    assert result.exit_code == 0
    assert result.stderr == ""
    return str(result.stdout)


def row(text: str, label: str) -> list[str]:
    """Return the cells after a label in the line that starts with it."""
    (line,) = (line for line in text.splitlines() if line.strip().startswith(f"{label} "))
    return line.strip().removeprefix(label).split()


def amplification(z: complex) -> float:
    return abs(1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24)


@pytest.mark.parametrize("name", cdcr.robots.names())
def test_robots_by_name_and_by_file(name: str, tmp_path: Path) -> None:
    robot = cdcr.robots.get(name)
    text = printed(name)
    path = tmp_path / "r.toml"
    robot.save(path)
    assert printed(path).replace(str(path), name).split() == text.split()
    assert row(text, "total") == [f"{robot.mass:.6g}"]
    for j, cable in enumerate(robot.all_cables):
        cells = row(text, f"cable {j + 1}")
        assert cells[:2] == [str(cable.end_section + 1), f"{cable.radius:g}"]
        assert cells[2] == f"{math.degrees(cable.angle):.4g}"


def test_table_1_in_closed_form() -> None:
    text = printed("amouri2020")
    section, model = TABLE_1.sections[0], cdcr.Model(TABLE_1)
    frequency = math.sqrt(section.stiffness / model.mass_matrix([0.0, 0.0])[0, 0])
    assert row(text, "1, 2") == [f"{frequency / (2 * math.pi):.6g}", f"{frequency:.6g}", "0"]
    # The tip of a straight section moves by l/2 for a unit angle.
    stiffness = 4.0 * section.stiffness / section.length**2
    assert row(text, "tip stiffness along its x [N/m]") == [f"{stiffness:.6g}"]
    per_newton = 1e3 * section.cable_radius / section.stiffness * section.length / 2.0
    assert row(text, "cable 2")[-1] == f"{per_newton:.4g}"
    step = 2.0 * math.sqrt(2.0) / frequency
    assert row(text, "largest stable step of rk4 [s]") == [f"{step:.6g}"]
    assert text.rstrip().endswith("amouri2020, at rest without tension: straight")


def test_massless_robots_say_why_they_have_no_frequencies() -> None:
    text = " ".join(printed("rao2021").split())
    assert "No natural frequencies: the robot has no dynamics, because section 2" in text
    assert "tip stiffness along its x [N/m]" in text
    assert "largest stable step" not in text


def test_damping_ratio_of_one_section() -> None:
    damping = 1e-3
    rest = at_rest(cdcr.robots.amouri2020(damping=damping))
    inertia = rest.model.mass_matrix([0.0, 0.0])[0, 0]
    ((numbers, _, _, ratio),) = mode_rows(rest)
    assert numbers == "1, 2"
    stiffness = TABLE_1.sections[0].stiffness
    assert float(ratio) == pytest.approx(damping / 2 / math.sqrt(stiffness * inertia), rel=5e-3)


def test_an_overdamped_mode_is_beyond_critical() -> None:
    ((_, _, _, ratio),) = mode_rows(at_rest(cdcr.robots.amouri2020(damping=1.0)))
    assert float(ratio) > 1.0


def test_a_heavy_robot_buckles_and_says_so(tmp_path: Path) -> None:
    robot = cdcr.robots.amouri2020(gravity=UPRIGHT, payload=0.2)
    rest = at_rest(robot)
    assert rest.buckled
    assert rest.stable
    theta = float(np.hypot(*rest.q))
    assert theta > 1.0
    # At rest the moment of weight balances that of the backbone.
    assert rest.model.bias(rest.q, [0.0, 0.0]) == pytest.approx([0.0, 0.0], abs=1e-9)
    assert not rest.is_nondegenerate  # it turns about the vertical freely
    robot.save(tmp_path / "heavy.toml")
    text = printed(tmp_path / "heavy.toml")
    assert f"bent by {math.degrees(theta):.2f} deg, buckled under" in " ".join(text.split())
    assert "some small forces move it far" in text
    light = at_rest(cdcr.robots.amouri2020(gravity=UPRIGHT))
    assert not light.buckled
    assert light.stable


def test_tip_stiffness_and_motion_by_statics() -> None:
    """A small force on the tip and a small pull of a cable, each with its new equilibrium."""
    robot = cdcr.robots.three_sections(gravity=(-9.81, 0.0, 0.0), payload=0.01)
    extra = cdcr.Cable(radius=0.01, angle=0.3, end_section=1)
    rest = at_rest(dataclasses.replace(robot, cables=(extra,)))
    model, q = rest.model, rest.q
    R, p = model.tip(q)
    for axis, stiffness in enumerate(rest.tip_stiffness):
        force = SMALL * R[:, axis]
        wrench = cdcr.Wrench(section=2, fraction=1.0, force=force)
        moved = model.equilibrium(rest.command, q, wrenches=wrench)
        along = float(R[:, axis] @ (model.tip(moved)[1] - p))
        assert SMALL / along == pytest.approx(stiffness, rel=1e-4)
    for cable in (0, 4, 9):
        pull = np.array(rest.command)
        pull[cable] += PULL
        away = np.linalg.norm(model.tip(model.equilibrium(pull, q))[1] - p) / PULL
        assert away == pytest.approx(rest.tip_motion[cable], rel=1e-2)


@pytest.mark.parametrize("strain", ["twist_order", "stretch_order"])
def test_a_tip_that_no_strain_moves_sideways_is_rigid(tmp_path: Path, strain: str) -> None:
    section = cdcr.Section(
        length=0.3, backbone_mass=0.01, backbone_diameter=2e-3, youngs_modulus=60e9,
        shear_modulus=23e9, bending_order=None, **{strain: 0},  # type: ignore[arg-type]
    )  # fmt: skip
    file = tmp_path / "stiff.toml"
    cdcr.Robot(sections=[section]).save(file)
    assert row(printed(file), "tip stiffness along its x [N/m]") == ["rigid"]
    told = json.loads(cdcr_("info", file, "--json").stdout)
    assert told["rest"]["tip_stiffness_N_per_m"] == [None, None]


def test_a_link_is_bent_as_it_was_made(tmp_path: Path) -> None:
    section = cdcr.robots.amouri2020().sections[0]
    link = dataclasses.replace(section, bending_order=None, rest_bending=(0.3, 0.4))
    rest = at_rest(cdcr.Robot(sections=[section, link]))
    assert rest.words == f"bent by 0.00, {math.degrees(0.5):.2f} deg"


def test_what_else_a_cable_has_is_told(tmp_path: Path) -> None:
    robot = cdcr.robots.amouri2020()
    rubs = cdcr.Cable(
        radius=0.01, angle=0.0, end_section=0, stiffness=1e4, entry_friction=0.5,
        sheath_friction=0.1, viscosity=2.0, pretension=3.0, backlash=1e-4,
    )  # fmt: skip
    robot = dataclasses.replace(robot, cables=(rubs, rubs), presliding_stiffness=2e4)
    robot.save(tmp_path / "rubs.toml")
    text = printed(tmp_path / "rubs.toml")
    assert (
        "cables with entry friction 0.5 N, sheath friction 0.1, viscosity 2 N s/m, pretension 3 N, "
        "backlash 0.0001 m: 4, 5"
    ) in " ".join(text.split())
    assert row(text, "stiffness of cables that stick [N/m]") == ["20000"]


def test_cables_driven_by_length(tmp_path: Path) -> None:
    robot = cdcr.scenarios.get("length-drive").robot
    robot.save(tmp_path / "driven.toml")
    text = printed(tmp_path / "driven.toml")
    assert row(text, "cable 1")[3] == "length"
    assert "driven by length, 20000 N/m, 20 N s/m: 1, 2, 3, 4, 5, 6, 7, 8, 9" in text
    assert "cables driven by length wound to 10 N" in " ".join(text.split())
    rest = at_rest(robot)
    assert np.all(rest.tension > 0.0)
    _, p = rest.model.tip(rest.q)
    wound = np.array(rest.command)
    wound[8] -= 1e-6
    away = np.linalg.norm(rest.model.tip(rest.model.equilibrium(wound, rest.q))[1] - p) / 1e-6
    assert away == pytest.approx(rest.tip_motion[8], rel=1e-2)


def test_stable_step_is_where_the_amplification_reaches_one() -> None:
    """For any damping: along the ray of every eigenvalue nothing before the step amplifies."""
    for damping in (0.0, 1e-6, 1e-3, 0.05, 0.5):
        model = cdcr.Model(cdcr.robots.three_sections(damping=damping))
        step = stable_step(model)
        A, _ = model.linearize(np.zeros(6), np.zeros(6), np.zeros(9))
        eigenvalues = np.linalg.eigvals(A)
        for share in np.linspace(0.01, 1.0, 50):
            assert max(amplification(share * step * z) for z in eigenvalues) < 1.0 + 1e-7
        assert max(amplification(1.01 * step * z) for z in eigenvalues) > 1.0


def test_stable_step_of_known_limits() -> None:
    section = TABLE_1.sections[0]
    inertia = cdcr.Model(TABLE_1).mass_matrix([0.0, 0.0])[0, 0]
    frequency = math.sqrt(section.stiffness / inertia)
    free = stable_step(cdcr.Model(TABLE_1))
    assert free == pytest.approx(math.sqrt(8.0) / frequency, rel=REL)
    damping = 1.0  # far beyond critical: real eigenvalues, the fast one near c/M
    half = damping / inertia / 2.0
    fast = half + math.sqrt(half**2 - frequency**2)
    slow = stable_step(cdcr.Model(cdcr.robots.amouri2020(damping=damping)))
    assert slow * fast == pytest.approx(2.785293563405282, rel=1e-8)  # root of |R| = 1


def test_a_growing_motion_sets_no_limit() -> None:
    top_heavy = cdcr.Model(cdcr.robots.amouri2020(gravity=UPRIGHT, payload=1.0))
    eigenvalues = np.linalg.eigvals(top_heavy.linearize([0, 0], [0, 0], [0, 0, 0])[0])
    assert np.max(eigenvalues.real) > 0.0
    fast = -float(np.min(eigenvalues.real))
    assert stable_step(top_heavy, [0.0, 0.0]) == pytest.approx(2.785293563405282 / fast, rel=1e-8)


def test_other_methods_are_refused() -> None:
    with pytest.raises(ValueError, match=r"^method must be 'rk4', .* got 'bdf'$"):
        stable_step(cdcr.Model(TABLE_1), method="bdf")  # type: ignore[arg-type]


@pytest.mark.parametrize("cable_damping", [0.0, 20.0])
def test_rk4_stays_bounded_below_the_step_and_diverges_above(cable_damping: float) -> None:
    """A stiff robot driven by length, its cables well taut, in a small motion."""
    plain = cdcr.scenarios.get("length-drive").robot
    drive: dict[str, Any] = {"cable_stiffness": 2e5, "cable_damping": cable_damping}
    sections = [dataclasses.replace(s, **drive) for s in plain.sections]
    rest = at_rest(dataclasses.replace(plain, sections=tuple(sections)))
    assert np.all(rest.tension > 0.0)
    start = rest.q + 1e-10 * np.random.default_rng(4).standard_normal(6)

    def largest(step: float) -> float:
        simulator = cdcr.Simulator(rest.model, step=step)
        simulator.reset(start, np.zeros(6))
        away = 0.0
        for _ in range(400):
            if simulator.step(rest.command) is not cdcr.Status.ok:
                return math.inf
            away = max(away, float(np.max(np.abs(simulator.q - rest.q))))
        return away

    assert largest(0.98 * rest.step) < 1e-8
    assert largest(1.1 * rest.step) > 1e-6
