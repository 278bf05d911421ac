from ..core.status import Advice
from .advice import advise, review
from .boundary import Free, FreeLine, Periodic
from .controls import Approach, FixedGrips, Force, MeanGap, MeanPressure, Pull, Step, Unloaded
from .history import EnergyBalance, History, HistoryResult, ramps
from .problem import ContactProblem, Flat
from .result import ContactResult
from .solve import Keep, solve, steps
from .time_division import TimeSteps

__all__ = [
    "Advice",
    "Approach",
    "ContactProblem",
    "ContactResult",
    "EnergyBalance",
    "FixedGrips",
    "Flat",
    "Force",
    "Free",
    "FreeLine",
    "History",
    "HistoryResult",
    "Keep",
    "MeanGap",
    "MeanPressure",
    "Periodic",
    "Pull",
    "Step",
    "TimeSteps",
    "Unloaded",
    "advise",
    "ramps",
    "review",
    "solve",
    "steps",
]
