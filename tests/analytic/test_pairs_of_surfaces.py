"""Run-in pairs: covariance of two surfaces in the statistical theories; further names of theories;
Weibull's heights; plasticity index with friction."""

from __future__ import annotations

import math

import numpy as np
import pytest
from refusals import refused
from scipy.integrate import quad
from scipy.special import gamma

import asperity as asp
from asperity.roughness import MomentCovariance, Roughness
from asperity.theories import (
    BushGibsonThomas,
    GreenwoodTripp,
    GreenwoodWilliamson,
    LaplaceHeights,
    McCool,
    PlasticityIndex,
    WeibullHeights,
    theory,
)
from asperity.theories.catalogue import ALIASES, nearest
from asperity.theories.statistics.heights import ExponentialHeights
from asperity.theories.subsurface.sliding_yield import sphere_yield_onset

PAIR = {"E_star": 1e11, "density": 1e12, "radius": 1e-6, "height_deviation": 1e-8}


def test_a_covariance_changes_the_deviation_alone():
    p = np.geomspace(1e5, 1e7, 5)
    found = GreenwoodTripp(**PAIR, covariance=-3e-17).at_pressure(p)
    smoother = GreenwoodTripp(**PAIR | {"height_deviation": math.sqrt(1e-16 - 6e-17)}).at_pressure(p)
    for name in ("area_fraction", "contact_density", "separation", "stiffness"):
        assert getattr(found, name) == pytest.approx(getattr(smoother, name))
    assert np.all(found.area_fraction > GreenwoodTripp(**PAIR).at_pressure(p).area_fraction)
    with refused(asp.InputError, "covariance of the heights that face each other (m^2)", "-5e-17"):
        GreenwoodTripp(**PAIR, covariance=-6e-17)


def test_the_moments_of_a_run_in_pair_are_those_of_the_sum_of_its_maps():
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.1), hurst=0.8, rolloff_wavelength=6e-7, shortest_wavelength=2e-7
    )
    grid = asp.Grid((64, 64), (2e-8, 2e-8))
    first, fresh = (asp.generate.gaussian(grid, spectrum, seed=seed) for seed in (1, 2))
    # half worn into each other: valleys where the other has crests
    worn = asp.Surface(0.7 * fresh.heights - 0.5 * first.heights, 2e-8, periodic=True)
    together = asp.Surface(first.heights + worn.heights, 2e-8, periodic=True)
    of_first, of_worn, of_both = (asp.roughness_of(surface) for surface in (first, worn, together))
    covariance = MomentCovariance.of(of_first, of_worn, of_both)
    heights = [surface.heights - surface.heights.mean() for surface in (first, worn)]
    assert covariance.m0 == pytest.approx(float(np.mean(heights[0] * heights[1])), rel=1e-10)
    assert covariance.m0 < 0.0
    assert covariance.m2 < 0.0
    pair = of_first.paired(of_worn, covariance)
    assert (pair.m0, pair.m2, pair.m4) == pytest.approx((of_both.m0, of_both.m2, of_both.m4))
    exact = BushGibsonThomas.from_roughness(of_both, 1e11).at_pressure(1e7)
    assert BushGibsonThomas.from_roughness(pair, 1e11).at_pressure(1e7).area_fraction == pytest.approx(
        exact.area_fraction
    )
    # without the covariance the pair is taken for rougher, and touches on less
    apart = BushGibsonThomas.from_roughness(of_first.paired(of_worn), 1e11).at_pressure(1e7)
    assert apart.area_fraction[0] < 0.9 * exact.area_fraction[0]
    with refused(asp.InputError, "moment m0 (m^2)"):
        of_first.paired(of_worn, MomentCovariance(m0=-of_first.m0 - of_worn.m0))


def test_two_rough_surfaces_are_one_to_a_fifth():
    """O'Callaghan and Cameron's statement: pairs of summits against the summits of the sum."""
    for alpha, low, high in ((3.0, 0.79, 0.82), (10.0, 0.82, 0.86), (50.0, 0.84, 0.89)):
        rough = Roughness(1.0, 1.0, alpha)
        pair, one = GreenwoodTripp.from_roughness(rough, 1.0), McCool.from_roughness(rough, 1.0)
        p = np.geomspace(1e-4, 0.05, 5)
        ratio = pair.at_pressure(p).area_fraction / one.at_pressure(p).area_fraction
        assert low < ratio.min() < ratio.max() < high, alpha


