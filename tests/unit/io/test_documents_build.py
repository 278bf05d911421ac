"""From documents to problems."""

from __future__ import annotations

import inspect
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity import (
    Approach,
    Elastic,
    Force,
    Free,
    FreeLine,
    Frictionless,
    Hardness,
    InputError,
    Layer,
    Layered,
    MeanGap,
    MeanPressure,
    Periodic,
    Rigid,
    RigidBase,
    Strength,
    Surface,
    Unloaded,
    generate,
    material,
)
from asperity.core import units
from asperity.io.schemas.surfaces import SURFACE_TABLES, SURFACES
from asperity.physics.stress.survey import StressRequest, WantedProfile, WantedSection
from asperity.plasticity import HardWall, LayeredHardness
from asperity.run.build import build, build_control, build_part, build_surface
from asperity.run.document import checked, relocated
from asperity.solids import ExponentialGrading, LinearGrading, PowerGrading, graded
from asperity.solvers import ActiveSet
from asperity.stresses import Tresca

GRID = {"points": [16, 12], "size": "8 um x 6 um"}
EXPONENTIAL = {"kind": "exponential", "rms_height": "1 nm", "correlation_length": "0.5 um"}


def table(**tables: Any) -> dict[str, Any]:
    return {
        "version": 1,
        "surface": {"kind": "sphere", "radius": "20 um", **GRID},
        "body": {"youngs_modulus": "100 GPa", "poisson_ratio": 0.3, "hardness": "5 GPa"},
        "control": {"mean_pressure": "50 kPa"},
    } | tables


@pytest.mark.parametrize(
    "surface",
    [
        {"kind": "elliptic_paraboloid", "radius_x": "20 um", "radius_y": "5 um"},
        {"kind": "cylinder", "radius": "20 um", "axis": "x"},
        {"kind": "cone", "slope": 0.1},
        {"kind": "flat_punch", "radius": "2 um", "depth": "1 um"},
        {"kind": "sinusoid", "amplitude": "1 nm", "wavelength": "4 um"},
        {"kind": "bisinusoid", "amplitude": "1 nm", "wavelength": "2 um"},
        {"kind": "flat"},
        {"kind": "sphere", "radius": "20 um", "exact": True},
        {"kind": "wedge", "slope": 0.1, "axis": "x"},
        {"kind": "power_law", "exponent": 4.0, "radius": "2 um", "height": "10 nm"},
        {"kind": "flat_punch", "radius": "2 um", "depth": "1 um", "edge_radius": "0.5 um"},
        {
            "kind": "laser_bumps",
            "pitch": ["4 um", "3 um"],
            "rim_height": "10 nm",
            "rim_radius": "0 um",
            "rim_width": "1 um",
        },
        {"kind": "dimples", "pitch": ["4 um", "3 um"], "radius": "0.5 um", "depth": "10 nm", "raised": True},
        {"kind": "grooves", "pitch": "4 um", "width": "1 um", "depth": "10 nm", "section": "round"},
        {"kind": "rough", "seed": 1, "spectrum": EXPONENTIAL},
        {"kind": "rough", "seed": 1, "spectrum": EXPONENTIAL | {"kind": "gaussian"}, "variant": "nested"},
        {"kind": "rough", "seed": 1, "spectrum": EXPONENTIAL, "variant": "fixed", "periodic": False},
        {
            "kind": "rough",
            "seed": 1,
            "spectrum": {
                "kind": "two_slopes",
                "plateau": "4e4 nm**4",
                "exponents": [6.5, 4.6],
                "rolloff_wavelength": "4 um",
                "crossover_wavelength": "2 um",
            },
        },
        {
            "kind": "rough",
            "seed": 1,
            "spectrum": {"kind": "table", "wavelengths": ["4 um", "1 um"], "psd": ["1e4 nm**4", "1e2 nm**4"]},
        },
        {"kind": "digital_filter", "seed": 1, "spectrum": EXPONENTIAL, "skewness": 0.5, "kurtosis": 4.0},
        {"kind": "translated", "seed": 1, "spectrum": EXPONENTIAL, "skewness": -1.0, "kurtosis": 5.0},
        {
            "kind": "rank_ordered",
            "seed": 1,
            "spectrum": EXPONENTIAL,
            "heights": {"kind": "moments", "skewness": -1.0, "kurtosis": 4.0},
        },
        {
            "kind": "rank_ordered",
            "seed": 1,
            "spectrum": EXPONENTIAL,
            "heights": {"kind": "two_levels", "share": 0.4, "separation": 3.0},
            "last": "spectrum",
        },
        {
            "kind": "bimodal",
            "seed": 1,
            "first": EXPONENTIAL,
            "second": EXPONENTIAL,
            "patches": EXPONENTIAL,
            "share": 0.3,
            "separation": "-2 nm",
        },
        {
            "kind": "two_process",
            "seed": 1,
            "plateau": EXPONENTIAL,
            "valleys": EXPONENTIAL,
            "offset": "1 nm",
            "keep": "upper",
        },
        {"kind": "particles", "seed": 1, "matrix": EXPONENTIAL, "density": "0.1 um**-2", "radius": "0.5 um"},
        {"kind": "weierstrass_mandelbrot", "seed": 1, "dimension": 2.4, "roughness": "1 pm"},
        {"kind": "weierstrass_mandelbrot_profile", "dimension": 1.4, "roughness": "1 pm"},
        {
            "kind": "rough",
            "seed": 1,
            "spectrum": {
                "kind": "self_affine",
                "rms_slope": 0.1,
                "hurst": 0.8,
                "rolloff_wavelength": "4 um",
                "shortest_wavelength": "1 um",
            },
        },
    ],
)
def test_every_kind_of_surface(surface: dict[str, Any]) -> None:
    built = build(checked(table(surface=surface | GRID))).problem.surface
    assert built.shape == (16, 12)
    assert built.size == pytest.approx((8e-6, 6e-6))
    if surface["kind"] == "elliptic_paraboloid":  # two pixels along x, three along y from the top
        found = built.heights[8 + 2, 6], built.heights[8, 6 + 3]
        assert found == pytest.approx((-(1e-6**2) / 40e-6, -(1.5e-6**2) / 10e-6))


