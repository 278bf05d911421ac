"""What a newcomer writes first and does not mean is refused with what to write instead."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
import pytest
from refusals import refused

import asperity as asp


@pytest.mark.parametrize("named", [{"E": 70e9, "nu": 0.3}, {"youngs_modulus": 70e9, "nu": 0.3}, {"G": 27e9}])
def test_symbols_of_textbooks_are_no_keywords(named: dict[str, Any]) -> None:
    with refused(asp.InputError, "keyword of Elastic", "youngs_modulus", "poisson_ratio"):
        asp.Elastic(**named)


def test_bodies_are_copied_as_before() -> None:
    body = asp.Elastic(70e9, poisson_ratio=0.3, name="aluminium")
    assert repr(copy.deepcopy(body)) == repr(body)


def test_a_layer_has_a_thickness() -> None:
    with refused(asp.InputError, "layers of a Layered body", "DLC", "thickness"):
        asp.Layered(asp.material("DLC"), asp.material("silicon"))  # type: ignore[arg-type]


@pytest.mark.parametrize("given", [asp.Surface(np.eye(4) * 1e-9, 1e-6), "scan.di"])
def test_a_surface_is_no_problem(given: object) -> None:
    with refused(asp.InputError, "problem", "ContactProblem(surface, body)"):
        asp.solve(given, asp.MeanPressure(1e6))  # type: ignore[call-overload]
