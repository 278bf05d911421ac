"""Viscoelastic contacts on the command line and in documents: the numbers of Python, files and
figures made again, studies, and what is refused."""

from __future__ import annotations

import csv
import functools
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cli.conftest import Runner
from study_cases import InProcess, plan

import asperity as asp
from asperity.contact.roughness import roughness_of
from asperity.core.errors import InputError
from asperity.physics.viscoelastic.moments import COLUMNS
from asperity.physics.viscoelastic.part import SCALARS, STEPS
from asperity.physics.viscoelastic.part_hysteresis import COLUMNS as SPEED_COLUMNS
from asperity.physics.viscoelastic.part_hysteresis import SCALARS as SLIDING
from asperity.physics.viscoelastic.transient_sliding import COLUMNS as WAY
from asperity.run.build import build
from asperity.run.document import checked, dumps, loads
from asperity.run.stored import load_outcome, save_outcome
from asperity.studies.collect import dataset
from asperity.studies.run import carry_out

POLYMER = "E=0.5GPa+1.2GPa@0.1s+0.8GPa@5s,nu=0.38,bulk=elastic,name=polymer"
BALL: dict[str, Any] = {
    "version": 2,
    "surface": {"kind": "sphere", "points": [20, 20], "size": "10 um", "radius": "20 um"},
    "body": f"{POLYMER}:2um/E=70GPa,nu=0.22",
    "boundary": {"kind": "free"},
    "control": {"path": {"force": ["2 mN", "1 mN"]}},
    "viscoelastic": {"ramp": ["0 s", "0.5 s"], "hold": "10 s", "tolerance": 0.01},
}
RUBBER = "E=3MPa+3MPa@0.1s+10MPa@10ms,nu=0.5,name=rubber,WLF=298K;8.86;101.6K"
GROUND: dict[str, Any] = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [32, 32],
        "size": "2 mm",
        "seed": 2,
        "spectrum": {
            "kind": "self_affine",
            "rms_height": "10 um",
            "hurst": 0.8,
            "rolloff_wavelength": "1 mm",
            "shortest_wavelength": "0.25 mm",
        },
    },
    "body": "rigid",
    "counter_body": RUBBER,
    "control": {"mean_pressure": "0.2 MPa"},
    "hysteresis": {"speed": "1 cm/s"},
}
ROLLER: dict[str, Any] = {
    "version": 2,
    "surface": BALL["surface"],
    "body": "rigid",
    "counter_body": "E=3MPa+3MPa@0.1s,nu=0.5",
    "boundary": {"kind": "free"},
    "control": {"force": "1 uN"},
    "hysteresis": {"speed": "20 um/s"},
}
OPTIONS = ("--level", "none", "--body", BALL["body"], "--boundary", "free")
IN_TIME = ("--ramp", "0s,0.5s", "--hold", "10s", "--time-tolerance", "0.01")


def in_python() -> asp.HistoryResult:
    """The history of the document ``BALL``."""
    polymer = asp.Viscoelastic.prony(0.5e9, ((1.2e9, 0.1), (0.8e9, 5.0)), 0.38, elastic_bulk=True)
    body = asp.Layered([asp.Layer(polymer, 2e-6)], asp.Elastic(70e9, 0.22))
    problem = asp.ContactProblem(build(checked(BALL)).problem.surface, body, boundary=asp.Free())
    high, low = asp.Force(2e-3), asp.Force(1e-3)
    course = [high, asp.Step(high, duration=10.0), asp.Step(low, duration=0.5), asp.Step(low, duration=10.0)]
    return asp.solve(problem, asp.History(course), time_steps=asp.TimeSteps(0.01))


@functools.cache
def of_start() -> asp.studies.Outcome:
    """Outcome of the document ``START``, which several tests compare with others."""
    return asp.run(START)


