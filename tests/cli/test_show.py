"""What the tables of the command line say."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import asperity as asp
from asperity.cli.show import scalar_rows
from asperity.contact.result import SCALARS
from asperity.io.words import PLASTIC


def test_counts_are_shown_in_full_and_unknown_values_in_words(monkeypatch: pytest.MonkeyPatch) -> None:
    surface = asp.Surface(np.arange(16.0).reshape(4, 4) * 1e-9, 1e-7)
    solved = asp.solve(asp.ContactProblem(surface, asp.Elastic(1e9, 0.3)), asp.MeanPressure(1e6))
    monkeypatch.setattr(asp.ContactResult, "spot_areas", property(lambda result: np.ones(123456)))
    rows = dict(scalar_rows(replace(solved, normal_stiffness=math.nan, area_fraction=0.0123)))
    assert rows["number of contact spots"] == "123456"
    assert rows["normal stiffness per nominal area"] == "not computed"
    assert rows["real contact area / nominal area (pixels)"] == "0.0123 (1.23 %)"
    assert {quantity.label for quantity in SCALARS if quantity.name not in PLASTIC} <= set(rows)
    assert rows["solver"].startswith(solved.certificate.solver)
