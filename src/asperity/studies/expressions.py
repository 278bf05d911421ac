"""Expressions of a study: numbers derived from scalars and quantities, with their units."""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Any

import numpy as np

from ..core.errors import InputError
from ..core.units import Dimension, dimension, unit_of

_OPERATIONS: Mapping[type[ast.operator], Callable[[Any, Any], Any]] = MappingProxyType(
    {
        ast.Add: operator.add,
        ast.Sub: operator.sub,
        ast.Mult: operator.mul,
        ast.Div: operator.truediv,
        ast.Pow: operator.pow,
    }
)

_FUNCTIONS: Mapping[str, Callable[[Any], Any]] = MappingProxyType(
    {"sqrt": np.sqrt, "exp": np.exp, "log": np.log, "log10": np.log10, "abs": np.abs}
)

_SLOPES: Mapping[str, Callable[[Any], Any]] = MappingProxyType(
    {
        "sqrt": lambda x: 0.5 / np.sqrt(x),
        "exp": np.exp,
        "log": lambda x: 1.0 / x,
        "log10": lambda x: 1.0 / (x * math.log(10.0)),
        "abs": np.sign,
    }
)

_CONSTANTS = MappingProxyType({"pi": math.pi})

_LONGEST = 500
"""Letters of an expression at most."""


