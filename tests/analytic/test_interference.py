"""Overlap of undeformed bodies, complementary energy, and influence coefficients."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from reference_data import reference

import asperity as asp
from asperity.solids.compliance.halfspace import contact_compliance


def ball(points: int = 128) -> tuple[asp.ContactProblem, dict[str, float]]:
    """The sphere of the reference on a grid of four contact radii."""
    row = reference("missing/energies_hertz")[0]
    side = 4.0 * row["a_m"]
    surface = asp.generate.sphere(asp.Grid((points, points), (side / points, side / points)), radius=row["R_m"])
    nu = 0.3
    body = asp.Elastic(row["Estar_Pa"] * (1.0 - nu**2), nu)
    return asp.ContactProblem(surface, body, boundary=asp.Free()), row


def test_energies_and_overlap_of_a_sphere():
    """U = 2/5 P δ, ∫ p u* dA = 2 U, V* = -U; 2 π a² and π R δ². The top of the sphere lies between
    four points, (dx²/2)/2R below: 2e-4 of the approach here; the count of points errs by one part
    in their radius."""
    problem, row = ball()
    found = asp.solve(problem, asp.Force(row["P_N"]))
    overlap = asp.contact.interference(found)
    assert found.elastic_energy == pytest.approx(row["U_J"], rel=2e-3)
    assert asp.contact.complementary_energy(found) == pytest.approx(row["V_star_J"], rel=2e-3)
    assert asp.contact.complementary_energy(found) == pytest.approx(-found.elastic_energy, rel=1e-6)
    assert 2.0 * found.elastic_energy == pytest.approx(row["work_of_pressure_J"], rel=2e-3)
    assert overlap.area == pytest.approx(row["interference_area_m2"], rel=0.01)
    assert overlap.volume == pytest.approx(row["interference_volume_m3"], rel=5e-3)
    assert not (found.contact & ~overlap.overlapping).any(), "the contact lies within"


def test_complementary_energy_where_the_pressure_is_capped():
    """V* = -U - H ∫ w_p dA (Peng 2001, eqs 3.27 and 3.28), and H ∫ w_p dA is the plastic work."""
    problem, row = ball(64)
    hardness = 0.4 * asp.solve(problem, asp.Force(row["P_N"])).max_pressure
    found = asp.solve(replace(problem, law=asp.Hardness(hardness)), asp.Force(row["P_N"]))
    dented = hardness * float(found.permanent_indentation.sum()) * problem.grid.pixel_area
    assert dented > 0.1 * found.elastic_energy
    assert found.plastic_work == pytest.approx(dented, rel=1e-6)
    assert asp.contact.complementary_energy(found) == pytest.approx(-found.elastic_energy - dented, rel=1e-6)


def test_the_contact_of_a_rough_surface_lies_within_the_overlap():
    spectrum = asp.generate.ExponentialAutocorrelation(1e-9, 0.5e-6)
    surface = asp.generate.gaussian(asp.Grid((64, 64), (80e-9, 80e-9)), spectrum, seed=2)
    problem = asp.ContactProblem(surface, asp.Elastic(100e9, 0.3), boundary=asp.Free())
    found = asp.solve(problem, asp.MeanPressure(20e6))
    overlap = asp.contact.interference(found)
    assert not (found.contact & ~overlap.overlapping).any()
    assert found.area_fraction * found.problem.grid.area < overlap.area < found.problem.grid.area


def test_adhesive_contacts_have_no_such_energy():
    problem, row = ball(32)
    sticky = replace(problem, adhesion=asp.ExponentialAdhesion(0.05, 20e-9))
    assert math.isnan(asp.contact.complementary_energy(asp.solve(sticky, asp.Force(row["P_N"]))))


@pytest.mark.parametrize("thickness", [None, 5e-8])
def test_influence_coefficients_are_those_of_the_solver_at_the_surface(thickness: float | None):
    base = asp.Elastic(200e9, 0.3)
    body = base if thickness is None else asp.Layered([asp.Layer(asp.Elastic(400e9, 0.25), thickness)], base)
    grid = asp.Grid((9, 9), (1e-7, 1e-7))
    C = asp.stresses.influence_coefficients(body, grid, [0.0, 1e-7])
    kernel = contact_compliance(body, asp.Rigid()).influence(asp.Grid((5, 5), (1e-7, 1e-7)))
    np.testing.assert_allclose(C.displacement.z[0, 4:, 4:], kernel[:5, :5], rtol=1e-6)
    assert C.displacement.z[1, 4, 4] < C.displacement.z[0, 4, 4]
    assert C.tensor.zz[0, 4, 4] == pytest.approx(-1.0, rel=1e-9)
    sheared = asp.stresses.influence_coefficients(body, grid, [1e-7], shear=True)
    assert sheared.displacement.x[0, 4, 4] > 10.0 * abs(sheared.displacement.z[0, 4, 4])
