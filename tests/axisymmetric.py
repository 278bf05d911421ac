"""Fields under axisymmetric pressure p(r), and under the shear μ p(r) along x, by Hankel integrals
over the transfer.

On the surface the integrals do not converge absolutely, so there the outermost layer's homogeneous
part is put in by formulas in real space. Everything is for the half-plane y = 0.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import optimize, special

import asperity as asp
from asperity.core.tensor import Displacement, StressTensor
from asperity.physics.stress.kernels import coefficients
from asperity.physics.stress.kernels.coefficients import SPECTRA, PlaneCoefficients
from asperity.physics.stress.kernels.patch import Load
from asperity.physics.stress.kernels.transfer import transfer
from asperity.physics.stress.regions import Plane
from asperity.solids.compliance.layered import interface_compliances

NODE, WEIGHT = np.polynomial.legendre.leggauss(24)


def panels(edges: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Gauss points and weights on the panels between ``edges``."""
    middle, half = 0.5 * (edges[1:] + edges[:-1]), 0.5 * np.diff(edges)
    return (middle[:, None] + half[:, None] * NODE).ravel(), (half[:, None] * WEIGHT).ravel()


def wavenumbers(last: float, reach: float, first: float = 1e-7) -> tuple[np.ndarray, np.ndarray]:
    """Panels graded to zero, then of the length that waves over ``reach`` allow, up to ``last``."""
    step = 8.0 / reach
    graded = step * 2.0 ** -np.arange(int(np.ceil(np.log2(step / (first * step)))), 0, -1.0)
    return panels(np.concatenate([[0.0], graded, np.arange(step, last + step, step)]))


class Pressure:
    """An axisymmetric pressure on r < ``a``."""

    a: float

    def transform(self, alpha: np.ndarray) -> np.ndarray:
        """2π ∫ p J0(αr) r dr."""
        raise NotImplementedError

    def value(self, r: float) -> float:
        """p(r)."""
        raise NotImplementedError

    def load_within(self, r: float) -> float:
        """2π ∫_0^r p s ds."""
        raise NotImplementedError

    def sink(self, r: float, modulus: float) -> float:
        """Surface displacement u_z of a homogeneous half-space of E' = ``modulus``."""
        raise NotImplementedError

    def odd_integrals(self, r: float) -> tuple[float, float]:
        """1/2π ∫ p̂ J_1 α dα and the same with J_3, for shear on the surface."""
        raise NotImplementedError


@dataclass(frozen=True)
class Disc(Pressure):
    """p = 1."""

    a: float

    def transform(self, alpha):
        return 2.0 * np.pi * self.a * special.j1(alpha * self.a) / alpha

    def value(self, r):
        return float(r < self.a)

    def load_within(self, r):
        return np.pi * min(r, self.a) ** 2

    def sink(self, r, modulus):
        if r <= self.a:
            return 4.0 * self.a / (np.pi * modulus) * special.ellipe((r / self.a) ** 2)
        m = (self.a / r) ** 2
        return 4.0 * r / (np.pi * modulus) * (special.ellipe(m) - (1.0 - m) * special.ellipk(m))


@dataclass(frozen=True)
class Hertz(Pressure):
    """p = sqrt(1 - r²/a²)."""

    a: float

    def transform(self, alpha):
        x = alpha * self.a
        small = x < 0.05
        y = np.where(small, 1.0, x)
        series = (1.0 / 3.0) * (1.0 - x**2 / 10.0 * (1.0 - x**2 / 28.0 * (1.0 - x**2 / 54.0)))
        return 2.0 * np.pi * self.a**2 * np.where(small, series, (np.sin(y) - y * np.cos(y)) / y**3)

    def value(self, r):
        return float(np.sqrt(max(1.0 - (r / self.a) ** 2, 0.0)))

    def load_within(self, r):
        return 2.0 / 3.0 * np.pi * self.a**2 * (1.0 - self.value(r) ** 3)

    def sink(self, r, modulus):
        a = self.a
        if r <= a:
            return np.pi / (4.0 * a * modulus) * (2.0 * a**2 - r**2)
        return ((2.0 * a**2 - r**2) * np.arcsin(a / r) + r * a * np.sqrt(1.0 - (a / r) ** 2)) / (2.0 * modulus * a)

    def odd_integrals(self, r):
        return _odd_integrals(lambda t: -2.0 * t / (np.pi * self.a) * 0.5 * np.pi, self.a, r)


