"""Normal compliance of viscoelastic bodies in time: c(q, t) = c_0(q) + sum c_k(q) (1 - exp(-t/lambda_k)) + c_f(q) t.

c_0 is the compliance at the first instant. Where all moduli relax alike, and of homogeneous bodies, all c_k are multiples of c_0
(``SharedCreep``). Else the response of the layers to oscillating pressure is computed with complex moduli, and a series fitted to
it at each wavenumber with one set of times for all (``LayeredCreep``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeAlias

import numpy as np

from ...core.arrays import ComplexArray, RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ..elastic import Elastic
from ..layers import Body, Layered, deformable, materials_of, relaxes
from ..relaxation import Creep, Terms, merged
from ..viscoelastic import Viscoelastic, alike
from .halfspace import Compliance, contact_compliance
from .influence import Limits, line_kernel, patch_coefficients, point_kernel, strip_coefficients, wavenumber_grid
from .layered import operational_compliance


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
    """

    times: RealArray
    nodes: RealArray
    strengths: RealArray
    mean_modes: RealArray
    error: float
    instantaneous: Compliance

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
    """Sum of the terms of a ``creep`` with these ``weights``, and ``share`` times the instantaneous compliance, as a compliance."""

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

    def _retarded(self, wavenumber: RealArray) -> RealArray:
        """q c of the terms, linear in ln q between the nodes."""
        nodes = self.creep.nodes
        found = np.interp(np.log(wavenumber), np.log(nodes), self._strength)
        if self.mean_mode_of_terms:  # on a rigid base c is constant at long waves
            found = np.where(wavenumber < nodes[0], self._strength[0] * wavenumber / nodes[0], found)
        return np.asarray(found)

    @property
    def mean_mode_of_terms(self) -> float:
        """c(0) of the terms alone, m/Pa."""
        return float(np.array(self.weights) @ self.creep.mean_modes)

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """c(q) in m/Pa at ``wavenumber`` q > 0 (rad/m)."""
        found = self._retarded(wavenumber) / wavenumber
        return found + self.share * self.creep.instantaneous.spectral(wavenumber) if self.share else found

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
        return self._retarded(wavenumber_grid(depth)), Limits(float(strength[-1]), low, depth)


AnyCreep: TypeAlias = SharedCreep | LayeredCreep
"""How a compliance grows in time."""


def contact_creep(body: Body, counter_body: Body) -> AnyCreep | None:
    """Creep of the sum of the compliances of ``body`` and ``counter_body``; None where nothing in them relaxes.

    InputError if both are rigid.
    """
    solids = tuple(solid for solid, _ in deformable(body, counter_body))
    if not any(map(relaxes, solids)):
        return None
    materials = tuple(material for solid in solids for material in materials_of(solid))
    if len(materials) == len(solids) and not any(_stacked(solid).layers for solid in solids):
        total = _creep(materials[0])
        for material in materials[1:]:
            total = total + _creep(material)
        return SharedCreep(total.times(1.0 / total.instantaneous))
    first = materials[0]
    if alike(materials) and isinstance(first, Viscoelastic):
        return SharedCreep(first.shear.creep.times(first.shear_modulus))
    stacks, instantaneous = tuple(_stacked(solid) for solid in solids), contact_compliance(body, counter_body)
    for per_decade in _PER_DECADE:
        found = _Fit(stacks, materials, per_decade).creep(instantaneous)
        if found.error <= ERROR:
            return found
    if found.error > _WORST:
        raise InputError(
            f"compliance of viscoelastic layers must be a series of retardations to {_WORST:.0%}, but is one to {found.error:.2g} only. "
            "Use moduli and thicknesses that differ by smaller factors."
        )
    return found


def complex_compliance(body: Body, counter_body: Body, wavenumber: RealArray, omega: RealArray) -> ComplexArray:
    """Sum of the complex compliances (m/Pa) of both bodies at ``wavenumber`` (rad/m) > 0 and angular frequency ``omega`` (rad/s).

    The two broadcast against each other. InputError if both bodies are rigid.
    """
    solids = (_stacked(solid) for solid, _ in deformable(body, counter_body))
    first, *others = (operational_compliance(solid, wavenumber, 1j * omega) for solid in solids)
    return sum(others, start=first)


