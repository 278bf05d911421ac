"""The core of a problem document: two surfaces, two bodies, boundary, law, control and solver.
Parts add their tables to it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Field, model_validator

from ...contact.solvers.by_name import SOLVERS
from ...core import units
from ...core.errors import InputError, UnitError
from ...core.settings import Settings, setting
from ...core.values import Choice, Count, Fraction, Length, Number, Pressure, Written
from .bodies import BodyTable
from .surfaces import FileSurface, SurfaceTable

FROM_BODY = "from body"
"""Hardness that stands for that of the softer body: the effective one where it is layered and all
of its strengths are known."""

SURFACE = "surface"
"""Hardness that stands for the lower known one of the materials at the two surfaces, whatever lies
below them."""

EFFECTIVE = "effective"
"""Hardness that stands for that of the softer body with all its layers, by the depth of the
indentation."""

NONE = "0"
"""Turning point of a load path without load."""

MIDDLE = "middle"
"""Word for a position: of the line in the middle of a map."""


class PerLength(Written):
    """Force per length of a line contact, in N/m."""


@dataclass(frozen=True)
class Load(Number):
    """Forces, or forces per length such as ``"1 N/m"`` for a line contact."""

    def read(self, value: Any, what: str) -> float | str:
        """Number for text with a unit, which is kept."""
        if isinstance(value, str) and value not in self.words:
            try:
                found = PerLength(units.parse(value, "surface tension", what), value)
            except UnitError:
                return super().read(value, what)
            self.check(found, what)
            return found
        return super().read(value, what)


Method: TypeAlias = Annotated[str, Choice({name: name for name in SOLVERS})]
PressureOrBody: TypeAlias = Annotated[float | str, Number("hardness", above=0.0, words=(FROM_BODY, SURFACE, EFFECTIVE))]
PathPressure: TypeAlias = Annotated[float | str, Number("pressure", least=0.0, words=(NONE,))]
PathForce: TypeAlias = Annotated[float | str, Load("force", least=0.0, words=(NONE,))]
PathLength: TypeAlias = Annotated[float | str, Number("length", least=0.0, words=(NONE,))]

LOADS = ("mean_pressure", "force", "approach", "mean_gap")
"""What can be prescribed."""

CONTROLS = (*LOADS, "path")
"""Keys of the table [control], of which exactly one is given."""

STEPS = 10
"""Steps from one turning point of a load path to the next, if not said otherwise."""


class BoundaryTable(Settings):
    """What lies outside the grid: the same again, no load, or for a surface of one row the same
    line contact for ever.

    ``datum`` is the distance at which displacements of a line contact are called zero, by default
    the length of the grid.
    """

    kind: Literal["periodic", "free", "line"] = setting(
        "periodic",
        option="--boundary",
        help="what lies outside the map, a line being in plane strain with loads per metre",
    )
    datum: Length | None = setting(None, help="distance at which displacements of a line contact are called zero")

    @model_validator(mode="after")
    def _datum(self) -> BoundaryTable:
        if self.datum is not None and self.kind != "line":
            raise InputError(f".datum must be left out for the boundary {self.kind}: only a line contact has one.")
        return self


class HardWallTable(Settings):
    """No limit on the pressure."""

    kind: Literal["hard_wall"]


class HardnessTable(Settings):
    """Pressure limited by a hardness, given or taken from the softer body."""

    kind: Literal["hardness"]
    hardness: PressureOrBody = setting(
        help='limit of the pressure, "body" for the hardness of the softer body, with its layers by depth '
        'where their strengths are known ("effective": refused where not), or "surface" for that of '
        "the material at its surface alone"
    )


LawTable: TypeAlias = Annotated[HardWallTable | HardnessTable, Field(discriminator="kind")]
"""One interface law, identified by the key ``kind``."""


class PathTable(Settings):
    """A load or position that runs from zero through turning points: exactly one list of them, and
    ``steps`` from one to the next.

    Zero, with or without a unit, takes the load away. A mean gap starts at its first value and is
    never zero.
    """

    mean_pressure: tuple[PathPressure, ...] | None = None
    force: tuple[PathForce, ...] | None = None
    approach: tuple[PathLength, ...] | None = None
    mean_gap: tuple[PathLength, ...] | None = None
    steps: Count = setting(STEPS, option="--path-steps", help="steps from one turning point to the next")

    @model_validator(mode="after")
    def _exactly_one(self) -> PathTable:
        _require_one(self, LOADS)
        return self


class ControlTable(Settings):
    """What is prescribed: exactly one of these."""

    mean_pressure: Pressure | None = setting(None, option="--pressure", help="mean pressure: 50kPa")
    force: Annotated[float, Load("force", above=0.0)] | None = setting(
        None, option="--load", help="normal force: 1mN; of a line contact also per length: 1N/m"
    )
    approach: Length | None = setting(None, help="approach from first touch: 3nm")
    mean_gap: Length | None = setting(None, help="mean gap of the deformed surfaces")
    path: PathTable | None = setting(
        None, help="load path through turning points: 50MPa,0,80MPa (or forces, or approaches)"
    )

    @model_validator(mode="after")
    def _exactly_one(self) -> ControlTable:
        _require_one(self, CONTROLS)
        return self


def _require_one(table: Settings, keys: tuple[str, ...]) -> None:
    given = [key for key in keys if getattr(table, key) is not None]
    if given and getattr(table, given[0]) == ():
        raise InputError(
            f'.{given[0]} must hold at least one turning point, such as ["50 MPa", "0", "80 MPa"], but is empty.'
        )
    if len(given) != 1:
        raise InputError(f" must give exactly one of {', '.join(keys)}, but gives {' and '.join(given) or 'none'}.")


class SolverTable(Settings):
    """How the problem is solved; what is left out is chosen by the package."""

    method: Method | None = setting(None, option="--solver", help="method; chosen for the problem by default")
    tolerance: Fraction | None = setting(None, help="relative error at which to stop")
    max_iterations: Count | None = setting(None, help="iterations after which to give up")
    precision: Literal["mixed", "double", "single"] | None = setting(
        None, help="arithmetic of active_set; mixed by default"
    )
    threads: Count | None = setting(None, help="threads of the transforms; ASPERITY_THREADS or all cores by default")
    machine: Literal["cpu", "gpu"] | None = setting(
        None, help="where the normal contact is computed: a gpu needs the library CuPy; cpu by default"
    )


class ProblemDocument(Settings):
    """A contact problem with its load and solver, as text."""

    version: Literal[2]
    title: str = ""
    surface: SurfaceTable
    counter_surface: SurfaceTable | None = None
    body: BodyTable = setting(
        help='material name, "E=140GPa,nu=0.25,H=15GPa", or layers from the surface down on a base: '
        '"DLC:5nm/Cr:2nm/steel"; ~ behind a thickness: slips on what is below'
    )
    counter_body: BodyTable = setting(
        BodyTable(rigid=True), option="--counter", help="counter body, in the same way; rigid by default"
    )
    boundary: BoundaryTable = BoundaryTable()
    law: LawTable = HardWallTable(kind="hard_wall")
    control: ControlTable
    solver: SolverTable = SolverTable()

    @property
    def relaxes(self) -> bool:
        """Whether a homogeneous material of its bodies is viscoelastic."""
        parts = (part for body in (self.body, self.counter_body) for part in (body, *body.layers, body.base))
        return any(getattr(part, "relaxation", None) is not None for part in parts)

    @model_validator(mode="after")
    def _pair(self) -> ProblemDocument:
        if self.surface.mirror is not None:
            raise InputError("surface.mirror must be left out: only the counter_surface is turned over.")
        if self.surface.place is not None:
            raise InputError("surface.place must be left out: the counter_surface is placed against the surface.")
        if isinstance(self.counter_surface, FileSurface) and self.counter_surface.mirror is None:
            raise InputError(
                'counter_surface.mirror must be given: "x" or "y" for a map measured facing its own body (how it is '
                'turned over to meet the other one), "none" for one already in the frame of the other surface.'
            )
        forces = (self.control.force, *((self.control.path and self.control.path.force) or ()))
        if self.boundary.kind != "line" and any(isinstance(force, PerLength) for force in forces):
            raise InputError(
                "force per length must be given together with {boundary.kind=line} only, but is given for "
                f"the boundary {self.boundary.kind}; write a force, such as 1 N."
            )
        if self.body.rigid and self.counter_body.rigid:
            raise InputError("body and counter_body must not both be rigid: give one of them a material.")
        return self
