"""Errors: everything that is raised, with its base.

All are an ``AsperityError``. ``InputError`` says what was given wrongly, with ``UnitError`` and
``FileFormatError`` below it, and ``NoSolutionError`` if there is none for such input;
``OutputError`` says what cannot be written, ``ConvergenceError`` what did not converge.
"""

from .core.late import late_names

late_names(__name__, __file__)
