"""Weierstrass-Mandelbrot functions: deterministic fractal profiles and surfaces of a discrete spectrum."""

from __future__ import annotations

import math
from typing import Annotated, TypeAlias

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.parameters import checked
from ...core.units import show
from ...core.values import Count, Length, Number, Seed
from ..surface import Surface, generated
from .gaussian import SurfaceSeed

FrequencyRatio: TypeAlias = Annotated[
    float, Number(above=1.0, fix="1.5 is usual."), "ratio γ of neighbouring frequencies"
]
FractalRoughness: TypeAlias = Annotated[Length, "fractal roughness G: a scale of the amplitudes, not a height"]
ShortestWave: TypeAlias = Annotated[Length | None, "shortest wave L_s; two pixels if left out"]
LongestWave: TypeAlias = Annotated[Length | None, "longest wave L; the size of the grid if left out"]

_MOST_WAVES = 100_000
_SOURCE = "Weierstrass-Mandelbrot"


@checked
def weierstrass_mandelbrot(
    grid: Grid,
    *,
    dimension: Annotated[float, Number(above=2.0, below=3.0), "fractal dimension D of the surface"],
    roughness: FractalRoughness,
    seed: SurfaceSeed,
    gamma: FrequencyRatio = 1.5,
    ridges: Annotated[Count, "number M of directions"] = 10,
    length: LongestWave = None,
    shortest_wavelength: ShortestWave = None,
) -> Surface:
    """Weierstrass-Mandelbrot surface (Ausloos & Berman 1985; Yan & Komvopoulos 1998) without its constant.

    z = -L (G/L)^(D-2) sqrt(ln γ/M) Σ_m Σ_n γ^((D-3)n) cos[2π γ^n (x cos(πm/M) + y sin(πm/M))/L + φ_mn], m = 1…M, n = 0…n_max,
    n_max = floor(ln(L/L_s)/ln γ), phases φ uniform. The spectrum is a set of lines, the map is not periodic, and isotropic only
    for many ridges; prefer :func:`gaussian` unless a published case is to be repeated.
    """
    longest, shortest = _limits(length, shortest_wavelength, max(grid.size), max(grid.spacing))
    if shortest > longest:
        raise InputError(
            f"shortest wave must not be longer than the longest ({longest:g} m), but is {shortest:g} m. Refine the grid."
        )
    count = math.floor(math.log(longest / shortest) / math.log(gamma) + 1e-9) + 1
    _require_count(count * ridges)
    powers = np.arange(count, dtype=float)
    phases = _phases(seed, (ridges, powers.size))
    angle = np.pi * np.arange(1, ridges + 1)[:, None] / ridges
    q = 2.0 * np.pi * gamma**powers / longest
    level = longest * (roughness / longest) ** (dimension - 2.0) * math.sqrt(math.log(gamma) / ridges)
    amplitude = np.broadcast_to(-level * gamma ** ((dimension - 3.0) * powers), phases.shape)
    heights = _waves(grid, (q * np.cos(angle)).ravel(), (q * np.sin(angle)).ravel(), amplitude.ravel(), phases.ravel())
    text = (
        f"Weierstrass-Mandelbrot surface, dimension {dimension:.4g}, roughness {show(roughness, 'm')}, γ {gamma:.4g}, "
        f"{ridges} ridges, {powers.size} waves each from {show(longest, 'm')} down, PCG64 seed {seed}"
    )
    return generated(grid, heights, _SOURCE, text, periodic=False, citation_keys=("Ausloos1985", "Yan1998"))


@checked
def weierstrass_mandelbrot_profile(
    grid: Grid,
    *,
    dimension: Annotated[float, Number(above=1.0, below=2.0), "fractal dimension D of the profile"],
    roughness: FractalRoughness,
    gamma: FrequencyRatio = 1.5,
    length: LongestWave = None,
    shortest_wavelength: ShortestWave = None,
    seed: Annotated[Seed | None, "seed of random phases; all are 0 if left out"] = None,
) -> Surface:
    """Weierstrass-Mandelbrot profile along x, equal for all y: z = G^(D-1) Σ cos(2π γ^n x + φ_n)/γ^((2-D)n), n = n1…n2.

    γ^n counts cycles per metre; n1 = floor(ln(1/L)/ln γ), n2 = ceil(ln(1/L_s)/ln γ) (Majumdar & Bhushan 1990).
    """
    longest, shortest = _limits(length, shortest_wavelength, grid.size[0], grid.spacing[0])
    first = math.floor(math.log(1.0 / longest) / math.log(gamma))
    powers = np.arange(first, math.ceil(math.log(1.0 / shortest) / math.log(gamma)) + 1, dtype=float)
    _require_count(powers.size)
    phases = np.zeros(powers.size) if seed is None else _phases(seed, (powers.size,))
    amplitude = roughness ** (dimension - 1.0) * gamma ** (-(2.0 - dimension) * powers)
    x = grid.coordinates()[0]
    profile = np.cos(2.0 * np.pi * gamma**powers * x + phases) @ amplitude
    how = "phases 0" if seed is None else f"phases of PCG64 seed {seed}"
    text = (
        f"Weierstrass-Mandelbrot profile, dimension {dimension:.4g}, roughness {show(roughness, 'm')}, γ {gamma:.4g}, "
        f"powers {first} to {int(powers[-1])}, {how}"
    )
    heights = np.broadcast_to(profile[:, None], grid.shape)
    return generated(grid, heights, _SOURCE, text, periodic=False, citation_keys=("Majumdar1990",))


def _phases(seed: int, shape: tuple[int, ...]) -> RealArray:
    return np.random.Generator(np.random.PCG64(seed)).uniform(0.0, 2.0 * np.pi, shape)


def _limits(longest: float | None, shortest: float | None, size: float, spacing: float) -> tuple[float, float]:
    """Longest and shortest wave in m: the size and two pixels if they are not given."""
    return size if longest is None else longest, 2.0 * spacing if shortest is None else shortest


def _require_count(count: int) -> None:
    if not 0 < count <= _MOST_WAVES:
        raise InputError(
            f"waves of a Weierstrass-Mandelbrot function must be between 1 and {_MOST_WAVES}, but are {count}. "
            "Change γ, the wavelengths or the number of ridges."
        )


def _waves(grid: Grid, qx: RealArray, qy: RealArray, amplitude: RealArray, phase: RealArray) -> RealArray:
    """Σ a cos(qx x + qy y + φ) at all nodes, as one matrix product: cos(α + β) is the real part of e^(iα) e^(iβ)."""
    x, y = grid.coordinates()
    along_x, along_y = qx * x + phase, qy * y.T
    heights: RealArray = (np.cos(along_x) * amplitude) @ np.cos(along_y).T
    heights -= (np.sin(along_x) * amplitude) @ np.sin(along_y).T
    return heights
