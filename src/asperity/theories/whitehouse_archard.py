"""Three-point peaks of sampled Gaussian profiles (Whitehouse & Archard 1970; Whitehouse & Phillips 1978)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from ..core import require
from ..core.errors import InputError
from .protocol import Input
from .ways import Column


@dataclass(frozen=True)
class SampledPeaks:
    """Peaks of a Gaussian profile sampled at an interval ℓ, from the correlations ρ1 = ρ(ℓ) and ρ2 = ρ(2ℓ).

    A peak is a point above both neighbours. Heights are in standard deviations of the profile, curvatures
    (2 z2 - z1 - z3)/σ in σ/ℓ². At given height s the curvature C is normal with mean 2s(1 - ρ1) and variance
    2(1 + ρ2 - 2ρ1²), and the slope z1 - z3 independently normal with variance 2(1 - ρ2).

    Parameters
    ----------
    rho_1, rho_2
        Correlations, between -1 and 1, of a possible profile: 1 + ρ2 - 2ρ1² > 0.

    Raises
    ------
    InputError
        If no Gaussian profile has these correlations.
    """

    rho_1: float
    rho_2: float
    name: ClassVar[str] = "sampled-peaks"
    title: ClassVar[str] = "Whitehouse-Archard, peaks of a sampled profile"
    citation_keys: ClassVar[tuple[str, ...]] = ("Whitehouse1970", "Whitehouse1978")
    inputs: ClassVar[tuple[Input, ...]] = (
        Input("rho_1", "", "correlation of neighbouring points"),
        Input("rho_2", "", "correlation of next neighbours"),
    )
    numbers: ClassVar[tuple[Column, ...]] = (
        Column("fraction", "", "peaks per point"),
        Column("mean_height", "", "mean height of the peaks in rms heights"),
        Column("height_deviation", "", "standard deviation of their heights in rms heights"),
        Column("mean_curvature", "", "mean curvature of the peaks in rms heights per squared interval"),
        Column("curvature_deviation", "", "standard deviation of their curvature in the same unit"),
        Column("height_curvature_correlation", "", "correlation of height and curvature"),
        Column("zero_crossings", "", "crossings of the mean line per point"),
    )

    def __post_init__(self) -> None:
        require.between(self.rho_1, -1.0, 1.0, "correlation of neighbours")
        require.between(self.rho_2, -1.0, 1.0, "correlation of next neighbours")
        if not 1.0 + self.rho_2 - 2.0 * self.rho_1**2 > 0.0:
            raise InputError(
                f"correlations of a profile must have 1 + rho_2 - 2 rho_1^2 > 0, but are {self.rho_1:g}, {self.rho_2:g}."
            )

    @property
    def fraction(self) -> float:
        """Peaks per point: (1/π) arctan sqrt[(3 - 4ρ1 + ρ2)/(1 - ρ2)]."""
        return math.atan(math.sqrt(self._curvature_variance / (2.0 * (1.0 - self.rho_2)))) / math.pi

    @property
    def mean_height(self) -> float:
        """Mean height of the peaks in σ: sqrt[(1 - ρ1)/π]/(2N), N peaks per point."""
        return math.sqrt((1.0 - self.rho_1) / math.pi) / (2.0 * self.fraction)

    @property
    def mean_curvature(self) -> float:
        """Mean curvature of the peaks in σ/ℓ²: (3 - 4ρ1 + ρ2)/(2N sqrt[π(1 - ρ1)])."""
        return 0.5 * self._curvature_variance / (2.0 * self.fraction * math.sqrt(math.pi * (1.0 - self.rho_1)))

    @property
    def curvature_deviation(self) -> float:
        """Standard deviation of the curvature of the peaks in σ/ℓ²."""
        return math.sqrt(self._mean_square_curvature - self.mean_curvature**2)

    @property
    def height_deviation(self) -> float:
        """Standard deviation of the heights of the peaks in σ."""
        # the height is its regression on the curvature and an independent normal rest
        regression = self._regression
        rest = 1.0 - regression**2 * self._curvature_variance
        return math.sqrt(rest + regression**2 * self.curvature_deviation**2)

    @property
    def height_curvature_correlation(self) -> float:
        """Correlation of height and curvature over the peaks."""
        return self._regression * self.curvature_deviation / self.height_deviation

    @property
    def zero_crossings(self) -> float:
        """Crossings of the mean line per point: arccos(ρ1)/π."""
        return math.acos(self.rho_1) / math.pi

    @property
    def _curvature_variance(self) -> float:
        """Variance of C over all points: 2(3 - 4ρ1 + ρ2)."""
        return 2.0 * (3.0 - 4.0 * self.rho_1 + self.rho_2)

    @property
    def _regression(self) -> float:
        """Slope of the mean height over the curvature: 2(1 - ρ1)/Var C."""
        return 2.0 * (1.0 - self.rho_1) / self._curvature_variance

    @property
    def _mean_square_curvature(self) -> float:
        """<C²> over the peaks, from ∫₀^∞ C² n(C) erf(C/2sqrt(1 - ρ2)) dC/N with n the normal density of C.

        With a² = Var C and b² the variance of the slope, the integral is
        (a²/π) [arctan(a/b) + ab/(a² + b²)].
        """
        a, b = math.sqrt(self._curvature_variance), math.sqrt(2.0 * (1.0 - self.rho_2))
        return a**2 / math.pi * (math.atan(a / b) + a * b / (a**2 + b**2)) / self.fraction
