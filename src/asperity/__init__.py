"""Contact mechanics of layered rough surfaces."""

from .contact.advice import Advice, advise, review
from .contact.boundary import Free, Periodic
from .contact.control import Approach, Force, MeanGap, MeanPressure
from .contact.laws import Hardness, HardWall
from .contact.operators import prepare_operator
from .contact.problem import ContactProblem, Flat
from .contact.result import ContactResult
from .contact.solve import Keep, solve
from .contact.state import InterfaceState
from .core.citations import cite
from .core.errors import (
    AsperityError,
    ConvergenceError,
    FileFormatError,
    InputError,
    NoSolutionError,
    OutputError,
    UnitError,
)
from .core.grid import Grid
from .solids.elastic import Elastic, Rigid, contact_modulus
from .solids.strength import Strength
from .surfaces.surface import Surface

__version__ = "0.1.0"

__all__ = [
    "Advice",
    "Approach",
    "AsperityError",
    "ContactProblem",
    "ContactResult",
    "ConvergenceError",
    "Elastic",
    "FileFormatError",
    "Flat",
    "Force",
    "Free",
    "Grid",
    "HardWall",
    "Hardness",
    "InputError",
    "InterfaceState",
    "Keep",
    "MeanGap",
    "MeanPressure",
    "NoSolutionError",
    "OutputError",
    "Periodic",
    "Rigid",
    "Strength",
    "Surface",
    "UnitError",
    "__version__",
    "advise",
    "cite",
    "contact_modulus",
    "prepare_operator",
    "review",
    "solve",
]
