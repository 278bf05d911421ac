"""Generated surfaces: deterministic shapes and textures, spectra, Gaussian and other random roughness."""

from .autocorrelation import ExponentialAutocorrelation, GaussianAutocorrelation
from .bimodal import bimodal, particles, two_process
from .deterministic import (
    bisinusoid,
    cone,
    cylinder,
    dimples,
    elliptic_paraboloid,
    flat,
    flat_punch,
    grooves,
    laser_bumps,
    power_law,
    sinusoid,
    sphere,
    wedge,
    weierstrass_mandelbrot,
    weierstrass_mandelbrot_profile,
)
from .digital_filter import EndlessSurface, digital_filter, endless
from .gaussian import gaussian
from .non_gaussian import HeightMoments, HeightsOf, TwoLevels, rank_ordered, translated
from .power_laws import PlateauPSD, RmsHeight, RmsSlope
from .spectra import MeasuredSpectrum, SelfAffine, Spectrum, TabulatedSpectrum, TwoSlopes, spectrum_of

__all__ = [
    "EndlessSurface",
    "ExponentialAutocorrelation",
    "GaussianAutocorrelation",
    "HeightMoments",
    "HeightsOf",
    "MeasuredSpectrum",
    "PlateauPSD",
    "RmsHeight",
    "RmsSlope",
    "SelfAffine",
    "Spectrum",
    "TabulatedSpectrum",
    "TwoLevels",
    "TwoSlopes",
    "bimodal",
    "bisinusoid",
    "cone",
    "cylinder",
    "digital_filter",
    "dimples",
    "elliptic_paraboloid",
    "endless",
    "flat",
    "flat_punch",
    "gaussian",
    "grooves",
    "laser_bumps",
    "particles",
    "power_law",
    "rank_ordered",
    "sinusoid",
    "spectrum_of",
    "sphere",
    "translated",
    "two_process",
    "wedge",
    "weierstrass_mandelbrot",
    "weierstrass_mandelbrot_profile",
]
