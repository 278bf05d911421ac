"""The one layer by which a table of contacts is read for bodies with layers."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.scipy_parts import optimize
from ...core.words import in_words
from ...solids.compliance.halfspace import contact_compliance
from ...solids.elastic import Elastic, Rigid
from ...solids.layers import Body, Bonded, Layer, Layered

LAYER_NU = (0.2, 0.4)
"""Poisson's ratios of layers and base between which the factors of a layer hold."""

UNLIKE_LAYER = 0.1
"""Rms of the logarithm of the compliance of several layers over that of the one layer, above which
it does not stand for them."""

OF_SEVERAL = (0.025, 0.3)
"""Relative standard error by several layers, and how it grows with that rms: of ten bodies of two
and three layers the area is at most 5 % off where the rms is below 0.1, 7 to 20 % off at 0.2."""

WAVES = 60
"""Wavenumbers at which compliances are compared."""


class OneLayer(NamedTuple):
    """E1/E2 and ``thickness`` in m of a layer, 1 and inf without one, and the relative standard
    ``error`` with which it stands for several."""

    ratio: float
    thickness: float
    error: float


def one_layer(body: Body, counter_body: Body, length: float, grid: Grid) -> OneLayer:
    """The layer of the bodies, or the one whose compliance is nearest to that of several.

    Near counts over the waves of the ``grid``, by the gradient of a surface with an exponential
    autocorrelation of the 10 % ``length`` in m.

    Raises
    ------
    InputError
        If the bodies are others than those of the table, or no layer is near to theirs.
    """
    bodies = [one.bare if isinstance(one, Layered) else one for one in (body, counter_body)]
    layered = [one for one in bodies if isinstance(one, Layered) and one.layers]
    solve = f"Solve it: {in_words('{solve}')}."
    bases = [one.base if isinstance(one, Layered) else one for one in bodies]
    if not all(isinstance(one, Elastic | Rigid) for one in bases):
        raise InputError(f"bodies of a prediction must be elastic half-spaces below their layers, but are not. {solve}")
    if not layered:
        return OneLayer(1.0, math.inf, 0.0)
    if len(layered) > 1 or not any(isinstance(one, Rigid) for one in bodies):
        raise InputError(
            "bodies of a prediction must be half-spaces, or layers on a half-space against a rigid surface, but have "
            f"layers on both or a soft counter body. {solve}"
        )
    whole = layered[0]
    for layer in whole.layers:
        if not isinstance(layer.interface, Bonded) or not isinstance(layer.material, Elastic):
            raise InputError(f"layer of a prediction must be homogeneous, elastic and bonded, but is not. {solve}")
    materials = [*(layer.material for layer in whole.layers), whole.base]
    if not all(isinstance(material, Elastic) for material in materials):
        raise InputError(f"base of a prediction must be elastic, but is not. {solve}")
    for material in materials:
        nu = getattr(material, "poisson_ratio", math.nan)
        if not LAYER_NU[0] <= nu <= LAYER_NU[1]:
            raise InputError(
                f"Poisson's ratios of a layer and its base must be from {LAYER_NU[0]} to {LAYER_NU[1]} for a "
                f"prediction, but one is {nu:g}. {solve}"
            )
    if len(whole.layers) > 1:
        return _equivalent(whole, length, grid)
    only = whole.layers[0]
    return OneLayer(_modulus(only.material) / _modulus(whole.base), only.thickness, 0.0)


def _modulus(material: object) -> float:
    return float(getattr(material, "youngs_modulus", math.nan))


def _equivalent(body: Layered, length: float, grid: Grid) -> OneLayer:
    """The one layer on the base of ``body`` whose compliance is nearest."""
    sides = [n * pixel for n, pixel in zip(grid.shape, grid.spacing, strict=True)]
    q = np.geomspace(2.0 * math.pi / max(sides), 1.2 * math.pi / min(grid.spacing), WAVES)
    decay = length / math.log(10.0)
    weights = np.sqrt(q**3 * (1.0 + (q * decay) ** 2) ** -1.5)
    wanted, base = np.log(contact_compliance(body, Rigid()).spectral(q)), _modulus(body.base)
    first = body.layers[0]

    def off(logs: RealArray) -> RealArray:
        ratio, thickness = np.exp(logs)
        material = replace(first.material, youngs_modulus=float(ratio) * base)
        one = Layered([Layer(material, float(thickness) * length)], base=body.base)
        return np.asarray(weights * (np.log(contact_compliance(one, Rigid()).spectral(q)) - wanted))

    total = sum(layer.thickness for layer in body.layers) / length
    begins = [
        (_modulus(first.material) / base, first.thickness / length),
        (_modulus(first.material) / base, total),
        (_modulus(body.layers[-1].material) / base, total),
    ]
    low, high = np.log([0.1, 0.01]), np.log([12.0, 20.0])
    fits = [
        optimize.least_squares(off, np.clip(np.log(begin), low + 0.01, high - 0.01), bounds=(low, high))
        for begin in begins
    ]
    best = min(fits, key=lambda fit: float(fit.cost))
    rms = math.sqrt(2.0 * float(best.cost) / float(np.sum(weights**2)))
    if rms > UNLIKE_LAYER:
        raise InputError(
            "layers of a prediction must be about as compliant as one layer, within "
            f"{UNLIKE_LAYER:g} of the logarithm, but are {rms:.2g} off. Solve it: {in_words('{solve}')}."
        )
    ratio, thickness = np.exp(best.x)
    return OneLayer(float(ratio), float(thickness) * length, OF_SEVERAL[0] + OF_SEVERAL[1] * rms)
