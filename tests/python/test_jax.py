"""Models as functions of JAX: values, exact derivatives, jit, vmap, and what is refused."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import cdcr

jax: Any = pytest.importorskip("jax", reason="needs JAX, extra jax")

import cdcr.jax  # noqa: E402 - where JAX is missing this is refused

ARM = cdcr.Model(cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81)))
ROUNDING = 1e-9  # relative, of sums of accelerations taken in two orders
SMOOTH = 3e-6  # relative, of central differences with a step of 1e-5


@pytest.fixture(autouse=True)
def double() -> Iterator[None]:
    before = jax.config.jax_enable_x64
    jax.config.update("jax_enable_x64", True)
    yield
    jax.config.update("jax_enable_x64", before)


def states(*leading: int) -> tuple[Any, Any, Any]:
    rng = np.random.default_rng(0)
    d, m = ARM.num_coordinates, ARM.num_cables
    return (
        0.3 * rng.normal(size=(*leading, d)),
        rng.normal(size=(*leading, d)),
        rng.uniform(0.5, 3.0, size=(*leading, m)),
    )


def close(found: Any, wanted: Any, tolerance: float = ROUNDING) -> None:
    np.testing.assert_allclose(found, wanted, rtol=0, atol=tolerance * np.abs(wanted).max())


@pytest.mark.parametrize("mode", ["jacfwd", "jacrev"])
def test_dynamics_and_their_derivatives_both_ways(mode: str) -> None:
    at = states()
    push = cdcr.Wrench(section=1, force=(0.1, 0.2, 0.3))
    f = cdcr.jax.dynamics(ARM, push)
    close(jax.jit(f)(*at), ARM.forward_dynamics(*at, push))
    found = jax.jit(getattr(jax, mode)(f, argnums=(0, 1, 2)))(*at)
    for one, wanted in zip(found, ARM.derivatives(*at, push), strict=False):
        close(one, wanted)


def test_a_batch_is_one_call(monkeypatch: pytest.MonkeyPatch) -> None:
    at = states(5, 3)
    calls = []
    whole = cdcr.Model.forward_dynamics

    def counted(self: Any, *args: Any) -> Any:
        calls.append(np.shape(args[0]))
        return whole(self, *args)

    monkeypatch.setattr(cdcr.Model, "forward_dynamics", counted)
    f = cdcr.jax.dynamics(ARM)
    wanted = whole(ARM, *at)
    close(jax.jit(jax.vmap(jax.vmap(f)))(*at), wanted)
    assert calls == [(15, 6)]
    close(jax.jit(f)(*at), wanted)
    q, qd, u = at
    close(
        jax.vmap(f, in_axes=(1, None, None))(q, qd[0, 0], u[0, 0]).swapaxes(0, 1),
        whole(ARM, q, qd[0, 0], u[0, 0]),
    )
    slopes = jax.jit(jax.vmap(jax.vmap(jax.jacobian(f, argnums=2))))(*at)
    close(slopes, ARM.derivatives(*at).dqdd_dtension)


def test_a_gradient_through_a_motion_is_that_of_the_simulator() -> None:
    q, qd, _ = states()
    pulls = states(6)[2]
    pulls[2, 1] = 0.0
    f = cdcr.jax.step(ARM, 0.02, substeps=3)
    simulator = cdcr.Simulator(ARM, step=0.02, substeps=3)
    start, weight = np.concatenate([q, 0.1 * qd]), np.linspace(-1.0, 1.0, 12)

    def end(pulls: Any) -> Any:
        return weight @ jax.lax.scan(lambda x, u: (f(x, u), None), start, pulls)[0]

    def simulated(pulls: Any) -> float:
        simulator.reset(start[:6], start[6:])
        for u in pulls:
            assert simulator.step(u) is cdcr.Status.ok
        return float(weight @ np.concatenate([simulator.q, simulator.qd]))

    value, slope = map(np.asarray, jax.jit(jax.value_and_grad(end))(pulls))
    assert value == pytest.approx(simulated(pulls), rel=1e-8)
    for at in ((0, 0), (3, 5), (5, 8)):
        change = np.zeros_like(pulls)
        change[at] = 1e-4
        ahead, behind = simulated(pulls + change), simulated(pulls - change)
        assert slope[at] == pytest.approx((ahead - behind) / 2e-4, abs=SMOOTH * abs(slope).max())


def test_a_robot_without_cables_and_no_rows_at_all() -> None:
    section = dataclasses.replace(cdcr.robots.amouri2020().sections[0], cable_angles=())
    bare = cdcr.Model(cdcr.Robot(sections=[section]))
    f, at = cdcr.jax.dynamics(bare), ([0.2, 0.1], [0.3, -0.4], np.zeros(0))
    found = jax.jacobian(f, argnums=(0, 1))(*(jax.numpy.array(one) for one in at))
    for one, wanted in zip(found, bare.derivatives(*at), strict=False):
        close(one, wanted)
    none = (jax.numpy.zeros((0, size)) for size in (6, 6, 9))
    assert cdcr.jax.dynamics(ARM)(*none).shape == (0, 6)


def test_kinematics() -> None:
    q = states(4)[0]
    R, p = jax.jit(cdcr.jax.tip(ARM))(q)
    for found, wanted in zip((R, p), ARM.tip(q), strict=True):
        np.testing.assert_array_equal(found, wanted)
    np.testing.assert_array_equal(cdcr.jax.cable_lengths(ARM)(q=q), ARM.cable_lengths(q))
    step = 1e-5 * np.eye(6)
    for f, of in (
        (lambda x: cdcr.jax.tip(ARM)(x)[0], lambda x: ARM.tip(x)[0]),
        (lambda x: cdcr.jax.tip(ARM)(x)[1], lambda x: ARM.tip(x)[1]),
        (cdcr.jax.cable_lengths(ARM), ARM.cable_lengths),
    ):
        slope = jax.jit(jax.jacrev(f))(q[0])
        ahead, behind = of(q[0] + step), of(q[0] - step)
        close(np.moveaxis(slope, -1, 0), (ahead - behind) / 2e-5, SMOOTH)


def test_states_that_are_none_give_nan() -> None:
    q, qd, u = states(3)
    q[1] *= 100.0
    found = jax.jit(cdcr.jax.dynamics(ARM))(q, qd, u)
    np.testing.assert_array_equal(np.isnan(found).all(axis=1), [False, True, False])
    close(found[::2], ARM.forward_dynamics(q[::2], qd[::2], u[::2]))


def test_refusals() -> None:
    f = cdcr.jax.dynamics(ARM)
    q, qd, u = states()
    with pytest.raises(ValueError, match=r"^q must have shape \(\.\.\., 6\), got \(5,\)$"):
        f(q[:5], qd, u)
    with pytest.raises(ValueError, match=r"^leading dimensions of q, qd, tension must broadcast"):
        f(np.zeros((2, 6)), np.zeros((3, 6)), u)
    with pytest.raises(TypeError, match=r"^dynamics takes \(q, qd, tension\), got arguments 1, qd"):
        f(q, qd=qd)
    with pytest.raises(NotImplementedError, match=r"^cdcr has no second derivatives: JAX asked"):
        jax.hessian(lambda x: f(x, qd, u).sum())(q)
    jax.config.update("jax_enable_x64", False)
    with pytest.raises(ValueError, match=r'^cdcr computes in double.*"jax_enable_x64", True'):
        f(q, qd, u)
    with pytest.raises(ValueError, match=r"^period must be a number > 0 s and finite, got -1"):
        cdcr.jax.step(ARM, -1.0)
