"""Random surfaces; equal seeds give equal surfaces. Named as the functions of ``asperity.generate`` but for ``rough``."""

from __future__ import annotations

from typing import Literal, TypeAlias

from ...core.values import Count, Density, Fraction, Length, NonNegativeLength, Positive, Real, Seed, SignedLength
from .base import GeneratedSurface
from .spectra import HeightsTable, SpectrumTable


class Rough(GeneratedSurface):
    """Gaussian random surface, or unless ``periodic`` a window of one; with amplitudes ``random``, ``fixed`` or ``nested``."""

    kind: Literal["rough"]
    seed: Seed
    exact_rms: bool = False
    variant: Literal["random", "fixed", "nested"] = "random"
    periodic: bool = True
    spectrum: SpectrumTable


class DigitalFilter(GeneratedSurface):
    """Surface by the digital filter of Hu & Tønder, with given skewness and kurtosis of the infinite surface."""

    kind: Literal["digital_filter"]
    seed: Seed
    spectrum: SpectrumTable
    skewness: Real = 0.0
    kurtosis: Positive = 3.0
    system: Literal["johnson", "pearson"] = "johnson"
    periodic: bool = False


class Translated(GeneratedSurface):
    """Periodic function of a Gaussian surface, with heights of given skewness and kurtosis."""

    kind: Literal["translated"]
    seed: Seed
    spectrum: SpectrumTable
    skewness: Real
    kurtosis: Positive
    system: Literal["johnson", "pearson"] = "johnson"
    predistorted: bool = True


class RankOrdered(GeneratedSurface):
    """Periodic surface with the given spectrum and the given distribution of heights at once."""

    kind: Literal["rank_ordered"]
    seed: Seed
    spectrum: SpectrumTable
    heights: HeightsTable
    last: Literal["heights", "spectrum"] = "heights"
    tolerance: Positive = 1e-4
    max_iterations: Count = 1000


class Bimodal(GeneratedSurface):
    """Patches of one texture, on a ``share`` of the area, in another; ``patches`` sets their size and shape."""

    kind: Literal["bimodal"]
    seed: Seed
    first: SpectrumTable
    second: SpectrumTable
    patches: SpectrumTable
    share: Fraction
    separation: SignedLength


class TwoProcess(GeneratedSurface):
    """The lower (or upper) of two random surfaces, as by honing or wear; valleys lie ``offset`` above the plateau."""

    kind: Literal["two_process"]
    seed: Seed
    plateau: SpectrumTable
    valleys: SpectrumTable
    offset: SignedLength
    keep: Literal["lower", "upper"] = "lower"


class Particles(GeneratedSurface):
    """Spheres at random places in or on a rough ``matrix``; their tops stand ``exposure`` radii above it."""

    kind: Literal["particles"]
    seed: Seed
    matrix: SpectrumTable
    density: Density
    radius: Length
    radius_deviation: NonNegativeLength | None = None
    exposure: Positive = 2.0


class WeierstrassMandelbrot(GeneratedSurface):
    """Weierstrass-Mandelbrot surface of fractal ``dimension`` between 2 and 3."""

    kind: Literal["weierstrass_mandelbrot"]
    seed: Seed
    dimension: Positive
    roughness: Length
    gamma: Positive = 1.5
    ridges: Count = 10
    length: Length | None = None
    shortest_wavelength: Length | None = None


class WeierstrassMandelbrotProfile(GeneratedSurface):
    """Weierstrass-Mandelbrot profile along x of ``dimension`` between 1 and 2; without a seed all phases are zero."""

    kind: Literal["weierstrass_mandelbrot_profile"]
    seed: Seed | None = None
    dimension: Positive
    roughness: Length
    gamma: Positive = 1.5
    length: Length | None = None
    shortest_wavelength: Length | None = None


RandomSurface: TypeAlias = (
    Rough
    | DigitalFilter
    | Translated
    | RankOrdered
    | Bimodal
    | TwoProcess
    | Particles
    | WeierstrassMandelbrot
    | WeierstrassMandelbrotProfile
)
"""A random surface."""
