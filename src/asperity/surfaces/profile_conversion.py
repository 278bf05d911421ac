"""From a line scan to the isotropic surface it may belong to: spectrum, moments, summits, each with
its assumption."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated, ClassVar, Literal

import numpy as np

from ..core import require
from ..core.arrays import BoolArray, RealArray
from ..core.errors import InputError
from ..core.grid import Grid
from ..core.late import Shown
from ..core.parameters import checked
from ..core.scipy_parts import optimize, special
from ..core.units import show
from .characterise.expectation import RingExpectation
from .characterise.heights import rms_height
from .characterise.moments import nayak_parameter
from .characterise.slopes import rms_profile_curvature, rms_profile_slope
from .characterise.spectral_fit import SHAPES, fitted_shape
from .characterise.spectrum import LOST_MODES, ProfileSpectrum, RadialSpectrum, profile_spectrum
from .characterise.summits import ProfilePeaks
from .generate.gaussian import SurfaceSeed, gaussian
from .generate.non_gaussian import HeightsOf, rank_ordered
from .prepare.level import filled, levelled
from .profile import Profile
from .profile_spectra import MapPieces, ProfilePieces, RoundedSpectrum
from .surface import Surface, strip

ISOTROPY = "the surface is isotropic, so that this line scan stands for every direction"
"""What every conversion by the spectrum assumes; one line scan cannot test it."""

MODELS = ("auto", "rounded", "pieces")
"""Models of the spectrum of a line scan."""

_FIRST = {"none": 1, "hann": 3}  # modes; the window mixes the first with the mean and the tilt
_LAST = 0.35 * math.pi  # q Δ up to which points alias little
_CLEAR_OF_FILTER = 4.0  # wavelengths over the short cut-off from which a Gaussian filter takes less than a tenth
_PER_DECADE = 40  # rings; the model hardly bends within one
_IMAGES = 4  # aliases on either side that are summed one by one
_APART = 1e-6  # share by which bends of a spectrum differ at the least
_STEP = 1e-4  # of derivatives by parameters of order one
_FEWEST = 8  # modes of a fit
_HURST = (0.01, 3.0)


@dataclass(frozen=True, eq=False)
class ConvertedSpectrum:
    """Spectrum of the isotropic surface of a line scan, which ``asperity.generate.gaussian`` takes
    as a spectrum.

    ``model`` rounded, or power-law pieces; ``errors`` relative standard errors of its parameters
    (Fisher information), absolute of ``hurst``; ``first``, ``last`` wavenumber (rad/m) of the
    fitted band; ``shortest_wavelength`` (m) beyond which the surface has no waves; ``criteria``
    Bayesian information criterion, less the best, by model; ``assumption`` in words; ``source`` of
    the line scan.
    """

    model: RoundedSpectrum | ProfilePieces
    errors: dict[str, float]
    first: float
    last: float
    shortest_wavelength: float
    criteria: dict[str, float]
    assumption: str
    source: str
    citation_keys: ClassVar[tuple[str, ...]] = ("Jacobs2017", "Whittle1953")

    @property
    def correlation_range(self) -> float:
        """Distance in m beyond which heights are taken as uncorrelated."""
        corner = self.model.corner if isinstance(self.model, RoundedSpectrum) else float(self.model.q[0])
        return 4.0 * math.pi / max(corner, self.first)

    @property
    def hurst(self) -> float:
        """Hurst exponent: that of the rounded model, or (p - 1)/2 of the last piece."""
        if isinstance(self.model, RoundedSpectrum):
            return self.model.hurst
        return 0.5 * (float(self.model.exponents[-1]) - 1.0)

    def psd(self, q: RealArray | float) -> RealArray:
        """C in m⁴ of the surface at the wavenumbers ``q`` (rad/m, any shape), zero at q = 0 and
        beyond its shortest wave."""
        number = np.asarray(q, dtype=float)
        inside = (number > 0.0) & (number <= 2.0 * math.pi / self.shortest_wavelength * (1.0 + 1e-9))
        return np.where(inside, self.model.psd(np.where(inside, number, self.last)), 0.0)

    def profile_psd(self, k: RealArray | float) -> RealArray:
        """C1D in m³ of the fitted line scan at the wavenumbers ``k`` (rad/m, any shape), without
        the cut of the surface."""
        return self.model.profile_psd(k)

    def pieces(self, per_decade: int = 20) -> MapPieces:
        """The surface as power-law pieces from a tenth of the first fitted wavenumber, a plateau,
        to its shortest wave."""
        first, last = 0.1 * self.first, 2.0 * math.pi / self.shortest_wavelength
        q = np.geomspace(first, last, 2 + int(per_decade * math.log10(last / first)))
        return MapPieces(q, self.psd(q))

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0."""
        return self.psd(grid.wavenumber())

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        kind = "power-law pieces"
        if isinstance(self.model, RoundedSpectrum):
            kind = f"rounded roll-off at {show(self.model.rolloff_wavelength, 'm')}"
        source = f" of {self.source}" if self.source else ""
        return (
            f"spectrum of a line scan{source}, {kind}, H = {self.hurst:.3g}, waves down to "
            f"{show(self.shortest_wavelength, 'm')}; assumption: {self.assumption}"
        )


