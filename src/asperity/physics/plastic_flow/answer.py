"""What flows plastically beneath a contact."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np

from ...contact.answer import Answer
from ...contact.boundary import Free
from ...contact.certificate import Certificate
from ...contact.couplings.protocol import Memory
from ...contact.problem import ContactProblem
from ...core.arrays import RealArray
from ...core.quantity import given, measured
from ...core.status import Advice
from ...core.units import percent, show
from ...solids.eigenstrain.cells import interfaces
from ...solids.eigenstrain.flow import Flowed
from ...solids.elastic import Elastic, Rigid
from ...solids.layers import Layered, RigidBase
from ...solids.plasticity import J2
from .law import plastic_body
from .residual_stress import LayerStress, ResidualStress, YieldingStress, layer_stresses, operator_of, tension_along

NAME = "plastic_flow"

REMEDY = "Take smaller steps of load, a little hardening, or a larger tolerance of the plastic flow."
"""What to do where the flow does not settle."""

SMALL_STRAIN = 0.1
"""Accumulated plastic strain from which small strains are no longer a good description."""


@dataclass(frozen=True)
class PlasticZone:
    """What has flowed in one layer or in the base.

    Attributes
    ----------
    name
        ``"layer 1"`` and so on from the surface down, or ``"base"``.
    volume
        m³ of the points that have flowed.
    top, bottom
        Least and largest depth in m that has flowed; NaN where nothing has.
    largest_strain
        Largest accumulated plastic strain.
    place
        x, y and depth (m) of it.
    first_yield
        Mean pressure (Pa) of the step in which the first point flowed; NaN where none has.
    first_place
        x, y and depth (m) of the largest plastic strain after that step.
    """

    name: str = measured("", "layer, or base")
    volume: float = measured("m**3", "volume that has flowed")
    top: float = measured("m", "least depth that has flowed")
    bottom: float = measured("m", "largest depth that has flowed")
    largest_strain: float = measured("1", "largest accumulated plastic strain")
    place: tuple[float, float, float] = measured("m", "x, y and depth of the largest plastic strain", "coordinate")
    first_yield: float = measured("Pa", "mean pressure of the step in which the first point flowed")
    first_place: tuple[float, float, float] = measured(
        "m", "x, y and depth of the largest plastic strain after that step", "coordinate"
    )


@dataclass(frozen=True, eq=False)
class PlasticBody(Answer):
    """Plastic flow of the body since it was virgin, after a step.

    Attributes
    ----------
    flowed
        Plastic strain, back stress and accumulated strain at the points that have flowed.
    displacement
        Displacement (nx, ny) in m of the surface by the plastic strain, positive into the body: the
        imprint that is left without load.
    work
        Plastic work in J: stress times plastic strain, of all steps.
    step_work
        The part of this step.
    residual_energy
        Elastic energy in J of the residual stress.
    zones
        One for each layer and the base.
    small_strain
        Whether all accumulated plastic strains are below 0.1.
    reaches_end
        Whether points in the deepest cell flow, at a depth that was prescribed or at the base.
    iterations
        Iterates of the plastic strain in this step, each an application of the operators of the
        volume.
    """

    problem: ContactProblem = given(repr=False)
    flowed: Flowed = measured("", "what has flowed", repr=False)
    displacement: RealArray = measured("m", "displacement of the surface by the plastic strain", "x", "y", repr=False)
    work: float = measured("J", "plastic work in the volume")
    step_work: float = measured("J", "plastic work of the step in the volume")
    residual_energy: float = measured("J", "elastic energy of the residual stress")
    zones: tuple[PlasticZone, ...] = measured("", "layers and base")
    reaches_end: bool = measured("1", "whether points in the deepest cell flow")
    iterations: int = measured("1", "iterates of the plastic strain", default=0)
    citation_keys: ClassVar[tuple[str, ...]] = ("Frerot2019", "Jacq2002")

    @classmethod
    def given_by(cls, problem: ContactProblem) -> Mapping[str, Any]:
        """The problem."""
        return {"problem": problem}

    def remembered(self, approach: float) -> Memory:
        """All but where the step ended; nothing where nothing has flowed."""
        if not self.flowed.points.size:
            return {}
        first = np.array([(zone.first_yield, *zone.first_place) for zone in self.zones])
        numbers = {
            "work": self.work,
            "step_work": self.step_work,
            "energy": self.residual_energy,
            "iterations": float(self.iterations),
        }
        named = {key: np.asarray(value) for key, value in numbers.items()}
        return {**self.flowed.memory, "lift": self.displacement, "first": first, **named}

    def imprint(self, part: str = "composite") -> RealArray | None:
        """Displacement by the plastic strain, in the composite surface and in that of the body
        which flows."""
        return self.displacement if part in ("composite", self.of) else None

    def stores(self, *, relaxing: bool) -> float:
        """Energy of the residual stress."""
        return self.residual_energy

    def contradicted(self) -> tuple[str, ...]:
        """Scalars of a limit of the pressure, which are zero without a hardness beside the work of
        the flow in the volume."""
        return "plastic_work", "total_plastic_work", "plastic_area_fraction", "indented_area"

    def flows(self) -> float:
        """Plastic work of this step."""
        return self.step_work

    def findings(self, certificate: Certificate) -> Iterator[Advice]:
        """Flow that is not settled, strains that are not small, and zones deeper than the cells or
        beyond the grid."""
        for check in certificate.couplings:
            if check.name == NAME and check.residual > check.tolerance:
                yield Advice(
                    "warning",
                    "plastic flow",
                    "The plastic strain is not settled: the return mapping still changes it by "
                    f"{check.residual:.1e} of itself (at most {check.tolerance:g} wanted).",
                    REMEDY,
                    {"change": check.residual, "largest": check.tolerance},
                    ("flow_", "total_plastic_work"),
                )
        if not self.small_strain:
            zone = max(self.zones, key=lambda item: item.largest_strain)
            where = "the base" if zone.name == "base" else zone.name
            yield Advice(
                "warning",
                "small strain",
                f"The plastic strain reaches {percent(zone.largest_strain)}, {show(zone.place[2], 'm')} deep "
                f"in {where}; above {percent(SMALL_STRAIN)} small strains are no longer a good description.",
                "Lower the load ({load}) or smooth sharp summits ({smooth}), or take imprint and pressures as "
                "qualitative there.",
                {"plastic_strain": zone.largest_strain, "largest": SMALL_STRAIN},
                ("flow_", "max_pressure"),
            )
        body = self.problem.body if self.of == "body" else self.problem.counter_body
        end = float(self.flowed.edges[-1]) if self.reaches_end else math.inf
        on_rigid = (
            isinstance(body, Layered) and isinstance(body.base, RigidBase) and end > (1.0 - 1e-9) * body.thickness
        )
        if self.reaches_end and not on_rigid:
            yield Advice(
                "warning",
                "depth of the cells",
                f"Points in the deepest cell flow, at {show(end, 'm', 3)}, and what lies below is held "
                "elastic: plastic strain and imprint are too small.",
                "Give a larger depth ({plastic_depth}), or none.",
                {"depth": end},
                ("flow_",),
            )
        if self.reaches_edge:
            yield Advice(
                "warning",
                "edge of the grid",
                "Points under the edge of the grid flow, and what lies beside the grid is held elastic: loads "
                "are too large, and plastic strain and imprint too small.",
                "Give a grid with a wider margin around the contact: on one of five contact radii loads are "
                "within 0.2 %.",
                concerns=("flow_", "force", "mean_pressure", "max_pressure"),
            )

    @property
    def small_strain(self) -> bool:
        """Whether all accumulated plastic strains are below 0.1."""
        return max((zone.largest_strain for zone in self.zones), default=0.0) < SMALL_STRAIN

    @property
    def reaches_edge(self) -> bool:
        """Whether points under the edge of a free grid have flowed: what lies beside the grid is
        held elastic."""
        if not isinstance(self.problem.boundary, Free) or not self.flowed.points.size:
            return False
        nx, ny = self.problem.grid.shape
        i, j = np.divmod(self.flowed.points % (nx * ny), ny)
        return bool(np.any((i == 0) | (i == nx - 1) | (j == 0) | (j == ny - 1)))

    @property
    def body(self) -> Elastic | Layered:
        """The body that flows."""
        return plastic_body(self.problem.body, self.problem.counter_body)[0]

    @property
    def laws(self) -> tuple[J2 | None, ...]:
        """Laws of its layers and of its base; None where it stays elastic."""
        assert self.problem.plastic_flow is not None
        return self.problem.plastic_flow.laws(self.body)

    @property
    def of(self) -> Literal["body", "counter_body"]:
        """Which body of the contact flows."""
        return "counter_body" if isinstance(self.problem.body, Rigid) else "body"

    @property
    def depths(self) -> RealArray:
        """Depths (cells,) in m of the middle of the depth cells; empty where nothing has flowed."""
        edges = self.flowed.edges
        return np.asarray(0.5 * (edges[1:] + edges[:-1]))

    def _field(self, values: RealArray) -> RealArray:
        """(cells, nx, ny, …) from ``values`` (n, …) at the points."""
        shape = self.problem.grid.shape
        found = np.zeros((self.depths.size * shape[0] * shape[1], *values.shape[1:]))
        found[self.flowed.points] = values
        return found.reshape(self.depths.size, *shape, *values.shape[1:])

    @property
    def accumulated(self) -> RealArray:
        """Accumulated plastic strain (cells, nx, ny)."""
        return self._field(self.flowed.state.accumulated)

    @property
    def plastic_strain(self) -> RealArray:
        """Plastic strain (cells, 6, nx, ny), components xx, yy, zz, xy, xz, yz."""
        return np.moveaxis(self._field(self.flowed.state.plastic_strain), -1, 1)

    def stress(
        self, pressure: RealArray | None = None, shear: RealArray | None = None, *, threads: int | None = None
    ) -> RealArray:
        """Mean stress (cells, 6, nx, ny) in Pa in the depth cells by the plastic strain and by
        these tractions.

        Without tractions this is the residual stress.

        Parameters
        ----------
        pressure, shear
            (nx, ny) and (2, nx, ny) in Pa on the plastic body, such as the ``pressure`` of the
            result; None for none.
        threads
            Number of threads.
        """
        if not self.depths.size:
            return np.zeros((0, 6, *self.problem.grid.shape))
        operator = operator_of(self.problem, self.flowed.edges, threads)
        return operator.stress(np.ascontiguousarray(self.plastic_strain), pressure, shear)[0]

    def residual(self, threads: int | None = None) -> ResidualStress:
        """Stress by the plastic strain alone at any depth; ``stress`` of a result adds it."""
        return ResidualStress(self, threads)

    def layers(
        self, pressure: RealArray | None = None, shear: RealArray | None = None, *, threads: int | None = None
    ) -> tuple[LayerStress, ...]:
        """Tension along the faces of each layer and tractions of the interface below it.

        Parameters as of ``stress``: without tractions those that remain when the load is gone.
        """
        return layer_stresses(YieldingStress(self.residual(threads), pressure, shear), interfaces(self.body))

    def surface_tension(
        self, pressure: RealArray | None = None, shear: RealArray | None = None, *, threads: int | None = None
    ) -> float:
        """Largest principal stress in Pa along the surface, as of ``layers``; negative where all of
        it is compressed."""
        return tension_along(YieldingStress(self.residual(threads), pressure, shear).at(0.0, below=True))
