"""The agreement matrix, row by row."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import pytest
from agreement.conductance import CONDUCTANCE
from agreement.conforming import CONFORMING
from agreement.fields_and_films import FIELDS_AND_FILMS
from agreement.heating import HEATING
from agreement.matrix import MATRIX as ROUGH_SURFACES
from agreement.matrix import Agreement
from agreement.sealing import SEALING
from agreement.single_contacts import SINGLE_CONTACTS
from agreement.summits import SUMMITS
from agreement.wear import WEAR
from reference_data import every_row

from asperity.theories.catalogue import THEORIES

MATRIX = (
    *ROUGH_SURFACES,
    *SUMMITS,
    *SINGLE_CONTACTS,
    *CONFORMING,
    *FIELDS_AND_FILMS,
    *CONDUCTANCE,
    *HEATING,
    *SEALING,
    *WEAR,
)
PAGE = Path(__file__).parents[2] / "docs/reference/agreement.md"


@pytest.mark.slow
@every_row(MATRIX, label=lambda row: f"{row.theory}|{row.other}|{row.limit}")
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


def test_the_page_shows_these_rows():
    rows = [f"| {row.theory} | {row.other} | {row.limit} | {row.tolerance:.2g} | {row.reason} |" for row in MATRIX]
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    shown = [line for line in lines if line.startswith("| ")][1:]
    assert shown == rows, f"the table of {PAGE.name} must be\n" + "\n".join(rows)
