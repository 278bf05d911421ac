"""Closed theories of summits for a wet contact, to stand beside the menisci that are counted on its
map."""

from __future__ import annotations

import contextlib
import math
from dataclasses import dataclass

import numpy as np

from ...contact.result import ContactResult
from ...contact.roughness import roughness_of
from ...core.errors import InputError
from ...surfaces.surface import Surface
from ...theories.rough.greenwood_williamson import KotwalBhushan
from ...theories.wet.meniscus import MeniscusGrowth, wetting_factor
from ...theories.wet.summits import KineticMeniscus, StatisticalMeniscus

HAMAKER = 1e-19
"""Hamaker constant in J of solid, liquid and vapour in remarks on the growth of menisci; of the
usual order."""

FEWEST = 20
"""Summits below which their skewness and kurtosis mean nothing."""


@dataclass(frozen=True)
class WetTheory:
    """Statistical meniscus model of the summits of a map, and its growth with time; forces in N,
    NaN where there is none.

    Attributes
    ----------
    statistical
        Summits with the density, mean radius and distribution of heights (Pearson's, by skewness
        and kurtosis) of those of the composite profile, in the film (Gao, Tian & Bhushan 1995;
        Kotwal & Bhushan 1996).
    summits
        Number of summits.
    meniscus_force
        F_m in equilibrium under the external force.
    feedback
        dF_m/dL in equilibrium.
    growth
        Growth of a meniscus on a summit with the Hamaker constant ``HAMAKER`` (Bhushan, Kotwal &
        Chilamakuri 1998, in character); None without a viscosity, or where the film is so thin that
        it holds its liquid back.
    first_force
        F_m just after contact is made, when menisci are as high as the film.
    """

    statistical: StatisticalMeniscus
    summits: int
    meniscus_force: float
    feedback: float
    growth: MeniscusGrowth | None
    first_force: float

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers the numbers rest on."""
        growth = () if self.growth is None else KineticMeniscus.citation_keys
        return tuple(sorted({*StatisticalMeniscus.citation_keys, *KotwalBhushan.citation_keys, *growth}))


def wet_theory(result: ContactResult) -> WetTheory:
    """Statistical and kinetic menisci for the surfaces, film and external force of ``result``.

    Both contact angles enter by their sum of cosines. The theory gives every summit in the film the
    force of a sphere that touches it, so it is an estimate for menisci much higher than the film.

    Raises
    ------
    InputError
        If there is no external force, or the profile has fewer than 20 summits, as spheres have.
    NoSolutionError
        If the summits do not carry load and menisci at any separation.
    """
    problem, film, load = result.problem, result.require_menisci().film, result.external_force
    if not load > 0.0:
        raise InputError(f"external force (N) must be greater than zero for the theory of summits, but is {load:.4g}.")
    surface = problem.surface
    roughness = roughness_of(Surface(problem.profile(), surface.dx, surface.dy, periodic=surface.periodic))
    count = 0 if roughness.summits is None else roughness.summits.count
    if count < FEWEST:
        raise InputError(f"profile must have at least {FEWEST} summits for the theory of summits, but has {count}.")
    contact = KotwalBhushan.from_roughness(roughness, problem.contact_modulus).greenwood_williamson
    angle = math.acos(wetting_factor(*film.contact_angles) - 1.0)
    statistical = StatisticalMeniscus(contact, film.surface_tension, film.thickness, angle)
    growth, area = None, problem.grid.area
    if not math.isnan(film.viscosity):
        with contextlib.suppress(
            InputError
        ):  # the disjoining pressure of so thin a film exceeds the suction of its menisci
            liquid = (film.surface_tension, film.thickness, film.viscosity, HAMAKER, angle)
            growth = MeniscusGrowth(contact.radius, *liquid)
    pressure = np.array([load / area])
    balance = statistical.at_pressure(pressure)
    first = math.nan
    if growth is not None:
        first = float(KineticMeniscus(statistical, growth).at(0.0, pressure).meniscus_pressure[0]) * area
    return WetTheory(
        statistical=statistical,
        summits=count,
        meniscus_force=float(balance.meniscus_pressure[0]) * area,
        feedback=float(statistical.feedback(balance.contact.separation)[0]),
        growth=growth,
        first_force=first,
    )
