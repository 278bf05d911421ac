"""Flash temperature of a sliding contact: heat made on the contact, its share, and the temperature
of both surfaces and below."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from ...contact.boundary import FreeLine
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.spectral import thread_count
from ...solids.elastic import known_conduction
from ...solids.layers import deformable, surface_material
from ...theories.heating.impedance import HeatConductor
from .answer import BODIES, FrictionalHeating
from .findings import findings
from .kernels import HeatKernel, heat_conductor
from .law import HeatedInterface, Motion
from .solver import Shared, shared


def flash_temperature(
    result: ContactResult,
    motion: Motion,
    friction: float | RealArray | None = None,
    interface: HeatedInterface = HeatedInterface(),
    *,
    voltage: float = 0.0,
    threads: int | None = None,
) -> FrictionalHeating:
    """Steady flash temperature of the sliding contact ``result``.

    Heat is made where the bodies slide: shear traction times sliding speed where the problem has
    friction, zero where a point sticks; else ``friction`` times pressure times speed. Both bodies
    conduct it as moving half-spaces, with their layers; the plane in which it is made has one
    temperature at every point of contact, and elsewhere the surfaces are insulated. Temperatures of
    periodic contacts are those over the mean planes of the bodies: what the nominal contact adds is
    not in them. One linear system with the pixels in contact.

    Parameters
    ----------
    result
        A solved contact, periodic or free.
    motion
        Velocities of both bodies in the frame in which the spots rest.
    friction
        Coefficient μ >= 0, a number or (nx, ny); needed where the problem has no friction.
    interface
        Films, bonds, bulk temperatures and sinks.
    voltage
        Between the bodies in V, >= 0: the Joule heat of a current through the same spots is added.
    threads
        Of the transforms; all by default.

    Raises
    ------
    InputError
        If a conductivity or heat capacity is not known, both bodies are rigid, it is a line
        contact, or it is not known how much friction there is.
    ConvergenceError
        If the linear system is not solved.
    """
    heat = heat_made(result, motion, friction)
    return heating_of(result, motion, heat, interface, voltage=voltage, threads=threads)


def require_heatable(problem: ContactProblem, interface: HeatedInterface = HeatedInterface()) -> None:
    """Refuse contacts whose heat cannot be computed, with an ``InputError``."""
    if isinstance(problem.boundary, FreeLine):
        raise InputError(
            "boundary of a contact that is heated must be periodic or free, but is that of a line contact. Take "
            "{periodic} or {free}."
        )
    _conductors(problem, interface)
    if not all(problem.boundary.wraps) and any(map(math.isfinite, interface.sink)):
        raise InputError(
            "depth of a heat sink must be left out for a free contact, whose heat spreads into half-spaces, but is "
            "given. Take {periodic} or leave it out."
        )


def heat_made(result: ContactResult, motion: Motion, friction: float | RealArray | None) -> RealArray:
    """Heat per area and time (nx, ny) in W/m².

    Raises
    ------
    InputError
        If it is not known how much friction there is.
    """
    pressure = np.maximum(result.pressure, 0.0)
    if friction is not None:
        mu = np.asarray(friction, dtype=float)
        if not np.all(np.isfinite(mu)) or np.any(mu < 0.0):
            raise InputError(f"friction coefficient must be at least zero, but is {float(np.min(mu)):g}.")
        return np.asarray(mu * pressure * motion.speed)
    stuck = result.stick_slip
    if stuck is not None:  # points that slip most slide with the speed
        slip = np.hypot(*stuck.slip_increment)
        most = float(slip.max())
        along = np.abs(np.einsum("kij,kij->ij", stuck.traction, stuck.slip_increment))
        return np.asarray(along * (motion.speed / most if most else 0.0))
    shear = result.problem.shear(pressure)
    if shear is None:
        raise InputError(
            "friction coefficient must be given where the problem has no friction, but is not. Give it after the "
            "motion: flash_temperature(result, motion, 0.2)."
        )
    vx, vy = motion.slip
    return np.asarray(np.abs(shear[0] * vx + shear[1] * vy))


def heating_of(
    result: ContactResult,
    motion: Motion,
    heat: RealArray,
    interface: HeatedInterface = HeatedInterface(),
    *,
    voltage: float = 0.0,
    threads: int | None = None,
) -> FrictionalHeating:
    """The same for a given ``heat`` (nx, ny) in W/m² on the contact."""
    return HeatedBodies.of(result.problem, motion, interface, voltage, threads).under(result, heat)


@dataclass(frozen=True, eq=False)
class HeatedBodies:
    """Both bodies of a problem prepared for the heat of any contact of them.

    Attributes
    ----------
    motion, interface
        How they move, and what heat meets.
    conductors, kernels
        What they are for heat, and from flux to temperature on the grid; None of a rigid one.
    joule
        Rise in K by Joule heat.
    """

    motion: Motion
    interface: HeatedInterface
    conductors: tuple[HeatConductor | None, HeatConductor | None]
    kernels: tuple[HeatKernel | None, HeatKernel | None]
    joule: float

    @classmethod
    def of(
        cls, problem: ContactProblem, motion: Motion, interface: HeatedInterface, voltage: float, threads: int | None
    ) -> Self:
        """Those of ``problem``; other arguments and errors as of ``flash_temperature``."""
        require_heatable(problem, interface)
        conductors = _conductors(problem, interface)
        first, second = (
            None if conductor is None else HeatKernel.of(conductor, velocity, problem, sink, thread_count(threads))
            for conductor, velocity, sink in zip(conductors, motion.velocities, interface.sink, strict=True)
        )
        return cls(motion, interface, conductors, (first, second), _joule(problem, voltage))

    def under(self, result: ContactResult, heat: RealArray) -> FrictionalHeating:
        """Temperatures of the contact ``result`` under ``heat`` (nx, ny) in W/m².

        Raises
        ------
        InputError
            If all points touch and nothing determines how the mean heat is shared.
        ConvergenceError
            If the linear system is not solved.
        """
        contact, interface = result.contact, self.interface
        found = shared(self.kernels, heat, contact, interface.resistance, interface.difference)
        plane = _plane(found, heat, interface)
        nowhere = np.full(heat.shape, math.nan)
        alone = [
            math.inf if kernel is None else float((kernel.apply(heat) + between * heat)[contact].max(initial=0.0))
            for kernel, between in zip(self.kernels, interface.resistance, strict=True)
        ]
        heated = FrictionalHeating(
            problem=result.problem,
            motion=self.motion,
            interface=interface,
            contact=contact,
            heat=heat,
            heat_1=found.heat_1,
            temperature=np.where(contact, plane + self.joule, math.nan),
            surface_1=nowhere if found.rise_1 is None else found.rise_1,
            surface_2=nowhere if found.rise_2 is None else found.rise_2,
            joule=self.joule,
            mismatch=found.mismatch,
            work=found.work,
            wake=_wake(self.kernels, self.motion, heat.shape),
            alone=(alone[0], alone[1]),
            normal_force=result.force,
            steps=found.steps,
            conductors=self.conductors,
        )
        return replace(heated, findings=findings(heated))


def _conductors(
    problem: ContactProblem, interface: HeatedInterface
) -> tuple[HeatConductor | None, HeatConductor | None]:
    bodies = problem.body, problem.counter_body
    deformable(*bodies)  # not both rigid
    first, second = (
        heat_conductor(body, which, bonds) for body, which, bonds in zip(bodies, BODIES, interface.bonds, strict=True)
    )
    return first, second


def _plane(found: Shared, heat: RealArray, interface: HeatedInterface) -> RealArray:
    """Rise of the plane of generation over the bulk of the body."""
    if found.rise_1 is not None:
        return found.rise_1 + interface.resistance[0] * found.heat_1
    assert found.rise_2 is not None
    return found.rise_2 + interface.resistance[1] * (heat - found.heat_1) + interface.difference


def _joule(problem: ContactProblem, voltage: float) -> float:
    """V²/2(ρ1 + ρ2)(k1 + k2) in K.

    Raises
    ------
    InputError
        If the voltage is negative, or a resistivity is not known.
    """
    if not require.not_negative(voltage, "voltage between the bodies (V)"):
        return 0.0
    resistivity = conductivity = 0.0
    for body, which in zip((problem.body, problem.counter_body), BODIES, strict=True):
        material = surface_material(body)
        if material is None:
            continue
        resistivity += known_conduction(material, "electrical_resistivity", which, " for Joule heat")
        conductivity += material.conduction.thermal_conductivity
    return voltage**2 / (2.0 * resistivity * conductivity)


def _wake(kernels: tuple[HeatKernel | None, HeatKernel | None], motion: Motion, shape: tuple[int, int]) -> float:
    """Temperature behind a hot pixel less that before it over its own, in the faster body."""
    there = [
        (math.hypot(*velocity), velocity, kernel)
        for velocity, kernel in zip(motion.velocities, kernels, strict=True)
        if kernel is not None
    ]
    speed, velocity, kernel = max(there, key=lambda item: item[0])
    if not speed:
        return 0.0
    axis = int(abs(velocity[1]) > abs(velocity[0]))
    if shape[axis] < 3:
        return 0.0
    one = np.zeros(shape)
    middle = [shape[0] // 2, shape[1] // 2]
    one[middle[0], middle[1]] = 1.0
    field = kernel.apply(one)
    step = int(math.copysign(1.0, velocity[axis]))
    behind, before = list(middle), list(middle)
    behind[axis] += step
    before[axis] -= step
    return float((field[behind[0], behind[1]] - field[before[0], before[1]]) / field[middle[0], middle[1]])