@pytest.mark.slow
def test_a_coated_ball_in_time_and_its_files(run: Runner, tmp_path: Path) -> None:
    """Options give the numbers of Python; the file holds them, gives words and pictures again, and
    a restart from every step."""
    asp.files.save_surface(build(checked(BALL)).problem.surface, tmp_path / "ball.nc")
    out = tmp_path / "out"
    done = run("contact", tmp_path / "ball.nc", *OPTIONS, "--path", "2mN,1mN", *IN_TIME, "--out", out)
    assert done.exit_code == 0, done.output
    found, outcome = in_python(), load_outcome(out / "result.nc")
    creeping = [step.creep for step in found.steps if step.creep is not None]
    values, columns = outcome.values, outcome.found["viscoelastic"].values
    assert values["viscoelastic_time"] == pytest.approx(20.5)
    assert values["viscoelastic_heat"] == pytest.approx(sum(each.dissipated for each in creeping), rel=1e-6)
    assert values["viscoelastic_stored"] == pytest.approx(creeping[-1].stored_energy, rel=1e-6)
    assert values["viscoelastic_work"] == pytest.approx(sum(each.work for each in creeping), rel=1e-6)
    np.testing.assert_allclose(columns["step_heat"], [each.dissipated for each in creeping], rtol=1e-5, atol=1e-18)
    np.testing.assert_allclose(columns["step_end"], [0.0, 10.0, 10.5, 20.5])
    ends = [int(at) for at in columns["step_moment"]]
    np.testing.assert_allclose(columns["moment_approach"][ends], found.approach, rtol=1e-6)
    np.testing.assert_allclose(columns["moment_time"][ends], columns["step_end"])
    assert (np.diff(columns["moment_dissipated"]) >= 0.0).all()
    tree = asp.files.open_tree(out / "result.nc")
    for item in (*SCALARS, *STEPS):
        assert tree[f"viscoelastic/{item.name}"].attrs["units"] == item.unit
    for item in COLUMNS:
        assert tree[f"viscoelastic/moment_{item.name}"].dims == ("moment",)
    made = {path.stem for path in (out / "plots").iterdir()}
    assert {figure.name for figure in outcome.figures["viscoelastic"]} <= made
    assert {
        "area_in_time",
        "approach_in_time",
        "load_in_time",
        "energy_in_time",
        "relaxation",
        "complex_moduli",
    } <= made
    (words,) = (words for part, words in outcome.sections if part.name == "viscoelastic")
    assert words.sentence in " ".join(done.output.split())
    with (out / "scalars.csv").open(encoding="utf-8") as file:
        rows = {row["name"]: row["value"] for row in csv.DictReader(file)}
    assert float(rows["viscoelastic_heat"]) == values["viscoelastic_heat"]
    again = run("report", out / "result.nc", "--out", tmp_path / "again.html")
    assert again.exit_code == 0, again.output
    assert words.sentence in (tmp_path / "again.html").read_text(encoding="utf-8")
    assert outcome.path is not None
    rest = asp.solve(
        found.steps[0].problem,
        asp.Step(asp.Force(2e-3), duration=10.0),
        state=outcome.path.steps[0].state,
        time_steps=asp.TimeSteps(0.01),
    )
    np.testing.assert_allclose(rest.pressure, found.steps[1].pressure, atol=1e-5 * rest.max_pressure)


