"""Pages on surfaces: what they claim holds on fewer realisations, and they belong to their
scripts."""

from __future__ import annotations

import functools
import re

import crossed_waves
import figure_10
import gallery
import gold_film
import interacting_crests
import numpy as np
import pytest
import scan_instruments
import scan_size
import standard_surface
from validation_pages import assert_claims_hold, assert_written_by_script, written_page


@functools.cache
def standard_page():
    return standard_surface.page(realisations=8)


RUNS = {
    "gold_film": lambda: gold_film.page(realisations=6),
    "standard_surface": standard_page,
    "figure_10": lambda: figure_10.page(realisations=1, loads=(0.008, 0.03, 0.1)),
    "interacting_crests": interacting_crests.page,
    "crossed_waves": lambda: crossed_waves.page(points=128),
    "scan_size": lambda: scan_size.page(count=8, sides=(4e-6, 64e-6)),
    "scan_instruments": lambda: scan_instruments.compare(count=8),
}


SLOW = ("figure_10", "gold_film")


@pytest.mark.slow
@pytest.mark.parametrize("name", [pytest.param(name, marks=[pytest.mark.slow] * (name in SLOW)) for name in RUNS])
def test_what_is_claimed_holds(name):
    page = RUNS[name]()
    assert_claims_hold(page)
    assert_written_by_script(page, name)


def test_waves_of_one_length_have_the_least_nayak_parameter():
    """Between the 3/2 of endlessly many waves of one length and that of a ring 2 % wide and of
    finitely many, a few per cent."""
    assert 1.49 < standard_surface.least_alpha(256) < 1.56


def test_the_written_figure_10_is_the_scripts():
    written = written_page("figure_10")
    for text in (figure_10.ABOUT, *figure_10.READING):
        assert text.format(all=12, close=1) in written
    for load in figure_10.LOADS:
        assert f"p = {load:g} E* h'" in written
    rows = [
        line for line in written.splitlines() if line.startswith(tuple(f"| {name} " for name in figure_10.THEORIES))
    ]
    assert [row.split("|")[2].strip() for row in rows] == 2 * [figure_10.REPORTED[name] for name in figure_10.THEORIES]


def test_moments_of_the_printed_spectrum_are_the_reference(reference):
    rows = {row["estimate"]: row for row in reference("au_psd_moments")}
    names = (None, "spectral_k_below_pi_over_delta", "spectral_all_modes", "finite_difference_all_modes")
    for found, name in zip(gold_film.printed(), names, strict=True):
        if name is None or "k_below" in name:
            continue  # integrals, not sums over the modes of the grid
        row = rows[f"grid_512_{name}"]
        assert found.alpha == pytest.approx(row["nayak_alpha"], rel=1e-9)
        assert found.m0 == pytest.approx((1e-9 * row["sigma_nm"]) ** 2, rel=1e-9)


@pytest.mark.parametrize("method", ["complementarity", "least squares"])
def test_the_published_system_of_crests_gives_the_published_rows(reference, method):
    rows, area = reference("gw_interaction_asperities"), 4e-12
    for row in reference("gw_interaction_results"):
        own = [crest for crest in rows if crest["set"] == row["set"]]
        columns = (np.array([crest[name] for crest in own]) for name in ("x_m", "y_m", "z_m", "h_m", "lambda_m"))
        theory = interacting_crests.PublishedCrests(1e11, *columns, area, method=method)
        found = theory.at_separation(theory.highest - row["delta_m"])
        assert found.contact_density * area == pytest.approx(row["n_printed"])
        assert found.area_fraction * area == pytest.approx(row["area_printed_m2"], rel=1e-12)
        assert found.pressure * area == pytest.approx(row["load_printed_N"], rel=1e-12)


@pytest.mark.slow
def test_the_gallery_of_measured_surfaces(shared_data, tmp_path):
    made = gallery.write_gallery(shared_data, tmp_path / "gallery")
    assert len(made) == 6
    index = (tmp_path / "gallery" / "index.html").read_text(encoding="utf-8")
    for entry in made:
        assert entry.fault == ""
        assert (tmp_path / "gallery" / f"{entry.name}.html").stat().st_size > 100_000
        assert f'href="{entry.name}.html"' in index
        assert entry.found.heights.Sq > 0.0
        assert entry.found.summits.eight.count > 0
    assert index.count("<img ") == 6 * len(gallery.SHOWN)
    assert not re.search(r'src="(?!data:)', index)


def test_a_file_that_cannot_be_read_is_told_in_the_gallery(tmp_path):
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "broken.opd").write_bytes(b"nothing")
    (tmp_path / "data" / "README.md").write_text("notes")
    (entry,) = gallery.write_gallery(tmp_path / "data", tmp_path / "gallery")
    assert entry.found is None
    assert "cannot be read" in (tmp_path / "gallery" / "index.html").read_text(encoding="utf-8")


def test_a_spectrum_of_another_amplitude_disagrees():
    spoiled = [claim for claim in standard_page().claims if claim.text.startswith("rms height")]
    assert not type(spoiled[0])(spoiled[0].text, 1.2 * spoiled[0].found, spoiled[0].low, spoiled[0].high).holds
