"""Sensitivities of one number of a contact, with their certificate."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from ...contact.problem import ContactProblem
from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Shown
from ...solids.elastic import Elastic
from ...solids.layers import Layered
from .outputs import Output
from .parameters import HEIGHTS, parameters
from .system import Held

_ALONG = 1e-5
"""Relative step of the differences of constants of a body."""

Again = Callable[[str, float], tuple[float, int]]
"""Solves the contact with a parameter of a name changed by a relative step; gives the output and
the number of points that changed their state."""


@dataclass(frozen=True)
class SensitivityCertificate:
    """What bounds the error of derivatives.

    Attributes
    ----------
    adjoint_residual
        Largest residual of the linear system of the output over its right-hand side; 1e-8 is asked
        for.
    state_error
        Largest residual of the result on its set over the rms height, before its pressure was
        corrected there.
    output_error
        Output of the corrected state less that of the result, as the residual of the result
        weighted with the adjoint solution estimates it: an error of the result itself.
    changed
        Points whose corrected pressure or gap has the wrong sign for the set of the result: their
        derivatives are those of the wrong side. Solve the contact more closely where it is not a
        small share of the contact.
    fft_pairs
        Work: FFT pairs of the size of the grid.
    by_edges
        Of area and layered conductors: what derivatives by the edge that moves were multiplied
        with, so that the one to the load is that of several loads. 0.7 to 1.5 where they then agree
        with differences within 4 % of the largest; further from one where spots are few pixels
        wide.
    """

    adjoint_residual: float
    state_error: float
    output_error: float
    changed: int
    fft_pairs: float
    by_edges: float = 1.0


@dataclass(frozen=True, eq=False)
class TaylorTest:
    """Solutions with a parameter changed by relative ``steps`` s, beside the derivative.

    Attributes
    ----------
    name
        The parameter; of the heights, all are multiplied by 1 + s.
    steps
        s, (n,).
    differences
        J(s) - J(0), (n,).
    remainders
        J(s) - J(0) - s dJ/ds, (n,).
    changed
        Points that changed their state, (n,): while there are none the remainder falls as s².
    """

    name: str
    steps: RealArray
    differences: RealArray
    remainders: RealArray
    changed: RealArray

    @property
    def orders(self) -> RealArray:
        """Power of s with which the remainder falls from each step to the next, (n - 1,): 2 of a
        right derivative, 1 of a wrong one."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(np.diff(np.log(np.abs(self.remainders))) / np.diff(np.log(np.abs(self.steps))))


