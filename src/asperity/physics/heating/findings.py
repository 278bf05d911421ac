"""What should be known before the temperatures of a sliding contact are used."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ...core.status import Advice
from ...core.units import percent, show
from ...solids.elastic import Rigid, yield_pressure
from ...solids.layers import surface_material
from .answer import FrictionalHeating

FEWEST = 5.0
"""Pixels across the hottest spot from which on its temperature is trusted: at 16 pixels the maximum
errs by 0.2 % on a smooth spot, by a few percent at 5."""

CONTINUUM = 100e-9
"""Radius in m of spots below which carriers of heat cross them without a collision: their free path
is 10 to 50 nm in metals, up to 1 µm in crystals that insulate."""

NEEDLE = 1.05
"""Pressure over that at which a material yields from which on the peaks are too sharp."""


def findings(found: FrictionalHeating) -> tuple[Advice, ...]:
    """All of them, for a contact that makes heat."""
    return tuple(_all(found)) if found.rubs else ()


def _all(found: FrictionalHeating) -> Iterator[Advice]:
    problem, grid = found.problem, found.problem.grid
    if any(isinstance(body, Rigid) for body in (problem.body, problem.counter_body)):
        fact = "The rigid body takes no heat: all of it goes into the other one, and the temperatures are upper bounds."
        yield Advice("note", "rigid body and heat", fact)
    across = found.pixels_across
    if across < FEWEST:
        yield Advice(
            "warning",
            "pixels of the hottest spot",
            f"The hottest spot is {across:.2g} pixels wide: its temperature follows the pixels.",
            "Take a finer grid ({resample}).",
            {"pixels": across, "fewest": FEWEST},
            ("flash_",),
        )
    yield from _sampled(found)
    yield from _needles(found)
    radius = found.spot_radius
    if 0.0 < radius < CONTINUUM:
        yield Advice(
            "warning",
            "free path of heat",
            f"The hottest spot has a radius of {show(radius, 'm', 2)}, less than the free path of what carries heat in "
            "many solids: it is hotter than Fourier's law has it.",
            "Add 4/3 of the free path over the conductivity as a resistance ({heating.resistance_body=1e-9m^2*K/W}).",
            {"radius": radius, "least": CONTINUUM},
            ("flash_",),
        )
    length, critical = max(n * d for n, d in zip(grid.shape, grid.spacing, strict=True)), found.critical_wavelength
    if length > critical:
        yield Advice(
            "warning",
            "thermoelastic instability",
            f"The contact is {show(length, 'm', 3)} long, and pressures of sliding surfaces grow by thermal expansion "
            f"beyond {show(critical, 'm', 3)}: there is no steady contact.",
            "Take a smaller patch or a lower speed ({heating.speed=0.1m/s}).",
            {"length": length, "critical": critical},
        )
    elif length > 0.1 * critical:
        yield Advice(
            "note",
            "thermoelastic bulge",
            f"Thermal expansion changes the pressures by some {percent(length / critical, 1)}, which is left out.",
            numbers={"length": length, "critical": critical},
        )


def _sampled(found: FrictionalHeating) -> Iterator[Advice]:
    """Pixels against the heated depth, where the kernel is sampled by waves."""
    if not all(found.problem.boundary.wraps) or not found.spot_radius:
        return
    peclet = found.spot_peclet
    depth = found.spot_radius / math.sqrt(peclet) if peclet else math.inf
    width = max(found.problem.grid.pixels)
    if width > depth:
        yield Advice(
            "warning",
            "heated depth",
            f"Heat reaches {show(depth, 'm', 2)} deep while a spot passes, less than a pixel: waves of the grid do not "
            "resolve that.",
            "Take a finer grid ({resample}) or {free}, whose pixels are exact.",
            {"depth": depth, "pixel": width},
            ("flash_",),
        )


def _needles(found: FrictionalHeating) -> Iterator[Advice]:
    """Peaks of the pressure that no material bears."""
    problem = found.problem
    if np.isfinite(np.asarray(problem.law.pressure_cap())).all():
        return
    materials = [surface_material(body) for body in (problem.body, problem.counter_body)]
    known = [yield_pressure(material.strength).value for material in materials if material is not None]
    limits = [value for value in known if value is not None]
    speed = found.motion.speed
    mu = found.friction
    if not limits or not speed or not mu:
        return
    highest = float(found.heat.max()) / (mu * speed)
    if highest > NEEDLE * min(limits):
        yield Advice(
            "warning",
            "peaks without a hardness",
            f"Pressures reach {show(highest, 'Pa', 3)} where a surface yields at {show(min(limits), 'Pa', 3)}: the "
            "peaks make more heat than they can.",
            "Limit the pressure ({hardness}).",
            {"pressure": highest, "hardness": min(limits)},
            ("flash_",),
        )
