"""What a page holds for its viewer: the coding of maps, how coarse they are, and how large all of
it may be."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import asperity as asp
from asperity.core.arrays import RealArray
from asperity.core.grid import Grid
from asperity.plots.maps import Kinds
from asperity.plots.picture import colour_table
from asperity.report.blocks import reduced
from asperity.report.scene import (
    BUDGET,
    MASKED,
    MOST_STEPS,
    as_json,
    coded,
    coded_kinds,
    decoded,
    scene,
    scene_of,
)
from asperity.run.execute import analysed
from asperity.run.stored import load_outcome, save_outcome

pytestmark = pytest.mark.usefixtures("unrendered")

RANDOM = np.random.default_rng(5)


def values(shape: tuple[int, int] = (37, 22), missing: float = 0.2) -> RealArray:
    found = RANDOM.standard_normal(shape).cumsum(0) * 1e-9
    found[RANDOM.random(shape) < missing] = np.nan
    return found


@pytest.mark.parametrize("shape", [(37, 22), (1, 5), (5, 1), (128, 64)])
def test_values_return_to_half_a_step(shape: tuple[int, int]) -> None:
    wanted = values(shape)
    array = coded(wanted, (2e-8, 1e-8))
    found = decoded(array)
    assert np.array_equal(np.isnan(found), np.isnan(wanted))
    span = np.nanmax(wanted) - np.nanmin(wanted)
    assert array["step"] == pytest.approx(span / (MASKED[16] - 1))
    assert np.nanmax(np.abs(found - wanted)) <= 0.5 * array["step"] * (1.0 + 1e-9)
    assert array["shape"] == list(shape)
    assert array["cell"] == [2e-8, 1e-8]


@pytest.mark.parametrize("value", [0.0, 3.5, np.nan])
def test_equal_values_return_exactly(value: float) -> None:
    np.testing.assert_array_equal(decoded(coded(np.full((4, 3), value), (1.0, 1.0))), np.full((4, 3), value))


def test_every_difference_of_two_numbers_is_coded() -> None:
    ends = np.array([[0.0, 65534.0], [65534.0, 0.0], [32768.0, 0.0], [np.nan, 32767.0], [1.0, np.nan]]).T
    np.testing.assert_array_equal(decoded(coded(ends, (1.0, 1.0))), ends)


def test_classes_return_exactly() -> None:
    kinds = RANDOM.integers(0, 4, (9, 14)).astype(float)
    shown = Kinds(kinds, Grid(kinds.shape, (1e-8, 2e-8)), tuple((str(number), "#000000") for number in range(4)))
    made = coded_kinds(shown)
    np.testing.assert_array_equal(decoded(made), kinds)
    np.testing.assert_allclose(made["shares"], [np.mean(kinds == number) for number in range(4)], rtol=1e-15)


@pytest.mark.parametrize(("how", "of"), [("max", np.nanmax), ("min", np.nanmin), ("mean", np.nanmean)])
def test_a_block_is_its_extreme_or_mean_and_blank_where_all_is_blank(how: str, of: object) -> None:
    wanted = values((11, 7), missing=0.4)
    wanted[:3, :3] = np.nan
    found = reduced(wanted, 3, how)
    assert found.shape == (4, 3)
    assert np.isnan(found[0, 0])
    for i in range(4):
        for j in range(3):
            block = wanted[3 * i : 3 * i + 3, 3 * j : 3 * j + 3]
            if np.isfinite(block).any():
                assert found[i, j] == pytest.approx(of(block), rel=1e-12)  # type: ignore[operator]


def posed(n: int = 32, law: asp.plasticity.HardWall | asp.Hardness | None = None) -> asp.ContactProblem:
    noise = np.random.default_rng(7).standard_normal((n, n // 2))
    heights = sum(np.roll(noise, (i, j), (0, 1)) for i in range(3) for j in range(3)) * 1e-9
    surface = asp.Surface(heights, 2e-8, 1e-8, periodic=True)
    return asp.ContactProblem(surface, asp.Elastic(1e11, 0.3), law=law or asp.plasticity.HardWall())


@pytest.fixture(scope="module")
def path() -> asp.HistoryResult:
    return asp.solve(
        posed(law=asp.Hardness(3e9)), asp.History(asp.contact.ramps(asp.MeanPressure, [4e8, 0.0], steps=3))
    )


def test_a_scene_holds_the_maps_of_the_result() -> None:
    result = asp.solve(posed(), asp.MeanPressure(2e8))
    made = scene_of(analysed(result, {"plasticity": True}))
    assert made is not None
    maps = {item["name"]: item for item in made["maps"]}
    assert list(maps) == ["heights", "pressure", "contact", "gap"]
    pressure = decoded(maps["pressure"]["arrays"][0])
    np.testing.assert_array_equal(np.isfinite(pressure), result.contact)
    assert np.nanmax(np.abs(pressure - result.pressure)) <= 0.5 * maps["pressure"]["arrays"][0]["step"] * (1.0 + 1e-9)
    assert maps["contact"]["arrays"][0]["shares"] == pytest.approx([1.0 - result.area_fraction, result.area_fraction])
    assert made["line"][1] == made["line"][3]
    assert made["wraps"] == [True, True]
    assert made["steps"] is made["depths"] is None
    assert set(made["palettes"]) == {"cividis", "viridis"}
    assert len(colour_table("viridis")) == 768
    assert json.loads(as_json(made)) == made


def test_every_step_of_a_path_is_there(path: asp.HistoryResult) -> None:
    made = scene_of(analysed(path.last, {"path": True, "plasticity": True}, path))
    assert made is not None
    maps = {item["name"]: item for item in made["maps"]}
    assert maps["heights"]["along"] is None
    assert len(made["steps"]["texts"]) == len(path.steps)
    for name in ("pressure", "contact", "gap"):
        assert len(maps[name]["arrays"]) == len(path.steps)
    for array, step in zip(maps["pressure"]["arrays"], path.steps, strict=True):
        np.testing.assert_array_equal(np.isfinite(decoded(array)), step.contact)
    top = max(float(step.pressure.max()) for step in path.steps)
    assert maps["pressure"]["range"][1] == pytest.approx(top, rel=1e-12)


def test_long_paths_are_thinned_with_a_note(path: asp.HistoryResult) -> None:
    long = replace(path, steps=path.steps * 14)
    made = scene_of(analysed(long.last, {"plasticity": True}, long))
    assert made is not None
    assert len(made["steps"]["texts"]) == MOST_STEPS
    assert made["steps"]["numbers"][made["steps"]["first"]] == long.peak + 1
    assert made["steps"]["numbers"][0] == 1
    assert made["steps"]["numbers"][-1] == len(long.steps)
    assert any(f"{MOST_STEPS} of the {len(long.steps)} steps" in note for note in made["notes"])


def test_a_coarse_map_says_so_and_loses_no_contact() -> None:
    result = asp.solve(posed(64), asp.MeanPressure(5e7))
    made = scene_of(analysed(result, {}), most_points=64 * 32 // 9)
    assert made is not None
    assert any("one value for each 4 × 4 points" in note and "Pressure (the largest)" in note for note in made["notes"])
    pressure = next(item for item in made["maps"] if item["name"] == "pressure")["arrays"][0]
    assert pressure["shape"] == [16, 8]
    assert pressure["cell"] == [4 * 2e-8, 4 * 1e-8]
    blocks = result.pressure.reshape(16, 4, 8, 4).max(axis=(1, 3))
    np.testing.assert_allclose(np.nan_to_num(decoded(pressure)), blocks, atol=0.51 * pressure["step"])


def test_arrays_take_no_more_than_the_budget(path: asp.HistoryResult) -> None:
    outcome = analysed(path.last, {"path": True, "plasticity": True}, path)
    for budget in (BUDGET, 8000, 4000):
        made = scene_of(outcome, budget=budget)
        assert made is not None
        assert sum(len(array["data"]) for item in made["maps"] for array in item["arrays"]) <= budget
    assert any("Shown coarser" in note for note in made["notes"])
    made = scene_of(outcome, budget=8000)
    assert made is not None
    first, number = made["steps"]["first"], path.peak + 1
    for item in made["maps"]:
        for array in item["arrays"] if item["along"] == "steps" else ():
            assert array["cell"] >= item["arrays"][first]["cell"]
            coarser = array["cell"] > item["arrays"][first]["cell"]
            said = any(
                f"{item['title']} (" in note and f"in all steps but step {number}" in note for note in made["notes"]
            )
            assert coarser <= said


@pytest.mark.parametrize("share", [0.3, 0.5, 0.9])
def test_the_decisive_step_keeps_its_points_while_others_are_coarsened(path: asp.HistoryResult, share: float) -> None:
    outcome = analysed(path.last, {"path": True, "plasticity": True}, path)
    whole = scene_of(outcome)
    assert whole is not None
    first = whole["steps"]["first"]
    decisive = sum(len(item["arrays"][first if item["along"] else 0]["data"]) for item in whole["maps"])
    every = sum(len(array["data"]) for item in whole["maps"] for array in item["arrays"])
    made = scene_of(outcome, budget=int(decisive + share * (every - decisive)))
    assert made is not None
    for item, fine in zip(made["maps"], whole["maps"], strict=True):
        place = first if item["along"] else 0
        assert item["arrays"][place] == fine["arrays"][place], "its points are those that were computed"
    assert any(array["cell"][0] > made["cell"][0] for item in made["maps"] for array in item["arrays"])


def test_a_scene_is_the_same_from_a_file(path: asp.HistoryResult, tmp_path: Path) -> None:
    outcome = analysed(path.last, {"contact": True, "path": True, "plasticity": True}, path)
    save_outcome(outcome, tmp_path / "r.nc")
    found, made = scene_of(load_outcome(tmp_path / "r.nc")), scene_of(outcome)
    assert found is not None
    assert made is not None
    (back,), (gaps,) = ([item for item in scene["maps"] if item["name"] == "gap"] for scene in (found, made))
    for one, other in zip(back.pop("arrays"), gaps.pop("arrays"), strict=True):
        # the gaps of the steps of a path come back within their rounding, so that a value may fall
        # into the next of the equal steps
        np.testing.assert_allclose(decoded(one), decoded(other), rtol=0.0, atol=1.01 * other["step"])
        assert one["low"] == pytest.approx(other["low"], rel=1e-9)
    assert found == made


def test_a_grid_of_one_row_has_no_maps() -> None:
    surface = asp.Surface(
        np.cos(np.linspace(0.0, 2.0 * np.pi, 32, endpoint=False))[:, None] * 1e-9, 1e-8, periodic=True
    )
    result = asp.solve(asp.ContactProblem(surface, asp.Elastic(1e11, 0.3)), asp.MeanPressure(1e7))
    assert scene_of(analysed(result, {})) is None


def test_text_within_a_page_ends_no_element() -> None:
    assert "<" not in as_json({"name": "</script><b>"})
    with pytest.raises(ValueError, match="JSON"):
        as_json(float("nan"))


def test_tractions_and_surfaces_have_maps_too(tmp_path: Path) -> None:
    loads = {"points": [24, 16], "size": "2.4 um x 1.6 um", "boundary": "free"}
    patch = {"kind": "patch", "x": ["0.8 um", "1.6 um"], "y": ["0.5 um", "1 um"], "pressure": "1 GPa"}
    stress = {"depths": ["0.1 um"], "sections": ["y=0.8um"]}
    document = {"version": 2, "body": "steel", "tractions": {**loads, "loads": [patch]}, "stress": stress}
    outcome = asp.run(document)
    made = scene((figure for group in outcome.figures.values() for figure in group), outcome.result.problem.grid)
    assert made is not None
    assert [item["name"] for item in made["maps"]] == ["planes"]
    assert made["depths"]["texts"] == ["depth 100 nm"]
    assert made["maps"][0]["shown"]
    assert len(made["sections"]) > 0
    found = asp.characterise(asp.Surface(np.random.default_rng(2).standard_normal((32, 32)) * 1e-9, 1e-8))
    asp.report.write_roughness_report(found, tmp_path / "r.html")
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert page.count("<div data-viewer>") == 1
    assert page.count('class="av-instead"') == 1


def test_pages_of_large_maps_keep_to_the_budget() -> None:
    noise = np.random.default_rng(1).standard_normal((1024, 1024))
    array = coded(noise, (1.0, 1.0))
    assert len(array["data"]) < 3_000_000, "even noise takes less than 3 MB"
    assert np.abs(decoded(array) - noise).max() <= 0.5 * array["step"] * (1.0 + 1e-9)