def test_further_names_stand_for_theories():
    assert theory("ocallaghan-cameron") is GreenwoodTripp
    assert theory("francis") is BushGibsonThomas
    for name, meant in ALIASES.items():
        assert theory(name) is theory(meant)
        assert name not in asp.theories.THEORIES
    assert nearest("OCallaghan")[0] == "greenwood-tripp"
    assert nearest("fransis")[0] == "bush-gibson-thomas"


@pytest.mark.parametrize("shape", [1.0, 1.5, 2.0, 3.6, 20.0])
@pytest.mark.parametrize("upward", [True, False])
def test_heights_of_weibull(shape, upward):
    heights = WeibullHeights(shape, upward)
    assert heights.tail_moment(np.array(-50.0), 0.0) == pytest.approx(1.0)
    assert heights.tail_moment(np.array(-50.0), 1.0) == pytest.approx(50.0)  # mean zero
    assert heights.tail_moment(np.array(-50.0), 2.0) == pytest.approx(2501.0)  # variance one
    low, high = heights.support
    for D in (-1.4, 0.0, 0.8):
        start, end = max(D, low), min(high, 45.0)
        for m in (0.5, 1.5):
            expected, _ = quad(
                lambda q, D=D, m=m, start=start: (
                    (start + q * q - D) ** m * float(heights.density(np.array(start + q * q))) * 2.0 * q
                ),
                0.0,
                math.sqrt(end - start),
                epsrel=1e-11,
                limit=500,
            )
            assert float(heights.tail_moment(np.array(D), m)) == pytest.approx(expected, rel=1e-8), (D, m)


def test_weibulls_heights_of_shape_one_are_exponential():
    D = np.array([0.3, 1.0, 2.5])
    shifted = ExponentialHeights().tail_moment(D, 1.5)  # those count from the lowest, at -1
    assert WeibullHeights(1.0).tail_moment(D - 1.0, 1.5) == pytest.approx(shifted, rel=1e-13)
    assert LaplaceHeights().mean == 0.0


def test_heights_of_weibull_by_name():
    named = GreenwoodWilliamson(**PAIR, heights="weibull:2")  # type: ignore[arg-type]
    assert named.heights == WeibullHeights(2.0)
    same = GreenwoodWilliamson(**PAIR, heights=WeibullHeights(2.0)).at_pressure(1e6)
    assert named.at_pressure(1e6).area_fraction == same.area_fraction
    with refused(asp.InputError, "heights of greenwood-williamson", "'weibull:two'"):
        GreenwoodWilliamson(**PAIR, heights="weibull:two")  # type: ignore[arg-type]


def test_surfaces_with_heights_of_weibull():
    g = asp.generate
    spectrum = g.SelfAffine(amplitude=g.RmsHeight(5e-9), hurst=0.8, rolloff_wavelength=6e-7, shortest_wavelength=2e-7)
    grid = asp.Grid((64, 64), (2e-8, 2e-8))
    for upward in (True, False):
        surface = g.rank_ordered(grid, spectrum, g.Weibull(2.0, upward), seed=1)
        z = surface.heights / surface.heights.std()
        skewness = 2.0 * math.sqrt(math.pi) * (math.pi - 3.0) / (4.0 - math.pi) ** 1.5
        # quantiles leave the tail beyond the outermost of 4096
        assert float(np.mean((z - z.mean()) ** 3)) == pytest.approx(skewness if upward else -skewness, rel=0.01)
    assert g.Weibull(3.0).sorted_heights(100_000).mean() == pytest.approx(gamma(4.0 / 3.0), rel=1e-5)


SUMMITS = {"E_star": 115e9, "radius": 1e-5, "height_deviation": 5e-9, "hardness": 6e9}


def test_friction_raises_the_index_as_it_lowers_first_yield():
    free = PlasticityIndex(**SUMMITS)
    assert free.reduced_index == pytest.approx(free.index)
    for mu in (0.1, 0.3, 0.6):
        onset = sphere_yield_onset(0.3, mu).peak_over_k / sphere_yield_onset(0.3).peak_over_k
        dragged = PlasticityIndex(**SUMMITS, friction=mu)
        assert dragged.reduced_index == pytest.approx(free.index / onset)
        # the roughness at which the reduced index is the same is smoother by the square
        smooth = PlasticityIndex(**SUMMITS | {"height_deviation": 5e-9 * onset**2}, friction=mu)
        assert smooth.reduced_index == pytest.approx(free.index)
    assert PlasticityIndex(**SUMMITS, yield_ratio=0.8).reduced_index == pytest.approx(free.index / 0.8)