def isotropic_spectrum(
    profile: Profile, *, model: str = "auto", shortest_wavelength: float | None = None
) -> ConvertedSpectrum:
    """Spectrum of the isotropic surface of which ``profile`` is a section, by a model fitted
    through the exact relation.

    Whittle's likelihood of the profile's modes, from the third with a Hann window (the first of a
    closed profile) to qΔ = 0.35π, or a quarter of the short cut-off. Points that are not filtered
    alias, which is part of the rounded model; of pieces it flattens the last by up to 0.05 in H.
    Raises InputError if the model is unknown, fewer than eight modes are left, or the profile is
    flat.

    Parameters
    ----------
    profile
        Line scan; missing points are bridged, and its mean or line is removed.
    model
        ``rounded`` roll-off (see ``RoundedSpectrum``), continuous power-law ``pieces`` with up to
        two slopes, or the better of both by the Bayesian information criterion (``auto``).
    shortest_wavelength
        Shortest wave of the surface in m, where its spectrum is cut on a disc; by default the
        shortest that was fitted. A shorter one extrapolates, which the words of the spectrum say.
    """
    require.one_of(model, MODELS, "model of the spectrum of a line scan")
    spectrum = profile_spectrum(levelled(filled(profile)))
    last = _LAST / profile.spacing
    if profile.short_cutoff > 0.0:
        last = min(last, 2.0 * math.pi / (_CLEAR_OF_FILTER * profile.short_cutoff))
    first = _FIRST[spectrum.window]
    part = (np.arange(1, spectrum.q.size + 1) >= first) & (spectrum.q <= last)
    if (count := int(np.count_nonzero(part))) < _FEWEST:
        raise InputError(
            f"line scan must have at least {_FEWEST} modes with power for its spectrum, but has {count}. Take a longer "
            "one, or a lower cut-off."
        )
    if lost_modes := count - int(np.count_nonzero(spectrum.psd[part] > 0.0)):
        raise InputError(
            f"line scan must have power in all modes of its spectrum, but {lost_modes} of {count} have none: it is "
            "flat, or cut sharply. State below which wavelength it has been filtered, as short_cutoff of the Profile.",
            subject="line scan",
        )
    q, rings = spectrum.q[part], _rings(spectrum, part)
    lost = LOST_MODES[spectrum.window]
    found = []
    if model in ("auto", "rounded"):
        found.append(_rounded(rings, lost, None if profile.short_cutoff > 0.0 else profile.spacing))
    if model in ("auto", "pieces"):
        found.append(_pieces(rings, lost))
    best = min(found, key=lambda item: item.criterion)
    shortest = 2.0 * math.pi / float(q[-1])
    assumption = ISOTROPY
    if not math.isnan(profile.lay_angle):
        angle = f"{math.degrees(profile.lay_angle):.4g}°"
        assumption += f", although it is stated to cross a lay, {angle} off its normal"
    if shortest_wavelength is not None:
        given = require.positive(shortest_wavelength, "shortest wavelength of the surface (m)")
        if given < shortest * (1.0 - 1e-9):
            assumption += f"; waves shorter than {show(shortest, 'm')} are extrapolated"
        shortest = given
    return ConvertedSpectrum(
        best.model,
        best.errors,
        first=float(q[0]),
        last=float(q[-1]),
        shortest_wavelength=shortest,
        criteria={item.name: item.criterion - best.criterion for item in found},
        assumption=assumption,
        source=profile.origin.source,
    )


