"""The exact meniscus of a sphere, and menisci that grow, against reference values."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference_data import reference
from refusals import refused
from scipy.integrate import quad

import asperity as asp
from asperity.theories.wet.meniscus import MeniscusGrowth

SHAPES = reference("missing/exact_meniscus")
GROWN = reference("missing/meniscus_vapour_growth")
COLUMNS = {
    "height": ("meniscus_height_over_R", 1e-9),
    "force": ("force_over_gamma_R", 1e-9),
    "volume": ("volume_over_R3", 1e-9),
    "plane_radius": ("plane_radius_over_R", 1e-9),
    "arc_force": ("force_arc_neck", 1e-9),
    "simple_force": ("force_simple", 1e-9),
}


def ring(row) -> asp.theories.ExactMeniscus:
    angles = (math.radians(row["theta_sphere_deg"]), math.radians(row["theta_plane_deg"]))
    return asp.theories.ExactMeniscus(1.0, 1.0, *angles, gap=row["gap_over_R"])


@pytest.mark.parametrize("row", SHAPES, ids=lambda row: f"{row['case']:.0f}")
def test_shapes_of_reference(row):
    """By shooting and by quadrature to 6e-10."""
    found = ring(row).at_filling_angle(row["filling_angle_rad"])
    for name, (column, error) in COLUMNS.items():
        assert float(getattr(found, name)) == pytest.approx(row[column], rel=error), name
    assert -float(found.deficit) == pytest.approx(row["laplace_pressure_R_over_gamma"], rel=1e-9)
    # the neck of the table is the least radius at the steps of its integration, which is not less
    assert 0.0 <= row["neck_radius_over_R"] / float(found.neck_radius) - 1.0 + 1e-9 < 1e-4


@pytest.mark.parametrize("row", SHAPES[::6], ids=lambda row: f"{row['case']:.0f}")
def test_the_force_is_the_same_at_the_flat_and_at_the_neck(row):
    """2 π r sin ψ less the suction on the circle."""
    found = ring(row).at_filling_angle(row["filling_angle_rad"])
    flat, neck = float(found.plane_radius), float(found.neck_radius)
    sine = math.sin(math.radians(row["theta_plane_deg"]))
    whole = math.pi * (2.0 * flat * sine + float(found.deficit) * flat**2)
    assert whole == pytest.approx(float(found.force), rel=1e-8)
    inside = row["filling_angle_rad"] + math.radians(row["theta_sphere_deg"]) < 0.5 * math.pi
    if inside:
        assert math.pi * (2.0 * neck + float(found.deficit) * neck**2) == pytest.approx(float(found.force), rel=1e-8)


@pytest.mark.parametrize(("angle", "factor"), [(0.0, 0.28), (math.pi / 3.0, 0.40)])
def test_the_simple_force_errs_with_the_root_of_the_height(angle, factor):
    """As 0.28 and 0.4 times the root of height over radius, not as height over radius."""
    found = asp.theories.ExactMeniscus(1.0, 1.0, angle).at_filling_angle([0.01, 0.02, 0.04])
    errors = 1.0 - found.force / found.simple_force
    np.testing.assert_allclose(errors / np.sqrt(found.height), factor, rtol=0.03)


def test_menisci_that_are_not_concave_are_refused():
    with refused(asp.errors.InputError, "filling angle (rad)"):
        asp.theories.ExactMeniscus(1e-6, 0.07, 1.5).at_filling_angle(1.7)


@pytest.mark.parametrize("row", GROWN, ids=lambda row: f"{row['case']:.0f}")
def test_menisci_from_vapour_of_reference(row):
    """Times by quadrature and by the differential equation, to 1e-6; and heights at those times."""
    other = math.acos(row["cos_sum"] - 1.0)
    water = {"surface_tension": 0.07275, "molar_volume": 1.8048e-5, "humidity": row["RH"]}
    found = asp.theories.VapourGrowth(
        row["R_m"], **water, start=row["s_start_m"], other_angle=other, diffusivity=row["D_m2_per_s"]
    )
    assert found.equilibrium_height == pytest.approx(row["s_eq_m"], rel=1e-9)
    assert found.time_to(row["s_m"]) == pytest.approx(row["time_s"], rel=1e-6)
    assert float(found.at_time(row["time_s"]).height) == pytest.approx(row["s_m"], rel=1e-6)


def sphere_time(feed: asp.menisci.FilmFeed | asp.menisci.FloodedFeed, radius: float, s: tuple[float, float]) -> float:
    """∫ 2 π R s ds/Q."""
    return float(quad(lambda height: 2.0 * math.pi * radius * height / feed.flow(height), *s, epsrel=1e-11)[0])


def test_the_feed_of_a_film_is_that_of_the_growth_of_one_meniscus():
    film = MeniscusGrowth(1e-6, 0.025, 2e-9, 0.1, 1e-19, 0.3)
    feed = asp.menisci.FilmFeed(0.025, 2e-9, 0.1, film.disjoining_pressure, 1.0 + math.cos(0.3))
    assert feed.equilibrium_height == pytest.approx(film.equilibrium_height, rel=1e-12)
    share = (0.5, 0.9)
    heights = (share[0] * film.equilibrium_height, share[1] * film.equilibrium_height)
    later = film.time_to(share[1]) - film.time_to(share[0])
    assert sphere_time(feed, 1e-6, heights) == pytest.approx(later, rel=1e-9)


def test_a_flooded_gap_feeds_by_the_resistance_of_its_wedge():
    """∫ 12 μ dr/(2 π r g³) from the meniscus outwards."""
    feed, height = asp.menisci.FloodedFeed(0.025, 0.1), 1e-8
    outwards = quad(lambda x: 12.0 * 0.1 * x**2, 0.0, 1.0)[0]  # dr/r = dg/2g, with x = height/g
    resistance = outwards / (4.0 * math.pi * height**3)
    assert feed.flow(height) == pytest.approx(0.05 / height / resistance, rel=1e-6)
    assert feed.equilibrium_height == math.inf
