from .core.errors import (
    AsperityError,
    ConvergenceError,
    FileFormatError,
    InputError,
    NoSolutionError,
    OutputError,
    UnitError,
)

__all__ = [
    "AsperityError",
    "ConvergenceError",
    "FileFormatError",
    "InputError",
    "NoSolutionError",
    "OutputError",
    "UnitError",
]
