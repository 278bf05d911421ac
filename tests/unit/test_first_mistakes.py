"""What a newcomer writes first and does not mean is refused with what to write instead."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.run.document import checked, dumps, loads


@pytest.mark.parametrize("named", [{"E": 70e9, "nu": 0.3}, {"youngs_modulus": 70e9, "nu": 0.3}, {"G": 27e9}])
def test_symbols_of_textbooks_are_no_keywords(named: dict[str, Any]) -> None:
    with refused(asp.InputError, "keyword of Elastic", "youngs_modulus", "poisson_ratio"):
        asp.Elastic(**named)


def test_bodies_are_copied_as_before() -> None:
    body = asp.Elastic(70e9, poisson_ratio=0.3, name="aluminium")
    assert repr(copy.deepcopy(body)) == repr(body)


def test_a_call_with_too_many_arguments_is_answered_with_those_it_has() -> None:
    grid = asp.Grid((8, 8), (1e-6, 1e-6))
    with pytest.raises(TypeError) as caught:
        asp.generate.sphere(grid, 1e-3)  # type: ignore[call-arg]
    assert "sphere(grid, *, radius" in str(caught.value)


def test_a_layer_has_a_thickness() -> None:
    with refused(asp.InputError, "layers of a Layered body", "DLC", "thickness"):
        asp.Layered(asp.material("DLC"), asp.material("silicon"))  # type: ignore[arg-type]


@pytest.mark.parametrize("given", [asp.Surface(np.eye(4) * 1e-9, 1e-6), "scan.di"])
def test_a_surface_is_no_problem(given: object) -> None:
    with refused(asp.InputError, "problem", "ContactProblem(surface, body)"):
        asp.solve(given, asp.MeanPressure(1e6))  # type: ignore[call-overload]


@pytest.mark.parametrize(
    ("module", "wrong", "right"),
    [(asp, "materal", "material"), (asp.theories, "HertzPont", "HertzPoint"), (asp.friction, "Coulom", "Coulomb")],
)
def test_a_name_that_is_nearly_right_is_answered_with_the_right_one(module: Any, wrong: str, right: str) -> None:
    with pytest.raises(AttributeError) as caught:
        getattr(module, wrong)
    assert right in str(caught.value).split()[-1]


def test_a_word_stands_for_a_distribution_in_python_too() -> None:
    numbers = {"E_star": 1e11, "density": 1e12, "radius": 1e-6, "height_deviation": 1e-8}
    named = asp.theories.GreenwoodWilliamson(**numbers, heights="exponential")
    assert named == asp.theories.GreenwoodWilliamson(**numbers, heights=named.heights)
    assert named != asp.theories.GreenwoodWilliamson(**numbers)
    with refused(asp.InputError, "heights of greenwood-williamson", "exponential", "lognormal"):
        asp.theories.GreenwoodWilliamson(**numbers, heights="lognormal")


@pytest.mark.parametrize("word", ["self_affine", "self-affine", "Self Affine"])
def test_hyphens_spaces_and_capitals_make_no_other_word(word: str) -> None:
    surface = {"kind": "rough", "points": [16, 16], "size": "1 um", "seed": 1}
    spectrum = {
        "kind": word,
        "hurst": 0.8,
        "rms_height": "1 nm",
        "rolloff_wavelength": "0.5 um",
        "shortest_wavelength": "0.2 um",
    }
    table = {
        "version": 2,
        "surface": {**surface, "spectrum": spectrum},
        "body": "E=100GPa,nu=0.3",
        "control": {"mean_pressure": "1 MPa"},
    }
    assert loads(dumps(checked(table, "table"))) == checked(table, "table")
    assert checked(table, "table").surface.spectrum.kind == "self_affine"
    spectrum["kind"] = "selffine"
    with refused(asp.InputError, "table: surface.spectrum.kind", "self_affine"):
        checked(table, "table")