def test_every_generator_has_a_kind() -> None:
    """What Python can make, a document can ask for, with the same arguments."""
    functions = {name for name in generate.__all__ if inspect.isfunction(getattr(generate, name))}
    others = {"endless", "spectrum_of"}  # an endless surface has no grid, and a spectrum is not a surface
    assert set(SURFACES.values()) == {getattr(generate, name) for name in functions - others}
    for kind, model in SURFACE_TABLES.items():
        arguments = set(inspect.signature(SURFACES[kind]).parameters)
        keys = set(model.model_fields) - {"kind", "points", "size", "prepare", "mirror", "place"}
        assert keys == arguments - {"grid", "progress"}, kind


def test_spectra_in_si() -> None:
    """A table of a document is the same as the object in Python."""
    table_of = {
        "self_affine": {
            "kind": "self_affine",
            "plateau": "2 um**4",
            "hurst": 0.8,
            "rolloff_wavelength": "4 um",
            "shortest_wavelength": "0 nm",
            "longest_wavelength": "8 um",
        },
        "gaussian": EXPONENTIAL | {"kind": "gaussian", "correlation_length_y": "700 nm", "drop": 0.5},
    }
    found = {
        name: build_part(
            checked(table(surface={"kind": "rough", "seed": 1, "spectrum": spectrum, **GRID})).surface.spectrum,
            Path(),
        )  # type: ignore[union-attr]
        for name, spectrum in table_of.items()
    }
    assert found["self_affine"] == generate.SelfAffine(
        amplitude=generate.PlateauPSD(units.parse("2 um**4", "power spectrum", "")),
        hurst=0.8,
        rolloff_wavelength=units.parse("4 um", "length", ""),
        shortest_wavelength=0.0,
        longest_wavelength=units.parse("8 um", "length", ""),
    )
    assert found["gaussian"].drop == 0.5  # type: ignore[attr-defined]
    assert found["gaussian"].correlation_length_y == pytest.approx(7e-7)  # type: ignore[attr-defined]


