"""Plastic flow and indentation at the doors: command, document, files made again, studies, animated
pictures, and what is refused."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cli.conftest import SCALE, Runner
from PIL import Image
from reference_data import reference
from refusals import refused, subject_of

import asperity as asp
from asperity.core.errors import InputError
from asperity.io.words import result_rows
from asperity.report.animation import plastic_cuts
from asperity.run.stored import load_outcome, save_outcome
from asperity.theories import catalogue

STEEL = "E=200GPa,nu=0.3,Y=400MPa"
PROBLEM: dict[str, Any] = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [24, 24],
        "size": "10 um",
        "seed": 1,
        "spectrum": {"kind": "gaussian", "rms_height": "20 nm", "correlation_length": "1.5 um"},
    },
    "body": f"E=300GPa,nu=0.25,Y=5GPa,name=film:500nm/{STEEL},name=steel",
    "control": {"mean_pressure": "60 MPa"},
}
FLOW = {"steps": 2, "cells": 12}


def outcome(**tables: Any) -> asp.studies.Outcome:
    return asp.run(PROBLEM | tables)


# Plastic flow in the volume.


@pytest.mark.slow
def test_a_command_with_plastic_flow_and_its_files(run: Runner, matrix: Path, tmp_path: Path, rendered: None) -> None:
    """The command solves and writes; files give the same words and pictures again; the animation
    has a frame for each step."""
    out, film = tmp_path / "out", tmp_path / "zones.gif"
    body = f"E=300GPa,nu=0.25,Y=0.5GPa,name=film:500nm/{STEEL}"
    flow = ("--plastic", "--plastic-steps", "2", "--plastic-unload", "--plastic-cells", "8")
    command = ("contact", matrix, *SCALE, "--periodise", "--body", body, "--pressure", "300MPa", *flow)
    done = run(*command, "--out", out, "--animation", film)
    assert done.exit_code == 0, done.output
    stored = load_outcome(out / "result.nc")
    (words,) = (words for part, words in stored.sections if part.name == "plastic_flow")
    assert words.sentence in " ".join(done.output.split())
    names = {figure.name for figure in stored.figures["plastic_flow"]}
    assert {"flow_plastic_zones", "flow_residual_stress", "flow_load_approach", "flow_imprint_map"} <= names
    assert names <= {picture.stem for picture in (out / "plots").iterdir()}
    with Image.open(film) as picture:
        assert getattr(picture, "n_frames", 1) == 4


def test_a_document_is_what_python_computes() -> None:
    found = outcome(plastic_flow=FLOW | {"steps": 1})
    film, steel = (
        asp.Elastic(300e9, 0.25, asp.Strength(yield_stress=5e9)),
        asp.Elastic(200e9, 0.3, asp.Strength(yield_stress=4e8)),
    )
    laws = [asp.plasticity.plastic_solid(film), asp.plasticity.plastic_solid(steel)]
    problem = asp.ContactProblem(
        found.result.problem.surface,
        asp.Layered([asp.Layer(film, 500e-9)], steel),
        plastic_flow=asp.PlasticFlow(laws, cells=12),
    )
    flow = asp.solve(problem, asp.MeanPressure(60e6)).require_plastic_flow()
    assert found.values["flow_plastic_work"] == pytest.approx(flow.work, rel=1e-6)
    assert found.values["flow_largest_strain"] == pytest.approx(
        max(zone.largest_strain for zone in flow.zones), rel=1e-6
    )
    assert found.values["flow_base_strain"] > 0.0
    assert not any(text == "0 J" for _, text in result_rows(found.result)), "work that is solved as plastic flow"
    np.testing.assert_allclose(found.found["plastic_flow"].values["flow_imprint"], flow.displacement, atol=1e-15)


def test_stresses_keep_to_the_yield_stress_that_the_same_run_enforces() -> None:
    """Perfectly plastic, rough against the pixels, with friction that only the flow and the
    stresses feel: largest von Mises stress, the one at a depth itself, tensions of both tables,
    tractions of the interface."""
    made = outcome(
        body=f"{STEEL}:800nm/E=100GPa,nu=0.3",
        plastic_flow=FLOW | {"unknown_is_elastic": True},
        stress={},
        friction={"coefficient": 0.3},
        control={"mean_pressure": "30 MPa"},
    )
    values, stress = made.values, made.found["stress"].values
    assert made.result.plastic_flow.zones[0].top == 0.0
    change = 1e-4 * values["flow_largest_strain"]  # at which the strain counts as settled
    unsettled = 3.0 * 200e9 / 2.6 * change
    assert stress["layer_max_von_mises"][0] == pytest.approx(0.4e9, abs=unsettled)
    assert unsettled < 0.01 * 0.4e9
    assert asp.stress(made.result, [0.0]).von_mises.max() > 2.0 * 0.4e9
    assert values["flow_surface_tension"] <= stress["layer_max_tension"][0]
    assert values["flow_layer_tension"] <= stress["layer_max_tension"][0]
    assert values["flow_interface_shear"] == pytest.approx(values["max_interface_shear"], rel=1e-3)
    assert values["flow_interface_peel"] == pytest.approx(values["max_interface_peel"], rel=1e-3)


def test_unloading_keeps_imprint_and_work() -> None:
    """Taking the load off adds no more plastic work than reverse flow, and the loop of force and
    approach is open."""
    loaded, off = (outcome(body=STEEL, plastic_flow=FLOW | {"unload": unload}) for unload in (False, True))
    values = off.found["plastic_flow"].values
    assert off.result.force == 0.0
    assert values["plastic_flow_approach"][-1] > 0.1 * values["plastic_flow_approach"].max()
    assert off.values["flow_plastic_work"] >= loaded.values["flow_plastic_work"] * (1.0 - 1e-6)
    assert off.values["flow_plastic_work"] < 1.1 * loaded.values["flow_plastic_work"]
    assert off.values["flow_imprint_depth"] == pytest.approx(loaded.values["flow_imprint_depth"], rel=0.1)
    peak = int(np.argmax(values["plastic_flow_force"]))
    assert values["plastic_flow_elastic_force"][peak] > values["plastic_flow_force"][peak]
    assert off.values["flow_surface_tension"] == pytest.approx(loaded.values["flow_surface_tension"], rel=1e-6)


def test_cut_of_the_file_is_that_of_the_outcome(tmp_path: Path) -> None:
    made = outcome(plastic_flow=FLOW)
    save_outcome(made, tmp_path / "o.nc")
    again = load_outcome(tmp_path / "o.nc")
    for name, value in made.found["plastic_flow"].values.items():
        np.testing.assert_array_equal(again.found["plastic_flow"].values[name], value, err_msg=name)
    assert [figure.picture for figure in again.figures["plastic_flow"]] == [
        figure.picture for figure in made.figures["plastic_flow"]
    ]


def test_light_loads_and_switched_off_flow_are_elastic() -> None:
    light = outcome(control={"mean_pressure": "1 Pa"}, plastic_flow=FLOW)
    assert light.values["flow_largest_strain"] == 0.0
    assert "plastic flow" in {finding.criterion for finding in light.findings}
    plain, off = outcome(), outcome(plastic_flow={"active": False})
    assert "plastic_flow" not in off.found
    np.testing.assert_array_equal(plain.result.pressure, off.result.pressure)
    assert light.figures["plastic_flow"]


@pytest.mark.slow
def test_a_study_of_thickness_and_yield_stress(tmp_path: Path) -> None:
    """A harder film protects the steel; the case without enough strength to be known is a record,
    not a crash."""
    study = {
        "version": 1,
        "problem": PROBLEM | {"plastic_flow": FLOW | {"steps": 1}},
        "quantities": ["flow_base_strain", "flow_depth", "flow_imprint_depth"],
        "axes": [
            {"path": "body.layers.0.thickness", "values": ["200 nm", "1 um"]},
            {"path": "body.layers.0.yield_stress", "values": ["0.5 GPa", "5 GPa"]},
        ],
    }
    study["problem"]["body"] = {
        "layers": [
            {
                "name": "film",
                "youngs_modulus": "300 GPa",
                "poisson_ratio": 0.25,
                "yield_stress": "5 GPa",
                "thickness": "500 nm",
            }
        ],
        "base": {"name": "steel", "youngs_modulus": "200 GPa", "poisson_ratio": 0.3, "yield_stress": "400 MPa"},
    }
    import tomli_w

    path = tmp_path / "study.toml"
    path.write_text(tomli_w.dumps(study), encoding="utf-8")
    data = asp.studies.run_study(path, tmp_path / "out").dataset()
    strain = np.asarray(data["flow_base_strain"])
    assert strain.shape == (2, 2)
    assert (strain[1] < strain[0]).all(), "under a thicker film the steel flows less"


@pytest.mark.parametrize(
    ("body", "extra", "subject"),
    [
        ("steel", ("--plastic",), "yield stress of steel"),
        (STEEL, ("--plastic", "--hardness", "1GPa"), "law"),
        (STEEL, ("--plastic", "--plastic-steps", "0"), "--plastic-steps"),
        (STEEL, ("--plastic", "--plastic-cells", "2"), "--plastic-cells"),
        (f"{STEEL}:1um~/{STEEL}", ("--plastic",), "layers that hold an eigenstrain"),
        ("E=1GPa,nu=0.3", ("--plastic", "--plastic-unknown-elastic"), "body"),
        ("steel", ("--indent", "10nm", "--indenter-radius", "1um"), "yield stress of steel"),
        (STEEL, ("--indent", "10nm", "--indenter-radius", "10nm"), "depth of indentation (m)"),
        (STEEL, ("--indent", "10nm", "--indenter", "cone", "--indenter-radius", "10um"), "the indentation"),
        (STEEL, ("--indenter-radius", "10um"), "the indentation"),
        (STEEL, ("--indent", "0nm"), "--indent"),
        (STEEL, ("--indent", "10nm", "--indent-in", "counter_body"), "counter_body"),
        (STEEL, ("--indent", "10nm", "--indenter-radius", "1um", "--elastic-indenter"), "counter_body"),
        (STEEL, ("--indent", "10nm", "--indent-friction", "-1"), "--indent-friction"),
    ],
)
def test_refusals(run: Runner, matrix: Path, body: str, extra: tuple[str, ...], subject: str) -> None:
    done = run("contact", matrix, *SCALE, "--periodise", "--body", body, "--pressure", "1MPa", *extra)
    assert subject_of(done).startswith(subject), subject_of(done)


def test_an_animation_needs_a_history(run: Runner, matrix: Path, tmp_path: Path) -> None:
    plain = run(
        "contact",
        matrix,
        *SCALE,
        "--periodise",
        "--body",
        STEEL,
        "--pressure",
        "1MPa",
        "--animation",
        tmp_path / "a.gif",
    )
    assert subject_of(plain) == "outcome of an animation"
    with refused(InputError, "path of the animation", "a.mp4"):
        asp.report.save_plastic_animation(outcome(plastic_flow=FLOW), tmp_path / "a.mp4")


# Indentation.

RADIUS = 10e-6
E_STAR = 200e9 / (1.0 - 0.3**2)
P_YIELD = 1.6128 * 400e6
DEPTH_Y = RADIUS * (math.pi * P_YIELD / (2.0 * E_STAR)) ** 2
FORCE_Y = math.pi**3 * RADIUS**2 / (6.0 * E_STAR**2) * P_YIELD**3


def indented(depth: float, body: Any = STEEL, **more: Any) -> asp.studies.Outcome:
    """Indentation by a ball of ``RADIUS`` to ``depth`` over that of first yield."""
    table = {
        "depth": f"{depth * DEPTH_Y!r} m",
        "radius": "10 um",
        "elements": 12,
        "steps": 8,
        "unloading_steps": 8,
    } | more
    return outcome(body=body, control={"mean_pressure": "1 MPa"}, indentation=table)


@pytest.mark.slow
def test_indentation_of_a_half_space() -> None:
    """Force of the table (own error 0.5 %; 12 elements 1 %), slope 2 E* a of the unloading, and the
    balance of work."""
    found = indented(6.0)
    row = next(row for row in reference("sphere_perfectly_plastic") if row["delta_over_delta_y"] == 6.0)
    values = found.values
    assert values["indent_force"] / FORCE_Y == pytest.approx(float(row["P_over_Py"]), rel=0.015)
    assert values["indent_hardness"] / 400e6 == pytest.approx(float(row["pm_over_Y"]), rel=0.05)
    assert values["indent_unloading_stiffness"] == pytest.approx(
        2.0 * E_STAR * values["indent_contact_radius"], rel=0.05
    )
    assert values["indent_oliver_pharr_modulus"] == pytest.approx(E_STAR, rel=0.05)
    assert 0.0 < values["indent_residual_depth"] < values["indent_depth"]
    arrays = found.found["indentation"].values
    plastic = arrays["indentation_work_lost"][-1]
    # the work kept is plastic work and the energy of the residual stress, a small part of it;
    # trapezia of 8 steps err by 2 %
    assert plastic < values["indent_dissipated_work"] * 1.05
    assert plastic > 0.75 * values["indent_dissipated_work"]
    assert math.isnan(values["indent_layer_tension"])


@pytest.mark.slow
def test_equal_layers_are_the_half_space_and_scales_do_not_matter() -> None:
    """Small strains: force over that at yield depends on the depth over that at yield alone; an
    interface of equal materials on nothing."""
    plain = indented(3.0, elements=8).values["indent_force"]
    coated = indented(3.0, f"{STEEL}:30nm/{STEEL}", elements=8).values["indent_force"]
    assert coated == pytest.approx(plain, rel=0.01)
    soft = indented(3.0, "E=20GPa,nu=0.3,Y=40MPa", elements=8)
    assert soft.values["indent_force"] == pytest.approx(0.1 * plain, rel=1e-6)


def test_elastic_indentation_is_hertz() -> None:
    found = indented(0.9)
    assert found.values["indent_force"] == pytest.approx(FORCE_Y * 0.9**1.5, rel=0.01)
    assert found.values["indent_plastic_strain"] == 0.0
    assert found.values["indent_residual_depth"] == pytest.approx(0.0, abs=1e-3 * DEPTH_Y)
    assert found.values["indent_oliver_pharr_modulus"] == pytest.approx(E_STAR, rel=0.02)
    assert "indentation" in {finding.criterion for finding in found.findings}


@pytest.mark.slow
def test_an_elastic_indenter_and_friction() -> None:
    """An indenter of the same elastic constants halves the contact modulus: Hertz's force at one
    approach, and Oliver and Pharr's modulus; friction does not lower the force."""
    body, table = "E=200GPa,nu=0.3,Y=40GPa", {"depth": f"{DEPTH_Y!r} m", "radius": "10 um", "elements": 12, "steps": 4}
    table |= {"unloading_steps": 8}
    pair = {"body": body, "counter_body": "E=200GPa,nu=0.3,name=ball", "control": {"mean_pressure": "1 MPa"}}
    soft = outcome(**pair, indentation=table | {"elastic_indenter": True})
    assert soft.values["indent_force"] == pytest.approx(0.5 * FORCE_Y, rel=0.01)
    assert soft.values["indent_oliver_pharr_modulus"] == pytest.approx(0.5 * E_STAR, rel=0.02)
    (words,) = (words for part, words in soft.sections if part.name == "indentation")
    assert dict(words.rows)["material of the indenter"] == "ball"
    rigid = outcome(**pair, indentation=table)
    assert rigid.values["indent_force"] == pytest.approx(FORCE_Y, rel=0.01)
    rough = outcome(**pair, indentation=table | {"friction": 0.3})
    sticks = catalogue.theory("sticking-indenter")(E_STAR, 0.5 / RADIUS, 2.0, 2.0 / 7.0).at_load(FORCE_Y)
    most = (DEPTH_Y / float(sticks.approach)) ** 1.5  # no friction takes more than full stick (Spence 1968)
    assert 1.0 < rough.values["indent_force"] / rigid.values["indent_force"] < 1.005 * most
    assert most < 1.05