def test_single_load_held_and_cycles(run: Runner) -> None:
    """One time for all loads; equal steps of time; every cycle has the same turning points."""
    single = asp.run(BALL | {"control": {"force": "2 mN"}, "viscoelastic": {"hold": "1 s", "steps": 3}})
    assert single.path is not None
    assert [step.control for step in single.path.steps] == [asp.Force(2e-3)] * 2
    np.testing.assert_allclose(single.found["viscoelastic"].values["moment_time"], [0.0, 0.0, 1 / 3, 2 / 3, 1.0])
    control = {"path": {"approach": ["50 nm", "10 nm"], "steps": 3}}
    cycles = asp.run(BALL | {"control": control, "viscoelastic": {"ramp": "1 s", "repeat": 2, "steps": 4}})
    assert cycles.path is not None
    np.testing.assert_allclose(cycles.path.approach, [50e-9, 10e-9] * 2)
    heats = cycles.found["viscoelastic"].values["step_heat"]
    assert (heats > 0.0).all()
    gaps = {"path": {"mean_gap": ["400 nm", "380 nm"], "steps": 2}}
    flat = asp.run(BALL | {"control": gaps, "viscoelastic": {"ramp": "1 s", "steps": 3}})
    assert flat.path is not None
    np.testing.assert_allclose(flat.path.mean_gap, [400e-9, 380e-9], rtol=1e-6)


def test_at_once_is_the_first_instant_and_a_finding_says_so() -> None:
    """Without times the contact is that of the elastic solid of the first instant, and nothing
    becomes heat."""
    table = {key: value for key, value in BALL.items() if key != "viscoelastic"} | {"control": {"force": "2 mN"}}
    outcome = asp.run(table)
    elastic = asp.run(table | {"body": "E=2.5GPa,nu=0.38:2um/E=70GPa,nu=0.22"})
    np.testing.assert_allclose(
        outcome.result.pressure, elastic.result.pressure, atol=1e-4 * elastic.result.max_pressure
    )
    assert outcome.values["viscoelastic_heat"] == 0.0
    assert "first instant" in {finding.criterion for finding in outcome.findings}
    assert {figure.name for figure in outcome.figures["viscoelastic"]} == {"relaxation", "complex_moduli"}
    assert "viscoelastic" not in elastic.found


def test_steps_of_approach_and_parting_take_the_time_of_the_ramp() -> None:
    adhesion = {"work": "5 mJ/m**2", "range": "20 nm", "retract": "40 nm", "steps": 4}
    soft = {"surface": {"kind": "sphere", "points": [24, 24], "size": "2 um", "radius": "5 um"}}
    table = BALL | soft | {"body": "E=3MPa+10MPa@10ms,nu=0.45", "control": {"approach": "10 nm"}, "adhesion": adhesion}
    outcome = asp.run(table | {"viscoelastic": {"ramp": "5 ms", "steps": 3}})
    np.testing.assert_allclose(outcome.found["viscoelastic"].values["step_end"], 5e-3 * np.arange(1, 10))
    assert outcome.values["viscoelastic_heat"] > 0.0
    assert outcome.values["pull_off_force"] > 0.0


def test_oscillation_is_the_shortcut_of_python() -> None:
    table = BALL | {"control": {"force": "2 mN"}, "viscoelastic": {"frequency": "1 Hz", "amplitude": "1 nm"}}
    outcome = asp.run(table)
    response = asp.viscoelasticity.harmonic(outcome.result, 1.0)
    assert outcome.values["storage_stiffness"] == pytest.approx(response.stiffness.real, rel=1e-9)
    assert outcome.values["loss_tangent"] == pytest.approx(response.loss_tangent, rel=1e-9)
    assert outcome.values["oscillation_heat"] == pytest.approx(response.heat(1e-9), rel=1e-9)
    apart = asp.run(table | {"control": {"path": {"force": ["2 mN", "0"]}}})
    assert math.isnan(apart.values["loss_tangent"])
    assert "oscillation" in {finding.criterion for finding in apart.findings}


def test_temperature_moves_all_times() -> None:
    """A load held at a temperature is the same held shorter or longer by the shift at the
    reference."""
    factor = asp.viscoelasticity.WilliamsLandelFerry(298.0, 8.86, 101.6).factor(310.0)
    base = GROUND | {"hysteresis": None, "control": {"mean_pressure": "0.1 MPa"}}
    base = {key: value for key, value in base.items() if value is not None}
    warm = asp.run(base | {"viscoelastic": {"hold": "10 ms", "temperature": "310 K", "steps": 4}})
    longer = asp.run(base | {"viscoelastic": {"hold": f"{10e-3 / factor} s", "steps": 4}})
    assert factor < 0.2
    np.testing.assert_allclose(warm.result.pressure, longer.result.pressure, atol=1e-6 * warm.result.max_pressure)
    assert warm.values["viscoelastic_heat"] == pytest.approx(longer.values["viscoelastic_heat"], rel=1e-6)


