"""Largest stresses in a layer and in its base below rough contacts, from a table of computed ones.

The largest √J₂ lies below the spot of the largest pressure, which is as wide as the surface allows:
λ = rms gradient / rms curvature. Over that pressure it is in the layer a function of two groups
alone, at all loads and grids,

    max √J₂ / p_max = f(E1/E2, h/λ),

and in the base below one of two groups where the layer is thin, and of y and α
beside them where the stresses of many spots add up there,

    max √J₂ / p_max = g(E1/E2, h/λ, y, α).

Both change with Poisson's ratios, by factors that are tabulated over the same two groups. The
script ``validation/predictor_table.py`` writes the tables.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Self

import numpy as np

from ...core.arrays import RealArray
from ...core.scipy_parts import special
from .predictor import LEAST_PIXELS, Curve, Expected, Groups, Row, table, up_to

LAYER_ERROR, HALF_SPACE_ERROR = 0.02, 0.03
"""Relative standard errors of the ratios in a layer, beside its spread over loads and grids, and in
a half-space, beside those of the largest pressure."""

BASE_ERRORS, NEAR = (0.05, 0.13), 3.0
"""That of the ratio in the base up to this h/λ and beyond, where the stresses of several spots add
up: what the curve leaves of contacts that no fit has seen."""

THINNEST = 0.35
"""h/λ from which on √J₂ in the layer is known: a stiff one that is thinner follows the base, and
the ratio falls by two thirds from there to 0.15."""

STRESS_DEGREES, STRESS_TOTAL = (2, 6, 2, 1), 6
"""Highest powers of the logarithms of the groups in the base, and of all together; with more the
fit is closer, and contacts that it has not seen are not."""

NU = 0.3
"""Poisson's ratio of the table."""

UNKNOWN = Expected(math.nan, math.nan, math.nan)


def in_half_space(nu: float, peak: Expected) -> Expected:
    """Largest √J₂ in a half-space of Poisson's ratio ``nu``, where ``peak`` is the largest
    pressure: a polynomial fitted for 0 to 0.49.

    It is 0.96 to 0.92 of that below a Hertzian contact of the same pressure.
    """
    return peak.times(0.432 - 0.325 * nu + 0.06 * nu**2, HALF_SPACE_ERROR)