@pytest.mark.slow
def test_a_hard_film_takes_more_and_is_in_tension(tmp_path: Path) -> None:
    """Stiffer and harder: more force, less flow in the base; tension at surface and bottom of the
    film; files hold the same words and pictures."""
    body = f"E=800GPa,nu=0.3,Y=1.6GPa,name=film:40nm/{STEEL},name=base"
    bare, coated = indented(5.0, elements=8), indented(5.0, body, elements=8)
    assert coated.values["indent_force"] > 1.1 * bare.values["indent_force"]
    for name in ("surface_tension", "layer_tension", "residual_layer_tension", "interface_shear"):
        assert coated.values[f"indent_{name}"] > 0.0
    save_outcome(coated, tmp_path / "o.nc")
    again = load_outcome(tmp_path / "o.nc")
    assert [f.picture for f in again.figures["indentation"]] == [f.picture for f in coated.figures["indentation"]]
    texts = [
        [(words.sentence, words.rows) for part, words in one.sections if part.name == "indentation"]
        for one in (again, coated)
    ]
    assert texts[0] == texts[1]
    assert len(plastic_cuts(coated)) == 1 + 8 + 8
    with refused(InputError, "outcome of an animation"):
        asp.report.save_plastic_animation(again, tmp_path / "again.gif")


