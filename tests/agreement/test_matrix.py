"""The agreement matrix, row by row."""

from __future__ import annotations

from itertools import pairwise

import pytest
from agreement.matrix import MATRIX, Agreement

from asperity.theories.catalogue import THEORIES


@pytest.mark.parametrize("row", MATRIX, ids=lambda row: f"{row.theory}|{row.other}|{row.limit}")
def test_theories_meet(row: Agreement):
    differences = [row.difference(value) for value in row.towards or (0.0,)]
    assert differences[-1] <= row.tolerance, row.reason
    assert all(later < earlier for earlier, later in pairwise(differences))


def test_every_theory_of_rough_surfaces_has_a_row():
    named = {name for row in MATRIX for name in (row.theory, row.other)}
    assert {name for name, kind in THEORIES.items() if hasattr(kind, "from_roughness")} <= named


def test_rows_name_theories_and_say_why():
    for row in MATRIX:
        assert row.theory in THEORIES
        assert row.other in THEORIES or " " in row.other or "/" in row.other or "(" in row.other
        assert len(row.reason) >= 10
