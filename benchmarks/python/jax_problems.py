"""The models in JAX, in double precision, for one point."""

from __future__ import annotations

import jax

jax.config.update("jax_enable_x64", True)
import jax.numpy as jnp  # noqa: E402


def plane_step(x):
    w = x[..., 4]
    s, c = jnp.sin(w), jnp.cos(w)
    a, b = s / w, (1.0 - c) / w
    x0, x1, x2, x3 = (x[..., i] for i in range(4))
    return jnp.stack([x0 + a * x1 - b * x3, c * x1 - s * x3, x2 + b * x1 + a * x3, s * x1 + c * x3, w], -1)


def plane_radar(x):
    return jnp.stack([jnp.sqrt(x[..., 0] ** 2 + x[..., 2] ** 2), jnp.arctan2(x[..., 2], x[..., 0])], -1)


def space_drift(x):
    zero = jnp.zeros_like(x[..., 0])
    parts = [x[..., 1], -x[..., 6] * x[..., 3], x[..., 3], x[..., 6] * x[..., 1], x[..., 5], zero, zero]
    return jnp.stack(parts, -1)


def space_radar(x):
    ground = jnp.sqrt(x[..., 0] ** 2 + x[..., 2] ** 2)
    range_ = jnp.sqrt(ground**2 + x[..., 4] ** 2)
    return jnp.stack([range_, jnp.arctan2(x[..., 2], x[..., 0]), jnp.arctan2(x[..., 4], ground)], -1)


def circle_drift(x):
    return (jnp.roll(x, -1, -1) - jnp.roll(x, 2, -1)) * jnp.roll(x, 1, -1) - x + 8.0


def rk4(f, x, gap, substeps):
    h = gap / substeps

    def step(_, x):
        k1 = f(x)
        k2 = f(x + 0.5 * h * k1)
        k3 = f(x + 0.5 * h * k2)
        k4 = f(x + h * k3)
        return x + (h / 6.0) * (k1 + 2 * k2 + 2 * k3 + k4)

    return jax.lax.fori_loop(0, substeps, step, x) if substeps > 1 else step(0, x)


def space_step(x):
    return rk4(space_drift, x, 4.0, 16)


def circle_step(x):
    return rk4(circle_drift, x, 0.05, 1)


def circle_radar(x):
    return x[..., ::2]