def _creep(material: Elastic) -> Creep:
    if isinstance(material, Viscoelastic):
        return material.contact_creep
    return Creep(1.0 / material.plane_strain_modulus)


def _stacked(solid: Elastic | Layered) -> Layered:
    """``solid`` without what does not take part, as layers on a base."""
    return solid.reduced if isinstance(solid, Layered) else Layered((), solid)


_PER_DECADE = (2, 3, 4, 6, 8)
"""Retardation times, and frequencies, a decade, tried one after the other; those of the materials themselves stand among the times."""

_APART, _NEAR = 0.6, 0.25
"""Share of a step from a time of the materials within which no other is taken, where few a decade serve and where many are needed."""

ERROR = 3e-3
"""Largest relative error of a complex compliance at which no more terms are taken. Coatings need 3 a decade for 1e-3; a stiff film on a
soft solid, each wavelength of which has one sharp retardation time of its own, needs 8."""

_WORST = 0.05
"""Relative error of the complex compliance above which a series is refused."""

_NODES_PER_DECADE = 80
_SHORTEST, _LONGEST = 0.1, 1e5
"""Wavelength over the thinnest layer, and over the thickness of all, beyond which waves feel the top layer or the base alone."""

_FLUID = 1e3
"""Factor to the longest time where something flows: under a film it may do so for very long."""

_SHOWS = 1e-3
"""Share of the compliance below which a retardation does not show."""


@dataclass(frozen=True)
class _Fit:
    """Series for the compliance of ``stacks`` of these ``materials``."""

    stacks: tuple[Layered, ...]
    materials: tuple[Elastic, ...]
    per_decade: int

    def creep(self, instantaneous: Compliance) -> LayeredCreep:
        """Series with one set of times for all wavenumbers."""
        nodes = self._nodes()
        times = self._times(nodes)
        exact = self._operational(nodes, times)
        strengths, error = _fitted(times, exact[0], exact[1])
        means, mean_error = self._mean_modes(times)
        used = strengths.max(axis=1) + means / max(float(means.max()), 1e-300) > 0.0
        return LayeredCreep(times[used], nodes, strengths[used], means[used], max(error, mean_error), instantaneous)

    def _nodes(self) -> RealArray:
        layers = [layer for stack in self.stacks for layer in stack.layers]
        thinnest = min(layer.thickness for layer in layers)
        stiff = max(m.youngs_modulus for m in self.materials) / min(_softest(m) for m in self.materials)
        longest = _LONGEST * max(stack.thickness for stack in self.stacks) * max(1.0, stiff) ** (1.0 / 3.0)
        first, last = 2.0 * np.pi / longest, 2.0 * np.pi / (_SHORTEST * thinnest)
        return np.geomspace(first, last, math.ceil(math.log10(last / first) * _NODES_PER_DECADE) + 1)

    def _times(self, nodes: RealArray) -> RealArray:
        """Those of the materials, and equal steps of the logarithm as far as retardation shows at some wavenumber."""
        viscous = [m for m in self.materials if isinstance(m, Viscoelastic) and m.spectrum]
        own = [lam for m in viscous for _, lam in m.contact_creep.terms]
        relaxations = [tau for m in viscous for _, tau in m.spectrum]
        stiff = max(m.youngs_modulus for m in self.materials) / min(_softest(m) for m in self.materials)
        first, last = 0.5 * min(relaxations), 4.0 * max([*own, *relaxations]) * max(1.0, stiff)
        fluid = any(m.contact_creep.fluidity for m in viscous)
        last *= _FLUID if fluid else 1.0
        pilot = np.geomspace(first, last, math.ceil(math.log10(last / first) * self.per_decade) + 1)
        if not fluid:
            c = np.stack([sum(_real(stack, nodes, 1.0 / t) for stack in self.stacks) for t in pilot])
            shows = np.diff(c, axis=0).max(axis=1, initial=0.0, where=np.diff(c, axis=0) > _SHOWS * c[:-1]) > 0.0
            inside = np.flatnonzero(shows)
            if inside.size:
                pilot = pilot[max(inside[0] - 1, 0) : inside[-1] + 3]
        times = [lam for _, lam in _distinct(tuple(pilot), tuple(own), self.per_decade)]
        return np.array([*times, math.inf] if fluid else times)

    def _operational(self, nodes: RealArray, times: RealArray) -> tuple[RealArray, ComplexArray]:
        """Angular frequencies (m,), and q c(q, omega) in rows of these and last at infinite frequency, (m + 1, n)."""
        finite = times[np.isfinite(times)]
        low, high = (0.1 if finite.size == times.size else 10.0) / finite[-1], 10.0 / finite[0]
        omega = np.geomspace(low, high, math.ceil(math.log10(high / low) * self.per_decade) + 1)
        rows = [
            sum(operational_compliance(stack, nodes, 1j * w) for stack in self.stacks) for w in (*omega, 1e30 * high)
        ]
        return omega, np.asarray(np.stack(rows) * nodes, dtype=complex)

    def _mean_modes(self, times: RealArray) -> tuple[RealArray, float]:
        """c_k(0) of the compression of layers on a rigid base; zero if one of the bodies is a half-space."""
        if any(isinstance(stack.base, Elastic) for stack in self.stacks):
            return np.zeros(times.size), 0.0
        finite = times[np.isfinite(times)]
        omega = np.geomspace(0.1 / finite[-1], 10.0 / finite[0], 8 * finite.size)
        rows = np.array([self._compression(1j * w) for w in (*omega, 1e30 / finite[0])])
        strengths, error = _fitted(times, omega, rows[:, None])
        return strengths[:, 0], error

    def _compression(self, s: complex) -> complex:
        """Sum of h (1 - 2nu)/2G(1 - nu) at ``s``."""
        total = 0.0 + 0.0j
        for stack in self.stacks:
            for layer in stack.layers:
                solid = layer.material
                G, nu = (
                    solid.operational(s)
                    if isinstance(solid, Viscoelastic)
                    else (solid.shear_modulus, solid.poisson_ratio)
                )
                total += complex(layer.thickness * (1.0 - 2.0 * nu) / (2.0 * G * (1.0 - nu)))
        return total


