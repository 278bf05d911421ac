from .physics.sealing.factors import FlowFactors, flow_factors, tabulated_flow_factors
from .physics.sealing.flow import FlowTensor, GapFlow, flow_tensor, flow_through
from .physics.sealing.fluids import IdealGas, ViscousLiquid
from .physics.sealing.law import FluidPressure
from .physics.sealing.leak import Leakage, leakage
from .physics.sealing.threshold import Closing, closing_load

__all__ = [
    "Closing",
    "FlowFactors",
    "FlowTensor",
    "FluidPressure",
    "GapFlow",
    "IdealGas",
    "Leakage",
    "ViscousLiquid",
    "closing_load",
    "flow_factors",
    "flow_tensor",
    "flow_through",
    "leakage",
    "tabulated_flow_factors",
]