@pytest.mark.slow
def test_rubber_on_rough_ground_and_its_files(run: Runner, tmp_path: Path) -> None:
    """Friction of Python with Persson's theory beside it, a curve against speed, and all of it
    again from the file."""
    document = tmp_path / "ground.toml"
    table = GROUND | {"hysteresis": {"speed": "1 cm/s", "slowest": "1 mm/s", "fastest": "0.1 m/s", "points": 3}}
    document.write_text(dumps(checked(table)), encoding="utf-8")
    done = run("contact", "--from", document, "--out", tmp_path / "out")
    assert done.exit_code == 0, done.output
    outcome = load_outcome(tmp_path / "out" / "result.nc")
    values = outcome.values
    problem = build(checked(GROUND)).problem
    found = asp.slide(problem, asp.MeanPressure(0.2e6), 0.01)
    assert values["hysteresis_friction"] == pytest.approx(found.friction, rel=1e-9)
    assert values["hysteresis_heat"] == pytest.approx(found.heat, rel=1e-9)
    assert values["sliding_area_fraction"] == found.normal.area_fraction_corrected
    spectrum = roughness_of(problem.surface).spectrum
    assert spectrum is not None
    assert isinstance(problem.counter_body, asp.Viscoelastic)
    holds = spectrum.psd > 0.0
    theory = asp.theories.rubber_friction(
        asp.theories.IsotropicSpectrum(spectrum.q[holds], spectrum.psd[holds]),
        problem.counter_body.contact_relaxation.complex_modulus,
        speed=0.01,
        pressure=0.2e6,
    )
    assert values["persson_friction"] == pytest.approx(theory.friction, rel=1e-6)
    assert values["persson_sliding_area_fraction"] == pytest.approx(theory.area_fraction, rel=1e-6)
    columns = outcome.found["hysteresis"].values
    np.testing.assert_allclose(columns["by_speed_speed"], [1e-3, 1e-2, 0.1])
    assert columns["by_speed_friction"][1] == pytest.approx(found.friction, rel=1e-6)
    assert (np.diff(columns["by_speed_area_fraction"]) < 0.0).all()
    tree = asp.files.open_tree(tmp_path / "out" / "result.nc")
    for item in (*SLIDING, *SPEED_COLUMNS):
        assert tree[f"hysteresis/{item.name}"].attrs["units"] == item.unit
    np.testing.assert_allclose(
        tree["hysteresis/sliding_pressure"], found.normal.pressure, atol=1e-6 * found.normal.max_pressure
    )
    made = {path.stem for path in (tmp_path / "out" / "plots").iterdir()}
    assert {figure.name for figure in outcome.figures["hysteresis"]} <= made
    assert {"sliding_pressure", "friction_by_speed", "area_by_speed"} <= made
    assert "first instant" not in {finding.criterion for finding in outcome.findings}
    (words,) = (words for part, words in outcome.sections if part.name == "hysteresis")
    assert words.sentence in " ".join(done.output.split())


START: dict[str, Any] = GROUND | {
    "surface": GROUND["surface"] | {"points": [16, 16]},
    "hysteresis": {"speed": "1 cm/s", "distance": "1 mm", "steps_per_pixel": 1},
}