def test_more_like_a_file(tmp_path: Path) -> None:
    heights = np.random.default_rng(1).standard_normal((32, 24))
    np.save(tmp_path / "seen.npy", heights)
    seen = {
        "kind": "file",
        "path": "seen.npy",
        "size": "8 um x 6 um",
        "height_unit": "nm",
        "prepare": [{"step": "level"}, {"step": "periodise"}],
    }
    surface = {
        "kind": "rank_ordered",
        "seed": 1,
        "spectrum": {"kind": "measured", "surface": seen, "isotropic": False},
        "heights": {"kind": "measured", "surface": seen},
        "points": [32, 24],
        "size": "8 um x 6 um",
    }
    document = checked(table(surface=surface))
    made = build(document, tmp_path).problem.surface
    assert made.heights.std() == pytest.approx(heights.std() * 1e-9, rel=0.05)
    assert "spectrum of seen.npy" in made.origin.history[0]
    # the same document from another folder finds the same file
    elsewhere = tmp_path / "deep" / "folder"
    elsewhere.mkdir(parents=True)
    moved = relocated(document, tmp_path, elsewhere)
    np.testing.assert_array_equal(build(moved, elsewhere).problem.surface.heights, made.heights)


def test_a_surface_with_the_spectrum_of_a_line_scan(tmp_path: Path) -> None:
    """A document names the file of the line scan, or a map and the line of it."""
    model = asp.roughness.RoundedSpectrum(3e-28, 3e6, 0.8)
    seen = generate.gaussian(asp.Grid((400, 6), (1e-7, 1e-7)), model, seed=2)
    asp.save(seen, tmp_path / "map.nc")
    asp.save(seen.row(3), tmp_path / "trace.nc")
    scans = (
        {"path": "trace.nc"},
        {"path": "map.nc", "prepare": [{"step": "slice", "y": "middle"}]},
    )
    made = []
    for scan in scans:
        surface = {"kind": "from_line_scan", "seed": 1, "profile": {"kind": "file", **scan}, **GRID}
        document = checked(table(surface=surface))
        made.append(build(document, tmp_path).problem.surface)
        elsewhere = tmp_path / "deep" / "folder"
        elsewhere.mkdir(parents=True, exist_ok=True)
        moved = build(relocated(document, tmp_path, elsewhere), elsewhere).problem.surface
        np.testing.assert_array_equal(moved.heights, made[-1].heights)
    expected = generate.surface_of_profile(seen.row(3), made[0].grid, seed=1)
    for surface in made:
        np.testing.assert_array_equal(surface.heights, expected.heights)
    with refused(InputError, "file for the spectrum of a line scan"):
        surface = {"kind": "from_line_scan", "seed": 1, "profile": {"kind": "file", "path": "map.nc"}, **GRID}
        build(checked(table(surface=surface)), tmp_path)


@pytest.mark.parametrize(
    ("control", "expected"),
    [
        ({"mean_pressure": "50 kPa"}, MeanPressure(50e3)),
        ({"force": "2 mN"}, Force(2e-3)),
        ({"approach": "3 nm"}, Approach(3e-9)),
        ({"mean_gap": "4 nm"}, MeanGap(4e-9)),
    ],
)
def test_controls(control: dict[str, str], expected: object) -> None:
    built = build(checked(table(control=control))).control
    assert type(built) is type(expected)
    assert built.value == pytest.approx(expected.value, rel=1e-14)  # type: ignore[attr-defined]


def test_bodies_boundary_and_law() -> None:
    problem = build(checked(table())).problem
    assert isinstance(problem.body, Elastic)
    assert problem.body.youngs_modulus == pytest.approx(100e9)
    assert problem.counter_body == Rigid()
    assert problem.boundary == Periodic()
    assert isinstance(problem.law, HardWall)
    other = table(boundary={"kind": "free"}, law={"kind": "hardness", "hardness": "2 GPa"})
    problem = build(checked(other)).problem
    assert problem.boundary == Free()
    assert isinstance(problem.law, Hardness)
    assert problem.law.pressure_cap() == pytest.approx(2e9)