def _odd_integrals(slope: Callable[[np.ndarray], np.ndarray], a: float, r: float) -> tuple[float, float]:
    """From p̂ = 2π ∫ g cos αt dt with g' = ``slope``: ∫ sin(αt) J_m(αr) dα = sin(m
    asin(t/r))/sqrt(r²-t²) for t < r."""
    if r == 0.0:
        return 0.0, 0.0
    angle, weight = panels(np.linspace(0.0, np.arcsin(min(1.0, a / r)), 4))
    g = slope(r * np.sin(angle))
    return -float((g * np.sin(angle) * weight).sum()), -float((g * np.sin(3.0 * angle) * weight).sum())


class SphereOnLayer(Pressure):
    """Rigid paraboloid on one layer on a half-space of E2' = 1/(1-ν2²), Hertz radius a0 = p0 = 1 of
    the substrate alone.

    Fredholm equation of the second kind (O'Sullivan & King 1988) for g(t), p̂ = 2π ∫ g cos αt dt,
    by 48 Gauss points; the contact radius is found for the load of a0 = 1.
    """

    COUNT = 48

    def __init__(self, ratio: float, nu1: float, nu2: float, thickness: float) -> None:
        self.body = asp.Layered([asp.Layer(asp.Elastic(ratio, nu1), thickness)], asp.Elastic(1.0, nu2))
        self.substrate, self.layer = 1.0 / (1.0 - nu2**2), ratio / (1.0 - nu1**2)
        self.thickness = thickness
        self.alpha, self.weight = wavenumbers(21.0 / thickness, 6.0)
        compliance = interface_compliances(self.body.reduced, self.alpha)[0].zz
        self.excess = 0.5 * self.layer * self.alpha * compliance - 1.0
        # a0³ = 3PR/4E', p0 = 2 a0 E'/πR: with a0 = p0 = 1, R = 2E'/π and P = 2π/3
        self.radius = 2.0 * self.substrate / np.pi
        self.a = optimize.brentq(lambda a: self._solve(a)[1] - 2.0 * np.pi / 3.0, 0.2, 3.0, xtol=1e-14)
        self.g = self._solve(self.a)[0]

    def _solve(self, a: float) -> tuple[np.polynomial.Legendre, float]:
        """g as a polynomial on (0, a) with g(a) = 0, and the load."""
        x, w = np.polynomial.legendre.leggauss(self.COUNT)
        t, w = 0.5 * a * (x + 1.0), 0.5 * a * w
        points = np.append(t, a)
        waves = np.cos(np.outer(points, self.alpha))
        kernel = (waves * (self.excess * self.weight)) @ waves[:-1].T * (2.0 / np.pi) * w
        matrix = np.eye(self.COUNT) + kernel[:-1]
        right = self.layer / np.pi * np.array([np.ones_like(t), -(t**2) / self.radius])
        flat, curved = np.linalg.solve(matrix, right.T).T
        end = self.layer / np.pi * np.array([1.0, -(a**2) / self.radius]) - kernel[-1] @ np.array([flat, curved]).T
        values = flat * (-end[1] / end[0]) + curved
        fit = np.polynomial.Legendre.fit(t, values, self.COUNT - 1, domain=[0.0, a])
        return fit, 2.0 * np.pi * float(values @ w)

    @cached_property
    def slope(self) -> np.polynomial.Legendre:
        """g'."""
        return self.g.deriv()

    def transform(self, alpha):
        t, w = panels(np.linspace(0.0, self.a, 12))
        return 2.0 * np.pi * (np.cos(np.outer(alpha, t)) @ (self.g(t) * w))

    def value(self, r):
        if r >= self.a:
            return 0.0
        v, w = panels(np.linspace(0.0, np.sqrt(self.a**2 - r**2), 4))
        t = np.hypot(r, v)
        return -float((self.slope(t) / t * w).sum())

    def load_within(self, r):
        total = 2.0 * np.pi / 3.0
        if r >= self.a:
            return total
        v, w = panels(np.linspace(0.0, np.sqrt(self.a**2 - r**2), 4))
        t = np.hypot(r, v)
        return total + 2.0 * np.pi * float((self.slope(t) * v * v / t * w).sum())

    def odd_integrals(self, r):
        return _odd_integrals(self.slope, self.a, r)


