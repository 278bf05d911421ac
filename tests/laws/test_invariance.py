"""Laws every solution obeys: symmetries, scaling, superposition of bodies, monotonicity.
Property-based."""

import dataclasses

import numpy as np
import pytest
from contact_cases import TIGHT, elastic, rough
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import asperity as asp
from asperity.solvers import ConjugateGradient

SHAPES = st.sampled_from([(16, 16), (12, 18), (15, 11), (32, 4)])
SEEDS = st.integers(0, 10**6)
BOUNDARIES = st.sampled_from([asp.Periodic(), asp.Free()])
LOADS = st.floats(0.002, 0.3)
few = settings(max_examples=25)

# a relative error of 1e-11 in energy is at most its square root, 3e-6, in pressure (K-norm); 1e-4
# of the maximum leaves room for the norms' ratio on grids of up to 18 points
CLOSE = 1e-4


def solved(surface, load, boundary, law=None, body=None, **more):
    problem = asp.ContactProblem(
        surface, body or elastic(1.0), boundary=boundary, law=law or asp.plasticity.HardWall(), **more
    )
    return asp.solve(problem, asp.MeanPressure(load), solver=TIGHT)


def assert_same_pressure(found, expected):
    np.testing.assert_allclose(found, expected, rtol=0, atol=CLOSE * expected.max())


@few
@given(SHAPES, SEEDS, BOUNDARIES, LOADS)
def test_swapping_the_axes_transposes(shape, seed, boundary, load):
    surface = rough(shape, seed, spacing=(1.0, 1.3))
    swapped = asp.Surface(surface.heights.T, surface.dy, surface.dx, periodic=True)
    assert_same_pressure(solved(swapped, load, boundary).pressure, solved(surface, load, boundary).pressure.T)


@few
@given(SHAPES, SEEDS, BOUNDARIES, LOADS)
def test_mirroring_mirrors(shape, seed, boundary, load):
    surface = rough(shape, seed)
    mirrored = asp.Surface(surface.heights[::-1, :], surface.dx, surface.dy, periodic=True)
    assert_same_pressure(solved(mirrored, load, boundary).pressure, solved(surface, load, boundary).pressure[::-1, :])


@few
@given(SHAPES, SEEDS, LOADS, st.integers(0, 40), st.integers(0, 40))
def test_shifting_a_periodic_surface_shifts(shape, seed, load, i, j):
    surface = rough(shape, seed)
    shifted = asp.Surface(np.roll(surface.heights, (i, j), (0, 1)), surface.dx, surface.dy, periodic=True)
    a, b = solved(surface, load, asp.Periodic()), solved(shifted, load, asp.Periodic())
    assert_same_pressure(b.pressure, np.roll(a.pressure, (i, j), (0, 1)))
    assert b.n_spots == a.n_spots
    assert b.contact_perimeter == pytest.approx(a.contact_perimeter)


@few
@given(SHAPES, SEEDS, BOUNDARIES, LOADS, st.floats(-1e3, 1e3))
def test_a_constant_changes_only_the_offset(shape, seed, boundary, load, constant):
    surface = rough(shape, seed)
    raised = asp.Surface(surface.heights + constant, surface.dx, surface.dy, periodic=True)
    a, b = solved(surface, load, boundary), solved(raised, load, boundary)
    assert_same_pressure(b.pressure, a.pressure)
    assert b.approach == pytest.approx(a.approach, rel=1e-5, abs=1e-9)
    assert b.offset - a.offset == pytest.approx(constant, rel=1e-5, abs=1e-5)


@few
@given(SHAPES, SEEDS, BOUNDARIES, LOADS, st.floats(1e-9, 1e-3), st.floats(1e-9, 1e-3), st.floats(1e3, 1e12))
def test_scaling_heights_lengths_and_modulus(shape, seed, boundary, load, height, length, modulus):
    """p = E* (height/length) f(x/length): the exact similarity of linear elasticity."""
    unit = rough(shape, seed)
    scaled = asp.Surface(height * unit.heights, length, length, periodic=True)
    factor = modulus * height / length
    a = solved(unit, load, boundary)
    b = solved(scaled, load * factor, boundary, body=elastic(modulus))
    assert_same_pressure(b.pressure / factor, a.pressure)
    assert b.approach / height == pytest.approx(a.approach, rel=1e-5)
    assert b.mean_gap / height == pytest.approx(a.mean_gap, rel=1e-5, abs=1e-8)
    assert b.elastic_energy / (factor * height * length**2) == pytest.approx(a.elastic_energy, rel=1e-5)


@few
@given(SHAPES, SEEDS, SEEDS, BOUNDARIES, LOADS)
def test_two_bodies_are_one_composite(shape, seed, other, boundary, load):
    """Two rough elastic bodies = the sum of the surfaces on the sum of the compliances (Peng 2001,
    appendix D)."""
    one, two = rough(shape, seed), rough(shape, other)
    soft, stiff = asp.Elastic(1.0, 0.2), asp.Elastic(3.0, 0.4)
    pair = asp.ContactProblem(one, soft, counter_surface=two, counter_body=stiff, boundary=boundary)
    both = asp.solve(pair, asp.MeanPressure(load), solver=TIGHT)
    total = asp.Surface(one.heights + two.heights, 1.0, periodic=True)
    assert_same_pressure(solved(total, load, boundary, body=elastic(pair.contact_modulus)).pressure, both.pressure)
    turned = asp.ContactProblem(two, stiff, counter_surface=one, counter_body=soft, boundary=boundary)
    assert_same_pressure(asp.solve(turned, asp.MeanPressure(load), solver=TIGHT).pressure, both.pressure)


