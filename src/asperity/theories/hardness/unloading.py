"""What an indentation curve says: the unloading stiffness, contact depth, hardness and modulus,
energies, and the depth that stays."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import minimize_scalar

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from .effective_hardness import BERKOVICH, PARABOLOID

UPPER_SHARE = 0.75
"""Part of the unloading that is fitted, from the peak load down; its end may bend with reverse
yield."""

FEWEST = 4
"""Points of a curve that determine the three values of the fit and its error."""


@dataclass(frozen=True, eq=False)
class UnloadingFit:
    """Unloading F = B (h - h_f)^m, fitted by least squares of the force.

    Attributes
    ----------
    factor, exponent
        B in N/m^m, and m: 1 punch, 1.5 paraboloid, 2 cone.
    final_depth
        h_f in m, where the fitted force vanishes.
    peak_depth, peak_force
        h_max (m) and F_max (N) at which the unloading begins.
    error
        Largest deviation of the fitted points over the peak force.
    """

    factor: float
    exponent: float
    final_depth: float
    peak_depth: float
    peak_force: float
    error: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Oliver1992",)

    @property
    def stiffness(self) -> float:
        """S = m B (h_max - h_f)^(m - 1) in N/m, at the start of the unloading."""
        return float(self.exponent * self.factor * (self.peak_depth - self.final_depth) ** (self.exponent - 1.0))

    def force(self, depth: ArrayLike) -> RealArray:
        """Fitted force in N at depths in m; zero above the final one."""
        found: RealArray = self.factor * np.maximum(np.asarray(depth, float) - self.final_depth, 0.0) ** self.exponent
        return found


def fit_unloading(depth: ArrayLike, force: ArrayLike, *, share: float = UPPER_SHARE) -> UnloadingFit:
    """Power law of the first unloading of a curve (Oliver and Pharr 1992, eq. 7).

    The unloading begins at the largest force, and ends with the curve or where the force rises
    again.

    Parameters
    ----------
    depth, force
        (n,) in m and N along the history.
    share
        Part of the peak force over which is fitted, from the peak down, 0 to 1.

    Raises
    ------
    InputError
        If the values are not finite or do not fit together, or the part to be fitted has fewer than
        four points.
    """
    h, F = unloading_part(depth, force)
    require.between(share, 0.0, 1.0 + 1e-12, "share of the unloading")
    kept = ((1.0 - share) * F[0] <= F) & (F > 0.0)
    if np.count_nonzero(kept) < FEWEST:
        raise InputError(
            f"unloading must have at least {FEWEST} points above {1.0 - share:.0%} of the peak force, but has "
            f"{np.count_nonzero(kept)}. Take more steps, or a larger share.",
            subject="unloading",
        )
    h, F = h[kept], F[kept]
    lowest, width = float(h.min()), float(np.ptp(h))

    def law(distance: float) -> tuple[float, float]:
        """Logarithm of B, and m, for a final depth that lies so many widths under the lowest point;
        points weigh as their force."""
        along = np.log((h - lowest) / width + distance)
        weights, logs = F / F[0], np.log(F / F[0])
        slope, start = np.polyfit(along, logs, 1, w=weights)
        return float(start), float(slope)

    def misfit(logarithm: float) -> float:
        start, slope = law(math.exp(logarithm))
        fitted = np.exp(start) * ((h - lowest) / width + math.exp(logarithm)) ** slope
        return float(((fitted - F / F[0]) ** 2).sum())

    tried = np.linspace(math.log(1e-6), math.log(1e2), 65)
    best = int(np.argmin([misfit(float(value)) for value in tried]))
    ends = float(tried[max(best - 1, 0)]), float(tried[min(best + 1, tried.size - 1)])
    found = minimize_scalar(misfit, bounds=ends, method="bounded", options={"xatol": 1e-12})
    distance = math.exp(float(found.x))
    start, exponent = law(distance)
    factor = math.exp(start) * F[0] / width**exponent
    final = lowest - distance * width
    error = float(np.abs(factor * (h - final) ** exponent - F).max() / F[0])
    return UnloadingFit(factor, exponent, final, float(h[0]), float(F[0]), error)


def unloading_part(depth: ArrayLike, force: ArrayLike) -> tuple[RealArray, RealArray]:
    """Depths and forces from the largest force on, as far as the force does not rise again.

    Raises
    ------
    InputError
        If the values are not finite, do not fit together, or never are above zero.
    """
    h, F = np.asarray(depth, dtype=float), np.asarray(force, dtype=float)
    if h.ndim != 1 or h.shape != F.shape or not np.isfinite(h).all() or not np.isfinite(F).all() or not F.size:
        raise InputError(
            f"depth and force of a curve must be finite and of one shape (n,), but have {h.shape} and {F.shape}.",
            subject="depth and force of a curve",
        )
    peak = int(np.argmax(F))
    if F[peak] <= 0.0:
        raise InputError(f"force (N) must be above zero somewhere on the curve, but is at most {F[peak]:g}.")
    h, F = h[peak:], F[peak:]
    rises = np.flatnonzero((np.diff(F) > 0.0) | (np.diff(h) > 0.0))
    end = int(rises[0]) + 1 if rises.size else F.size
    return h[:end], F[:end]


# Area functions: projected area of contact at the contact depth.


def berkovich_area(depth: float) -> float:
    """24.5 h² of an ideal Berkovich pyramid, m²."""
    return BERKOVICH * depth**2


def sphere_area(radius: float) -> Callable[[float], float]:
    """Area function π (2 R h - h²) of a sphere of ``radius`` in m; of the paraboloid, 2 π R h,
    where h is beyond R.

    InputError if the radius is not positive.
    """
    R = require.positive(radius, "radius (m)")
    return lambda depth: math.pi * (2.0 * R * depth - depth**2) if depth < R else math.pi * R * depth


def paraboloid_area(radius: float) -> Callable[[float], float]:
    """Area function 2 π R h of a paraboloid of ``radius`` of curvature in m. InputError if the
    radius is not positive."""
    R = require.positive(radius, "radius (m)")
    return lambda depth: 2.0 * math.pi * R * depth


def cone_area(half_angle: float) -> Callable[[float], float]:
    """Area function π (h tan θ)² of a cone of ``half_angle`` in rad, 0 to π/2. InputError
    outside."""
    tangent = math.tan(require.between(half_angle, 0.0, 0.5 * math.pi, "half angle of a cone (rad)"))
    return lambda depth: math.pi * (depth * tangent) ** 2


# Hardness, modulus and energies.


@dataclass(frozen=True, eq=False)
class IndentationAnalysis:
    """Hardness and modulus of a load-depth curve as an instrument finds them, and the energies.

    Attributes
    ----------
    unloading
        The fitted unloading.
    contact_depth
        h_c = h_max - ε F_max/S in m.
    area
        A(h_c) in m².
    hardness
        F_max/A in Pa.
    contact_modulus
        (sqrt(π)/2) S/sqrt(A) in Pa.
    true_area, true_hardness
        Area of the contact at the peak in m², and the mean pressure on it in Pa; NaN where not
        known.
    loading_work, recovered_work
        Work of the loading and work given back in the unloading, J.
    """

    unloading: UnloadingFit
    contact_depth: float
    area: float
    hardness: float
    contact_modulus: float
    true_area: float
    true_hardness: float
    loading_work: float
    recovered_work: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Oliver1992",)

    @property
    def dissipated_work(self) -> float:
        """Work that the loop of loading and unloading takes, J: plastic work and energy of the
        residual stresses."""
        return self.loading_work - self.recovered_work

    @property
    def pile_up(self) -> float:
        """True area over that of the contact depth: above 1 where the material piles up, below
        where it sinks in."""
        return self.true_area / self.area


def analyse_indentation(
    depth: ArrayLike,
    force: ArrayLike,
    area: Callable[[float], float] = berkovich_area,
    *,
    shape: float = PARABOLOID,
    share: float = UPPER_SHARE,
    true_area: float = math.nan,
) -> IndentationAnalysis:
    """Hardness and modulus of a curve of loading and unloading by the method of Oliver and Pharr
    (1992).

    Parameters
    ----------
    depth, force
        (n,) in m and N along the history, from the first touch.
    area
        Projected area (m²) of the indenter at a contact depth (m), such as ``sphere_area(R)``.
    shape
        ε: 0.72 cone, 0.75 paraboloid and Berkovich, 1 punch.
    share
        Part of the unloading that is fitted.
    true_area
        Area of the contact at the peak in m², where known: of a simulation it is.

    Raises
    ------
    InputError
        If the curve has no unloading that can be fitted, or the contact depth is not above zero.

    Examples
    --------
    >>> h = np.concatenate([np.linspace(0.0, 1e-6, 21), np.linspace(1e-6, 0.0, 21)])
    >>> elastic = 4.0 / 3.0 * 100e9 * np.sqrt(10e-6) * h**1.5
    >>> found = analyse_indentation(h, elastic, paraboloid_area(10e-6))
    >>> f"{found.contact_modulus / 1e9:.2f} GPa, {found.unloading.exponent:.3f}"
    '100.00 GPa, 1.500'
    """
    fit = fit_unloading(depth, force, share=share)
    h, F = np.asarray(depth, dtype=float), np.asarray(force, dtype=float)
    factor = require.within(shape, 0.0, 1.0, "shape factor ε of an indenter")
    deep = fit.peak_depth - factor * fit.peak_force / fit.stiffness
    if deep <= 0.0:
        raise InputError(
            f"contact depth (m) must be above zero, but is {deep:g}: the unloading springs back by more than "
            "was pressed in. Check depth and force.",
            subject="contact depth (m)",
        )
    size = float(area(deep))
    peak = int(np.argmax(F))
    back = unloading_part(h, F)
    return IndentationAnalysis(
        fit,
        deep,
        size,
        fit.peak_force / size,
        0.5 * math.sqrt(math.pi / size) * fit.stiffness,
        true_area,
        fit.peak_force / true_area,
        float(np.trapezoid(F[: peak + 1], h[: peak + 1])),
        float(-np.trapezoid(back[1], back[0])),
    )


def residual_depth(ratio: ArrayLike) -> RealArray:
    """Depth that stays over the largest approach of a flattened elastic-plastic ball (Etsion,
    Kligerman and Kadin 2005).

        δ_res/δ_max = (1 - x^-0.33) (1 - x^-0.31),   x = δ_max/δ_y.

    A fit to finite elements for 1 <= x <= 170, ν = 0.3; zero below first yield. Indented
    half-spaces keep some per cent more.

    Parameters
    ----------
    ratio
        x, >= 0, of any shape.

    Raises
    ------
    InputError
        If a ratio is negative or not finite.
    """
    x = np.asarray(ratio, dtype=float)
    if np.any(~(np.isfinite(x) & (x >= 0.0))):
        raise InputError("ratio must be finite and at least zero, but some are not.")
    x = np.maximum(x, 1.0)
    found: RealArray = (1.0 - x**-0.33) * (1.0 - x**-0.31)
    return found