def fields(
    body: asp.Layered, plane: Plane, pressure: Pressure, x: float, mu: float = 0.0
) -> tuple[Displacement, StressTensor]:
    """Displacement and stress at (x, 0) of ``plane`` under p and the shear μp along +x."""
    body, r, side = body.reduced, abs(x), 1.0 if x >= 0.0 else -1.0
    outermost, surface = plane.region.index == 0, plane.depth == 0.0
    ready = PlaneCoefficients(body, plane, asp.Grid((1, 1), (1.0, 1.0)))
    decay = min(2.0 * plane.region.bottom, 100.0) if surface else plane.depth
    alpha, weight = wavenumbers(45.0 / decay, r + pressure.a + plane.depth)
    spectra = ready.spectra(alpha) if surface else transfer(body, plane, alpha)
    nu = plane.region.material.poisson_ratio
    load = pressure.transform(alpha) * alpha * weight / (2.0 * np.pi)

    def total(under: Load, line: tuple[coefficients.Term, ...]) -> float:
        found = 0.0
        for name, angular, sign in line:
            order, combine = SPECTRA[name]
            integral = float((load * combine(spectra, nu) * special.jv(order, alpha * r)).sum())
            found += sign * float(angular.factor(np.array(side), np.array(0.0))) * integral
        return found * (mu if under == "x" else 1.0)

    displacement = {a: total("z", coefficients.DISPLACEMENT_UNDER_PRESSURE[a]) for a in "xyz"}
    stress = {s: total("z", coefficients.STRESS_UNDER_PRESSURE[s]) for s in ("xx", "yy", "zz", "xy", "xz", "yz")}
    if mu:
        for s in stress:
            stress[s] += total("x", coefficients.STRESS_UNDER_SHEAR[s])
    if surface and outermost:
        _add_surface(displacement, stress, pressure, plane.region.material, x, mu)
    return Displacement(**displacement), StressTensor(**stress)


def _add_surface(displacement, stress, pressure, material, x, mu) -> None:
    """Surface fields of a homogeneous half-space in real space: u_r = -(1-2ν) P(r)/4πGr and Hooke's
    law; shear by the integrals of J1 and J3 (σ_xx = -(2+ν/2) H1 cos θ - ν/2 H3 cos 3θ and so
    on)."""
    G, nu, r = material.shear_modulus, material.poisson_ratio, abs(x)
    side, p = (1.0 if x >= 0.0 else -1.0), pressure.value(r)
    k = (1.0 - 2.0 * nu) / (2.0 * G)
    mean = 0.5 * p if r == 0.0 else pressure.load_within(r) / (2.0 * np.pi * r**2)
    radial, hoop = -k * (p - mean), -k * mean
    plane_stress = 2.0 * G / (1.0 - nu)
    displacement["x"] += -k * mean * r * side
    displacement["z"] += (
        pressure.sink(r, material.plane_strain_modulus)
        if mu == 0.0 and not isinstance(pressure, SphereOnLayer)
        else np.nan
    )
    stress["xx"] += plane_stress * (radial + nu * hoop) - nu / (1.0 - nu) * p
    stress["yy"] += plane_stress * (hoop + nu * radial) - nu / (1.0 - nu) * p
    stress["zz"] -= p
    if mu:
        one, three = pressure.odd_integrals(r)
        stress["xx"] += mu * side * (-(2.0 + 0.5 * nu) * one - 0.5 * nu * three)
        stress["yy"] += mu * side * (-1.5 * nu * one + 0.5 * nu * three)
        stress["xz"] -= mu * p
