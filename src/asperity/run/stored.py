"""Outcomes as files: one labelled tree with a group for each part, from which report and figures
are made again."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..contact.result import ContactResult
from ..core.quantity import Labelled
from ..core.status import Advice
from ..io.contacts import grid_lines, status_attributes
from ..io.kept import kept_from, kept_node
from ..io.paths import status_in
from ..io.results import contact_of, path_in, result_in, result_tree, root_attributes, whole
from ..io.tree import Node, datatree, read_tree, write_tree
from ..parts.part import Found, Part, Solved, Stored, Table, Words
from ..parts.registry import parts, versions
from .execute import Outcome, answered

if TYPE_CHECKING:
    import xarray

FIELD = "field"
"""Kind of the fields that parts store, by the name of its group in a file of one alone."""

OF_OUTCOME = "of_outcome"
"""Attribute of the root of a tree that holds the outcome of a document, not a result alone."""


def save_outcome(
    outcome: Outcome, path: str | Path, *, document: str | None = None, title: str = "", overwrite: bool = False
) -> None:
    """Write ``outcome``, and the text of the problem ``document`` it came from, to the NetCDF-4
    file ``path``.

    Every part has a group with its values and its text; ``load`` reads the contact,
    ``load_outcome`` everything.

    Raises
    ------
    OutputError
        If the file does not end in .nc, exists and ``overwrite`` is false, or cannot be written.
    InputError
        If the problem holds a type that files cannot hold.
    """
    write_tree(outcome_tree(outcome, document=document, title=title, streamed=True), path, overwrite=overwrite)


def outcome_to_xarray(outcome: Outcome) -> xarray.DataTree:
    """``outcome`` as ``xarray.DataTree``: one group for each part, units and long names on every
    variable."""
    return datatree(outcome_tree(outcome))


def outcome_tree(outcome: Outcome, *, document: str | None = None, title: str = "", streamed: bool = False) -> Node:
    """Tree of ``outcome``; where it is ``streamed`` the steps of a load path are made as they are
    written."""
    groups = dict(result_tree(outcome.path or outcome.result, streamed=streamed).children)
    for part in outcome.parts:
        if part.name in outcome.found:
            groups[part.name] = part_group(part, outcome, groups.get(part.name, Node()))
    attributes = root_attributes(outcome.result, document, versions()) | status_attributes(outcome.status)
    attributes |= {
        OF_OUTCOME: 1,
        "citation_keys": " ".join(outcome.citation_keys),
        "findings": json.dumps([asdict(finding) for finding in outcome.findings]),
    }
    return Node((), attributes | ({"report_title": title} if title else {}), groups)


def load_outcome(path: str | Path) -> Outcome:
    """The outcome in the file ``path``: contact, values and text of every part, findings and
    status.

    Of a file that holds a result alone, an outcome of the parts that need nothing else.

    Raises
    ------
    FileFormatError
        If the file is missing, damaged, not NetCDF-4, or holds no contact.
    """
    tree = read_tree(path)
    answer = result_in(tree, path)
    contact = contact_of(answer)
    with whole(path):
        return _outcome(tree, contact)


def _outcome(tree: Node, contact: ContactResult) -> Outcome:
    """Outcome of a ``tree`` that holds the ``contact``."""
    groups = tree.children
    steps = groups.get("path")
    course = None if steps is None or "control" not in steps else path_in(tree, contact)
    if OF_OUTCOME not in tree.attributes:
        return answered(contact, course, "contact", "plasticity", *(() if course is None else ("path",)))
    solved = Solved(contact.problem, contact.control, contact, course)
    found = {
        part.name: _found(part, groups[part.name], solved, course if part.name == "path" else None)
        for part in parts()
        if "words" in groups.get(part.name, Node()).attributes
    }
    # reports name when and with what an outcome was made, and the digests of its surfaces
    made = json.loads(tree.attributes["provenance"])
    surfaces = [made[key]["digest"] for key in ("surface", "counter_surface") if key in made]
    _require_texts("provenance", made["created"], *made["software"].values(), *surfaces)
    findings = []
    for known in json.loads(tree.attributes["findings"]):  # earlier files hold the text of one as a message
        values = {"fact": known.pop("message", ""), **known, "concerns": tuple(known.get("concerns", ()))}
        findings.append(item := Advice(**values))
        _require_texts("findings", item.level, item.criterion, item.fact, item.remedy, *item.concerns)
    outcome = Outcome(None, replace(solved, found=found), found, tuple(findings), status_in(tree.attributes))
    return replace(outcome, stored=dict(tree.attributes))


def part_group(part: Part, outcome: Outcome, before: Node = Node()) -> Node:
    """Group of values and text of ``part``, in addition to what the result itself has
    ``before``."""
    found = outcome.found[part.name]
    values = list(before.values)
    for quantity in part.quantities:
        if quantity.name in found.values and quantity.name not in before:
            values.append(Labelled(quantity, found.values[quantity.name]))
    there = {item.quantity.name for item in values}
    needed = {dim for item in values for dim in item.quantity.dims}
    values += [line for line in grid_lines(outcome.result) if line.quantity.name in needed - there]
    stored = part.at_work.stored(found)
    words = asdict(found.words or part.at_work.words(found, outcome.solved))
    attributes = {"words": json.dumps(words), "facts": json.dumps(dict(stored.facts))}
    attributes |= {"title": part.title}
    if found.citation_keys or "citation_keys" not in before.attributes:  # those of the contact are its own
        attributes |= {"citation_keys": " ".join(found.citation_keys)}
    fields = {name: kept_node(field, FIELD) for name, field in stored.fields.items()}
    return replace(
        before,
        values=tuple(values),
        attributes={**before.attributes, **attributes},
        children={**before.children, **fields},
    )


def _require_texts(where: str, *texts: Any) -> None:
    """Refuse, with a ValueError, what is no text."""
    for text in texts:
        if not isinstance(text, str):
            raise ValueError(f"{text!r:.60} in the {where} is no text")


def _found(part: Part, node: Node, solved: Solved, known: Any) -> Found:
    """Values and text of ``part`` from its group; ``known`` is the detail where the result itself
    holds it."""
    values = {item.quantity.name: item.values for item in node.values}
    fields = {name: kept_from(child, FIELD) for name, child in node.children.items() if "xx" in child}
    stored = Stored(fields, json.loads(node.attributes["facts"]))
    made = part.at_work.made_from(solved.result) if known is None else None
    detail = known if known is not None else part.at_work.restored(stored, solved) if made is None else made.detail
    keys = tuple(str(node.attributes["citation_keys"]).split())
    return Found(values, detail, citation_keys=keys, words=_words(json.loads(node.attributes["words"])))


def _words(described: Mapping[str, Any]) -> Words:
    tables = tuple(
        (str(heading), Table(tuple(map(str, table["headings"])), tuple(tuple(map(str, row)) for row in table["cells"])))
        for heading, table in described["tables"]
    )
    rows = {name: [(str(label), str(text)) for label, text in described[name]] for name in ("headline", "rows")}
    return Words(
        sentence=str(described["sentence"]),
        tables=tables,
        remarks=tuple(map(str, described["remarks"])),
        alarming=bool(described["alarming"]),
        holds=str(described.get("holds", "")),
        **rows,
    )
