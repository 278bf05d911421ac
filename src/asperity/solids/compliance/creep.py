"""Normal compliance of viscoelastic bodies in time: c(q, t) = c_0(q) + sum c_k(q) (1 -
exp(-t/lambda_k)) + c_f(q) t.

c_0 is the compliance at the first instant. Where all moduli relax alike, and of homogeneous bodies,
all c_k are multiples of c_0 (``SharedCreep``). Else the response of the layers to oscillating
pressure is computed with complex moduli, and a series fitted to it at each wavenumber with one set
of times for all (``LayeredCreep``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import BoolArray, ComplexArray, RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ..elastic import Elastic
from ..layers import Body, Layered, deformable, materials_of, relaxes
from ..relaxation import Creep, merged
from ..viscoelastic import Viscoelastic, alike
from .halfspace import Compliance, contact_compliance
from .influence import (
    Limits,
    line_kernel,
    patch_coefficients,
    point_kernel,
    strip_coefficients,
    wavenumber_grid,
    wavenumbers,
)
from .layered import PlaneCompliance, Samples, operational_moduli, operational_plane
from .retardation_fit import fitted, fitted_planes
from .tensor import (
    SurfaceTensor,
    coupling_pixels_of,
    coupling_strips_of,
    shear_pixels_of,
    shear_strips_of,
    summed_planes,
    tensor_of,
)


@dataclass(frozen=True)
class SharedCreep:
    """Creep of bodies whose compliance grows by the same factor at all wavenumbers.

    ``ratio``: creep over the instantaneous compliance, J(t)/J(0), without unit.
    """

    ratio: Creep

    @property
    def times(self) -> RealArray:
        """Retardation time (s) of each term; infinite for that of a fluid, which comes last."""
        taus = [lam for _, lam in self.ratio.terms]
        return np.array([*taus, *([math.inf] if self.ratio.fluidity else [])])

    @property
    def shares(self) -> RealArray:
        """c_k/c_0 of each term, in 1/s that of a fluid."""
        strengths = [strength for strength, _ in self.ratio.terms]
        return np.array([*strengths, *([self.ratio.fluidity] if self.ratio.fluidity else [])])


@dataclass(frozen=True, eq=False)
class LayeredCreep:
    """Creep of layers that relax differently.

    Attributes
    ----------
    times
        Retardation time (s) of each term; infinite for that of a fluid, which comes last.
    nodes
        Wavenumbers (n,) in rad/m, rising.
    strengths
        q c_k(q) (terms, n) in 1/Pa, of a fluid in 1/(Pa s).
    mean_modes
        c_k(0) of each term, m/Pa; zero where the datum of the body is its mean displacement.
    error
        Largest difference of the fitted from the exact complex compliance, relative to it.
    instantaneous
        Compliance at the first instant.
    shear
        The same for tractions of all directions, where it is known.
    """

    times: RealArray
    nodes: RealArray
    strengths: RealArray
    mean_modes: RealArray
    error: float
    instantaneous: Compliance
    shear: ShearStrengths | None = None

    def term(self, number: int) -> RetardedCompliance:
        """c_k(q) of the term of this ``number`` alone."""
        weights = np.zeros(self.times.size)
        weights[number] = 1.0
        return RetardedCompliance(self, tuple(weights), 0.0)

    def with_terms(self, weights: RealArray) -> RetardedCompliance:
        """c_0 + sum of ``weights`` (terms,) times c_k."""
        return RetardedCompliance(self, tuple(float(w) for w in weights), 1.0)


@dataclass(frozen=True)
class RetardedCompliance:
    """Sum of the terms of a ``creep`` with these ``weights``, and ``share`` times the instantaneous
    compliance, as a compliance."""

    creep: LayeredCreep = field(repr=False)
    weights: tuple[float, ...]
    share: float

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Those of the instantaneous compliance."""
        return self.creep.instantaneous.citation_keys

    @cached_property
    def _strength(self) -> RealArray:
        return np.asarray(np.array(self.weights) @ self.creep.strengths)

    @property
    def mean_mode_of_terms(self) -> float:
        """c(0) of the terms alone, m/Pa."""
        return float(np.array(self.weights) @ self.creep.mean_modes)

    def spectral(self, wavenumber: ArrayLike) -> RealArray:
        """c(q) in m/Pa at ``wavenumber`` q > 0 (rad/m)."""
        rigid_base, q = bool(self.mean_mode_of_terms), wavenumbers(wavenumber)
        found = _between(self.creep.nodes, self._strength, q, rigid_base=rigid_base) / q
        return found + self.share * self.creep.instantaneous.spectral(q) if self.share else found

    def mean_mode(self) -> float:
        """c(0) in m/Pa; 0 where the datum is the mean displacement."""
        return self.share * self.creep.instantaneous.mean_mode() + self.mean_mode_of_terms

    def influence(self, grid: Grid) -> RealArray:
        """Displacement (m/Pa) at pixel offsets from a pixel under unit pressure."""
        values, limits = self._samples
        found = patch_coefficients(point_kernel(values, limits), grid)
        return found + self.share * self.creep.instantaneous.influence(grid) if self.share else found

    def line_influence(self, grid: Grid, datum: float) -> RealArray:
        """Displacement (m/Pa), shape (nx, 1), from a strip under unit pressure."""
        values, limits = self._samples
        found = strip_coefficients(line_kernel(values, limits), grid, datum)
        return found + self.share * self.creep.instantaneous.line_influence(grid, datum) if self.share else found

    @property
    def _samples(self) -> tuple[RealArray, Limits]:
        nodes, strength = self.creep.nodes, self._strength
        depth = 1.0 / math.sqrt(nodes[0] * nodes[-1])
        low = 0.0 if self.mean_mode_of_terms else float(strength[0])
        values = _between(nodes, strength, wavenumber_grid(depth), rigid_base=bool(self.mean_mode_of_terms))
        return values, Limits(float(strength[-1]), low, depth)


