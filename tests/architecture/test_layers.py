"""Imports point downwards: the layers of the library, as data."""

from __future__ import annotations

from architecture.source import PACKAGE, Import, Module, imports, library

LAYERS = {
    10: ("cli", "web"),
    9: ("report",),
    8: ("studies",),
    7: ("run",),
    6: ("parts",),
    5: ("plots",),
    4: ("io",),
    3: ("physics",),
    2: ("contact", "fem"),
    1: ("surfaces", "solids", "theories"),
    0: ("core",),
}
"""Folders by layer; a folder may import folders of lower layers only."""

DATA_FOLDERS = ("data",)
"""Folders that hold files, and at most an ``__init__`` that imports nothing of the library."""

SIDEWAYS = {("cli", "web"): "the command `asperity app` starts the web application"}
"""Sideways imports that are allowed, each with its reason."""

ROOMS = {"part": "parts", "work": "parts", "figures": "plots", "files": "io"}
"""Folder of whose layer a file in the folder of a physics is, by the beginning of its name; all
others are of ``physics`` itself."""

NAMED = {
    "asperity.contact.known": "names of the physics with their types, which only type checkers read",
    "asperity.contact.found": "names of what the physics found with their types, which only type checkers read",
}
"""Modules that may import upwards, each with its reason."""

LAYER_OF = {folder: layer for layer, folders in LAYERS.items() for folder in folders} | dict.fromkeys(DATA_FOLDERS, -1)
MODULES = library()
TOP_LEVEL = {"", *(module.folder for module in MODULES if module.name.count(".") == 1 and not module.is_package)}
"""The package itself and the files beside it, which stand above all layers: the public modules of
names from several folders, and the command."""


def violations(module: Module) -> list[str]:
    """One sentence for each import of ``module`` that does not point downwards."""
    return [
        f"{module.name}:{item.line} imports {item.target}"
        for item in imports(module)
        if not allowed(folder_of(module.name.split(".")), imported_folder(item))
    ]


def folder_of(parts: list[str]) -> str:
    """Folder whose layer the module of these ``parts`` of a name has."""
    if len(parts) < 2:
        return ""
    if parts[1] == "physics" and len(parts) > 3:
        return ROOMS.get(parts[3].partition("_")[0], "physics")
    return parts[1]


def imported_folder(item: Import) -> str | None:
    """Folder of the library that is imported, the empty text for the public names, None for foreign
    packages."""
    parts = item.target.split(".")
    if parts[0] != PACKAGE:
        return None
    folder = folder_of(parts)
    return folder if folder in LAYER_OF else ""


def allowed(importer: str, imported: str | None) -> bool:
    """Whether a module in the folder ``importer`` may import from the folder ``imported``."""
    if imported is None or importer in TOP_LEVEL or importer == imported:
        return True
    return LAYER_OF.get(importer, -1) > LAYER_OF.get(imported, 99) or (importer, imported) in SIDEWAYS


def test_imports_point_downwards() -> None:
    assert [text for module in MODULES if module.name not in NAMED for text in violations(module)] == []


def test_every_folder_has_a_layer_and_the_library_was_found() -> None:
    folders = {module.folder for module in MODULES} - TOP_LEVEL
    assert folders <= set(LAYER_OF), "give the new folder a layer in LAYERS"
    assert {"core", "solids", "surfaces"} <= folders


def test_upward_and_sideways_imports_are_found() -> None:
    samples = [
        ("asperity.core.grid", "from ..solids import elastic"),
        ("asperity.core.grid", "from ..solids.elastic import Elastic"),
        ("asperity.core.grid", "import asperity.solids.elastic as e"),
        ("asperity.core.grid", "def f():\n    from asperity.contact import solve"),
        ("asperity.core.grid", "if TYPE_CHECKING:\n    from ..surfaces.surface import Surface"),
        ("asperity.core.grid", "import importlib\nimportlib.import_module('asperity.io')"),
        ("asperity.contact.solve", "from .. import solve"),
        ("asperity.contact.solve", "from asperity import material"),
        ("asperity.contact.solve", "import asperity"),
        ("asperity.contact.solve", "from .. import stress"),
        ("asperity.contact.law", "from ..stress.field import Field"),
        ("asperity.contact.couplings.wet", "from ...parts.wet import Settings"),
        ("asperity.contact.problem", "from ..physics.menisci.physics import Wet"),
        ("asperity.physics.menisci.coupling", "from .part import Settings"),
        ("asperity.physics.menisci.figures", "from .part_more import Settings"),
        ("asperity.physics.menisci.physics", "from .figures import plot"),
        ("asperity.physics.stress.layered", "from ..adhesion.part import Result"),
        ("asperity.solids.library", "from ..surfaces import surface"),
        ("asperity.surfaces.pair", "from ..solids import elastic"),
        ("asperity.theories.single.hertz", "from ...solids import elastic"),
        ("asperity.io.words", "from ..plots import maps"),
        ("asperity.parts.contact", "from ..run import executor"),
        ("asperity.run.executor", "from ..report import page"),
        ("asperity.studies.sweep", "from ..report import page"),
        ("asperity.studies.sweep", "from ..cli import main"),
        ("asperity.run.document", "from ..report import html"),
        ("asperity.web.app", "from ..cli import main"),
        ("asperity.data", "from ..core import grid"),
    ]
    missed = [s for s in samples if len(violations(Module(*s, is_package=s[0] == "asperity.data"))) != 1]
    assert missed == []


def test_downward_imports_are_allowed() -> None:
    samples = [
        ("asperity.contact.solve", "from ..core.errors import InputError\nfrom .result import Result\nimport numpy"),
        (
            "asperity.physics.adhesion.law",
            "from ...contact.problem import ContactProblem\nfrom ...solids import elastic",
        ),
        (
            "asperity.physics.menisci.part",
            "from .figures import plot\nfrom .film import Film\nfrom ...parts.part import Part",
        ),
        ("asperity.run.executor", "from ..parts import registry\nfrom ..io import results"),
        ("asperity.report.study", "from ..run import document\nfrom ..studies import campaign"),
        ("asperity.cli.app", "from ..web import server\nfrom ..io import documents"),
        ("asperity", "from .cli import main"),
    ]
    assert [v for s in samples for v in violations(Module(*s, is_package=s[0] == "asperity"))] == []
