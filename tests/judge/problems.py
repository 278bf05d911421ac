"""Random problems over all physics of a contact, each the same for the same seed.

What is known beforehand to have no solution is not made: loads above the hardness, positions beyond
full contact, tangential forces above friction.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from judge import heights

import asperity as asp
from asperity.contact.controls import Control
from asperity.core.arrays import RealArray
from asperity.physics.rolling.rolling import Rolling
from asperity.solids.layers import Body

KINDS = (
    *("normal", "layered", "hardness", "wet", "adhesive", "stick-slip", "rolling", "in time", "plastic flow"),
    *("normal", "layered", "hardness", "wet", "adhesive", "stick-slip", "in time"),
    *("normal", "layered", "hardness", "normal"),
)
"""Kinds of problems by seed, again and again: each at least one in twenty."""

DECADES = (-13.0, 1.0)
"""Powers of ten of the mean pressure over E* times the slope of the surface."""


@dataclass(frozen=True, eq=False)
class Rolled:
    """What rolls: creepage, direction, method."""

    creepage: asp.rolling.Creepage
    direction: Rolling = "x"
    method: Any = "direct"


@dataclass(frozen=True, eq=False)
class Case:
    """A problem with the steps of its history, of which the last one of a rolling contact is the
    only one."""

    seed: int
    kind: str
    problem: asp.ContactProblem
    steps: tuple[asp.Step, ...]
    time_steps: asp.TimeSteps = field(default_factory=asp.TimeSteps)
    rolled: Rolled | None = None


def problem(seed: int) -> Case:
    """Random problem of the ``seed``."""
    kind = KINDS[seed % len(KINDS)]
    return MAKERS[kind](seed, np.random.default_rng([seed, 29]))


# Parts of problems.


def _log(rng: np.random.Generator, low: float, high: float) -> float:
    return float(10.0 ** rng.uniform(low, high))


def _chosen(rng: np.random.Generator, options: tuple[Any, ...]) -> Any:
    return options[rng.integers(len(options))]


def _shape(rng: np.random.Generator, largest: int, *, line: float = 0.15) -> tuple[int, int]:
    """Up to ``largest`` points a side, most of them few; one point wide with the probability
    ``line``."""
    nx, ny = (round(4.0 * (0.25 * largest) ** rng.random()) for _ in range(2))
    return nx, 1 if rng.random() < line else ny


def _boundary(rng: np.random.Generator, shape: tuple[int, int], body: Body) -> asp.Periodic | asp.Free | asp.FreeLine:
    if shape[1] == 1 and rng.random() < 0.5:
        return asp.FreeLine()
    return asp.Free() if rng.random() < 0.5 else asp.Periodic()


def _surface(
    rng: np.random.Generator,
    shape: tuple[int, int],
    shapes: tuple[Callable[..., RealArray], ...],
    slope: tuple[float, float],
    *,
    periodic: bool = False,
) -> asp.Surface:
    """Surface of random pixels, 1 nm to 1 mm wide, of 1 : 4 to 4 : 1, with a largest difference of
    neighbours over pixels of ten to the powers ``slope``."""
    pixel = _log(rng, -9.0, -3.0)
    dy = pixel * float(rng.choice([1.0, 1.0, 0.25, 0.7, 4.0]))
    found = _chosen(rng, shapes)(rng, shape)
    return asp.Surface(found * (pixel * _log(rng, *slope)), pixel, dy, periodic=periodic)


def _elastic(rng: np.random.Generator, *, most: float = 0.5) -> asp.Elastic:
    """Young's modulus of 1 kPa to 1 TPa, Poisson's ratio 0 to 1/2."""
    return asp.Elastic(_log(rng, 3.0, 12.0), min(float(rng.choice([0.0, 0.3, 0.5, rng.uniform(0.0, 0.5)])), most))


def slope_of(surface: asp.Surface) -> float:
    """Range of the heights over the longer side of the grid, or one for flat surfaces."""
    heights_range = float(np.ptp(surface.heights))
    scale = heights_range / max(surface.grid.pixels)
    flat_ = heights_range <= 1e-12 * float(np.abs(surface.heights).max(initial=0.0))
    return 1.0 if flat_ or scale == 0.0 else scale


def _load(rng: np.random.Generator, mean: float, grid: asp.Grid) -> Control:
    return asp.Force(mean * grid.area) if rng.random() < 0.3 else asp.MeanPressure(mean)


def _position(rng: np.random.Generator, surface: asp.Surface, boundary: object, depth: tuple[float, float]) -> Control:
    """Approach or mean gap nearer than first touch by ten to the powers ``depth`` of the way to
    full contact of rigid bodies."""
    heights_ = np.asarray(surface.heights)
    touch = float(heights_.max() - heights_.mean())
    closer = touch * _log(rng, *depth)
    if rng.random() < 0.5:
        return asp.MeanGap(touch - closer)
    return asp.Approach(closer)


def _is_flat(surface: asp.Surface) -> bool:
    heights_ = np.asarray(surface.heights)
    return bool(np.ptp(heights_) <= 1e-6 * np.abs(heights_).max(initial=0.0))


def _control(
    rng: np.random.Generator, surface: asp.Surface, modulus: float, boundary: object, decades: tuple[float, float]
) -> Control:
    """A load over these ``decades`` of ``modulus`` times slope, or a position."""
    if rng.random() < 0.3 and not _is_flat(surface):
        return _position(rng, surface, boundary, (-5.0, -0.05))
    return _load(rng, modulus * slope_of(surface) * _log(rng, *decades), surface.grid)


def _counter(rng: np.random.Generator, body: Body) -> Body:
    if rng.random() < 0.7 or not isinstance(body, asp.Elastic):
        return asp.Rigid()
    return asp.Elastic(body.youngs_modulus * _log(rng, -2.0, 2.0), float(rng.uniform(0.0, 0.49)))


# Normal contact, layers, hardness.


def _normal(seed: int, rng: np.random.Generator) -> Case:
    shape = _shape(rng, 32)
    surface = _surface(rng, shape, heights.ALL, (-6.0, 0.5))
    body = _elastic(rng)
    boundary = _boundary(rng, shape, body)
    posed = asp.ContactProblem(surface, body, counter_body=_counter(rng, body), boundary=boundary)
    if rng.random() < 0.15:
        other = surface.with_heights(rng.uniform(0.1, 2.0) * np.asarray(surface.heights)[::-1], "counter surface")
        posed = asp.ContactProblem(surface, asp.Rigid(), other, body, boundary)
        surface = surface.with_heights(posed.profile(), "composite")
    controls = [_control(rng, surface, posed.contact_modulus, boundary, DECADES) for _ in range(rng.integers(1, 3))]
    return Case(seed, "normal", posed, tuple(map(asp.Step, controls)))


def layered_body(rng: np.random.Generator, pixel: float, *, least: float = -2.5) -> asp.Layered:
    """One to three layers, softer or stiffer by up to thousand times, a hundredth to a hundred
    pixels thick, on a half-space or a rigid base."""
    base = _elastic(rng, most=0.49)
    modulus = base.youngs_modulus
    layers = [
        asp.Layer(
            asp.Elastic(modulus * _log(rng, least, 2.5), float(rng.uniform(0.0, 0.49))),
            pixel * _log(rng, -1.5, 2.0),
            asp.Frictionless() if rng.random() < 0.1 else asp.solids.Bonded(),
        )
        for _ in range(rng.integers(1, 4))
    ]
    return asp.Layered(layers, asp.RigidBase() if rng.random() < 0.2 else base)


def _layered(seed: int, rng: np.random.Generator) -> Case:
    shape = _shape(rng, 24)
    surface = _surface(rng, shape, heights.ALL, (-6.0, 0.0))
    body = layered_body(rng, max(surface.grid.pixels))
    boundary = _boundary(rng, shape, body)
    if body.slips and not isinstance(boundary, asp.Periodic):
        boundary = asp.Periodic()
    posed = asp.ContactProblem(surface, body, boundary=boundary)
    control = _control(rng, surface, posed.contact_modulus, boundary, DECADES)
    return Case(seed, "layered", posed, (asp.Step(control),))


def _strong(material: asp.Elastic, hardness: float) -> asp.Elastic:
    return asp.Elastic(material.youngs_modulus, material.poisson_ratio, asp.Strength(hardness=hardness))


def _hardness(seed: int, rng: np.random.Generator) -> Case:
    """A number, a map, or that of a coated body; loaded, unloaded and loaded again, or to a
    position."""
    shape = _shape(rng, 24)
    surface = _surface(rng, shape, heights.ALL, (-4.0, 0.0))
    body: Body = _elastic(rng)
    boundary = _boundary(rng, shape, body)
    size = asp.ContactProblem(surface, body).contact_modulus * slope_of(surface)
    hard = size * _log(rng, -2.0, 1.0)
    law: Any = asp.Hardness(hard)
    if rng.random() < 0.3:
        law = asp.Hardness(hard * rng.uniform(0.3, 3.0, shape))
    elif rng.random() < 0.3 and isinstance(body, asp.Elastic):
        thickness = max(float(np.ptp(surface.heights)), 1e-3 * surface.grid.spacing[0]) * _log(rng, -1.0, 1.0)
        film = _strong(
            asp.Elastic(body.youngs_modulus * _log(rng, -0.5, 0.5), min(body.poisson_ratio, 0.49)),
            hard * _log(rng, -0.3, 0.3),
        )
        body = asp.Layered([asp.Layer(film, thickness)], _strong(body, hard))
        law = asp.plasticity.LayeredHardness(body)
    bearable = float(np.mean(law.pressure_cap()))
    if isinstance(law, asp.plasticity.LayeredHardness):
        bearable = min(bearable, law.base_hardness)
    posed = asp.ContactProblem(surface, body, boundary=boundary, law=law)
    if rng.random() < 0.2 and not _is_flat(surface):
        return Case(seed, "hardness", posed, (asp.Step(_position(rng, surface, boundary, (-4.0, -0.5))),))
    controls: list[Control] = []
    for _ in range(rng.integers(1, 5)):
        unloads = controls and rng.random() < 0.25 and not isinstance(controls[-1], asp.Unloaded)
        mean = min(bearable * _log(rng, -6.0, -0.05), size * 10.0)
        controls.append(asp.Unloaded() if unloads else _load(rng, mean, surface.grid))
    return Case(seed, "hardness", posed, tuple(map(asp.Step, controls)))


# Films of liquid and adhesion.


def _wet(seed: int, rng: np.random.Generator) -> Case:
    """Films of a hundredth to the whole of the roughness; menisci that pull by a millionth to a
    hundredth of E* times the slope."""
    shape = _shape(rng, 24)
    surface = _surface(rng, shape, (heights.rough, heights.waves, heights.sphere), (-4.0, 0.0))
    body = _elastic(rng)
    boundary = _boundary(rng, shape, body)
    modulus, slope = asp.ContactProblem(surface, body).contact_modulus, slope_of(surface)
    thickness = float(np.ptp(surface.heights)) * _log(rng, -2.0, -0.5)
    suction = modulus * slope * _log(rng, -6.0, -2.0)
    height = thickness * rng.uniform(1.0, 3.0)
    angles = (0.0, float(rng.uniform(0.0, 1.0)))
    factor = math.cos(angles[0]) + math.cos(angles[1])
    film = asp.LiquidFilm(
        surface_tension=suction * height / factor,
        thickness=thickness,
        meniscus_height=height,
        contact_angles=angles,
    )
    posed = asp.ContactProblem(surface, body, boundary=boundary, film=film)
    if rng.random() < 0.2:
        return Case(seed, "wet", posed, (asp.Step(_position(rng, surface, boundary, (-3.0, -0.2))),))
    loads = [suction * _log(rng, -3.0, 4.0) for _ in range(rng.integers(1, 4))]
    controls = [_load(rng, load, surface.grid) for load in loads]
    if rng.random() < 0.1:
        controls.append(asp.Unloaded())
    return Case(seed, "wet", posed, tuple(map(asp.Step, controls)))


def adhesion_law(rng: np.random.Generator, modulus: float, pixel: float, slope: float) -> asp.ContactProblem | Any:
    """Law of a range of a hundredth to three pixels, whose cohesive length spans half a pixel to a
    hundred."""
    reach = pixel * min(slope, 1.0) * _log(rng, -1.0, 0.5)
    length = pixel * _log(rng, 0.3, 2.0)
    strength = modulus * reach / length
    work = strength * reach
    laws: tuple[Callable[[], Any], ...] = (
        lambda: asp.ExponentialAdhesion(work, reach),
        lambda: asp.adhesion.LinearAdhesion(work, reach),
        lambda: asp.adhesion.DugdaleAdhesion(work, reach),
        lambda: asp.adhesion.DugdaleAdhesion(work, reach, smoothing=1.0),
        lambda: asp.adhesion.DugdaleAdhesion(work, reach, smoothing=0.0),
        lambda: asp.adhesion.VanDerWaalsAdhesion(work, 2.0 * reach, reach=8.0 * reach),
        lambda: asp.adhesion.VanDerWaalsAdhesion(work, 2.0 * reach),
        lambda: asp.adhesion.LennardJonesAdhesion(work, reach),
        lambda: asp.adhesion.JKRAdhesion(work),
        lambda: asp.adhesion.CustomAdhesion(
            of_gap=lambda g: strength * np.exp(-g / reach),
            energy_of_gap=lambda g: -work * np.exp(-g / reach),
            slope_of_gap=lambda g: -strength / reach * np.exp(-g / reach),
            far=30.0 * reach,
        ),
    )
    return _chosen(rng, laws)()


def _adhesive(seed: int, rng: np.random.Generator) -> Case:
    """Loads, grips that press and pull, machines with a spring; every law."""
    shape = _shape(rng, 16)
    surface = _surface(rng, shape, heights.GENTLE, (-3.0, 0.0))
    body = _elastic(rng)
    boundary = _boundary(rng, shape, body)
    modulus, slope, grid = asp.ContactProblem(surface, body).contact_modulus, slope_of(surface), surface.grid
    law = adhesion_law(rng, modulus, max(grid.pixels), slope)
    wall: Any = asp.plasticity.HardWall()
    if law.spacing == 0.0 and not isinstance(law, asp.adhesion.JKRAdhesion) and rng.random() < 0.2:
        wall = asp.Hardness(max(modulus * slope, 2.0 * law.strength) * _log(rng, 0.0, 1.0))
    posed = asp.ContactProblem(surface, body, boundary=boundary, adhesion=law, law=wall)
    range_ = float(np.ptp(surface.heights))
    touch = float(np.max(surface.heights) - np.mean(surface.heights))
    deepest = 0.5 * touch if isinstance(boundary, asp.Periodic) else range_
    controls: list[Control] = []
    drawn = rng.random()
    if drawn < 0.1:
        controls = [
            asp.MeanGap(touch * (1.0 - _log(rng, -2.0, -0.5))) if law.spacing == 0.0 else asp.Approach(0.3 * deepest)
        ]
    elif drawn < 0.5:
        stiffness = math.inf if rng.random() < 0.7 else modulus * math.sqrt(grid.area) * _log(rng, -1.0, 2.0)
        places = [deepest * rng.uniform(0.05, 1.0), deepest * rng.uniform(0.05, 1.0), -deepest * rng.uniform(0.0, 0.3)]
        controls += [asp.FixedGrips(float(place), stiffness) for place in places[: rng.integers(1, 4)]]
    else:
        size = modulus * slope
        controls += [_load(rng, size * _log(rng, -6.0, -0.3), grid) for _ in range(rng.integers(1, 4))]
        if rng.random() < 0.3:
            point = min(law.strength, math.sqrt(law.work * modulus / max(grid.pixels))) * grid.pixel_area
            controls.append(asp.contact.Pull(1e-2 * point) if rng.random() < 0.5 else asp.Unloaded())
    return Case(seed, "adhesive", posed, tuple(map(asp.Step, controls)))


# Friction.


def friction_law(rng: np.random.Generator, mean: float, shape: tuple[int, int]) -> Any:
    """Coulomb's law with a number, a map or a limit, a constant strength, or full stick, of a
    contact under the ``mean`` pressure."""
    mu = float(rng.uniform(0.05, 0.8))
    laws: tuple[Callable[[], Any], ...] = (
        lambda: asp.Coulomb(mu),
        lambda: asp.Coulomb(mu),
        lambda: asp.Coulomb(mu * rng.uniform(0.5, 1.5, shape)),
        lambda: asp.Coulomb(mu, limit=mean * _log(rng, -0.5, 1.0)),
        lambda: asp.friction.TrescaFriction(mean * _log(rng, -1.0, 0.5)),
        asp.friction.FullStick,
    )
    return _chosen(rng, laws)()


def _pair(rng: np.random.Generator, pixel: float, *, coupled: bool) -> tuple[Body, Body]:
    """Bodies whose shear moves the surfaces up and down, or not; some are coated, in layers of more
    than a third of a ``pixel`` (m)."""
    body: Body = _elastic(rng, most=0.49)
    if rng.random() < 0.1:
        coated = layered_body(rng, 10.0 * pixel, least=-1.0)
        body = asp.Layered([asp.Layer(each.material, each.thickness) for each in coated.layers[:2]], coated.base)
    if not coupled:
        return body, body
    return body, asp.Rigid() if rng.random() < 0.5 else _counter(rng, body)


def _stick_slip(seed: int, rng: np.random.Generator) -> Case:
    """A load, then shifts or forces there and back; or everything slides."""
    shape = _shape(rng, 16)
    surface = _surface(rng, shape, heights.GENTLE, (-3.0, -0.3))
    bodies = _pair(rng, max(surface.grid.pixels), coupled=rng.random() < 0.5)
    boundary = _boundary(rng, shape, bodies[0])
    bare = asp.ContactProblem(surface, bodies[0], counter_body=bodies[1], boundary=boundary)
    slope = slope_of(surface)
    mean = bare.contact_modulus * slope * _log(rng, -6.0, -0.5)
    law = friction_law(rng, mean, shape)
    if isinstance(law, asp.friction.TrescaFriction | asp.friction.FullStick) and bodies[1] != bodies[0]:
        bodies = (
            bodies[0],
            bodies[0],
        )  # a point that bears shear as soon as it touches may have no solution where shear opens it
    posed = asp.ContactProblem(surface, bodies[0], counter_body=bodies[1], boundary=boundary, friction=law)
    grid = surface.grid
    normal, coefficient = _load(rng, mean, grid), getattr(law, "coefficient", None)
    angle = rng.uniform(0.0, 2.0 * np.pi)
    x, y = math.cos(angle), math.sin(angle)
    if isinstance(law, asp.Coulomb) and law.limit == math.inf and rng.random() < 0.2:
        sliding = asp.Coulomb(law.coefficient, direction=float(angle))
        slid = asp.ContactProblem(surface, bodies[0], counter_body=bodies[1], boundary=boundary, friction=sliding)
        return Case(seed, "stick-slip", slid, (asp.Step(normal),))
    steps = [asp.Step(normal, asp.Shift())]
    by_force = coefficient is not None and getattr(law, "limit", math.inf) == math.inf and rng.random() < 0.4
    most = 0.0 if coefficient is None else float(np.min(coefficient)) * mean * grid.area
    length = float(np.ptp(surface.heights)) * _log(rng, -3.0, 0.0)
    for _ in range(rng.integers(1, 4)):
        share = float(rng.uniform(-0.95, 0.95))
        if by_force:
            steps.append(asp.Step(normal, asp.TangentialForce(share * most * x, share * most * y)))
        else:
            twist = 0.0
            if isinstance(boundary, asp.Free) and rng.random() < 0.3:
                twist = share * length / max(grid.size)
            steps.append(asp.Step(normal, asp.Shift(share * length * x, share * length * y, twist)))
    return Case(seed, "stick-slip", posed, tuple(steps))


def _rolling(seed: int, rng: np.random.Generator) -> Case:
    """Balls and rollers of many pixels, with creepage and spin."""
    nx = int(rng.integers(6, 18))
    line = rng.random() < 0.3
    shape = nx, 1 if line else int(rng.integers(6, 18))
    pixel = _log(rng, -7.0, -3.0)
    x, y = ((np.arange(n) - 0.5 * (n - 1)) * pixel for n in shape)
    radius = pixel * _log(rng, 2.0, 4.0)
    shape_ = -(x[:, None] ** 2 + (0.0 if line else 1.0) * rng.uniform(0.5, 2.0) * y[None, :] ** 2) / (2.0 * radius)
    surface = asp.Surface(shape_, pixel, pixel)
    bodies = _pair(rng, pixel, coupled=rng.random() < 0.4)
    boundary = asp.FreeLine() if line else asp.Free()
    mu = float(rng.uniform(0.05, 0.6))
    width = pixel * min(shape[0], shape[1] if shape[1] > 1 else nx)
    half = 0.4 * width * rng.uniform(0.3, 1.0)
    bare = asp.ContactProblem(surface, bodies[0], counter_body=bodies[1], boundary=boundary)
    modulus = bare.contact_modulus
    mean = modulus * half / radius * 0.2
    law: Any = asp.Coulomb(mu) if rng.random() < 0.8 else asp.friction.TrescaFriction(mu * modulus * half / radius)
    if isinstance(law, asp.friction.TrescaFriction):
        bodies = bodies[0], bodies[0]
    posed = asp.ContactProblem(surface, bodies[0], counter_body=bodies[1], boundary=boundary, friction=law)
    size = mu * half / radius
    creepage = asp.rolling.Creepage(
        size * float(rng.uniform(-3.0, 3.0)),
        size * float(rng.uniform(-3.0, 3.0)),
        0.0 if line or rng.random() < 0.5 else size / half * float(rng.uniform(-2.0, 2.0)),
    )
    direction: Rolling = "x" if line else _chosen(rng, ("x", "-x", "y", "-y"))
    method = "transient" if rng.random() < 0.15 else "direct"
    control = asp.Approach(half**2 / radius) if rng.random() < 0.2 else asp.MeanPressure(mean)
    return Case(seed, "rolling", posed, (asp.Step(control),), rolled=Rolled(creepage, direction, method))


# Time and plastic flow.


def _in_time(seed: int, rng: np.random.Generator) -> Case:
    """Ramps and holds of solids with one to three relaxation times, some of a fluid; equal steps of
    time or those by the error."""
    shape = _shape(rng, 12)
    surface = _surface(rng, shape, heights.GENTLE, (-3.0, -0.3))
    modulus, nu = _log(rng, 3.0, 10.0), float(rng.uniform(0.0, 0.5))
    time = _log(rng, -3.0, 4.0)
    count = int(rng.integers(1, 4))
    shares = rng.dirichlet(np.ones(count + 1))[:count] * rng.uniform(0.3, 0.99)
    spectrum = tuple((float(share), time * _log(rng, -1.0, 1.0)) for share in shares)
    if rng.random() < 0.1:
        body: asp.Viscoelastic = asp.Viscoelastic.maxwell(modulus, time, nu)
    else:
        body = asp.Viscoelastic(modulus, nu, spectrum=spectrum, elastic_bulk=nu < 0.45 and rng.random() < 0.3)
    boundary = _boundary(rng, shape, body)
    posed = asp.ContactProblem(surface, body, boundary=boundary)
    size = posed.contact_modulus * slope_of(surface)
    shortest = min((lam for _, lam in body.spectrum), default=time)
    by_error = rng.random() < 0.3
    placed = rng.random() < 0.25
    touch = float(np.max(surface.heights) - np.mean(surface.heights))
    mean = touch * _log(rng, -2.0, -1.0) if placed else size * _log(rng, -6.0, -0.5)
    control: type[asp.Approach | asp.MeanPressure] = asp.Approach if placed else asp.MeanPressure
    steps = [asp.Step(control(mean), duration=time * _log(rng, -1.5, 0.7) if by_error else 0.0)]
    for _ in range(rng.integers(1, 4)):
        before, parts = mean, 1 if by_error else 8
        if rng.random() < 0.6:  # else it is held
            mean *= _log(rng, 0.0 if placed else -0.5, 0.4)
        duration = 0.0 if rng.random() < 0.1 else (time if by_error else shortest) * _log(rng, -1.5, 0.7)
        loads = [before + (mean - before) * (part / parts) for part in range(1, parts)]
        steps += [asp.Step(control(each), duration=duration / parts) for each in [*loads, mean]]
    return Case(seed, "in time", posed, tuple(steps), asp.TimeSteps() if by_error else asp.TimeSteps(number=1))


def _plastic_flow(seed: int, rng: np.random.Generator) -> Case:
    """Balls and waves on solids that harden, loaded past yield and unloaded."""
    n = int(rng.integers(6, 13))
    shape = n, n if rng.random() < 0.6 else int(rng.integers(6, 13))
    boundary = asp.Free() if rng.random() < 0.6 else asp.Periodic()
    shapes: tuple[Callable[..., RealArray], ...] = (heights.sphere, heights.waves)
    surface = _surface(rng, shape, shapes, (-3.0, -1.5))
    solid = _elastic(rng, most=0.45)
    size = asp.ContactProblem(surface, solid).contact_modulus * slope_of(surface)
    yield_stress = size * _log(rng, -1.5, 0.0)
    hardening: Any = asp.plasticity.LinearHardening(yield_stress, solid.youngs_modulus * rng.uniform(0.01, 0.3))
    if rng.random() < 0.3:
        hardening = asp.plasticity.Voce(
            yield_stress, yield_stress * rng.uniform(0.2, 1.0), float(rng.uniform(5.0, 50.0))
        )
    kinematic = solid.youngs_modulus * float(rng.uniform(0.01, 0.1)) if rng.random() < 0.3 else 0.0
    law = asp.plasticity.J2(solid, hardening, kinematic)
    body: Body = solid
    laws: Any = law
    if rng.random() < 0.3:
        film = asp.Elastic(solid.youngs_modulus * _log(rng, -0.5, 0.7), 0.3)
        body = asp.Layered([asp.Layer(film, max(surface.grid.spacing) * _log(rng, -0.5, 0.7))], solid)
        own = asp.plasticity.J2(film, asp.plasticity.LinearHardening(2.0 * yield_stress, 0.1 * film.youngs_modulus))
        laws = (own if rng.random() < 0.5 else None, law)
    flow = asp.PlasticFlow(laws, cells=8)
    friction = asp.Coulomb(float(rng.uniform(0.05, 0.3)), coupled=False) if rng.random() < 0.2 else None
    posed = asp.ContactProblem(surface, body, boundary=boundary, plastic_flow=flow, friction=friction)
    mean = yield_stress * float(rng.uniform(0.05, 0.8))
    steps: list[asp.Step] = [asp.Step(asp.MeanPressure(mean))]
    if rng.random() < 0.2:
        touch = float(np.max(surface.heights) - np.mean(surface.heights))
        steps = [asp.Step(asp.Approach(0.2 * touch) if rng.random() < 0.5 else asp.MeanGap(0.8 * touch))]
    if rng.random() < 0.5:
        steps.append(asp.Step(asp.Unloaded() if rng.random() < 0.5 else asp.MeanPressure(0.3 * mean)))
    if rng.random() < 0.3:
        steps.append(asp.Step(asp.MeanPressure(mean * float(rng.uniform(0.5, 1.2)))))
    return Case(seed, "plastic flow", posed, tuple(steps))


MAKERS: dict[str, Callable[[int, np.random.Generator], Case]] = {
    "normal": _normal,
    "layered": _layered,
    "hardness": _hardness,
    "wet": _wet,
    "adhesive": _adhesive,
    "stick-slip": _stick_slip,
    "rolling": _rolling,
    "in time": _in_time,
    "plastic flow": _plastic_flow,
}
