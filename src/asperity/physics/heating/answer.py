"""What the heat of a sliding contact makes: temperatures and what follows from them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import ClassVar

import numpy as np

from ...contact.measure import labelled
from ...contact.problem import ContactProblem
from ...core.arrays import BoolArray, ComplexArray, RealArray
from ...core.errors import InputError
from ...core.late import Shown
from ...core.spectral import RealTransform, thread_count
from ...core.status import Advice
from ...solids.elastic import Elastic
from ...solids.layers import materials_of, surface_material
from ...theories.heating.impedance import HeatConductor, decay
from ...theories.heating.thermoelastic import bulge, critical_wavelength
from .kernels import HeatKernel, waves
from .law import HeatedInterface, Motion

BODIES = ("body", "counter body")
"""What both bodies are called."""


@dataclass(frozen=True, eq=False, repr=False)
class FrictionalHeating(Shown):
    """Steady temperatures of a sliding contact. Fields are (nx, ny), all values SI; temperatures
    are rises over the bulk temperature of the body but where they are called otherwise.

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
    findings
        What should be known before the temperatures are used.
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
    findings: tuple[Advice, ...] = ()
    citation_keys: ClassVar[tuple[str, ...]] = ("Blok1937", "Jaeger1942", "CarslawJaeger1959", "TianKennedy1994")

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

    @cached_property
    def hottest(self) -> tuple[int, int]:
        """Pixel of the largest temperature on the contact."""
        found = int(np.argmax(np.where(self.contact, self.temperature, -np.inf)))
        i, j = np.unravel_index(found, self.contact.shape)
        return int(i), int(j)

    @property
    def place(self) -> tuple[float, float]:
        """(x, y) in m of the middle of that pixel."""
        (i, j), (dx, dy) = self.hottest, self.problem.grid.spacing
        return (i + 0.5) * dx, (j + 0.5) * dy

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
        """Estimate in K of the largest rise, 1/T = 1/T1 + 1/T2 of the rises with all heat in one
        body (Blok 1937)."""
        return 1.0 / sum(1.0 / rise if rise else math.inf for rise in self.alone) if self.rubs else 0.0

    def distribution(self) -> tuple[RealArray, RealArray]:
        """Rises in K of the pixels in contact, hottest first, and the share of the contact area
        that is at least as hot: (n,) each."""
        ordered = np.sort(self.temperature[self.contact])[::-1]
        return ordered, (np.arange(ordered.size) + 1.0) / max(ordered.size, 1)

    @cached_property
    def spot(self) -> BoolArray:
        """(nx, ny) True in the hottest spot, pixels joined by their sides; nowhere without
        contact."""
        labels, _ = labelled(self.contact, wraps=self.problem.boundary.wraps)
        return np.asarray(self.contact & (labels == labels[self.hottest]))

    @property
    def spot_pixels(self) -> int:
        """Pixels of the hottest spot; 0 without contact."""
        return int(np.count_nonzero(self.spot))

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

    def section(self, depths: Sequence[float] | RealArray) -> tuple[RealArray, RealArray]:
        """Rise in K below the surfaces of body and counter body over their bulk temperatures, on
        the plane along x through the hottest point: (n, nx) each at the ``depths`` (n,) in m, >= 0;
        NaN of a body that takes no heat. Without Joule heat.

        Raises
        ------
        InputError
            If a depth is negative, or below a rigid base.
        """
        row, made, threads = self.hottest[1], [], thread_count()
        fluxes = (self.heat_1, self.heat - self.heat_1)
        for conductor, velocity, flux, sink in zip(
            self.conductors, self.motion.velocities, fluxes, self.interface.sink, strict=True
        ):
            if conductor is None:
                made.append(np.full((len(depths), self.problem.grid.shape[0]), math.nan))
                continue
            below = (HeatKernel.of(conductor, velocity, self.problem, sink, threads, z) for z in depths)
            made.append(np.array([kernel.apply(flux)[:, row] for kernel in below]))
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
        transform = RealTransform(grid.shape, thread_count())
        for body, which, conductor, velocity, flux in zip(
            (problem.body, problem.counter_body), BODIES, self.conductors, self.motion.velocities, fluxes, strict=True
        ):
            if conductor is None:
                continue
            material = materials_of(body)[-1]
            if math.isnan(material.conduction.thermal_expansion):
                raise InputError(f"thermal expansion of the {which} must be known, but is not. Give it as alpha.")
            spectrum = waves(grid, partial(_bulge, conductor, material, velocity), 0.0)
            total += HeatKernel(transform, spectrum).apply(flux)
        return total


def _bulge(
    conductor: HeatConductor, material: Elastic, velocity: tuple[float, float], qx: RealArray, qy: RealArray
) -> ComplexArray:
    """Displacement out of a body by a wave of flux into it, m/(W/m²)."""
    of, alpha = conductor.diffusivity, material.conduction.thermal_expansion
    flux = 1.0 / (conductor.conductivity * decay(qx, qy, of, velocity))
    return np.asarray(bulge(qx, qy, of, alpha, material.poisson_ratio, velocity) * flux)