@dataclass(frozen=True, eq=False, repr=False)
class Sensitivities(Shown):
    """Derivatives of one number J of a contact with respect to its parameters, all SI.

    Attributes
    ----------
    problem
        The contact.
    output
        What J is, such as ``PressureNorm(16)``; its ``name`` and ``unit``.
    value
        J.
    held
        ``"load"`` or ``"approach"``: what stays as it is while the other parameters change.
    values
        dJ/dθ by the name of each parameter: a number, of ``heights`` and of a map of hardness an
        array (nx, ny).
    parameters
        Value of each parameter; of ``heights`` their rms value in m.
    units
        SI unit of each parameter.
    certificate
        What bounds the error, and the work.
    """

    problem: ContactProblem
    output: Output
    value: float
    held: Held
    values: Mapping[str, float | RealArray]
    parameters: Mapping[str, float | RealArray]
    units: Mapping[str, str]
    certificate: SensitivityCertificate
    again: Again = field(repr=False)

    def __getitem__(self, name: str) -> float | RealArray:
        """dJ/dθ of the parameter of that ``name``.

        Raises
        ------
        InputError
            If it was not asked for.
        """
        if name not in self.values:
            raise InputError(
                f"parameter of the sensitivities must be one of {', '.join(self.values)}, but is {name!r}."
            )
        return self.values[name]

    @property
    def relative(self) -> Mapping[str, float]:
        """d ln J/d ln θ by name: the change of J in percent by 1 % of each parameter; of heights
        and of a map, of all together."""
        found = {}
        for name, value in self.values.items():
            change = self._scaled(name, value)
            found[name] = change / self.value if self.value else math.nan
        return found

    @property
    def influence(self) -> tuple[str, ...]:
        """Names of the parameters, that with the largest relative sensitivity first."""
        relative = self.relative
        return tuple(sorted(relative, key=lambda name: -abs(relative[name])))

    @property
    def euler_defect(self) -> float:
        """(Σ θ dJ/dθ - n J)/Σ |θ dJ/dθ| over load, moduli and hardness, n the degree of J in them:
        zero but for errors. NaN where n is not known or one of them was not asked for."""
        stresses = [name for name in self.values if self.units[name] in ("Pa", "N")]
        if self.output.degree is None or self._left_out:
            return math.nan
        terms = [self._scaled(name, self.values[name]) for name in stresses]
        whole = sum(map(abs, terms)) or 1.0
        return (sum(terms) - self.output.degree * self.value) / whole

    def along(
        self, body: Callable[[float], Elastic | Layered], value: float, *, of: Literal["body", "counter_body"] = "body"
    ) -> float:
        """dJ/dt of a parameter t that a whole body depends on, such as the modulus at the top of a
        graded coating: the sum over its constants of their derivatives times their rates.

        Rates are central differences with a relative error of 1e-9. Hardness is not followed.

        Parameters
        ----------
        body
            Gives the body for t, always of the same layers.
        value
            t of the contact.
        of
            Which body it is.

        Raises
        ------
        InputError
            If a constant of the body was not asked for, or there are others.
        """
        step = _ALONG * (abs(require.finite(value, "value of a parameter of a body")) or 1.0)
        ends = list[dict[str, float]]()
        for sign in (1.0, -1.0):
            other, problem = body(value + sign * step), self.problem
            problem = replace(problem, body=other) if of == "body" else replace(problem, counter_body=other)
            ends.append({each.name: each.value for each in parameters(problem)})
        own = [each.name for each in parameters(self.problem) if each.body == of]
        if any([name for name in end if name.startswith(f"{of}.")] != own for end in ends):
            raise InputError(
                f"body that depends on a parameter must have the constants {', '.join(own)}, but has others."
            )
        rates = {name: (ends[0][name] - ends[1][name]) / (2.0 * step) for name in own}
        return sum(float(np.asarray(self[name])) * rate for name, rate in rates.items() if rate)

    @property
    def of_load(self) -> Mapping[str, float | RealArray]:
        """Derivatives -(dJ/dθ)/(dJ/dP) of the load P at which J has its value, in N by the other
        parameters: J being kept, the load follows them.

        Raises
        ------
        InputError
            If the load is not held, or its derivative was not asked for.
        """
        slope = float(np.asarray(self["force"]))
        return {name: -value / slope for name, value in self.values.items() if name != "force"}

    @property
    def _left_out(self) -> bool:
        known = self.problem.law.pressure_cap()
        return (self.held == "load" and "force" not in self.values) or (
            "hardness" not in self.values and bool(np.all(np.isfinite(known)))
        )

    def _scaled(self, name: str, value: float | RealArray) -> float:
        """dJ by a small relative change of the parameter, over that change."""
        if name == HEIGHTS:
            return float((np.asarray(value) * self.problem.profile()).sum())
        return float(np.sum(np.asarray(value) * np.asarray(self.parameters[name])))

    def taylor(self, name: str, steps: Sequence[float] = (1e-2, 3e-3, 1e-3, 3e-4)) -> TaylorTest:
        """The contact solved again with the parameter of that ``name`` changed by relative
        ``steps``: the remainder beside the derivative falls as their square.

        It takes a solve for each step.

        Raises
        ------
        InputError
            If the parameter was not asked for, or a step is zero.
        """
        slope = self._scaled(name, self[name])
        found = [self.again(name, require.finite(step, "relative step of a Taylor test")) for step in steps]
        differences = np.array([value for value, _ in found]) - self.value
        taken = np.asarray(steps, dtype=float)
        if not taken.all():
            raise InputError("relative step of a Taylor test must not be zero, but is 0.")
        return TaylorTest(name, taken, differences, differences - slope * taken, np.array([n for _, n in found]))

    def line(self) -> str:
        """What it is in one line."""
        relative = self.relative
        first = ", ".join(f"{name} {relative[name]:+.3g}" for name in self.influence[:4])
        return f"Sensitivities of {self.output.name} at given {self.held}, d ln J/d ln θ: {first}"
