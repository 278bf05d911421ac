"""Calibrations: parameters of published curves come back, with the deviations and correlations of
their exact derivatives; what a curve does not tell is said."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from coated_sphere import Film, approach
from reference_data import Row, reference
from refusals import refused
from scipy.optimize import minimize_scalar
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


def test_a_contact_of_few_points_is_named(tmp_path: Path):
    found = asp.calibrate(film(CURVES[0.3], tmp_path, points=16, names=("h",)))
    assert sum("points of the grid" in text for text in found.findings) == 1


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


def exact_approach(row: Row, modulus: float, thickness: float) -> float:
    return approach(row["P"], modulus, thickness, Film(row["nu1"], row["E2"], row["nu2"], row["R"]))


def test_the_published_curves_and_deviations_are_those_of_an_independent_equation():
    """Approach and derivatives of all rows by a Fredholm equation and differences, and from these
    (JᵀJ)⁻¹ of the three films; that of the third says that its parameters are not known at all."""
    step = 1e-4
    for rows in CURVES.values():
        slopes = []
        for row in rows:
            E1, h = row["E1"], row["h"]
            assert exact_approach(row, E1, h) == pytest.approx(row["delta"], rel=1e-9)
            up, down = 1.0 + step, 1.0 - step
            by_modulus = exact_approach(row, E1 * up, h) - exact_approach(row, E1 * down, h)
            by_thickness = exact_approach(row, E1, h * up) - exact_approach(row, E1, h * down)
            assert by_modulus / (2.0 * step * E1) == pytest.approx(row["ddelta_dE1"], rel=1e-7)
            assert by_thickness / (2.0 * step * h) == pytest.approx(row["ddelta_dh"], rel=1e-7)
            slopes.append(np.array([by_modulus, by_thickness]) / (2.0 * step * row["delta"] * 0.01))
        covariance = np.linalg.inv(np.transpose(slopes) @ np.array(slopes))
        assert np.sqrt(np.diag(covariance)) == pytest.approx(exact(rows, ("E1", "h"))[0], rel=1e-4)
    assert exact(CURVES[3.0], ("E1", "h"))[0] == pytest.approx([1.765, 1.288], abs=1e-3)


@pytest.mark.slow
def test_the_film_that_no_curve_tells_has_the_interval_of_the_exact_profile(tmp_path: Path):
    """A relative deviation of 1.8 is no error bar, the interval is that of the profile.

    The correlation is 0.9994, so the deviations take errors of the derivatives 30 times, and the
    fit moves 1.8 times as far as the model is off in units of the noise. On 32² points, on which
    the smallest contact has 21, the approach is off by 0.8 % of it: the fit goes to 0.76 of the
    modulus, where the exact deviations are 0.69 and 0.74. On 128² points it is off by 0.03 %.
    """
    rows = CURVES[3.0]
    found = asp.calibrate(film(rows, tmp_path, points=128))
    deviations, correlation = exact(rows, ("E1", "h"))
    assert [each.deviation for each in found.parameters] == pytest.approx(deviations, rel=0.08)
    assert found.correlation[0][1] == pytest.approx(correlation[0, 1], abs=2e-4)
    assert found["E1"].value == pytest.approx(3e9, rel=0.03)
    assert found["h"].value == pytest.approx(50e-6, rel=0.03)

    def rise(modulus: float, thickness: float) -> float:
        ratios = [exact_approach(row, modulus, thickness) / row["delta"] for row in rows]
        return float(np.square((np.array(ratios) - 1.0) / 0.01).sum())

    low = minimize_scalar(lambda h: rise(found["E1"].low / 1e9, h), bounds=(0.02, 0.15), method="bounded")
    assert low.fun == pytest.approx(3.84, rel=0.05)
    for end in (found["h"].low, found["h"].high):
        best = minimize_scalar(lambda E1, h=1e3 * end: rise(E1, h), bounds=(1.0, 9.0), method="bounded")
        assert best.fun == pytest.approx(3.84, rel=0.05)
    assert found["E1"].high == pytest.approx(9e9)
    assert sum("E1 is open" in text for text in found.findings) == 1


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
