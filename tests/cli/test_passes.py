"""Repeated passes at the doors: document, command, files made again, studies, animated pictures,
and what is refused."""

from __future__ import annotations

import itertools
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cli.conftest import SCALE, Runner
from PIL import Image
from refusals import subject_of

import asperity as asp
from asperity.report.animation import plastic_cuts
from asperity.run.stored import load_outcome, save_outcome
from asperity.theories.subsurface.shakedown import cylinder_shakedown

STEEL = "E=200GPa,nu=0.3,Y=400MPa,name=steel"
Y, E_STAR, RADIUS = 400e6, 200e9 / (1.0 - 0.3**2), 10e-3
K = Y / math.sqrt(3.0)
PROBLEM: dict[str, Any] = {
    "version": 2,
    "surface": {"kind": "sphere", "points": [16, 12], "size": "80 um x 60 um", "radius": "2 mm"},
    "body": STEEL,
    "boundary": {"kind": "free"},
    "control": {"force": "10 mN"},
}
COARSE = {"count": 1, "radius": "10 mm", "elements": 5, "steps": 8}


def passed(peak: float, body: Any = STEEL, **table: Any) -> asp.studies.Outcome:
    """Passes at Hertz's pressure of ``peak`` times the yield stress in shear."""
    return asp.run(PROBLEM | {"body": body, "passes": COARSE | {"peak_pressure": f"{peak * K!r} Pa"} | table})


def said(outcome: asp.studies.Outcome) -> Any:
    (words,) = (words for part, words in outcome.sections if part.name == "passes")
    return words


def test_an_elastic_cylinder_is_hertz() -> None:
    """Below first yield at 3.1 k: load, half-width and peak of Hertz within what five elements
    allow, no flow, and the share of the shakedown limit of the theory."""
    found = passed(2.5, friction=0.1)
    values, half_width = found.values, 2.0 * 2.5 * K * RADIUS / E_STAR
    assert values["pass_line_load"] == pytest.approx(0.5 * math.pi * half_width * 2.5 * K)
    assert values["pass_peak_pressure"] == pytest.approx(2.5 * K, rel=0.02)
    assert values["pass_contact_radius"] == pytest.approx(half_width, rel=0.15)
    assert values["pass_shakedown_share"] == pytest.approx(2.5 / cylinder_shakedown(0.1).peak_over_k)
    assert values["pass_plastic_strain"] == values["pass_line_dissipation"] == 0.0
    assert math.isnan(values["pass_force"])
    assert said(found).headline == [("repeated passes", "elastic")]
    assert "passes" in {finding.criterion for finding in found.findings}
    # 2 mu p_0 at the edge behind a sliding cylinder and nowhere more
    assert 0.0 < values["pass_surface_tension"] < 0.2 * 2.5 * K


@pytest.mark.slow
def test_an_elastic_sphere_is_hertz() -> None:
    """The force is that on the whole sphere, of which half is meshed."""
    peak = 4.0 * K
    load = math.pi**3 * RADIUS**2 * peak**3 / (6.0 * E_STAR**2)
    table = {
        "count": 1,
        "radius": "10 mm",
        "indenter": "sphere",
        "force": f"{load!r} N",
        "motion": "in place",
        "steps": 4,
    }
    found = asp.run(PROBLEM | {"body": "E=200GPa,nu=0.3,Y=4GPa", "passes": table}).values
    assert found["pass_force"] == pytest.approx(load)
    assert found["pass_hertz_pressure"] == pytest.approx(peak, rel=1e-9)
    assert found["pass_peak_pressure"] == pytest.approx(peak, rel=0.03)  # four elements to the radius
    assert found["pass_contact_radius"] == pytest.approx(math.pi * peak * RADIUS / (2.0 * E_STAR), rel=0.1)
    assert math.isnan(found["pass_resistance"])


@pytest.mark.slow
def test_pressed_in_place_again_and_again() -> None:
    """A cylinder yields first at 1.79 Y; pressed once more to the same load a hardening solid stays
    elastic."""
    for peak, flows in ((1.70, False), (1.95, True)):
        found = passed(peak * math.sqrt(3.0), count=2, motion="in place", elements=8)
        assert (found.values["pass_plastic_strain"] > 0.0) is flows, peak
    assert found.values["pass_growth_ratio"] < 1e-3  # the balance leaves 1e-6 of the load
    assert "ceases" in said(found).sentence
    assert found.values["pass_groove_depth"] > 0.0
    assert found.values["pass_forward"] == pytest.approx(0.0, abs=1e-6 * found.values["pass_groove_depth"])


