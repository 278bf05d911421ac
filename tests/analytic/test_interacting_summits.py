"""Summits that press each other down, and contacts that merge, against their reference rows, limits
and the solved contact."""

from __future__ import annotations

import math
from itertools import islice, pairwise

import numpy as np
import pytest
from contact_cases import TIGHT, elastic
from reference_data import every_row, reference
from refusals import refused

import asperity as asp
from asperity.theories import (
    BushGibsonThomas,
    DiscreteSummits,
    GreenwoodWilliamson,
    InteractingSummits,
    MeanFieldSummits,
    MergingSummits,
    sunk,
)
from asperity.theories.rough.interacting_summits import hertz_displacement

ROUNDING = 1e-9
"""Of the rows: two ways to the same numbers, to 1e-10."""

COLUMNS = {name: np.array([row[name] for row in reference("missing/summits_in_unit_square")]) for name in ("x", "y")}
COLUMNS |= {
    key: np.array([row[name] for row in reference("missing/summits_in_unit_square")])
    for key, name in (("height", "z"), ("radius", "R"))
}
PLACED = {"E_star": 1.0, **COLUMNS, "area": 1.0}


def radii_of(theory: InteractingSummits, separation: float) -> np.ndarray:
    """Contact radii in the order of the table."""
    found = np.zeros(COLUMNS["height"].size)
    found[np.argsort(-COLUMNS["height"], kind="stable")] = theory.contact_radii(separation)
    return found


@every_row(reference("missing/interacting_summits"), label=lambda row: f"{row['case']:g}")
def test_summits_that_press_each_other_down(row):
    theory = InteractingSummits(**PLACED, displacement=row["interaction"])
    found = theory.at_separation(row["d"])
    assert found.area_fraction == pytest.approx(row["area"], rel=ROUNDING)
    assert found.pressure == pytest.approx(row["load_over_Estar"], rel=ROUNDING)
    radii = radii_of(theory, row["d"])
    assert radii[[0, 2]] == pytest.approx([row["a_0"], row["a_2"]], rel=ROUNDING)
    # the table counts all summits above the plane, also those that others have pressed below it
    assert np.count_nonzero(COLUMNS["height"] > row["d"]) == row["n_contacts"]
    assert found.contact_density[0] == np.count_nonzero(radii) <= row["n_contacts"]
    distance = np.hypot(*(np.subtract.outer(COLUMNS[axis], COLUMNS[axis]) for axis in "xy"))
    pairs = np.triu((np.add.outer(radii, radii) > distance) & np.outer(radii > 0.0, radii > 0.0), 1)
    assert np.count_nonzero(pairs) == row["overlapping_pairs"]
    assert (theory.closeness(row["d"])[0] > 1.0) == (row["overlapping_pairs"] > 0)


def test_the_first_two_contacts_that_merge():
    before, after = reference("missing/merging_summits")
    theory = MergingSummits(**PLACED)
    # where they merge is known to 1e-15; the areas change by 6e-11 over this
    step = 1e-13
    above, below = (theory.at_separation(before["d"] + sign * step) for sign in (1.0, -1.0))
    for found, row in ((above, before), (below, after)):
        assert found.area_fraction == pytest.approx(row["area"], rel=ROUNDING)
        assert found.pressure == pytest.approx(row["load_over_Estar"], rel=ROUNDING)
    spots = theory.spots(before["d"] - step)
    assert spots.x.size == COLUMNS["x"].size - 1
    new = int(np.argmin(np.abs(spots.x - after["x_new"])))
    for name, column in (("x", "x"), ("y", "y"), ("height", "z"), ("radius", "R"), ("contact_radius", "a")):
        assert getattr(spots, name)[new] == pytest.approx(after[f"{column}_new"], rel=ROUNDING)
    # until then nothing has merged
    alone = InteractingSummits(**PLACED).at_separation(before["d"] + step)
    assert above.pressure == pytest.approx(alone.pressure, rel=1e-12)


def test_contacts_within_each_other_are_solved():
    """Two equal summits closer than their contact radius leave one direction open; the contact is
    symmetric."""
    pair = {"x": [0.0, 1.0], "y": [0.0, 0.0], "height": [0.0, 0.0], "radius": [100.0, 100.0]}
    theory = InteractingSummits(1.0, **pair, area=1e4)
    one, other = theory.contact_radii(-0.5)
    assert one == pytest.approx(other)
    # a²/R + (a² - r²/2)/R = δ
    assert one == pytest.approx(math.sqrt(0.5 * (0.5 * 100.0 + 0.5)))


