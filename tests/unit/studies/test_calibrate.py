"""Calibrations: parameters of published curves come back, with the deviations and correlations of
their exact derivatives; what a curve does not tell is said."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference_data import Row, reference
from refusals import refused
from study_cases import PROBLEM

import asperity as asp
from asperity.core.errors import FileFormatError, InputError, UnitError

CURVES: dict[float, list[Row]] = {}
for each in reference("calibration_curves"):
    CURVES.setdefault(each["E1"], []).append(each)


def film(rows: list[Row], folder: Path, *, points: int = 24, names: tuple[str, ...] = ("E1", "h"), **more: Any):
    """Calibration of the curve of approach of ``rows``, lengths in mm and moduli in GPa."""
    first, widest = rows[0], max(row["delta"] * row["R"] for row in rows) ** 0.5
    lines = [f"{1e3 * row['P']},{row['delta']}" for row in rows]
    (folder / "curve.csv").write_text("\n".join(["force (N),approach (mm)", *lines]) + "\n", encoding="utf-8")
    layer = {"thickness": f"{first['h']} mm", "youngs_modulus": f"{first['E1']} GPa", "poisson_ratio": first["nu1"]}
    modulus = first["E1"]
    parameters = {
        "E1": {"path": "body.layers.0.youngs_modulus", "low": f"{modulus / 3} GPa", "high": f"{modulus * 3} GPa"},
        "h": {"path": "body.layers.0.thickness", "low": f"{first['h'] / 3} mm", "high": f"{first['h'] * 3} mm"},
    }
    start = {"E1": f"{0.8 * first['E1']} GPa", "h": f"{1.2 * first['h']} mm"}
    problem = {
        "version": 2,
        "surface": {"kind": "sphere", "points": [points] * 2, "size": f"{2.3 * widest} mm", "radius": "1 mm"},
        "body": {"layers": [layer], "base": {"youngs_modulus": "1 GPa", "poisson_ratio": first["nu2"]}},
        "boundary": {"kind": "free"},
        "control": {"force": "1 N"},
        "solver": {"tolerance": 1e-8},
    }
    fitted = [{"name": name, "start": start[name], **parameters[name], **more.get(name, {})} for name in names]
    return {"version": 1, "problem": problem, "calibration": {"curve": str(folder / "curve.csv"), "parameters": fitted}}


def exact(rows: list[Row], names: tuple[str, ...], noise: float = 0.01) -> tuple[np.ndarray, np.ndarray]:
    """Relative deviations and correlation by the derivatives of the reference."""
    slopes = np.array([[row[f"ddelta_d{name}"] * row[name] / row["delta"] / noise for name in names] for row in rows])
    covariance = np.linalg.inv(slopes.T @ slopes)
    deviations = np.sqrt(np.diag(covariance))
    return deviations, covariance / np.outer(deviations, deviations)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["E1", "h"])
def test_one_parameter_comes_back_with_its_deviation(tmp_path: Path, name: str):
    """A compliant film: within 1 % on 24² points, on which the loads have 4 to 10 pixels across."""
    rows = CURVES[0.3]
    found = asp.calibrate(film(rows, tmp_path, names=(name,)))
    unit = {"E1": 1e9, "h": 1e-3}[name]
    assert found[name].value / unit == pytest.approx(rows[0][name], rel=0.01)
    assert found[name].deviation == pytest.approx(exact(rows, (name,))[0][0], rel=0.02)
    assert found.identifiable
    assert found.converged
    low, high = found[name].low, found[name].high
    assert np.log(high / low) == pytest.approx(2.0 * 1.96 * found[name].deviation)


@pytest.mark.slow
@pytest.mark.parametrize("modulus", [8.0, 0.3])
def test_two_parameters_of_a_film_are_not_told_apart(tmp_path: Path, modulus: float):
    rows = CURVES[modulus]
    found = asp.calibrate(film(rows, tmp_path, points=32))
    deviations, correlation = exact(rows, ("E1", "h"))
    assert [each.deviation for each in found.parameters] == pytest.approx(deviations, rel=0.15)
    assert found.correlation[0][1] == pytest.approx(correlation[0, 1], abs=2e-3)
    assert not found.identifiable
    assert set(found.profiles) == {"E1", "h"}
    assert all(each.low <= each.value <= each.high for each in found.parameters)


@pytest.mark.slow
def test_a_prior_tells_what_the_curve_does_not(tmp_path: Path):
    """Known thickness: the deviation is that of the exact derivatives with one row more."""
    rows = CURVES[0.3]
    known = {"prior": f"{rows[0]['h']} mm", "deviation": 0.05}
    found = asp.calibrate(film(rows, tmp_path, h=known))
    slopes = np.array([[row[f"ddelta_d{n}"] * row[n] / row["delta"] / 0.01 for n in ("E1", "h")] for row in rows])
    whole = np.concatenate([slopes, [[0.0, 1.0 / 0.05]]])
    deviations = np.sqrt(np.diag(np.linalg.inv(whole.T @ whole)))
    assert [each.deviation for each in found.parameters] == pytest.approx(deviations, rel=0.02)
    assert found["h"].value == pytest.approx(rows[0]["h"] * 1e-3, rel=0.01)


def written(folder: Path, head: str, *rows: str) -> Path:
    path = folder / "c.csv"
    path.write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")
    return path


def made(curve: Path, *parameters: dict[str, Any], **problem: Any) -> dict[str, Any]:
    table = {"curve": str(curve), "parameters": list(parameters)}
    return {"version": 1, "problem": {**PROBLEM, "solver": {"tolerance": 1e-8}, **problem}, "calibration": table}


HARDNESS = {"path": "law.hardness", "name": "H", "low": "0.1 GPa", "high": "2 GPa", "start": "0.3 GPa"}


def test_a_hardness_from_load_and_area(tmp_path: Path):
    """The curve of a hardness of 0.5 GPa, made by the model; run again, nothing is solved."""
    law, loads, area = {"kind": "hardness", "hardness": "0.5 GPa"}, (10, 20, 40), "area_fraction_corrected"
    areas = [asp.run({**PROBLEM, "control": {"mean_pressure": f"{p} MPa"}, "law": law}).values[area] for p in loads]
    rows = [f"{p},{100 * a!r},0.5" for p, a in zip(loads, areas, strict=True)]
    curve = written(tmp_path, f"mean_pressure (MPa),{area} (%),{area}_deviation (%)", *rows)
    study = made(curve, HARDNESS, law={**law, "hardness": "0.3 GPa"})
    study["calibration"]["step"] = 0.1  # areas jump from point to point
    found = asp.calibrate(study, tmp_path / "results")
    assert found["H"].low < 0.5e9 < found["H"].high
    assert found.chi_squared < 1.0
    again = asp.calibrate(study, tmp_path / "results")
    assert (again.solves, again["H"].value) == (0, found["H"].value)
    assert found.verdict in repr(found)


@pytest.mark.slow
def test_a_work_of_adhesion_from_force_and_distance(tmp_path: Path):
    """The pull of a ball at given approach gives the work of adhesion it was made with."""
    ball = {"kind": "sphere", "points": [32, 32], "size": "0.6 um", "radius": "1 um"}
    body = {"youngs_modulus": "1 GPa", "poisson_ratio": 0.3}
    table = {"work": "20 mJ/m^2", "range": "5 nm"}
    problem = {"version": 2, "surface": ball, "body": body, "boundary": {"kind": "free"}, "adhesion": table}
    name, approaches = "adhesive_external_force", (2, 4, 6)
    forces = [asp.run({**problem, "control": {"approach": f"{a} nm"}}).values[name] for a in approaches]
    rows = [f"{a},{1e9 * force!r}" for a, force in zip(approaches, forces, strict=True)]
    curve = written(tmp_path, f"approach (nm),{name} (nN)", *rows)
    fitted = {"path": "adhesion.work", "name": "w", "low": "5 mJ/m^2", "high": "80 mJ/m^2", "start": "35 mJ/m^2"}
    asked = {"curve": str(curve), "parameters": [fitted], "noise": 0.02}
    start = {**problem, "control": {"approach": "2 nm"}}
    found = asp.calibrate({"version": 1, "problem": start, "calibration": asked})
    assert found["w"].value == pytest.approx(20e-3, rel=2e-3)
    assert found.identifiable


# What is refused.


MODULUS = {"path": "body.base.youngs_modulus", "low": "50 GPa", "high": "500 GPa"}


@pytest.mark.parametrize(
    ("head", "row", "kind", "subject"),
    [
        ("force,approach (nm)", "1,1", InputError, "column force of the curve"),
        ("force (nm),approach (nm)", "1,1", UnitError, "column force of the curve"),
        ("force (mN),aproach (nm)", "1,1", InputError, "column aproach of the curve"),
        ("force (mN),approach (nm)", "1,x", FileFormatError, ""),
        ("forces (mN),approach (nm)", "1,1", InputError, "path"),
        ("force (mN)", "1", FileFormatError, "curve"),
        ("force (mN),plastic_work (J)", "1,0", InputError, "deviation of plastic_work in the curve"),
    ],
)
def test_curves_that_cannot_be_read_are_refused(tmp_path: Path, head: str, row: str, kind: Any, subject: str):
    with pytest.raises(kind) as caught:
        asp.calibrate(made(written(tmp_path, head, row, row), MODULUS))
    assert not subject or caught.value.subject == subject, str(caught.value)


def test_too_few_values_and_other_studies_are_refused(tmp_path: Path):
    curve = written(tmp_path, "force (mN),approach (nm)", "1,1")
    other = {"path": "body.layers.0.youngs_modulus", "low": "50 GPa", "high": "500 GPa"}
    with refused(InputError, "curve of a calibration", "2", "1"):
        asp.calibrate(made(curve, MODULUS, other))
    with refused(InputError, "study of a calibration"):
        asp.calibrate({"version": 1, "problem": PROBLEM, "axes": [{"path": "surface.seed", "values": [1, 2]}]})
