"""Rates of the sliding block, compiled: they are evaluated a million times a second of motion.
Import this where a motion is computed."""

from __future__ import annotations

import numpy as np

from ...core.engine.kernels import compiled

MASS, INERTIA, ARM, SPRING_HEIGHT, STIFFNESS, DAMPING, LOAD, SPEED, SMOOTHING = range(9)
NORMAL, NORMAL_POWER, VISCOUS, VISCOUS_POWER, FRICTION, FRICTION_POWER = range(9, 15)
COUNT = 15
"""Places of the numbers of a block in ``numbers``."""


@compiled
def interface_forces(y, tilt, rate, tilt_rate, numbers, xi, area):  # type: ignore[no-untyped-def]
    """Normal force, its moment, largest friction, and power of the damping of the interface."""
    normal = 0.0
    moment = 0.0
    friction = 0.0
    heat = 0.0
    c, m = numbers[NORMAL], numbers[NORMAL_POWER]
    b, ell = numbers[VISCOUS], numbers[VISCOUS_POWER]
    t, power = numbers[FRICTION], numbers[FRICTION_POWER]
    for i in range(xi.size):
        depth = y - xi[i] * tilt
        if depth > 0.0:
            normal_power = depth * depth if m == 2.0 else depth**m
            viscous_power = normal_power if ell == m else depth**ell
            friction_power = normal_power if power == m else depth**power
            rising = rate - xi[i] * tilt_rate
            elastic = c * normal_power
            damping = max(b * viscous_power * rising, -elastic)
            normal += area[i] * (elastic + damping)
            moment += area[i] * xi[i] * (elastic + damping)
            friction += area[i] * t * friction_power
            heat += area[i] * damping * rising
    return normal, moment, friction, heat


@compiled
def stick_force(moment, held, numbers):  # type: ignore[no-untyped-def]
    """Friction force on the block under which its base keeps the speed of the belt; ``held`` is the
    force of the spring on the block."""
    h, inertia = numbers[ARM], numbers[INERTIA]
    turning = moment - numbers[SPRING_HEIGHT] * held
    return -(held / numbers[MASS] + h * turning / inertia) / (1.0 / numbers[MASS] + h * h / inertia)


@compiled
def block_rates(state, scales, numbers, xi, area, sign):  # type: ignore[no-untyped-def]
    """d/dt of the scaled state x, y, φ, x', y', φ', work supplied, heat.

    ``sign`` is that of the sliding velocity; 0 while the base sticks, 2 for friction that is
    smoothed about a velocity of zero.
    """
    x, y, tilt = state[0] * scales[0], state[1] * scales[1], state[2] * scales[2]
    v, rate, tilt_rate = state[3] * scales[3], state[4] * scales[4], state[5] * scales[5]
    normal, moment, most, heat = interface_forces(y, tilt, rate, tilt_rate, numbers, xi, area)
    sliding = v + numbers[ARM] * tilt_rate - numbers[SPEED]
    held = -numbers[STIFFNESS] * x - numbers[DAMPING] * v
    if sign == 2.0:
        force = -most * sliding / np.sqrt(sliding * sliding + numbers[SMOOTHING] * numbers[SMOOTHING])
    elif sign == 0.0:
        force = stick_force(moment, held, numbers)
    else:
        force = -most * sign
    turning = moment + numbers[ARM] * force - numbers[SPRING_HEIGHT] * held
    rates = np.empty(8)
    rates[0] = v / scales[0]
    rates[1] = rate / scales[1]
    rates[2] = tilt_rate / scales[2]
    rates[3] = (held + force) / numbers[MASS] / scales[3]
    rates[4] = (numbers[LOAD] - normal) / numbers[MASS] / scales[4]
    rates[5] = turning / numbers[INERTIA] / scales[5]
    # the spring pulls at its height without being stretched by the tilt: what that turns into
    # motion is supplied
    rates[6] = (force * numbers[SPEED] - numbers[SPRING_HEIGHT] * held * tilt_rate) / scales[6]
    rates[7] = (heat - force * sliding + numbers[DAMPING] * v * v) / scales[7]
    return rates
