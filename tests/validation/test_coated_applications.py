"""Pages on the applications of Peng (2001): their scripts say on small grids what the pages say,
and claims hold."""

from __future__ import annotations

from functools import cache

import head_disk_unfed
import numpy as np
import peng_head_disk
import peng_load
import peng_menisci
import peng_unfed_menisci
import pytest
import xarray
from peng import grid, surfaces
from ready_studies import PIXEL, axis, ready, results, without
from validation_pages import CLAIMS, assert_claims_hold, assert_written_by_script, written_rows

RUNS = {
    "peng_head_disk": lambda: peng_head_disk.compare(seeds=1, points=64, count=7, unfed=16),
    "peng_load": lambda: peng_load.compare(
        seeds=2, points=256, loads=("10 kPa", "1 MPa", "10 MPa", "100 MPa"), dry_seeds=16
    ),
    "peng_menisci": lambda: peng_menisci.compare(seeds=2, points=128, count=4),
    "peng_unfed_menisci": lambda: peng_unfed_menisci.compare(seeds=2, points=128, count=7),
}


@cache
def page_of(name):
    return RUNS[name]()


@pytest.mark.slow
@pytest.mark.parametrize("name", RUNS)
def test_every_claim_holds_and_is_that_of_the_page(name):
    assert_claims_hold(page_of(name))
    assert_written_by_script(page_of(name), name)


@pytest.mark.parametrize("name", RUNS)
def test_every_written_claim_holds(name):
    claims = written_rows(name, CLAIMS)[1:]
    assert len(claims) >= 10
    assert {row[-1] for row in claims} == {"yes"}


def test_published_rows_of_the_load_page():
    rows = [row for row in written_rows("peng_load") if len(row) == 6 and "±" in row[4]]
    found = {(row[0], row[1], row[3], row[5]) for row in rows if "±" in row[2] and "±" not in row[3]}
    published = {(f"{r:g}", f"{p:.0e}", f"{a:.4f}", f"{m:.4f}") for r, p, a, m in peng_load._published()}
    assert found == published
    assert len(published) == 12


def test_floor_of_the_dry_disk_on_a_small_grid_is_that_of_the_page():
    """About 5 nm, within a factor of three; the page has the largest displacement without liquid in
    its third table."""
    table = without(ready("head_disk_interface", points=48, seeds=1), "film")
    axis(table, "modulus")["values"] = ["150 GPa", "350 GPa"]
    found = peng_head_disk.Curves(results(table), peng_head_disk.DISK)
    rows = [row for row in written_rows("peng_head_disk") if row[0] == "largest u_z" and len(row) == 8]
    for ratio, row in ((0.75, rows[9]), (1.75, rows[10])):
        assert row[1] == f"{ratio:.2f}"
        floor = 1e9 * found.critical("max_displacement", ratio).floor
        assert 1.0 / 3.0 < floor / float(row[4]) < 3.0
        assert 1.5 < floor < 15.0


def test_contacts_without_feedback_are_the_dry_ones_of_the_ready_study():
    """Same bodies, hardness, surface and load, posed by the document and in Python; the menisci are
    those of the steady film's first pass."""
    table = without(ready("head_disk_interface", points=32, seeds=1), "film")
    table["critical_thickness"]["count"] = 2
    axis(table, "modulus")["values"] = ["20 GPa"]
    study = results(table)
    here = head_disk_unfed.solved(2, 32, 2, (0.1,)).isel(surface=1)
    for name in ("area_fraction", "max_displacement", "max_pressure"):
        theirs = study[name].isel(surface=0).transpose("modulus", "thickness")
        np.testing.assert_allclose(here[name].to_numpy(), np.asarray(theirs, dtype=float), rtol=1e-5)
    assert float(here["relative_meniscus_force"].min()) > 1.0


def test_critical_thicknesses_scatter_as_much_as_surfaces_differ():
    """Values that rise with log h up to 10 µm: 95 % are reached at 10^3.8 nm on all surfaces, or at
    ten times less on half of them."""
    depth = head_disk_unfed.thicknesses(26)
    rise = np.concatenate([[0.0], np.clip(np.log10(depth[1:-1] / 1e-9) / 4.0, 0.0, 1.0), [1.0]])
    early = np.concatenate([[0.0], np.clip(np.log10(depth[1:-1] / 1e-9) / 3.0, 0.0, 1.0), [1.0]])
    dims, coordinates = ("modulus", "thickness", "surface"), {"modulus": [150e9, 350e9], "thickness": depth}
    found = []
    for half in (rise, early):
        values = np.broadcast_to(np.stack([rise, half] * 4, axis=1), (2, depth.size, 8))
        data = xarray.Dataset({"max_pressure": (dims, values)}, coordinates)
        curves = peng_head_disk.Curves(data, peng_head_disk.DISK)
        found.append(curves.scattered(("max_pressure",), "ceiling", draws=20))
    assert found[0] == (pytest.approx(10.0**3.8, rel=0.01), pytest.approx(0.0, abs=1e-6))
    assert found[1][1] > 1.0
    each = curves.each("max_pressure", "ceiling")
    assert each == pytest.approx(np.array([[10.0**3.8] * 2, [10.0 ** (0.95 * 3.0)] * 2] * 4), rel=0.01)


def test_menisci_under_the_load_alone_are_those_of_the_figure():
    """(Fm/W)/X of about 2000 on the base at X = 2e-3 and σ = 1 nm; the steady force is several
    times as large."""
    shape = surfaces(1, grid(128, 128 * PIXEL))[0]
    found = peng_menisci.forces(shape, 1.0, 2e-3, rms=1e-9)
    assert found.alone / 2e-3 == pytest.approx(peng_menisci.ORDINATE, rel=0.4)
    assert found.steady > 3.0 * found.alone


def test_scaled_contacts_have_the_same_menisci():
    table, claims = peng_menisci._exact(64)
    assert [int(row[1]) for row in table.rows] == [0, 0, 0]
    assert all(np.isfinite(claim.found) and claim.holds for claim in claims)
