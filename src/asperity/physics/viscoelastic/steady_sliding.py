"""Steady sliding of rough surfaces over viscoelastic bodies: hysteretic friction, contact area and
heat.

A surface that moves at a speed v along the direction of sliding, and with it its contact, is at
rest in its own frame. A wave exp(i q·x) of pressure passes a point of the viscoelastic body with
the frequency -q·v, so that u(q) = c(q, -q·v) p(q), with the complex compliance c. The operator K is
real in space but not symmetric: pressure is larger in front. Its symmetric part is positive, so
that there is one solution for each load, but there is no energy that it would minimise.

With the symmetric operator S of the compliance 1/Re(1/c), of the storage modulus, K p = S p + (K -
S) p. Contacts with S, whose profile is lowered by (K - S) p of the last one, approach the solution:
in the norm of S each of them has at most sin(phi) times the error of the one before, phi being the
largest loss angle, for |c - S|/S = sin(phi). Adhesion adds its attraction to what moves, so that p
is the net traction, and a contact with S is an adhesive one, on a branch of its own; the bound by
sin(phi) is then that of its linear part alone.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np

from ...contact.boundary import Periodic
from ...contact.controls import Control, Unloaded
from ...contact.couplings.driver import Rounds
from ...contact.couplings.protocol import Contact, Coupling, Exchange, Memory, Posed, height_scale
from ...contact.law import HardWall
from ...contact.operators import Operator, prepare_operator
from ...contact.operators.convolution import PeriodicOperator
from ...contact.problem import ContactProblem, require_borne
from ...contact.result import ContactResult
from ...contact.solve import couplings_of, finished, settled_with
from ...contact.solvers.active_set.solver import ActiveSet
from ...core import require
from ...core.arrays import ComplexArray, RealArray
from ...core.engine import CpuEngine
from ...core.errors import ConvergenceError, InputError
from ...core.spectral import RealTransform
from ...core.status import Status
from ...solids.compliance.creep import complex_compliance
from ...solids.compliance.halfspace import Compliance
from ...solids.layers import Body, Layered, relaxes
from ...surfaces.characterise.spectrum import power_spectrum, radial_spectrum
from ...surfaces.pair import composite
from ...surfaces.surface import Surface
from ...theories.rough.persson import IsotropicSpectrum
from ...theories.rough.rubber_friction import ORIGINAL, RubberFriction, rubber_friction
from .moving_load import FreeMovingKernel, axis_of

TOLERANCE = 1e-7
"""Relative L2 change of the displacement by lag from round to round that does not count."""


@dataclass(frozen=True, eq=False)
class MovingKernel:
    """Complex compliance (m/Pa) on the half spectrum of a grid over which pressure moves, and that
    of the storage modulus.

    Attributes
    ----------
    whole
        c(q, -q·v), real where the grid holds no wave of the opposite direction.
    storage
        1/Re(1/c), symmetric.
    along
        Wavenumber q·v/v along the direction of motion, rad/m.
    transform
        Of the grid.
    """

    whole: ComplexArray
    storage: RealArray
    along: RealArray
    transform: RealTransform = field(repr=False)

    @classmethod
    def of(cls, problem: ContactProblem, velocity: tuple[float, float], threads: int) -> MovingKernel:
        """For the bodies of ``problem`` under a contact of ``velocity`` (m/s)."""
        grid = problem.grid
        (nx, ny), (qx, qy) = grid.shape, grid.wavevector()
        q = np.hypot(qx, qy)
        mean = q == 0.0
        omega = -(qx * velocity[0] + qy * velocity[1])
        q = np.where(mean, 1.0, q)
        whole = np.empty(q.shape, dtype=complex)
        for row in range(0, nx, _ROWS):
            part = slice(row, row + _ROWS)
            with np.errstate(divide="ignore", invalid="ignore"):
                whole[part] = complex_compliance(problem.body, problem.counter_body, q[part], omega[part])
        whole[mean] = 1.0
        if not np.isfinite(whole).all():
            raise InputError(
                f"bodies in steady sliding at {math.hypot(*velocity):g} m/s must be solid, but one flows under "
                "waves that stand still in it: those along the motion, and at rest all of them. Take a "
                "spectrum whose shares add up to less than one."
            )
        storage = 1.0 / (1.0 / whole).real
        speed = math.hypot(*velocity)
        along = (qx * velocity[0] + qy * velocity[1]) / speed if speed else 0.0 * q
        for lone in (np.s_[nx // 2 : nx // 2 + 1 - nx % 2, :], np.s_[:, ny // 2 : ny // 2 + 1 - ny % 2]):
            whole[lone], along[lone] = whole[lone].real, 0.0
            storage[lone] = 1.0 / (1.0 / whole[lone]).real
        whole[mean] = storage[mean] = problem.compliance.mean_mode()
        return cls(whole, storage, along, RealTransform(grid.shape, threads))

    def lag(self, pressure: RealArray) -> RealArray:
        """Displacement (nx, ny) in m by ``pressure`` (Pa), net of attraction, beyond that of the
        storage modulus."""
        spectrum = self._spectrum(pressure)
        spectrum *= self.whole - self.storage
        return self.transform.backward(spectrum, np.empty(pressure.shape))

    def slope(self, heights: RealArray) -> RealArray:
        """Derivative of ``heights`` (nx, ny) along the direction of motion."""
        spectrum = self._spectrum(heights)
        spectrum *= 1j * self.along
        return self.transform.backward(spectrum, np.empty(heights.shape))

    def dissipation(self, pressure: RealArray) -> float:
        """Mean of -p ∂u/∂x along the motion (Pa): sum of q_v Im c |p(q)|² over all waves
        (Parseval)."""
        spectrum = self._spectrum(pressure)
        each = self.along * self.whole.imag * np.abs(spectrum) ** 2
        columns, ny = each.sum(axis=0), pressure.shape[1]
        total = 2.0 * float(columns.sum()) - float(columns[0]) - (float(columns[-1]) if ny % 2 == 0 and ny > 1 else 0.0)
        return total / pressure.size**2

    @property
    def lags(self) -> bool:
        """Whether there is any difference from the compliance of the storage modulus."""
        return bool(np.abs(self.whole - self.storage).max() > _NO_LAG * self.storage.max())

    def _spectrum(self, values: RealArray) -> ComplexArray:
        return self.transform.forward(
            np.ascontiguousarray(values, dtype=float), np.empty(self.transform.spectrum_shape, np.complex128)
        )


_NO_LAG = 1e-14
"""Difference from the compliance of the storage modulus, over the largest, below which there is
none."""

_SOLVER = ActiveSet(tolerance=1e-12)
"""Method of the normal solves; the error of the lag goes with the root of its tolerance."""

_ROWS = 64
"""Rows of a grid whose complex compliance is computed at once."""


@dataclass(frozen=True, eq=False)
class LagCoupling(Coupling):
    """Displacement by the net traction beyond that of the storage modulus, as a lift; it is the
    unknown."""

    kernel: MovingKernel | FreeMovingKernel = field(repr=False)
    feedback: bool = True
    tolerance: float = TOLERANCE
    name: ClassVar[str] = "lag"
    settled_text: ClassVar[str] = "The lag of the viscoelastic displacement is settled"
    unsettled_text: ClassVar[str] = "The lag of the viscoelastic displacement still changes by {change:.1e}"
    remedy: ClassVar[str] = (
        "Allow more rounds, or loosen the tolerance of the lag. Where adhesive contacts jump, prescribe the "
        "position or start from a contact of another speed (after=); slide_in_time follows the motion."
    )

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """None, or that remembered."""
        x = np.asarray(memory["displacement"]) if memory else np.zeros(posed.profile.shape)
        return Exchange(x, x, np.inf if self.feedback else 0.0, self.tolerance)

    def reply(self, exchange: Exchange, contact: Contact) -> Exchange:
        """The displacement under the traction of ``contact``."""
        if not self.feedback:
            return exchange
        target = self.kernel.lag(contact.traction)
        size, change = float(np.linalg.norm(target)), float(np.linalg.norm(target - exchange.x))
        return replace(exchange, target=target, residual=change / size if size else change, scale=size or 1.0)

    def end(self, exchange: Exchange, contact: Contact) -> tuple[Memory, None]:
        """The displacement."""
        return {"displacement": exchange.x}, None


@dataclass(frozen=True)
class _Symmetric:
    """Compliance of the storage modulus, for preconditioners: of waves along the motion in a line,
    at 45° to it on a map."""

    problem: ContactProblem
    speed: float
    citation_keys: ClassVar[tuple[str, ...]] = ()

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """1/Re(1/c) in m/Pa at ``wavenumber`` q > 0 (rad/m)."""
        across = 1.0 if self.problem.grid.shape[1] == 1 else math.sqrt(0.5)
        c = complex_compliance(
            self.problem.body, self.problem.counter_body, wavenumber, -across * self.speed * wavenumber
        )
        return np.asarray(1.0 / (1.0 / c).real)

    def mean_mode(self) -> float:
        """That of the bodies at rest, m/Pa."""
        return self.problem.compliance.mean_mode()


@dataclass(frozen=True, eq=False)
class SteadySliding:
    """A surface that slides, or rolls, steadily over a viscoelastic body. All values SI.

    Attributes
    ----------
    normal
        Pressure, displacement, gap and areas, and what adhesion and menisci do; the friction here
        is not part of its problem.
    speed, direction
        Speed (m/s) and direction of the motion of the rough surface over the viscoelastic body,
        angle in rad from +x towards +y.
    friction_stress
        Force of hysteretic friction over nominal area, Pa: loss in every wave of the net traction.
    slope_friction_stress
        The same from the slope of the surface, mean of -(p - σ) ∂h/∂x, σ being the attraction. Both
        agree where the contact is solved and the grid resolves its edges; their difference is of
        first order in the pixel.
    energy_error
        Bound on the energy (J) of the error of the pressure in the symmetric part of the operator,
        over p·Kp, at the attraction found.
    """

    normal: ContactResult
    speed: float
    direction: float
    friction_stress: float
    slope_friction_stress: float
    energy_error: float

    @property
    def friction(self) -> float:
        """Coefficient of hysteretic friction, ``friction_stress`` over the mean pressure from
        outside; zero or, with adhesion, NaN where none presses."""
        return self._over_load(self.friction_stress)

    @property
    def slope_friction(self) -> float:
        """The same by ``slope_friction_stress``."""
        return self._over_load(self.slope_friction_stress)

    @property
    def friction_force(self) -> float:
        """Friction force, N."""
        return self.friction_stress * self.normal.problem.grid.area

    def _over_load(self, stress: float) -> float:
        load = self.normal.external_force / self.normal.problem.grid.area
        if load > 0.0:
            return stress / load
        return 0.0 if stress == 0.0 else math.nan

    @property
    def heat(self) -> float:
        """Heat per nominal area and time, W/m²."""
        return self.friction_stress * self.speed

    def persson(self, reduction: float = ORIGINAL) -> RubberFriction:
        """Friction and area by Persson's theory (2001) of the same surface, half-space, speed and
        load.

        The spectrum is the measured one, up to the shortest wave of the grid; ``reduction`` as of
        ``theories.rubber_friction``.

        InputError if the problem is no periodic map, a body is layered, something pulls, or it
        stands still.
        """
        problem = self.normal.problem
        if problem.attracts:
            raise InputError(
                "adhesion and film beside Persson's theory must be None, for it is one of pressed surfaces, "
                "but one is given."
            )
        if not isinstance(problem.boundary, Periodic) or min(problem.grid.shape) < 2:
            raise InputError(
                f"boundary beside Persson's theory must be Periodic() on a map, but is {problem.boundary!r} on "
                f"{problem.grid.shape[0]} x {problem.grid.shape[1]} points."
            )
        if any(isinstance(body, Layered) and body.reduced.layers for body in (problem.body, problem.counter_body)):
            raise InputError("bodies beside Persson's theory must be half-spaces, but one is layered.")

        def modulus(omega: RealArray) -> ComplexArray:
            return 2.0 / complex_compliance(problem.body, problem.counter_body, np.ones(omega.shape), omega)

        pair = isinstance(problem.counter_surface, Surface)
        rough = composite(problem.surface, problem.counter_surface) if pair else problem.surface  # type: ignore[arg-type]
        measured = radial_spectrum(power_spectrum(rough))
        known = measured.psd > 0.0
        spectrum = IsotropicSpectrum(measured.q[known], measured.psd[known])
        pressure = self.normal.mean_pressure
        return rubber_friction(spectrum, modulus, speed=self.speed, pressure=pressure, reduction=reduction)

    @property
    def status(self) -> Status:
        """How it ended."""
        return self.normal.status

    @property
    def converged(self) -> bool:
        """Whether pressure and displacement agree."""
        return self.normal.converged

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers behind the numbers."""
        return tuple(sorted({"Hunter1961", "Carbone2013", "Ferry1980", *self.normal.citation_keys}))


