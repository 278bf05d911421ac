"""Random heights of the judge's problems: rough, stepped, with plateaus, ties and spikes, smooth,
flat, from far below to far above a pixel."""

from __future__ import annotations

import numpy as np

from asperity.core.arrays import RealArray


def rough(rng: np.random.Generator, shape: tuple[int, int]) -> RealArray:
    return rng.standard_normal(shape)


def ties(rng: np.random.Generator, shape: tuple[int, int]) -> RealArray:
    return np.round(rng.standard_normal(shape))


def plateau(rng: np.random.Generator, shape: tuple[int, int]) -> RealArray:
    found = np.zeros(shape)
    found[: rng.integers(1, shape[0] + 1), : rng.integers(1, shape[1] + 1)] = 1.0
    return found


def cut_off(rng: np.random.Generator, shape: tuple[int, int]) -> RealArray:
    return np.minimum(rng.standard_normal(shape), rng.uniform(-0.5, 1.0))


def spike(rng: np.random.Generator, shape: tuple[int, int]) -> RealArray:
    found = 0.01 * rng.standard_normal(shape)
    found[rng.integers(shape[0]), rng.integers(shape[1])] += 1.0
    return found


def steps(rng: np.random.Generator, shape: tuple[int, int]) -> RealArray:
    return np.asarray((np.arange(shape[0])[:, None] // 3 + np.arange(shape[1])[None, :] // 2) % 3, dtype=float)


def sphere(rng: np.random.Generator, shape: tuple[int, int]) -> RealArray:
    x, y = ((np.arange(n) - 0.5 * (n - 1) + rng.uniform(-0.5, 0.5)) / max(n, 2) for n in shape)
    return -4.0 * (x[:, None] ** 2 + y[None, :] ** 2)


def waves(rng: np.random.Generator, shape: tuple[int, int]) -> RealArray:
    x, y = (2.0 * np.pi * np.arange(n) / n for n in shape)
    return np.cos(x + rng.uniform(0.0, 6.0))[:, None] + np.cos(y + rng.uniform(0.0, 6.0))[None, :]


def nearly_flat(rng: np.random.Generator, shape: tuple[int, int]) -> RealArray:
    return 1.0 + 10.0 ** rng.uniform(-12.0, -3.0) * rng.standard_normal(shape)


def flat(rng: np.random.Generator, shape: tuple[int, int]) -> RealArray:
    return np.full(shape, rng.choice([0.0, 1e-7, 1.0]))


GENTLE = (rough, cut_off, sphere, waves, ties)
"""Shapes of the problems with other physics than the normal contact."""

ALL = (rough, ties, plateau, cut_off, spike, steps, sphere, waves, nearly_flat, flat)