@pytest.fixture(scope="module")
def coated() -> asp.studies.Outcome:
    """A hard film on steel with kinematic hardening, dragged over to and fro."""
    body = "E=400GPa,nu=0.25,Y=4GPa,name=film:40um/E=200GPa,nu=0.3,Y=400MPa,kinematic=10GPa,name=base"
    return passed(4.2, body, count=2, friction=0.2, motion="to and fro")


@pytest.mark.slow
def test_to_and_fro_over_a_film(coated: asp.studies.Outcome) -> None:
    """The surface follows the friction and comes back; the film is in tension and does not flow;
    the work lost is less than that of the friction."""
    values, each = coated.values, coated.found["passes"].values
    assert each["passes_forward"][0] > 0.0 > each["passes_forward"][1]
    assert values["pass_layer_strain"] == 0.0 < values["pass_base_strain"] <= values["pass_plastic_strain"]
    for name in ("surface_tension", "layer_tension", "interface_shear", "residual_interface_shear"):
        assert values[f"pass_{name}"] > 0.0
    assert 0.0 < values["pass_resistance"] < 0.2
    assert values["pass_line_dissipation"] == pytest.approx(
        values["pass_resistance"] * values["pass_line_load"] * 4.0 * 2.0 * 4.2 * K * RADIUS / E_STAR
    )
    assert math.isnan(values["pass_shakedown_share"])
    depth, along = each["passes_profile_depth"], each["passes_residual_along"]
    assert values["pass_residual_compression"] == pytest.approx(-along.min())
    assert depth[int(np.argmin(along))] > 40e-6


def test_files_give_the_same_words_and_pictures(coated: asp.studies.Outcome, tmp_path: Path) -> None:
    save_outcome(coated, tmp_path / "o.nc")
    again = load_outcome(tmp_path / "o.nc")
    assert [f.picture for f in again.figures["passes"]] == [f.picture for f in coated.figures["passes"]]
    assert (said(again).sentence, said(again).rows) == (said(coated).sentence, said(coated).rows)
    names = {figure.name for figure in coated.figures["passes"]}
    assert {"passes_plastic_zones", "passes_residual_depth", "passes_flow", "passes_motion", "passes_imprint"} <= names
    cuts = plastic_cuts(coated)
    assert len(cuts) == 2 * (4 + 8 + 4)
    assert "pass 2" in cuts[-1].label
    grown = [float(cut.strain.sum()) for cut in cuts]
    assert all(after >= before for before, after in itertools.pairwise(grown))


@pytest.mark.slow
def test_the_friction_of_the_contact_is_that_of_the_passes() -> None:
    found = asp.run(
        PROBLEM | {"friction": {"coefficient": 0.15}, "passes": COARSE | {"peak_pressure": "100 MPa", "track": "50 um"}}
    )
    assert found.values["pass_friction"] == 0.15
    assert "50 µm" in dict(said(found).rows)["motion"]


@pytest.mark.slow
def test_given_pressure_below_and_above_the_limit() -> None:
    """Rolling at 0.92 of 4 k: flow ceases. At 1.15 it goes on in closed cycles by Prager's law."""
    body = "E=200GPa,nu=0.3,Y=400MPa,kinematic=20GPa"
    table = {"pressure": "hertz", "friction": 0, "elements": 5, "steps": 16, "track": "600 um"}
    below = passed(0.92 * 4.0, body, count=4, **table)
    assert below.values["pass_growth_ratio"] < 0.01
    assert "shakedown" in said(below).sentence
    assert below.values["pass_shakedown_share"] == pytest.approx(0.92, rel=1e-3)
    above = passed(1.15 * 4.0, body, count=5, **table)
    assert above.values["pass_growth_ratio"] > 0.2
    assert above.values["pass_onward_share"] < 0.1
    assert said(above).headline[0][1] == "flow goes on in closed cycles"


@pytest.mark.slow
def test_a_command_with_passes(run: Runner, matrix: Path, tmp_path: Path, rendered: None) -> None:
    out, film = tmp_path / "out", tmp_path / "passes.gif"
    passes = ("--passes", "2", "--pass-motion", "in place", "--pass-line-load", "200kN/m", "--pass-radius", "10mm")
    more = ("--pass-steps", "8", "--pass-elements", "4")
    contact = ("contact", matrix, *SCALE, "--periodise", "--body", STEEL, "--pressure", "1MPa")
    done = run(*contact, *passes, *more, "--out", out, "--animation", film)
    assert done.exit_code == 0, done.output
    stored = load_outcome(out / "result.nc")
    assert said(stored).sentence in " ".join(done.output.split())
    assert {figure.name for figure in stored.figures["passes"]} <= {path.stem for path in (out / "plots").iterdir()}
    assert "Repeated passes" in (out / "report.html").read_text(encoding="utf-8")
    with Image.open(film) as picture:
        assert getattr(picture, "n_frames", 1) == 2 * (4 + 4)


