"""Compiled sweeps over nested cells that end at the cells of one level, whose true compliance is a convolution A.

With S and T what the levels below pass up for given and for unit loads, the loads f on the cells follow from
(1/T + A) f = S/T, and the deflections are d = A f = (S - f)/T. Nested cells from there on up give a guess d0 and hence
f0 = S - T d0, whose residual is d0 - A f0; one step of conjugate gradients follows, preconditioned by nested cells again.

``tower`` holds what ``cell_kernels`` has of one hierarchy (levels, weights, g and s) and the number of the level; ``fields``
for each cell of the level T, d0, the direction t of the step over T, and what goes into a product with A and comes out of it.
"""

from __future__ import annotations

import numpy as np

from .cell_kernels import COLUMNS, ROWS, START, STRIDE, bounce, collect, fall, rise
from .kernels import compiled

UNIT, GUESS, STEP, FIELD, RESPONSE = range(5)


@compiled
def take(level, s, unit):  # type: ignore[no-untyped-def]
    """unit = s of the level."""
    for cell in range(level[ROWS]):
        base = level[START] + cell * level[STRIDE]
        for j in range(level[COLUMNS]):
            unit[cell, j] = s[base + j]


@compiled
def begin(tower, shape, rows, index, values, fields):  # type: ignore[no-untyped-def]
    """Guess by nested cells under the loads ``values`` of points; f0 goes into a product."""
    levels, weights, g, s, depth = tower
    unit, guess, field = fields[UNIT], fields[GUESS], fields[FIELD]
    collect(levels[1], shape, rows, index, values, s)
    rise(levels, 1, depth, g, s)
    take(levels[depth], s, field)
    bounce(levels, weights, depth, g, s)
    level = levels[depth]
    for cell in range(level[ROWS]):
        base = level[START] + cell * level[STRIDE]
        for j in range(level[COLUMNS]):
            guess[cell, j] = s[base + j]
            field[cell, j] -= unit[cell, j] * s[base + j]


@compiled
def improve(tower, fields):  # type: ignore[no-untyped-def]
    """A f0 came out of the product, t goes into the next; its product with the residual is returned."""
    levels, weights, g, s, depth = tower
    unit, guess, step, field, response = fields[UNIT], fields[GUESS], fields[STEP], fields[FIELD], fields[RESPONSE]
    level = levels[depth]
    for cell in range(level[ROWS]):
        base = level[START] + cell * level[STRIDE]
        for j in range(level[COLUMNS]):
            residual = guess[cell, j] - response[cell, j]
            step[cell, j] = residual
            s[base + j] = unit[cell, j] * residual
    bounce(levels, weights, depth, g, s)
    product = 0.0
    for cell in range(level[ROWS]):
        base = level[START] + cell * level[STRIDE]
        for j in range(level[COLUMNS]):
            residual = step[cell, j]
            direction = residual - s[base + j]
            t = unit[cell, j] * direction
            product += np.float64(t) * residual
            step[cell, j] = direction
            field[cell, j] = t
    return product


@compiled
def finish(tower, fields, product):  # type: ignore[no-untyped-def]
    """A t came out of the product: deflections d0 - length t / T, spread down to the finest cells."""
    levels, weights, g, s, depth = tower
    guess, step, field, response = fields[GUESS], fields[STEP], fields[FIELD], fields[RESPONSE]
    level = levels[depth]
    curvature = 0.0
    for cell in range(level[ROWS]):
        for j in range(level[COLUMNS]):
            curvature += np.float64(field[cell, j]) * (step[cell, j] + response[cell, j])
    length = s.dtype.type(product / curvature if curvature > 0.0 else 0.0)
    for cell in range(level[ROWS]):
        base = level[START] + cell * level[STRIDE]
        for j in range(level[COLUMNS]):
            s[base + j] = guess[cell, j] - length * step[cell, j]
    fall(levels, weights, depth, 1, g, s)