def _between(nodes: RealArray, strength: RealArray, wavenumber: RealArray, *, rigid_base: bool) -> RealArray:
    """q c, linear in ln q between the ``nodes`` with this ``strength``; on a rigid base c is
    constant at long waves."""
    found = np.interp(np.log(wavenumber), np.log(nodes), strength)
    if rigid_base:
        found = np.where(wavenumber < nodes[0], strength[0] * wavenumber / nodes[0], found)
    return np.asarray(found)


@dataclass(frozen=True, eq=False)
class ShearStrengths:
    """Terms of a creep for tractions of all directions.

    ``planes``: q c_k(q) (terms, n) in 1/Pa at the nodes, of a fluid in 1/(Pa s), the coupling Lz
    with the sign of the body that carries the traction; ``mean_modes``: c_k(0) along the surface
    (terms,) in m/Pa, zero where the datum is the mean displacement.
    """

    planes: PlaneCompliance
    mean_modes: RealArray


@dataclass(frozen=True, eq=False)
class RetardedSurface:
    """The term of this ``number`` of a ``creep`` with shear, as a compliance for tractions of all
    directions."""

    creep: LayeredCreep = field(repr=False)
    number: int

    @property
    def _shear(self) -> ShearStrengths:
        assert self.creep.shear is not None
        return self.creep.shear

    def _plane(self, wavenumber: RealArray) -> PlaneCompliance:
        """q c of the term at ``wavenumber`` > 0 (rad/m)."""
        planes, rigid_base = self._shear.planes, bool(self._shear.mean_modes.any())
        each = (component[self.number] for component in (planes.LL, planes.zz, planes.Lz, planes.T))
        return PlaneCompliance(
            *(_between(self.creep.nodes, strength, wavenumber, rigid_base=rigid_base) for strength in each)
        )

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """(C_LL + C_T)/2 in m/Pa at each ``wavenumber`` > 0 (rad/m)."""
        q = wavenumbers(wavenumber)
        found = self._plane(q)
        return 0.5 * (found.LL + found.T) / q

    def tensor(self, grid: Grid) -> SurfaceTensor:
        """That of a periodic cell."""
        q = grid.wavenumber()
        q[0, 0] = 1.0  # any value: the mean mode is replaced
        shear, normal = (float(modes[self.number]) for modes in (self._shear.mean_modes, self.creep.mean_modes))
        return tensor_of(grid, self._plane(q).scaled(1.0 / q), shear, normal)

    def shear_pixels(self, grid: Grid) -> tuple[RealArray, RealArray, RealArray]:
        """``xx``, ``yy`` and ``xy`` of pixels."""
        return shear_pixels_of(grid, self._samples)

    def coupling_pixels(self, grid: Grid) -> tuple[RealArray, RealArray]:
        """``xz`` and ``yz`` of pixels."""
        return coupling_pixels_of(grid, self._samples)

    def shear_strips(self, grid: Grid, datum: float) -> tuple[RealArray, RealArray]:
        """Along and across, (nx, 1)."""
        return shear_strips_of(grid, self._samples, datum)

    def coupling_strips(self, grid: Grid) -> RealArray:
        """Normal displacement by shear along x, (nx, 1)."""
        return coupling_strips_of(grid, self._samples)

    @cached_property
    def _samples(self) -> Samples:
        nodes = self.creep.nodes
        depth, ends = 1.0 / math.sqrt(nodes[0] * nodes[-1]), nodes[[0, -1]]
        low, high = (self._plane(ends[at]) for at in (0, 1))
        return Samples(
            depth, self._plane(wavenumber_grid(depth)), high, low.scaled(0.0) if self._shear.mean_modes.any() else low
        )


