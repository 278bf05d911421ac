"""Checks of single input values; each returns the value in its canonical type or raises
``InputError``."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from .arrays import RealArray
from .errors import InputError
from .values import LARGEST, LEAST

T = TypeVar("T")


def finite(value: float, what: str, fix: str = "") -> float:
    """Return ``value`` as float if it is a finite real number."""
    if isinstance(value, str):
        raise InputError(_sentence(what, "a number", value, "Python takes SI numbers, such as 50e6 for 50 MPa."))
    try:
        if isinstance(value, bytes | bool | np.bool_):
            raise TypeError
        number = float(value)
    except (TypeError, ValueError):
        raise InputError(_sentence(what, "a number", value, fix)) from None
    except OverflowError:
        raise InputError(f"{what} must be a finite number, but has more than 308 digits.{fix and ' '}{fix}") from None
    if not math.isfinite(number):
        raise InputError(_sentence(what, "a finite number", value, fix))
    return number


def positive(value: float, what: str, fix: str = "") -> float:
    """Return ``value`` as float if it is finite and > 0."""
    number = finite(value, what, fix)
    if number <= 0.0:
        raise InputError(_sentence(what, "greater than zero", value, fix))
    return number


def not_negative(value: float, what: str, fix: str = "") -> float:
    """Return ``value`` as float if it is finite and >= 0."""
    number = finite(value, what, fix)
    if number < 0.0:
        raise InputError(_sentence(what, "at least zero", value, fix))
    return number


def between(value: float, low: float, high: float, what: str, fix: str = "") -> float:
    """Return ``value`` as float if ``low < value < high``."""
    number = finite(value, what, fix)
    if not low < number < high:
        raise InputError(_sentence(what, f"greater than {low:g} and less than {high:g}", value, fix))
    return number


def within(value: float, low: float, high: float, what: str, fix: str = "") -> float:
    """Return ``value`` as float if ``low < value <= high``."""
    number = finite(value, what, fix)
    if not low < number <= high:
        raise InputError(_sentence(what, f"greater than {low:g} and at most {high:g}", value, fix))
    return number


def at_most(value: float, high: float, what: str, fix: str = "") -> float:
    """Return ``value`` as float if ``0 < value <= high``."""
    number = finite(value, what, fix)
    if not 0.0 < number <= high:
        raise InputError(_sentence(what, f"greater than zero and at most {high:g}", value, fix))
    return number


def magnitude(value: float, what: str) -> float:
    """Return the length, modulus or pressure ``value`` if it is within ``values.LEAST`` and
    ``LARGEST``."""
    number = positive(value, what)
    if not LEAST < number <= LARGEST:
        must_be = f"greater than {LEAST:g} and at most {LARGEST:g}"
        raise InputError(_sentence(what, must_be, number, "Use other units of length and pressure."))
    return number


def integer(value: int, minimum: int, what: str, fix: str = "") -> int:
    """Return ``value`` as int if it is a whole number >= ``minimum``."""
    number = finite(value, what, fix)
    if number != int(number) or number < minimum:
        raise InputError(_sentence(what, f"a whole number of at least {minimum}", value, fix))
    return int(number)


def one_of(value: str, allowed: Iterable[str], what: str) -> str:
    """Return ``value`` if it is one of the ``allowed`` words."""
    choices = tuple(allowed)
    if value not in choices:
        raise InputError(_sentence(what, "one of " + ", ".join(choices), value))
    return value


def two(values: tuple[T, T], what: str, fix: str = "") -> tuple[T, T]:
    """Return ``values`` as a pair if there are two of them."""
    try:
        first, second = values
    except (TypeError, ValueError):
        raise InputError(_sentence(what, "two values", values, fix)) from None
    return first, second


def instance(value: T, kind: type, what: str, fix: str = "") -> T:
    """Return ``value`` if it is of the type ``kind``."""
    if not isinstance(value, kind):
        raise InputError(_sentence(what, f"of type {kind.__name__}", value, fix))
    return value


def field(values: ArrayLike, what: str, shape: tuple[int, int] | None = None) -> RealArray:
    """Return ``values`` as a two-dimensional floating-point array (float32 is kept, all else
    becomes float64)."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiub":
        raise InputError(_sentence(what, "an array of real numbers", f"an array of type {array.dtype}"))
    if array.ndim != 2 or array.size == 0:
        raise InputError(_sentence(what, "a two-dimensional array (nx, ny)", f"an array of shape {array.shape}"))
    if shape is not None and array.shape != shape:
        raise InputError(_sentence(what, f"an array of shape {shape}", f"an array of shape {array.shape}"))
    return array if array.dtype == np.float32 else array.astype(np.float64, copy=False)


def _sentence(what: str, must_be: str, received: object, fix: str = "") -> str:
    shown = received if isinstance(received, str) and received.startswith("an array") else repr(received)
    return f"{what} must be {must_be}, but is {shown}." + (f" {fix}" if fix else "")
