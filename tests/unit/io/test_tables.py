"""Cells of tables that a spreadsheet would compute are written as text; numbers stay numbers."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import numpy as np
import pytest
import xarray
from refusals import refused

import asperity as asp
from asperity.io.tables import cell, table_text, write_table
from asperity.physics.stress.survey import StressRequest, survey
from asperity.report.study import _table


@pytest.mark.parametrize("text", ["=1+1", "+cmd|' /C calc'!A0", "-2+3", "@SUM(A1)", "\t=1", "\r=1", "=", "-"])
def test_what_begins_like_a_formula_is_text(text: str) -> None:
    assert cell(text) == "'" + text


@pytest.mark.parametrize("value", ["steel", "", "a=b", "-1e-9", "+3", "-inf", -1.5, np.float64(-2.0), True, None, 3])
def test_everything_else_stays(value: object) -> None:
    assert cell(value) is value


def test_a_table_is_read_back(tmp_path: Path) -> None:
    rows = [("name", "=x"), ('-a, "b"', -1.25), ("c", 1e-300)]
    write_table(rows, tmp_path / "table.csv")
    read = list(csv.reader(io.StringIO((tmp_path / "table.csv").read_text("utf-8"))))
    assert read == [["name", "'=x"], ['\'-a, "b"', "-1.25"], ["c", "1e-300"]]
    assert list(csv.reader(io.StringIO(table_text(rows)))) == read
    with refused(asp.errors.OutputError, "output file", str(tmp_path / "table.csv")):
        write_table(rows, tmp_path / "table.csv")


def test_names_of_layers_in_tables_of_stresses(tmp_path: Path) -> None:
    layer = asp.Layer(asp.Elastic(1e11, 0.3, name="=HYPERLINK(1)"), 1e-8)
    heights = 1e-9 * np.random.default_rng(1).standard_normal((8, 8))
    problem = asp.ContactProblem(
        asp.Surface(heights, 1e-8, periodic=True), asp.Layered([layer], asp.Elastic(2e11, 0.3))
    )
    asp.files.export_csv(survey(StressRequest(), asp.solve(problem, asp.MeanPressure(1e7))), tmp_path / "stress.csv")
    read = list(csv.reader(io.StringIO((tmp_path / "stress.csv").read_text("utf-8"))))
    names = {row[1] for row in read[1:]}
    assert "'=HYPERLINK(1)" in names
    assert not any(value.startswith("=") for row in read for value in row)
    assert all(float(row[5]) == float(row[5]) for row in read[1:] if row[4].startswith("max_"))


def test_cases_of_a_study(tmp_path: Path) -> None:
    data = xarray.Dataset(
        {"area": ("=axis", [-1.0, np.nan]), "cause": ("=axis", ["@x", "fine"])}, coords={"=axis": ["=a", "-3"]}
    )
    _table(data, tmp_path / "cases.csv")
    read = list(csv.reader(io.StringIO((tmp_path / "cases.csv").read_text("utf-8"))))
    assert read == [["'=axis", "area", "cause"], ["'=a", "-1.0", "'@x"], ["-3", "", "fine"]]
