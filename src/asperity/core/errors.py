"""Exceptions. Every message names the input, what it must be, what was received and the usual
fix."""

from __future__ import annotations

from .words import in_words


class AsperityError(Exception):
    """Base of every exception that asperity raises on purpose; ``subject`` where it does not stand
    before "must".

    What can be done, as ``{fill}`` in the message, is said in the words of the door that speaks:
    see ``words.ACTIONS``. ``place`` is the key of the table of a document that is refused, where
    that is known.
    """

    place: str = ""

    def __init__(self, message: str, *, subject: str = "") -> None:
        super().__init__(in_words(message))
        self._subject = subject

    @property
    def subject(self) -> str:
        """Name of the input that is wrong, such as ``"load (N)"`` or ``"control.force"``; empty if
        none is."""
        before, must, _ = str(self).partition(" must ")
        return self._subject or (before if must else "")


class InputError(AsperityError, ValueError):
    """An argument, a document or a file holds a value that cannot be used."""


class UnitError(InputError):
    """A quantity has no unit, an unknown unit, or a unit of the wrong dimension."""


class FileFormatError(InputError):
    """A file is missing, empty, truncated, of an unknown format, or lacks units or size."""


class NoSolutionError(InputError):
    """The problem as posed has no solution (for example a mean pressure above the hardness)."""


class OutputError(AsperityError, OSError):
    """A result cannot be written (exists already, unwritable folder, disk full)."""


class ConvergenceError(AsperityError, RuntimeError):
    """A solver did not reach its tolerance; ``result`` holds the unconverged answer, flagged as
    such."""

    def __init__(self, message: str, result: object = None, *, subject: str = "") -> None:
        super().__init__(message, subject=subject)
        self.result = result