def slide(
    problem: ContactProblem,
    control: Control,
    speed: float,
    *,
    direction: float = 0.0,
    tolerance: float = TOLERANCE,
    rounds: Rounds = Rounds(),
    after: SteadySliding | None = None,
) -> SteadySliding:
    """Steady sliding of the rough body of ``problem`` over its viscoelastic one under ``control``,
    without interfacial shear.

    Friction is by hysteresis alone. What does not slide but rolls with its contact, as a smooth
    wheel, has the same pressure, and the friction is its rolling resistance.

    Parameters
    ----------
    problem
        Contact with a hard wall, without friction, on any boundary: on a free grid one body slides
        or rolls over the half-space, all of which is at rest before it comes. Adhesion of finite
        range pulls along the motion too; menisci of a film act by their normal force. The surfaces
        of viscoelastic bodies must be flat: roughness that moves with them causes no hysteresis. A
        rigid rough body on rubber: ``ContactProblem(rough, Rigid(), counter_body=rubber)``.
    control
        ``MeanPressure``, ``Force``, ``Approach`` or ``MeanGap``; with adhesion also ``Pull`` and
        ``FixedGrips``.
    speed
        Of the rough body over the viscoelastic one, m/s, >= 0; zero finds the relaxed contact.
    direction
        Of the motion, angle in rad from +x towards +y; on a free grid along one of its axes.
    tolerance
        Largest relative change of the displacement from round to round.
    rounds
        When to give up.
    after
        Sliding of the same surfaces at another speed or load, whose contact this one starts from:
        with adhesion it stays on its branch.

    Raises
    ------
    InputError
        If the problem has another law or physics, ``after`` another grid, the direction is not
        along an axis of a free grid, nothing in it relaxes, a viscoelastic surface is rough, or a
        body flows under waves that stand still in it.
    NoSolutionError
        If a position has no solution, or the surfaces part under a pull.
    ConvergenceError
        If pressure and displacement do not agree.
    """
    started = time.perf_counter()
    angle = require.finite(direction, "direction of sliding (rad)")
    require_slidable(problem, angle)
    require_borne(problem, control)
    if isinstance(control, Unloaded):
        raise InputError("control of steady sliding must be a load or position, but is Unloaded().")
    v = require.not_negative(speed, "sliding speed (m/s)")
    # kernel of pressure that moves, and its symmetric operator
    engine, symmetric = CpuEngine(), _Symmetric(problem, v)
    kernel: MovingKernel | FreeMovingKernel
    operator: Operator
    if isinstance(problem.boundary, Periodic):
        velocity = v * math.cos(angle), v * math.sin(angle)
        kernel = MovingKernel.of(problem, velocity, engine.threads_for(problem.grid.shape))
        compliance: Compliance = symmetric  # type: ignore[assignment]
        operator = PeriodicOperator(compliance, problem.grid, engine=engine, kernel=kernel.storage)
    else:
        first = prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
        kernel = FreeMovingKernel.of(problem, first, v, angle)
        operator = kernel.symmetric(first)
    profile, before = problem.profile(), None if after is None else after.normal.state
    couplings = (*couplings_of(problem, operator, rounds), LagCoupling(kernel, kernel.lags, tolerance))
    start = None
    if before is not None:
        before.require_shape(profile.shape)
        start = before.pressure if before.pressure.any() else None
    posed = Posed(operator, profile, profile, control, height_scale(profile, control, operator), start)
    settled = settled_with(couplings, posed, {} if before is None else before.memory, _SOLVER, rounds=rounds)
    contact, exchanges = settled.contact, settled.exchanges
    traction, ends = contact.traction, {c.name: c.end(exchanges[c.name], contact) for c in couplings}
    lag, seconds = kernel.lag(traction), time.perf_counter() - started
    lift = exchanges[
        LagCoupling.name
    ].x  # what the gap was found with; that of the traction found is within the tolerance of it
    normal = finished(problem, settled, ends, _SOLVER, before=None, lift=lift, seconds=seconds)
    p, deflection = contact.pressure, contact.solution.state.deflection
    gap = deflection - contact.qp.profile + (lag - lift)
    work = float((p * (deflection + kernel.lag(p))).sum())
    error = float((p * (gap - gap.min())).sum()) / work if work > 0.0 else 0.0
    by_slope = -float((traction * kernel.slope(profile)).mean())
    result = SteadySliding(normal, v, angle, kernel.dissipation(traction), by_slope, error)
    if not result.converged:
        raise ConvergenceError(f"{result.status.message} {result.status.remedy}", result)
    return result


