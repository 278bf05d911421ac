"""Conductance on the command line: a study from its file, a loaded and unloaded joint, and what is
said where a conductivity is missing."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray
from cli.conftest import Runner
from refusals import subject_of

STUDY = """
version = 1
quantities = ["electrical_resistance", "thermal_conductance_per_area"]

[[axes]]
name = "pressure"
path = "control.mean_pressure"
values = ["20 MPa", "80 MPa"]

[[axes]]
name = "gold"
path = "body.layers.0.thickness"
values = ["0.1 um", "2 um"]

[[axes]]
name = "roughness"
path = "surface.spectrum.rms_height"
values = ["50 nm", "100 nm"]

[problem]
version = 2
body = "gold:0.5um/nickel"
counter_body = "copper"
control = { mean_pressure = "20 MPa" }
conductance = { flow = "both" }

[problem.surface]
kind = "rough"
points = [48, 48]
size = "20 um"
seed = 1
spectrum = { kind = "gaussian", rms_height = "100 nm", correlation_length = "2 um" }
"""


def test_a_study_over_load_thickness_and_roughness(tmp_path: Path, run: Runner) -> None:
    document, folder = tmp_path / "joint.toml", tmp_path / "study"
    document.write_text(STUDY, encoding="utf-8")
    told = run("run", document, "--out", folder, "--workers", "1")
    assert told.exit_code == 0, told.output
    data = xarray.load_dataset(folder / "results.nc")
    resistance = np.asarray(data["electrical_resistance"])
    assert resistance.shape == (2, 2, 2)
    assert np.all(np.diff(resistance, axis=0) < 0.0)  # load
    assert np.all(np.diff(resistance, axis=1) < 0.0)  # gold
    assert np.all(np.diff(resistance, axis=2) > 0.0)  # rougher elastic surfaces conduct less
    assert np.all(np.diff(np.asarray(data["thermal_conductance_per_area"]), axis=0) > 0.0)


@pytest.mark.parametrize(
    ("flow", "subject"),
    [
        ("electrical", "electrical resistivity of DLC (layer 1 of the body)"),
        ("thermal", "thermal conductivity of DLC (layer 1 of the body)"),
        ("known", "electrical resistivity of DLC or thermal conductivity of DLC"),
    ],
)
def test_a_missing_conductivity_is_that_of_a_material(tmp_path: Path, run: Runner, flow: str, subject: str) -> None:
    document = tmp_path / "problem.toml"
    text = STUDY[STUDY.index("[problem]") :].replace("[problem]\n", "").replace("problem.", "")
    text = text.replace("gold:0.5um", "DLC:5nm").replace('flow = "both"', f'flow = "{flow}"')
    document.write_text(text, encoding="utf-8")
    told = run("contact", "--from", document, "--out", tmp_path / "out")
    assert subject_of(told) == subject
