"""Scalars of a document by path, and its content freed of wording."""

from __future__ import annotations

from pathlib import Path

import pytest
from refusals import refused
from study_cases import PROBLEM

from asperity.core.arrays import content_digest
from asperity.core.errors import InputError
from asperity.run.document import checked
from asperity.studies.places import content, locate, problem_table, replaced, scalars

DOCUMENT = checked(PROBLEM)


@pytest.mark.parametrize(
    ("path", "unit"),
    [
        ("control.mean_pressure", "Pa"),
        ("body.layers.0.thickness", "m"),
        ("surface.seed", "1"),
        ("surface.points", "1"),
        ("surface.spectrum.rms_height", "m"),
        ("solver.tolerance", "1"),
        ("counter_body.material", "1"),
    ],
)
def test_scalars_are_found_also_where_the_document_leaves_them_out(path, unit):
    assert locate(DOCUMENT, path).unit == unit


@pytest.mark.parametrize(
    ("path", "nearest"),
    [
        ("control.pressure", "control.mean_pressure"),
        ("surface.generate.seed", "surface.seed"),
        ("body.layers.1.thickness", "body.layers.0.thickness"),
        ("thickness", "body.layers.0.thickness"),
        ("surface.rms_height", "surface.spectrum.rms_height"),
    ],
)
def test_a_bad_path_is_refused_with_the_nearest_names(path, nearest):
    with refused(InputError, "path", f"{path!r}", nearest):
        locate(DOCUMENT, path)


def test_tables_are_no_scalars():
    paths = {place.path for place in scalars(DOCUMENT)}
    assert {"body", "body.layers", "surface.spectrum", "stress", "counter_surface"} & paths == set()


def test_content_knows_values_and_not_their_wording():
    reworded = replaced(PROBLEM, ("control", "mean_pressure"), "2000 kPa")
    other = replaced(PROBLEM, ("control", "mean_pressure"), "2001 kPa")
    digests = [content_digest(content(checked(table), Path())) for table in (PROBLEM, reworded, other)]
    assert digests[0] == digests[1] != digests[2]


def test_title_and_threads_do_not_change_the_content():
    table = {**PROBLEM, "title": "another", "solver": {"threads": 3}}
    assert content(checked(table), Path()) == content(DOCUMENT, Path())


def test_the_content_of_a_file_counts_and_not_its_name(tmp_path):
    for name, text in (("a.txt", "1 2\n3 4\n"), ("b.txt", "1 2\n3 4\n"), ("c.txt", "1 2\n3 5\n")):
        (tmp_path / name).write_text(text)

    def found(name: str) -> object:
        surface = {"kind": "file", "path": name, "size": "1 um", "height_unit": "nm"}
        return content(checked({**PROBLEM, "surface": surface}), tmp_path)

    assert found("a.txt") == found("b.txt") != found("c.txt")
    assert found("missing.txt")["surface"]["path"] == "missing.txt"


def test_one_control_replaces_another_and_nothing_else_changes():
    changed = replaced(problem_table(DOCUMENT), ("control", "force"), "1.0 N")
    assert changed["control"] == {"force": "1.0 N"}
    assert problem_table(DOCUMENT)["control"] == {"mean_pressure": "2 MPa"}
    assert {key: value for key, value in changed.items() if key != "control"} == {
        key: value for key, value in problem_table(DOCUMENT).items() if key != "control"
    }