AnyCreep: TypeAlias = SharedCreep | LayeredCreep
"""How a compliance grows in time."""


def contact_creep(body: Body, counter_body: Body, *, shear: bool = False) -> AnyCreep | None:
    """Creep of the sum of the compliances of ``body`` and ``counter_body``; None where nothing in
    them relaxes.

    With ``shear`` that of layers which relax differently is one series for tractions of all
    directions.

    InputError if both are rigid, or no series is near the compliance.
    """
    pairs = deformable(body, counter_body)
    solids = tuple(solid for solid, _ in pairs)
    if not any(map(relaxes, solids)):
        return None
    materials = tuple(material for solid in solids for material in materials_of(solid))
    if len(materials) == len(solids) and not any(_stacked(solid).layers for solid in solids):
        creeps = [
            m.contact_creep if isinstance(m, Viscoelastic) else Creep(1.0 / m.plane_strain_modulus) for m in materials
        ]
        total = sum(creeps[1:], start=creeps[0])
        return SharedCreep(total.times(1.0 / total.instantaneous))
    first = materials[0]
    if alike(materials) and isinstance(first, Viscoelastic):
        return SharedCreep(first.shear.creep.times(first.shear_modulus))
    return _layered_creep(body, counter_body, shear)


@lru_cache(maxsize=16)
def _layered_creep(body: Body, counter_body: Body, shear: bool) -> LayeredCreep:
    """Series of layers that relax differently; kept, as every solve of a history that is continued
    needs it and a fit may take a second."""
    pairs = deformable(body, counter_body)
    materials = tuple(material for solid, _ in pairs for material in materials_of(solid))
    stacks = tuple((_stacked(solid), sign) for solid, sign in pairs)
    instantaneous = contact_compliance(body, counter_body)
    for per_decade in _PER_DECADE:
        found = _Fit(stacks, materials, per_decade, shear).creep(instantaneous)
        if found.error <= ERROR:
            return found
    if found.error > _WORST:
        raise InputError(
            f"compliance of viscoelastic layers must be a series of retardations to {_WORST:.0%}, but is one "
            f"to {found.error:.2g} only. Use moduli and thicknesses that differ by smaller factors."
        )
    return found


