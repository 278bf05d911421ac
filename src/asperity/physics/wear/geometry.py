"""Worn bodies: surfaces with what they have lost, coatings with what is left of them, and how far
the compliance of one thickness holds."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from ...contact.law import Hardness
from ...contact.problem import ContactProblem
from ...core.arrays import BoolArray, RealArray
from ...solids.compliance.halfspace import contact_compliance
from ...solids.elastic import Elastic
from ...solids.layers import Body, Layer, Layered
from ...surfaces.surface import Surface
from .losses import Doses
from .third_body import ThirdBody

REFRESHED = 0.05
"""Change of the mean worn depth, over the thickness of the layers, from which on the compliance is
that of the thickness that is left."""

UNEVEN = 0.2
"""Standard deviation of the worn depth in the contact, over the thickness that is left, from which
on a compliance of one thickness is doubtful."""

_ROUNDING = 1e-12
"""Share of a thickness below which nothing is left of it."""

SIDES: tuple[Literal["body", "counter"], ...] = ("body", "counter")


@dataclass(frozen=True)
class Thinned:
    """Mean depth (m) of ``body`` and ``counter`` that the compliance takes off their layers."""

    body: float = 0.0
    counter: float = 0.0


def thinned(body: Body, depth: float) -> Body:
    """``body`` without the uppermost ``depth`` (m) of its layers."""
    if not isinstance(body, Layered) or depth <= 0.0:
        return body
    layers: list[Layer] = []
    for layer in body.layers:
        taken = min(depth, layer.thickness)
        depth -= taken
        if layer.thickness > taken:
            layers.append(replace(layer, thickness=layer.thickness - taken))
    return Layered(layers, body.base, body.name)


def thickness(body: Body) -> float:
    """Thickness (m) of all layers of ``body``; zero without."""
    return body.reduced.thickness if isinstance(body, Layered) else 0.0


def mean_taken(depth: RealArray | None, whole: float, pressure: RealArray) -> float:
    """Mean of what the worn ``depth`` (nx, ny) in m takes off layers that are ``whole`` (m) thick,
    weighted by the ``pressure`` (nx, ny)."""
    total = float(pressure.sum())
    return 0.0 if depth is None or total <= 0.0 else float((np.minimum(depth, whole) * pressure).sum()) / total


def followed(problem: ContactProblem, depths: Doses, pressure: RealArray, now: Thinned) -> Thinned:
    """What the compliance takes off the layers of both bodies of the virgin ``problem``: as
    ``now``, or the mean where that has changed enough, or nothing is left."""
    found = []
    for name, body in zip(SIDES, (problem.body, problem.counter_body), strict=True):
        before, whole = getattr(now, name), thickness(body)
        if whole == 0.0:
            found.append(before)
            continue
        mean = mean_taken(getattr(depths, name), whole, pressure)
        if mean >= whole * (1.0 - _ROUNDING):
            mean = before = whole
        found.append(mean if abs(mean - before) > REFRESHED * whole else before)
    return Thinned(*found)


def worn_problem(
    problem: ContactProblem,
    depths: Doses,
    taken: Thinned,
    bare: BoolArray | None,
    debris: ThirdBody | None = None,
) -> ContactProblem:
    """The virgin ``problem`` with surfaces that have lost ``depths`` (m), layers without what is
    ``taken`` off them, the hardness of the base where ``bare``, and ``debris``, which lies on the
    surface of the body."""
    surface, counter = problem.surface, problem.counter_surface
    if depths.body is not None:
        surface = surface.with_heights(surface.heights - depths.body, "worn")
    if depths.counter is not None:
        whole = counter if isinstance(counter, Surface) else surface.with_heights(0.0 * surface.heights, "flat")
        counter = whole.with_heights(whole.heights - depths.counter, "worn")
    physics = problem.physics
    if debris is not None:
        surface = surface.with_heights(surface.heights + debris.thickness, "debris")
        physics = (*physics, debris)
    law = problem.law
    if isinstance(law, Hardness) and bare is not None and bare.any():
        hardness = base_hardness(problem)
        if not math.isnan(hardness):
            law = Hardness(np.where(bare, hardness, law.pressure_cap()))
    return replace(
        problem,
        surface=surface,
        counter_surface=counter,
        body=thinned(problem.body, taken.body),
        counter_body=thinned(problem.counter_body, taken.counter),
        law=law,
        physics=physics,
    )


def base_hardness(problem: ContactProblem) -> float:
    """Hardness (Pa) under the layers of the coated body of ``problem``; NaN where it is not
    known."""
    for body in (problem.body, problem.counter_body):
        if isinstance(body, Layered) and body.reduced.layers and isinstance(body.base, Elastic):
            return body.base.strength.hardness
    return math.nan


@dataclass(frozen=True)
class Unevenness:
    """How unevenly the layers of one body are worn in the contact.

    Attributes
    ----------
    variation
        Standard deviation of the worn depth in the contact over the mean thickness that is left.
    error
        Relative error of the compliance of a wave as long as the contact is wide: half of the
        difference between the thicknesses one standard deviation above and below.
    """

    variation: float
    error: float


def unevenness(problem: ContactProblem, depths: Doses, pressure: RealArray) -> Unevenness:
    """The larger of both bodies of the virgin ``problem``, worn by ``depths`` (m) under
    ``pressure`` (nx, ny) in Pa."""
    worst, touching = Unevenness(0.0, 0.0), pressure > 0.0
    if not touching.any():
        return worst
    width = math.sqrt(float(np.count_nonzero(touching)) * problem.grid.pixel_area)
    wave = np.array([2.0 * math.pi / width])
    bodies = [problem.body, problem.counter_body]
    for number, name in enumerate(SIDES):
        depth, whole = getattr(depths, name), thickness(bodies[number])
        if depth is None or whole == 0.0:
            continue
        left = np.maximum(whole - depth[touching], 0.0)
        spread, mean = float(left.std()), float(left.mean())
        variation = spread / mean if mean > 0.0 else math.inf if spread > 0.0 else 0.0
        values = []
        for at in (mean + spread, max(mean - spread, 0.0)):
            changed = list(bodies)
            changed[number] = thinned(bodies[number], whole - at)
            values.append(float(contact_compliance(changed[0], changed[1]).spectral(wave)[0]))
        error = abs(values[0] - values[1]) / (values[0] + values[1])
        worst = max(worst, Unevenness(variation, error), key=lambda item: item.variation)
    return worst
