"""Rough contact of layered bodies: what must not matter, what must, and what it may cost."""

import numpy as np
import pytest
from contact_cases import TIGHT, rough, square_grid
from solid_cases import elastic, on_half_space

import asperity as asp

LOAD = asp.MeanPressure(0.02)
NO_EXTRAS = asp.Keep(stiffness=False)
SURFACE = rough((48, 40), seed=3, spacing=(1.0, 1.3), power=2.0)
BODY = on_half_space(3.0, 2.5)
OTHER = asp.Layered(
    [asp.Layer(elastic(0.5, 0.4), 1.0, asp.Frictionless()), asp.Layer(elastic(4.0, 0.2), 3.0)], elastic(2.0, 0.3)
)


def solved(body, counter=asp.Rigid(), boundary=asp.Periodic(), control=LOAD):
    problem = asp.ContactProblem(SURFACE, body, counter_body=counter, boundary=boundary)
    return asp.solve(problem, control, solver=TIGHT, keep=NO_EXTRAS)


def assert_same(one, other, tolerance=1e-5):
    """Both have the field error 1e-11; the pressure is determined to about its root."""
    np.testing.assert_allclose(one.pressure, other.pressure, rtol=0, atol=tolerance * one.max_pressure)
    assert one.area_fraction == pytest.approx(other.area_fraction, abs=1.0 / one.problem.grid.n_points)


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()])
def test_it_does_not_matter_which_body_is_called_the_counter_body(boundary):
    assert_same(solved(BODY, OTHER, boundary), solved(OTHER, BODY, boundary))


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()])
def test_layers_of_the_base_s_material_change_nothing(boundary):
    same = asp.Layered([asp.Layer(elastic(1.0, 0.3), h) for h in (0.3, 2.0, 7.0)], elastic(1.0, 0.3))
    assert_same(solved(same, boundary=boundary), solved(elastic(1.0, 0.3), boundary=boundary))


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()])
def test_very_thick_and_very_thin_layers_are_half_spaces(boundary):
    """Beyond 1e4 map lengths and below 1e-6 pixels: the error is of the order of those ratios."""
    thick, thin = on_half_space(3.0, 1e6), on_half_space(3.0, 1e-7)
    assert_same(solved(thick, boundary=boundary), solved(elastic(3.0, 0.3), boundary=boundary), 1e-4)
    assert_same(solved(thin, boundary=boundary), solved(elastic(1.0, 0.3), boundary=boundary), 1e-4)


def test_stretching_everything_scales_the_answer():
    """Heights, pixels and layers three times as large at the same pressure: lengths triple,
    pressures stay."""
    plain = solved(BODY)
    large = asp.Surface(3.0 * SURFACE.heights, 3.0 * SURFACE.dx, 3.0 * SURFACE.dy, periodic=True)
    layers = [asp.Layer(layer.material, 3.0 * layer.thickness) for layer in BODY.layers]
    problem = asp.ContactProblem(large, asp.Layered(layers, BODY.base))
    scaled = asp.solve(problem, LOAD, solver=TIGHT, keep=NO_EXTRAS)
    assert_same(scaled, plain)
    np.testing.assert_allclose(scaled.displacement, 3.0 * plain.displacement, rtol=0, atol=1e-5 * plain.gap.max())


def test_a_layer_on_a_rigid_base_is_pressed_by_the_approach():
    """A uniform pressure on a flat layer compresses it by p h/M: approach, and energy per area half
    of their product."""
    h, material = 2.0, elastic(3.0, 0.25)
    body = asp.Layered([asp.Layer(material, h)], asp.RigidBase())
    problem = asp.ContactProblem(asp.Surface(np.zeros((8, 8)), 1.0, periodic=True), body)
    result = asp.solve(problem, asp.MeanPressure(0.1), solver=TIGHT, keep=NO_EXTRAS)
    confined = 2.0 * material.shear_modulus * (1.0 - 0.25) / (1.0 - 2.0 * 0.25)
    assert result.approach == pytest.approx(0.1 * h / confined, rel=1e-12)
    assert result.elastic_energy == pytest.approx(0.5 * 0.1 * result.approach * problem.grid.area, rel=1e-12)
    back = asp.solve(problem, asp.Approach(result.approach), solver=TIGHT, keep=NO_EXTRAS)
    assert back.mean_pressure == pytest.approx(0.1, rel=1e-9)


def self_affine(n=256):
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(1.0), hurst=0.8, rolloff_wavelength=n / 4, shortest_wavelength=8.0
    )
    return asp.generate.gaussian(square_grid(n, float(n)), spectrum, seed=1)


@pytest.mark.parametrize(("ratio", "factor"), [(2.0, 0.5), (0.5, 2.0)])
def test_a_thick_coating_twice_as_stiff_halves_the_area(ratio, factor):
    """Area is proportional to load over modulus while it is small (Peng & Bhushan 2001); the base
    is felt by a few per cent."""
    surface = self_affine()
    load = asp.MeanPressure(0.01)
    bare, coated = (
        asp.solve(asp.ContactProblem(surface, body), load, keep=NO_EXTRAS)
        for body in (elastic(1.0, 0.3), on_half_space(ratio, 60.0))
    )
    assert coated.area_fraction / bare.area_fraction == pytest.approx(factor, rel=0.1)


@pytest.mark.parametrize("ratio", [0.5, 2.0])
def test_layers_cost_hardly_more_transforms(ratio):
    """The preconditioner follows the compliance; pairs at equal areas, counted, and so the same on
    every machine."""
    surface = self_affine()
    bare = asp.solve(asp.ContactProblem(surface, elastic(1.0, 0.3)), asp.MeanPressure(0.05), keep=NO_EXTRAS)
    problem = asp.ContactProblem(surface, on_half_space(ratio, 20.0))
    coated = asp.solve(problem, asp.MeanPressure(0.05 * ratio), keep=NO_EXTRAS)
    assert coated.area_fraction == pytest.approx(bare.area_fraction, rel=0.2)
    assert coated.certificate.fft_pairs <= 1.25 * bare.certificate.fft_pairs
