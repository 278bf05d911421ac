from ..core.status import Advice
from ..parts.advice import advise, review
from .boundary import Boundary, Free, FreeLine, Periodic
from .compliant import CompliantContact, compliant_contact
from .conforming import ConformingContact, cylinder_in_bore, sphere_in_socket
from .controls import Approach, Control, FixedGrips, Force, MeanGap, MeanPressure, Pull, Step, Unloaded
from .full import FullContactField, full_contact
from .history import EnergyBalance, History, HistoryResult, ramps
from .line_contact import line_problem
from .problem import ContactProblem, Flat
from .result import ContactResult, Interference, complementary_energy, interference
from .solve import Keep, solve, steps
from .stamp import StampField, stamp_contact
from .time_division import TimeSteps

__all__ = [
    "Advice",
    "Approach",
    "Boundary",
    "CompliantContact",
    "ConformingContact",
    "ContactProblem",
    "ContactResult",
    "Control",
    "EnergyBalance",
    "FixedGrips",
    "Flat",
    "Force",
    "Free",
    "FreeLine",
    "FullContactField",
    "History",
    "HistoryResult",
    "Interference",
    "Keep",
    "MeanGap",
    "MeanPressure",
    "Periodic",
    "Pull",
    "StampField",
    "Step",
    "TimeSteps",
    "Unloaded",
    "advise",
    "complementary_energy",
    "compliant_contact",
    "cylinder_in_bore",
    "full_contact",
    "interference",
    "line_problem",
    "ramps",
    "review",
    "solve",
    "sphere_in_socket",
    "stamp_contact",
    "steps",
]
