"""Elliptic sources of heat by quadrature about the field point, and their means.

Lengths in half lengths a along the motion, θ = k T/(q̄ a), and Pe = v a/2κ. In polar coordinates
about the field point the kernel exp(-Pe (r - x))/(2π r) of a point source on a half-space that
moves to +x (Rosenthal 1946) has no singularity left,

    θ = 1/2π ∫∫ f exp(-β r) dr dφ,  β = 2 Pe sin²(φ/2),  φ = 0 looking upstream,

and so have means over the source, with the overlap of the source with itself in place of the flux
f. The ellipse is scaled to a circle: tan φ = b tan ψ, r = n t.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...core.arrays import RealArray
from ...core.quadrature import gauss
from ...core.scipy_parts import special

_NODES = 12


@dataclass(frozen=True)
class ScaledEllipse:
    """A source of half axes 1 along the motion and ``b`` across it.

    Parameters
    ----------
    b
        Over the half axis along the motion, > 0.
    hertzian
        Whether the flux is 3/2 sqrt(1 - ρ²) of its mean; uniform if not.
    peclet
        v a/2κ, of any sign.
    depth
        z/a >= 0.
    fourier
        κ t/a² since the flux began; infinite for the steady state.
    """

    b: float
    hertzian: bool
    peclet: float
    depth: float = 0.0
    fourier: float = math.inf

    def at(self, x: float, y: float) -> float:
        """θ at one point, in or out of the source."""
        if self.peclet < 0.0:
            return ScaledEllipse(self.b, self.hertzian, -self.peclet, self.depth, self.fourier).at(-x, y)
        X, Y = x, y / self.b
        out, away = X**2 + Y**2 - 1.0, math.hypot(X, Y)
        psi, weight = self._directions(X, Y, out, away)
        c, s = np.cos(psi), np.sin(psi)
        n = np.sqrt(c**2 + (self.b * s) ** 2)  # length of the direction in units of a
        middle = X * c + Y * s
        root = np.sqrt(np.maximum(middle**2 - out, 0.0))
        far = np.where(middle > 0.0, middle + root, -out / np.maximum(root - middle, 1e-300))
        near = np.where(middle > 0.0, out / np.maximum(middle + root, 1e-300), middle - root)
        beta = self._falls(n, c, s)
        if self.depth == 0.0 and math.isinf(self.fourier) and not self.hertzian:
            begin = np.maximum(near, 0.0)
            inner = np.exp(-beta * begin) * _falling(beta, far - begin)
        else:
            inner = self._along(near, far, n, c, beta)
        return float(weight @ (self.b / n * inner)) / (2.0 * math.pi)

    def mean(self, *, weighted: bool = False) -> float:
        """Mean of θ over the source, or ``weighted`` with its flux, in steady state at the
        surface."""
        psi, weight = _graded(
            ((0.0, self._levels), (0.5 * math.pi, 8 + self._slender), (math.pi, 4 + self._slender)), 0.0, math.pi
        )
        c, s = np.cos(psi), np.sin(psi)
        n = np.sqrt(c**2 + (self.b * s) ** 2)
        beta = ScaledEllipse(self.b, self.hertzian, abs(self.peclet))._falls(n, c, s)
        t, overlap = _overlap(self.hertzian, weighted and self.hertzian, 8 + self._levels)
        return float((weight * self.b / n) @ (np.exp(-beta[:, None] * t) @ overlap)) / math.pi

    @property
    def _levels(self) -> int:
        """Panels that grow twofold from a point where the flow upstream is felt."""
        return 6 + self._slender + math.ceil(0.5 * math.log2(1.0 + abs(self.peclet)))

    @property
    def _slender(self) -> int:
        """Further panels of a slender ellipse, whose directions crowd about its axes."""
        return math.ceil(abs(math.log2(self.b)))

    def _falls(self, n: RealArray, c: RealArray, s: RealArray) -> RealArray:
        """β of lengths t in the direction ψ, Pe (n - cos ψ), without cancellation upstream."""
        upstream = (self.b * s) ** 2 / np.maximum(n + c, 1e-300)
        return np.asarray(self.peclet * np.where(c > 0.0, upstream, n - c))

    def _directions(self, X: float, Y: float, out: float, away: float) -> tuple[RealArray, RealArray]:
        """Directions ψ in which the source is seen, and weights."""
        rim = 4 + math.ceil(0.5 * math.log2(1.0 / max(abs(out), 1e-12))) if abs(out) < 1.0 else 0
        towards = math.atan2(Y, X)
        across, along = 8 + self._slender, 4 + self._slender
        marks = [
            (0.0, self._levels),
            (0.5 * math.pi, across),
            (-0.5 * math.pi, across),
            (math.pi, along),
            (-math.pi, along),
        ]
        if out < 0.0 and Y == 0.0:  # both sides alike
            psi, weight = _graded((*marks, (0.5 * math.pi, rim)), 0.0, math.pi)
            return psi, 2.0 * weight
        if out < 0.0:
            for tangent in (towards + 0.5 * math.pi, towards - 0.5 * math.pi):
                marks.append((math.remainder(tangent, 2.0 * math.pi), rim))
            return _graded(tuple(marks), -math.pi, math.pi)
        half = math.asin(min(1.0, 1.0 / away))
        seen = []
        for mark, levels in marks:
            apart = math.remainder(mark - towards, 2.0 * math.pi) / half
            if abs(apart) < 1.0:
                seen.append((math.asin(apart), levels))
        u, weight = _graded(
            (*seen, (-0.5 * math.pi, rim), (0.0, 2), (0.5 * math.pi, rim)), -0.5 * math.pi, 0.5 * math.pi
        )
        return towards + half * np.sin(u), weight * half * np.cos(u)

    def _along(self, near: RealArray, far: RealArray, n: RealArray, c: RealArray, beta: RealArray) -> RealArray:
        """∫ f r g dt along the chords; t = near + (far - near) sin²(u/2) takes the roots of the
        flux at both ends."""
        chord = np.maximum(far - near, 1e-300)
        first = 2.0 * np.arcsin(np.sqrt(np.clip(-near / chord, 0.0, 1.0)))
        fewest = 1 if math.isinf(self.fourier) else self._levels
        if self.depth:
            fewest += math.ceil(math.log2(1.0 + 1.0 / self.depth))
        levels = fewest + np.ceil(np.log2(1.0 + 0.25 * beta * chord)).astype(int)
        found = np.empty(beta.shape)
        for count in np.unique(levels):
            of = levels == count
            found[of] = self._along_alike(near[of], chord[of], first[of], int(count), (n[of], c[of], beta[of]))
        return found

    def _along_alike(
        self,
        near: RealArray,
        chord: RealArray,
        first: RealArray,
        levels: int,
        to: tuple[RealArray, RealArray, RealArray],
    ) -> RealArray:
        """``_along`` with so many panels, which halve towards the field point at u = ``first``;
        what is felt depends on n, cos ψ and β in ``to``."""
        share, weight = gauss(np.append(0.0, 2.0 ** np.arange(-levels, 1.0)), _NODES)
        u = first[:, None] + (math.pi - first)[:, None] * share
        half_sine = 0.5 * np.sin(u)  # sin(u/2) cos(u/2)
        t = np.maximum(near[:, None] + chord[:, None] * np.sin(0.5 * u) ** 2, 0.0)
        felt = self._felt(t, *(part[:, None] for part in to))
        flux = 1.5 * chord[:, None] * half_sine if self.hertzian else 1.0
        return np.asarray(chord * (math.pi - first) * ((flux * half_sine * felt) @ weight))

    def _felt(self, t: RealArray, n: RealArray, c: RealArray, beta: RealArray) -> RealArray:
        """r times the temperature that a source at the distance r = n t makes, over 1/2π."""
        r = n * t
        distance = np.hypot(r, self.depth)
        beyond = self.depth**2 / np.maximum(distance + r, 1e-300) if self.depth else 0.0
        share = r / np.maximum(distance, 1e-300) if self.depth else 1.0
        steady = np.exp(-beta * t - self.peclet * beyond)
        if math.isinf(self.fourier):
            return np.asarray(share * steady)
        root = math.sqrt(self.fourier)
        reached = 0.5 * distance / root
        ahead = np.exp(self.peclet * c * t - reached**2 - (self.peclet * root) ** 2)
        late = ahead * special.erfcx(reached + self.peclet * root)
        return np.asarray(0.5 * share * (steady * special.erfc(reached - self.peclet * root) + late))


def _falling(beta: RealArray, length: RealArray) -> RealArray:
    """(1 - exp(-β L))/β, L at β = 0."""
    small = beta * length < 1e-9
    safe = np.where(small, 1.0, beta)
    return np.asarray(np.where(small, length * (1.0 - 0.5 * beta * length), -np.expm1(-safe * length) / safe))


def _graded(marks: tuple[tuple[float, int], ...], low: float, high: float) -> tuple[RealArray, RealArray]:
    """Nodes and weights between ``low`` and ``high`` on panels that halve towards each of the
    ``marks``, so many times."""
    breaks = [low, high]
    for mark, levels in marks:
        apart = np.append(0.0, 2.0 ** np.arange(1.0 - levels, 1.0)) if levels else np.zeros(1)
        breaks += [*(mark + apart), *(mark - apart)]
    inside = np.unique([each for each in breaks if low <= each <= high])
    return gauss(inside, _NODES)


def _overlap(hertzian: bool, weighted: bool, levels: int) -> tuple[RealArray, RealArray]:
    """Nodes t on (0, 2), and weights times the overlap C(t) = ∫ w(s) f(s + t) ds/∫ w ds of unit
    circles, f of the flux and w = f if ``weighted``, else 1."""
    half, weight = gauss(np.append(0.0, 2.0 ** np.arange(-float(levels), 1.0)), _NODES)
    t, weight = 2.0 * (1.0 - (1.0 - half) ** 2), weight * 4.0 * (1.0 - half)  # C falls as (2 - t)^1.5 or faster
    h = 0.5 * t
    if not hertzian:
        return t, weight * 2.0 / math.pi * (np.arccos(h) - h * np.sqrt(1.0 - h**2))
    v, across = gauss(0.5 * math.pi * (1.0 - np.append(4.0 ** -np.arange(0.0, 9.0), 0.0)), _NODES)
    top = np.sqrt(1.0 - h**2)[:, None]
    s = np.sqrt(h[:, None] ** 2 + (top * np.cos(v)) ** 2)  # half chord at the height y = top sin v
    X = (top * np.cos(v)) ** 2 / (s + h[:, None])  # half width of the lens there, s - h
    if not weighted:
        sector = 2.0 * np.arcsin(np.sqrt(X / s))  # π/2 - asin((t - s)/s)
        cut = 0.5 * (s**2 * sector - (t[:, None] - s) * np.sqrt(2.0 * t[:, None] * X))
        lens = 1.5 * cut
    else:
        u = v[:, None, None]
        width = np.sqrt((s + h[:, None]) ** 2 - (X * np.sin(u)) ** 2)
        lens = 2.25 * 2.0 * np.tensordot(across, X**2 * np.cos(u) ** 2 * width, (0, 0))
    return t, weight * 2.0 / math.pi * ((lens * top * np.cos(v)) @ across)