@pytest.mark.slow
def test_a_study_of_thickness_and_hardness_ratio(tmp_path: Path) -> None:
    """Beneath a cylinder pressed in place a thicker film of a harder material keeps more of the
    flow from the base."""
    import tomli_w

    layer = {"name": "film", "youngs_modulus": "200 GPa", "poisson_ratio": 0.3, "thickness": "40 um"}
    base = {"name": "base", "youngs_modulus": "200 GPa", "poisson_ratio": 0.3, "yield_stress": "400 MPa"}
    table = COARSE | {"line_load": "250 kN/m", "motion": "in place", "elements": 4}
    study = {
        "version": 1,
        "problem": PROBLEM | {"body": {"layers": [layer | {"yield_stress": "1 GPa"}], "base": base}, "passes": table},
        "quantities": ["pass_base_strain", "pass_layer_strain", "pass_plastic_depth"],
        "axes": [
            {"path": "body.layers.0.thickness", "values": ["20 um", "100 um"]},
            {"path": "body.layers.0.yield_stress", "values": ["300 MPa", "2 GPa"]},
        ],
    }
    path = tmp_path / "study.toml"
    path.write_text(tomli_w.dumps(study), encoding="utf-8")
    data = asp.studies.run_study(path, tmp_path / "out").dataset()
    base_strain, layer_strain = (np.asarray(data[name]) for name in ("pass_base_strain", "pass_layer_strain"))
    assert base_strain[1, 1] < base_strain[0, 1]
    assert (layer_strain[:, 1] == 0.0).all()
    assert (layer_strain[:, 0] > 0.0).all()


@pytest.mark.parametrize(
    ("body", "extra", "subject"),
    [
        ("steel", ("--passes", "2", "--pass-peak", "1GPa"), "yield stress of steel"),
        (STEEL, ("--passes", "2"), "the passes"),
        (STEEL, ("--pass-peak", "1GPa"), "the passes"),
        (STEEL, ("--passes", "0", "--pass-peak", "1GPa"), "--passes"),
        (STEEL, ("--passes", "1", "--pass-peak", "1GPa", "--pass-line-load", "1N/m"), "the passes"),
        (STEEL, ("--passes", "1", "--pass-line-load", "1N/m", "--pass-indenter", "sphere"), "the passes"),
        (
            STEEL,
            ("--passes", "1", "--pass-peak", "1GPa", "--pass-motion", "in place", "--pass-track", "1um"),
            "the passes",
        ),
        (
            STEEL,
            ("--passes", "1", "--pass-peak", "1GPa", "--pass-elements", "30", "--pass-indenter", "sphere"),
            "--pass-elements",
        ),
        (STEEL, ("--passes", "1", "--pass-peak", "1GPa", "--pass-motion", "sideways"), "--pass-motion"),
        (STEEL, ("--passes", "1", "--pass-peak", "1GPa", "--pass-in", "counter_body"), "counter_body"),
        (STEEL, ("--passes", "1", "--pass-peak", "500GPa", "--pass-radius", "1um"), "load of the passes"),
        (
            STEEL,
            (
                "--passes",
                "1",
                "--pass-peak",
                "1GPa",
                "--pass-radius",
                "1um",
                "--pass-track",
                "2um",
                "--pass-elements",
                "60",
            ),
            "mesh of the passes",
        ),
        (
            STEEL,
            ("--passes", "1", "--pass-peak", "1GPa", "--pass-radius", "1um", "--pass-track", "1mm"),
            "track of the passes",
        ),
        (
            f"{STEEL}:1um~/{STEEL}",
            ("--passes", "1", "--pass-peak", "1GPa", "--pass-radius", "1um"),
            "interface of a meshed layer",
        ),
    ],
)
def test_refusals(run: Runner, matrix: Path, body: str, extra: tuple[str, ...], subject: str) -> None:
    done = run("contact", matrix, *SCALE, "--periodise", "--body", body, "--pressure", "1MPa", *extra)
    assert subject_of(done).startswith(subject), subject_of(done)
