"""Where liquid stands in given gaps: the reference maps pixel by pixel, and areas known in closed
form."""

from __future__ import annotations

import math
from collections import defaultdict

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference_data import every_row, reference
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.physics.menisci.coupling import viscous_force
from asperity.physics.menisci.film import LiquidFilm, wetting
from asperity.theories.wet.meniscus import film_force

MODES = defaultdict(list)
for _row in reference("meniscus_map_modes"):
    MODES[_row["map"]].append(_row)

CASES = defaultdict(list)
for _row in reference("meniscus_map_results"):
    CASES[_row["map"], _row["periodic"]].append(_row)


def heights(number, size):
    """Argument of a reference map: a sum of cosines in m."""
    i, j = np.indices((size, size))
    whole = np.zeros((size, size))
    for mode in MODES[number]:
        phase = 2.0 * np.pi * (mode["m"] * i + mode["n"] * j) / size + mode["phase_rad"]
        whole += mode["amplitude_m"] * np.cos(phase)
    return whole


def film_of(row):
    angles = math.radians(row["theta1_deg"]), math.radians(row["theta2_deg"])
    return LiquidFilm(
        surface_tension=row["gamma_N_per_m"],
        thickness=row["h_f_m"],
        meniscus_height=row["h_m_m"],
        contact_angles=angles,
    )


@pytest.mark.parametrize(("number", "periodic"), CASES, ids=lambda value: str(value))
def test_reference_maps(number, periodic):
    """Every count of every row is exact: no gap of the maps lies near a threshold."""
    shape = heights(number, int(CASES[number, periodic][0]["N"]))
    for row in CASES[number, periodic]:
        argument = shape + row["offset_m"]
        contact, gap = argument <= 0.0, np.maximum(0.0, argument)
        wraps = (row["periodic"] == "True",) * 2
        film = film_of(row)
        found = wetting(gap, contact, film, wraps=wraps, diagonal=row["connectivity"] == 8.0)
        assert np.count_nonzero(contact) == row["n_contact"]
        assert np.count_nonzero(found.wetted) == row["n_wetted"]
        assert np.count_nonzero(found.cut) == row["n_cut"]
        assert found.n_islands == row["n_islands"]
        assert found.n_menisci == row["n_islands_selected"]
        assert np.count_nonzero(found.kept) == row["n_selected"]
        assert np.count_nonzero(found.kept & contact) == row["n_contact_in_selected"]
        assert np.count_nonzero(found.menisci) == row["n_meniscus"]
        force = film.suction * np.count_nonzero(found.menisci) * row["pixel_m"] ** 2
        assert force == pytest.approx(row["Fm_N"], rel=1e-13, abs=1e-30)


@every_row(reference("meniscus_two_paraboloids"))
def test_two_paraboloids(row):
    """Areas of a fine map against closed forms: pixel counting errs by less than a pixel along the
    rim."""
    reach = math.sqrt(2.0 * max(row["R1_m"], row["R2_m"]) * row["h_m_m"]) * 1.6
    pixels = 700
    x = (np.arange(pixels) + 0.5) / pixels * 2.0 * reach - reach
    squares = np.add.outer(x**2, x**2)
    argument = np.concatenate([squares / (2.0 * row[f"R{side}_m"]) + row[f"g{side}_m"] for side in (1, 2)], axis=0)
    contact, gap = argument <= 0.0, np.maximum(0.0, argument)
    film = LiquidFilm(
        surface_tension=row["gamma_N_per_m"],
        thickness=row["h_f_m"],
        meniscus_height=row["h_m_m"],
        contact_angles=(math.radians(row["theta_deg"]),) * 2,
    )
    found = wetting(gap, contact, film, wraps=(False, False))
    pixel = (x[1] - x[0]) ** 2
    area = np.count_nonzero(found.menisci) * pixel
    assert area == pytest.approx(row["A_m_m2"], rel=2e-3)
    assert film.suction * area == pytest.approx(row["Fm_N"], rel=2e-3)
    kept = sum(row[f"island{side}_area_m2"] > 0.0 for side in (1, 2))
    assert found.n_menisci == kept


def test_a_touching_sphere_has_the_force_of_its_closed_form():
    """Pixels see 2πRγ(1 + cos θ), whatever the height of the meniscus; at 40 pixels per radius
    within 1 %."""
    radius, tension, angle = 5e-6, 0.07, 0.5
    for height in (1e-9, 4e-9):
        reach = 1.2 * math.sqrt(2.0 * radius * height)
        x = np.linspace(-reach, reach, 96)
        gap = np.add.outer(x**2, x**2) / (2.0 * radius)
        film = LiquidFilm(
            surface_tension=tension, thickness=0.1e-9, meniscus_height=height, contact_angles=(angle, 0.0)
        )
        found = wetting(gap, gap <= 0.0, film, wraps=(False, False))
        force = film.suction * np.count_nonzero(found.menisci) * (x[1] - x[0]) ** 2
        assert force == pytest.approx(film_force(radius, tension, angle), rel=0.01)


