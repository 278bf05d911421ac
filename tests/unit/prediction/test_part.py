"""Predictions beside what is solved: in documents, reports and studies."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from refusals import refused
from study_cases import InProcess, plan

import asperity as asp
from asperity.core.errors import InputError
from asperity.generate import ExponentialAutocorrelation, gaussian
from asperity.run.document import checked
from asperity.studies.collect import dataset
from asperity.studies.run import carry_out

PROBLEM: dict[str, Any] = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [96, 96],
        "size": "8 um",
        "seed": 3,
        "spectrum": {"kind": "exponential", "rms_height": "1 nm", "correlation_length": "0.5 um"},
    },
    "body": "E=200GPa,nu=0.3,Y=4GPa:0.1um/E=100GPa,nu=0.3,Y=2GPa",
    "counter_body": {"rigid": True},
    "control": {"mean_pressure": "20 MPa"},
    "prediction": {},
}
GRID, ROUGH = asp.Grid((96, 96), (8e-6 / 96, 8e-6 / 96)), ExponentialAutocorrelation(1e-9, 0.5e-6)
BODY = asp.Layered(
    [asp.Layer(asp.Elastic(200e9, 0.3, asp.Strength(yield_stress=4e9)), 0.1e-6)],
    base=asp.Elastic(100e9, 0.3, asp.Strength(yield_stress=2e9)),
)


def with_prediction(**settings: Any) -> dict[str, Any]:
    return {**PROBLEM, "prediction": settings}


def test_the_values_are_those_of_predict() -> None:
    outcome = asp.run(checked(PROBLEM))
    expected = asp.predict(gaussian(GRID, ROUGH, seed=3), BODY, asp.MeanPressure(20e6))
    assert np.isfinite(expected.yield_load_base.value)
    for quantity, value in expected.values():
        found = [outcome.values[f"predicted_{quantity.name}{end}"] for end in ("", "_low", "_high")]
        assert found == pytest.approx([value.value, *value.band], rel=1e-9)
    assert outcome.values["full_contact_pressure"] == pytest.approx(expected.waves.full_contact)


def test_of_the_spectrum_all_realisations_are_alike() -> None:
    found = [
        asp.run(checked({**with_prediction(of="spectrum"), "surface": {**PROBLEM["surface"], "seed": seed}})).values
        for seed in (3, 4)
    ]
    expected = asp.predict(ROUGH, BODY, asp.MeanPressure(20e6), grid=GRID)
    for values in found:
        assert values["predicted_area_fraction"] == pytest.approx(expected.area_fraction.value)
        assert values["predicted_peak_pressure"] == pytest.approx(expected.peak_pressure.value)
    assert found[0]["max_pressure"] != found[1]["max_pressure"]


def test_what_is_solved_lies_in_the_bands_and_the_report_says_so(tmp_path: Path) -> None:
    outcome = asp.run(checked(PROBLEM))
    asp.write_report(outcome, tmp_path / "report.html")
    for solved, name in (("area_fraction", "area_fraction_pixels"), ("max_pressure", "peak_pressure")):
        low, high = (outcome.values[f"predicted_{name}_{end}"] for end in ("low", "high"))
        assert low < outcome.values[solved] < high
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "largest pressure of a pixel" in page
    assert "Solved beside predicted" in page


def test_a_hardness_is_that_of_the_contact() -> None:
    table = {**PROBLEM, "body": "E=100GPa,nu=0.3", "law": {"kind": "hardness", "hardness": "1 GPa"}}
    outcome = asp.run(checked(table))
    surface = gaussian(GRID, ROUGH, seed=3)
    expected = asp.predict(surface, asp.Elastic(100e9, 0.3), asp.MeanPressure(20e6), hardness=1e9)
    assert outcome.values["predicted_area_fraction_pixels"] == pytest.approx(expected.area_fraction_pixels.value)


def test_a_study_has_both_side_by_side(tmp_path: Path) -> None:
    loads = {"path": "control.mean_pressure", "values": ["10 MPa", "40 MPa", "2 kPa"]}
    names = ["area_fraction", "predicted_area_fraction_pixels", "predicted_area_fraction_pixels_high"]
    made = plan(
        problem=PROBLEM,
        axes=[loads],
        quantities=names,
        derived={"off": {"expression": "area_fraction / predicted_area_fraction_pixels - 1"}},
    )
    carry_out(made, tmp_path / "r.log", InProcess())
    data = dataset(made, tmp_path / "r.log")
    predicted = data["predicted_area_fraction_pixels"].values
    assert np.isnan(predicted[2])  # too few pixels in contact for the table
    assert data["area_fraction"].values[:2] == pytest.approx(predicted[:2], rel=0.15)
    assert np.all(predicted[:2] < data["predicted_area_fraction_pixels_high"].values[:2])
    assert data["off"].values[:2] == pytest.approx(data["area_fraction"].values[:2] / predicted[:2] - 1.0)


def test_contacts_that_are_not_like_those_of_the_table() -> None:
    sphere = {"kind": "sphere", "points": [32, 32], "size": "8 um", "radius": "10 um"}
    with refused(InputError, "boundary of a contact that is predicted"):
        asp.run(checked({**PROBLEM, "boundary": {"kind": "free"}}))
    with refused(InputError, "contact that is predicted"):
        asp.run(checked({**PROBLEM, "film": {"thickness": "1 nm", "liquid": "water"}}))
    with refused(InputError, "surface of a prediction of its spectrum"):
        asp.run(checked({**with_prediction(of="spectrum"), "surface": sphere}))