def test_start_of_sliding_and_its_files(tmp_path: Path) -> None:
    """Friction and area along the way are those of Python, in the outcome and its file, with
    figures and words."""
    outcome = of_start()
    found = asp.viscoelasticity.slide_in_time(
        build(checked(START)).problem, asp.MeanPressure(0.2e6), 0.01, 1e-3, steps_per_pixel=1
    )
    values = outcome.found["sliding_start"].values
    for item in WAY:
        np.testing.assert_array_equal(values[f"way_{item.name}"], found.column(item.name))
    np.testing.assert_array_equal(values["way_friction"], found.friction)
    assert len(values["way_time"]) == 9
    assert outcome.values["start_last_friction"] == found.mean_friction(0.25e-3)
    assert outcome.values["start_last_heat_friction"] == found.mean_loss(0.25e-3)
    assert outcome.values["start_last_area_fraction"] == found.column("area_fraction")[-1]
    save_outcome(outcome, tmp_path / "start.nc")
    again = load_outcome(tmp_path / "start.nc")
    np.testing.assert_array_equal(again.found["sliding_start"].values["way_friction"], found.friction)
    names = {"friction_at_start", "area_at_start", "energy_at_start", "pressure_after_start"}
    assert {figure.name for figure in again.figures["sliding_start"]} == names
    texts = [next(words for part, words in each.sections if part.name == "sliding_start") for each in (outcome, again)]
    assert f"(steady: {outcome.values['hysteresis_friction']:.3g})" in texts[0].sentence
    assert texts[0].sentence == texts[1].sentence


ATTRACTED: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "adhesion": (
        {"adhesion": {"law": "exponential", "work": "50 mJ/m^2", "range": "0.5 um"}},
        {"adhesion": asp.ExponentialAdhesion(0.05, 0.5e-6)},
    ),
    "film": (
        {"film": {"liquid": "water", "thickness": "0.3 um"}},
        {"film": asp.LiquidFilm.of(asp.liquid("water"), 0.3e-6)},
    ),
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", ATTRACTED)
def test_sliding_of_surfaces_that_attract_each_other(kind: str, tmp_path: Path) -> None:
    """Adhesion and menisci stand beside sliding in documents with the numbers of Python, at rest,
    on the way and steadily; Persson's theory is left out."""
    table, physics = ATTRACTED[kind]
    dry, outcome = of_start(), asp.run(START | table)
    problem = replace(build(checked(START)).problem, **physics)
    load = asp.MeanPressure(0.2e6)
    steady, start = (
        asp.slide(problem, load, 0.01),
        asp.viscoelasticity.slide_in_time(problem, load, 0.01, 1e-3, steps_per_pixel=1),
    )
    assert outcome.values["hysteresis_friction"] == pytest.approx(steady.friction, rel=1e-9)
    assert outcome.values["start_last_friction"] == pytest.approx(start.mean_friction(0.25e-3), rel=1e-9)
    assert outcome.values["hysteresis_friction"] > dry.values["hysteresis_friction"]
    assert outcome.values["sliding_area_fraction"] > dry.values["sliding_area_fraction"]
    assert math.isnan(outcome.values["persson_friction"])
    save_outcome(outcome, tmp_path / "sliding.nc")
    again = load_outcome(tmp_path / "sliding.nc")
    for each in (outcome, again):
        words = next(words for part, words in each.sections if part.name == "hysteresis")
        assert f"friction of {steady.friction:.3g}" in words.sentence
        assert "knows no attraction" in " ".join(words.remarks)


def test_start_of_sliding_that_leaves_its_grid_is_a_finding() -> None:
    table = ROLLER | {"hysteresis": ROLLER["hysteresis"] | {"distance": "2 um", "steps_per_pixel": 1}}
    assert "edge of the grid" not in {finding.criterion for finding in asp.run(table).findings}
    far = asp.run(table | {"hysteresis": ROLLER["hysteresis"] | {"distance": "4.5 um", "steps_per_pixel": 1}})
    assert "edge of the grid" in {finding.criterion for finding in far.findings}


