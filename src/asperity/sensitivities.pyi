from .physics.sensitivities.answer import Sensitivities, SensitivityCertificate, TaylorTest
from .physics.sensitivities.outputs import EdgeArea, PressureAt, PressureNorm, SmoothArea
from .physics.sensitivities.sensitivities import sensitivities
from .physics.sensitivities.subsurface import StressNorm
from .physics.sensitivities.uncertainty import HeightNoise, Sampled, Uncertainty, uncertainty
from .physics.sensitivities.yielding import FirstYield, YieldLoad, yield_load

__all__ = [
    "EdgeArea",
    "FirstYield",
    "HeightNoise",
    "PressureAt",
    "PressureNorm",
    "Sampled",
    "Sensitivities",
    "SensitivityCertificate",
    "SmoothArea",
    "StressNorm",
    "TaylorTest",
    "Uncertainty",
    "YieldLoad",
    "sensitivities",
    "uncertainty",
    "yield_load",
]
