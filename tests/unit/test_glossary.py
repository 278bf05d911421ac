"""The glossary names every word of the public names once, and nothing that does not exist."""

from __future__ import annotations

import re
from pathlib import Path

import asperity

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "develop" / "glossary.md"
TEXT = PAGE.read_text(encoding="utf-8")
SECTIONS = dict(re.findall(r"^## (.+?)\n(.*?)(?=^## |\Z)", TEXT, re.MULTILINE | re.DOTALL))
ENTRIES = re.findall(r"^- \*\*(.+?)\*\*(.*)$", SECTIONS["Terms"], re.MULTILINE)
TERMS = [term for term, _ in ENTRIES]
OTHER_TERMS = re.findall(r"\*\*(.+?)\*\*", " ".join(rest for _, rest in ENTRIES))
EVERYDAY = re.findall(r"\w+", SECTIONS["Everyday words"].partition("everywhere.")[2])
NOT_USED = [row[0].strip() for row in re.findall(r"^\| (.+?) \| (.+?) \|$", SECTIONS["Not used"], re.MULTILINE)[1:]]
PLACES = (asperity, *(getattr(asperity, module) for module in asperity.__all__))
NAMES = {name: getattr(place, name) for place in PLACES for name in dir(place) if name in place._names.home}
"""Public names, with what they stand for; of names in several modules the last."""

TECHNICAL = ("dynamics", "fem", "generate", "plots", "roughness", "solvers", "theories")
"""Modules with words of their own, such as the names of authors, shapes and methods, which their
pages explain."""


def words(name: str) -> list[str]:
    """Words of an identifier or of a term, in small letters and without the ending of the
    plural."""
    found = re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+", name)
    return [singular(word.lower()) for word in found]


def singular(word: str) -> str:
    if word.endswith("ies"):
        return word[:-3] + "y"
    return word[:-1] if word.endswith("s") and not word.endswith(("ss", "is", "us")) else word


def test_every_word_of_a_public_name_is_explained_or_everyday() -> None:
    known = {word for text in (*TERMS, *OTHER_TERMS, *EVERYDAY) for word in words(text)}
    # a name that an entry shows in code font is explained there, whole
    shown = set(re.findall(r"`(\w+)`", SECTIONS["Terms"]))
    elsewhere = {name for module in TECHNICAL for name in getattr(asperity, module).__all__}
    missing = {name: [w for w in words(name) if w not in known] for name in {*NAMES} - shown - elsewhere}
    assert {name: left for name, left in missing.items() if left} == {}, f"write an entry in {PAGE.name}"


def test_names_in_code_font_are_public() -> None:
    shown = re.findall(r"`(\w+)`", SECTIONS["Terms"])
    assert [name for name in shown if name not in NAMES] == [], f"{PAGE.name} names what is not public"


def test_each_term_has_one_entry_in_alphabetical_order() -> None:
    assert sorted(TERMS, key=str.lower) == TERMS
    every = [*TERMS, *OTHER_TERMS, *EVERYDAY]
    assert sorted({term for term in every if every.count(term) > 1}) == [], "one place for each word"
    assert [term for term, rest in ENTRIES if " — " not in rest or not rest.endswith(".")] == []


def test_everyday_words_are_in_use() -> None:
    used = {word for name in NAMES for word in words(name)} | {"version"}
    assert [word for word in EVERYDAY if singular(word) not in used] == []


def test_words_that_are_not_used_are_not_used() -> None:
    assert NOT_USED
    assert not set(NOT_USED) & {*TERMS, *OTHER_TERMS}
    public = "\n".join(item.__doc__ or "" for item in NAMES.values())
    pages = {path.name: path.read_text(encoding="utf-8") for path in DOCS.rglob("*.md") if path != PAGE}
    texts = {
        **pages,
        "docstrings of public names": public,
        "public names": "\n".join(" ".join(words(n)) for n in NAMES),
    }
    assert [
        f"{place}: {bad}"
        for place, text in texts.items()
        for bad in NOT_USED
        if re.search(rf"\b{bad}s?\b", text.lower())
    ] == []