def _softest(material: Elastic) -> float:
    """Modulus (Pa) that a material relaxes to; of a fluid a thousandth of the first."""
    share = material.relaxed_share if isinstance(material, Viscoelastic) else 1.0
    return material.youngs_modulus * max(share, 1e-3)


def _real(stack: Layered, nodes: RealArray, s: float) -> RealArray:
    return np.asarray(operational_compliance(stack, nodes, complex(s)).real)


def _distinct(pilot: tuple[float, ...], own: tuple[float, ...], per_decade: int) -> Terms:
    """Times of the materials, and those of the ``pilot`` that do not stand near one."""
    near = 10.0 ** ((_APART if per_decade < 4 else _NEAR) / per_decade)
    kept = [t for t in pilot if not any(1.0 / near < t / lam < near for lam in own)]
    return merged((1.0, t) for t in (*kept, *own))


def _fitted(times: RealArray, omega: RealArray, exact: ComplexArray) -> tuple[RealArray, float]:
    """Non-negative strengths (terms, n) for the columns of ``exact`` (m + 1, n), and the largest relative error.

    The last row is the value at infinite frequency, which is subtracted.
    """
    from scipy.optimize import nnls

    finite = np.isfinite(times)
    columns = np.empty((omega.size, times.size), dtype=complex)
    columns[:, finite] = 1.0 / (1.0 + 1j * omega[:, None] * times[finite])
    columns[:, ~finite] = 1.0 / (1j * omega[:, None])
    strengths, worst = np.empty((times.size, exact.shape[1])), 0.0
    for number, values in enumerate(exact.T):
        wanted, size = values[:-1] - values[-1], np.abs(values[:-1])
        rows = np.vstack([columns.real / size[:, None], columns.imag / size[:, None]])
        found, _ = nnls(rows, np.concatenate([wanted.real / size, wanted.imag / size]), maxiter=100 * times.size)
        strengths[:, number] = found
        worst = max(worst, float((np.abs(columns @ found - wanted) / size).max()))
    if not math.isfinite(worst):
        raise InputError(
            "moduli and thicknesses of viscoelastic layers must be within the range of numbers, but are not."
        )
    return strengths, worst