def test_the_displacement_is_one_function_inside_and_outside():
    w, radius = np.array([1.0]), np.array([2.0])
    r = np.array([[0.0], [0.5], [1.0], [1.0 + 1e-9], [30.0], [1e4]])
    u = hertz_displacement(w, radius, r)[:, 0]
    assert u[0] == pytest.approx(0.5)  # a²/R, the approach of a contact itself
    assert u[2] == pytest.approx(0.25)
    assert u[3] == pytest.approx(u[2], rel=1e-8)
    force = 4.0 / 3.0 / 2.0  # over E*
    point = force / (math.pi * r[4:, 0])
    assert u[4:] == pytest.approx(point * (1.0 + 0.1 / r[4:, 0] ** 2), rel=1e-6)
    # the series below a fiftieth of the distance meets the closed form
    near, far = (hertz_displacement(w, radius, np.array([[1.0 / share]]))[0, 0] for share in (0.02 + 1e-12, 0.02))
    assert near == pytest.approx(far, rel=1e-10)


def test_summits_alone_are_those_of_greenwood_and_williamson():
    h = np.array([0.0018, 0.0005, -0.0009])
    alone = DiscreteSummits(1.0, COLUMNS["height"], COLUMNS["radius"], 1.0).at_separation(h)
    found = InteractingSummits(**PLACED, displacement="none").at_separation(h)
    for name in ("pressure", "area_fraction", "contact_density", "stiffness"):
        assert getattr(found, name) == pytest.approx(getattr(alone, name), rel=1e-11)


@pytest.mark.parametrize("kind", [InteractingSummits, MergingSummits])
def test_pressures_and_separations_are_inverse(kind):
    theory = kind(**PLACED)
    pressures = np.array([3e-3, 1e-5, 2e-4])
    found = theory.at_pressure(pressures)
    assert found.pressure == pytest.approx(pressures, rel=1e-9)
    again = theory.at_separation(found.separation)
    assert again.pressure == pytest.approx(pressures, rel=1e-9)
    assert again.stiffness == pytest.approx(found.stiffness, rel=1e-9)


def test_merging_keeps_area_and_load_nearly():
    """The others move as the place of the load does: by a thousandth."""
    theory = MergingSummits(**PLACED)
    path = list(islice(theory._path(), 60))
    merges = [one.low for one, after in pairwise(path) if after.spots.x.size < one.spots.x.size]
    assert len(merges) >= 2
    for low in merges:
        above, below = (theory.at_separation(low + sign * 1e-13) for sign in (1.0, -1.0))
        assert below.area_fraction == pytest.approx(above.area_fraction, rel=5e-3)
        assert below.pressure == pytest.approx(above.pressure, rel=5e-3)


def test_a_cell_that_repeats_counts_the_nearest_images():
    """Moving all summits around the cell, across its ends, changes nothing."""
    h = np.array([0.001, 0.0, -0.0008])
    for kind in (InteractingSummits, MergingSummits):
        here = kind(**PLACED, period=(1.0, 1.0)).at_separation(h)
        moved = PLACED | {axis: (COLUMNS[axis] + 0.37) % 1.0 for axis in "xy"}
        there = kind(**moved, period=(1.0, 1.0)).at_separation(h)
        assert there.pressure == pytest.approx(here.pressure, rel=1e-10)
        assert there.area_fraction == pytest.approx(here.area_fraction, rel=1e-10)