@dataclass(frozen=True, eq=False)
class _Fit:
    name: str
    model: RoundedSpectrum | ProfilePieces
    errors: dict[str, float]
    criterion: float


def _rounded(rings: RadialSpectrum, lost: float, sampled: float | None) -> _Fit:
    """Rounded model with the largest likelihood of the modes, by ln C1D(0), ln q0 and H.

    With ``sampled`` points a spacing (m) apart, what their aliases add is part of the model.
    """
    unit_q, unit_c = math.sqrt(float(rings.q[0] * rings.q[-1])), float(np.exp(np.mean(np.log(rings.psd))))
    x, measured, count = rings.q / unit_q, rings.psd / unit_c, 0.5 * rings.modes
    turn = math.inf if sampled is None else 2.0 * math.pi / (sampled * unit_q)
    images = np.array([0.0, *(turn * j for j in range(-_IMAGES, _IMAGES + 1) if j)]) if sampled else np.zeros(1)

    def log_psd(values: RealArray) -> RealArray:
        level, corner, H = (float(value) for value in values)
        terms = (1.0 + np.square((x[:, None] + images) * math.exp(-corner))) ** -(0.5 + H)
        total = terms.sum(axis=1)
        if sampled:  # all further images, on the power law
            total += 2.0 * special.zeta(1.0 + 2.0 * H, _IMAGES + 1.0) * (turn * math.exp(-corner)) ** -(1.0 + 2.0 * H)
        return np.asarray(level + np.log(total))

    def deviance(values: RealArray) -> float:
        log_c = log_psd(values)
        return float(count @ (measured * np.exp(-log_c) + log_c)) / float(count.sum())

    low, high = math.log(x[0]) - 2.0, math.log(x[-1])
    bounds = [(-60.0, 60.0), (low, high), _HURST]
    starts = []
    for corner in np.linspace(low + 1.0, high - 0.5, 4):
        below = x <= max(math.exp(corner), x[min(3, x.size - 1)])
        starts += [np.array([math.log(float(measured[below].mean())), corner, H]) for H in (0.4, 0.9)]
    starts.sort(key=deviance)
    runs = [
        optimize.minimize(deviance, start, bounds=bounds, method="L-BFGS-B", options={"ftol": 1e-13})
        for start in starts[:2]
    ]
    run = min(runs, key=lambda item: float(item.fun))
    level, corner, H = (float(value) for value in run.x)
    one = RoundedSpectrum(1.0, math.exp(corner) * unit_q, H)
    model = replace(one, level=unit_c * math.exp(level) / float(one.profile_psd(0.0)))
    rows = np.array([log_psd(run.x + step) - log_psd(run.x - step) for step in _STEP * np.eye(3)]) / (2.0 * _STEP)
    errors = {"level": math.nan, "corner": math.nan, "hurst": math.nan}
    information = (rows * count) @ rows.T / lost
    if np.linalg.cond(information) < 1e12:
        spread = np.sqrt(np.diag(np.linalg.inv(information)))
        errors = {name: float(error) for name, error in zip(errors, spread, strict=True)}
    total = float(count.sum())
    criterion = 2.0 * total * (float(run.fun) + math.log(unit_c)) / lost + 3.0 * math.log(total)
    return _Fit("rounded", model, errors, criterion)


def _rings(spectrum: ProfileSpectrum, part: BoolArray) -> RadialSpectrum:
    """Means over narrow logarithmic rings of the modes in ``part``; a mode and its opposite count
    as two."""
    q, power = spectrum.q[part], spectrum.psd[part]
    count = 2 + int(_PER_DECADE * math.log10(q[-1] / q[0]))
    edges = np.geomspace(q[0] * (1.0 - 1e-9), q[-1] * (1.0 + 1e-9), count)
    ring = np.searchsorted(edges, q, side="left") - 1
    modes = np.bincount(ring, minlength=count - 1).astype(float)
    kept = modes > 0.0
    log_q, psd = (np.bincount(ring, values, count - 1)[kept] / modes[kept] for values in (np.log(q), power))
    return RadialSpectrum(np.exp(log_q), psd, 2.0 * modes[kept], edges[:-1][kept], edges[1:][kept], spectrum.window)