@dataclass(frozen=True, eq=False)
class Stresses:
    """Largest √J₂ over the largest pressure.

    Attributes
    ----------
    axes
        Logarithms of E1/E2 and of h/λ of the table.
    layer, spread
        Logarithm of the ratio in the layer, and its standard deviation over loads and grids.
    poisson
        Derivatives of the logarithms of both ratios by both Poisson's ratios, such as
        ``"base_nu1"``.
    base, base_scatter
        Logarithm of the ratio in the base, and of its relative standard deviation from one surface
        to the next, as curves.
    loads
        Least and largest y of the table; those of its ends hold beyond.
    """

    axes: tuple[RealArray, RealArray]
    layer: RealArray
    spread: RealArray
    poisson: Mapping[str, RealArray]
    base: Curve
    base_scatter: Curve
    loads: tuple[float, float]

    @classmethod
    def of(cls, rows: Sequence[Row], others: Sequence[Row]) -> Self:
        """Fitted to the ``rows`` of the table that have pixels enough in contact, and to ``others``
        with other Poisson's ratios."""
        rows = [row for row in rows if row["pixels"] >= LEAST_PIXELS]
        ratios, thicknesses = (np.array(sorted({row[name] for row in rows})) for name in ("ratio", "thickness"))
        layer, spread = np.zeros((2, ratios.size, thicknesses.size))
        poisson = {f"{part}_{nu}": np.zeros_like(layer) for part in ("layer", "base") for nu in ("nu1", "nu2")}
        for i, j in np.ndindex(*layer.shape):
            at = [row for row in rows if row["ratio"] == ratios[i] and row["thickness"] == thicknesses[j]]
            logs = np.log([row["layer"] for row in at])
            layer[i, j], spread[i, j] = logs.mean(), logs.std()
            there = [row for row in others if row["ratio"] == ratios[i] and row["thickness"] == thicknesses[j]]
            for key, slopes in poisson.items():
                part, nu = key.split("_")
                low, high = sorted((row for row in there if row[nu] != NU), key=lambda row: row[nu])
                slopes[i, j] = math.log(high[part] / low[part]) / (high[nu] - low[nu])
        at_all = np.array([_variables(**{name: row[name] for name in GROUPS}) for row in rows])
        ratio, sd, count = (np.array([row[name] for row in rows]) for name in ("base", "base_sd", "samples"))
        noise, even = np.hypot(sd / np.sqrt(count), 0.02), np.ones(ratio.size)
        base = Curve.fitted(at_all, np.log(ratio), noise, up_to(STRESS_DEGREES, STRESS_TOTAL))
        half = 0.5 * (count - 1.0)
        spread_logs = np.log(np.maximum(sd, 0.01)) + 0.5 * (np.log(half) - special.psi(half))  # mean of ln s is low
        scatter = Curve.fitted(at_all, spread_logs, even, up_to((1, 3, 2, 1), 3))
        loads = min(row["y"] for row in rows), max(row["y"] for row in rows)
        return cls((np.log(ratios), np.log(thicknesses)), layer, spread, poisson, base, scatter, loads)

    @property
    def thickest(self) -> float:
        """Largest h/λ of the table, below which √J₂ in the base is known."""
        return math.exp(float(self.axes[1][-1]))

    def in_layer(self, groups: Groups, nu: tuple[float, float], peak: Expected) -> Expected:
        """Largest √J₂ in the layer, where ``peak`` is the largest pressure and ``nu`` are Poisson's
        ratios of layer and base; not known of thinner layers than ``THINNEST``."""
        if groups.spots < THINNEST:
            return UNKNOWN
        change = self._of_poisson("layer", groups, nu)
        error = math.hypot(LAYER_ERROR, self._read(self.spread, groups), 0.15 * change)
        return peak.times(math.exp(self._read(self.layer, groups) + change), error)

    def in_base(self, groups: Groups, nu: tuple[float, float], peak: Expected) -> Expected:
        """Largest √J₂ in the base, where ``peak`` is the largest pressure; not known below layers
        thicker than the table has."""
        if groups.spots > self.thickest:
            return UNKNOWN
        thickness = max(groups.spots, math.exp(float(self.axes[1][0])))
        y = min(max(groups.y, self.loads[0]), self.loads[1])
        at = _variables(groups.ratio, thickness, y, groups.nayak)
        value = peak.value * math.exp(self.base(*at) + self._of_poisson("base", groups, nu))
        error = math.hypot(peak.error / peak.value, BASE_ERRORS[int(groups.spots > NEAR)])
        return Expected(value, value * error, value * math.exp(self.base_scatter(*at)))

    def _of_poisson(self, part: str, groups: Groups, nu: tuple[float, float]) -> float:
        slopes = [self._read(self.poisson[f"{part}_{name}"], groups) for name in ("nu1", "nu2")]
        return sum(slope * (value - NU) for slope, value in zip(slopes, nu, strict=True))

    def _read(self, values: RealArray, groups: Groups) -> float:
        """``values`` of the table between its nodes, and at its ends beyond."""
        at = []
        for value, axis in zip((groups.ratio, groups.spots), self.axes, strict=True):
            inside = min(max(math.log(value), float(axis[0])), float(axis[-1]))
            low = min(max(int(np.searchsorted(axis, inside)) - 1, 0), axis.size - 2)
            at.append((low, float((inside - axis[low]) / (axis[low + 1] - axis[low]))))
        (i, a), (j, b) = at
        return float(np.array([1.0 - a, a]) @ values[i : i + 2, j : j + 2] @ np.array([1.0 - b, b]))


GROUPS = ("ratio", "thickness", "y", "nayak")


def _variables(ratio: float, thickness: float, y: float, nayak: float) -> tuple[float, ...]:
    """What the curves are polynomials of."""
    return math.log(ratio), math.log(thickness / 3.0), math.log(y / 0.03), math.log(nayak / 6.0)


@cache
def stresses() -> Stresses:
    """The curves of the tables of this package."""
    return Stresses.of(table("stress"), table("stress_poisson"))
