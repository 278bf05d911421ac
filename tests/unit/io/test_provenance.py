"""Provenance names software, time and inputs, and is fit for JSON."""

from __future__ import annotations

import json
from dataclasses import fields, replace
from datetime import UTC, datetime

import numpy as np

import asperity as asp
from asperity.contact.certificate import Certificate
from asperity.contact.result import OF_EDGES, ContactResult
from asperity.core.arrays import array_digest
from asperity.io.description import provenance
from asperity.io.words import ALL_SCALARS, CERTIFICATE, FIELDS


def test_software_and_time_are_those_of_now(elastic: asp.ContactResult) -> None:
    described = provenance(elastic)
    assert described["software"]["numpy"] == np.__version__
    assert described["software"]["asperity"] == asp.__version__
    assert described["software"]["fft_library"].split()[0] in {"ducc0", "numpy"}
    age = datetime.now(UTC) - datetime.fromisoformat(described["created"])
    assert -1.0 < age.total_seconds() < 60.0


def test_inputs_are_named_by_origin_and_content(plastic: asp.ContactResult, elastic: asp.ContactResult) -> None:
    described = provenance(plastic)
    assert json.loads(json.dumps(described)) == described
    assert described["surface"]["digest"] == array_digest(plastic.problem.surface.heights)
    assert described["surface"]["history"] == ["levelled by a plane", "cropped"]
    assert described["surface"]["citation_keys"] == ["Roettger2022"]
    assert described["surface"]["instrument"] == {"model": 'NV "7300"'}
    assert described["counter_surface"]["digest"] != described["surface"]["digest"]
    assert described["citation_keys"] == list(plastic.citation_keys)
    assert "counter_surface" not in provenance(elastic)


def test_digest_follows_the_content(elastic: asp.ContactResult) -> None:
    surface = elastic.problem.surface
    other = surface.with_heights(surface.heights + 1e-12, "raised")
    changed = replace(elastic, problem=replace(elastic.problem, surface=other))
    assert provenance(changed)["surface"]["digest"] != provenance(elastic)["surface"]["digest"]


def test_tables_of_labels_are_complete() -> None:
    """A field added to result or certificate must get a label, or it would be missing in files and
    reports."""
    other = {"problem", "control", "plastic", "certificate", "status", "citation_keys"}
    other |= {"couplings", "memory", "earlier", "deflections"}
    labelled = {item.name for item in (*FIELDS, *ALL_SCALARS)}
    assert labelled | other == {f.name for f in fields(ContactResult)} | set(OF_EDGES)
    assert [item.name for item in CERTIFICATE] == [
        f.name
        for f in fields(Certificate)
        if f.name not in ("couplings", "rounds", "complementarity", "pressure_error")
    ]