@dataclass(frozen=True)
class Expression:
    """A formula of names, numbers, pi, ``+ - * / **``, parentheses, sqrt, exp, log, log10 and
    abs.

    Parameters
    ----------
    text
        The formula, such as ``"p * beta / (E2 * sigma)"``.
    what
        What it is for, for messages.

    Raises
    ------
    InputError
        If it is none.
    """

    text: str
    what: str

    def __post_init__(self) -> None:
        self._require(self._tree)

    @cached_property
    def _tree(self) -> ast.expr:
        if len(self.text) > _LONGEST:
            raise InputError(f"{self.what} must have at most {_LONGEST} letters, but has {len(self.text)}.")
        try:
            return ast.parse(self.text.strip(), mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            raise InputError(
                f"{self.what} must be a formula such as 'p * beta / (E2 * sigma)', but is {self.text!r}."
            ) from None

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names in it, each once."""
        called = {id(node.func) for node in ast.walk(self._tree) if isinstance(node, ast.Call)}
        found = [node.id for node in ast.walk(self._tree) if isinstance(node, ast.Name) and id(node) not in called]
        return tuple(dict.fromkeys(name for name in found if name not in _CONSTANTS))

    def unit(self, units: Mapping[str, str]) -> str:
        """SI unit of it, "1" for a plain number, where ``units`` holds those of its names.

        Raises
        ------
        InputError
            If a sum has terms of unlike units, a function or a power takes a unit, or a power is no
            number.
        """
        return unit_of(self._dimension(self._tree, {name: dimension(units[name]) for name in self.names}))

    def value(self, values: Mapping[str, Any]) -> Any:
        """Number or array (SI) of it, where ``values`` holds those of its names."""
        with np.errstate(all="ignore"):
            return self._value(self._tree, values)

    def slope(self, values: Mapping[str, Any], slopes: Mapping[str, Any]) -> Any:
        """Derivative (SI) of it along a direction in which its names have these ``slopes``, at
        their ``values``."""
        with np.errstate(all="ignore"):
            return self._slope(self._tree, values, slopes)

    def _slope(self, node: ast.expr, values: Mapping[str, Any], slopes: Mapping[str, Any]) -> Any:
        if isinstance(node, ast.Name):
            return 0.0 if node.id in _CONSTANTS else slopes[node.id]
        if isinstance(node, ast.UnaryOp):
            found = self._slope(node.operand, values, slopes)
            return -found if isinstance(node.op, ast.USub) else found
        if isinstance(node, ast.Call):
            assert isinstance(node.func, ast.Name)
            within = np.asarray(self._value(node.args[0], values), dtype=float)
            return _SLOPES[node.func.id](within) * self._slope(node.args[0], values, slopes)
        if not isinstance(node, ast.BinOp):
            return 0.0
        a, b = (np.asarray(self._value(side, values), dtype=float) for side in (node.left, node.right))
        by_a, by_b = (np.asarray(self._slope(side, values, slopes)) for side in (node.left, node.right))
        if isinstance(node.op, ast.Add | ast.Sub):
            return _OPERATIONS[type(node.op)](by_a, by_b)
        if isinstance(node.op, ast.Mult):
            return by_a * b + a * by_b
        if isinstance(node.op, ast.Div):
            return (by_a - a / b * by_b) / b
        # of a power: what stands in an exponent that does not change needs no logarithm of its base
        of_base = np.where(by_a == 0.0, 0.0, b * a ** (b - 1.0) * by_a)
        return of_base + np.where(by_b == 0.0, 0.0, a**b * np.log(a) * by_b)

    def _require(self, node: ast.expr) -> None:
        if isinstance(node, ast.BinOp) and type(node.op) in _OPERATIONS:
            self._require(node.left)
            self._require(node.right)
        elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.UAdd):
            self._require(node.operand)
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in _FUNCTIONS:
            if len(node.args) != 1 or node.keywords:
                raise InputError(f"{self.what} must give {node.func.id} one number, but is {self.text!r}.")
            self._require(node.args[0])
        elif not (isinstance(node, ast.Name) or (isinstance(node, ast.Constant) and type(node.value) in (int, float))):
            part = ast.unparse(node)
            raise InputError(
                f"{self.what} must consist of names, numbers, + - * / **, parentheses and the functions "
                f"{', '.join(_FUNCTIONS)}, but has {part!r}."
            )

    def _value(self, node: ast.expr, values: Mapping[str, Any]) -> Any:
        if isinstance(node, ast.BinOp):
            left, right = self._value(node.left, values), self._value(node.right, values)
            return _OPERATIONS[type(node.op)](np.asarray(left, dtype=float), right)
        if isinstance(node, ast.UnaryOp):
            found = self._value(node.operand, values)
            return -found if isinstance(node.op, ast.USub) else found
        if isinstance(node, ast.Call):
            assert isinstance(node.func, ast.Name)
            return _FUNCTIONS[node.func.id](self._value(node.args[0], values))
        if isinstance(node, ast.Name):
            return _CONSTANTS[node.id] if node.id in _CONSTANTS else values[node.id]
        assert isinstance(node, ast.Constant)
        assert isinstance(node.value, int | float)
        return float(node.value)

    def _dimension(self, node: ast.expr, dimensions: Mapping[str, Dimension]) -> Dimension:
        plain = dimension("1")
        if isinstance(node, ast.UnaryOp):
            return self._dimension(node.operand, dimensions)
        if isinstance(node, ast.Name):
            return plain if node.id in _CONSTANTS else dimensions[node.id]
        if isinstance(node, ast.Constant):
            return plain
        if isinstance(node, ast.Call):
            assert isinstance(node.func, ast.Name)
            within = self._dimension(node.args[0], dimensions)
            if node.func.id == "abs":
                return within
            if node.func.id == "sqrt":
                return within.power(0.5)
            self._plain(within, node.args[0], f"{node.func.id} takes")
            return plain
        assert isinstance(node, ast.BinOp)
        left, right = (self._dimension(side, dimensions) for side in (node.left, node.right))
        if isinstance(node.op, ast.Mult):
            return left.times(right)
        if isinstance(node.op, ast.Div):
            return left.times(right.power(-1.0))
        if isinstance(node.op, ast.Pow):
            self._plain(right, node.right, "a power takes")
            if left == plain:
                return plain
            if any(isinstance(part, ast.Name) and part.id not in _CONSTANTS for part in ast.walk(node.right)):
                raise InputError(
                    f"{self.what} must raise what has a unit to a number, but has {ast.unparse(node)!r}: its unit "
                    "would be another one in every case."
                )
            return left.power(float(self._value(node.right, {})))
        if left != right:
            sides = " and ".join(
                f"{ast.unparse(side)!r} in {unit_of(found)}" for side, found in ((node.left, left), (node.right, right))
            )
            raise InputError(f"{self.what} must add and subtract what has one unit, but has {sides}.")
        return left

    def _plain(self, found: Dimension, node: ast.expr, who: str) -> None:
        if found != dimension("1"):
            raise InputError(
                f"{self.what} must have a plain number where {who} one, but {ast.unparse(node)!r} is in "
                f"{unit_of(found)}."
            )
