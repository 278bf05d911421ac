"""A line scan on a page, in figures and in a notebook: numbers of both standards, and what is
assumed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import asperity as asp
from asperity.plots import PROFILE_PLOTS
from asperity.report.profile import profile_facts, profile_headline, profile_rows, profile_summary
from asperity.roughness import ProfileCharacterisation, characterise_profile
from asperity.surfaces import Profile


def scan(points: int = 4000) -> Profile:
    x = 0.5e-6 * np.arange(points)
    noise = np.random.default_rng(1).standard_normal(points)
    return Profile(5e-8 * np.sin(2.0 * np.pi * x / 20e-6) + 5e-9 * np.convolve(noise, np.ones(9), "same"), 0.5e-6)


@pytest.fixture(scope="module")
def found() -> ProfileCharacterisation:
    return characterise_profile(scan())


def test_the_class_of_settings_follows_the_measured_Ra(found: ProfileCharacterisation) -> None:
    assert found.parts is not None
    assert found.parts.long == 0.25e-3  # Ra between 0.02 and 0.1 µm
    assert found.sections is not None
    assert found.sections.Ra == pytest.approx(found.main.a, rel=1e-12)
    given = characterise_profile(scan(), long=0.08e-3)
    assert given.parts is not None
    assert given.parts.long == 0.08e-3


def test_short_scans_have_the_primary_profile_alone() -> None:
    found = characterise_profile(scan(100))
    assert (found.letter, found.parts, found.sections) == ("P", None, None)
    assert any("no section" in remark for remark in found.remarks)
    flat = characterise_profile(Profile(np.zeros(50), 1e-6))
    assert flat.converted is None
    assert flat.remarks


def test_rows_and_facts_say_numbers_and_assumption(found: ProfileCharacterisation) -> None:
    groups = dict(profile_rows(found))
    assert len(groups) == 5
    assert all(len(row) == 3 and row[2] for rows in groups.values() for row in rows)
    assert len(profile_headline(found)) == 8
    assert any("isotropic" in text for name, text in profile_facts(found) if name.startswith("assumption"))
    assert "Ra" in profile_summary(found)
    assert "Rq" in repr(found)


@pytest.mark.usefixtures("unrendered")
def test_a_page_and_a_picture(found: ProfileCharacterisation, tmp_path: Path) -> None:
    asp.report.write_profile_report(found, tmp_path / "scan.html")
    assert "ISO 21920-2" in (tmp_path / "scan.html").read_text(encoding="utf-8")


def test_every_figure_draws(found: ProfileCharacterisation) -> None:
    from matplotlib.figure import Figure

    bare = characterise_profile(Profile(np.zeros(50), 1e-6))
    for plot in PROFILE_PLOTS:
        for thing in (found, bare):
            ax = Figure().subplots()
            plot.draw(thing, ax)
            assert ax.get_xlabel()
    assert found.profile.plot(ax=Figure().subplots()).get_ylabel()
    assert found.plot("spectrum", ax=Figure().subplots()).get_ylabel()
