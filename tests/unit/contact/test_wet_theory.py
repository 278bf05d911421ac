"""The theory of summits beside a wet contact: what it is made of, its bounds and limits, and when
there is none."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from contact_cases import wetted
from refusals import refused

import asperity as asp
from asperity.theories.rough.greenwood_williamson import KotwalBhushan
from asperity.theories.wet.summits import StatisticalMeniscus

NM = 1e-9
LOAD = asp.MeanPressure(2e6)


@pytest.fixture(scope="module")
def problem() -> asp.ContactProblem:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(2.0 * NM), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=100 * NM
    )
    surface = asp.generate.gaussian(asp.Grid((64, 64), (25 * NM, 25 * NM)), spectrum, seed=5)
    return asp.ContactProblem(surface, asp.Elastic(100e9, 0.3))


def film(thickness: float, **options) -> asp.LiquidFilm:
    return asp.LiquidFilm(surface_tension=0.025, thickness=thickness, **options)


def with_film(result: asp.ContactResult, film: asp.LiquidFilm) -> asp.ContactResult:
    return replace(result, couplings={"menisci": replace(result.menisci, film=film)})


def test_it_is_the_closed_theory_of_the_summits_of_the_map(problem):
    wet = wetted(problem, LOAD, film(2.0 * NM, contact_angles=(math.radians(10.0), 0.0)))
    found = asp.menisci.wet_theory(wet)
    summits = KotwalBhushan.from_roughness(asp.roughness_of(problem.surface), problem.contact_modulus)
    theory = StatisticalMeniscus(summits.greenwood_williamson, 0.025, 2.0 * NM, math.radians(10.0))
    direct = theory.at_pressure(LOAD.value).meniscus_pressure[0] * problem.grid.area
    assert found.meniscus_force == pytest.approx(direct, rel=1e-12)
    assert 0.0 < found.meniscus_force < theory.largest * problem.grid.area
    # each of the two models is off by a factor of order one, and both are about the same thing
    assert 0.2 < found.meniscus_force / wet.menisci.meniscus_force < 5.0


def test_two_angles_count_by_the_sum_of_their_cosines(problem):
    """cos 60° + cos 60° = 1 + cos 90°."""
    both = wetted(problem, LOAD, film(NM, contact_angles=(math.pi / 3.0, math.pi / 3.0)))
    one = with_film(both, film(NM, contact_angles=(math.pi / 2.0, 0.0)))
    assert asp.menisci.wet_theory(both).meniscus_force == pytest.approx(
        asp.menisci.wet_theory(one).meniscus_force, rel=1e-9
    )


def test_the_force_rises_from_contact_to_equilibrium(problem):
    """At first, menisci as high as the film pull summits near it less; in the end all pull with the
    full force."""
    wet = wetted(problem, LOAD, film(2.0 * NM, viscosity=0.01))
    found = asp.menisci.wet_theory(wet)
    assert 0.0 < found.first_force < found.meniscus_force
    assert found.growth is not None
    assert found.growth.time_to(0.99) > 0.0
    assert "BhushanKotwal1998" in found.citation_keys


def test_no_growth_without_viscosity_or_from_a_film_that_holds_its_liquid(problem):
    """Disjoining pressure of 0.1 nm: 1e-19/(6π 1e-30) = 5 GPa, ten times the suction of a meniscus
    of that height."""
    wet = wetted(problem, LOAD, film(NM))
    assert asp.menisci.wet_theory(wet).growth is None
    thin = with_film(wet, film(0.1 * NM, viscosity=0.01))
    assert asp.menisci.wet_theory(thin).growth is None
    assert math.isnan(asp.menisci.wet_theory(thin).first_force)


def test_there_is_no_theory_without_summits_or_load(problem):
    x = (np.arange(32) - 15.5) * 10 * NM
    ball = asp.ContactProblem(
        asp.Surface(-np.add.outer(x**2, x**2) / 2e-6, 10 * NM), asp.Elastic(100e9, 0.3), boundary=asp.Free()
    )
    with refused(asp.InputError, "profile", "20"):
        asp.menisci.wet_theory(wetted(ball, asp.Force(1e-7), film(NM)))
    apart = wetted(problem, asp.MeanGap(5.8 * NM), film(2.0 * NM))
    assert apart.external_force <= 0.0
    with refused(asp.InputError, "external force (N)"):
        asp.menisci.wet_theory(apart)
