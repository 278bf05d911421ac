"""Friction in motion at the doors: command, document, files made again, studies, and what is
refused."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cli.conftest import LOAD, SCALE, Runner
from refusals import refused, subject_of

import asperity as asp
from asperity import dynamics as dyn
from asperity.core.errors import InputError
from asperity.core.settings import COMMAND_LINE
from asperity.physics.dynamics.motion import Motion
from asperity.run.document import checked
from asperity.run.stored import load_outcome

BODY = ("--body", "E=1GPa,nu=0.2")
MOTION = ("--mass", "1kg", "--base", "10mm x 10mm", "--block-height", "5mm", "--spring", "200N/mm", "--speed", "1mm/s")
PROBLEM: dict[str, Any] = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [32, 32],
        "size": "10 um",
        "seed": 1,
        "spectrum": {"kind": "gaussian", "rms_height": "10 nm", "correlation_length": "2 um"},
    },
    "body": "E=1GPa,nu=0.3",
    "control": {"mean_pressure": "1 MPa"},
    "friction": {"coefficient": 0.3, "speed": "1 mm/s"},
    "dynamics": {"mass": "1 kg", "base": "10 mm x 10 mm", "height": "5 mm", "stiffness": "200 N/mm"},
}


def checked_and_run(table: dict[str, Any]) -> asp.ContactResult:
    """The document read as from the command line, where messages begin with the key, and run."""
    return asp.run(checked(table, COMMAND_LINE)).result


def moved(**tables: Any) -> dict[str, Any]:
    """Values of the problem with these ``tables``; those of the motion in addition to its own."""
    motion = PROBLEM["dynamics"] | tables.pop("dynamics", {})
    return asp.run(PROBLEM | {"dynamics": motion} | tables).values


def test_a_block_and_its_files(run: Runner, matrix: Path, tmp_path: Path) -> None:
    """The command solves, moves and writes; files give the same words and pictures again; no
    stresses come uninvited."""
    out = tmp_path / "out"
    command = ("dynamics", matrix, *SCALE, "--periodise", *BODY, *LOAD, *MOTION, "--friction", "0.3")
    done = run(*command, "--start", "sliding", "--duration", "2ms", "--out", out)
    assert done.exit_code == 0, done.output
    outcome = load_outcome(out / "result.nc")
    assert "stress" not in outcome.found
    (words,) = (words for part, words in outcome.sections if part.name == "dynamics")
    assert words.sentence in " ".join(done.output.split())
    names = {figure.name for figure in outcome.figures["dynamics"]}
    assert (
        {"dynamics_law", "dynamics_forces", "dynamics_sliding", "dynamics_stability"}
        <= names
        <= {p.stem for p in (out / "plots").iterdir()}
    )
    stored = outcome.found["dynamics"].values
    assert stored["curve_pressure"][0] < outcome.result.mean_pressure < stored["curve_pressure"][-1]


def test_a_document_is_what_python_computes() -> None:
    """The law is that of the contact curve, and the steady state that of the block on it."""
    values = moved(dynamics={"start": "sliding", "duration": "1 ms", "damping_ratio": 0.05})
    law = dyn.NormalCompliance.amontons(
        1e6 / values["interface_penetration"] ** values["interface_exponent"],
        values["interface_exponent"],
        friction=0.3,
    )
    block = dyn.SlidingBlock(law.damped(0.05, 1e4, 1e6), 1.0, 0.01, 0.01, 0.005, 100.0, 2e5, 1e-3)
    assert values["normal_frequency"] == pytest.approx(block.normal_frequency / (2.0 * np.pi), rel=1e-9)
    assert values["growth_rate"] == pytest.approx(block.stability.margin, rel=1e-6)
    assert values["critical_friction"] == pytest.approx(block.critical_friction(), rel=1e-6)
    assert values["motion_energy_error"] < 1e-5


def test_models_beside_the_block() -> None:
    """A mass vibrates at its natural frequency; a belt with more static friction has stick-slip at
    its closed-form period."""
    mass = moved(dynamics={"model": "mass", "amplitude": 1.01, "damping_ratio": 0.0})
    assert mass["vibration_frequency"] == pytest.approx(mass["normal_frequency"], rel=0.01)  # 15 periods in the window
    belt = moved(dynamics={"model": "belt", "static_friction": 0.4})
    exact = asp.theories.belt_stick_slip(1.0, 2e5, 100.0, 1e-3, static=0.4, kinetic=0.3)
    assert belt["stick_slip_period"] == pytest.approx(exact.period, rel=1e-6)
    aged = moved(dynamics={"model": "belt", "slip_distance": "10 um", "duration": "50 ms"})
    assert np.isfinite(aged["apparent_friction"])


def test_a_block_that_does_not_slide_has_no_apparent_friction() -> None:
    outcome = asp.run(PROBLEM | {"dynamics": PROBLEM["dynamics"] | {"start": "rest", "duration": "1 ms"}})
    assert "apparent_friction" not in outcome.values
    assert any(item.criterion == "duration of the motion" and item.level == "warning" for item in outcome.findings)


def test_static_friction_of_a_wet_contact() -> None:
    """The friction of a block on a wet interface is the static one with its menisci."""
    film = {"liquid": "water", "thickness": "2 nm"}
    outcome = asp.run(
        PROBLEM
        | {"film": film, "dynamics": PROBLEM["dynamics"] | {"start": "sliding", "duration": "1 ms"}}
        | {"body": "E=100GPa,nu=0.3", "control": {"mean_pressure": "100 MPa"}}
    )
    values = outcome.values
    assert values["static_friction"] > 0.3
    assert values["peak_friction"] == pytest.approx(values["static_friction"], rel=0.05)


@pytest.mark.slow
def test_speed_and_spring_are_axes_of_studies(run: Runner, tmp_path: Path) -> None:
    """Each case of a study is the document of its values; the stiffness is a quantity with a unit
    of its own."""
    motion = PROBLEM["dynamics"] | {"start": "sliding", "duration": "1 ms"}
    study = {
        "version": 1,
        "quantities": ["apparent_friction"],
        "axes": [
            {"name": "speed", "path": "friction.speed", "values": ["1 mm/s", "5 mm/s"]},
            {"name": "spring", "path": "dynamics.stiffness", "values": ["400 N/mm"]},
        ],
        "problem": PROBLEM | {"dynamics": motion},
    }
    (tmp_path / "study.json").write_text(json.dumps(study), encoding="utf-8")
    done = run("run", tmp_path / "study.json", "--out", tmp_path / "out", "--workers", "1")
    assert done.exit_code == 0, done.output
    with (tmp_path / "out" / "cases.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row, speed in zip(rows, ("1 mm/s", "5 mm/s"), strict=True):
        alone = moved(
            friction={"coefficient": 0.3, "speed": speed},
            dynamics={"start": "sliding", "duration": "1 ms", "stiffness": "400 N/mm"},
        )
        assert float(row["spring"]) == 4e5
        assert float(row["apparent_friction"]) == pytest.approx(alone["apparent_friction"], rel=1e-6)


def test_a_curve_over_the_speed() -> None:
    motion = PROBLEM["dynamics"] | {"start": "sliding", "duration": "1 ms", "speeds": 3}
    outcome = asp.run(PROBLEM | {"dynamics": motion})
    assert outcome.found["dynamics"].values["sweep_mean_friction"].shape == (3,)


def test_a_law_of_few_pixels_is_refused(run: Runner, matrix: Path) -> None:
    """One pixel of a stiff body gives an exponent of one whatever the surface; the command fails
    with it."""
    stiff = PROBLEM | {"body": "E=100GPa,nu=0.3"}
    few = asp.run({key: value for key, value in stiff.items() if key != "dynamics"}).result
    assert 0 < few.contact.sum() < 50
    with refused(InputError, "control", "50", str(int(few.contact.sum()))):
        checked_and_run(stiff)
    done = run(
        "dynamics", matrix, *SCALE, "--periodise", "--body", "E=100TPa,nu=0.2", *LOAD, *MOTION, "--friction", "0.3"
    )
    assert done.exit_code != 0


def test_loads_of_few_pixels_are_left_out_of_the_law() -> None:
    """A path from a light load on gives the law of its loads from about twenty pixels on, and one
    of its own where those are too few."""
    control = {"path": {"mean_pressure": ["1 MPa"], "steps": 40}}
    outcome = asp.run(
        PROBLEM | {"control": control, "dynamics": PROBLEM["dynamics"] | {"start": "sliding", "duration": "1 ms"}}
    )
    steps = {step.mean_pressure: int(step.contact.sum()) for step in outcome.path.steps}
    assert min(count for count in steps.values() if count) < 20
    used = outcome.found["dynamics"].values["curve_pressure"]
    assert used.size >= 8
    assert all(steps[pressure] >= 20 for pressure in used)


def test_ends_that_are_not_steady_are_findings() -> None:
    """Without damping the friction falls as the block hops: the spring relaxes through the whole
    window, at times that hang on rounding."""
    friction = {"coefficient": 0.5, "speed": "1 mm/s"}
    motion = PROBLEM["dynamics"] | {"start": "sliding", "duration": "20 ms", "damping_ratio": 0.0, "disturbance": 0.0}
    found = {item.criterion: item for item in asp.run(PROBLEM | {"friction": friction, "dynamics": motion}).findings}
    assert found["window of the motion"].level == "warning"
    assert "phase of the motion" in found
    steady = PROBLEM["dynamics"] | {"start": "sliding", "duration": "20 ms"}
    quiet = {item.criterion for item in asp.run(PROBLEM | {"dynamics": steady}).findings}
    assert not quiet & {"window of the motion", "phase of the motion"}


def test_interface_with_a_power_below_one_has_modes_where_parts_lift_off() -> None:
    """Without contact the stiffness is zero, not infinite: the eigenvalues were not those of
    numbers."""
    law = dyn.NormalCompliance.amontons(1e9, 0.8, friction=0.3)
    assert np.array_equal(law.stiffness([-1e-6, 0.0]), [0.0, 0.0])
    assert np.array_equal(law.friction_slope([-1e-6, 0.0]), [0.0, 0.0])
    tall = dyn.SlidingBlock(law, 1.0, 0.1, 0.02, 0.15, 100.0, 2e5, 1e-3)
    assert (tall.steady.penetration - tall.base[0] * tall.steady.tilt).min() < 0.0
    assert np.isfinite(tall.stability.growth_rates).all()


def test_stick_slip_needs_a_base_that_comes_to_rest_on_the_belt() -> None:
    """A swing of the spring without sticking is none, however much it stands out; the same swing
    that reaches the belt is."""
    block = dyn.SlidingBlock(
        dyn.NormalCompliance.amontons(2.8e18, 2.0, friction=0.3), 1.0, 0.1, 0.02, 0.05, 100.0, 2e5, 1e-3
    )
    time = np.linspace(0.0, 1.0, 1001)
    swing = block.reference_displacement * (0.8 + 0.1 * np.sin(20.0 * np.pi * time))
    for reached, found in ((-0.5, False), (0.0, True)):
        speed = block.speed * (reached - 1.0 + np.cos(20.0 * np.pi * time))
        still = np.zeros_like(time)
        values = dict.fromkeys(("penetration", "tilt", "normal_force"), still)
        values |= {
            "displacement": swing,
            "spring_force": swing * block.stiffness,
            "velocity": speed + block.speed,
            "sliding_speed": speed,
        }
        numbers = dyn.BlockRun(block, Motion(time, values)).numbers()
        assert np.isfinite(numbers["stick_slip_period"]) == found
        if found:
            assert numbers["stick_slip_period"] == pytest.approx(0.1, rel=1e-6)


def test_refusals(run: Runner, matrix: Path) -> None:
    for change, subject in (
        ({"friction": {"coefficient": 0.3}}, "friction.speed"),
        ({"friction": {"speed": "1 mm/s"}}, "friction.coefficient"),
        ({"dynamics": {"mass": "1 kg"}}, "dynamics"),
        ({"dynamics": PROBLEM["dynamics"] | {"mass": 1.0}}, "dynamics.mass"),
        ({"dynamics": {"mass": "1 kg", "base": "1 mm"}}, "dynamics"),
        ({"dynamics": PROBLEM["dynamics"] | {"model": "belt", "speeds": 3}}, "dynamics"),
    ):
        with refused(InputError, subject):
            checked_and_run(PROBLEM | change)
    command = ("dynamics", matrix, *SCALE, "--periodise", *BODY, *LOAD)
    assert subject_of(run(*command, "--mass", "1kg")) == "the dynamics"
    assert subject_of(run(*command, "--mass", "1", "--base", "1mm")) == "--mass"
