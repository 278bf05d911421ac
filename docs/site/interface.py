"""Pages of the Python interface: every public name with its docstring, by subject."""

from __future__ import annotations

import inspect
from types import ModuleType

import asperity

SUBJECTS = {
    "surfaces": ("Surfaces", "Read, prepare, pair and characterise height maps.", ("surfaces",)),
    "solids": ("Bodies", "Elastic, layered and graded bodies; materials and liquids.", ("solids",)),
    "contact": ("Contact", "State a problem, prescribe a load, solve, and read the result.", ("contact",)),
    "physics": (
        "Physics of the interface",
        "Adhesion, menisci, friction, hardness, plastic flow, rolling, bodies that relax.",
        ("physics",),
    ),
    "stress": ("Stress", "Stresses below the surface, and where a body yields first.", ("stress",)),
    "studies": (
        "Documents, studies, comparison",
        "Run documents and campaigns; compare theories with the solution.",
        ("run", "studies"),
    ),
    "files": ("Files, pictures and reports", "Save, load, export, draw and report.", ("io", "plots", "report")),
    "core": ("Grids, engines, errors", "What everything else rests on.", ("core",)),
}
"""Pages of names: title, what is on them, and the packages whose names they hold."""

MODULES = {
    "generate": ("Generated surfaces", "Functions that make surfaces, and the spectra and statistics they take."),
    "roughness": ("Roughness", "Every quantity of a surface, one function or record each."),
    "solvers": ("Solvers", "Numerical methods for the normal contact."),
    "theories": (
        "Theories",
        "Closed-form theories; their formulas, inputs and limits are listed under [all theories](../theories.md).",
    ),
}
"""Pages of the modules that are public names."""


def pages() -> dict[str, str]:
    """Every page by its place on the site."""
    found = {}
    home = {name: getattr(asperity, name) for name in asperity.__all__ if not name.startswith("_")}
    packages = {name: _package(name, value) for name, value in home.items()}
    for page, (title, about, wanted) in SUBJECTS.items():
        names = [name for name, value in home.items() if packages[name] in wanted and not isinstance(value, ModuleType)]
        found[f"reference/api/{page}.md"] = _page(title, about, "asperity", names)
    for name, (title, about) in MODULES.items():
        module = home[name]
        names = [one for one in sorted(module.__all__) if getattr(module, one) is not home.get(one)]
        found[f"reference/api/{name}.md"] = _page(title, about, f"asperity.{name}", names)
    rows = [f"| [{title}]({page}.md) | {about} |" for page, (title, about, *_) in (SUBJECTS | MODULES).items()]
    found["reference/api/index.md"] = (
        INDEX + "\n".join(rows) + "\n\n```{toctree}\n:hidden:\n\n" + "\n".join((*SUBJECTS, *MODULES)) + "\n```\n"
    )
    return found


INDEX = """# Python interface

`import asperity as asp`: every name below is `asp.NAME`. Numbers are in SI units, arrays `[x, y]`
([conventions](../conventions.md)).

| | |
|---|---|
"""


def _package(name: str, value: object) -> str:
    """The folder of the package that a public name comes from."""
    if name == "Roughness":
        return "surfaces"
    _, package, *rest = getattr(value, "__module__", "asperity.core").split(".")
    return "stress" if package == "physics" and rest[0] == "stress" else package


def _page(title: str, about: str, module: str, names: list[str]) -> str:
    owner = asperity if module == "asperity" else getattr(asperity, module.rpartition(".")[2])
    kinds = {name: _kind(getattr(owner, name)) for name in names}
    lines = [f"# {title}", "", about, ""]
    tables = [name for name, kind in kinds.items() if kind == "data"]
    if tables:
        lines += [f"Tables and constants: {', '.join(f'`{name}`' for name in tables)}.", ""]
    documented = {name: kind for name, kind in kinds.items() if kind != "data"}
    lines += [
        "```{eval-rst}",
        ".. autosummary::",
        "   :nosignatures:",
        "",
        *(f"   ~{module}.{name}" for name in documented),
        "",
    ]
    for name, kind in documented.items():
        lines += [f".. auto{kind}:: {module}.{name}", *([] if kind == "function" else ["   :members:"]), ""]
    return "\n".join([*lines, "```", ""])


def _kind(value: object) -> str:
    if inspect.isclass(value):
        return "exception" if issubclass(value, Exception) else "class"
    return "function" if callable(value) else "data"
