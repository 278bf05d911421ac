"""Smooth rigid indenters on layered bodies in the units of the reference tables: a_0 = 1, base
modulus 1, radius 100."""

from __future__ import annotations

import numpy as np
from reference_data import Row
from solid_cases import on_half_space

import asperity as asp
from asperity.solvers import ConjugateGradient
from asperity.theories.single.hertz import HertzLine, HertzPoint

RADIUS = 100.0
WIDTH = 2.3
"""Side of the grid in contact radii; the free boundary needs no more than the contact."""
SOLVER = ConjugateGradient(tolerance=1e-9)
NO_EXTRAS = asp.Keep(stiffness=False)


def body(row: Row) -> asp.Layered:
    """One layer on a half-space of modulus 1."""
    return on_half_space(row["E1_over_E2"], row["h_over_a0"], nu=row["nu1"], nu_base=row["nu2"])


def _on_base(row: Row) -> HertzPoint:
    """Hertz's contact of the same paraboloid with the base alone."""
    return HertzPoint(body(row).base.plane_strain_modulus, RADIUS)


def sphere(row: Row, radius: float, n: int) -> asp.ContactResult:
    """Paraboloid under the load that gives a_0 = 1 on the base alone, on n x n pixels over
    ``radius``."""
    layered = body(row)
    pixel = WIDTH * radius / n
    x, y = asp.Grid((n, n), (pixel, pixel)).centred_coordinates()
    surface = asp.Surface(-(x**2 + y**2) / (2.0 * RADIUS), pixel)
    problem = asp.ContactProblem(surface, layered, boundary=asp.Free())
    force = float(_on_base(row).at_radius(1.0).load)
    return asp.solve(problem, asp.Force(force), solver=SOLVER, keep=NO_EXTRAS)


def sphere_peak(row: Row) -> float:
    """Hertz's peak pressure on the base alone."""
    return float(_on_base(row).at_radius(1.0).max_pressure)


def cylinder(row: Row, radius: float, n: int, datum: float | None = None) -> asp.ContactResult:
    """Parabolic cylinder under the load per length that gives a_0 = 1 on the base alone."""
    layered = body(row)
    pixel = WIDTH * radius / n
    x, _ = asp.Grid((n, 1), (pixel, 1.0)).centred_coordinates()
    surface = asp.Surface(-(x**2) / (2.0 * RADIUS), pixel, 1.0)
    problem = asp.ContactProblem(surface, layered, boundary=asp.FreeLine(datum))
    force = float(HertzLine(layered.base.plane_strain_modulus, RADIUS).at_half_width(1.0).load)
    return asp.solve(problem, asp.Force(force), solver=SOLVER, keep=NO_EXTRAS)


def cylinder_peak(row: Row) -> float:
    """Hertz's peak pressure on the base alone."""
    return float(HertzLine(body(row).base.plane_strain_modulus, RADIUS).at_half_width(1.0).max_pressure)


def pressure_at(result: asp.ContactResult, distance: float) -> float:
    """Pressure (Pa) at ``distance`` (m) from the middle along x; its square, linear at the edge, is
    interpolated."""
    middle = tuple(n // 2 for n in result.problem.grid.shape)
    x = result.problem.grid.spacing[0] * np.arange(middle[0] + 1)
    return float(np.sqrt(np.interp(distance, x, result.pressure[middle[0] :, middle[1]] ** 2)))