def test_hardness_from_body_is_that_of_the_softer_one() -> None:
    law = {"kind": "hardness", "hardness": "from body"}
    softer = {"youngs_modulus": "1 GPa", "poisson_ratio": 0.3, "hardness": "1 GPa"}
    assert build(checked(table(law=law))).problem.law.pressure_cap() == pytest.approx(5e9)
    assert build(checked(table(law=law, counter_body=softer))).problem.law.pressure_cap() == pytest.approx(1e9)
    unknown = {"youngs_modulus": "1 GPa", "poisson_ratio": 0.3}
    with refused(InputError, "hardness"):
        build(checked(table(law=law, body=unknown)))


def test_layered_body_of_tables_and_of_text() -> None:
    """Both ways give the body that Python makes."""
    coating, strong = Elastic(1e9, 0.3, Strength(hardness=2e8), name="film", sources=("user",)), material("DLC")
    expected = Layered([Layer(strong, 5e-9, Frictionless()), Layer(coating, 2e-6)], material("steel"))
    tables = {
        "layers": [
            {"material": "DLC", "thickness": "5 nm", "interface": "frictionless"},
            {
                "youngs_modulus": "1 GPa",
                "poisson_ratio": 0.3,
                "hardness": "200 MPa",
                "name": "film",
                "thickness": "2 um",
            },
        ],
        "base": {"material": "steel"},
    }
    text = "DLC:5nm~/E=1GPa,nu=0.3,H=200MPa,name=film:2um/steel"
    for body in (tables, text):
        built = build(checked(table(body=body))).problem.body
        assert isinstance(built, Layered)
        assert len(built.layers) == 2
        for found, wanted in zip(built.layers, expected.layers, strict=True):
            assert found.interface == wanted.interface
            assert found.thickness == pytest.approx(wanted.thickness, rel=1e-14)
            assert (found.material.name, found.material.sources) == (wanted.material.name, wanted.material.sources)
            assert found.material.youngs_modulus == pytest.approx(wanted.material.youngs_modulus, rel=1e-14)
            assert found.material.strength.hardness == pytest.approx(wanted.material.strength.hardness, rel=1e-14)
        on_rigid = build(checked(table(body="DLC:5nm/rigid", counter_body="steel"))).problem
    assert on_rigid.body.base == RigidBase()  # type: ignore[union-attr]
    assert repr(asdict(on_rigid.counter_body)) == repr(asdict(material("steel")))


@pytest.mark.parametrize(
    ("kind", "grading"),
    [
        ({"kind": "linear"}, LinearGrading()),
        ({"kind": "exponential"}, ExponentialGrading()),
        ({"kind": "power", "exponent": 2.0}, PowerGrading(2.0)),
    ],
)
def test_graded_coatings(kind: dict[str, Any], grading: Any) -> None:
    coating = {
        **kind,
        "top": "TiN",
        "bottom": "steel",
        "thickness": "1 um",
        "sublayers": 7,
        "interface": "frictionless",
    }
    built = build(checked(table(body={"layers": [coating], "base": "steel"}))).problem.body
    expected = graded(material("TiN"), material("steel"), 1e-6, grading=grading, sublayers=7, interface=Frictionless())
    assert isinstance(built, Layered)
    for found, wanted in zip(built.layers, expected, strict=True):
        assert repr(asdict(found.material)) == repr(
            asdict(wanted.material)
        )  # unknown strengths are nan, which equals nothing
        assert found.interface == wanted.interface
        assert found.thickness == pytest.approx(wanted.thickness, rel=1e-14)


