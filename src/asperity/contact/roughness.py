"""The numbers of a surface that theories of rough contact are built from, measured on a map."""

from __future__ import annotations

import math

import numpy as np

from ..core import require
from ..core.errors import InputError
from ..surfaces.characterise.correlation import (
    DROP_1E,
    FractalParameters,
    autocovariance,
    fractal_parameters,
    fractal_roughness,
)
from ..surfaces.characterise.heights import deviations, height_parameters, rms_height
from ..surfaces.characterise.moments import (
    DifferenceMoments,
    SpectralMoments,
    difference_moments,
    mixed_moments,
    spectral_moments,
)
from ..surfaces.characterise.spectral_fit import MEASURED_MODEL_ERROR, fit_spectrum
from ..surfaces.characterise.spectrum import PowerSpectrum, power_spectrum, profile_spectrum, radial_spectrum
from ..surfaces.characterise.summits import profile_peaks, summits
from ..surfaces.prepare.level import filled
from ..surfaces.profile import Profile
from ..surfaces.profile_conversion import isotropic_spectrum, profile_moments, summits_of_peaks
from ..surfaces.surface import Surface
from ..theories.statistics.roughness import Fractal, MomentTensor, Roughness, Spectrum, SummitList, SummitNumbers

MOMENTS = ("auto", "spectrum", "differences")
"""Where the moments can come from."""


def roughness_of(surface: Surface | Profile, *, moments: str = "auto", neighbours: int = 8) -> Roughness:
    """Measure on ``surface`` what theories of rough contact need: moments, spectrum, summits,
    heights.

    Nothing is levelled or filtered: prepare the surface first. Missing points are filled for the
    spectrum. Of a line scan moments, heights and correlation are its own, and the spectrum is that
    of the isotropic surface that it may belong to (see ``asperity.roughness.isotropic_spectrum``);
    of its summits there are the numbers alone, which follow from the peaks of the line scan as
    those of Gaussian heights (``asperity.roughness.summits_of_peaks``). The ``assumption`` says so.

    Parameters
    ----------
    surface
        Heights positive out of the solid, facing the counter body. For two rough bodies give their
        ``composite``.
    moments
        ``"spectrum"``: sums over the modes, those of the trigonometric interpolation of a periodic
        map; ``"differences"``: finite differences between its pixels; ``"auto"``: the first for a
        periodic map, the second for a measured one, whose spectrum bears the traces of its window.
    neighbours
        4 or 8, how many neighbours a summit exceeds.

    Raises
    ------
    InputError
        If a choice is unknown, or the surface is flat or too small for second differences.
    """
    require.one_of(moments, MOMENTS, "source of the moments")
    if isinstance(surface, Profile):
        return _of_profile(surface, moments)
    spectrum = power_spectrum(filled(surface) if surface.n_missing else surface)
    from_spectrum = moments == "spectrum" or (moments == "auto" and surface.periodic)
    found: SpectralMoments | DifferenceMoments
    if from_spectrum:
        found = of = spectral_moments(spectrum)
        tensor = MomentTensor(of.m20, of.m11, of.m02, of.m40, of.m31, of.m22, of.m13, of.m04)
    else:
        found = near = difference_moments(surface)
        slopes = near.slope_tensor
        tensor = MomentTensor(
            slopes.xx, slopes.xy, slopes.yy, m40=near.m4_x, m04=near.m4_y, **mixed_moments(surface)._asdict()
        )
    peaks, covariance = summits(surface, neighbours), autocovariance(surface)
    listed = None
    if peaks.count:
        listed = SummitList(
            x=peaks.i * surface.dx,
            y=peaks.j * surface.dy,
            height=peaks.height,
            curvature=peaks.curvature,
            area=peaks.candidate_area,
            period=surface.size if surface.periodic else None,
        )
    radial = radial_spectrum(spectrum)
    shape = height_parameters(surface)
    return Roughness(
        found.m0,
        found.m2,
        found.m4,
        area=math.prod(surface.size),
        moments=tensor,
        spectrum=Spectrum(radial.q, radial.psd),
        summits=listed,
        heights=deviations(surface),
        skewness=shape.Ssk,
        kurtosis=shape.Sku,
        fractal=_fractal(surface, spectrum),
        correlation_length=0.5 * sum(covariance.correlation_length(DROP_1E, axis=axis) for axis in ("x", "y")),
    )


