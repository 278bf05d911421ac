"""Area, largest pressure and gap of rough contacts from a table of solved ones.

With s the rms pressure of full contact of the body as it is layered,

    s² = Σ |h(q)|²/c(q)²,        y = p/s,

areas and pressures of all loads, moduli and layers nearly fall on curves of y and of Nayak's
bandwidth α. Gaps live on longer waves and follow

    X = p β/(E σ ε),        ε = Σ |h|² q^(-1/2)/c / Σ |h|² q^(-1/2)/c_base,

where β is the 10 % length, σ the rms height and E the contact modulus of the base. What is left of
a layer at equal y is a factor that is tabulated over E1/E2, h/β and α. The script
``validation/predictor_table.py`` writes the tables.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources
from types import MappingProxyType
from typing import Self, TypeAlias

import numpy as np

from ...core.arrays import RealArray
from ...core.scipy_parts import special

HEIGHTS = (0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0)
"""Heights over the rms height at which the share of the area below them is tabulated."""

PERIMETER = (math.pi - 1.0 + math.log(2.0)) / 24.0
"""Area in pixels between counted pixels and the contact, per edge between a pixel in contact and
one outside (Yastrebov, Anciaux & Molinari 2017)."""

SLACK = 0.03
"""Share by which groups may leave the ranges of the table: those of one pixel differ so much with
the size of the map."""

LEAST_PIXELS = 20.0
"""Pixels in contact below which a row of the table is not used, and nothing is predicted."""

FULLEST = 0.97
"""Share of area in contact above which the curve of the area is not fitted: it holds no digits."""

LEAST_GAP = 0.3
"""Mean gap over the rms height below which nothing is said of the share of small gaps."""

BELOW_ERROR = 0.04
"""Relative error of the share of small gaps at a given mean gap."""

LAYERED_GAP = 0.03
"""Standard error of the gap over the rms height that a layer adds, per unit of the logarithm of its
modulus over that of the base."""

CAPPED: Mapping[str, tuple[float, float]] = MappingProxyType({"area_pixels": (2.1, 0.035), "area": (1.75, 0.06)})
"""Power n of the factor (1 + uⁿ)^(1/n) on the elastic area under a hardness H, u = p/(H A) with the
counted share A, and the relative error that it leaves of half-spaces and layers up to u = 1.5."""

CAPPED_RANGE, MOST_CAPPED, CAPPED_BEYOND = 2.5, 0.8, 0.15
"""Largest u and mean pressure over hardness of the contacts behind it, and the relative error of
the area without pixels beyond u = 1.5."""

CAPPED_GAP = 0.6
"""u up to which a hardness lowers the mean gap by less than 0.05 rms heights."""

Row: TypeAlias = Mapping[str, float]
Powers: TypeAlias = tuple[tuple[int, ...], ...]


@dataclass(frozen=True)
class Expected:
    """A predicted number, in the unit of its ``value``.

    Attributes
    ----------
    value
        Mean over surfaces of the same statistics.
    error
        Standard error of that mean, by what the curves and factors leave of the table.
    scatter
        Standard deviation from one surface to the next.
    """

    value: float
    error: float
    scatter: float

    @property
    def band(self) -> tuple[float, float]:
        """Where the number of one surface lies in 19 of 20 cases, from zero on."""
        reach = 2.0 * math.hypot(self.error, self.scatter)
        return max(0.0, self.value - reach), self.value + reach

    def below(self, limit: float) -> Expected:
        """The number where it cannot exceed ``limit``, whose band ends there."""
        value, reach = min(self.value, limit), 2.0 * math.hypot(self.error, self.scatter)
        share = min(1.0, (limit - value) / reach) if reach else 1.0
        return Expected(value, self.error * share, self.scatter * share)

    def times(self, factor: float, error: float = 0.0) -> Expected:
        """Multiplied by a ``factor`` > 0 with a relative standard ``error``."""
        value = self.value * factor
        return Expected(value, math.hypot(self.error * factor, value * error), self.scatter * factor)


@dataclass(frozen=True)
class Groups:
    """What a contact is known by, all without dimension.

    Attributes
    ----------
    y
        Mean pressure over the rms pressure of full contact.
    X
        Mean pressure times 10 % length over contact modulus of the base, rms height and ε.
    nayak
        Bandwidth α.
    size, points
        Side over the 10 % length; pixels of the whole map.
    ratio, thickness
        E1/E2 of a layer, 1 without one, and its thickness over the 10 % length.
    spots
        The thickness over λ, rms gradient over rms curvature of the surface.
    """

    y: float
    X: float
    nayak: float
    size: float
    points: int
    ratio: float = 1.0
    thickness: float = math.inf
    spots: float = math.inf


@dataclass(frozen=True)
class Range:
    """Values of the group ``name`` between which the table holds."""

    name: str
    low: float
    high: float

    def holds(self, value: float) -> bool:
        """Whether ``value`` is within, or a little beyond."""
        return self.low * (1.0 - SLACK) <= value <= self.high * (1.0 + SLACK)


@dataclass(frozen=True, eq=False)
class Curve:
    """Polynomial in a few variables fitted to a column of the table; ``error`` is the rms of what
    it leaves."""

    powers: Powers
    coefficients: RealArray
    error: float

    @classmethod
    def fitted(cls, variables: RealArray, values: RealArray, errors: RealArray, powers: Powers) -> Self:
        """Least squares of ``values`` with standard ``errors`` at ``variables`` (rows)."""
        terms, weights = _terms(variables, powers), 1.0 / errors
        found = np.linalg.lstsq(terms * weights[:, None], values * weights, rcond=None)[0]
        left = (terms @ found - values) * weights
        return cls(powers, found, math.sqrt(float(left @ left / (weights @ weights))))

    def __call__(self, *variables: float) -> float:
        """Value at one point."""
        return float(_terms(np.array([variables]), self.powers)[0] @ self.coefficients)


def _terms(variables: RealArray, powers: Powers) -> RealArray:
    return np.stack([np.prod(variables ** np.array(power), axis=1) for power in powers], axis=1)


def up_to(degrees: tuple[int, ...], total: int) -> Powers:
    """Exponents of monomials: each at most its own of the ``degrees``, their sum at most
    ``total``."""
    return tuple(power for power in np.ndindex(*(degree + 1 for degree in degrees)) if sum(power) <= total)


def table(name: str) -> list[dict[str, float]]:
    """Rows of the table ``name``: ``master``, ``layer``, ``stress`` or ``stress_poisson``."""
    text = resources.files("asperity").joinpath("data", "predictor", f"{name}.csv").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]


MIDDLE, LAYER_LOADS = 0.02, (0.002, 0.5)
"""Mean pressure over that of full contact at which the factors of a layer are tabulated, beside
their slope over its logarithm, and between which the slope holds."""

LAYER_AXES = ("nayak", "ratio", "thickness")


@dataclass(frozen=True, eq=False)
class Factors:
    """Factors of one layer at equal y, by interpolation in the logarithms of bandwidth, modulus
    ratio and thickness."""

    axes: tuple[RealArray, ...]
    values: Mapping[str, RealArray]

    @classmethod
    def of(cls, rows: Sequence[Row]) -> Self:
        """Factors in the ``rows`` of the table of layers; a ratio of one has a factor of one."""
        axes = [sorted({row[name] for row in rows} | ({1.0} if name == "ratio" else set())) for name in LAYER_AXES]
        values = {}
        for name in ("area", "area_pixels", "peak"):
            for key, bare in ((name, 1.0), (f"{name}_slope", 0.0), (f"{name}_sd", 0.0)):
                values[key] = np.full([len(axis) for axis in axes], bare)
                for row in rows:
                    place = tuple(axis.index(row[of]) for axis, of in zip(axes, LAYER_AXES, strict=True))
                    values[key][place] = row[key]
        return cls(tuple(np.log(axis) for axis in axes), values)

    def at(self, groups: Groups, name: str) -> tuple[float, float]:
        """Factor on the quantity ``name``, and its relative standard error, by what the slope
        leaves of the loads."""
        weights, places = [], []
        for value, axis in zip((groups.nayak, groups.ratio, groups.thickness), self.axes, strict=True):
            inside = min(max(math.log(value), float(axis[0])), float(axis[-1]))
            low = min(max(int(np.searchsorted(axis, inside)) - 1, 0), axis.size - 2)
            share = (inside - axis[low]) / (axis[low + 1] - axis[low])
            weights.append(np.array([1.0 - share, share]))
            places.append(slice(low, low + 2))
        cube = np.einsum("i,j,k->ijk", *weights)
        middle, slope, error = (
            float(np.sum(cube * self.values[key][tuple(places)])) for key in (name, f"{name}_slope", f"{name}_sd")
        )
        load = min(max(groups.y, LAYER_LOADS[0]), LAYER_LOADS[1])
        return middle * math.exp(slope * math.log10(load / MIDDLE)), error


@dataclass(frozen=True, eq=False)
class Predictor:
    """Curves of the contacts of Gaussian rough surfaces on a half-space, and factors of a layer."""

    curves: Mapping[str, Curve]
    scatters: Mapping[str, Curve]
    factors: Factors
    ranges: tuple[Range, ...]
    samples: float
    """Surfaces per row of the table."""

    @classmethod
    def of(cls, master: Sequence[Row], layer: Sequence[Row]) -> Self:
        """Fitted to the tables of contacts on a half-space and of factors of a layer."""
        rows = [row for row in master if row["area_pixels"] * row["points"] ** 2 >= LEAST_PIXELS]
        at = np.array([_variables(row["y"], row["nayak"], row["size"]) for row in rows])
        column = {key: np.array([row[key] for row in rows]) for key in rows[0]}
        error = {
            name: column[f"{name}_sd"] / np.sqrt(column["samples"]) for name in ("area", "area_pixels", "peak", "gap")
        }
        curves, scatters = {}, {}
        for name in ("area", "area_pixels"):
            used = column[name] < FULLEST
            area = column[name][used]
            slope = np.log(2.0 / math.sqrt(math.pi) * special.erfinv(area) / column["y"][used])
            curves[name] = Curve.fitted(
                at[used, :2], slope, np.hypot(error[name][used] / area, 0.005), up_to((4, 2), 4)
            )
            scatters[name] = _scatter(at[used], column[f"{name}_sd"][used] / area)
        peak, gap = column["peak"], column["gap"]
        curves["peak"] = Curve.fitted(at, np.log(peak), np.hypot(error["peak"] / peak, 0.01), up_to((3, 2, 1), 3))
        scatters["peak"] = _scatter(at, column["peak_sd"] / peak)
        of_load = np.stack([np.log10(column["X"]), at[:, 1]], axis=1)
        curves["gap"] = Curve.fitted(of_load, gap, np.hypot(error["gap"], 0.01), up_to((5, 2), 5))
        scatters["gap"] = _scatter(at, column["gap_sd"])
        of_gap = np.stack([gap, at[:, 1]], axis=1)
        for height in HEIGHTS:
            share = column[f"below_{height:g}"] / (1.0 - column["area_pixels"])
            used = (share > 1e-4) & (share < 1.0 - 1e-4) & (gap > LEAST_GAP)
            even = np.ones(int(used.sum()))
            curves[_below(height)] = Curve.fitted(of_gap[used], special.ndtri(share[used]), even, up_to((5, 2), 5))
        return cls(curves, scatters, Factors.of(layer), _ranges(column, layer), float(np.median(column["samples"])))

    def outside(self, groups: Groups) -> list[tuple[Range, float]]:
        """Ranges of the table that ``groups`` leave, each with the value."""
        values = {"y": groups.y, "nayak": groups.nayak, "size": groups.size}
        if groups.ratio != 1.0:
            values |= {"ratio": groups.ratio, "thickness": groups.thickness, "nayak, layered": groups.nayak}
        found = [(one, values[one.name]) for one in self.ranges if one.name in values]
        return [(one, value) for one, value in found if not one.holds(value)]

    def area(self, groups: Groups, name: str = "area") -> Expected:
        """Share of the area in contact: ``"area"`` freed of the pixels, ``"area_pixels"``
        counted."""
        variables = _variables(groups.y, groups.nayak, groups.size)
        argument = 0.5 * math.sqrt(math.pi) * math.exp(self.curves[name](*variables[:2])) * groups.y
        share = math.erf(argument)
        # by how much the share changes with the logarithm of the slope
        change = 2.0 / math.sqrt(math.pi) * math.exp(-(argument**2)) * argument
        scatter = share * math.exp(self.scatters[name](*variables))
        error = math.hypot(change * self.curves[name].error, self._of_few(scatter))
        return self._layered(Expected(share, error, scatter), groups, name)

    def peak(self, groups: Groups) -> Expected:
        """Largest pressure of a pixel over the rms pressure of full contact."""
        variables = _variables(groups.y, groups.nayak, groups.size)
        value = math.exp(self.curves["peak"](*variables))
        scatter = value * math.exp(self.scatters["peak"](*variables))
        error = math.hypot(value * self.curves["peak"].error, self._of_few(scatter))
        return self._layered(Expected(value, error, scatter), groups, "peak")

    def gap(self, groups: Groups) -> Expected:
        """Mean gap over the rms height."""
        variables = _variables(groups.y, groups.nayak, groups.size)
        value = max(0.0, self.curves["gap"](math.log10(groups.X), variables[1]))
        scatter = math.exp(self.scatters["gap"](*variables))
        error = math.hypot(self.curves["gap"].error, self._of_few(scatter))
        return Expected(value, math.hypot(error, LAYERED_GAP * math.log(groups.ratio)), scatter)

    def share_below(self, groups: Groups, height: float) -> Expected:
        """Share of the area where the surfaces do not touch and the gap is at most ``height`` times
        the rms height."""
        gap, pixels = self.gap(groups), self.area(groups, "area_pixels").value
        bandwidth = _variables(groups.y, groups.nayak, groups.size)[1]

        def share(of_gap: float) -> float:
            values = [self.curves[_below(one)](of_gap, bandwidth) for one in HEIGHTS]
            return (1.0 - pixels) * float(special.ndtr(np.interp(height, HEIGHTS, values)))

        value = share(gap.value)
        slope = abs(share(gap.value + 0.01) - value) / 0.01
        return Expected(value, math.hypot(slope * gap.error, BELOW_ERROR * value), slope * gap.scatter)

    def _of_few(self, scatter: float) -> float:
        """Standard error of a mean in the table, of surfaces that ``scatter`` so."""
        return scatter / math.sqrt(self.samples)

    def _layered(self, found: Expected, groups: Groups, name: str) -> Expected:
        return found if groups.ratio == 1.0 else found.times(*self.factors.at(groups, name))


def capped(found: Expected, u: float, name: str) -> Expected:
    """The elastic share ``found`` of the area, ``"area"`` or ``"area_pixels"``, under a hardness of
    1/u times the mean real pressure."""
    if not math.isfinite(found.value):
        return found
    power, error = CAPPED[name]
    if name == "area" and u > 1.5:
        error = CAPPED_BEYOND
    follows = 1.0 / (1.0 + u**power)  # d ln A/d ln A of the elastic contact: none once A is p/H
    factor = (1.0 + u**power) ** (1.0 / power)
    value = min(1.0, found.value * factor)
    own = math.hypot(found.error / found.value * follows, error * min(1.0, u / 0.3))
    return Expected(value, value * own, value * follows * found.scatter / found.value)


def of_shape(found: Expected, y: float, skewness: float, excess: float, name: str) -> Expected:
    """The ``found`` area, ``"peak"`` or ``"gap"`` (over the rms height) with the standard error of
    heights that are not Gaussian, of this skewness and kurtosis less 3.

    It is what surfaces of given skewness and kurtosis, made by translation of Gaussian ones, are
    off.
    """
    low = math.log10(0.2 / y)
    if name == "peak":
        of_skewness, of_excess = 0.9, 0.8
    elif name == "gap":
        of_skewness, of_excess = max(0.05, 0.55 * low), max(0.05, 0.17 * low)
    else:
        of_skewness, of_excess = max(0.1, 0.27 + 0.33 * low), max(0.05, 0.05 + 0.33 * low)
    more = math.hypot(of_skewness * skewness, of_excess * excess) * (1.0 if name == "gap" else found.value)
    return Expected(found.value, math.hypot(found.error, more), found.scatter)


def _below(height: float) -> str:
    return f"below_{height:g}"


def _variables(y: float, nayak: float, size: float) -> tuple[float, float, float]:
    """What the curves are polynomials of."""
    return math.log10(y / 0.01), math.log10(nayak / 6.0), math.log10(size / 20.0)


def _scatter(variables: RealArray, values: RealArray) -> Curve:
    """Curve of the logarithm of standard deviations from surface to surface."""
    return Curve.fitted(variables, np.log(np.maximum(values, 1e-4)), np.ones(values.size), up_to((2, 1, 1), 2))


LARGEST_SIZE = 160.0
"""Largest side over the 10 % length: the peak grows with the logarithm of the area, which the table
shows up to 40."""


def _ranges(master: Mapping[str, RealArray], layer: Sequence[Row]) -> tuple[Range, ...]:
    ends = {name: [row[name] for row in layer] for name in LAYER_AXES}
    return (
        *(Range(name, float(master[name].min()), float(master[name].max())) for name in ("y", "nayak")),
        Range("size", float(master["size"].min()), LARGEST_SIZE),
        Range("ratio", min(ends["ratio"]), max(ends["ratio"])),
        Range("thickness", min(ends["thickness"]), math.inf),
        Range("nayak, layered", 0.0, max(ends["nayak"])),
    )


@cache
def predictor() -> Predictor:
    """The curves and factors of the tables of this package."""
    return Predictor.of(table("master"), table("layer"))
