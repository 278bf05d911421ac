"""Layered bodies and line contacts in result files."""

from pathlib import Path

import numpy as np
import pytest
from catalogue import ON_ROCK, line, rough

import asperity as asp


@pytest.mark.parametrize(
    ("surface", "body", "boundary"),
    [
        (
            rough,
            asp.Layered([asp.Layer(asp.material("DLC"), 5e-9, asp.Frictionless())], asp.material("steel")),
            asp.Free(),
        ),
        (rough, asp.Layered([asp.Layer(asp.material("steel"), np.inf)], asp.RigidBase()), asp.Periodic()),
        (lambda: line((20, 1)), ON_ROCK, asp.FreeLine(1.0)),
    ],
)
def test_saved_and_loaded(surface, body, boundary, tmp_path: Path):
    """Unknown strengths are nan, which equals nothing, so bodies are compared as they print."""
    problem = asp.ContactProblem(surface(), body, boundary=boundary)
    asp.save(asp.solve(problem, asp.MeanPressure(1e7)), tmp_path / "layered.nc")
    loaded = asp.load(tmp_path / "layered.nc").problem
    assert vars(loaded.body).keys() == vars(body).keys()
    assert str(vars(loaded.body)) == str(vars(body))
    assert loaded.compliance == problem.compliance
    assert loaded.boundary == boundary
