"""Models as functions of JAX, under jit, vmap, grad and jacobian. Extra ``jax``, on processors.

First derivatives are exact, by `Model.derivatives`, forward and reverse; there are no second ones.
They compute in double precision, so that ``jax_enable_x64`` has to be on.

Examples
--------
>>> import cdcr.jax
>>> import jax
>>> import jax.numpy as jnp
>>> jax.config.update("jax_enable_x64", True)
>>> model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
>>> step = cdcr.jax.step(model, 0.05)
>>> def missed(tensions):  # how far from rest at 0.2 rad, after so many periods
...     x, _ = jax.lax.scan(lambda x, now: (step(x, now), None), jnp.zeros(4), tensions)
...     return jnp.sum((x - jnp.array([0.2, 0.0, 0.0, 0.0])) ** 2)
>>> slope = jax.jit(jax.grad(missed))(jnp.full((10, 3), 2.0))
>>> slope.shape
(10, 3)
"""
# ruff: noqa: E402 - the extra is asked for before its first import, so that one sentence says so

from cdcr.base.extras import require

require("jax", "jax")

from cdcr.jax._functions import cable_lengths, dynamics, step, tip

__all__ = ["cable_lengths", "dynamics", "step", "tip"]
