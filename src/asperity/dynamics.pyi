from .physics.dynamics.belt import BeltOscillator, RateState, StaticKinetic
from .physics.dynamics.block import SlidingBlock, Stability, SteadySliding
from .physics.dynamics.block_motion import BLOCK_SCALARS, BlockRun, move_block
from .physics.dynamics.interface import ComplianceFit, NormalCompliance, fit_compliance, metal_joint
from .physics.dynamics.motion import ENERGIES, QUANTITIES, Event, Motion
from .physics.dynamics.normal_motion import NormalOscillator
from .physics.dynamics.sweeps import BlockSweep, Branches, StabilityMap, bifurcation, stability_map, sweep_block

__all__ = [
    "BLOCK_SCALARS",
    "ENERGIES",
    "QUANTITIES",
    "BeltOscillator",
    "BlockRun",
    "BlockSweep",
    "Branches",
    "ComplianceFit",
    "Event",
    "Motion",
    "NormalCompliance",
    "NormalOscillator",
    "RateState",
    "SlidingBlock",
    "Stability",
    "StabilityMap",
    "StaticKinetic",
    "SteadySliding",
    "bifurcation",
    "fit_compliance",
    "metal_joint",
    "move_block",
    "stability_map",
    "sweep_block",
]