def test_sliding_along_a_line_and_over_a_coating_has_no_theory_beside_it() -> None:
    coated = GROUND | {"counter_body": f"{RUBBER}:0.2mm/steel"}
    line = GROUND | {
        "surface": {
            "kind": "sinusoid",
            "points": [32, 1],
            "size": "1 mm x 1 mm",
            "amplitude": "2 um",
            "wavelength": "1 mm",
        }
    }
    for table in (coated, line):
        values = asp.run(table).values
        assert values["hysteresis_friction"] > 0.0
        assert math.isnan(values["persson_friction"])


def test_a_ball_that_slides_on_a_free_grid() -> None:
    """Numbers are those of Python; there is no theory of rough surfaces beside it."""
    outcome = asp.run(ROLLER)
    found = asp.slide(outcome.result.problem, asp.Force(1e-6), 20e-6)
    assert outcome.values["hysteresis_friction"] == pytest.approx(found.friction, rel=1e-9)
    assert found.friction > 0.005
    assert math.isnan(outcome.values["persson_friction"])


def test_long_steps_of_time_and_steep_slopes_are_findings() -> None:
    spectrum = GROUND["surface"]["spectrum"] | {"rms_height": "1 mm"}
    steep = GROUND | {"control": {"mean_pressure": "60 MPa"}, "surface": GROUND["surface"] | {"spectrum": spectrum}}
    assert "steep slopes" in {finding.criterion for finding in asp.run(steep).findings}
    held = BALL | {"control": {"force": "2 mN"}, "viscoelastic": {"hold": "100 s", "steps": 3}}
    coarse = asp.run(held, on_failure="return")
    assert "steps of time" in {finding.criterion for finding in coarse.findings}
    assert not coarse.converged  # 20 % of the work is neither stored nor heat
    assert coarse.path.steps[-1].creep.energy_error > 0.05
    fine = asp.run(held | {"viscoelastic": {"hold": "100 s", "tolerance": 0.002}})
    assert "steps of time" not in {finding.criterion for finding in fine.findings}


def test_energies_that_miss_are_said_on_the_command_line(run: Runner, tmp_path: Path) -> None:
    """Equal steps of time that part a ball held in place: exit code 1 and the words, in files too;
    with steps by their error 0."""
    asp.files.save_surface(build(checked(BALL)).problem.surface, tmp_path / "ball.nc")
    body = ("--level", "none", "--body", "E=3MPa+297MPa@1ms,nu=0.5", "--boundary", "free", "--approach", "0.3um")
    words = ("contact", tmp_path / "ball.nc", *body, "--hold", "60ms")
    bad = run(*words, "--time-steps", "16", "--out", tmp_path / "bad")
    assert bad.exit_code == 1, bad.output
    outcome = load_outcome(tmp_path / "bad" / "result.nc")
    assert not outcome.converged
    assert outcome.path.steps[-1].creep.energy_error > 0.05
    good = run(*words)
    assert good.exit_code == 0, good.output


