"""Pages of the Python interface: one for each public module, with every name and its docstring, and
a table of the names at the top."""

from __future__ import annotations

import inspect
from types import ModuleType

from theories import escaped

import asperity
from asperity.core.words import first_paragraph


def pages() -> dict[str, str]:
    """Every page by its place on the site."""
    modules = {name: getattr(asperity, name) for name in asperity.__all__}
    top = [name for name in dir(asperity) if asperity._HOME.get(name)]
    place = {name: next((one for one, module in modules.items() if name in module.__all__), "") for name in top}
    alone = [name for name, module in place.items() if not module]
    found = {f"reference/api/{name}.md": _page(name, module, top) for name, module in modules.items()}
    rows = [f"| [{_title(module)}]({name}.md) | `asp.{name}` | {_about(module)} |" for name, module in modules.items()]
    names = [f"| `{name}` | {_where(place[name])} | {_first(getattr(asperity, name))} |" for name in top]
    cited = _documented("asperity", dict.fromkeys(alone, "function"))
    contents = ["```{toctree}", ":hidden:", "", *modules, "```", ""]
    found["reference/api/index.md"] = "\n".join([INDEX, *rows, "", TOP, *names, "", *cited, *contents])
    return found


INDEX = """# Python interface

`import asperity as asp`: every name stands in a module of its subject, as `asp.MODULE.NAME`. Numbers are in
SI units, arrays `[x, y]` ([conventions](../conventions.md)).

| subject | module | |
|---|---|---|"""

TOP = """## Names at the top

What most work needs stands at the top too: `asp.solve` is `asp.contact.solve`.

| name | of | |
|---|---|---|"""

SEE = {"theories": "Their formulas, inputs and limits are listed under [all theories](../theories.md)."}
"""What pages link to, by module."""


def _title(module: ModuleType) -> str:
    return (module.__doc__ or "").partition(":")[0]


def _about(module: ModuleType) -> str:
    return escaped(first_paragraph(module).partition(": ")[2])


def _where(module: str) -> str:
    return f"[{module}]({module}.md)" if module else "–"


def _first(item: object) -> str:
    return escaped(first_paragraph(item))


def _page(name: str, module: ModuleType, top: list[str]) -> str:
    kinds = {one: _kind(getattr(module, one)) for one in sorted(module.__all__)}
    about, *more = (module.__doc__ or "").split("\n\n")
    lines = [f"# {_title(module)}: `asperity.{name}`", "", escaped(" ".join(about.split()).partition(": ")[2]), ""]
    lines += [text for part in more for text in (escaped(" ".join(part.split())), "")]
    lines += [SEE[name], ""] if name in SEE else []
    both = [f"`{one}`" for one in kinds if one in top]
    lines += [f"At the top too, as `asp.NAME`: {', '.join(both)}.", ""] if both else []
    tables = [f"`{one}`" for one, kind in kinds.items() if kind == "data"]
    lines += [f"Tables, constants and types: {', '.join(tables)}.", ""] if tables else []
    documented = {one: kind for one, kind in kinds.items() if kind != "data"}
    return "\n".join([*lines, *_documented(f"asperity.{name}", documented)])


def _documented(module: str, kinds: dict[str, str]) -> list[str]:
    lines = [
        "```{eval-rst}",
        ".. autosummary::",
        "   :nosignatures:",
        "",
        *(f"   ~{module}.{name}" for name in kinds),
        "",
    ]
    for name, kind in kinds.items():
        lines += [f".. auto{kind}:: {module}.{name}", *([] if kind == "function" else ["   :members:"]), ""]
    return [*lines, "```", ""]


def _kind(value: object) -> str:
    if inspect.isclass(value):
        return "exception" if issubclass(value, Exception) else "class"
    return "function" if callable(value) else "data"
