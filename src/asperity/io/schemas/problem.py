"""The whole problem document: two surfaces, two bodies, boundary, law, control and solver."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field, model_validator

from ...core.errors import InputError
from .surfaces import FileSurface, SurfaceTable
from .values import Count, Force, Fraction, Length, Method, PoissonRatio, Pressure, PressureOrBody, Table, Text

VERSION = 1
"""Version of the document that this package reads and writes."""

CONTROLS = ("mean_pressure", "force", "approach", "mean_gap")
"""Keys of the table [control], of which exactly one is given."""


class BodyTable(Table):
    """One body: a named ``material``, elastic constants, or ``rigid = true``."""

    material: Text | None = None
    materials_file: Text | None = None
    youngs_modulus: Pressure | None = None
    poisson_ratio: PoissonRatio | None = None
    hardness: Pressure | None = None
    yield_stress: Pressure | None = None
    name: Text | None = None
    rigid: bool = False

    @model_validator(mode="after")
    def _one_way(self) -> BodyTable:
        constants = [key for key in ("youngs_modulus", "poisson_ratio") if getattr(self, key) is not None]
        ways = [*(["rigid = true"] if self.rigid else []), *(["material"] if self.material else []), *constants[:1]]
        if len(ways) != 1:
            given = " and ".join(ways) or "none of these"
            raise InputError(
                f" must give a material, or youngs_modulus and poisson_ratio, or rigid = true, but gives {given}."
            )
        if len(constants) == 1:
            raise InputError(f" must give youngs_modulus and poisson_ratio together, but gives only {constants[0]}.")
        beside = [key for key in ("hardness", "yield_stress", "name") if getattr(self, key) is not None]
        if beside and not constants:
            raise InputError(f" may give {beside[0]} only together with youngs_modulus, but gives it with {ways[0]}.")
        if self.materials_file is not None and self.material is None:
            raise InputError(" may give a materials_file only together with a material, but gives it without.")
        return self


class BoundaryTable(Table):
    """What lies outside the grid."""

    kind: Literal["periodic", "free"] = "periodic"


class HardWallTable(Table):
    """No limit on the pressure."""

    kind: Literal["hard_wall"]


class HardnessTable(Table):
    """Pressure limited by a hardness, given or taken from the softer body."""

    kind: Literal["hardness"]
    hardness: PressureOrBody


LawTable: TypeAlias = Annotated[HardWallTable | HardnessTable, Field(discriminator="kind")]
"""One interface law, told apart by the key ``kind``."""


class ControlTable(Table):
    """What is prescribed: exactly one of these."""

    mean_pressure: Pressure | None = None
    force: Force | None = None
    approach: Length | None = None
    mean_gap: Length | None = None

    @model_validator(mode="after")
    def _exactly_one(self) -> ControlTable:
        given = [key for key in CONTROLS if getattr(self, key) is not None]
        if len(given) != 1:
            raise InputError(
                f" must give exactly one of {', '.join(CONTROLS)}, but gives {' and '.join(given) or 'none'}."
            )
        return self


class SolverTable(Table):
    """How the problem is solved; what is left out is chosen by the package."""

    method: Method | None = None
    tolerance: Fraction | None = None
    max_iterations: Count | None = None
    precision: Literal["mixed", "double", "single"] | None = None
    threads: Count | None = None


class ProblemDocument(Table):
    """A contact problem with its load and solver, as text."""

    version: Literal[1]
    title: str = ""
    surface: SurfaceTable
    counter_surface: SurfaceTable | None = None
    body: BodyTable
    counter_body: BodyTable = BodyTable(rigid=True)
    boundary: BoundaryTable = BoundaryTable()
    law: LawTable = HardWallTable(kind="hard_wall")
    control: ControlTable
    solver: SolverTable = SolverTable()

    @model_validator(mode="after")
    def _pair(self) -> ProblemDocument:
        if self.surface.mirror is not None:
            raise InputError("surface.mirror must be left out: only the counter_surface is turned over.")
        if isinstance(self.counter_surface, FileSurface) and self.counter_surface.mirror is None:
            raise InputError(
                'counter_surface.mirror must be given: "x" or "y" for a map measured facing its own body (how it is '
                'turned over to meet the other one), "none" for one already in the frame of the other surface.'
            )
        if self.body.rigid and self.counter_body.rigid:
            raise InputError("body and counter_body must not both be rigid: give one of them a material.")
        return self
