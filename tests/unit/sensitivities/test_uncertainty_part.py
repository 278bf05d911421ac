"""Error bars in documents: numbers of Python, files, words, studies, and what is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from study_cases import InProcess, plan
from typer.testing import CliRunner

import asperity as asp
from asperity.cli.main import app
from asperity.core.errors import InputError
from asperity.physics.sensitivities.part_uncertainty import QUANTITIES
from asperity.physics.sensitivities.work import yielding_norms
from asperity.run.build import build
from asperity.run.document import checked, dumps, loads
from asperity.run.stored import load_outcome, save_outcome
from asperity.sensitivities import FirstYield, HeightNoise, PressureNorm, uncertainty
from asperity.studies.collect import dataset
from asperity.studies.run import carry_out

ROUGH: dict[str, Any] = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [32, 32],
        "size": "20 um",
        "seed": 2,
        "spectrum": {"kind": "gaussian", "rms_height": "50 nm", "correlation_length": "3 um"},
    },
    "body": "E=300GPa,nu=0.2,name=film:1um/E=200GPa,nu=0.3,name=base",
    "control": {"mean_pressure": "200 MPa"},
    "uncertainty": {"moduli": 0.05, "load": 0.02},
}


def test_numbers_are_those_of_python_and_files_keep_them(tmp_path: Path) -> None:
    asked = {
        "of": ["peak_pressure", "mean_gap"],
        "moduli": 0.05,
        "thicknesses": 0.1,
        "load": "2 %",
        "height_scale": 0.01,
        "noise": "0.2 nm",
        "noise_length": "1 um",
        "samples": 6,
        "seed": 3,
    }
    document = ROUGH | {"uncertainty": asked}
    assert loads(dumps(checked(document))) == checked(document)
    outcome = asp.run(document)
    values = outcome.found["uncertainty"].values
    scatter = {
        "body.layers[0].youngs_modulus": 0.05,
        "body.layers[0].thickness": 0.1,
        "body.base.youngs_modulus": 0.05,
        "force": 0.02,
        "heights": 0.01,
    }
    noise = HeightNoise(0.2e-9, 1e-6)
    peak = uncertainty(outcome.result, PressureNorm(16.0), scatter, noise=noise, samples=6, seed=3)
    assert values["uncertainty_peak_pressure"] == pytest.approx(peak.relative, rel=1e-6)
    assert (values["uncertainty_low_peak_pressure"], values["uncertainty_high_peak_pressure"]) == pytest.approx(
        peak.interval, rel=1e-6
    )
    assert values["uncertainty_bias_peak_pressure"] == pytest.approx(peak.bias, abs=1e-6)
    shares = dict(zip(values["uncertainty_source"], values["uncertainty_share_peak_pressure"], strict=True))
    assert shares == pytest.approx(dict(peak.shares), rel=1e-5)
    save_outcome(outcome, tmp_path / "unsure.nc")
    again = load_outcome(tmp_path / "unsure.nc")
    tree = asp.files.open_tree(tmp_path / "unsure.nc")
    for item in QUANTITIES:
        if item.name in values:
            assert tree[f"uncertainty/{item.name}"].attrs.get("units", "") == item.unit
    first, second = (next(w for p, w in one.sections if p.name == "uncertainty") for one in (outcome, again))
    assert (first.sentence, first.rows, first.tables) == (second.sentence, second.rows, second.tables)
    drawn = {figure.name for figure in again.figures["uncertainty"]}
    assert drawn == {"uncertainty_peak_pressure", "uncertainty_mean_gap"}
    assert all(figure.picture for figure in again.figures["uncertainty"])


def test_error_bars_that_are_too_large_for_the_linear_estimate_are_warned_of() -> None:
    def criteria(asked: dict[str, Any]) -> set[str]:
        return {finding.criterion for finding in asp.run(ROUGH | {"uncertainty": asked}).findings}

    assert "linear uncertainty" in criteria({"height_scale": 0.4})
    assert "linear uncertainty" not in criteria({"moduli": 0.05})
    assert "linear uncertainty" not in criteria({"height_scale": 0.4, "samples": 4})


def test_a_hardness_has_its_scatter() -> None:
    law = {"kind": "hardness", "hardness": "3 GPa"}
    asked = {"of": ["mean_gap"], "hardness": 0.1, "moduli": 0.01}
    outcome = asp.run(ROUGH | {"law": law, "uncertainty": asked})
    assert "hardness" in {str(name) for name in outcome.found["uncertainty"].values["uncertainty_source"]}


def test_first_yield_has_an_error_bar_by_layer() -> None:
    """Of the layer that yields first, that of Python; of all that are near to it in a list."""
    film = {"youngs_modulus": "300 GPa", "poisson_ratio": 0.2, "yield_stress": "6 GPa", "name": "film"}
    base = {"youngs_modulus": "200 GPa", "poisson_ratio": 0.3, "yield_stress": "4 GPa", "name": "base"}
    body = {"layers": [{**film, "thickness": "1 um"}], "base": base}
    asked = {"of": ["yield", "approach"], "moduli": 0.05, "load": 0.02, "strengths": 0.1}
    outcome = asp.run(ROUGH | {"body": body, "uncertainty": asked})
    values = outcome.found["uncertainty"].values
    layers, factors = values["uncertainty_yield_layer"], values["uncertainty_yield_factor"]
    assert list(factors) == sorted(factors)
    assert factors[0] == values["uncertainty_median_yield"]
    assert set(map(str, layers)) == {"layer 1 (film)", "the base (base)"}
    scatter = {f"body.{part}.youngs_modulus": 0.05 for part in ("layers[0]", "base")}
    bars = [
        uncertainty(outcome.result, FirstYield(norm), {**scatter, "force": 0.02, "strength": 0.1})
        for _, norm in yielding_norms(outcome.result)
    ]
    first = min(bars, key=lambda bar: bar.value)
    assert values["uncertainty_yield"] == pytest.approx(first.relative, rel=1e-6)
    assert sorted(bar.value for bar in bars) == pytest.approx(factors, rel=1e-6)
    shares = dict(zip(values["uncertainty_source"], values["uncertainty_share_approach"], strict=True))
    assert shares["strength"] == 0.0
    tables = next(words for part, words in outcome.sections if part.name == "uncertainty").tables
    assert len(tables) == 3
    assert [figure.name for figure in outcome.figures["uncertainty"] if figure.picture]


REFUSED = {
    "nothing unsure": ({"uncertainty": {}}, "uncertainty"),
    "too much": ({"uncertainty": {"moduli": 3.0}}, "uncertainty.moduli"),
    "yield": ({"uncertainty": {"of": ["yield"], "moduli": 0.1}}, "strength of a layer or base"),
    "strength of nothing": ({"uncertainty": {"strengths": 0.1, "moduli": 0.1}}, "uncertainty.strengths"),
    "strength alone": ({"uncertainty": {"strengths": 0.1, "of": ["yield", "approach"]}}, "uncertainty"),
    "adhesion": (
        {"adhesion": {"work": "50 mJ/m^2", "range": "1 nm"}},
        "contact of sensitivities",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refused(name: str) -> None:
    tables, subject = REFUSED[name]
    with pytest.raises(InputError) as refused:
        build(checked(ROUGH | tables))
    assert refused.value.subject.endswith(subject)


def test_a_study_over_the_load(tmp_path: Path) -> None:
    """At every load the mean gap is as unsure as the scale of heights allows."""
    axis = {"path": "control.mean_pressure", "values": ["50 MPa", "200 MPa"]}
    made = plan(problem=ROUGH, axes=[axis], quantities=["uncertainty_approach"])
    carry_out(made, tmp_path / "r.log", InProcess())
    found = np.asarray(dataset(made, tmp_path / "r.log")["uncertainty_approach"]).ravel()
    assert np.all((found > 0.001) & (found < 0.1))


def test_the_command_asks_for_them(tmp_path: Path) -> None:
    plain = {key: value for key, value in ROUGH.items() if key != "uncertainty"}
    (tmp_path / "p.toml").write_text(dumps(checked(plain)), encoding="utf-8")
    options = ("--scatter-moduli", "0.05", "--scatter-load", "0.02", "--out", str(tmp_path / "o"))
    done = CliRunner().invoke(app, ["contact", "--from", str(tmp_path / "p.toml"), *options])
    assert done.exit_code == 0, done.output
    tree = asp.files.open_tree(tmp_path / "o" / "result.nc")
    single = asp.run(ROUGH).values
    assert float(tree["uncertainty/uncertainty_approach"]) == pytest.approx(single["uncertainty_approach"], rel=1e-5)
    assert "uncertainty_approach" in {path.stem for path in (tmp_path / "o").rglob("*.png")}
