"""Films of liquid in studies: humidity and thickness as axes, menisci as quantities, runaways as
records."""

from __future__ import annotations

import importlib

import numpy as np
import pytest
from contact_cases import wetted
from refusals import refused
from study_cases import InProcess, plan

import asperity as asp
from asperity.contact.operators import prepare_operator
from asperity.run.build import build
from asperity.run.document import checked
from asperity.studies.collect import dataset, state
from asperity.studies.places import replaced
from asperity.studies.run import carry_out

SPECTRUM = {
    "kind": "self_affine",
    "rms_height": "2 nm",
    "hurst": 0.8,
    "rolloff_wavelength": "1 um",
    "shortest_wavelength": "100 nm",
}
WET = {
    "version": 1,
    "surface": {"kind": "rough", "points": [48, 48], "size": "1.92 um", "seed": 5, "spectrum": SPECTRUM},
    "body": {"youngs_modulus": "90 GPa", "poisson_ratio": 0.3},
    "control": {"mean_pressure": "2 MPa"},
    "film": {"liquid": "water", "humidity": "80 %", "contact_angle": ["60 deg", "60 deg"], "friction": 0.3},
}


def test_humidity_is_an_axis_and_menisci_are_quantities(tmp_path):
    humidities = ["50 %", "70 %", "80 %"]
    made = plan(
        problem=WET,
        axes=[{"path": "film.humidity", "values": humidities}],
        quantities=["meniscus_force", "static_friction", "n_menisci", "statistical_meniscus_force"],
    )
    carry_out(made, tmp_path / "r.log", InProcess())
    data = dataset(made, tmp_path / "r.log")
    assert (np.diff(data["meniscus_force"]) > 0.0).all()
    assert data["meniscus_force"].attrs["units"] == "N"
    for number, humidity in enumerate(humidities):
        case = build(checked(replaced(WET, ("film", "humidity"), humidity)))
        film = case.asks["film"]
        alone = wetted(case.problem, case.control, film.film, friction=film.friction, solver=case.solver)
        assert float(data["meniscus_force"][number]) == alone.menisci.meniscus_force
        theory = asp.menisci.wet_theory(alone).meniscus_force
        assert float(data["statistical_meniscus_force"][number]) == pytest.approx(theory, rel=1e-12)
        assert float(data["static_friction"][number]) == pytest.approx(alone.menisci.static_friction, rel=1e-12)


def test_a_wet_load_curve_shares_one_operator_and_agrees_with_its_cases(tmp_path, monkeypatch):
    """Loads start from those before: forces agree within the pixels that the error of a solve may
    flip."""
    prepared = []

    def counted(*arguments, **options):
        prepared.append(prepare_operator(*arguments, **options))
        return prepared[-1]

    monkeypatch.setattr(importlib.import_module("asperity.run.execute"), "prepare_operator", counted)
    monkeypatch.setattr(importlib.import_module("asperity.contact.solve"), "prepare_operator", counted)
    loads = ["1 MPa", "2 MPa", "4 MPa", "8 MPa"]
    made = plan(problem=WET, axes=[{"path": "control.mean_pressure", "values": loads}], quantities=["meniscus_force"])
    carry_out(made, tmp_path / "r.log", InProcess())
    assert len(prepared) == 1
    data = dataset(made, tmp_path / "r.log")
    for number, load in enumerate(loads):
        case = build(checked(replaced(WET, ("control", "mean_pressure"), load)))
        alone = wetted(case.problem, case.control, case.asks["film"].film, solver=case.solver, operator=prepared[0])
        pixels = 2.0 * alone.menisci.suction * case.problem.grid.pixel_area
        slack = 1e-4 * alone.external_force + pixels
        assert float(data["meniscus_force"][number]) == pytest.approx(alone.menisci.meniscus_force, abs=slack, rel=0.0)
    assert len(prepared) == 1


def test_a_force_that_runs_away_is_a_record_with_its_reason(tmp_path):
    soft = {**WET, "body": {"youngs_modulus": "1 GPa", "poisson_ratio": 0.3}, "control": {"mean_pressure": "10 kPa"}}
    soft["film"] = {"liquid": "PFPE", "thickness": "1 nm"}
    thin = {"path": "film.thickness", "values": ["0.001 nm", "2 nm"]}
    made = plan(problem=soft, axes=[thin], quantities=["meniscus_force"])
    carry_out(made, tmp_path / "r.log", InProcess())
    data = dataset(made, tmp_path / "r.log")
    assert np.isfinite(data["meniscus_force"][0])
    assert np.isnan(data["meniscus_force"][1])
    (failed,) = state(made, tmp_path / "r.log").causes
    assert "runs away" in failed.first.message


def test_menisci_need_a_film():
    dry = {key: value for key, value in WET.items() if key != "film"}
    with refused(asp.InputError, "quantity meniscus_force", "[film]"):
        plan(problem=dry, axes=[{"path": "control.mean_pressure", "values": ["1 MPa"]}], quantities=["meniscus_force"])