@few
@given(SHAPES, SEEDS, BOUNDARIES, st.lists(LOADS, min_size=2, max_size=2, unique=True))
def test_contact_grows_with_load(shape, seed, boundary, loads):
    """Area and approach never decrease with load, the mean gap never grows (pixels near zero
    pressure may flicker)."""
    surface = rough(shape, seed)
    low, high = (solved(surface, load, boundary) for load in sorted(loads))
    assert high.approach >= low.approach * (1.0 - 1e-6)
    assert high.mean_gap <= low.mean_gap * (1.0 + 1e-6)
    clearly = low.pressure > 1e-5 * low.max_pressure
    assert np.count_nonzero(high.contact) >= np.count_nonzero(clearly)


@few
@given(SHAPES, SEEDS, BOUNDARIES, LOADS, st.floats(1.1, 10.0))
def test_a_more_compliant_solid_has_no_less_area(shape, seed, boundary, load, ratio):
    surface = rough(shape, seed)
    stiff, soft = solved(surface, load, boundary), solved(surface, load, boundary, body=elastic(1.0 / ratio))
    clearly = stiff.pressure > 1e-5 * stiff.max_pressure
    assert np.count_nonzero(soft.contact) >= np.count_nonzero(clearly)


@few
@given(SHAPES, SEEDS, BOUNDARIES, LOADS, st.sampled_from([np.inf, 4.0, 1.5]))
def test_contact_conditions_and_balance(shape, seed, boundary, load, cap_over_load):
    """The solution itself: p >= 0, p <= H, gap >= 0, p gap = 0, load carried, gap identity,
    certificate honest."""
    law = asp.plasticity.HardWall() if cap_over_load == np.inf else asp.Hardness(cap_over_load * load)
    result = solved(rough(shape, seed), load, boundary, law)
    assert result.pressure.min() >= 0.0
    assert result.max_pressure <= cap_over_load * load
    assert result.gap.min() >= 0.0
    assert result.mean_pressure == pytest.approx(load, rel=1e-12)
    scale = result.problem.profile().std()
    assert (result.pressure * result.gap).sum() <= 1e-8 * result.pressure.sum() * scale
    identity = result.offset + result.displacement - result.problem.profile() + result.permanent_indentation
    np.testing.assert_allclose(result.gap, identity, rtol=0, atol=1e-6 * scale)
    assert result.certificate.field_error <= 1.01e-11
    assert result.certificate.load_imbalance < 1e-12
    assert (result.permanent_indentation[~result.plastic] == 0.0).all()


@few
@given(SHAPES, SEEDS, BOUNDARIES, LOADS)
def test_free_approach_and_gap_controls_find_the_same_state(shape, seed, boundary, load):
    by_load = solved(rough(shape, seed), load, boundary)
    assume(by_load.area_fraction < 1.0)  # at full contact the position does not fix a periodic load
    for control in (asp.Approach(by_load.approach), asp.MeanGap(by_load.mean_gap)):
        other = asp.solve(by_load.problem, control, solver=TIGHT)
        assert other.mean_pressure == pytest.approx(load, rel=1e-4)
        assert_same_pressure(other.pressure, by_load.pressure)


def test_thread_count_changes_nothing_but_rounding():
    surface = rough((64, 64), 3)
    problem = asp.ContactProblem(surface, elastic(1.0))
    one, two = (
        asp.solve(problem, asp.MeanPressure(0.05), solver=TIGHT, engine=asp.engines.CpuEngine(t)) for t in (1, 2)
    )
    np.testing.assert_allclose(two.pressure, one.pressure, rtol=0, atol=1e-9 * one.max_pressure)


def test_inputs_are_left_alone():
    surface = rough((16, 16), 1)
    problem = asp.ContactProblem(surface, elastic(1.0), law=asp.Hardness(0.3))
    first = asp.solve(problem, asp.MeanPressure(0.05))
    heights, state = surface.heights.copy(), first.state
    indentation = state.permanent_indentation.copy()
    asp.solve(problem, asp.MeanPressure(0.08), state=state)
    np.testing.assert_array_equal(surface.heights, heights)
    np.testing.assert_array_equal(state.permanent_indentation, indentation)
    with pytest.raises(dataclasses.FrozenInstanceError):
        problem.body = asp.Rigid()
    with pytest.raises(ValueError, match="read-only"):
        surface.heights[0, 0] = 1.0


def test_looser_tolerance_means_fewer_iterations_and_a_larger_certified_error():
    problem = asp.ContactProblem(rough((48, 48), 5), elastic(1.0))
    loose, tight = (
        asp.solve(problem, asp.MeanPressure(0.05), solver=ConjugateGradient(tolerance=t)) for t in (1e-3, 1e-9)
    )
    assert loose.certificate.iterations < tight.certificate.iterations
    assert 1e-9 < loose.certificate.field_error <= 1e-3

    # the certificate bounds the energy error: the loose answer's energy lies above the tight one's
    # by at most that
    def energy(result):
        return 0.5 * (result.pressure * result.displacement).sum() - (result.pressure * problem.profile()).sum()

    excess = energy(loose) - energy(tight)
    bound = loose.certificate.field_error * loose.pressure.sum() * problem.profile().std()
    assert 0.0 <= excess <= bound
