"""Adhesion of a rough surface: Greenwood and Williamson's summits, each an adhesive sphere (Fuller
& Tabor 1975)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.parameters import Help
from ...core.quadrature import gauss
from ...core.quantity import Quantity
from ...core.values import Choice, Length, Number
from ..protocol import (
    BLUNT_SUMMITS,
    FEW_CONTACTS,
    Bound,
    HeightDeviation,
    MeanHeight,
    Modulus,
    Prediction,
    SummitDensity,
    SummitRadius,
    bisected,
    curve,
    prediction,
)
from ..rough.greenwood_williamson import HIGHEST, LOWEST, GreenwoodWilliamson, OnSummits
from ..statistics.roughness import Roughness
from .spheres import JKR, approach_ratio, contact_ratio, load_ratio

_NODES = 96  # over the 18 standard deviations that matter; 64 leave 1e-12
_SIGMAS = 9.0
_JUMP_IN = 4.0 ** (2.0 / 3.0)  # a/ac of JKR at zero approach


@dataclass(frozen=True)
class FullerTabor(OnSummits):
    """Summits of one radius and Gaussian heights with JKR's adhesion at each.

    With the pull-off force P_c and the extension δ_c of one summit, Δ_c = δ_c/σ_s and D the
    separation over σ_s,

        p = η P_c ∫_(D_0)^∞ f((s - D)/Δ_c) φ(s) ds,

    f = P/P_c of JKR at the approach over δ_c; D_0 = D - Δ_c when the surfaces part (summits hold on
    to -δ_c), and D when they approach (summits jump in at touch).

    Examples
    --------
    >>> soft = FullerTabor(
    ...     E_star=10e6, density=1e10, radius=10e-6, height_deviation=1e-7, work=0.05
    ... )
    >>> separation, pressure = soft.pull_off()
    >>> equal_heights = soft.density * soft.sphere.pull_off
    >>> f"{pressure / 1e3:.1f} kPa against {equal_heights / 1e3:.1f} kPa of equal heights"
    '-12.1 kPa against 23.6 kPa of equal heights'
    """

    E_star: Modulus
    density: SummitDensity
    radius: SummitRadius
    height_deviation: HeightDeviation
    work: Annotated[float, Number("J/m^2", above=0.0), Help("work of adhesion w", of="bodies")]
    mean_height: MeanHeight = 0.0
    parting: Annotated[bool, Choice({"parting": True, "approaching": False}), Help("way", of="choice")] = True
    spacing: Annotated[Length, Help("equilibrium spacing of the surfaces", of="bodies")] = 3e-10
    name: ClassVar[str] = "fuller-tabor"
    title: ClassVar[str] = "Fuller-Tabor"
    citation_keys: ClassVar[tuple[str, ...]] = ("Fuller1975", "Johnson1971")
    limits: ClassVar[tuple[Bound, ...]] = (
        FEW_CONTACTS,
        BLUNT_SUMMITS,
        Bound(
            "Tabor's parameter of a summit",
            lambda theory, answer: theory.sphere.tabor,
            5.0,
            math.inf,
            "Tabor1977",
            "Adhesion reaches beyond the contacts, which JKR leaves out.",
        ),
    )
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("theta", "1", "adhesion parameter: roughness wins for large values"),
    )

    @classmethod
    def from_roughness(
        cls, roughness: Roughness, E_star: float, *, work: float, parting: bool = True, spacing: float = 0.3e-9
    ) -> Self:
        """Theory for the summits of a map, taken as Greenwood and Williamson's.

        InputError if the roughness holds no summits, or their heights are all equal.
        """
        s = GreenwoodWilliamson.from_roughness(roughness, E_star)
        return cls(E_star, s.density, s.radius, s.height_deviation, work, s.mean_height, parting, spacing)

    @property
    def sphere(self) -> JKR:
        """One summit."""
        return JKR(self.E_star, self.radius, self.work, self.spacing)

    @property
    def reach(self) -> float:
        """Δ_c = δ_c/σ_s; adhesion hardly matters below 1/3."""
        return self.sphere.critical_extension / self.height_deviation

    @property
    def theta(self) -> float:
        """Adhesion parameter θ = E* σ_s^(3/2)/(R^(1/2) w); 1/Δ_c = (4/3)(θ/π)^(2/3)."""
        return self.E_star * self.height_deviation * math.sqrt(self.height_deviation / self.radius) / self.work

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m from the mean plane of the surface; negative
        pressures pull."""
        h = curve(separation, "separations (m)")
        D = self.summits.standardised(h)
        x, s, weight = self._summits_at(D)
        scale = self.density * self.sphere.pull_off
        return prediction(
            scale * np.sum(weight * load_ratio(x), axis=-1),
            area_fraction=self.density * math.pi * self.sphere.critical_radius**2 * np.sum(weight * x**2, axis=-1),
            contact_density=self.density * np.sum(weight, axis=-1),
            separation=h,
            stiffness=scale * np.sum(weight * load_ratio(x) * s, axis=-1) / self.height_deviation,
        )

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa, positive, on the branch that repels.

        InputError if a pressure is not positive, or larger than at 40 standard deviations below the
        mean summit height.
        """
        unit = self.density * self.sphere.pull_off
        wanted = curve(pressure, "pressures (Pa)", positive=True) / unit
        highest = float(self.load_per_summit(LOWEST))
        if wanted.max(initial=0.0) > highest:
            raise InputError(
                f"pressure must be at most {highest * unit:.4g} Pa, at which the surfaces are {-LOWEST:g} "
                f"standard deviations below the mean summit height, but is {wanted.max() * unit:.4g} Pa."
            )
        least = np.full_like(wanted, self._least()[0])
        D = bisected(lambda d: wanted - self.load_per_summit(d), np.full_like(wanted, LOWEST), least, halvings=20)
        for _ in range(4):  # Newton's method from 1e-4 on
            x, s, weight = self._summits_at(D)
            load = load_ratio(x)
            D = D + (np.sum(weight * load, axis=-1) - wanted) / np.sum(weight * load * s, axis=-1)
        return self.at_separation(self.mean_height + self.height_deviation * D)

    def pull_off(self) -> tuple[float, float]:
        """Separation in m and pressure in Pa, negative, at which a dead load parts the surfaces."""
        D, load = self._least()
        return self.mean_height + self.height_deviation * D, self.density * self.sphere.pull_off * load

    def load_per_summit(self, D: ArrayLike) -> RealArray:
        """f in units of P_c, over all summits, at the separation ``D`` = d/σ_s from their mean
        height, any shape."""
        x, _, weight = self._summits_at(np.asarray(D, dtype=float))
        return np.asarray(np.sum(weight * load_ratio(x), axis=-1))

    def _summits_at(self, D: RealArray) -> tuple[RealArray, RealArray, RealArray]:
        """Nodes x = a/a_c, their heights s, and weights of the mean over all summits; nothing has
        to be inverted in x."""
        first = 1.0 if self.parting else _JUMP_IN
        lowest = D + self.reach * float(approach_ratio(np.array(first)))
        # far apart the density falls like exp(-lowest u): it ends where it has fallen by exp(-40)
        s = np.maximum(lowest, 0.0)
        highest = np.where(lowest > 0.0, s + 80.0 / (np.sqrt(s * s + 80.0) + s), _SIGMAS)
        low, high = (contact_ratio(np.maximum((end - D) / self.reach, -1.0)) for end in (-_SIGMAS, highest))
        ends = np.stack([np.maximum(low, first), np.maximum(high, first)], axis=-1)
        x, weight = gauss(ends, _NODES)
        s = D[..., None] + self.reach * approach_ratio(x)
        step = self.reach * (2.0 * x - 2.0 / np.sqrt(x)) / 3.0
        return x, s, weight * step * np.exp(-0.5 * s * s) / math.sqrt(2.0 * math.pi)

    def _least(self) -> tuple[float, float]:
        """Separation D and load f where f is least, by ever finer grids about the least of the last
        one."""
        low, high = LOWEST / 4.0, HIGHEST / 4.0 + self.reach
        for _ in range(14):  # each a tenth of the one before
            D = np.linspace(low, high, 41)
            loads = self.load_per_summit(D)
            best = int(np.argmin(loads))
            low, high = D[max(best - 2, 0)], D[min(best + 2, 40)]
        return float(D[best]), float(loads[best])