def complex_compliance(body: Body, counter_body: Body, wavenumber: RealArray, omega: RealArray) -> ComplexArray:
    """Sum of the complex compliances (m/Pa) of both bodies at ``wavenumber`` (rad/m) > 0 and
    angular frequency ``omega`` (rad/s).

    The two broadcast against each other. InputError if both bodies are rigid.
    """
    solids = (_stacked(solid) for solid, _ in deformable(body, counter_body))
    first, *others = (
        np.asarray(operational_plane(solid, wavenumbers(wavenumber), 1j * omega).zz, dtype=complex) for solid in solids
    )
    return sum(others, start=first)


def _stacked(solid: Elastic | Layered) -> Layered:
    """``solid`` without what does not take part, as layers on a base."""
    return solid.reduced if isinstance(solid, Layered) else Layered((), solid)


_PER_DECADE = (2, 3, 4, 6, 8)
"""Retardation times, and frequencies, a decade, tried one after the other; those of the materials
themselves stand among the times."""

_APART, _NEAR = 0.6, 0.25
"""Share of a step from a time of the materials within which no other is taken, where few a decade
serve and where many are needed."""

ERROR = 3e-3
"""Largest relative error of a complex compliance at which no more terms are taken. Coatings need 3
a decade for 1e-3; a stiff film on a soft solid, each wavelength of which has one sharp retardation
time of its own, needs 8."""

_WORST = 0.05
"""Relative error of the complex compliance above which a series is refused."""

_NODES_PER_DECADE = 80
_SHORTEST, _LONGEST = 0.1, 1e5
"""Wavelength over the thinnest layer, and over the thickness of all, beyond which waves feel the
top layer or the base alone."""

_FLUID = 1e3
"""Factor to the longest time where something flows: under a film it may do so for very long."""

_SHOWS = 1e-3
"""Share of the compliance below which a retardation does not show."""


