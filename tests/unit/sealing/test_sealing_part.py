"""Sealing in documents: numbers of Python, files, load paths, words, figures, and what is
refused."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from refusals import refused
from sealing_cases import seal

import asperity as asp
from asperity.core.errors import InputError
from asperity.physics.sealing.fluids import GASES, ViscousLiquid
from asperity.physics.sealing.leak import leakage
from asperity.physics.sealing.part import SCALARS, Sealing
from asperity.run.document import checked, dumps, loads
from asperity.run.execute import Outcome
from asperity.run.stored import load_outcome, save_outcome

SEAL = seal(48, sealing={})


def words_of(outcome: Outcome) -> Any:
    return next(words for part, words in outcome.sections if part.name == "sealing")


def test_numbers_are_those_of_python_and_files_keep_them(tmp_path: Path) -> None:
    document = SEAL | {"sealing": {"fluid": "air", "direction": "y", "allowed_throughput": "1e-3 mbar*l/s"}}
    assert loads(dumps(checked(document))) == checked(document)
    outcome = asp.run(document)
    values = outcome.values
    found = leakage(outcome.result, GASES["air"], 2e5, 1e5, way="y")
    assert found.flow.repeats
    assert values["leak_throughput"] == pytest.approx(found.rate, rel=1e-9)
    assert values["leak_rate"] == pytest.approx(found.rate / 101325.0, rel=1e-9)
    assert values["leak_lower_factor"] <= 1.0 <= values["leak_upper_factor"]
    assert values["transmissivity_lower"] <= values["transmissivity"] <= values["transmissivity_upper"]
    assert values["leak_slip_factor"] > 1.0
    assert values["leak_section_error"] < 1e-8
    assert math.isnan(values["sealing_pressure"])
    size = np.hypot(outcome.found["sealing"].values["leak_flux_x"], outcome.found["sealing"].values["leak_flux_y"])
    assert size.mean() > 0.5
    save_outcome(outcome, tmp_path / "seal.nc")
    again = load_outcome(tmp_path / "seal.nc")
    tree = asp.files.open_tree(tmp_path / "seal.nc")
    for item in SCALARS:
        assert tree[f"sealing/{item.name}"].attrs["units"] == item.unit
    first, second = words_of(outcome), words_of(again)
    assert (first.sentence, first.rows, first.holds) == (second.sentence, second.rows, second.holds)
    assert "mbar·l/s" in first.sentence
    assert [figure.name for figure in again.figures["sealing"]] == ["leak_flow", "fluid_pressure"]
    for figure in again.figures["sealing"]:
        assert figure.picture.startswith(b"\x89PNG")


def test_mean_flow_of_the_fields_is_that_of_the_leak() -> None:
    for driven in ("sides", "gradient"):
        outcome = asp.run(SEAL | {"sealing": {"driven": driven}})
        flux = outcome.found["sealing"].values["leak_flux_x"]
        np.testing.assert_allclose(flux.mean(axis=1), 1.0, rtol=1e-6)
        assert outcome.found["sealing"].values["leak_dissipation"].mean() == pytest.approx(1.0)


def test_a_contact_that_seals_shows_the_path(tmp_path: Path) -> None:
    document = SEAL | {
        "control": {"mean_pressure": "20 GPa"},
        "sealing": {"fluid": "liquid", "viscosity": "10 mPa*s", "allowed_rate": "1 mm^3/s"},
    }
    outcome = asp.run(document)
    values = outcome.found["sealing"].values
    assert values["leak_rate"] == values["transmissivity"] == 0.0
    cells = [(values[f"closed_path_{a}"] / outcome.result.problem.grid.spacing[0]).astype(int) for a in "xy"]
    assert outcome.result.contact[cells[0], cells[1]].all()
    assert set(cells[1]) == set(range(48))
    assert [figure.name for figure in outcome.figures["sealing"]] == ["closed_path"]
    assert outcome.figures["sealing"][0].picture.startswith(b"\x89PNG")
    words = words_of(outcome)
    assert words.holds
    assert not words.alarming
    save_outcome(outcome, tmp_path / "sealed.nc")
    assert words_of(load_outcome(tmp_path / "sealed.nc")).sentence == words.sentence


def test_load_path_finds_where_the_gap_closes() -> None:
    loads_ = [f"{p} MPa" for p in (300, 2000, 20000)]
    document = SEAL | {"control": {"path": {"mean_pressure": loads_}}, "sealing": {"step": "peak"}}
    outcome = asp.run(document)
    values = outcome.found["sealing"].values
    rates, loads = values["path_leak_rate"], values["path_leak_load"]
    assert rates[0] > rates[-1] == 0.0
    last, first = loads[rates > 0.0][-1], loads[rates == 0.0][0]
    assert last < values["sealing_pressure"] < first
    assert {figure.name for figure in outcome.figures["sealing"]} == {"closed_path", "leak_path"}


def test_narrow_throats_are_a_finding() -> None:
    found = asp.run(SEAL | {"control": {"mean_pressure": "3 GPa"}, "sealing": {"step": "last"}})
    values = found.found["sealing"].values
    narrow = [item for item in found.findings if item.criterion == "pixels across the throats"]
    assert values["leak_rate"] > 0.0
    assert values["leak_throat_pixels"] < 8.0
    assert narrow[0].numbers["pixels"] == values["leak_throat_pixels"]
    assert narrow[0].numbers["refinement"] == values["leak_refinement"] > 1.0
    assert len(values["throat_pixels"]) == min(12, values["leak_throats"])


def test_not_tight() -> None:
    outcome = asp.run(SEAL | {"sealing": {"allowed_rate": "1e-9 mm^3/s"}})
    assert words_of(outcome).alarming


def test_water_is_a_liquid_of_its_viscosity() -> None:
    named = asp.run(SEAL | {"sealing": {"fluid": "water"}})
    given = leakage(named.result, ViscousLiquid(1.002e-3), 2e5, 1e5)
    assert named.values["leak_rate"] == pytest.approx(given.rate, rel=1e-12)
    assert Sealing.headline in named.values


@pytest.mark.parametrize(
    ("table", "subject", "shown"),
    [
        ({"inlet": "1 bar", "outlet": "2 bar"}, "sealing.inlet", "100000"),
        ({"fluid": "liquid"}, "sealing.viscosity", "liquid"),
        ({"fluid": "gas", "viscosity": "18 uPa*s"}, "sealing.mean_free_path", "65nm"),
        ({"mean_free_path": "65 nm"}, "sealing.mean_free_path", "water"),
        ({"fluid": "air", "allowed_rate": "1 mm^3/s"}, "sealing.allowed_rate", "air"),
        ({"fluid": "mud"}, "sealing.fluid", "mud"),
    ],
)
def test_wrong_tables(table: dict[str, Any], subject: str, shown: str) -> None:
    with refused(InputError, f"problem document: {subject}", shown):
        checked(SEAL | {"sealing": table})


def test_what_does_not_repeat_has_no_mean_gradient() -> None:
    free = SEAL | {"boundary": {"kind": "free"}, "sealing": {"driven": "gradient"}}
    with refused(InputError, "sealing.driven", "x"):
        asp.run(free)
    sides = asp.run(SEAL | {"boundary": {"kind": "free"}, "sealing": {}})
    assert sides.values["leak_rate"] > 0.0
