"""The page of all theories, from what they declare: text and formulas of their docstrings, inputs,
limits, sources."""

from __future__ import annotations

import re

from formulas import paragraphs, tex

from asperity.core.citations import reference
from asperity.core.parameters import Parameter, parameters
from asperity.core.values import Several
from asperity.theories.ask import ways_of
from asperity.theories.catalogue import FAMILIES
from asperity.theories.protocol import Described

HEAD = """# All theories

What `asperity theory --list` names, made from the declarations of the theories. How to use them:
[theories of contact](../how-to/theories.md); which must agree with which: [agreement](agreement.md). A star marks what
`--surface FILE` and `from_roughness` or `of_roughness` measure.
"""


def page() -> str:
    """Text of the page."""
    parts = [HEAD]
    for family, kinds in FAMILIES.items():
        parts.append(f"## {family}\n")
        parts += [section(kind) for kind in kinds]
    listed = [kind for kinds in FAMILIES.values() for kind in kinds]
    sources = sorted(
        {key for kind in listed for key in (*kind.citation_keys, *(bound.citation for bound in kind.limits))}
    )
    parts.append(
        "## Sources\n\n" + "\n".join(f"- ({key.lower()})=\\[{key}\\] {reference(key)}" for key in sources) + "\n"
    )
    return "\n".join(parts)


def section(kind: type[Described]) -> str:
    """What the page holds on one theory."""
    measured = hasattr(kind, "from_roughness") or hasattr(kind, "of_roughness")
    lines = [
        f"### {kind.title}",
        "",
        f"`{kind.name}`, in Python `asperity.theories.{kind.__name__}`.",
        "",
        *description(kind),
    ]
    lines += ["| input | unit | meaning | range | default |", "|---|---|---|---|---|"]
    lines += [
        (
            f"| `{item.name}`{'*' if measured and not item.of else ''} | {item.unit or '–'} | {escaped(item.help)} "
            f"| {bounds(item)} | {default(item)} |"
        )
        for item in parameters(kind)
    ]
    lines.append("")
    for way in ways_of(kind):
        given = [f"`{item.name}` ({item.unit or 'number'})" for item in way.given]
        beside = f", given {', '.join(given)}" if given else ""
        answers = ", ".join(column.name.replace(".", " ").replace("_", " ") for column in way.columns)
        lines += [f"Asked along `{way.axis.name}` ({way.axis.unit or 'number'}){beside}: {answers}.", ""]
    if kind.numbers:
        numbers = ", ".join(
            f"{column.label} ({'number' if column.unit == '1' else column.unit})" for column in kind.numbers
        )
        lines += [f"From the inputs alone: {numbers}.", ""]
    if kind.limits:
        lines += [
            "Holds for:",
            "",
            *(f"- {escaped(bound.rule)}. {escaped(bound.message)} [{bound.citation}]" for bound in kind.limits),
            "",
        ]
    lines.append("Sources: " + " ".join(f"[{key}]" for key in kind.citation_keys))
    return "\n".join(lines) + "\n"


def description(kind: type[Described]) -> list[str]:
    """The docstring of a theory up to its first section, with its formulas numbered."""
    made = []
    for paragraph, lines in paragraphs(kind.__doc__ or ""):
        if paragraph == "formula":
            for line in lines:
                made += ["$$", tex(line.strip().rstrip(".,")), "$$", ""]
        else:
            made += [escaped(" ".join(line.strip() for line in lines)), ""]
    return made


def escaped(text: str) -> str:
    """Plain text of a docstring in Markdown: code stays code, symbols with an index or a power
    become formulas."""
    roles = re.sub(r":\w+:`~?([^`]*)`", r"``\1``", text)
    parts = re.split(r"(``[^`]*``)", roles)
    return "".join(f"`{part[2:-2]}`" if part.startswith("``") else _prose(part) for part in parts)


def _prose(text: str) -> str:
    words = re.split(r"(\s+)", text)
    return "".join(_symbol(word) or re.sub(r"([*_\[\]<|$\\])", r"\\\1", word) for word in words)


def _symbol(word: str) -> str:
    """A word that is one symbol, with its punctuation outside of the formula; empty for any other
    word."""
    found = re.fullmatch(r"(\(?)(.+?)([,.:;)]*)", word)
    if found is None:
        return ""
    before, symbol, after = found.groups()
    if symbol.count("(") > symbol.count(")") and after.startswith(")"):
        symbol, after = symbol + ")", after[1:]
    letters = r"[A-Za-zα-ωΑ-Ωϑℓ][\u0304\u0302]?['*]?"
    power = r"\^\([^()]+\)|\^[\w*]+|[²³⁴⁵]"
    shape = rf"{letters}(_\([^()]+\)|_\w+)?({power})?(\(\w+\))?|{letters}({power})"
    if not re.fullmatch(shape, symbol) or not re.search(r"[_^*\u0304²³⁴⁵]", symbol):
        return ""
    return f"{before}${tex(symbol)}${after}"


def bounds(item: Parameter) -> str:
    """What values an input takes, in words."""
    values = item.values.item if isinstance(item.values, Several) else item.values
    return "–" if item.words else getattr(values, "rule", "") or "–"


def default(item: Parameter) -> str:
    """The default of an input in words."""
    if item.required:
        return "–"
    words = [word for word, value in item.words.items() if value == item.default]
    if words:
        return f"{words[0]}; or {', '.join(word for word in item.words if word != words[0])}"
    return "none" if item.default is None or item.default == () else f"{item.default:g}"
