from .physics.sensitivities.answer import Sensitivities, SensitivityCertificate, TaylorTest
from .physics.sensitivities.outputs import PressureNorm, SmoothArea
from .physics.sensitivities.sensitivities import sensitivities

__all__ = [
    "PressureNorm",
    "Sensitivities",
    "SensitivityCertificate",
    "SmoothArea",
    "TaylorTest",
    "sensitivities",
]
