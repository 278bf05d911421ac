"""Gross sliding as a coupling: shear traction moves the surfaces up and down, and so changes the
pressure (Dundurs 1969).

All points slide: the shear traction is the friction coefficient times the pressure, in one
direction, and lifts the surface of the softer or more compressible body by a field that is linear
in the pressure. Every round on its own reduces the change by about friction times Dundurs' β;
extrapolation over the last rounds does the rest.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, Self

import numpy as np

from ...contact.answer import Answer
from ...contact.couplings.protocol import Contact, Coupling, Exchange, Memory, Posed
from ...contact.problem import ContactProblem
from ...core.arrays import RealArray
from ...core.quantity import given, measured
from ...core.spectral import thread_count
from ...solids.compliance.tensor import BodiesSurface
from .law import Coulomb
from .operator import NO_COUPLING, CouplingKernel

TOLERANCE = 1e-6
"""Relative L2 change of the displacement by shear that does not count."""


@dataclass(frozen=True, eq=False)
class GrossSliding(Answer):
    """What the shear traction of a sliding contact does to it.

    Attributes
    ----------
    friction, direction
        Coefficient μ (number or map), and angle in rad of the shear traction on ``body`` from +x
        towards +y.
    shear_displacement
        Normal displacement (nx, ny) in m caused by the shear traction alone.
    """

    friction: float | RealArray = given()
    direction: float = given()
    shear_displacement: RealArray = measured("m", "normal displacement by shear", "x", "y")

    @classmethod
    def given_by(cls, problem: ContactProblem) -> Mapping[str, Any]:
        """Coefficient and direction."""
        law = problem.friction
        return {"friction": law.coefficient, "direction": law.direction} if isinstance(law, Coulomb) else {}

    def lifted(self) -> RealArray:
        """Displacement by shear."""
        return self.shear_displacement


class ShearKernel:
    """Normal displacement under shear that is the pressure times the ratios (kx, ky), prepared
    once.

    The coupling of the two bodies subtracts, for they carry opposite tractions: equal bodies have
    none, nor has an incompressible body against a rigid one. On a free line shear along y moves
    nothing up or down.
    """

    def __init__(self, coupling: CouplingKernel, ratios: tuple[float, float]) -> None:
        self._transform = coupling.transform
        self._kernel = 1j * (ratios[0] * coupling.zx + ratios[1] * coupling.zy)

    @classmethod
    def of(cls, problem: ContactProblem, ratios: tuple[float, float], *, threads: int | None = None) -> Self:
        """That of the bodies of ``problem``."""
        compliance = BodiesSurface(problem.body, problem.counter_body)
        return cls(CouplingKernel.of(problem.grid, compliance, problem.boundary, thread_count(threads)), ratios)

    @property
    def largest(self) -> float:
        """Largest displacement by a wave of unit pressure, m/Pa."""
        return float(np.abs(self._kernel).max())

    def displacement(self, pressure: RealArray) -> RealArray:
        """Normal displacement (nx, ny) in m of ``body`` relative to the counter body under the
        shear of ``pressure``."""
        field = np.ascontiguousarray(pressure, dtype=np.float64)
        spectrum = self._transform.forward(field, np.empty(self._transform.spectrum_shape, np.complex128))
        spectrum *= self._kernel
        return self._transform.backward(spectrum, np.empty_like(field))


@dataclass(frozen=True, eq=False)
class SlidingCoupling(Coupling):
    """Lift by the shear of ``friction``; the unknown is that displacement (nx, ny) in m.

    In a step of time of viscoelastic bodies the ``kernel`` is that of the step, and ``retarded``
    (m) what earlier shear displaces at its end.
    """

    friction: Coulomb
    kernel: ShearKernel = field(repr=False)
    feedback: bool = True
    tolerance: float = TOLERANCE
    retarded: RealArray | float = 0.0
    name: ClassVar[str] = "sliding"
    settled_text: ClassVar[str] = "The displacement by shear is settled"
    unsettled_text: ClassVar[str] = (
        "The normal displacement by shear of the sliding contact still changes by {change:.1e}"
    )
    remedy: ClassVar[str] = "Tighten the solver's tolerance, allow more change, or lower the friction coefficient."

    @classmethod
    def prepared(
        cls, problem: ContactProblem, friction: Coulomb, stiffest: float, tolerance: float, threads: int | None
    ) -> Self:
        """Coupling of the bodies of ``problem``; passive where it is nothing beside ``stiffest``,
        the largest normal compliance (m/Pa)."""
        kernel = ShearKernel.of(problem, _ratios(friction), threads=threads)
        return cls(friction, kernel, kernel.largest > NO_COUPLING * stiffest, tolerance)

    def in_time(self, coupling: CouplingKernel, retarded: RealArray) -> Self:
        """The same in a step of time with this ``coupling``, at whose end the past displaces
        ``retarded`` (nx, ny) in m."""
        return replace(self, kernel=ShearKernel(coupling, _ratios(self.friction)), retarded=retarded)

    def traction(self, pressure: RealArray) -> RealArray:
        """Shear traction (2, nx, ny) in Pa under ``pressure`` (nx, ny) in Pa."""
        ratios = np.array(_ratios(self.friction))
        return ratios[:, None, None] * self._weighted(pressure)

    def _weighted(self, pressure: RealArray) -> RealArray:
        """``pressure`` times the friction coefficient over its largest, which the kernel holds."""
        if isinstance(self.friction.coefficient, np.ndarray):
            return np.asarray(pressure * (self.friction.coefficient / self.friction.largest))
        return pressure

    def displacement(self, pressure: RealArray) -> RealArray:
        """Normal displacement (nx, ny) in m under friction times ``pressure``, and by earlier
        shear."""
        return self.kernel.displacement(self._weighted(pressure)) + self.retarded

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """The displacement under the pressure to start from."""
        start = posed.start if self.feedback else None
        x = np.zeros(posed.profile.shape) if start is None else self.displacement(start)
        return Exchange(x, x, np.inf if self.feedback else 0.0, self.tolerance)

    def reply(self, exchange: Exchange, contact: Contact) -> Exchange:
        """The displacement under the shear of ``contact``."""
        if not self.feedback:
            return exchange
        target = self.displacement(contact.pressure)
        size = float(np.linalg.norm(target))
        change = float(np.linalg.norm(target - exchange.x))
        return replace(exchange, target=target, residual=change / size if size else change, scale=size or 1.0)

    def end(self, exchange: Exchange, contact: Contact) -> tuple[Memory, GrossSliding]:
        """Nothing to remember: the displacement follows from the pressure."""
        return {}, GrossSliding(self.friction.coefficient, self.friction.direction, exchange.x)


def _ratios(friction: Coulomb) -> tuple[float, float]:
    """Shear along x and y over pressure where the coefficient is largest."""
    mu, angle = friction.largest, friction.direction
    return mu * math.cos(angle), mu * math.sin(angle)
