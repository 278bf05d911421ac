"""Interfaces of the literature by name: they hold the numbers that their source prints."""

from __future__ import annotations

import numpy as np
import pytest

import asperity as asp
from asperity.cli.main import app
from asperity.run.build import build
from asperity.run.document import PRESETS, load_document, read_table


@pytest.mark.parametrize("name", PRESETS)
def test_presets_hold_the_numbers_of_their_tables(name):
    """Peng 2001, sections 4.1.1 and 4.2, tables 4.1 and 4.2."""
    problem = build(load_document(name)).problem
    sigma = {"head-disk": 1e-9, "disk-and-slider": np.hypot(2.1e-9, 1.5e-9), "mems": 1e-9}[name]
    assert problem.profile().std() == pytest.approx(sigma, rel=0.35)  # of one finite map
    moduli = {"head-disk": (150e9, 200e9), "disk-and-slider": (140e9, 190e9), "mems": (140e9, 170e9)}[name]
    assert (problem.body.layers[0].material.youngs_modulus, problem.body.base.youngs_modulus) == moduli
    assert build(load_document(name)).control.value == pytest.approx(24.5e-3 / 0.47e-6, rel=0.05)
    film = problem.film
    assert (film is None) == (name == "disk-and-slider")
    if film is not None:
        assert (film.surface_tension, film.thickness, film.meniscus_height) == (0.025, 2e-9, 2e-9)
        assert max(film.contact_angles) == pytest.approx(np.radians(10.0))
    assert load_document(name).friction.coefficient == (0.06 if name == "mems" else 0.0)


def test_a_file_of_that_name_goes_before(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert "Peng" in read_table("mems")["title"]
    (tmp_path / "mems").write_text('title = "mine"')
    assert read_table("mems")["title"] == "mine"


def test_presets_are_run_and_changed_from_the_command_line(tmp_path):
    out = tmp_path / "mems.toml"
    small = read_table("mems")
    small["surface"] |= {"points": [32, 32], "size": "2.5 um x 2.5 um"}
    small.pop("film")
    assert asp.run(small).result.control == asp.MeanPressure(50e3)
    with pytest.raises(SystemExit) as ended:
        app(["contact", "--from", "disk-and-slider", "--pressure", "1MPa", "--save-document", str(out)])
    assert ended.value.code == 0
    assert load_document(out).control.mean_pressure == 1e6