def require_slidable(problem: ContactProblem, direction: float = 0.0) -> None:
    """Refuse with an InputError what is not steady in this ``direction`` (rad), or has no
    hysteresis."""
    if not isinstance(problem.boundary, Periodic):
        axis_of(direction, problem)
    if not isinstance(problem.law, HardWall):
        raise InputError(
            f"law of steady sliding must be HardWall(), but is {problem.law!r}: a hardness leaves a groove in "
            "the body at rest. Follow it in steps of time, with slide_in_time."
        )
    if problem.friction is not None or problem.plastic_flow is not None:
        raise InputError(
            "friction and plastic_flow of steady sliding must be None: the friction found is that of "
            "hysteresis alone, and shear of the interface adds to it."
        )
    for physics in problem.physics:
        physics.check_relaxing(problem)
    pairs: tuple[tuple[Body, object, str], ...] = (
        (problem.body, problem.surface, "surface"),
        (problem.counter_body, problem.counter_surface, "counter_surface"),
    )
    relaxing = [(surface, name) for body, surface, name in pairs if relaxes(body)]
    if not relaxing:
        raise InputError(
            "body or counter_body of steady sliding must be viscoelastic, but neither is. Give one its "
            "relaxation, as {relaxation}."
        )
    for surface, name in relaxing:
        if isinstance(surface, Surface) and float(np.ptp(surface.heights)) > 0.0:
            raise InputError(
                f"{name} of a viscoelastic body in steady sliding must be flat, since roughness that stays on "
                "it is at rest, but is rough. "
                "Make it the counter body of a rigid rough one ({soft_counter})."
            )
