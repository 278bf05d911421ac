"""Conductance of solved contacts: stiffness, bounds, plastic points, gaps, histories, spots."""

from __future__ import annotations

import math

import numpy as np
import pytest
from contact_cases import rough
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.physics.conductance.conductance import ContactConductance, conductance
from asperity.physics.conductance.law import ConductingInterface
from asperity.physics.conductance.operator import ELECTRICAL, THERMAL
from asperity.physics.conductance.stiffness import (
    conductance_bounds,
    convex_bounds,
    from_stiffness,
    smooth_bounds,
    why_not,
)
from asperity.solids import Conduction
from asperity.theories.conductance import spots

K, RHO = 20.0, 4e-8
BODY = asp.Elastic(0.91, 0.3, conduction=Conduction(K, RHO))
ROUGH = rough((64, 64), 3)


def problem(surface: asp.Surface = ROUGH, body=BODY, **more) -> asp.ContactProblem:
    return asp.ContactProblem(surface, body, **more)


def sphere(radius: float, pixels: float) -> tuple[asp.ContactResult, float]:
    """Hertz's contact of so many pixels in the radius on a free grid, and that radius."""
    n, a = int(2.6 * pixels), 0.05 * radius
    dx = a / pixels
    place = (np.arange(n) - 0.5 * (n - 1) + 0.3) * dx
    heights = -0.5 * (place[:, None] ** 2 + place[None, :] ** 2) / radius
    found = asp.solve(problem(asp.Surface(heights, dx), boundary=asp.Free()), asp.Force(4.0 / 3.0 * a**3 / radius))
    return found, a


@pytest.mark.parametrize("pixels", [8.0, 16.0, 40.0])
def test_hertz_contacts_conduct_as_holms_circle(pixels: float) -> None:
    """The estimated error of the pixels holds the truth."""
    result, a = sphere(2.0, pixels)
    found = conductance(result, "thermal")
    true = float(spots.circle(2.0 * K, a))
    assert abs(found.total / true - 1.0) < found.error
    assert found.error < 0.3 / pixels
    assert found.resistance == pytest.approx(1.0 / found.total)


@pytest.mark.parametrize("pixels", [8.0, 16.0, 40.0])
def test_films_on_hertz_contacts_conduct_by_their_area(pixels: float) -> None:
    result, a = sphere(2.0, pixels)
    thick = 100.0 * a / K
    found = conductance(result, "thermal", ConductingInterface(film_resistance=thick))
    assert abs(found.total / (math.pi * a**2 / thick) - 1.0) < found.error + 0.01  # the constriction adds 1 %
    assert found.error < 0.6 / pixels


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()])
def test_conductance_is_stiffness(boundary) -> None:
    """The same linear system by the same solver: they agree to its single precision."""
    result = asp.solve(problem(boundary=boundary), asp.MeanPressure(0.02))
    for flow, k_s in ((THERMAL, 2.0 * K), (ELECTRICAL, 2.0 / RHO)):
        found = conductance(result, flow.name)
        assert found.k_s == pytest.approx(k_s)
        assert found.total == pytest.approx(from_stiffness(result, flow), rel=1e-5)
    assert found.lower <= found.upper <= found.lower * (1.0 + 1e-6)


def test_heat_and_current_of_one_material_take_the_same_way() -> None:
    result = asp.solve(problem(), asp.MeanPressure(0.02))
    heat, current = conductance(result, "thermal"), conductance(result, "electrical")
    np.testing.assert_allclose(heat.density / K, current.density * RHO, rtol=1e-6)
    assert heat.layers == 0.0


def test_order_of_the_bodies_does_not_matter_and_mirrored_contacts_conduct_alike() -> None:
    other = asp.Elastic(2.0, 0.2, conduction=Conduction(3.0))
    coated = asp.Layered([asp.Layer(asp.Elastic(3.0, 0.3, conduction=Conduction(0.7)), 2.0)], BODY)
    first, second = (
        conductance(asp.solve(problem(body=one, counter_body=two), asp.MeanPressure(0.02)), "thermal")
        for one, two in ((coated, other), (other, coated))
    )
    assert first.per_area == pytest.approx(second.per_area, rel=1e-6)
    turned = asp.Surface(ROUGH.heights[::-1].T, 1.0, periodic=True)
    third = conductance(asp.solve(problem(turned, coated, counter_body=other), asp.MeanPressure(0.02)), "thermal")
    assert third.per_area == pytest.approx(first.per_area, rel=1e-4)


def test_yielded_points_conduct() -> None:
    result = asp.solve(problem(law=asp.Hardness(0.15)), asp.MeanPressure(0.02))
    assert result.plastic.any()
    found = conductance(result, "thermal")
    assert np.all(found.density[result.plastic] > 0.0)
    assert "yielded" in why_not(result)
    with refused(InputError, "contact"):
        from_stiffness(result, THERMAL)
    stiffness = 2.0 * K / result.problem.contact_modulus * result.normal_stiffness
    assert found.per_area > 1.05 * stiffness


def test_no_contact_and_full_contact() -> None:
    apart = asp.solve(problem(), asp.Unloaded())
    none = conductance(apart, "thermal")
    assert (none.total, none.resistance, none.error, none.through_gap) == (0.0, math.inf, 0.0, 0.0)
    assert none.with_ballistic_spots(1.0) == 0.0
    pressed = asp.solve(problem(), asp.MeanPressure(100.0))
    full = conductance(pressed, "thermal")
    assert (full.per_area, full.resistance, full.error) == (math.inf, 0.0, 0.0)
    filmed = conductance(pressed, "thermal", ConductingInterface(film_resistance=0.5))
    assert filmed.per_area == pytest.approx(2.0, rel=1e-6)


