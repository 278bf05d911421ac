"""From the text of a problem document to the objects that are solved."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

from ..contact.boundary import Boundary, Free, FreeLine, Periodic
from ..contact.control import Approach, Control, Force, MeanGap, MeanPressure
from ..contact.laws import Hardness, HardWall, InterfaceLaw
from ..contact.problem import ContactProblem, Flat
from ..contact.solvers.by_name import solver_by_name
from ..contact.solvers.choose import default_solver
from ..contact.solvers.protocol import Solver
from ..core import units
from ..core.citations import citation_keys
from ..core.errors import InputError
from ..solids.body import Body, surface_material
from ..solids.layers import Layered
from ..stress.request import Planned, StressRequest
from .build_body import build_body
from .build_stress import build_stress, check_stress
from .build_surface import build_surfaces
from .schemas.problem import BoundaryTable, ControlTable, HardnessTable, LawTable, ProblemDocument, SolverTable
from .schemas.values import FROM_BODY


@dataclass(frozen=True)
class Case:
    """What a document asks for: ``problem``, ``control``, ``solver``, ``threads``, and if any the ``stress``."""

    problem: ContactProblem
    control: Control
    solver: Solver
    threads: int | None = None
    stress: StressRequest | None = None

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers that its numbers will rest on."""
        asked = () if self.stress is None else (Planned(self.stress, self.problem),)
        return citation_keys(self.problem, self.solver, *asked)


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
    solver = build_solver(document.solver, problem)
    stress = None if document.stress is None else build_stress(document.stress)
    if stress is not None:
        check_stress(stress, problem)
    return Case(problem, build_control(document.control), solver, document.solver.threads, stress)


def build_boundary(table: BoundaryTable) -> Boundary:
    """Boundary that ``table`` names."""
    if table.kind == "line":
        return FreeLine(None if table.datum is None else units.parse(table.datum, "length", "boundary.datum"))
    return Free() if table.kind == "free" else Periodic()


def build_law(table: LawTable, bodies: tuple[Body, ...]) -> InterfaceLaw:
    """Law that ``table`` names; a hardness from the body is the lower known one, of its top layer where it is coated."""
    if not isinstance(table, HardnessTable):
        return HardWall()
    if table.hardness != FROM_BODY:
        return Hardness(_pressure(table.hardness))
    surfaces = [solid for solid in map(surface_material, bodies) if solid is not None]
    known = [solid.strength.hardness for solid in surfaces if not math.isnan(solid.strength.hardness)]
    if not known:
        coated = " (of a coated body the top layer counts)" if any(isinstance(b, Layered) for b in bodies) else ""
        raise InputError(
            f"hardness must be known for at least one body to be taken from it, but neither states one{coated}. "
            'Give law.hardness (--hardness) as a pressure, such as "5 GPa".'
        )
    return Hardness(min(known))


def build_control(table: ControlTable) -> Control:
    """The one control that ``table`` gives."""
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
    name = table.method or chosen.name
    return solver_by_name(name, table.tolerance, table.max_iterations, precision=table.precision)


def _pressure(text: str | None) -> float:
    return float("nan") if text is None else units.parse(text, "pressure", "pressure")
