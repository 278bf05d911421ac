"""The roughness of surfaces, as ``asperity.roughness``: every quantity as a function.

``asperity.characterise`` calls them all; ``QUANTITIES`` says what each number is.
"""

from ..core.quantity import Quantity
from .characterise.autocorrelation import DROP_1E, DROP_ISO, DROP_TENTH, Autocovariance, autocovariance
from .characterise.distribution import HeightDistribution, height_distribution
from .characterise.expectation import effective_samples, expected_difference_moments, mean_square_after_levelling
from .characterise.fractal import (
    FractalParameters,
    fitted_fractal,
    fractal_parameters,
    fractal_roughness,
    spectrum_coefficient,
    structure_coefficient,
)
from .characterise.heights import (
    HeightParameters,
    deepest_valley,
    height_parameters,
    highest_peak,
    kurtosis,
    mean_absolute_height,
    peak_to_valley,
    rms_height,
    skewness,
)
from .characterise.material_ratio import (
    Core,
    FunctionalParameters,
    MaterialRatioCurve,
    core,
    functional_parameters,
    material_ratio_curve,
)
from .characterise.moments import (
    DifferenceMoments,
    SlopeTensor,
    SpectralMoments,
    difference_moments,
    nayak_parameter,
    slope_tensor,
    spectral_moments,
)
from .characterise.parameters import (
    HybridParameters,
    Moments,
    Sampling,
    SpatialParameters,
    SpectralParameters,
    SummitDensities,
)
from .characterise.peaks import ProfilePeaks, profile_peaks
from .characterise.quantities import QUANTITIES
from .characterise.sampling_study import SamplingStudy, sampling_interval_study, scan_size_study
from .characterise.slopes import (
    developed_area_ratio,
    rms_laplacian,
    rms_profile_curvature,
    rms_profile_slope,
    rms_slope,
)
from .characterise.spectral_fit import SpectralFit, fit_spectrum
from .characterise.spectral_model import SpectralModel
from .characterise.spectrum import (
    PowerSpectrum,
    ProfileSpectrum,
    RadialSpectrum,
    power_spectrum,
    profile_spectrum,
    radial_spectrum,
)
from .characterise.structure import (
    ScaleDependence,
    StructureFunction,
    mean_square_increment,
    scale_dependence,
    structure_function,
    tip_cutoff,
)
from .characterise.summary import Characterisation, characterise
from .characterise.summits import Summits, SummitStatistics, summit_statistics, summits
from .characterise.texture import AngularSpectrum, TextureLengths, angular_spectrum, texture_lengths
from .characterise.tilt import tilt_share

__all__ = [
    "DROP_1E",
    "DROP_ISO",
    "DROP_TENTH",
    "QUANTITIES",
    "AngularSpectrum",
    "Autocovariance",
    "Characterisation",
    "Core",
    "DifferenceMoments",
    "FractalParameters",
    "FunctionalParameters",
    "HeightDistribution",
    "HeightParameters",
    "HybridParameters",
    "MaterialRatioCurve",
    "Moments",
    "PowerSpectrum",
    "ProfilePeaks",
    "ProfileSpectrum",
    "Quantity",
    "RadialSpectrum",
    "Sampling",
    "SamplingStudy",
    "ScaleDependence",
    "SlopeTensor",
    "SpatialParameters",
    "SpectralFit",
    "SpectralModel",
    "SpectralMoments",
    "SpectralParameters",
    "StructureFunction",
    "SummitDensities",
    "SummitStatistics",
    "Summits",
    "TextureLengths",
    "angular_spectrum",
    "autocovariance",
    "characterise",
    "core",
    "deepest_valley",
    "developed_area_ratio",
    "difference_moments",
    "effective_samples",
    "expected_difference_moments",
    "fit_spectrum",
    "fitted_fractal",
    "fractal_parameters",
    "fractal_roughness",
    "functional_parameters",
    "height_distribution",
    "height_parameters",
    "highest_peak",
    "kurtosis",
    "material_ratio_curve",
    "mean_absolute_height",
    "mean_square_after_levelling",
    "mean_square_increment",
    "nayak_parameter",
    "peak_to_valley",
    "power_spectrum",
    "profile_peaks",
    "profile_spectrum",
    "radial_spectrum",
    "rms_height",
    "rms_laplacian",
    "rms_profile_curvature",
    "rms_profile_slope",
    "rms_slope",
    "sampling_interval_study",
    "scale_dependence",
    "scan_size_study",
    "skewness",
    "slope_tensor",
    "spectral_moments",
    "spectrum_coefficient",
    "structure_coefficient",
    "structure_function",
    "summit_statistics",
    "summits",
    "texture_lengths",
    "tilt_share",
    "tip_cutoff",
]
