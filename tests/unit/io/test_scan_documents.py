"""Documents whose surface is generated from many scans of one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity import InputError
from asperity.core.grid import Grid
from asperity.files import save_surface
from asperity.generate import ExponentialAutocorrelation, gaussian
from asperity.parts.waves import DecidingWavesPart
from asperity.parts.waves_work import waves_of
from asperity.roughness import deciding_waves, deciding_waves_of, power_spectrum, radial_spectrum
from asperity.run.build import build
from asperity.run.document import checked, dumps, files_of, loads, relocated
from asperity.run.run import run
from asperity.run.stored import load_outcome, save_outcome
from asperity.theories.rough.persson import IsotropicSpectrum


def table(surface: dict[str, Any]) -> dict[str, Any]:
    return {
        "version": 2,
        "surface": surface,
        "body": {"youngs_modulus": "100 GPa", "poisson_ratio": 0.3, "hardness": "5 GPa"},
        "control": {"mean_pressure": "1 MPa"},
    }


def scans(folder: Path) -> list[Any]:
    """Two maps and a line of one surface in files of the ``folder``, as a document names them."""
    folder.mkdir(exist_ok=True)
    model = ExponentialAutocorrelation(1e-9, 2e-7)
    for seed, size in enumerate((8e-6, 2e-6)):
        made = gaussian(Grid((64, 64), (size / 64, size / 64)), model, seed=seed)
        save_surface(made, folder / f"map {seed}.nc", overwrite=True)
    line = gaussian(Grid((256, 256), (5e-8, 5e-8)), model, seed=7).heights[0]
    np.savetxt(folder / "line.txt", np.column_stack([0.05 * np.arange(256), line * 1e9]))
    return [
        "scans/map 0.nc",
        {"path": "scans/map 1.nc", "noise": "1 pm", "prepare": [{"step": "level", "form": "plane"}]},
        "scans/line.txt, lateral_unit=um,height_unit=nm, tip_radius=20 nm",
    ]


def scanned(items: list[Any], **more: Any) -> dict[str, Any]:
    return {
        "kind": "rough",
        "seed": 1,
        "spectrum": {"kind": "scans", "scans": items, **more},
        "points": [64, 64],
        "size": "3 um",
    }


def test_more_like_many_scans(tmp_path: Path) -> None:
    items = scans(tmp_path / "scans")
    document = checked(table(surface=scanned(items, shortest_wavelength="100 nm", corner="rounded")))
    again = loads(dumps(document))
    assert again == document
    made = build(again, tmp_path).problem.surface
    # the same by hand: heights of a map are levelled, what is known of the line is the tip
    line = asp.read(tmp_path / "scans" / "line.txt", lateral_unit="um", height_unit="nm")
    maps = [asp.read(tmp_path / "scans" / f"map {number}.nc") for number in range(2)]
    own = asp.surfaces.Scans(
        [
            maps[0],
            asp.surfaces.Scan.of(asp.surfaces.levelled(maps[1], "plane"), noise=1e-12),
            asp.surfaces.Scan.of(line, tip_radius=20e-9),
        ]
    )
    spectrum = own.spectrum(corner="rounded").extended(1e-7)
    np.testing.assert_array_equal(made.heights, gaussian(made.grid, spectrum, seed=1).heights)
    assert "scans/line.txt" in made.origin.history[0]
    assert {item.criterion for item in spectrum.findings} == {item.criterion for item in made.origin.findings}
    # the same document from another folder finds the same files
    elsewhere = tmp_path / "deep" / "folder"
    elsewhere.mkdir(parents=True)
    moved = relocated(document, tmp_path, elsewhere)
    np.testing.assert_array_equal(build(moved, elsewhere).problem.surface.heights, made.heights)
    assert files_of(document, tmp_path)[0] == tmp_path / "scans" / "map 0.nc"


@pytest.mark.parametrize("kind", ["digital_filter", "rank_ordered", "two_process"])
def test_every_generator_takes_the_spectrum_of_scans(tmp_path: Path, kind: str) -> None:
    (tmp_path / "scans").mkdir()
    surface = scanned(scans(tmp_path / "scans"))
    spectrum = surface["spectrum"]
    if kind == "two_process":
        surface = {key: value for key, value in surface.items() if key != "spectrum"}
        surface |= {"plateau": spectrum, "valleys": spectrum, "offset": "1 nm"}
    elif kind == "rank_ordered":
        surface["heights"] = {"kind": "moments", "skewness": 0.3, "kurtosis": 3.5}
    made = build(checked(table(surface=surface | {"kind": kind})), tmp_path).problem.surface
    assert made.heights.std() == pytest.approx(1e-9, rel=0.5)


@pytest.mark.parametrize("more", [{"prepare": [{"step": "level"}]}, {"axis": "y"}])
def test_lines_are_not_prepared_like_maps(tmp_path: Path, more: dict[str, Any]) -> None:
    scans(tmp_path / "scans")
    line = {"path": "scans/line.txt", "lateral_unit": "um", "height_unit": "nm", **more}
    with refused(InputError, f"{next(iter(more))} of the scan scans/line.txt"):
        build(checked(table(surface=scanned([line]))), tmp_path)


def test_waves_that_decide_the_contact_are_those_of_the_scans(tmp_path: Path) -> None:
    surface = scanned(scans(tmp_path / "scans"), shortest_wavelength="20 nm", corner="rounded")
    document = checked(table(surface) | {"deciding_waves": {}})
    outcome = run(document, tmp_path)
    found = outcome.found["deciding_waves"]
    items = [item.scan(tmp_path) for item in document.surface.spectrum.scans]
    spectrum = asp.surfaces.Scans(items).spectrum(corner="rounded").extended(2e-8)
    modulus, pressure = outcome.result.problem.contact_modulus, outcome.result.mean_pressure
    expected = deciding_waves_of(spectrum, modulus, pressure)
    np.testing.assert_array_equal(found.values["waves_area_share"], expected.shares["area"])
    assert found.values["waves_mean_gap_size"] == expected.needs["mean_gap"].size
    assert np.isnan(found.values["waves_plastic_size"])  # a hard wall
    assert {"short waves", "waves of the real area"} <= {item.criterion for item in found.findings}
    assert {"short waves", "roll-off"} & {item.criterion for item in outcome.findings} == {"short waves"}
    # the file tells the same again
    save_outcome(outcome, tmp_path / "found.nc")
    again = load_outcome(tmp_path / "found.nc").found["deciding_waves"]
    assert waves_of(again).needs == waves_of(found).needs == expected.needs
    assert again.words is not None
    assert again.words.sentence == DecidingWavesPart().at_work.words(found, outcome.solved).sentence


def test_waves_of_any_other_surface_are_those_of_its_heights(tmp_path: Path) -> None:
    spectrum = {"kind": "exponential", "rms_height": "1 nm", "correlation_length": "0.2 um"}
    surface = {"kind": "rough", "seed": 1, "spectrum": spectrum, "points": [64, 64], "size": "3 um"}
    law = {"kind": "hardness", "hardness": "from body"}
    outcome = run(checked(table(surface) | {"law": law, "deciding_waves": {"tolerance": 0.1}}), tmp_path)
    found = outcome.found["deciding_waves"]
    rings = radial_spectrum(power_spectrum(outcome.result.problem.surface))
    heights = IsotropicSpectrum(rings.q, rings.psd)
    modulus, pressure = outcome.result.problem.contact_modulus, outcome.result.mean_pressure
    expected = deciding_waves(heights, modulus, pressure, hardness=5e9, tolerance=0.1)
    np.testing.assert_array_equal(found.values["waves_plastic_share"], expected.shares["plastic"])
    assert waves_of(found).needs == expected.needs


@pytest.mark.parametrize(
    ("more", "subject"),
    [
        ({"boundary": {"kind": "free"}}, "boundary of a contact whose deciding waves are asked for"),
        (
            {"body": {"layers": [{"material": "DLC", "thickness": "5 nm"}], "base": {"material": "steel"}}},
            "bodies of a contact whose deciding waves are asked for",
        ),
    ],
)
def test_waves_are_asked_for_where_the_theory_holds(more: dict[str, Any], subject: str, tmp_path: Path) -> None:
    surface = {"kind": "sinusoid", "amplitude": "1 nm", "wavelength": "1 um", "points": [16, 16], "size": "1 um"}
    with refused(InputError, subject):
        build(checked(table(surface) | {"deciding_waves": {}} | more), tmp_path)