def _pieces(rings: RadialSpectrum, lost: float) -> _Fit:
    """Power-law pieces without floor with the best criterion, by the same fit as the spectra of
    maps."""
    found, count = [], 0.5 * rings.modes
    plain = RingExpectation(rings.q, np.eye(rings.q.size))
    first, last = float(rings.q[0]), float(rings.q[-1])
    for shape in SHAPES:
        if shape.floor or shape.rounded or shape.folded or shape.parameters >= rings.q.size:
            continue
        solution = fitted_shape(rings, shape, plain)
        model = solution.model(2.0 * math.pi / first)
        bends = [2.0 * math.pi / model.rolloff_wavelength]
        if len(model.exponents) == 2:
            bends.append(2.0 * math.pi / model.crossover_wavelength)
        inner = [bend for bend in sorted(bends) if first * (1.0 + _APART) < bend < last / (1.0 + _APART)]
        if len(inner) == 2 and inner[1] < inner[0] * (1.0 + _APART):
            inner = inner[:1]
        nodes = np.array([first, *inner, last])
        pieces = ProfilePieces(nodes, np.asarray(model.psd(nodes)))
        if pieces.exponents[-1] <= 0.0 or pieces.exponents.min() <= -1.0:
            continue
        errors = solution.errors(rings, lost)
        errors["hurst"] = 0.5 * errors.get(f"exponent_{len(model.exponents)}", math.nan)
        log_c = np.log(pieces.profile_psd(rings.q))
        deviance = 2.0 * float(count @ (rings.psd * np.exp(-log_c) + log_c)) / lost
        found.append(_Fit("pieces", pieces, errors, deviance + shape.parameters * math.log(float(count.sum()))))
    if not found:
        raise InputError(
            "spectrum of a line scan must fall towards short waves to be that of a surface, but does not. "
            "Filter its noise."
        )
    return min(found, key=lambda item: item.criterion)


# Moments and summits.


@dataclass(frozen=True)
class ProfileMoments(Shown):
    """Moments of a line scan, and what they are of the isotropic surface it belongs to.

    ``m0`` (m²), ``m2``, ``m4`` (1/m²) mean square height, slope and second derivative; of a profile
    by definition, so that they need no conversion. ``spacing`` in m at which the differences were
    taken, on which m2 and m4 depend.
    """

    m0: float
    m2: float
    m4: float
    spacing: float
    assumption: ClassVar[str] = ISOTROPY

    @property
    def alpha(self) -> float:
        """Nayak's parameter m0 m4/m2², at least 1.5 for an isotropic Gaussian surface; NaN without
        slopes."""
        return nayak_parameter(self.m0, self.m2, self.m4)

    @property
    def rms_gradient(self) -> float:
        """Of the isotropic surface: sqrt(2) times the rms slope of the profile."""
        return math.sqrt(2.0 * self.m2)

    @property
    def rms_laplacian(self) -> float:
        """Of the isotropic surface in 1/m: sqrt(8/3) times the rms second derivative of the
        profile."""
        return math.sqrt(8.0 / 3.0 * self.m4)

    def in_words(self) -> tuple[str, list[tuple[str, str]]]:
        """Heading and numbers."""
        rows = [
            ("m0", show(self.m0, "m**2")),
            ("m2", show(self.m2, "1")),
            ("m4", show(self.m4, "m**-2")),
            ("Nayak parameter", show(self.alpha, "1")),
            ("rms gradient of the isotropic surface", show(self.rms_gradient, "1")),
            ("rms Laplacian of the isotropic surface", show(self.rms_laplacian, "m**-1")),
        ]
        return "Moments of a line scan", rows


def profile_moments(profile: Profile) -> ProfileMoments:
    """Moments of ``profile`` by forward first and central second differences over its valid points.

    Raises InputError if there are no three valid neighbours.
    """
    return ProfileMoments(
        m0=rms_height(profile) ** 2,
        m2=rms_profile_slope(profile) ** 2,
        m4=rms_profile_curvature(profile) ** 2,
        spacing=profile.spacing,
    )


