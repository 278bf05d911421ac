"""Imports stand at the top of a module, except where they would make others pay for a library that
costs time.

A function may import a heavy library, or a module of this package that brings a heavy library which
its own module does not have yet, or several modules of this package, a millisecond each: a contact
without output needs no figures, reports and stresses. Everything else is imported at the top, where
a reader looks for it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping

from architecture.source import PACKAGE, Module, imports, library

HEAVY = {
    "PIL": "pictures, only where one is read or written",
    "SurfaceTopography": "1.1 s",
    "array_api_compat": "only for arrays of other libraries",
    "cupy": "only on a GPU",
    "cupyx": "only on a GPU",
    "dask": "an extra that may be missing",
    "distributed": "an extra that may be missing",
    "ducc0": "an extra that may be missing",
    "h5netcdf": "0.2 s with h5py",
    "h5py": "0.2 s",
    "jinja2": "0.1 s",
    "joblib": "0.1 s",
    "matplotlib": "0.5 s",
    "nicegui": "an extra that may be missing; 0.5 s",
    "numba": "0.3 s",
    "numpy": "0.1 s: `asperity --help` must answer within 0.2 s",
    "pandas": "0.4 s",
    "pint": "0.2 s",
    "pydantic": "0.1 s",
    "pydantic_core": "0.1 s, with pydantic",
    "rich": "0.1 s, only where something is printed",
    "scipy": "0.05 to 0.3 s for every part of it",
    "tomli_w": "only where a document is written",
    "uvicorn": "comes with nicegui",
    "xarray": "0.4 s",
    "yaml": "comes with SurfaceTopography; only for older containers of contact.engineering",
}
"""Libraries that may be imported late, and why. Parts of scipy count one by one."""

SEVERAL = 4
"""Modules of this package that a late import must spare where it brings no heavy library."""

STANDARD = {
    "fcntl": "missing on Windows",
    "resource": "missing on Windows",
    "importlib.metadata": "20 ms, for the version only",
    "importlib.resources": "10 ms",
    "json": "commands that print JSON",
    "traceback": "internal errors only",
}
"""Modules of Python itself that may be imported late, and why."""

REMAINING = {"studies": 2}
"""Late imports by folder that the rule forbids and that are still there. The numbers may only
fall."""


MOST = 250
"""Imports in functions of the whole package, those by name counted. The number may only fall."""


def outside(target: str) -> str:
    """The heavy library, or part of scipy, that ``target`` belongs to; empty if none."""
    parts = target.split(".")
    return ".".join(parts[:2]) if parts[0] == "scipy" else parts[0] if parts[0] in HEAVY else ""


class Costs:
    """The heavy libraries that importing each of some modules brings, with all that they import in
    turn."""

    def __init__(self, modules: Mapping[str, Module]) -> None:
        self._modules = modules
        self._brought: dict[str, tuple[frozenset[str], frozenset[str]]] = {}

    def home(self, target: str) -> str:
        """Module in which the imported ``target`` is defined."""
        while target and target not in self._modules:
            target = target.rpartition(".")[0]
        return target

    def spares(self, target: str, name: str) -> bool:
        """Whether the module ``name`` would pay for the ``target`` at its top."""
        libraries, modules = self.of(target)
        present, loaded = self.of(name)
        return bool(libraries - present) or len(modules - loaded) >= SEVERAL

    def of(self, name: str) -> tuple[frozenset[str], frozenset[str]]:
        """Heavy libraries and modules of this package that come with the module ``name``."""
        if name not in self._brought:
            seen: set[str] = set()
            waiting, libraries = [name], set()
            while waiting:
                current = waiting.pop()
                if current in seen or current not in self._modules:
                    continue
                seen.add(current)
                waiting.append(current.rpartition(".")[0])  # a package is imported before its modules
                for item in imports(self._modules[current]):
                    if item.late or item.typing:
                        continue
                    waiting.append(self.home(item.target))
                    libraries.add(outside(item.target))
            self._brought[name] = frozenset(libraries - {""}), frozenset(seen)
        return self._brought[name]


def violations(modules: Mapping[str, Module]) -> Iterator[tuple[str, str]]:
    """Folder and sentence for each late import in ``modules`` that saves nothing."""
    costs = Costs(modules)
    for name, module in modules.items():
        for item in imports(module):
            if not item.late or any(item.target == s or item.target.startswith(s + ".") for s in STANDARD):
                continue
            own = item.target.split(".")[0] == PACKAGE
            library = {outside(item.target)} - {""}
            if not (costs.spares(costs.home(item.target), name) if own else library - costs.of(name)[0]):
                yield module.folder, f"{name}:{item.line} imports {item.target} late, which saves next to nothing"


def test_imports_stand_at_the_top_unless_they_are_heavy() -> None:
    found: dict[str, list[str]] = {}
    for folder, sentence in violations({module.name: module for module in library()}):
        found.setdefault(folder, []).append(sentence)
    counts = Counter({folder: len(sentences) for folder, sentences in found.items()})
    too_many = {folder: found[folder] for folder in counts if counts[folder] > REMAINING.get(folder, 0)}
    assert too_many == {}, f"allowed for now: {REMAINING}; found: {dict(counts)}"


def test_late_imports_stay_few() -> None:
    assert len({(module.name, item.line) for module in library() for item in imports(module) if item.late}) <= MOST


def test_late_imports_without_a_reason_are_found() -> None:
    texts = {
        "asperity": "",
        "asperity.core": "",
        "asperity.core.light": "import math",
        "asperity.core.heavy": "import numpy as np\nfrom scipy import special",
        "asperity.core.chain": "from .heavy import f",
        "asperity.core.user": (
            "def f():\n    from .light import a\n    from .chain import b\n    import json, math\n    import scipy"
        ),
        "asperity.core.far": "from .light import a\nfrom .near import b",
        "asperity.core.near": "from .nearer import c",
        "asperity.core.nearer": "",
        "asperity.core.alone": "def f():\n    from .far import a\n    from .near import b",
        "asperity.core.other": (
            "import numpy\nfrom scipy import special\ndef f():\n    from .heavy import a\n    import scipy.optimize"
        ),
    }
    modules = {name: Module(name, text, is_package=name.count(".") < 2) for name, text in texts.items()}
    found = [sentence.split(" late")[0] for _, sentence in violations(modules)]
    assert found == [
        "asperity.core.user:2 imports asperity.core.light.a",
        "asperity.core.user:4 imports math",
        "asperity.core.alone:3 imports asperity.core.near.b",
        "asperity.core.other:4 imports asperity.core.heavy.a",
    ]