def test_own_materials_in_every_part_of_a_body(tmp_path: Path) -> None:
    (tmp_path / "own.toml").write_text(
        '[material."film"]\nyoungs_modulus = "3 GPa"\npoisson_ratio = 0.4\n'
        '[material."board"]\nyoungs_modulus = "9 GPa"\npoisson_ratio = 0.1\n'
    )
    coating = {"kind": "linear", "top": "film", "bottom": "board", "thickness": "1 um", "sublayers": 1}
    body = {
        "layers": [{"material": "film", "thickness": "5 nm"}, coating, {"material": "DLC", "thickness": "1 nm"}],
        "base": "board",
        "materials_file": "own.toml",
    }
    built = build(checked(table(body=body)), tmp_path).problem.body
    assert isinstance(built, Layered)
    assert [round(layer.material.youngs_modulus / 1e9, 6) for layer in built.layers] == [3.0, 6.0, 140.0]
    assert built.base.youngs_modulus == pytest.approx(9e9)  # type: ignore[union-attr]


def test_hardness_of_the_surface_is_that_of_the_top_layer() -> None:
    law = {"kind": "hardness", "hardness": "surface"}
    coated = "E=100GPa,nu=0.3,H=9GPa:5nm/E=100GPa,nu=0.3,H=2GPa"
    assert build(checked(table(law=law, body=coated))).problem.law.pressure_cap() == pytest.approx(9e9)
    unknown = "E=100GPa,nu=0.3:5nm/E=100GPa,nu=0.3,H=2GPa"
    with refused(InputError, "hardness"):
        build(checked(table(law=law, body=unknown)))


def test_hardness_from_a_coated_body_follows_its_layers_where_their_strengths_are_known() -> None:
    law = {"kind": "hardness", "hardness": "from body"}
    gold = "gold:50nm/nickel:1um/copper"
    found = build(checked(table(law=law, body=gold))).problem
    assert isinstance(found.law, LayeredHardness)
    assert found.law.body == found.body
    for partly in ("E=100GPa,nu=0.3,H=9GPa:5nm/E=100GPa,nu=0.3", "DLC:5nm/rigid"):
        assert isinstance(build(checked(table(law=law, body=partly))).problem.law, Hardness)


def test_a_yield_stress_serves_where_no_hardness_is_known() -> None:
    law = {"kind": "hardness", "hardness": "from body"}
    soft = {"youngs_modulus": "100 GPa", "poisson_ratio": 0.3, "yield_stress": "1 GPa"}
    assert build(checked(table(law=law, body=soft))).problem.law.pressure_cap() == pytest.approx(2.8e9)
    assert build(checked(table(law=law, counter_body=soft))).problem.law.pressure_cap() == pytest.approx(2.8e9)
    coated = build(checked(table(law=law, body="E=100GPa,nu=0.3,Y=1GPa:5nm/E=100GPa,nu=0.3,H=9GPa"))).problem.law
    assert isinstance(coated, LayeredHardness)
    assert coated.pressure_cap() == pytest.approx(2.8e9)


def test_hardness_numbers_stand_for_pressures() -> None:
    hard = {"material": "steel", "hardness": "60 HRC"}
    for body in (hard, "steel{H=60HRC}", "E=210GPa,nu=0.3,H=697HV"):
        found = build(checked(table(body=body))).problem.body
        assert isinstance(found, Elastic)
        assert found.strength.hardness == pytest.approx(697 * 9.80665e6 / 0.9271839, rel=1e-6)
    law = {"kind": "hardness", "hardness": "697 HV"}
    assert build(checked(table(law=law))).problem.law.pressure_cap() == pytest.approx(7.372e9, rel=1e-3)
    with refused(InputError, "problem document: body.hardness", "80 HRC"):
        checked(table(body={"material": "steel", "hardness": "80 HRC"}))


def test_effective_hardness_is_that_of_the_softer_body_with_its_layers() -> None:
    law = {"kind": "hardness", "hardness": "effective"}
    coated = "E=100GPa,nu=0.3,H=9GPa:5nm/E=100GPa,nu=0.3,H=2GPa"
    found = build(checked(table(law=law, body=coated))).problem
    assert isinstance(found.law, LayeredHardness)
    assert found.law.body == found.body
    assert build(checked(table(law=law))).problem.law.pressure_cap() == pytest.approx(5e9)  # one material
    softer = {"youngs_modulus": "1 GPa", "poisson_ratio": 0.3, "hardness": "1 GPa"}
    assert isinstance(build(checked(table(law=law, body=coated, counter_body=softer))).problem.law, Hardness)
    bare = "E=100GPa,nu=0.3,H=9GPa:0nm/E=100GPa,nu=0.3,H=2GPa"
    assert build(checked(table(law=law, body=bare))).problem.law.pressure_cap() == pytest.approx(2e9)
    unknown = "E=100GPa,nu=0.3,H=9GPa:5nm/E=100GPa,nu=0.3"
    with refused(InputError, "hardness of the material in the base"):
        build(checked(table(law=law, body=unknown)))


