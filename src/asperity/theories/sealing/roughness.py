"""Roughness in a film: flow factors φ of waves in closed form and of Gaussian surfaces by the fits
of Patir and Cheng.

With the separation H of the mean planes the flow per width is q = -φ H³/(12 η) ∂P/∂x + u_m h_T ± Δu
σ φ_s/2.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.quantity import Quantity
from ...core.values import Length, Positive
from ..ask import Way, asked
from ..protocol import Bound, Theory, curve

ISOTROPIC = 1.0
"""Peklenik number of roughness that is alike in all directions."""

PRESSURE_FIT: Mapping[float, tuple[float, float, float]] = MappingProxyType(
    {
        1.0 / 9.0: (1.48, 0.42, 1.0),
        1.0 / 6.0: (1.38, 0.42, 1.0),
        1.0 / 3.0: (1.18, 0.42, 0.75),
        1.0: (0.90, 0.56, 0.5),
        3.0: (0.225, 1.5, 0.5),
        6.0: (0.520, 1.5, 0.5),
        9.0: (0.870, 1.5, 0.5),
    }
)
"""C, r and the smallest H/σ of φ = 1 - C exp(-r H/σ) up to the Peklenik number 1, and 1 + C
(H/σ)^-r above (Patir & Cheng 1978)."""

SHEAR_FIT: Mapping[float, tuple[float, float, float, float, float]] = MappingProxyType(
    {
        1.0 / 9.0: (2.046, 1.12, 0.78, 0.03, 1.856),
        1.0 / 6.0: (1.962, 1.08, 0.77, 0.03, 1.754),
        1.0 / 3.0: (1.858, 1.01, 0.76, 0.03, 1.561),
        1.0: (1.899, 0.98, 0.92, 0.05, 1.126),
        3.0: (1.560, 0.85, 1.13, 0.08, 0.556),
        6.0: (1.290, 0.62, 1.09, 0.08, 0.388),
        9.0: (1.011, 0.54, 1.07, 0.08, 0.295),
    }
)
"""A1, α1, α2, α3 and A2 of φ_s = A1 (H/σ)^α1 exp(-α2 H/σ + α3 (H/σ)²) up to H/σ = 5, and A2
exp(-H/4σ) beyond (Patir & Cheng 1979)."""


def patir_cheng(separation: ArrayLike, peklenik: float = ISOTROPIC) -> tuple[RealArray, RealArray]:
    """Pressure and shear flow factor φ and φ_s of Gaussian roughness at the ``separation`` H/σ (any
    shape), with flow along the direction whose correlation length is ``peklenik`` times that across
    (Patir & Cheng 1978, 1979).

    The isotropic fit is good to 7 % from 2 on, and too low below.

    Raises
    ------
    InputError
        If the fit has no such Peklenik number: 1/9, 1/6, 1/3, 1, 3, 6 and 9 are there.

    Examples
    --------
    >>> pressure, shear = patir_cheng(3.0)
    >>> round(pressure.item(), 3), round(shear.item(), 3)
    (0.832, 0.553)
    """
    number = next((known for known in PRESSURE_FIT if math.isclose(known, peklenik, rel_tol=1e-2)), None)
    if number is None:
        raise InputError(
            f"Peklenik number of the fits of Patir and Cheng must be 1/9, 1/6, 1/3, 1, 3, 6 or 9, but is {peklenik:g}."
        )
    ratio = np.asarray(separation, np.float64)
    size, rate, _ = PRESSURE_FIT[number]
    # the power, whose base may be zero, is of long summits along the flow only
    pressure = 1.0 - size * np.exp(-rate * ratio) if number <= 1.0 else 1.0 + size * np.maximum(ratio, 1e-9) ** -rate
    first, power, falling, bend, far = SHEAR_FIT[number]
    near = first * ratio**power * np.exp(-falling * ratio + bend * np.minimum(ratio, 5.0) ** 2)
    return pressure, np.where(ratio <= 5.0, near, far * np.exp(-0.25 * ratio))


def waves(ratio: ArrayLike) -> tuple[RealArray, RealArray, RealArray]:
    """Flow factors of a sinusoidal gap at ``ratio`` (any shape, > 0), amplitude over mean
    separation: pressure factor along and across the grooves, and shear factor times σ/H across
    them.

    Where the wave reaches beyond the other surface, from 1 on, the overlap is cut off.
    """
    e = np.asarray(ratio, np.float64)
    inside = np.minimum(e, 1.0)
    closes = np.arccos(-1.0 / np.maximum(e, 1.0))  # half of the angle that stays open: π where nothing touches
    sine = np.sin(closes)
    cube = (
        closes + 3.0 * e * sine + 1.5 * e**2 * (closes + sine * np.cos(closes)) + e**3 * (sine - sine**3 / 3.0)
    ) / np.pi
    mean = (closes + e * sine) / np.pi
    across = (1.0 - inside**2) ** 2.5 / (1.0 + 0.5 * inside**2)
    dragged = (1.0 - inside**2) / (1.0 + 0.5 * inside**2)
    return cube, across, mean - dragged


@dataclass(frozen=True, eq=False, repr=False)
class WaveFactors(Tabled):
    """Flow factors of grooves at some separations, (n,) each.

    Parameters
    ----------
    mean_gap
        Separation of the mean planes in m.
    pressure_along, pressure_across
        φ along and across the grooves.
    shear
        φ_s of grooves that move across themselves; zero along.
    transmissivity_along, transmissivity_across
        φ H³ in m³.
    """

    mean_gap: RealArray
    pressure_along: RealArray
    pressure_across: RealArray
    shear: RealArray
    transmissivity_along: RealArray
    transmissivity_across: RealArray


@dataclass(frozen=True)
class GroovedGap(Theory):
    """A sinusoidal gap H + A cos, along the grooves, across them, and sheared, with ε = A/H and the
    rms height σ = A/√2:

        φ_x = 1 + (3/2) ε²,  φ_y = (1 - ε²)^(5/2)/(1 + ε²/2)

        φ_s = 3 (σ/H)/(1 + (σ/H)²).

    Below H = A the crests are cut off where they reach the other surface.
    """

    amplitude: Annotated[Length, "amplitude A of the wave"]
    name: ClassVar[str] = "grooved-gap"
    title: ClassVar[str] = "Reynolds, sinusoidal gap"
    citation_keys: ClassVar[tuple[str, ...]] = ("Reynolds1886", "PatirCheng1978")
    limits: ClassVar[tuple[Bound, ...]] = (
        Bound(
            "separation over amplitude",
            lambda theory, answer: answer.mean_gap / theory.amplitude,
            1.0,
            math.inf,
            "PatirCheng1978",
            "The crests touch; they are cut off and not deformed.",
        ),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("mean_gap", "m", "separation H of the mean planes"),
            "at_mean_gap",
            (
                Quantity("pressure_along", "1", "pressure flow factor along the grooves"),
                Quantity("pressure_across", "1", "pressure flow factor across the grooves"),
                Quantity("shear", "1", "shear flow factor across the grooves"),
                Quantity("transmissivity_along", "m**3", "transmissivity along the grooves"),
                Quantity("transmissivity_across", "m**3", "transmissivity across the grooves"),
            ),
        ),
    )

    def at_mean_gap(self, mean_gap: ArrayLike) -> WaveFactors:
        """The gap at separations (n,) of the mean planes in m, > 0."""
        height = curve(mean_gap, "separations (m)", positive=True)
        along, across, sheared = waves(self.amplitude / height)
        shear = sheared * height * math.sqrt(2.0) / self.amplitude
        return WaveFactors(height, along, across, shear, along * height**3, across * height**3)


@dataclass(frozen=True, eq=False, repr=False)
class FittedFactors(Tabled):
    """Flow factors of Patir and Cheng at some separations, (n,) each.

    Parameters
    ----------
    mean_gap
        Separation of the mean planes in m.
    pressure_along, pressure_across
        φ_x and φ_y.
    shear
        φ_s along x of rough body 1.
    """

    mean_gap: RealArray
    pressure_along: RealArray
    pressure_across: RealArray
    shear: RealArray


@dataclass(frozen=True)
class PatirCheng(Theory):
    """Flow factors of a Gaussian surface whose correlation length along the flow is γ times that
    across, as fitted by Patir and Cheng; if isotropic:

        φ = 1 - 0.9 exp(-0.56 H/σ).

    InputError if the fit has no such γ.
    """

    rms_height: Annotated[Length, "rms height σ of the composite surface"]
    peklenik: Annotated[Positive, "Peklenik number γ: 1/9, 1/6, 1/3, 1, 3, 6 or 9"] = ISOTROPIC
    name: ClassVar[str] = "patir-cheng"
    title: ClassVar[str] = "Patir & Cheng, flow factors"
    citation_keys: ClassVar[tuple[str, ...]] = ("PatirCheng1978", "PatirCheng1979")
    limits: ClassVar[tuple[Bound, ...]] = (
        Bound(
            "separation over rms height",
            lambda theory, answer: answer.mean_gap / theory.rms_height,
            2.0,
            math.inf,
            "PatirCheng1978",
            "The fit is too low where summits touch, and the sample decides: compute the factors from its gap.",
        ),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("mean_gap", "m", "separation H of the mean planes"),
            "at_mean_gap",
            (
                Quantity("pressure_along", "1", "pressure flow factor along the flow"),
                Quantity("pressure_across", "1", "pressure flow factor across it"),
                Quantity("shear", "1", "shear flow factor"),
            ),
        ),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        patir_cheng(1.0, self.peklenik)

    def at_mean_gap(self, mean_gap: ArrayLike) -> FittedFactors:
        """The fit at separations (n,) of the mean planes in m, > 0."""
        height = curve(mean_gap, "separations (m)", positive=True)
        ratio = height / self.rms_height
        along, shear = patir_cheng(ratio, self.peklenik)
        return FittedFactors(height, along, patir_cheng(ratio, 1.0 / self.peklenik)[0], shear)
