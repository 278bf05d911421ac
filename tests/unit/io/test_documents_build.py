"""From documents to problems."""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest

from asperity import (
    Approach,
    Elastic,
    Force,
    Free,
    Hardness,
    HardWall,
    InputError,
    MeanGap,
    MeanPressure,
    Periodic,
    Rigid,
    Surface,
)
from asperity.contact.solvers import ActiveSet
from asperity.io.build import build
from asperity.io.documents import checked
from asperity.io.schemas.surfaces import Shape
from asperity.surfaces import generate

GRID = {"points": [16, 12], "size": "8 um x 6 um"}


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
        {
            "kind": "rough",
            "seed": 1,
            "spectrum": {"kind": "exponential", "rms_height": "1 nm", "correlation_length": "0.5 um"},
        },
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


def test_every_generated_shape_has_a_kind() -> None:
    """What Python can make, a document can ask for."""
    kinds = {shape.model_fields["kind"].annotation.__args__[0] for shape in get_args(Shape)}  # type: ignore[union-attr]
    made = {name for name in generate.__all__ if inspect.isfunction(getattr(generate, name))}
    assert kinds == made - {"gaussian"}


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
    with pytest.raises(InputError, match="hardness must be known for at least one body"):
        build(checked(table(law=law, body=unknown)))


def test_unknown_material_is_refused() -> None:
    with pytest.raises(InputError, match="material must be a name in the material library"):
        build(checked(table(body={"material": "unobtainium"})))


def test_solver_settings() -> None:
    settings = {"method": "steepest_descent", "tolerance": 1e-3, "max_iterations": 7, "threads": 1}
    case = build(checked(table(solver=settings)))
    assert (case.solver.name, case.solver.tolerance, case.solver.max_iterations) == ("steepest_descent", 1e-3, 7)
    assert case.threads == 1
    assert build(checked(table())).solver.name == "active_set"
    single = build(checked(table(solver={"precision": "single"}))).solver
    assert single == ActiveSet(precision="single")
    with pytest.raises(InputError, match="precision must not be given for the solver nnls"):
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