def test_load_path() -> None:
    path = {"mean_pressure": ["2 MPa", "0", "3 MPa"], "steps": 2}
    case = build(checked(table(control={"path": path})))
    assert [control.value for control in case.path] == pytest.approx([0.5e6, 2e6, 0.5e6, 0.0, 0.75e6, 3e6])
    assert case.path[3] == Unloaded()
    assert case.control == case.path[-1] == MeanPressure(3e6)
    assert build(checked(table())).path == ()
    for key, value, kind in (("force", "1 mN", Force), ("approach", "2 nm", Approach), ("mean_gap", "3 nm", MeanGap)):
        case = build(
            checked(table(control={"path": {key: [value, value.replace("2", "1")][: 1 + (key == "approach")]}}))
        )
        assert isinstance(case.control, kind)
    with refused(InputError, "control"):
        build_control(checked(table(control={"path": path})).control)


def test_line_contact() -> None:
    """A row of points under the boundary "line" is the line contact of Python."""
    row = {"kind": "cylinder", "radius": "20 um", "axis": "y", "points": [16, 1], "size": "8 um x 1 m"}
    problem = build(checked(table(surface=row, boundary={"kind": "line"}))).problem
    assert problem.boundary == FreeLine()
    assert problem.surface.shape == (16, 1)
    far = build(checked(table(surface=row, boundary={"kind": "line", "datum": "1 mm"}))).problem
    assert far.boundary == FreeLine(units.parse("1 mm", "length", ""))
    with refused(InputError, "grid of a line contact"):
        build(checked(table(boundary={"kind": "line"})))


def test_stresses() -> None:
    """Every key of [stress] in SI; an empty table means the section through the maximum."""
    assert "stress" not in build(checked(table())).asks
    assert build(checked(table(stress={}))).asks["stress"] == StressRequest()
    wanted = {
        "friction": 0.3,
        "direction": "90 deg",
        "coupled": True,
        "inside": "counter_body",
        "depths": ["5 nm", "0 nm"],
        "sections": ["y=max", {"x": "2 um"}, "y=pressure"],
        "profiles": [{}, "x=1um"],
        "deepest": "3 um",
        "criterion": "tresca",
        "tensile_strength": "2 GPa",
        "interface_shear_strength": "300 MPa",
        "interface_peel_strength": "100 MPa",
        "precision": "single",
    }
    request = build(checked(table(stress=wanted, counter_body="steel"))).asks["stress"]
    assert request is not None
    assert (request.friction, request.coupled, request.of, request.dtype) == (0.3, True, "counter_body", "float32")
    assert request.direction == pytest.approx(np.pi / 2.0, rel=1e-14)
    assert request.depths == pytest.approx((5e-9, 0.0), rel=1e-14)
    assert request.sections == (WantedSection("y", "max"), WantedSection("x", 2e-6), WantedSection("y", "pressure"))
    assert request.profiles == (WantedProfile("max", "max"), WantedProfile(pytest.approx(1e-6), "max"))
    assert request.deepest == pytest.approx(3e-6)
    assert request.criterion == Tresca()
    assert vars(request.strengths) == pytest.approx({"tensile": 2e9, "interface_shear": 3e8, "interface_peel": 1e8})
    planes = build(checked(table(stress={"depths": ["5 nm"]}))).asks["stress"]
    assert planes is not None
    assert planes.sections == ()