@settings(max_examples=30)
@given(st.integers(0, 10**6), st.integers(0, 30), st.integers(0, 30), st.floats(0.1, 2.0), st.floats(1.0, 3.0))
def test_menisci_do_not_care_where_the_map_starts(seed, i, j, thickness, higher):
    rng = np.random.default_rng(seed)
    argument = rng.standard_normal((16, 24)) + 1.0
    contact, gap = argument <= 0.0, np.maximum(0.0, argument)
    film = LiquidFilm(surface_tension=1.0, thickness=thickness, meniscus_height=higher * thickness)
    found = wetting(gap, contact, film, wraps=(True, True))
    shifted = (np.roll(field, (i, j), (0, 1)) for field in (gap, contact))
    moved = wetting(*shifted, film, wraps=(True, True))
    np.testing.assert_array_equal(np.roll(found.menisci, (i, j), (0, 1)), moved.menisci)
    assert (found.n_islands, found.n_menisci, found.regime) == (moved.n_islands, moved.n_menisci, moved.regime)
    # every wetted pixel is in a meniscus or contact, and no meniscus is higher than it may be
    assert (found.kept >= found.wetted).all()
    assert (found.cut >= found.kept).all()
    assert not (found.menisci & contact).any()


@pytest.mark.parametrize(
    ("thickness", "regime"), [(0.05, "dry"), (0.4, "toe-dipping"), (0.65, "pillbox"), (2.0, "flooded")]
)
def test_regimes(thickness, regime):
    """A ridged egg box: rings around summits, then bands along the ridges, then everything."""
    x = 2.0 * np.pi * (np.arange(48) + 0.5) / 24
    gap = 1.0 - 0.7 * np.cos(x)[:, None] - 0.25 * np.cos(x)[None, :]
    film = LiquidFilm(surface_tension=1.0, thickness=thickness)
    found = wetting(np.maximum(gap, 0.0), gap <= 0.06, film, wraps=(True, True))
    assert found.regime == regime


def test_viscous_shear_of_a_plane_film():
    gap = np.full((4, 4), 2e-9)
    film = LiquidFilm(surface_tension=0.03, thickness=3e-9, viscosity=0.1)
    found = wetting(gap, np.zeros((4, 4), bool), film, wraps=(True, True))
    grid = asp.Grid((4, 4), (1e-8, 2e-8))
    plane = 0.1 * 1e-3 / 2e-9 * 16 * 2e-16
    assert viscous_force(gap, grid, found, film, 1e-3) == pytest.approx(plane, rel=1e-12)
    weak = LiquidFilm(surface_tension=0.03, thickness=3e-9, viscosity=0.1, shear_strength=1e3)
    assert viscous_force(gap, grid, found, weak, 1e-3) == pytest.approx(1e3 * 16 * 2e-16, rel=1e-12)
    unknown = LiquidFilm(surface_tension=0.03, thickness=3e-9)
    assert viscous_force(gap, grid, found, unknown, 0.0) == 0.0
    with refused(InputError, "viscosity of the liquid"):
        viscous_force(gap, grid, found, unknown, 1e-3)


def test_films_from_humidity():
    water, angle = asp.liquid("water"), math.radians(60.0)
    film = LiquidFilm.at_humidity(water, 0.8, contact_angles=(angle, angle))
    # kelvin_film.csv has 2.414 nm at 80 % for 72.75 mN/m
    assert film.meniscus_height == pytest.approx(2.414e-9 * 72.74 / 72.75, rel=1e-3)
    assert film.thickness == pytest.approx(0.249e-9, rel=1e-3)
    dry = LiquidFilm.at_humidity(water, 0.05, thickness=1e-9, contact_angles=(angle, angle))
    assert dry.meniscus_height == dry.thickness, "a meniscus is at least as high as the film"
    with refused(InputError, "molar volume of Z-Dol"):
        LiquidFilm.at_humidity(asp.liquid("Z-Dol"), 0.5)
    with refused(InputError, "thickness of the film"):
        LiquidFilm.at_humidity(asp.liquid("ethanol"), 0.5)


@pytest.mark.parametrize(
    ("options", "subject"),
    [
        ({"thickness": 0.0}, "thickness of a film (m)"),
        ({"thickness": 2e-9, "meniscus_height": 1e-9}, "meniscus height (m)"),
        ({"thickness": 1e-9, "contact_angles": (2.0, 2.0)}, "contact angles"),
        ({"thickness": 1e-9, "surface_tension": -1.0}, "surface tension of a film (N/m)"),
        ({"thickness": 1e-9, "viscosity": -1.0}, "viscosity (Pa s) of a film"),
    ],
)
def test_films_out_of_range_are_refused(options, subject):
    with refused(InputError, subject):
        LiquidFilm(**{"surface_tension": 0.03, **options})
