"""Flash temperature of a sliding contact: heat made on the contact, its share, and the temperature
of both surfaces and below."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar

import numpy as np

from ...contact.boundary import FreeLine
from ...contact.measure import labelled
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError
from ...core.late import Shown
from ...core.spectral import thread_count
from ...core.status import Advice
from ...solids.layers import materials_of, surface_material
from ...theories.heating.impedance import HeatConductor, decay
from ...theories.heating.thermoelastic import bulge, critical_wavelength
from .findings import findings
from .kernels import HeatKernel, heat_conductor, waves
from .law import HeatedInterface, Motion
from .solver import Shared, shared

BODIES = ("body", "counter body")


@dataclass(frozen=True, eq=False, repr=False)
class FrictionalHeating(Shown):
    """Steady temperatures of a sliding contact. Fields are (nx, ny), all values SI; temperatures are
    rises over the bulk temperature of the body but where they are called otherwise.

    Attributes
    ----------
    problem, motion, interface
        The contact, how its bodies move, and what heat meets.
    contact
        Where the bodies touch.
    heat, heat_1
        Heat made per area and time, and what of it goes into the body, W/m²; where the hot wake of
        the counter body warms the body, ``heat_1`` is negative.
    temperature
        Rise in K of the plane in which heat is made, over the bulk temperature of the body; NaN
        outside the contact. With Joule heat where a voltage was given.
    surface_1, surface_2
        Rise in K of the surface of either body over its own bulk temperature, everywhere; NaN of a
        rigid body, which takes no heat. Without Joule heat.
    joule
        What Joule heat adds on the contact, K; an upper bound where a body is fast.
    mismatch
        Largest difference in K between the temperatures of the plane of generation on its two
        sides: the residual of the solution.
    work
        q·(K + R)q > 0 of the flux into the body, in K W/m².
    wake
        Temperature one pixel behind a hot one less that before it, over its own, in the faster
        body; > 0 where something moves.
    alone
        Largest rise in K where all heat went into the body, and into the counter body; infinite of
        a body that takes none.
    normal_force
        Force in N that presses the bodies together.
    steps
        Steps of the solver.
    conductors
        What both bodies are for heat; None of a rigid one.
    """

    problem: ContactProblem
    motion: Motion
    interface: HeatedInterface
    contact: BoolArray
    heat: RealArray
    heat_1: RealArray
    temperature: RealArray
    surface_1: RealArray
    surface_2: RealArray
    joule: float
    mismatch: float
    work: float
    wake: float
    alone: tuple[float, float]
    normal_force: float
    steps: int
    conductors: tuple[HeatConductor | None, HeatConductor | None] = field(repr=False)
    citation_keys: ClassVar[tuple[str, ...]] = ("Blok1937", "Jaeger1942", "CarslawJaeger1959")

    @property
    def rubs(self) -> bool:
        """Whether any heat is made."""
        return bool(self.heat.any())

    @property
    def power(self) -> float:
        """Heat per time in W."""
        return float(self.heat.sum()) * self.problem.grid.pixel_area

    @property
    def friction(self) -> float:
        """Heat over normal force and sliding speed: the mean coefficient of friction."""
        made = self.normal_force * self.motion.speed
        return self.power / made if made else 0.0

    @property
    def share(self) -> float:
        """Share of the heat that goes into the body; NaN without heat."""
        total = float(self.heat.sum())
        return float(self.heat_1.sum()) / total if total else math.nan

    @property
    def hottest(self) -> tuple[int, int]:
        """Pixel of the largest temperature on the contact."""
        found = int(np.argmax(np.where(self.contact, self.temperature, -np.inf)))
        i, j = np.unravel_index(found, self.contact.shape)
        return int(i), int(j)

    @property
    def place(self) -> tuple[float, float]:
        """(x, y) in m of that pixel."""
        (i, j), (dx, dy) = self.hottest, self.problem.grid.spacing
        return i * dx, j * dy

    @property
    def maximum(self) -> float:
        """Flash temperature: largest rise in K on the contact; 0 without contact."""
        return float(self.temperature[self.hottest]) if self.contact.any() else 0.0

    @property
    def hottest_temperature(self) -> float:
        """Bulk temperature of the body and the flash temperature, K."""
        return self.interface.bulk[0] + self.maximum

    @property
    def mean(self) -> float:
        """Mean rise in K over the contact, which follows the contact area with the pixels."""
        return float(self.temperature[self.contact].mean()) if self.contact.any() else 0.0

    @property
    def flux_mean(self) -> float:
        """Mean rise in K over the contact, weighted with the heat."""
        on = self.contact
        return float(np.average(self.temperature[on], weights=self.heat[on])) if self.rubs else self.mean

    @property
    def blok(self) -> float:
        """Estimate in K of the largest rise, 1/T = 1/T1 + 1/T2 of the rises with all heat in one body
        (Blok 1937)."""
        return 1.0 / sum(1.0 / rise if rise else math.inf for rise in self.alone) if self.rubs else 0.0

    def distribution(self) -> tuple[RealArray, RealArray]:
        """Rises in K of the pixels in contact, hottest first, and the share of the contact area that
        is at least as hot: (n,) each."""
        ordered = np.sort(self.temperature[self.contact])[::-1]
        return ordered, (np.arange(ordered.size) + 1.0) / max(ordered.size, 1)

    @cached_property
    def spot_pixels(self) -> int:
        """Pixels of the hottest spot, pixels joined by their sides; 0 without contact."""
        if not self.contact.any():
            return 0
        labels, _ = labelled(self.contact, wraps=self.problem.boundary.wraps)
        return int(np.count_nonzero(labels == labels[self.hottest]))

    @property
    def spot_radius(self) -> float:
        """Radius in m of a circle of the area of the hottest spot."""
        return math.sqrt(self.spot_pixels * self.problem.grid.pixel_area / math.pi)

    @property
    def pixels_across(self) -> float:
        """Pixels in the diameter of that circle."""
        return 2.0 * self.spot_radius / math.sqrt(self.problem.grid.pixel_area)

    def peclet(self, half_length: float) -> tuple[float, float]:
        """v a/2κ of body and counter body for the ``half_length`` a in m, by what is at their
        surfaces; NaN of a rigid body."""
        found = []
        for body, velocity in zip((self.problem.body, self.problem.counter_body), self.motion.velocities, strict=True):
            material = surface_material(body)
            kappa = math.nan if material is None else material.conduction.diffusivity
            found.append(math.hypot(*velocity) * half_length / (2.0 * kappa))
        return found[0], found[1]

    @property
    def pixel_peclet(self) -> float:
        """Largest of both bodies for half a pixel, v dx/4κ."""
        return float(np.nanmax((0.0, *self.peclet(0.5 * max(self.problem.grid.pixels)))))

    @property
    def spot_peclet(self) -> float:
        """Largest of both bodies for the radius of the hottest spot."""
        return float(np.nanmax((0.0, *self.peclet(self.spot_radius))))

    @property
    def heat_error(self) -> float:
        """Relative difference between the heat into both bodies and that made."""
        into = float(self.heat_1.sum()) + float((self.heat - self.heat_1).sum())
        return abs(into / float(self.heat.sum()) - 1.0) if self.rubs else 0.0

    @property
    def critical_wavelength(self) -> float:
        """Length in m beyond which the pressure of sliding surfaces grows by thermal expansion
        (Burton 1980); NaN where no expansion is known.

        That of a conductor on an insulator, each body bulging by its share of the heat, which is an
        estimate where both conduct.
        """
        inverse, known = 0.0, False
        shares = (self.share, 1.0 - self.share)
        for body, share in zip((self.problem.body, self.problem.counter_body), shares, strict=True):
            material = next(reversed(materials_of(body)), None)
            if material is not None and not math.isnan(material.conduction.thermal_expansion) and self.rubs:
                of = material.conduction
                made = (self.friction, self.motion.speed, of.thermal_expansion, material.poisson_ratio)
                length = critical_wavelength(*made, self.problem.contact_modulus, of.thermal_conductivity)
                inverse, known = inverse + share / length, True
        if not known:
            return math.nan
        return 1.0 / inverse if inverse > 0.0 else math.inf

    @cached_property
    def findings(self) -> tuple[Advice, ...]:
        """What should be known before the temperatures are used."""
        return findings(self)

    def section(self, depths: Sequence[float] | RealArray) -> tuple[RealArray, RealArray]:
        """Rise in K below the surfaces of body and counter body over their bulk temperatures, on the
        plane along x through the hottest point: (n, nx) each at the ``depths`` (n,) in m, >= 0; NaN
        of a body that takes no heat. Without Joule heat.

        Raises
        ------
        InputError
            If a depth is negative, or below a rigid base.
        """
        grid, row, made = self.problem.grid, self.hottest[1], []
        fluxes = (self.heat_1, self.heat - self.heat_1)
        sinks, kernels = self.interface.sink, self._kernels
        for conductor, kernel, velocity, flux, sink in zip(
            self.conductors, kernels, self.motion.velocities, fluxes, sinks, strict=True
        ):
            if conductor is None or kernel is None:
                made.append(np.full((len(depths), grid.shape[0]), math.nan))
                continue
            fields = [kernel.at_depth(z, conductor, velocity, grid, sink).apply(flux)[:, row] for z in depths]
            made.append(np.array(fields))
        return made[0], made[1]

    def displacement(self) -> RealArray:
        """Sum (nx, ny) in m of the displacements of both surfaces towards each other by thermal
        expansion, without its mean: for one pass, without what it does to the contact. Layers are
        taken to expand like the base.

        Raises
        ------
        InputError
            If the contact is not periodic, or the thermal expansion of a body is not known.
        """
        problem, grid = self.problem, self.problem.grid
        if not all(problem.boundary.wraps):
            raise InputError(
                "contact must be periodic for its displacement by heat, but is free: without a support that grows "
                "with the logarithm of the distance. Take {periodic}."
            )
        total = np.zeros(grid.shape)
        fluxes = (self.heat_1, self.heat - self.heat_1)
        for body, which, conductor, kernel, velocity, flux in zip(
            (problem.body, problem.counter_body),
            BODIES,
            self.conductors,
            self._kernels,
            self.motion.velocities,
            fluxes,
            strict=True,
        ):
            if conductor is None or kernel is None:
                continue
            material = materials_of(body)[-1]
            alpha, kappa = material.conduction.thermal_expansion, conductor.diffusivity
            if math.isnan(alpha):
                raise InputError(f"thermal expansion of the {which} must be known, but is not. Give it as alpha.")
            spectrum = waves(
                grid,
                lambda qx, qy, v=velocity, k=conductor.conductivity, d=kappa, m=material, a=alpha: (
                    bulge(qx, qy, d, a, m.poisson_ratio, v) / (k * decay(qx, qy, d, v))
                ),
                0.0,
            )
            total += HeatKernel(kernel.transform, spectrum).apply(flux)
        return total

    @cached_property
    def _kernels(self) -> tuple[HeatKernel | None, HeatKernel | None]:
        return _kernels(self.problem, self.conductors, self.motion, self.interface, None)


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
        If a conductivity or heat capacity is not known, both bodies are rigid, it is a line contact,
        or it is not known how much friction there is.
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
            "friction coefficient must be given where the problem has no friction, but is not. Give "
            "{heating.friction=0.2}."
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
    problem, contact = result.problem, result.contact
    require_heatable(problem, interface)
    conductors = _conductors(problem, interface)
    kernels = _kernels(problem, conductors, motion, interface, threads)
    found = shared(kernels, heat, contact, interface.resistance, interface.difference)
    joule = _joule(problem, voltage)
    plane = _plane(found, heat, interface)
    nowhere = np.full(heat.shape, math.nan)
    alone = [
        math.inf if kernel is None else float((kernel.apply(heat) + film * heat)[contact].max(initial=0.0))
        for kernel, film in zip(kernels, interface.resistance, strict=True)
    ]
    return FrictionalHeating(
        problem=problem,
        motion=motion,
        interface=interface,
        contact=contact,
        heat=heat,
        heat_1=found.heat_1,
        temperature=np.where(contact, plane + joule, math.nan),
        surface_1=nowhere if found.rise_1 is None else found.rise_1,
        surface_2=nowhere if found.rise_2 is None else found.rise_2,
        joule=joule,
        mismatch=found.mismatch,
        work=found.work,
        wake=_wake(kernels, motion, heat.shape),
        alone=(alone[0], alone[1]),
        normal_force=result.force,
        steps=found.steps,
        conductors=conductors,
    )


def _conductors(
    problem: ContactProblem, interface: HeatedInterface
) -> tuple[HeatConductor | None, HeatConductor | None]:
    first, second = (
        heat_conductor(body, which, bonds)
        for body, which, bonds in zip((problem.body, problem.counter_body), BODIES, interface.bonds, strict=True)
    )
    if first is None and second is None:
        raise InputError("body and counter_body must not both be rigid to conduct; make at least one of them Elastic.")
    return first, second


def _kernels(
    problem: ContactProblem,
    conductors: tuple[HeatConductor | None, HeatConductor | None],
    motion: Motion,
    interface: HeatedInterface,
    threads: int | None,
) -> tuple[HeatKernel | None, HeatKernel | None]:
    first, second = (
        None
        if conductor is None
        else HeatKernel.of(conductor, velocity, problem.grid, problem.boundary, sink, thread_count(threads))
        for conductor, velocity, sink in zip(conductors, motion.velocities, interface.sink, strict=True)
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
        known = material.conduction
        if math.isnan(known.electrical_resistivity):
            name = f"{material.name} ({which})" if material.name else f"the {which}"
            raise InputError(
                f"electrical resistivity of {name} must be known for Joule heat, but is not. Give "
                "{electrical_resistivity}.",
                subject=f"electrical resistivity of {material.name or which}",
            )
        resistivity += known.electrical_resistivity
        conductivity += known.thermal_conductivity
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