def test_the_radius_of_the_summits() -> None:
    """A ball without a radius is as round as the summits of the surface are on average."""
    table = {"depth": "2 nm", "elements": 8, "steps": 4, "unloading_steps": 6}
    ball = outcome(body=STEEL, control={"mean_pressure": "1 MPa"}, indentation=table)
    summits = asp.roughness_of(ball.result.problem.surface).summits
    assert summits is not None
    assert ball.values["indent_radius"] == pytest.approx(summits.mean_radius)


def test_a_cone_on_what_stays_elastic() -> None:
    """Sneddon's cone, F = (2/π) E* tan θ δ², on a body that yields at no stress of this depth; its
    tip reaches over any yield stress in one element alone."""
    table = {
        "depth": "50 nm",
        "indenter": "cone",
        "half_angle": "80 deg",
        "elements": 10,
        "steps": 4,
        "unloading_steps": 6,
    }
    cone = outcome(body="E=200GPa,nu=0.3,Y=900GPa", control={"mean_pressure": "1 MPa"}, indentation=table)
    exact = 2.0 / math.pi * E_STAR * math.tan(math.radians(80.0)) * 50e-9**2
    assert cone.values["indent_force"] == pytest.approx(exact, rel=0.03)
    assert math.isnan(cone.values["indent_radius"])
    assert cone.values["indent_pile_up"] == pytest.approx(1.0, abs=0.1)