def test_stresses_that_cannot_be_had_are_refused_before_solving() -> None:
    with refused(InputError, "body in which stresses are asked", "counter body", 'stress.inside = "body"'):
        build(checked(table(stress={"inside": "counter_body"})))
    with refused(InputError, "y of a stress section", "6"):
        build(checked(table(stress={"sections": "y=7um"})))


def test_unknown_material_is_refused() -> None:
    with refused(InputError, "material"):
        build(checked(table(body={"material": "unobtainium"})))


def test_solver_settings() -> None:
    settings = {"method": "steepest_descent", "tolerance": 1e-3, "max_iterations": 7, "threads": 1}
    case = build(checked(table(solver=settings)))
    assert (case.solver.name, case.solver.tolerance, case.solver.max_iterations) == ("steepest_descent", 1e-3, 7)
    assert case.threads == 1
    assert build(checked(table())).solver.name == "active_set"
    single = build(checked(table(solver={"precision": "single"}))).solver
    assert single == ActiveSet(precision="single")
    with refused(InputError, "precision"):
        build(checked(table(solver={"method": "nnls", "precision": "double"})))


def test_files_start_at_the_folder_of_the_document(tmp_path: Path) -> None:
    heights = np.arange(12.0).reshape(3, 4)
    np.savetxt(tmp_path / "a.txt", heights)
    surface = {"kind": "file", "path": "a.txt", "size": "4 um x 3 um", "height_unit": "nm"}
    steps = [{"step": "level", "form": "mean"}, {"step": "fill"}, {"step": "taper"}]
    built = build(checked(table(surface=surface | {"prepare": steps})), tmp_path).problem.surface
    assert built.shape == (4, 3)
    assert [step.split(":")[0] for step in built.origin.history] == ["read", "levelled", "tapered"]
    cropped = surface | {"prepare": [{"step": "crop", "x": ["1 um", "3 um"]}, {"step": "resample", "points": [4, 6]}]}
    built = build(checked(table(surface=cropped)), tmp_path).problem.surface
    assert built.shape == (4, 6)
    assert built.size == pytest.approx((2e-6, 3e-6))
    built = build(checked(table(surface=surface | {"prepare": [{"step": "periodise"}]})), tmp_path).problem.surface
    assert built.periodic


@pytest.mark.parametrize(
    ("step", "expected"),
    [
        ({"step": "level", "degree": 4, "robust": True}, lambda s: asp.levelled(s, 4, robust=True)),
        ({"step": "despike", "threshold": 3.0, "window": 3}, lambda s: asp.surfaces.despiked(s, 3.0, window=3)),
        (
            {
                "step": "mask",
                "regions": [
                    {"kind": "rectangle", "x": ["1 um", "2 um"], "y": "3um:4um"},
                    {"kind": "ellipse", "centre": ["5 um", "3 um"], "radii": "2um,1um", "angle": "30 deg"},
                    {"kind": "polygon", "x": ["0 um", "1 um", "1 um"], "y": ["0 um", "0 um", "2 um"]},
                ],
            },
            lambda s: asp.surfaces.masked(
                s,
                [
                    asp.surfaces.Rectangle(x=(1e-6, 2e-6), y=(3e-6, 4e-6)),
                    asp.surfaces.Ellipse((5e-6, 3e-6), (2e-6, 1e-6), angle=np.radians(30.0)),
                    asp.surfaces.Polygon((0.0, 1e-6, 1e-6), (0.0, 0.0, 2e-6)),
                ],
            ),
        ),
        (
            {"step": "mask", "regions": [{"kind": "rectangle", "x": ["1 um", "2 um"]}], "invert": True},
            lambda s: asp.surfaces.masked(s, [asp.surfaces.Rectangle(x=(1e-6, 2e-6))], invert=True),
        ),
        ({"step": "line_correct", "axis": "y"}, lambda s: asp.surfaces.line_corrected(s, "y")),
        (
            {"step": "filter", "short": "1 um", "short_y": "1.5 um", "long": "3 um", "kind": "robust", "order": 1},
            lambda s: asp.surfaces.filtered(s, short=(1e-6, 1.5e-6), long=3e-6, kind="robust", order=1),
        ),
        ({"step": "tip_limit", "radius": "30 um"}, lambda s: asp.surfaces.tip_limited(s, 30e-6)),
        (
            {"step": "tip", "radius": "30 um"},
            lambda s: asp.surfaces.reconstructed(s, asp.surfaces.SphericalTip(30e-6)),
        ),
        (
            {"step": "tip", "pixels": [3, 5], "noise": "0.1 nm"},
            lambda s: asp.surfaces.reconstructed(s, asp.surfaces.estimated_tip(s, (3, 5), noise=1e-10)),
        ),
        (
            {"step": "tip", "radius": "1 nm", "opening": "170 deg", "mask_uncertain": True},
            lambda s: asp.surfaces.reconstructed(
                s, asp.surfaces.ConicalTip(1e-9, np.radians(170.0)), mask_uncertain=True
            ),
        ),
    ],
)
def test_steps_do_what_the_functions_do(tmp_path: Path, step: dict[str, Any], expected: Any) -> None:
    np.save(tmp_path / "a.npy", np.random.default_rng(1).standard_normal((32, 28)))
    surface = {"kind": "file", "path": "a.npy", "size": "8 um x 7 um", "height_unit": "nm"}
    before = asp.read(tmp_path / "a.npy", size=(8e-6, 7e-6), height_unit="nm")
    found = build_surface(checked(table(surface=surface | {"prepare": [step]})).surface, tmp_path)
    np.testing.assert_allclose(found.heights, expected(before).heights, rtol=1e-9, atol=1e-20)
    assert found.origin.history == expected(before).origin.history


