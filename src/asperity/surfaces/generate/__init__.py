"""Generated surfaces: deterministic shapes, spectra and Gaussian random roughness."""

from .autocorrelation import ExponentialAutocorrelation
from .gaussian import gaussian
from .shapes import bisinusoid, cone, cylinder, elliptic_paraboloid, flat, flat_punch, sinusoid, sphere
from .spectra import PlateauPSD, RmsHeight, RmsSlope, SelfAffine, Spectrum

__all__ = [
    "ExponentialAutocorrelation",
    "PlateauPSD",
    "RmsHeight",
    "RmsSlope",
    "SelfAffine",
    "Spectrum",
    "bisinusoid",
    "cone",
    "cylinder",
    "elliptic_paraboloid",
    "flat",
    "flat_punch",
    "gaussian",
    "sinusoid",
    "sphere",
]