@dataclass(frozen=True)
class SummitsOfPeaks(Shown):
    """Summits of the isotropic Gaussian surface whose profiles have the counted peaks.

    ``density`` (1/m²), ``mean_height``, ``height_deviation`` (m), ``mean_curvature`` (1/m),
    ``alpha`` = π m0/(2 z̄_p²). All depend on the spacing of the profile. Taking peaks *as* summits
    would underestimate the heights by 1.8 and the curvatures by 1.2.
    """

    density: float
    mean_height: float
    height_deviation: float
    mean_curvature: float
    alpha: float
    assumption: ClassVar[str] = f"heights are Gaussian, and {ISOTROPY}"
    citation_keys: ClassVar[tuple[str, ...]] = ("Nayak1971", "Whitehouse1970")

    @property
    def radius(self) -> float:
        """1/<κ> in m."""
        return 1.0 / self.mean_curvature

    def in_words(self) -> tuple[str, list[tuple[str, str]]]:
        """Heading and numbers."""
        rows = [
            ("density of summits", show(self.density, "m**-2")),
            ("mean summit height", show(self.mean_height, "m")),
            ("standard deviation of summit heights", show(self.height_deviation, "m")),
            ("mean summit curvature", show(self.mean_curvature, "m**-1")),
        ]
        return "Summits from the peaks of a line scan", rows


def summits_of_peaks(peaks: ProfilePeaks, m0: float) -> SummitsOfPeaks:
    """Summits from counted ``peaks`` of a profile of the mean square height ``m0`` (m²).

    D = 2π/(3 sqrt 3) N_p², z̄_s = (4 sqrt 2/π) z̄_p, <κ> = (8 sqrt 2/(3π)) κ̄_p, σ_s² = m0 (1 -
    0.8968/α). Raises InputError if there are no peaks above the mean line, or m0 is not positive.
    """
    square = require.positive(m0, "mean square height m0 (m^2)")
    if not (peaks.density > 0.0 and peaks.mean_height > 0.0):
        raise InputError("peaks of a profile must stand above its mean line on average, but do not or are none.")
    alpha = 0.5 * math.pi * square / peaks.mean_height**2
    return SummitsOfPeaks(
        density=2.0 * math.pi / (3.0 * math.sqrt(3.0)) * peaks.density**2,
        mean_height=4.0 * math.sqrt(2.0) / math.pi * peaks.mean_height,
        height_deviation=math.sqrt(square * max(0.0, 1.0 - 0.8968 / alpha)),
        mean_curvature=8.0 * math.sqrt(2.0) / (3.0 * math.pi) * peaks.mean_curvature,
        alpha=alpha,
    )


# A surface with the spectrum of the profile.


@checked
def surface_of_profile(
    profile: Annotated[Profile, "line scan whose spectrum the surface has"],
    grid: Grid,
    *,
    seed: SurfaceSeed,
    model: Annotated[
        Literal["auto", "rounded", "pieces"], "of the spectrum: a rounded roll-off or power laws"
    ] = "auto",
    heights: Annotated[bool, "impose the height distribution of the profile"] = False,
    periodic: Annotated[bool, "periodic surface, or a window of one"] = True,
) -> Surface:
    """Isotropic random surface with the spectrum of a line scan, on the assumption that its surface
    is isotropic.

    The assumption stands in its history. With ``heights`` its distribution is that of the profile,
    which is the same in a profile and in the map, by rank ordering (of a periodic surface). The
    spectrum ends at the shortest wave that the profile or the grid resolves. Raises InputError if
    the spectrum cannot be had (see :func:`isotropic_spectrum`), or a window is to have the heights.
    """
    shortest = 2.0 * max(grid.spacing)
    spectrum = isotropic_spectrum(profile, model=model)
    if shortest > spectrum.shortest_wavelength:
        spectrum = replace(spectrum, shortest_wavelength=shortest)
    if not heights:
        return gaussian(grid, spectrum, seed=seed, periodic=periodic)
    if not periodic:
        raise InputError(
            "surface with the heights of a profile must be periodic, but is not. Leave out periodic or heights."
        )
    return rank_ordered(grid, spectrum, heights=HeightsOf(strip(levelled(profile))), seed=seed)
