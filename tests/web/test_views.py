"""What the page of a run shows while it goes on and afterwards: scenes, arrays, progress."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

from asperity.core.arrays import RealArray
from asperity.core.errors import AsperityError
from asperity.parts.part import Solved
from asperity.plots.maps import contact_kinds, gap_field, pressure_field
from asperity.report.scene import MASKED
from asperity.run.build import build
from asperity.run.document import checked, dumps
from asperity.run.execute import Outcome, execute
from asperity.run.stored import save_outcome
from asperity.web import progress, tasks
from asperity.web.progress import Watch, reported, time_left
from asperity.web.views import ARRAYS, SCENE, SHOWN, SPACE, Views, spots_file

pytestmark = pytest.mark.usefixtures("unrendered")

TABLE: dict[str, Any] = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [48, 32],
        "size": "1.5 um x 1 um",
        "seed": 3,
        "spectrum": {"kind": "gaussian", "rms_height": "2 nm", "correlation_length": "0.2 um"},
    },
    "body": {"material": "steel"},
    "control": {"path": {"mean_pressure": ["60 MPa", "5 MPa"], "steps": 3}},
}


def run(reached: Callable[[Solved], None] | None = None, **more: Any) -> Outcome:
    return execute(build(checked({**TABLE, **more}), Path()), reached=reached)


def read(file: Path) -> tuple[dict[str, Any], RealArray]:
    """What an array is, and its values (nx, ny)."""
    head, _, data = file.read_bytes().partition(b"\n")
    about = json.loads(head)
    numbers = np.frombuffer(data, "u1" if about["bits"] == 8 else "<u2").reshape(about["shape"][::-1]).T
    values = about["low"] + about["step"] * numbers.astype(float)
    return about, np.where(numbers == MASKED[about["bits"]], np.nan, values)


def scene_in(folder: Path) -> Any:
    return json.loads((folder / f"run{SCENE}").read_text(encoding="utf-8"))


def test_every_step_is_told_before_anything_is_computed_of_it() -> None:
    seen: list[Solved] = []
    outcome = run(seen.append)
    assert outcome.path is not None
    assert len(seen) == len(outcome.path.steps) == 6
    for number, solved in enumerate(seen, start=1):
        assert solved.path is not None
        assert len(solved.path.steps) == number
        np.testing.assert_array_equal(solved.result.pressure, outcome.path.steps[number - 1].pressure)
        assert not solved.found
    alone: list[Solved] = []
    one = run(alone.append, control={"mean_pressure": "60 MPa"})
    assert [solved.result.force for solved in alone] == [one.result.force]
    assert alone[0].path is None


def test_arrays_are_those_of_the_maps_at_every_step(tmp_path: Path) -> None:
    outcome = run()
    views = Views(tmp_path / "run")
    views.page(outcome)
    views.end()
    scene = scene_in(tmp_path)
    fields = {"pressure": pressure_field, "gap": gap_field}
    assert outcome.path is not None
    for entry in scene["maps"]:
        if entry["along"] != "steps":
            continue
        assert len(entry["arrays"]) == 6
        for array, result in zip(entry["arrays"], outcome.path.steps, strict=True):
            assert list(array) == ["url"], "nothing of it is in the scene"
            about, values = read(tmp_path / f"run{ARRAYS}" / array["url"])
            assert about["cell"] == list(result.problem.grid.spacing)
            if entry["name"] == "contact":
                np.testing.assert_array_equal(values, contact_kinds(result).kinds)
                assert sum(about["shares"]) == pytest.approx(1.0, rel=1e-12)
            else:
                wanted = fields[entry["name"]](result).values
                np.testing.assert_array_equal(np.isnan(values), np.isnan(wanted))
                there = ~np.isnan(wanted)
                assert np.all(np.abs(values - wanted)[there] <= 0.5 * about["step"] * (1.0 + 1e-6))
    names = {array["url"] for entry in scene["maps"] for array in entry["arrays"]}
    spots = {spots_file(number) for number in scene["steps"]["numbers"]}
    assert {file.name for file in (tmp_path / f"run{ARRAYS}").iterdir()} == names | spots | {SPACE}


def test_the_range_of_a_map_holds_its_decisive_step(tmp_path: Path) -> None:
    outcome = run()
    views = Views(tmp_path / "run")
    views.page(outcome)
    views.end()
    pressure = next(entry for entry in scene_in(tmp_path)["maps"] if entry["name"] == "pressure")
    assert pressure["range"][1] >= outcome.solved.at().result.max_pressure * (1.0 - 1e-12)


def test_maps_of_a_run_that_goes_on_are_those_of_the_steps_so_far(tmp_path: Path) -> None:
    views, counts = Views(tmp_path / "run"), []

    def show(solved: Solved) -> None:
        views.maps(solved)
        scene = scene_in(tmp_path)
        counts.append(len(scene["steps"]["numbers"]) if scene["steps"] else 1)
        assert not (tmp_path / f"run{SHOWN}").is_file()

    outcome = run(show)
    assert counts == [1, 2, 3, 4, 5, 6]
    views.page(outcome)
    views.end()
    arrays = tmp_path / f"run{ARRAYS}"
    assert outcome.path is not None
    early = next(entry for entry in scene_in(tmp_path)["maps"] if entry["name"] == "pressure")["arrays"][1]["url"]
    _, values = read(arrays / early)
    np.testing.assert_allclose(np.nanmax(values), outcome.path.steps[1].max_pressure, rtol=1e-12)


def test_spots_are_those_of_each_step(tmp_path: Path) -> None:
    outcome = run()
    views = Views(tmp_path / "run")
    views.page(outcome)
    views.end()
    assert outcome.path is not None
    for number, result in enumerate(outcome.path.steps, start=1):
        found = json.loads((tmp_path / f"run{ARRAYS}" / spots_file(number)).read_text(encoding="utf-8"))
        assert sum(row[3] for row in found["rows"]) == pytest.approx(result.force, rel=1e-12)


def test_what_is_there_is_not_made_again(tmp_path: Path) -> None:
    outcome = run(control={"mean_pressure": "60 MPa"})
    found = []
    for _ in range(2):
        views = Views(tmp_path / "run")
        views.page(outcome)
        views.end()
        found.append({file: file.stat().st_mtime_ns for file in (tmp_path / f"run{ARRAYS}").iterdir()})
    assert found[0] == found[1]


def test_planes_in_the_body_are_there_when_a_result_is_opened_again(tmp_path: Path) -> None:
    more = {"control": {"mean_pressure": "60 MPa"}, "stress": {}}
    document = checked({**TABLE, **more})
    save_outcome(run(**more), tmp_path / "result.nc", document=dumps(document))
    answer = tasks.views({"result": str(tmp_path / "result.nc"), "views": str(tmp_path / "run")})
    assert answer == {}

    def planes() -> list[Any]:
        return [entry["arrays"] for entry in scene_in(tmp_path)["maps"] if entry["name"] == "planes"]

    end = time.monotonic() + 60.0
    while not planes() and time.monotonic() < end:
        time.sleep(0.05)
    assert len(planes()[0]) > 5


def test_what_keeps_an_array_from_being_written_is_raised(tmp_path: Path) -> None:
    def broken() -> Any:
        raise AsperityError("no such map")

    views = Views(tmp_path / "run")
    views.array("broken", broken)
    with pytest.raises(AsperityError):
        views.end()


# How far a run is.


class Clock:
    """Time that passes only when it is told to."""

    def __init__(self) -> None:
        self.now = 100.0

    def monotonic(self) -> float:
        return self.now


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    made = Clock()
    monkeypatch.setattr(progress, "time", made)
    return made


def test_step_time_left_and_curve_are_reported(tmp_path: Path, clock: Clock) -> None:
    steps: list[Solved] = []
    run(steps.append)
    file, shown = tmp_path / "progress", []
    watch = Watch(file, shown.append, len(steps))
    with watch.stage("solving 6 steps") as told:
        for number, solved in enumerate(steps, start=1):
            clock.now += 10.0
            told.update(3, 1e-3, 1e-7)
            assert reported(file).text.startswith(f"step {number} of 6, iteration 3")
            watch.reached(solved)
            state = reported(file)
            assert state.share == pytest.approx(number / 6)
            assert state.left == pytest.approx(10.0 * (6 - number)), "each step has taken ten seconds"
            assert state.curve == [[s.result.mean_pressure, s.result.area_fraction] for s in steps[:number]]
    assert f"step 6 of 6, {time_left(0.0)}" in reported(file).in_words
    assert shown == steps, "showing them takes no time here"


def test_showing_steps_takes_a_share_of_the_time_at_most(tmp_path: Path, clock: Clock) -> None:
    steps: list[Solved] = []
    run(steps.append)
    shown = []

    def show(solved: Solved) -> None:
        shown.append(solved)
        clock.now += 3.0

    watch = Watch(tmp_path / "progress", show, 400)
    began = clock.now
    with watch.stage("solving"):
        for _ in range(399):
            clock.now += 1.0
            watch.reached(steps[0])
    assert len(shown) > 5
    assert 3.0 * len(shown) <= progress.SHARE * (clock.now - began) + 3.0
    watch.reached(steps[0])
    assert len(shown) > 6, "the last step is shown in any case"


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(2.0, "a few seconds left"), (12.0, "about 10 s left"), (150.0, "about 2 min left"), (9000.0, "about 2.5 h left")],
)
def test_time_left_in_words(seconds: float, words: str) -> None:
    assert time_left(seconds) == words
