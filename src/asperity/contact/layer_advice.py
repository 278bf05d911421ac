"""Checks of layer thickness against pixel and period."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ..core.status import Advice
from ..core.units import show
from ..solids.elastic import Elastic
from ..solids.layers import Layered, materials_of
from .laws import LimitByDepth
from .problem import ContactProblem

PIXELS_PER_LAYER = 1.0
"""A pressure that varies from pixel to pixel (wavelength 2 pixels) reaches exp(-pi) = 4 % deep into a layer of one
pixel.
"""

LARGEST_THICKNESS = 0.5
"""Thickness over period at which the longest wave has decayed to (1 + pi) exp(-pi) = 18 % of its pressure below the
layers.
"""


def layer_advice(problem: ContactProblem) -> Iterator[Advice]:
    """Layers thinner than a pixel, or so thick that the base hardly matters in a periodic cell; softer ones below."""
    for body in (problem.body, problem.counter_body):
        if isinstance(body, Layered):
            yield from _against_pixel(problem, body.reduced)
            yield from _against_period(problem, body.reduced)
            yield from _softer_below(problem, body.reduced)


def _against_pixel(problem: ContactProblem, body: Layered) -> Iterator[Advice]:
    grid = problem.grid
    pixel = max((step for step, n in zip(grid.spacing, grid.shape, strict=True) if n > 1), default=grid.spacing[0])
    thin = [layer for layer in body.layers if layer.thickness < PIXELS_PER_LAYER * pixel]
    if thin:
        least = min(layer.thickness for layer in thin)
        count = f"{len(thin)} layers are" if len(thin) > 1 else "A layer is"
        yield Advice(
            "note",
            "layer against pixel",
            f"{count} thinner than a pixel (the thinnest {least / pixel:.2g} pixels, at least {PIXELS_PER_LAYER:g} wanted): "
            "deflections of resolved waves are right, but peak pressures and stresses on the scale of the layer are not "
            "resolved. Refine the grid to the scale of the layer.",
        )


def _against_period(problem: ContactProblem, body: Layered) -> Iterator[Advice]:
    """The longest wave along an axis that wraps; a base as soft as the layers makes no difference and goes unsaid."""
    lengths = [
        problem.grid.size[axis] for axis in (0, 1) if problem.boundary.wraps[axis] and problem.grid.shape[axis] > 1
    ]
    if not lengths or not body.layers:
        return
    share = body.thickness / max(lengths)
    if share > LARGEST_THICKNESS and _differs(body):
        yield Advice(
            "note",
            "layer against period",
            f"The layers are {share:.2g} of the period thick (more than {LARGEST_THICKNESS:g}): even the longest wave hardly "
            "reaches the base, whose material then makes little difference. Use a larger map, or the free boundary for a "
            "single contact.",
        )


def _softer_below(problem: ContactProblem, body: Layered) -> Iterator[Advice]:
    """A pressure limit does not describe yield below the surface, where a softer material may yield first."""
    if isinstance(problem.law, LimitByDepth):
        return
    limit = float(np.max(problem.law.pressure_cap()))
    surface, *below = (part.strength.hardness for part in materials_of(body))
    if math.isfinite(limit) and any(hardness < min(limit, surface) for hardness in below):
        yield Advice(
            "note",
            "softer layers below",
            f"The pressure is limited to {show(limit, 'Pa')} at the surface, but a material below it has a hardness of only "
            f"{show(min(h for h in below if h == h), 'Pa')}: under contacts wide against the layers it yields first, at a "
            "lower pressure. Limit the pressure by the effective hardness, LayeredHardness(body) (--hardness effective), or compute "
            "the stresses, which give the load factor of each layer.",
        )


def _differs(body: Layered) -> bool:
    """Whether the base is of another plane-strain modulus than the lowest layer."""
    base = body.base.plane_strain_modulus if isinstance(body.base, Elastic) else math.inf
    return base != body.layers[-1].material.plane_strain_modulus
