"""Documents with the table [tractions]: a body under prescribed loads, whose stresses are computed
without any contact, and their files."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias, Union

import numpy as np
from pydantic import Field, model_validator

from ..core.arrays import RealArray
from ..core.errors import FileFormatError, InputError
from ..core.grid import Grid
from ..core.quantity import Labelled, Quantity
from ..core.settings import Settings, setting, table_of, validated
from ..core.status import Outcome as Ended
from ..core.status import Status
from ..core.text import require_file
from ..core.units import show
from ..core.values import NonEmpty, Points, Size
from ..io.contacts import grid_lines
from ..io.description import describe, software
from ..io.schemas.bodies import BodyTable
from ..io.schemas.problem import SolverTable
from ..io.tree import Node, write_tree
from ..io.words import Rows, body_text
from ..parts.part import Found, Part, Solved, Stage, no_stage
from ..physics.stress.loads import LineLoad, PatchLoad, PointLoad
from ..physics.stress.part import Stress, StressSettings, Yielding, stress_request
from ..physics.stress.tractions import LoadedBody, ShearTraction, Tractions
from ..surfaces.formats import checked_size
from ..surfaces.text_files import table as numbers_of
from .build import build_body
from .document import TRACTIONS
from .execute import Outcome
from .stored import part_group

LOADS = MappingProxyType({"point": PointLoad, "line": LineLoad, "patch": PatchLoad})
"""What makes each kind of load; its table has the keys that it declares."""

LOAD_TABLES = MappingProxyType({kind: table_of(made, Settings, f"kind={kind}") for kind, made in LOADS.items()})

if TYPE_CHECKING:
    LoadTable: TypeAlias = Any
else:
    LoadTable = Annotated[Union[tuple(LOAD_TABLES.values())], Field(discriminator="kind")]  # noqa: UP007

FIELDS = (
    Quantity("pressure", "Pa", "prescribed pressure", dims=("x", "y")),
    Quantity("shear_x", "Pa", "prescribed shear traction along x", dims=("x", "y")),
    Quantity("shear_y", "Pa", "prescribed shear traction along y", dims=("x", "y")),
)
"""Tractions of the result file, and keys of files in the document, with ``_file`` behind."""


class TractionsTable(Settings):
    """Tractions on a grid from 0 to ``size``: the sum of all ``loads`` and of arrays in files.

    Arrays (nx, ny) are in Pa, from ``.npy`` files or text with a row for each x. ``points`` may be
    left out with arrays.
    """

    size: Size = setting(help='physical size of the grid, such as "20 um x 10 um"')
    points: Points | None = setting(None, help="number of points along x and y")
    boundary: Literal["periodic", "free", "line"] = setting("periodic", help="what lies outside the grid")
    loads: tuple[LoadTable, ...] = ()
    pressure_file: NonEmpty | None = setting(None, help="file with an array of the pressure, positive in compression")
    shear_x_file: NonEmpty | None = setting(None, help="file with an array of the shear traction along x")
    shear_y_file: NonEmpty | None = setting(None, help="file with an array of the shear traction along y")

    @property
    def files(self) -> dict[str, str]:
        """Names of files by the name of the field."""
        return {q.name: path for q in FIELDS if (path := getattr(self, f"{q.name}_file")) is not None}

    @model_validator(mode="after")
    def _some_load(self) -> TractionsTable:
        if not self.loads and not self.files:
            raise InputError(
                " must hold a load, but holds none: give [[tractions.loads]] of kind point, line or patch, or "
                "pressure_file, shear_x_file or shear_y_file."
            )
        if self.points is None and not self.files:
            raise InputError(".points must be given where no file states them, such as points = [128, 128].")
        return self


class TractionsDocument(Settings):
    """A body under prescribed tractions, and the stresses that are wanted."""

    version: Literal[2]
    title: str = ""
    body: BodyTable = setting(help='material name, "E=140GPa,nu=0.25", or layers such as "DLC:5nm/steel"')
    tractions: TractionsTable
    stress: StressSettings = setting(StressSettings())
    solver: SolverTable = SolverTable()

    @model_validator(mode="after")
    def _no_contact(self) -> TractionsDocument:
        if self.stress.inside != "body":
            raise InputError("stress.inside must be left out under prescribed tractions, which load the body alone.")
        if self.body.rigid:
            raise InputError("body must deform under prescribed tractions, but is rigid: give it a material.")
        return self


def checked_tractions(
    table: Mapping[str, Any], where: str = "problem document", names: Mapping[str, str] | None = None
) -> TractionsDocument:
    """Document made of the nested ``table``; arguments and errors as for ``document.checked``."""
    return validated(TractionsDocument, table, where, names)


def build_tractions(document: TractionsDocument, folder: Path) -> LoadedBody:
    """The loaded body that ``document`` describes; its relative paths start at ``folder``.

    Raises
    ------
    InputError
        If a load leaves the grid, or an array does not fit it.
    FileFormatError
        If a file cannot be read.
    """
    table = document.tractions
    arrays = {name: _array(folder / path, f"{name}_file") for name, path in table.files.items()}
    shape = table.points or next(iter(arrays.values())).shape
    size = checked_size(table.size, "a grid of tractions", shape)
    grid = Grid((shape[0], shape[1]), (size[0] / shape[0], size[1] / shape[1]))
    for name, array in arrays.items():
        if array.shape != grid.shape:
            raise InputError(
                f"array of tractions.{name}_file must have {shape[0]} x {shape[1]} points (rows along x), but has "
                f"{' x '.join(map(str, array.shape))}."
            )
    boundary: Any = "free line" if table.boundary == "line" else table.boundary
    half = [0.5 * step for step in grid.spacing]
    loads = []
    for load in table.loads:  # its positions are those of figures: the grid begins half a pixel before its first node
        given = load.given("kind")
        for key in ("at", "start", "end"):
            if key in given:
                given[key] = tuple(value - step for value, step in zip(given[key], half, strict=True))
        for key, step in zip("xy", half, strict=True):
            if key in given:
                given[key] = tuple(value - step for value in given[key])
        loads.append(load.makes(**given))
    total = Tractions.of(grid, *loads, boundary=boundary)
    nothing: RealArray = np.zeros(grid.shape)
    shear = ShearTraction(
        total.shear_x + arrays.get("shear_x", nothing), total.shear_y + arrays.get("shear_y", nothing)
    )
    pressure = total.pressure + arrays.get("pressure", nothing)
    return LoadedBody(build_body(document.body, folder), Tractions(grid, pressure, shear, boundary))


def _array(path: Path, key: str) -> RealArray:
    """Array of numbers in the file at ``path``."""
    what = f"array of tractions.{key}"
    require_file(path, what)
    try:
        array = np.load(path, allow_pickle=False) if path.suffix.lower() == ".npy" else numbers_of(path)
        found: RealArray = np.asarray(array, dtype=float)
    except (ValueError, TypeError, OSError, EOFError, IndexError) as error:
        raise FileFormatError(
            f"{what} must be numbers in a .npy file or in text with a row for each x, but {path} is not: {error}."
        ) from None
    if found.ndim != 2 or not np.isfinite(found).all():
        shown = "holds numbers that are not finite" if found.ndim == 2 else f"has {found.ndim} dimensions"
        raise InputError(f"{what} must have two dimensions of finite numbers, but {shown}.")
    return found


def traction_rows(loaded: LoadedBody, document: TractionsDocument) -> Rows:
    """What loads the body, in words."""
    tractions, (nx, ny) = loaded.tractions, loaded.tractions.grid.shape
    width, height = tractions.grid.size
    along_x, along_y, pressure = (mean * tractions.grid.area for mean in tractions.means)
    files = [f"{name.replace('_', ' ')} of {path}" for name, path in document.tractions.files.items()]
    kinds = [table.kind for table in document.tractions.loads]
    counted = [f"{kinds.count(kind)} of kind {kind}" for kind in dict.fromkeys(kinds)]
    unit = " on the length of the grid along y" if tractions.boundary == "free line" else ""
    return [
        ("body", body_text(loaded.body)),
        ("grid", f"{nx} × {ny} points, {show(width, 'm')} × {show(height, 'm')}, {tractions.boundary}"),
        ("loads", "; ".join([*counted, *files])),
        ("force into the body", show(pressure, "N") + unit),
        ("forces along x and y", f"{show(along_x, 'N')}, {show(along_y, 'N')}{unit}"),
        ("largest pressure", show(float(tractions.pressure.max()), "Pa")),
    ]


def run_tractions(document: TractionsDocument, folder: Path, *, stage: Stage = no_stage, lines: bool = True) -> Outcome:
    """Stresses under the tractions of ``document``, whose relative paths start at ``folder``;
    ``result`` is the ``LoadedBody``.

    Raises
    ------
    InputError
        If the document asks for what its body or grid does not have.
    """
    loaded: Any = build_tractions(document, folder)
    request = stress_request(document.stress)
    Stress().at_work.check(request, loaded.problem)
    nothing: Any = None
    solved = Solved(loaded.problem, nothing, loaded, threads=document.solver.threads, lines=lines, stage=stage)
    found: dict[str, Found] = {}
    both: tuple[Part, ...] = (Stress(), Yielding())
    for part in both:
        found[part.name] = part.at_work.compute(request, replace(solved, found=found))
    return Outcome(None, replace(solved, found=found), found, (), Status(Ended.CONVERGED, "Stresses computed."))


def save_tractions(outcome: Outcome, text: str, path: str | Path, *, overwrite: bool = False) -> None:
    """Write tractions and stresses of ``outcome``, and the ``text`` of its document, to the
    NetCDF-4 file ``path`` for ``open_tree``.

    Raises OutputError if the file exists and ``overwrite`` is false, or cannot be written.
    """
    loaded: Any = outcome.result
    fields = [Labelled(q, getattr(loaded.tractions, q.name)) for q in FIELDS]
    body = {"body": json.dumps(describe(loaded.body)), "boundary": loaded.tractions.boundary}
    groups = {TRACTIONS: Node((*grid_lines(outcome.result), *fields), body)}
    groups |= {part.name: part_group(part, outcome) for part, _ in outcome.sections}
    attributes = {
        "title": "stresses under prescribed tractions",
        "provenance": json.dumps({"created": datetime.now(UTC).isoformat(timespec="seconds"), "software": software()}),
        "citation_keys": " ".join(outcome.citation_keys),
        "document": text,
    }
    write_tree(Node((), attributes, groups), path, overwrite=overwrite)
