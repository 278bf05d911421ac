"""Makes the page of all theories from the catalogue and its declarations: ``make reference`` writes it anew."""

from __future__ import annotations

from pathlib import Path

from asperity.core.citations import reference
from asperity.core.parameters import Parameter, parameters
from asperity.core.values import Several
from asperity.theories.ask import ways_of
from asperity.theories.catalogue import FAMILIES
from asperity.theories.protocol import Described

PAGE = Path(__file__).with_name("theories.md")

HEAD = """# All theories

What `asperity theory --list` names, made from the catalogue by `make reference`. How to use them:
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
    sources = sorted({key for kind in listed for key in (*kind.citation_keys, *(bound.citation for bound in kind.limits))})
    parts.append("## Sources\n\n" + "\n".join(f"- [{key}] {reference(key)}" for key in sources) + "\n")
    return "\n".join(parts)


def section(kind: type[Described]) -> str:
    """What the page says of one theory."""
    measured = hasattr(kind, "from_roughness") or hasattr(kind, "of_roughness")
    lines = [f"### {kind.title}", "", f"`{kind.name}`, in Python `asperity.theories.{kind.__name__}`.", ""]
    lines += ["| input | unit | meaning | range | default |", "|---|---|---|---|---|"]
    lines += [
        f"| `{item.name}`{'*' if measured and not item.of else ''} | {item.unit or '–'} | {item.help} | {bounds(item)} | {default(item)} |"
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
        lines += ["Holds for:", "", *(f"- {bound.rule}. {bound.message} [{bound.citation}]" for bound in kind.limits), ""]
    lines.append(" ".join(f"[{key}]" for key in kind.citation_keys))
    return "\n".join(lines) + "\n"


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


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
