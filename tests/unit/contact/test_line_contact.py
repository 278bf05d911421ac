"""Line contact: plane strain on grids of one point along y."""

import numpy as np
import pytest
from contact_cases import TIGHT, elastic, rough
from hypothesis import given, settings
from hypothesis import strategies as st
from indenter_cases import cylinder
from reference_data import reference
from refusals import refused
from solid_cases import on_half_space, stacks

import asperity as asp
from asperity.solids.compliance.halfspace import HalfSpace
from asperity.solids.compliance.layered import LayerStack, interface_compliances
from asperity.theories.single.hertz import HertzLine

ROW = next(row for row in reference("cylinder_layered") if row["E1_over_E2"] == 4.0)
LAYERED = on_half_space(5.0, 0.7)
few = settings(max_examples=30)


def strips(n, step=1.0):
    return asp.Grid((n, 1), (step, 1.0))


def test_homogeneous_strip_is_the_integral_of_flamant_s_line_load():
    """u = -(2/pi E') ∫ ln(|x - s|/datum) ds over the strip (Johnson 1985, eq. 2.24), by
    quadrature."""
    found = HalfSpace(2.0).line_influence(strips(6, 0.5), 10.0)
    node, weight = np.polynomial.legendre.leggauss(60)
    for i in range(6):
        ends = (-0.25, 0.25) if i else (0.0, 0.25)  # the logarithm is split at its pole, and halved
        s = ends[0] + (ends[1] - ends[0]) * (0.5 * (node + 1.0)) ** 3  # smooth at the pole too
        jacobian = (ends[1] - ends[0]) * 1.5 * (0.5 * (node + 1.0)) ** 2
        integral = float(np.sum(weight * jacobian * np.log(np.abs(0.5 * i - s) / 10.0))) * (1.0 if i else 2.0)
        assert found[i, 0] == pytest.approx(-integral / np.pi, rel=1e-9)


def test_layered_strips_have_the_two_half_spaces_as_limits():
    """Far finer and far coarser than the layer: Flamant's response of the layer's and of the base's
    material.

    Near the load the datum is still that of the base: differences of displacement are compared.
    """
    body = LAYERED
    fine, coarse = strips(5, 1e-6), strips(5, 1e6)
    top = HalfSpace(body.layers[0].material.plane_strain_modulus).line_influence(fine, 1.0)
    near = LayerStack(body).line_influence(fine, 1.0)
    np.testing.assert_allclose(np.diff(near, axis=0), np.diff(top, axis=0), rtol=1e-6)
    base = HalfSpace(body.base.plane_strain_modulus).line_influence(coarse, 1e7)
    np.testing.assert_allclose(LayerStack(body).line_influence(coarse, 1e7), base, rtol=1e-6)


@few
@given(stacks(most=3, moduli=st.floats(0.05, 20.0), thicknesses=st.floats(0.2, 3.0)), st.floats(-1.0, 1.0))
def test_line_response_by_direct_quadrature(body, exponent):
    """Differences of displacement, ∫ C P (cos alpha x - cos alpha x0) d alpha/pi with the transform
    P of a strip.

    The part of the top layer alone is taken from Flamant's formula, so that the rest falls
    exponentially.
    """
    step = 10.0**exponent
    grid = strips(4, step)
    top = body.layers[0].material.plane_strain_modulus
    known = HalfSpace(top).line_influence(grid, 100.0 * step)[:, 0]
    found = LayerStack(body).line_influence(grid, 100.0 * step)[:, 0]
    first = 40.0 / body.layers[0].thickness
    ends = np.unique(np.concatenate([[0.0], np.geomspace(1e-9 * first, first, 200), np.arange(0.0, first, 0.5 / step)]))
    node, weight = np.polynomial.legendre.leggauss(16)
    half = 0.5 * np.diff(ends)
    alpha = ((ends[:-1] + half)[:, None] + half[:, None] * node).ravel()
    measure = (half[:, None] * weight).ravel()
    rest = interface_compliances(body, alpha)[0].zz - 2.0 / (top * alpha)
    rest *= 2.0 * np.sin(0.5 * alpha * step) / alpha
    for i in range(1, 4):
        change = float(np.sum(measure * rest * (np.cos(alpha * i * step) - 1.0))) / np.pi
        assert found[i] - found[0] == pytest.approx(known[i] - known[0] + change, abs=1e-8 * known[0])


def test_datum_shifts_the_approach_and_nothing_else():
    """Approach grows by the Flamant displacement between the two datums, 2P/(pi E') ln of their
    ratio."""
    near, far = (cylinder(ROW, ROW["a_over_a0"], 129, datum=datum) for datum in (1e3, 1e5))
    np.testing.assert_allclose(near.pressure, far.pressure, rtol=0, atol=1e-6 * near.max_pressure)
    np.testing.assert_allclose(near.gap, far.gap, rtol=0, atol=1e-6 * near.gap.max())
    base = near.problem.body.base.plane_strain_modulus
    shift = 2.0 * near.force / (np.pi * base) * np.log(100.0)  # per metre of dy = 1 m
    assert far.approach - near.approach == pytest.approx(shift, rel=1e-4)  # at 1e3 layers are still felt to (h/datum)


