"""From the text of a problem document to the objects that are solved: one case."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ..contact.boundary import Boundary, Free, FreeLine, Periodic
from ..contact.control import Approach, Control, Force, MeanGap, MeanPressure
from ..contact.history import Ramped, ramps
from ..contact.laws import Hardness, HardWall, InterfaceLaw, LayeredHardness
from ..contact.problem import ContactProblem, Flat
from ..contact.solvers.by_name import default_solver, solver_by_name
from ..contact.solvers.protocol import Solver
from ..core import units
from ..core.citations import citation_keys
from ..core.errors import InputError
from ..io.build_body import build_body
from ..io.build_surface import build_surfaces
from ..io.schemas.problem import (
    BoundaryTable,
    ControlTable,
    HardnessTable,
    LawTable,
    PathTable,
    ProblemDocument,
    SolverTable,
)
from ..io.schemas.values import EFFECTIVE, FROM_BODY, NONE
from ..parts.registry import parts
from ..solids.layers import Body, Layered, surface_material


@dataclass(frozen=True, eq=False)
class Case:
    """What a ``document`` describes.

    Attributes
    ----------
    document
        The document.
    problem
        Surfaces, bodies, boundary and law.
    control, path
        The load, and the load path that ends with it; empty for a single load.
    solver
        Method with its settings.
    asks
        What is asked of each part, by its name.
    """

    document: ProblemDocument
    problem: ContactProblem
    control: Control
    path: tuple[Control, ...]
    solver: Solver
    asks: Mapping[str, Any]

    @property
    def threads(self) -> int | None:
        """Number of threads that the document states."""
        return self.document.solver.threads

    @property
    def chooses_solver(self) -> bool:
        """Whether the document says anything of the method."""
        return any(value is not None for key, value in self.document.solver if key != "threads")

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers that its numbers will rest on."""
        asked = [part for part in parts() if part.name in self.asks]
        planned = {key for part in asked for key in part.citations(self.asks[part.name], self.problem)}
        return tuple(sorted({*citation_keys(self.solver), *planned}))

    def under(self, document: ProblemDocument) -> Case:
        """The same case with the load of ``document``, which differs in nothing else."""
        control, path = build_load(document.control)
        return replace(self, document=document, control=control, path=path)


def build(document: ProblemDocument, base_folder: str | Path = ".") -> Case:
    """Objects described by ``document``; its relative file paths start at ``base_folder``.

    Raises
    ------
    InputError
        If a file cannot be read, a material is unknown, or the parts do not fit together.
    """
    folder = Path(base_folder)
    body = build_body(document.body, folder)
    counter_body = build_body(document.counter_body, folder)
    surface, counter_surface = build_surfaces(document.surface, document.counter_surface, folder)
    problem = ContactProblem(
        surface,
        body,
        Flat() if counter_surface is None else counter_surface,
        counter_body,
        build_boundary(document.boundary),
        build_law(document.law, (body, counter_body)),
    )
    asks = {part.name: ask for part in parts() if (ask := part.asked(document, folder)) is not None}
    for part in parts():
        if part.name in asks:
            part.check(asks[part.name], problem)
    problem = _with_physics(problem, asks)
    control, path = build_load(document.control)
    return Case(document, problem, control, path, build_solver(document.solver, problem), asks)


def _with_physics(problem: ContactProblem, asks: Mapping[str, Any]) -> ContactProblem:
    """``problem`` with the film and the friction by which the parts join it."""
    joined: dict[str, Any] = {}
    for part in parts():
        joined |= part.coupling(asks[part.name]) if part.name in asks else {}
    return replace(problem, **joined)


def build_boundary(table: BoundaryTable) -> Boundary:
    """Boundary that ``table`` names."""
    if table.kind == "line":
        return FreeLine(None if table.datum is None else units.parse(table.datum, "length", "boundary.datum"))
    return Free() if table.kind == "free" else Periodic()


def build_law(table: LawTable, bodies: tuple[Body, ...]) -> InterfaceLaw:
    """Law that ``table`` names; a hardness from the body is the lower known one, of its top layer where it is coated.

    An effective hardness is that of the body with the lower hardness at its surface, which takes the indentation.
    """
    if not isinstance(table, HardnessTable):
        return HardWall()
    if table.hardness not in (FROM_BODY, EFFECTIVE):
        return Hardness(_pressure(table.hardness))
    tops = [(solid.strength.hardness, body) for body in bodies if (solid := surface_material(body)) is not None]
    known = [(hardness, body) for hardness, body in tops if not math.isnan(hardness)]
    if not known:
        coated = " (of a coated body the top layer counts)" if any(isinstance(b, Layered) for b in bodies) else ""
        raise InputError(
            f"hardness must be known for at least one body to be taken from it, but neither states one{coated}. "
            'Give law.hardness (--hardness) as a pressure, such as "5 GPa".'
        )
    hardness, softer = min(known, key=lambda item: item[0])
    coated_softer = table.hardness == EFFECTIVE and isinstance(softer, Layered) and softer.reduced.layers
    return LayeredHardness(softer) if coated_softer and isinstance(softer, Layered) else Hardness(hardness)


def build_load(table: ControlTable) -> tuple[Control, tuple[Control, ...]]:
    """The one control that ``table`` gives and no path, or the last control of its load path and the whole path."""
    if table.path is None:
        return build_control(table), ()
    path = build_path(table.path)
    return path[-1], path


def build_path(table: PathTable) -> tuple[Control, ...]:
    """The controls of the load path that ``table`` describes."""
    kinds: dict[str, tuple[Ramped, str]] = {
        "mean_pressure": (MeanPressure, "pressure"),
        "force": (Force, "force"),
        "approach": (Approach, "length"),
        "mean_gap": (MeanGap, "length"),
    }
    name = next(key for key in kinds if getattr(table, key) is not None)
    kind, quantity = kinds[name]
    texts: tuple[str, ...] = getattr(table, name)
    points = [0.0 if text == NONE else units.parse(text, quantity, f"control.path.{name}") for text in texts]
    return ramps(kind, points, steps=table.steps)


def build_control(table: ControlTable) -> Control:
    """The one control that ``table`` gives.

    Raises
    ------
    InputError
        If it gives a load path.
    """
    if table.path is not None:
        raise InputError(
            "control must be one load or position here, but is a load path. Give control.mean_pressure, force, approach or "
            "mean_gap."
        )
    if table.mean_pressure is not None:
        return MeanPressure(_pressure(table.mean_pressure))
    if table.force is not None:
        return Force(units.parse(table.force, "force", "control.force"))
    if table.approach is not None:
        return Approach(units.parse(table.approach, "length", "control.approach"))
    assert table.mean_gap is not None
    return MeanGap(units.parse(table.mean_gap, "length", "control.mean_gap"))


def build_solver(table: SolverTable, problem: ContactProblem) -> Solver:
    """Method with its settings; what ``table`` leaves out is the default of the method, or of this ``problem``."""
    chosen = default_solver(problem)
    name, tolerance = table.method or chosen.name, table.tolerance
    if tolerance is None and name == chosen.name:
        tolerance = chosen.tolerance
    return solver_by_name(name, tolerance, table.max_iterations, precision=table.precision)


def _pressure(value: float | str | None) -> float:
    return float("nan") if value is None else float(value)