@pytest.mark.parametrize("body", ["E=3MPa+13MPa@10ms,nu=0.45", "E=3MPa+13MPa@10ms,nu=0.45:2um/E=70GPa,nu=0.22"])
def test_stick_and_slip_in_time(body: str) -> None:
    """Steps along the surfaces take the time of the ramp; numbers are those of Python, and a path
    keeps its turning points and all shear steps."""
    rubber = {"body": body, "counter_body": "rigid", "friction": {"coefficient": 0.4}}
    surface = BALL["surface"] | {"points": [16, 16]}
    table = BALL | rubber | {"surface": surface, "control": {"force": "20 uN"}, "shear": {"shift": "100 nm"}}
    outcome = asp.run(table | {"viscoelastic": {"ramp": "10 ms", "hold": "20 ms", "steps": 4}})
    load, shift = asp.Force(20e-6), asp.Shift(100e-9)
    pressed = [asp.Step(load, asp.Shift(), duration=time) for time in (10e-3, 20e-3)]
    course = [*pressed, *(asp.Step(load, shift, duration=time) for time in (10e-3, 20e-3))]
    problem = build(checked(table)).problem
    found = asp.solve(problem, asp.History(course), time_steps=asp.TimeSteps(number=4))
    assert outcome.values["viscoelastic_heat"] == pytest.approx(
        sum(step.creep.dissipated for step in found.steps), rel=1e-9
    )
    assert outcome.values["total_dissipated"] == pytest.approx(found.last.stick_slip.total_dissipated, rel=1e-9)
    path = {
        "control": {"path": {"force": ["10 uN", "20 uN"], "steps": 2}},
        "shear": {"shift": ["50 nm", "0 nm"], "steps": 2},
    }
    legs = asp.run(table | path | {"viscoelastic": {"ramp": "10 ms", "steps": 3}})
    assert legs.path is not None
    assert [step.force for step in legs.path.steps[:3]] == pytest.approx([10e-6, 20e-6, 20e-6])
    assert [step.stick_slip.shift_x for step in legs.path.steps] == pytest.approx([0.0, 0.0, 25e-9, 50e-9, 25e-9, 0.0])


def test_documents_keep_their_text() -> None:
    for table in (BALL, GROUND):
        document = checked(table)
        assert loads(dumps(document)) == document
        assert loads(dumps(document, form="json"), form="json") == document