@pytest.mark.parametrize("mirror", ["none", "x", "y"])
def test_counter_surface_is_turned_over(tmp_path: Path, mirror: str) -> None:
    np.save(tmp_path / "a.npy", np.arange(12.0).reshape(4, 3))
    surface = {"kind": "file", "path": "a.npy", "size": "4 um x 3 um", "height_unit": "nm"}
    document = checked(table(surface=surface, counter_surface=surface | {"mirror": mirror}))
    counter = build(document, tmp_path).problem.counter_surface
    assert isinstance(counter, Surface)
    expected = np.arange(12.0).reshape(4, 3)
    if mirror != "none":
        expected = np.flip(expected, "xy".index(mirror))
        assert counter.origin.history[-1] == f"turned over: mirrored along {mirror}"
    np.testing.assert_allclose(counter.heights, expected * 1e-9, rtol=1e-12, atol=0.0)


def test_counter_surface_is_placed_on_a_common_grid(tmp_path: Path) -> None:
    for name, shape in (("a", (32, 24)), ("b", (40, 30))):
        np.save(tmp_path / f"{name}.npy", np.random.default_rng(len(name)).standard_normal(shape))
    surface = {"kind": "file", "path": "a.npy", "size": "8 um x 6 um", "height_unit": "nm"}
    counter = {"kind": "file", "path": "b.npy", "size": "8 um x 6 um", "height_unit": "nm", "mirror": "y"}
    place = {"shift": ["1 um", "-0.5 um"], "angle": "20 deg"}
    problem = build(checked(table(surface=surface, counter_surface=counter | {"place": place})), tmp_path).problem
    assert isinstance(problem.counter_surface, Surface)
    expected = asp.surfaces.on_common_grid(
        asp.read(tmp_path / "a.npy", size=(8e-6, 6e-6), height_unit="nm"),
        asp.read(tmp_path / "b.npy", size=(8e-6, 6e-6), height_unit="nm"),
        shift=(1e-6, -0.5e-6),
        angle=np.radians(20.0),
        mirrored="y",
    )
    np.testing.assert_allclose(problem.surface.heights, expected.surface.heights, atol=1e-18)
    np.testing.assert_allclose(problem.counter_surface.heights, expected.counter_surface.heights, atol=1e-18)
    with refused(InputError, "the two surfaces of a pair"):
        build(checked(table(surface=surface, counter_surface=counter)), tmp_path)
    with refused(InputError, "problem document: surface.place"):
        checked(table(surface=surface | {"place": {}}))
