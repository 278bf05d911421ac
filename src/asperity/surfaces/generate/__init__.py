"""Generated surfaces: deterministic shapes, spectra and Gaussian random roughness."""

from .amplitude import PlateauPSD, RmsHeight, RmsSlope
from .autocorrelation import ExponentialAutocorrelation, GaussianAutocorrelation
from .gaussian import gaussian
from .shapes import bisinusoid, cone, cylinder, elliptic_paraboloid, flat, flat_punch, sinusoid, sphere
from .spectra import SelfAffine, Spectrum, TwoSlopes

__all__ = [
    "ExponentialAutocorrelation",
    "GaussianAutocorrelation",
    "PlateauPSD",
    "RmsHeight",
    "RmsSlope",
    "SelfAffine",
    "Spectrum",
    "TwoSlopes",
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