def test_gas_conducts_beside_the_contact() -> None:
    result = asp.solve(problem(), asp.MeanPressure(0.01))
    clean = conductance(result, "thermal")
    last = clean
    for gas in (1e-3, 1e-1, 1.0):
        found = conductance(result, "thermal", ConductingInterface(gap_conductivity=gas, jump=0.1))
        assert found.lower > last.per_area
        assert found.through_gap > last.through_gap
        last = found
    poor = conductance(result, "thermal", ConductingInterface(gap_conductivity=1e-6, jump=0.1))
    mean = float((1.0 / (result.gap[~result.contact] + 0.1)).sum()) / result.gap.size
    assert poor.per_area - clean.per_area < 1e-6 * mean  # contact draws the heat that gas would carry beside it
    assert poor.per_area - clean.per_area > 0.5e-6 * mean


def test_spots_share_the_flow_and_small_ones_are_ballistic() -> None:
    result = asp.solve(problem(), asp.MeanPressure(0.005))
    found = conductance(result, "electrical")
    shared = found.spots
    assert shared.flow.sum() == pytest.approx(found.total, rel=1e-6)
    assert np.all(np.diff(shared.flow) <= 0.0)
    assert 1 <= shared.needed(0.5) <= shared.needed(0.9) <= shared.flow.size == result.n_spots
    assert found.with_ballistic_spots(0.0) == pytest.approx(found.total, rel=1e-6)
    long = 1e5
    area = result.area_fraction * result.problem.grid.area
    expected = 0.75 * found.k_s * area / long  # by the area of the spots alone
    assert found.with_ballistic_spots(long) == pytest.approx(expected, rel=1e-3)


# From stiffness, and bounds.


def test_secants_of_a_convex_curve_bound_its_slope() -> None:
    x = np.array([1.0, 1.5, 2.0, 4.0])
    found = convex_bounds(x, x**1.5)
    assert np.all(found.lower <= 1.5 * x**0.5)
    assert np.all(found.upper >= 1.5 * x**0.5)
    with refused(InputError, "approach"):
        convex_bounds(x[::-1], x)


def test_forces_of_a_path_bound_the_conductance() -> None:
    loads = [asp.MeanPressure(p) for p in np.linspace(0.005, 0.05, 6)]
    path = asp.solve(problem(), asp.History(loads))
    bounds = conductance_bounds(path, THERMAL)
    for step, low, high in zip(path.steps, *bounds, strict=True):
        assert low <= conductance(step, "thermal").total * (1.0 + 1e-6)
        assert high >= conductance(step, "thermal").total * (1.0 - 1e-6)


def test_smooth_spheres_bound_a_rough_one() -> None:
    assert smooth_bounds(3.0, 2.0, 0.1, 0.0, 1.0) == pytest.approx([6.0 * (0.75 * 0.1 * 2.0) ** (1 / 3)] * 2)
    last = (0.0, math.inf)
    for height in (1.0, 0.1, 0.01, 1e-3, 1e-4):
        low, high = smooth_bounds(3.0, 2.0, 0.1, height, 1.0)
        exact = smooth_bounds(3.0, 2.0, 0.1, 0.0, 1.0)[0]
        assert last[0] <= low <= exact <= high <= last[1]
        last = low, high
    assert last[1] / last[0] < 1.1


# A joint loaded and unloaded.


def test_unloaded_joints_conduct_better_where_points_have_yielded() -> None:
    loads = [asp.MeanPressure(p) for p in (0.01, 0.03, 0.06, 0.03, 0.01)]
    plastic = asp.solve(problem(law=asp.Hardness(0.12)), asp.History(loads))
    elastic = asp.solve(problem(), asp.History(loads))
    set_in, back = ([conductance(step, "thermal").per_area for step in path.steps] for path in (plastic, elastic))
    assert set_in[3] > 1.2 * set_in[1]
    assert set_in[4] > 1.2 * set_in[0]
    np.testing.assert_allclose(back[3:], back[1::-1], rtol=1e-2)


def test_what_cannot_conduct_is_refused() -> None:
    result = asp.solve(problem(body=asp.Elastic(1.0, 0.3, name="plain")), asp.MeanPressure(0.02))
    with refused(InputError, "electrical resistivity of plain"):
        conductance(result)
    with refused(InputError, "flow", "magnetic"):
        conductance(result, "magnetic")  # type: ignore[arg-type]
    line = asp.Surface(ROUGH.heights[:, :1], 1.0)
    pressed = asp.solve(problem(line, boundary=asp.FreeLine()), asp.MeanPressure(0.001))
    with refused(InputError, "boundary of a conducting contact"):
        conductance(pressed, "thermal")


def test_threads_do_not_change_it() -> None:
    result = asp.solve(problem(), asp.MeanPressure(0.02))
    one, two = (conductance(result, "thermal", engine=asp.engines.CpuEngine(n)) for n in (1, 2))
    assert isinstance(one, ContactConductance)
    assert one.per_area == pytest.approx(two.per_area, rel=1e-12)