def test_load_of_close_summits_is_that_of_the_solver():
    """Four paraboloids at 2.5 contact radii: without interaction the load is two thirds too large;
    with it the summits carry what the solved contact does, but for the rim of the pixels."""
    pixel, n, radius, delta = 8e-9, 160, 1e-6, 8e-9
    places = np.array([[62, 62], [94, 66], [66, 96], [98, 98]])
    heights = np.array([0.0, -1e-9, -2e-9, -5e-10])
    x = pixel * np.arange(n)
    drops = [((x[:, None] - pixel * i) ** 2 + (x[None] - pixel * j) ** 2) / (2.0 * radius) for i, j in places]
    z = np.max([top - drop for top, drop in zip(heights, drops, strict=True)], axis=0)
    problem = asp.ContactProblem(asp.Surface(z, pixel), elastic(1e11), boundary=asp.Free())
    result = asp.solve(problem, asp.Approach(delta), solver=TIGHT)
    at = {"x": pixel * places[:, 0], "y": pixel * places[:, 1], "height": heights, "radius": np.full(4, radius)}

    def load(displacement: str) -> float:
        theory = InteractingSummits(1e11, **at, area=1.0, displacement=displacement)
        return float(theory.at_separation(-delta).pressure[0]) / result.force

    assert load("hertz") == pytest.approx(1.0, abs=0.01)
    assert load("none") > 1.3


PATCH = {"E_star": 1e11, "density": 1e12, "radius": 1e-6, "height_deviation": 1e-8}


def test_a_mean_plane_that_sinks_moves_the_separation_alone():
    gw, p = GreenwoodWilliamson(**PATCH), np.geomspace(1e5, 1e7, 5)
    for where, share in (("mean", 0.946424), ("centre", 1.122200)):
        theory = MeanFieldSummits(**PATCH, side=1e-5, where=where)
        found, alone = theory.at_pressure(p), gw.at_pressure(p)
        assert found.area_fraction == pytest.approx(alone.area_fraction)
        assert found.contact_density == pytest.approx(alone.contact_density)
        assert alone.separation - found.separation == pytest.approx(share * p * 1e-5 / 1e11, rel=1e-6)
        again = theory.at_separation(found.separation)
        assert again.pressure == pytest.approx(p, rel=1e-10)
        assert again.stiffness == pytest.approx(found.stiffness, rel=1e-10)
        fine = theory.at_pressure(p[2] * np.array([1.0 - 1e-4, 1.0 + 1e-4]))
        slope = -np.diff(fine.pressure) / np.diff(fine.separation)
        assert slope == pytest.approx(found.stiffness[2], rel=1e-6)


def test_any_theory_can_sink():
    bgt = BushGibsonThomas(1e11, 1e-16, 1e-2, 2e12).at_pressure([1e6])
    found = sunk(bgt, 1e11, 1e-4, "centre")
    assert bgt.separation - found.separation == pytest.approx(4.0 / math.pi * math.asinh(1.0) * 1e6 * 1e-4 / 1e11)
    assert 1.0 / found.stiffness - 1.0 / bgt.stiffness == pytest.approx(4.0 / math.pi * math.asinh(1.0) * 1e-4 / 1e11)
    with refused(asp.InputError, "place of a patch", "'rim'"):
        sunk(bgt, 1e11, 1e-4, "rim")  # type: ignore[arg-type]


def test_summits_of_a_map():
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.1), hurst=0.8, rolloff_wavelength=5e-7, shortest_wavelength=2e-7
    )
    roughness = asp.roughness_of(asp.generate.gaussian(asp.Grid((64, 64), (2e-8, 2e-8)), spectrum, seed=1))
    pressures = np.array([1e7, 1e8])
    alone, pressed, merged = (
        InteractingSummits.of_roughness(roughness, 1e11, displacement="none").at_pressure(pressures),
        InteractingSummits.of_roughness(roughness, 1e11).at_pressure(pressures),
        MergingSummits.of_roughness(roughness, 1e11).at_pressure(pressures),
    )
    assert pressed.separation[1] < alone.separation[1] - 0.5e-9  # by other contacts
    assert pressed.area_fraction == pytest.approx(alone.area_fraction, rel=0.2)
    assert merged.area_fraction == pytest.approx(pressed.area_fraction, rel=0.1)
    mean = MeanFieldSummits.of_roughness(roughness, 1e11)
    assert mean.side == pytest.approx(64 * 2e-8)


def test_what_is_no_summit_is_refused():
    with refused(asp.InputError, "arrays of summits", "x 14", "height 13"):
        InteractingSummits(**PLACED | {"height": COLUMNS["height"][1:]})
    with refused(asp.InputError, "displacement of interacting-summits", "'far'"):
        InteractingSummits(**PLACED, displacement="far")  # type: ignore[arg-type]
    with refused(asp.InputError, "radius (m) of merging-summits"):
        MergingSummits(**PLACED | {"radius": -COLUMNS["radius"]})
