from .surfaces.generate.autocorrelation import ExponentialAutocorrelation, GaussianAutocorrelation
from .surfaces.generate.bimodal import bimodal, particles, two_process
from .surfaces.generate.deterministic import (
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
from .surfaces.generate.digital_filter import EndlessSurface, digital_filter, endless
from .surfaces.generate.gaussian import gaussian
from .surfaces.generate.non_gaussian import HeightMoments, HeightsOf, TwoLevels, Weibull, rank_ordered, translated
from .surfaces.generate.power_laws import PlateauPSD, RmsHeight, RmsSlope
from .surfaces.generate.spectra import MeasuredSpectrum, SelfAffine, Spectrum, TabulatedSpectrum, TwoSlopes, spectrum_of
from .surfaces.profile_conversion import surface_of_profile

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
    "Weibull",
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
    "surface_of_profile",
    "translated",
    "two_process",
    "wedge",
    "weierstrass_mandelbrot",
    "weierstrass_mandelbrot_profile",
]
