"""Generated surfaces: deterministic shapes and textures, spectra, Gaussian and other random roughness."""

from .amplitude import PlateauPSD, RmsHeight, RmsSlope
from .autocorrelation import ExponentialAutocorrelation, GaussianAutocorrelation
from .bimodal import bimodal, particles, two_process
from .digital_filter import EndlessSurface, digital_filter, endless
from .gaussian import gaussian
from .marginal import HeightMoments, HeightsOf, TwoLevels
from .measured import MeasuredSpectrum, TabulatedSpectrum, spectrum_of
from .rank_ordered import rank_ordered
from .shapes import (
    bisinusoid,
    cone,
    cylinder,
    elliptic_paraboloid,
    flat,
    flat_punch,
    power_law,
    sinusoid,
    sphere,
    wedge,
)
from .spectra import SelfAffine, Spectrum, TwoSlopes
from .textures import dimples, grooves, laser_bumps
from .translation import translated
from .weierstrass import weierstrass_mandelbrot, weierstrass_mandelbrot_profile

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