def _of_profile(profile: Profile, moments: str) -> Roughness:
    """Numbers of the isotropic surface of which ``profile`` is a section."""
    converted = isotropic_spectrum(profile)
    pieces = converted.pieces()
    if moments == "spectrum" or (moments == "auto" and profile.periodic):
        modes = profile_spectrum(filled(profile))
        share = np.full(modes.q.size, 2.0) / profile.length  # of both signs of a mode; the Nyquist mode is one
        share[-1] *= 0.5 if profile.n_points % 2 == 0 else 1.0
        m0, m2, m4 = (float(share @ (modes.q**order * modes.psd)) for order in (0, 2, 4))
    else:
        found = profile_moments(profile)
        m0, m2, m4 = found.m0, found.m2, found.m4
    shape = height_parameters(profile)
    fractal = None
    try:
        fit = fractal_parameters(profile)
        if fit.self_affine and fit.roughness > 0.0:
            fractal = Fractal(fit.dimension, fit.roughness, fit.first_lag, fit.last_lag)
    except InputError:  # too few lags, or no slope
        pass
    numbers = _numbers_of_summits(profile)
    return Roughness(
        m0,
        m2,
        m4,
        spectrum=Spectrum(pieces.q, pieces.psd_at),
        heights=deviations(profile),
        skewness=shape.Ssk,
        kurtosis=shape.Sku,
        fractal=fractal,
        correlation_length=autocovariance(profile).correlation_length(DROP_1E),
        assumption=converted.assumption if numbers is None else f"{converted.assumption}; {GAUSSIAN_SUMMITS}",
        summit_numbers=numbers,
    )


GAUSSIAN_SUMMITS = "its summits follow from the peaks of the line scan as those of Gaussian heights"
"""What the numbers of summits of a line scan assume beside isotropy."""


def _numbers_of_summits(profile: Profile) -> SummitNumbers | None:
    """Numbers of the summits of the isotropic surface of ``profile``; None where its peaks do not
    give them."""
    try:
        found = summits_of_peaks(profile_peaks(profile), rms_height(profile) ** 2)
        return SummitNumbers(found.density, found.radius, found.mean_height, found.height_deviation)
    except InputError:  # no peaks above the mean line, or heights that are not those of summits
        return None


def _fractal(surface: Surface, spectrum: PowerSpectrum) -> Fractal | None:
    """Dimension and roughness of self-affine profiles, in the band of the power law of the
    ``spectrum``; None unless there is one.

    Of second differences, the mean dimension and geometric mean of the fractal roughness along x
    and y, if the roll-off leaves enough lags and both agree with the spectrum; otherwise of the
    spectrum, which allows for the roll-off.
    """
    if 1 in surface.shape:
        return None
    try:
        fit = fit_spectrum(spectrum, model_error=0.0 if surface.periodic else MEASURED_MODEL_ERROR)
    except InputError:  # flat, or too few modes
        return None
    along: list[FractalParameters] = []
    for axis in ("x", "y"):
        try:
            along.append(fractal_parameters(surface, axis=axis, lag_range=fit.lag_range))
        except InputError:  # too few lags
            break
    shortest, longest = fit.band[::-1]
    if len(along) == 2 and all(found.self_affine for found in along):
        if not all(fit.agrees(found.hurst, found.dimension_error) for found in along):  # the lags alone
            shortest, longest = max(found.first_lag for found in along), min(found.last_lag for found in along)
        roughness = math.exp(0.5 * sum(math.log(found.roughness) for found in along))
        return Fractal(0.5 * sum(found.dimension for found in along), roughness, shortest, longest)
    margin = 1.96 * fit.hurst_error
    if not margin < fit.hurst < 1.0 - margin:
        return None
    dimension, pixel = 2.0 - fit.hurst, surface.dx
    roughness = fractal_roughness(dimension, fit.structure_amplitude(pixel), pixel)
    return Fractal(dimension, roughness, shortest, longest) if roughness > 0.0 else None