def test_force_and_area_are_those_of_the_length_dy():
    heights = -((np.arange(65) - 32.0) ** 2)[:, None] / 200.0
    results = [
        asp.solve(
            asp.ContactProblem(asp.Surface(heights, 1.0, dy), elastic(1.0), boundary=asp.FreeLine()),
            asp.Force(3.0 * dy),
            solver=TIGHT,
        )
        for dy in (1.0, 0.01)
    ]
    np.testing.assert_allclose(results[0].pressure, results[1].pressure, rtol=1e-9)
    assert results[1].contact_area == pytest.approx(0.01 * results[0].contact_area, rel=1e-9)
    assert results[0].approach == pytest.approx(results[1].approach, rel=1e-9)
    assert results[0].max_pressure == pytest.approx(float(HertzLine(1.0, 100.0).at_load(3.0).max_pressure), rel=2e-3)


def test_long_rows_of_rectangles_become_a_line_contact():
    """The boundary Free() on one row is a row of rectangles dx x dy: long ones have the
    plane-strain differences."""
    grid, long_grid = strips(20), asp.Grid((20, 1), (1.0, 1e6))
    for compliance in (HalfSpace(1.0), LayerStack(LAYERED)):
        plane = compliance.line_influence(grid, 100.0)[:, 0]
        space = compliance.influence(long_grid)[:, 0]
        np.testing.assert_allclose(np.diff(space), np.diff(plane), rtol=1e-6)


def test_periodic_line_is_plane_strain_already():
    """Waves along x on a cell of one point along y: the same c(q) as in three dimensions."""
    problem = asp.ContactProblem(rough((64, 1), seed=4), LAYERED)
    operator = asp.solvers.prepare_operator(problem.compliance, problem.grid, problem.boundary)
    x = problem.grid.coordinates()[0]
    q = 2.0 * np.pi * 3.0 / 64.0
    expected = np.cos(q * x) * interface_compliances(LAYERED, q)[0].zz
    np.testing.assert_allclose(operator.apply(np.cos(q * x)), expected, rtol=0, atol=1e-12)


@few
@given(st.integers(1, 40), st.sampled_from([1e-3, 1.0, 1e3]), st.booleans())
def test_operator_is_symmetric_and_positive(n, step, layered):
    """A datum not nearer than the grid is long keeps the logarithm positive."""
    compliance = LayerStack(LAYERED) if layered else HalfSpace(1.0)
    operator = asp.solvers.prepare_operator(compliance, strips(n, step), asp.FreeLine())
    dense = operator.matrix()
    p = np.random.default_rng(n).standard_normal((n, 1))
    np.testing.assert_allclose(dense @ p.ravel(), operator.apply(p).ravel(), rtol=0, atol=1e-13 * n * dense.max())
    np.testing.assert_array_equal(dense, dense.T)
    assert np.linalg.eigvalsh(dense).min() > 0.0


def test_rigid_base_needs_no_datum():
    body = asp.Layered([asp.Layer(elastic(1.0), 1.0)], asp.RigidBase())
    one, other = (LayerStack(body).line_influence(strips(50), datum) for datum in (50.0, 1e6))
    np.testing.assert_array_equal(one, other)
    assert abs(one[-1, 0]) < 2e-11 * one[0, 0], (
        "dies out within some thicknesses; rounding grows with the root of the datum"
    )
    uniform = one[0, 0] + 2.0 * one[1:, 0].sum()
    assert uniform == pytest.approx(LayerStack(body).mean_mode(), rel=1e-9)


def test_refusals():
    flat = asp.Surface(np.zeros((4, 3)), 1.0)
    line = asp.Surface(np.zeros((4, 1)), 1.0)
    with refused(asp.InputError, "grid of a line contact", "4", "3"):
        asp.ContactProblem(flat, elastic(1.0), boundary=asp.FreeLine())
    with refused(asp.InputError, "datum of a line contact (m)", "4", "3"):
        asp.ContactProblem(line, elastic(1.0), boundary=asp.FreeLine(3.0))
    with refused(asp.InputError, "datum of a line contact (m)"):
        asp.FreeLine(0.0)
    asp.ContactProblem(line, elastic(1.0), boundary=asp.FreeLine(4.0))


def test_perimeter_and_border_of_a_line():
    """No edges along y, where the contact goes on; contact at an end of the line is noted."""
    problem = asp.ContactProblem(asp.Surface(np.zeros((8, 1)), 1.0, 5.0), elastic(1.0), boundary=asp.FreeLine())
    result = asp.solve(problem, asp.MeanPressure(1e-3))
    assert result.contact.all()
    assert result.contact_perimeter == 2 * 5.0
    assert "contact at the border" in {a.criterion for a in asp.contact.review(result)}
    hill = asp.Surface(-((np.arange(33) - 16.0) ** 2)[:, None] / 500.0, 1.0, 5.0)
    inside = asp.solve(asp.ContactProblem(hill, elastic(1.0), boundary=asp.FreeLine()), asp.Force(1.0))
    assert "contact at the border" not in {a.criterion for a in asp.contact.review(inside)}
    assert "periodic edges" not in {a.criterion for a in asp.contact.advise(inside.problem, asp.Force(1.0))}