ELASTIC = {"body": "E=2GPa,nu=0.4"}
REFUSED: dict[str, tuple[dict[str, Any], dict[str, Any], str]] = {
    "nothing relaxes": (BALL, ELASTIC, "body or counter_body"),
    "times for other loads": (BALL, {"viscoelastic": {"ramp": ["1 s", "2 s", "3 s"]}}, "viscoelastic.ramp"),
    "negative time": (BALL, {"viscoelastic": {"hold": "-1 s"}}, "viscoelastic.hold[1]"),
    "time without unit": (BALL, {"viscoelastic": {"hold": 3}}, "viscoelastic.hold"),
    "repeated at once": (BALL, {"viscoelastic": {"repeat": 2}}, "viscoelastic.repeat"),
    "amplitude alone": (BALL, {"viscoelastic": {"amplitude": "1 nm"}}, "viscoelastic.amplitude"),
    "temperature without shift": (BALL, {"viscoelastic": {"temperature": "310 K"}}, "viscoelastic solid polymer"),
    "too cold": (GROUND, {"viscoelastic": {"temperature": "190 K"}}, "temperature (K)"),
    "no speed": (GROUND, {"hysteresis": {}}, "hysteresis"),
    "half a curve": (GROUND, {"hysteresis": {"speed": "1 m/s", "slowest": "1 mm/s"}}, "hysteresis"),
    "curve backwards": (
        GROUND,
        {"hysteresis": {"speed": "1 m/s", "slowest": "1 m/s", "fastest": "1 mm/s"}},
        "hysteresis.fastest",
    ),
    "points without ends": (
        GROUND,
        {"hysteresis": {"speed": "1 m/s", "points": 3}},
        "hysteresis.points",
    ),
    "steps without distance": (
        GROUND,
        {"hysteresis": {"speed": "1 m/s", "steps_per_pixel": 3}},
        "hysteresis.steps_per_pixel",
    ),
    "too far": (
        GROUND,
        {"hysteresis": {"speed": "1 m/s", "distance": "1 km"}},
        "hysteresis.distance",
    ),
    "too near": (
        GROUND,
        {"hysteresis": {"speed": "1 m/s", "distance": "1 um"}},
        "hysteresis.distance",
    ),
    "rough rubber": (
        GROUND,
        {"body": RUBBER, "counter_body": "rigid"},
        "surface of a viscoelastic body in steady sliding",
    ),
    "oblique on a free grid": (
        ROLLER,
        {"hysteresis": {"speed": "1 mm/s", "direction": "30 deg"}},
        "direction of sliding (rad)",
    ),
    "hard rubber": (GROUND, {"law": {"kind": "hardness", "hardness": "5 GPa"}}, "law of steady sliding"),
    "sheared": (GROUND, {"friction": {"coefficient": 0.3}, "shear": {"shift": "1 nm"}}, "shear"),
    "sticky without range": (
        GROUND,
        {"adhesion": {"law": "jkr", "work": "50 mJ/m^2"}},
        "adhesion of viscoelastic bodies",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refused(name: str) -> None:
    base, tables, subject = REFUSED[name]
    with pytest.raises(InputError) as refused:
        build(checked(base | tables))
    assert refused.value.subject.removeprefix("problem document: ") == subject


def test_a_study_over_speed_and_temperature(tmp_path: Path) -> None:
    """Numbers of a campaign are those of single runs; friction follows the shift of the times."""
    quantities = ["hysteresis_friction", "sliding_area_fraction", "persson_friction"]
    axes = [
        {"path": "hysteresis.speed", "values": ["1 mm/s", "1 cm/s"]},
        {"path": "viscoelastic.temperature", "values": ["298 K", "310 K"]},
    ]
    table = GROUND | {"viscoelastic": {"temperature": "298 K"}}
    made = plan(problem=table, axes=axes, quantities=quantities)
    carry_out(made, tmp_path / "r.log", InProcess())
    data = dataset(made, tmp_path / "r.log")
    alone = asp.run(GROUND | {"viscoelastic": {"temperature": "310 K"}}).values
    for name in quantities:
        assert float(data[name][1, 1]) == pytest.approx(alone[name], rel=1e-6)
    assert (np.diff(data["sliding_area_fraction"].values, axis=1) > 0.0).all()


def test_a_study_over_the_time_of_a_hold(tmp_path: Path) -> None:
    table = BALL | {"control": {"force": "2 mN"}, "viscoelastic": {"hold": "1 s", "steps": 4}}
    made = plan(
        problem=table,
        axes=[{"path": "viscoelastic.hold.0", "values": ["0.1 s", "10 s"]}],
        quantities=["approach", "viscoelastic_heat"],
    )
    carry_out(made, tmp_path / "r.log", InProcess())
    data = dataset(made, tmp_path / "r.log")
    alone = asp.run(table | {"viscoelastic": {"hold": "10 s", "steps": 4}}).values
    assert float(data["viscoelastic_heat"][1]) == pytest.approx(alone["viscoelastic_heat"], rel=1e-9)
    assert float(data["approach"][0]) < float(data["approach"][1])


@pytest.mark.slow
def test_motion_that_comes_to_another_steady_contact_is_a_finding() -> None:
    """An adhesive wave that is pressed and slides jumps into full contact on the way, where the
    steady state found at once touches in part."""
    wave = {"kind": "sinusoid", "points": [64, 1], "size": "1 mm x 1 mm", "amplitude": "2 um", "wavelength": "1 mm"}
    table = {
        "version": 2,
        "surface": wave,
        "body": "rigid",
        "counter_body": "E=3MPa+3MPa@0.1s+10MPa@10ms,nu=0.5",
        "control": {"mean_pressure": "5 kPa"},
        "adhesion": {"work": "50 mJ/m^2", "range": "0.2 um"},
        "hysteresis": {"speed": "1.2 cm/s", "distance": "1 mm", "steps_per_pixel": 1},
    }
    outcome = asp.run(table)
    assert outcome.values["start_last_area_fraction"] == 1.0
    assert outcome.values["sliding_area_fraction"] < 0.5
    assert "two steady states" in {finding.criterion for finding in outcome.findings}
    fast = asp.run(table | {"hysteresis": table["hysteresis"] | {"speed": "1.5 cm/s"}})
    assert fast.values["start_last_area_fraction"] == fast.values["sliding_area_fraction"]
    assert "two steady states" not in {finding.criterion for finding in fast.findings}
