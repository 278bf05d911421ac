"""Contacts with couplings and histories come back from their file as they went in."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import asperity as asp
from asperity.contact.result import SCALARS
from asperity.io.words import FIELDS


@pytest.fixture(scope="module")
def problem() -> asp.ContactProblem:
    heights = np.random.default_rng(5).normal(size=(16, 12)) * 1e-9
    film = asp.LiquidFilm(surface_tension=0.025, thickness=0.4e-9, meniscus_height=0.8e-9)
    return asp.ContactProblem(
        asp.Surface(heights, 2e-8, periodic=True),
        asp.Elastic(1e11, 0.3),
        law=asp.Hardness(8e9),
        film=film,
        friction=asp.Coulomb(0.3, coupled=True),
    )


def same(found: asp.ContactResult, result: asp.ContactResult) -> None:
    for item in (*SCALARS, *FIELDS):
        np.testing.assert_array_equal(getattr(found, item.name), getattr(result, item.name), item.name)
    assert (found.control, found.status) == (result.control, result.status)
    assert str(found.certificate) == str(result.certificate)
    assert str(found.problem.film) == str(result.problem.film)
    assert found.problem.friction == result.problem.friction
    assert found.menisci is not None
    assert result.menisci is not None
    assert found.menisci.static_friction == result.menisci.static_friction
    np.testing.assert_array_equal(found.menisci.wetting.menisci, result.menisci.wetting.menisci)
    assert found.sliding is not None
    assert result.sliding is not None
    np.testing.assert_array_equal(found.sliding.shear_displacement, result.sliding.shear_displacement)
    assert found.memory.keys() == result.memory.keys()
    for name, memory in result.memory.items():
        for key, values in memory.items():
            np.testing.assert_array_equal(found.memory[name][key], values)


def test_a_wet_sliding_contact(problem: asp.ContactProblem, tmp_path: Path) -> None:
    result = asp.solve(problem, asp.MeanPressure(2e8))
    asp.save(result, tmp_path / "r.nc")
    same(asp.load(tmp_path / "r.nc"), result)
    tree = asp.files.open_tree(tmp_path / "r.nc")
    assert tree["contact/couplings/menisci/meniscus_force"].attrs == {"units": "N", "long_name": "meniscus force"}
    assert tree["contact/couplings/sliding/shear_displacement"].dims == ("x", "y")
    assert tree.groups == result.to_xarray().groups


def test_a_history(problem: asp.ContactProblem, tmp_path: Path) -> None:
    history = asp.solve(problem, asp.History([asp.MeanPressure(p) for p in (1e8, 2e8, 5e7)]))
    asp.save(history, tmp_path / "h.nc")
    again = asp.load(tmp_path / "h.nc")
    assert len(again.steps) == 3
    for found, result in zip(again.steps, history.steps, strict=True):
        same(found, result)
        assert (found.earlier is None) == (result.earlier is None)
        if result.earlier is not None:
            np.testing.assert_array_equal(found.earlier, result.earlier)
    np.testing.assert_array_equal(again.energies.residual, history.energies.residual)
    tree = asp.files.open_tree(tmp_path / "h.nc")
    np.testing.assert_array_equal(
        tree["path/couplings/menisci/meniscus_force"], [s.menisci.meniscus_force for s in history.steps]
    )
    assert "3, all converged" in repr(history)


def test_a_history_that_goes_on(problem: asp.ContactProblem, tmp_path: Path) -> None:
    first = asp.solve(problem, asp.MeanPressure(1e8))
    history = asp.solve(problem, asp.History([asp.MeanPressure(2e8)]), state=first.state)
    asp.save(history, tmp_path / "h.nc")
    again = asp.load(tmp_path / "h.nc")
    assert again.start is not None
    np.testing.assert_array_equal(again.start.pressure, first.pressure)
    assert again.start.memory.keys() == first.state.memory.keys()
    np.testing.assert_array_equal(again.start.permanent_indentation, first.permanent_indentation)
