"""Options of the preparation and of the place of a counter surface: the steps they stand for."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from cli.conftest import BODY, LOAD, SCALE, Runner
from refusals import refused, subject_of

from asperity import InputError
from asperity.cli.declared import Given
from asperity.cli.options import preparation_options, step_names, steps
from asperity.io.results import load
from asperity.run.document import load_document

pytestmark = pytest.mark.usefixtures("undrawn")


def given(**options: object) -> Given:
    offered = {option.word: option.path for option in preparation_options()}
    return Given({offered[word]: value for word, value in options.items()})


def kinds(**options: object) -> list[str]:
    return [step["step"] for step in steps(given(**options))]


def test_order_of_the_steps() -> None:
    everything = {
        "crop": "0um:5um,0um:4um",
        "mask": "rectangle 0um:1um",
        "despike": "6",
        "line_correct": "x",
        "remove_tip": "10nm",
        "tip_opening": "40deg",
        "mask_uncertain": True,
        "tip_radius": "10nm",
        "short_cutoff": "1um",
        "resample": "64",
        "taper": "0.1",
        "periodise": True,
        "line": "y=middle",
    }
    before = [
        "crop",
        "mask",
        "despike",
        "line_correct",
        "tip",
        "level",
        "fill",
        "tip_limit",
        "filter",
        "resample",
        "taper",
        "periodise",
        "slice",
    ]
    assert kinds(**everything) == before
    assert kinds(**everything, filter="sharp")[-2:] == ["filter", "slice"]
    assert kinds() == ["level", "fill"]
    assert kinds(level="none", fill="none") == []


def test_options_of_a_tip_go_together() -> None:
    (tip,) = steps(given(estimate_tip="5x7", tip_noise="1nm", mask_uncertain=True, level="none", fill="none"))
    assert tip == {"step": "tip", "pixels": "5x7", "noise": "1nm", "mask_uncertain": True}
    for alone in ({"tip_opening": "40deg"}, {"tip_noise": "1nm"}, {"mask_uncertain": True}):
        with refused(InputError, "--" + next(iter(alone)).replace("_", "-")):
            steps(given(**alone))
    with refused(InputError, "--estimate-tip"):
        steps(given(remove_tip="10nm", estimate_tip="5x5"))


def test_values_of_the_steps() -> None:
    made = steps(given(level="5", robust_level=True, short_cutoff="1um", long_cutoff="9um", filter="robust"))
    assert made[0] == {"step": "level", "degree": 5, "robust": True}
    assert made[-1] == {"step": "filter", "short": "1um", "long": "9um", "kind": "robust"}
    names = step_names(made)
    assert names["surface.prepare[1].degree"] == "--level"
    assert names["surface.prepare[3].short"] == "--short-cutoff"


def test_regions_of_a_mask() -> None:
    text = "rectangle 1um:2um,3um:4um; ellipse 5um,3um,2um,1um,30deg;polygon 0um,0um,1um,0um,1um,2um"
    (mask,) = steps(given(mask=text, mask_invert=True, level="none", fill="none"))
    assert mask == {
        "step": "mask",
        "regions": [
            {"kind": "rectangle", "x": "1um:2um", "y": "3um:4um"},
            {"kind": "ellipse", "centre": ["5um", "3um"], "radii": ["2um", "1um"], "angle": "30deg"},
            {"kind": "polygon", "x": ["0um", "1um", "1um"], "y": ["0um", "0um", "2um"]},
        ],
        "invert": True,
    }
    (rows,) = steps(given(mask="rectangle ,3um:4um", level="none", fill="none"))
    assert rows["regions"] == [{"kind": "rectangle", "y": "3um:4um"}]


def test_a_masked_scan_is_filled_and_solved(run: Runner, matrix: Path, tmp_path: Path) -> None:
    options = ("--mask", "rectangle 1um:2um,1um:2um; ellipse 4um,4um,1um,1um", "--save-document", tmp_path / "a.toml")
    result = run("contact", matrix, *SCALE, *BODY, *LOAD, *options)
    assert result.exit_code == 0, result.stderr
    written = load_document(tmp_path / "a.toml").surface.prepare
    assert [step.step for step in written] == ["mask", "level", "fill"]
    again = run("contact", "--from", tmp_path / "a.toml", "--out", tmp_path / "run")
    assert again.exit_code == 0, again.stderr
    history = load(tmp_path / "run" / "result.nc").problem.surface.origin.history
    assert any(step.startswith("masked: ") for step in history)
    for text, subject in (("rectangle 9um:10um", "region 1 of a mask"), ("rectangle 1um:0um", "x of part 1 of --mask")):
        assert subject_of(run("contact", matrix, *SCALE, *BODY, *LOAD, "--mask", text)) == subject


@pytest.mark.parametrize(
    ("options", "subject"),
    [
        ({"mask": "circle 1um"}, "--mask"),
        ({"mask": "polygon 1um,1um,2um,2um"}, "--mask"),
        ({"mask_invert": True}, "--mask-invert"),
        ({"level": "cubic"}, "--level"),
        ({"filter": "spline"}, "--filter spline"),
        ({"filter": "robust"}, "--filter robust"),
        ({"crop": "1um"}, "--crop"),
    ],
)
def test_refusals(options: dict[str, str], subject: str) -> None:
    with refused(InputError, subject):
        steps(given(**options))


def test_a_contact_of_a_filtered_scan_writes_its_steps(run: Runner, matrix: Path, tmp_path: Path) -> None:
    options = ("--despike", "5", "--level", "3", "--short-cutoff", "1um", "--periodise")
    result = run("contact", matrix, *SCALE, *BODY, *LOAD, *options, "--save-document", tmp_path / "a.toml")
    assert result.exit_code == 0, result.stderr
    written = load_document(tmp_path / "a.toml").surface.prepare
    assert [step.step for step in written] == ["despike", "level", "fill", "filter", "periodise"]
    assert "1 µm" in result.stdout


def test_errors_name_the_option(run: Runner, matrix: Path) -> None:
    for options, subject in (
        (("--short-cutoff", "1"), "--short-cutoff"),
        (("--short-cutoff", "2nm"), "short cut-off of a filter"),
        (("--tip-radius", "-1nm"), "--tip-radius"),
        (("--counter-shift", "1um,0um"), "--counter-shift"),
        (("--common-grid",), "--common-grid"),
    ):
        result = run("contact", matrix, *SCALE, *BODY, *LOAD, *options)
        assert subject_of(result) == subject, options


def test_counter_surface_on_a_common_grid(run: Runner, matrix: Path, tmp_path: Path) -> None:
    place = ("--counter-surface", matrix, "--counter-shift", "1um,0um", "--rotate", "90deg")
    result = run("contact", matrix, *SCALE, *BODY, *LOAD, *place, "--save-document", tmp_path / "a.toml")
    assert result.exit_code == 0, result.stderr
    placed = load_document(tmp_path / "a.toml").counter_surface.place  # type: ignore[union-attr]
    assert placed is not None
    assert (placed.shift, placed.angle) == ((1e-6, 0.0), pytest.approx(math.pi / 2))
    wrong = run("contact", matrix, *SCALE, *BODY, *LOAD, "--counter-surface", matrix, "--counter-shift", "1um")
    assert subject_of(wrong) == "--counter-shift"


def test_line_contact_of_one_line_of_a_map(run: Runner, matrix: Path, tmp_path: Path) -> None:
    """In the frame of plane strain: loads per metre, stresses with a section along the line, no
    section across it."""
    line = ("--boundary", "line", "--load", "0.5N/m", "--friction", 0.2, "--coupled")
    found = run("contact", matrix, *SCALE, *BODY, *line, "--line", "x=3um", "--out", tmp_path / "run")
    assert found.exit_code == 0, found.stderr
    result = load(tmp_path / "run" / "result.nc")
    assert result.problem.surface.shape == (24, 1)
    assert result.problem.surface.size == pytest.approx((6e-6, 1.0))
    assert result.force == pytest.approx(0.5)
    assert "3.125 µm" in found.stdout
    assert load_document(tmp_path / "run" / "problem.toml").surface.prepare[-1].x == pytest.approx(3e-6)
    per_length = run("contact", matrix, *SCALE, *BODY, "--load", "1N/m")
    assert subject_of(per_length) == "force per length"
    path = run(
        "contact",
        matrix,
        *SCALE,
        *BODY,
        "--boundary",
        "line",
        "--line",
        "x=3um",
        "--path",
        "0.5N/m",
        "--path-steps",
        "1",
    )
    assert "500 mN" in path.stdout, path.stderr
    refused = run("contact", matrix, *SCALE, *BODY, *line)
    assert refused.exit_code == 2
    assert "--line y=middle" in refused.stderr
    for text, subject in (("3um", "--line"), ("y=9um", "y of a line")):
        assert subject_of(run("contact", matrix, *SCALE, *BODY, *line, "--line", text)) == subject