@dataclass(frozen=True)
class _Fit:
    """Series for the compliance of ``stacks``, each with the sign of the traction that it carries,
    of these ``materials``; with ``shear`` for all directions."""

    signed: tuple[tuple[Layered, float], ...]
    materials: tuple[Elastic, ...]
    per_decade: int
    shear: bool

    @property
    def stacks(self) -> tuple[Layered, ...]:
        """The stacks alone."""
        return tuple(stack for stack, _ in self.signed)

    def creep(self, instantaneous: Compliance) -> LayeredCreep:
        """Series with one set of times for all wavenumbers."""
        layers = [layer for stack in self.stacks for layer in stack.layers]
        thinnest = min(layer.thickness for layer in layers)
        relaxed = ((m, m.relaxed_share if isinstance(m, Viscoelastic) else 1.0) for m in self.materials)
        softest = min(
            m.youngs_modulus * max(share, 1e-3) for m, share in relaxed
        )  # of a fluid a thousandth of the first
        stiff = max(1.0, max(m.youngs_modulus for m in self.materials) / softest)
        longest = _LONGEST * max(stack.thickness for stack in self.stacks) * stiff ** (1.0 / 3.0)
        first, last = 2.0 * np.pi / longest, 2.0 * np.pi / (_SHORTEST * thinnest)
        nodes = np.geomspace(first, last, math.ceil(math.log10(last / first) * _NODES_PER_DECADE) + 1)

        times = self._times(nodes, stiff)
        finite = times[np.isfinite(times)]
        low, high = (0.1 if finite.size == times.size else 10.0) / finite[-1], 10.0 / finite[0]
        omega = np.geomspace(low, high, math.ceil(math.log10(high / low) * self.per_decade) + 1)
        rows = [self._at(nodes, 1j * w) for w in (*omega, 1e30 * high)]  # the last at infinite frequency
        LL, zz, Lz, T = (np.stack([getattr(row, name) for row in rows]) for name in ("LL", "zz", "Lz", "T"))
        exact = PlaneCompliance(LL, zz, Lz, T).scaled(nodes)

        means, mean_error = self._mean_modes(times, shear=False)
        if not self.shear:
            strengths, error = fitted(times, omega, np.asarray(exact.zz, dtype=complex))
            used = _used(strengths, means)
            error = max(error, mean_error)
            return LayeredCreep(times[used], nodes, strengths[used], means[used], error, instantaneous)
        planes, error = fitted_planes(times, omega, exact)
        shears, shear_error = self._mean_modes(times, shear=True)
        used = _used(planes.zz, means) | _used(planes.LL, shears) | _used(planes.T, shears)
        kept = PlaneCompliance(planes.LL[used], planes.zz[used], planes.Lz[used], planes.T[used])
        error, shear = max(error, mean_error, shear_error), ShearStrengths(kept, shears[used])
        return LayeredCreep(times[used], nodes, kept.zz, means[used], error, instantaneous, shear)

    def _times(self, nodes: RealArray, stiff: float) -> RealArray:
        """Those of the materials, and equal steps of the logarithm as far as retardation shows at
        some wavenumber.

        ``stiff`` >= 1 is the largest modulus over the smallest that a material relaxes to. A step
        near a time of the materials is left out.
        """
        viscous = [m for m in self.materials if isinstance(m, Viscoelastic) and m.spectrum]
        own = [lam for m in viscous for _, lam in m.contact_creep.terms]
        relaxations = [tau for m in viscous for _, tau in m.spectrum]
        first, last = 0.5 * min(relaxations), 4.0 * max([*own, *relaxations]) * stiff
        fluid = any(m.contact_creep.fluidity for m in viscous)
        last *= _FLUID if fluid else 1.0
        pilot = np.geomspace(first, last, math.ceil(math.log10(last / first) * self.per_decade) + 1)
        if not fluid:
            planes = [self._at(nodes, complex(1.0 / t)) for t in pilot]
            c = np.stack([np.concatenate([p.zz, p.LL, p.T] if self.shear else [p.zz]).real for p in planes])
            shows = np.diff(c, axis=0).max(axis=1, initial=0.0, where=np.diff(c, axis=0) > _SHOWS * c[:-1]) > 0.0
            inside = np.flatnonzero(shows)
            if inside.size:
                pilot = pilot[max(inside[0] - 1, 0) : inside[-1] + 3]
        near = 10.0 ** ((_APART if self.per_decade < 4 else _NEAR) / self.per_decade)
        kept = [t for t in pilot if not any(1.0 / near < t / lam < near for lam in own)]
        times = [lam for _, lam in merged((1.0, t) for t in (*kept, *own))]
        return np.array([*times, math.inf] if fluid else times)

    def _at(self, nodes: RealArray, s: complex) -> PlaneCompliance:
        return summed_planes([(operational_plane(stack, nodes, s), sign) for stack, sign in self.signed])

    def _mean_modes(self, times: RealArray, *, shear: bool) -> tuple[RealArray, float]:
        """c_k(0) of layers on a rigid base, of the compression h (1 - 2nu)/2G(1 - nu) of each or of
        its ``shear`` h/G.

        Zero if one of the bodies is a half-space, and in shear where a layer slips: the datum is
        then the mean displacement.
        """
        on_half_space = any(isinstance(stack.base, Elastic) for stack in self.stacks)
        if on_half_space or (shear and any(stack.slips for stack in self.stacks)):
            return np.zeros(times.size), 0.0
        finite = times[np.isfinite(times)]
        omega = np.geomspace(0.1 / finite[-1], 10.0 / finite[0], 8 * finite.size)
        rows = np.zeros(omega.size + 1, dtype=complex)
        for number, w in enumerate((*omega, 1e30 / finite[0])):
            for layer in (layer for stack in self.stacks for layer in stack.layers):
                (G, nu), h = operational_moduli(layer.material, 1j * w), layer.thickness
                rows[number] += complex(h / G if shear else h * (1.0 - 2.0 * nu) / (2.0 * G * (1.0 - nu)))
        if not rows.any():
            return np.zeros(times.size), 0.0
        strengths, error = fitted(times, omega, rows[:, None])
        return strengths[:, 0], error


def _used(strengths: RealArray, means: RealArray) -> BoolArray:
    """Whether a term shows at some wavenumber or in the mean, (terms,)."""
    return np.asarray(strengths.max(axis=1) + means / max(float(means.max()), 1e-300) > 0.0)
