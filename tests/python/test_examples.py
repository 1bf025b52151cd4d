"""Each example runs, draws its picture, and finds what other means find."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp  # type: ignore[import-untyped]
from scipy.optimize import brentq, minimize_scalar  # type: ignore[import-untyped]

from example_script import Example

GRAVITY = 9.81


def rotated(phi: Any) -> Any:
    return np.stack([np.cos(phi), np.sin(phi)], axis=-1)


def test_own_robot(example: Example) -> None:
    found = example(1)
    # One cable bends to F r/K; swings about that shape are those of a damped oscillator.
    K = 60e9 * np.pi / 64 * 2e-3**4 / 0.4
    assert found["theta_rest"] == pytest.approx(4.0 * 0.015 / K, rel=1e-9)
    theta, t = found["run"].theta[:, 0], found["run"].t
    peaks = np.flatnonzero((theta[1:-1] > theta[:-2]) & (theta[1:-1] > theta[2:])) + 1
    first, last = peaks[3], peaks[-1]
    swings = len(peaks) - 4
    period = (t[last] - t[first]) / swings
    decrement = np.log((theta[first] - K**-1 * 0.06) / (theta[last] - K**-1 * 0.06)) / swings
    ratio = decrement / np.hypot(2 * np.pi, decrement)
    assert found["modes"].damping_ratio[0] == pytest.approx(ratio, rel=2e-3)
    damped = found["modes"].frequency_hz[0] * np.sqrt(1 - ratio**2)
    assert period == pytest.approx(1.0 / damped, rel=2e-3)


def test_shapes(example: Example) -> None:
    found = example(2)
    section = found["model"].robot.sections[0]
    needed = section.stiffness * np.pi / 3 / section.cable_radius  # [N]
    directions = rotated(2 * np.pi / 3 * np.arange(3))
    np.testing.assert_allclose(
        found["tension"] @ directions, needed * rotated(found["phi"]), rtol=0, atol=1e-9 * needed
    )
    assert found["total"].min() == pytest.approx(needed, rel=1e-9)
    assert found["total"].max() == pytest.approx(2 * needed, rel=1e-9)
    assert found["tension"].max() == pytest.approx(needed / np.cos(np.pi / 6), rel=1e-9)
    l = section.length
    circle = l * (1 - np.cos(np.pi / 3)) / (np.pi / 3)
    tips = found["model"].tips(found["shapes"])
    np.testing.assert_allclose(np.hypot(*tips[:, :2].T), circle, rtol=1e-9)


def test_two_sections(example: Example) -> None:
    found = example(3)
    K = found["first"].stiffness
    bent = 6.0 * 0.015 / K * rotated(np.pi / 3)
    np.testing.assert_allclose(found["coupled"], [*bent, *bent], rtol=1e-9)
    np.testing.assert_allclose(found["alone"], [0.0, 0.0, *bent], rtol=0, atol=1e-9)
    np.testing.assert_allclose(found["inner"][0::2], -6.0 * 0.008 / K, rtol=1e-9)


def test_gravity_and_payload(example: Example) -> None:
    found = example(4)
    section = found["arm"].sections[0]
    l, EI = section.length, section.stiffness * section.length
    disks = np.array([disk.position * l for disk in section.disks])

    def weight_beyond(s: float, payload: float) -> float:
        own = section.backbone_mass * (1 - s / l) + section.disk_mass * np.sum(disks > s)
        return GRAVITY * float(own + payload)

    def elastica(payload: float) -> float:
        """Sag of the tip of a rod, integrated from its tip, whose angle is sought."""

        def base(angle: float) -> Any:
            return solve_ivp(
                lambda s, y: [y[1], -weight_beyond(s, payload) * np.cos(y[0]) / EI, np.sin(y[0])],
                (l, 0.0),
                [angle, 0.0, 0.0],
                max_step=l / 100,
            ).y[:, -1]

        return float(-base(brentq(lambda angle: base(angle)[0], 0.0, 1.5, xtol=1e-6))[2])

    def arc(payload: float) -> float:
        """The same of a circular arc, which has the least energy."""

        def energy(theta: float) -> float:
            def drop(s: Any) -> Any:
                return l * (1 - np.cos(theta * s / l)) / theta

            spread = np.mean(drop((np.arange(1000) + 0.5) * l / 1000))
            work = section.backbone_mass * spread + section.disk_mass * np.sum(drop(disks))
            work += payload * drop(l)
            return float(section.stiffness * theta**2 / 2 - GRAVITY * work)

        theta = minimize_scalar(energy, bounds=(1e-3, 3.0), method="bounded").x
        return float(l * (1 - np.cos(theta)) / theta)

    for payload in (0.0, 0.1):
        assert found["sag"][payload, 8] == pytest.approx(elastica(payload), rel=0.02)
        assert found["sag"][payload, 1] == pytest.approx(arc(payload), rel=1e-4)
    # Straight, a mass m at s bends by m g s^2/(2 l).
    moment = section.backbone_mass * l / 6 + (section.disk_mass * disks**2).sum() / (2 * l)
    moment = GRAVITY * (moment + 0.05 * l / 2)
    np.testing.assert_allclose(found["lift"], [moment / section.cable_radius, 0, 0], atol=1e-9)


def test_length_drives_and_friction(example: Example) -> None:
    found = example(5)
    t, lengths = found["t"], found["lengths"]
    for mu, run in found["runs"].items():
        model = run.model
        section = model.robot.sections[0]
        d, k = section.cable_damping, section.cable_stiffness
        rate = run.qd @ -model.actuation_matrix()  # of the lengths
        stretch = model.cable_lengths(run.q) - lengths
        # What the drives put in is in springs and robot, or heat.
        winding = -(k * stretch * np.gradient(lengths, t, axis=0)).sum(axis=1)
        heat = d * (rate**2).sum(axis=1) + section.damping * (run.qd**2).sum(axis=1)
        heat = heat + run.friction_power
        stored = run.energy + run.cable_energy
        put_in, lost = np.trapezoid(winding, t), np.trapezoid(heat, t)
        scale = np.ptp(stored)
        assert put_in == pytest.approx(stored[-1] - stored[0] + lost, abs=1e-4 * scale)
        # Capstan: along an arc of theta a sliding cable loses exp(-mu theta).
        row = np.argmax(t > 5.0)
        along = model.tensions_along(run.q[row], run.qd[row], lengths[row])
        speed = np.tanh(rate[row] / 2 / model.robot.sliding_speed)  # half way along
        ratio = np.exp(mu * run.theta[row, 0] * np.abs(speed))
        assert np.all(run.friction_power >= 0.0)
        base, end = along
        np.testing.assert_allclose(np.maximum(base / end, end / base), ratio, rtol=0.01)
    assert np.abs(found["rubbing"].q[:, 0] - found["asked"]).max() > np.deg2rad(1.0)
    assert np.abs(found["runs"][0.0].q[:, 0] - found["asked"]).max() < np.deg2rad(0.1)


def test_fit(example: Example) -> None:
    found = example(9)
    modulus, damping = found["TRUE"]
    off = np.log([found["modulus"] / modulus, found["damping"] / damping])
    assert np.all(np.abs(off) < 4 * found["spread"])
    assert np.all(found["spread"] < 0.01)
    assert found["deviation"] == pytest.approx(found["NOISE"], rel=0.15)


def test_fit_from_poses(example: Example) -> None:
    found = example(16)
    modulus, tilt = found["found"].estimates[:2]
    assert abs(modulus.value - found["TRUE"][0]) < 4.5 * modulus.standard_error
    assert abs(tilt.value - found["TRUE"][1]) < 4.5 * tilt.standard_error
    # What was promised at the data sheet's numbers, within how far these are off.
    assert found["error"] == pytest.approx(modulus.standard_error, rel=0.4)


def test_sweep(example: Example) -> None:
    found = example(10)
    model, rest = found["model"], found["rest"]
    # A linear oscillator with the inertia at rest.
    inertia = float(rest @ model.mass_matrix(rest) @ rest / (rest @ rest))
    section = model.robot.sections[0]
    pole = np.roots([inertia, section.damping, section.stiffness])[0]
    half = np.pi / abs(pole.imag)
    share = 1.0 / (1.0 + np.exp(pole.real * half))
    assert found["half_period"] == pytest.approx(half, rel=1e-6)
    assert found["first"] == pytest.approx(share, rel=1e-6)
    # The robot is not linear: its best is near.
    assert found["best_share"] == pytest.approx(share, abs=0.02)
    assert found["best_wait"] == pytest.approx(half, rel=0.04)
    assert found["left_over"].min() < 0.02 * found["residual"](1.0, 0.1)


def test_optimise_pull(example: Example) -> None:
    found = example(11)
    model, knots, pull, goal = (found[name] for name in ("model", "knots", "pull", "goal"))

    def rate(t: float, y: Any) -> Any:
        tension = [np.interp(t, knots, pull), 0.0, 0.0]
        return np.concatenate([y[2:], model.forward_dynamics(y[:2], y[2:], tension)])

    options = {"rtol": 1e-9, "atol": 1e-11, "max_step": knots[1]}
    end = solve_ivp(rate, (0.0, 0.5), np.zeros(4), **options).y[:, -1]
    np.testing.assert_allclose(end, [*goal, 0.0, 0.0], rtol=0, atol=1e-4)
    # No pull that arrives is smoother: the gradient is one of the two constraints alone.
    gradient = np.convolve(pull, [-1, 2, -1])[1:-1][1:-1]
    columns = np.eye(knots.size)[1:-1] * 1e-3
    miss = [np.subtract(found["miss"](pull + dp), found["miss"](pull - dp)) for dp in columns]
    left = np.linalg.lstsq(np.array(miss), gradient)[0]
    np.testing.assert_allclose(np.array(miss) @ left, gradient, atol=0.02 * np.abs(gradient).max())


def test_events_and_files(example: Example) -> None:
    found = example(13)
    model, run, touch = found["model"], found["run"], found["touch"]
    assert model.tip(touch.q)[1][2] == pytest.approx(found["SHELF"], abs=1e-9)
    for turn in found["turning"]:
        assert turn.q @ turn.qd == pytest.approx(0.0, abs=1e-9)
    # Work of the pulls is energy or heat.
    t = np.append(run.t, touch.time)
    lengths = model.cable_lengths(np.vstack([run.q, touch.q]))[:, 0]
    held = np.array([4.0, 8.0, 12.0, 20.0])[np.floor(t[:-1]).astype(int)]
    work = np.sum(held * -np.diff(lengths))
    qd = np.vstack([run.qd, touch.qd])
    heat = model.robot.sections[0].damping * np.trapezoid((qd**2).sum(axis=1), t)
    energy = model.kinetic_energy(touch.q, touch.qd) + model.potential_energy(touch.q)
    assert energy == pytest.approx(work - heat, rel=2e-3)
    assert found["speed"] == pytest.approx(
        np.linalg.norm(
            np.diff([model.tip(touch.q + h * touch.qd)[1] for h in (-1e-5, 1e-5)], axis=0)
        )
        / 2e-5,
        rel=1e-6,
    )


def test_feel_a_push(example: Example) -> None:
    found = example(20)
    assert found["error"][1:-1].max() < 0.01 * np.linalg.norm(found["size"])
    # The same from the mass matrix and the Jacobian of the tip, at one of the states.
    model, run, i = found["model"], found["run"], 1000
    J = model.jacobian(run.q[i], 2, 1.0)[:3]
    by_hand = np.linalg.solve(model.mass_matrix(run.q[i]), J.T)
    np.testing.assert_allclose(found["by_force"][i], by_hand, rtol=1e-9)


def test_optimal_pull(example: Example) -> None:
    found = example(23)
    assert found["rest"] < 0.02 < 10.0 < found["swing"]
    # One column of the chain rule through both runs, by a difference.
    pulls, h = found["found"].x, 1e-4
    ends = []
    for side in (h, -h):
        _, second, _ = found["end"](pulls + side * np.eye(6)[1])
        ends.append(np.concatenate([second.q[-1], second.qd[-1]]))
    column = found["end"](pulls)[2][:, 1]
    np.testing.assert_allclose((ends[0] - ends[1]) / (2 * h), column, atol=1e-5)


def test_hysteresis(example: Example) -> None:
    found = example(24)
    # Without friction the way back is the way there, and the equilibrium.
    smooth, rough = found["runs"]["no friction"], found["runs"]["in the holes"]
    shape = smooth.model.equilibrium(found["command"][70])
    np.testing.assert_allclose(smooth.q[70], shape, rtol=0, atol=1e-9)
    # At full sliding the last cable loses as the capstan has it, by all that it turns.
    theta, _ = rough.model.polar(rough.q[45])
    lost = np.exp(-0.25 * np.sum(theta))
    assert rough.end_tension[45, 6] / rough.tension[45, 6] == pytest.approx(lost, rel=1e-9)
    assert np.all(np.abs(smooth.friction) == 0.0)
