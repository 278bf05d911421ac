"""Stresses of a contact result: plane by plane in Fourier space, kept as one field or handed out as
a stream."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any, Literal, Protocol, TypeAlias

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.tensor import AXES, STRESSES, Displacement, StressTensor
from ...solids.layers import materials_of
from ...solids.viscoelastic import Viscoelastic, alike
from .boundaries import FreePlanes, PeriodicPlanes, Reader, Rows, require_held
from .field import OfTensor, StressField
from .regions import Everywhere, Plane, Selection, Where, planes, selection, stack
from .sharp import AtEdges
from .tractions import LoadedBody, Shear, ShearTraction, Sliding, Tractions

Direction: TypeAlias = float | tuple[float, float]
"""Angle in rad from +x towards +y, or a vector (x, y) of any length."""

Of: TypeAlias = Literal["body", "counter_body"]
"""Which of the two bodies of a contact."""

_ROWS = 64
"""Rows of a stress in memory that are read at a time."""


class Loaded(Protocol):
    """What stresses need of a contact result: its pressure (nx, ny) in Pa, and the problem.

    The problem has ``grid``, ``body``, ``counter_body`` and a ``boundary`` with a ``name``. One
    with a ``friction`` (``Coulomb``) brings its own shear traction on ``body``.
    """

    @property
    def pressure(self) -> RealArray:
        """Contact pressure."""

    @property
    def problem(self) -> Any:
        """The contact problem."""


class Planes(Protocol):
    """Fields on one plane after the other, for one kind of boundary."""

    def stress(self, plane: Plane, out: StressTensor | None = None) -> StressTensor:
        """Stress on ``plane``."""

    def read(self, plane: Plane, reader: Reader) -> None:
        """Give the stress on ``plane`` to ``reader``, some rows at a time."""

    def at(self, plane: Plane, places: Sequence[Selection]) -> list[RealArray]:
        """Stress on ``plane`` at each of some ``places``, (6, …)."""

    def displacement(self, plane: Plane, out: Displacement | None = None) -> Displacement:
        """Displacement of ``plane``."""


class Residual(Protocol):
    """Stress of a body beside that by its tractions, such as by plastic strain."""

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers on it."""

    def at(self, depth: float, *, above: bool, below: bool) -> RealArray:
        """(6, nx, ny) in Pa at ``depth`` (m), on the asked sides of it, or their mean."""

    def cell_at(self, depth: float, *, below: bool) -> int | None:
        """Number of the cell in depth on whose mean stress yield is required, at the lower or upper
        side of ``depth`` (m); None where there is none."""

    def yielding_depths(self) -> RealArray:
        """Depths (m) of the middle of these cells."""

    def means(self, pressure: RealArray, shear: RealArray | None) -> RealArray:
        """Mean stress (cells, 6, nx, ny) in Pa in all cells in depth, with that by the
        tractions."""


@dataclass(eq=False)
class WithResidual:
    """Stress by tractions on ``planes`` and the ``residual`` stress, in numbers of the type
    ``dtype``."""

    planes: Planes
    residual: Residual
    dtype: str
    _last: tuple[Plane, RealArray] | None = dataclasses.field(default=None, init=False)

    def _added(self, plane: Plane) -> RealArray:
        """Residual stress (6, nx, ny) on ``plane``; that of the last one is kept."""
        if self._last is None or self._last[0] != plane:
            sides = {"above": plane.side in ("above", "inside"), "below": plane.side != "above"}
            self._last = plane, self.residual.at(plane.depth, **sides).astype(self.dtype)
        return self._last[1]

    def stress(self, plane: Plane, out: StressTensor | None = None) -> StressTensor:
        """Stress (Pa) on ``plane``, written into the arrays of ``out`` if given."""
        found = self.planes.stress(plane, out)
        for component, added in zip(vars(found).values(), self._added(plane), strict=True):
            component += added
        return found

    def read(self, plane: Plane, reader: Reader) -> None:
        """Give the stress (Pa) on ``plane`` to ``reader`` some rows at a time."""
        added = self._added(plane)

        def whole(rows: Rows) -> Rows:
            for first, part in rows:
                yield first, part + added[:, first : first + part.shape[1]]

        self.planes.read(plane, lambda rows: reader(whole(rows)))

    def at(self, plane: Plane, places: Sequence[Selection]) -> list[RealArray]:
        """Stress (Pa) on ``plane`` at each of some ``places``, (6, …)."""
        added = self._added(plane)
        found = zip(self.planes.at(plane, places), places, strict=True)
        return [field + added[(slice(None), *place.index)] for field, place in found]

    def displacement(self, plane: Plane, out: Displacement | None = None) -> Displacement:
        """Refused: that by the plastic strain is known at the surface alone."""
        raise _displaced()


@dataclass(eq=False)
class OverCells(WithResidual):
    """The same, but at depths within cells on whose mean stress yield is required that mean, under
    the ``tractions``."""

    tractions: Tractions

    @cached_property
    def _means(self) -> RealArray:
        loads = self.tractions
        shear = np.stack([loads.shear_x, loads.shear_y]) if loads.sheared else None
        return self.residual.means(loads.pressure, shear).astype(self.dtype, copy=False)

    def _mean(self, plane: Plane) -> RealArray | None:
        """Mean stress (6, nx, ny) of the cell that ``plane`` is in; None where there is none."""
        cell = self.residual.cell_at(plane.depth, below=plane.side != "above")
        return None if cell is None else self._means[cell]

    def stress(self, plane: Plane, out: StressTensor | None = None) -> StressTensor:
        """Stress (Pa) on ``plane``, written into the arrays of ``out`` if given."""
        mean = self._mean(plane)
        if mean is None:
            return super().stress(plane, out)
        found = out or StressTensor(*(np.empty_like(part) for part in mean))
        for component, part in zip(vars(found).values(), mean, strict=True):
            component[...] = part
        return found

    def read(self, plane: Plane, reader: Reader) -> None:
        """Give the stress (Pa) on ``plane`` to ``reader`` some rows at a time."""
        mean = self._mean(plane)
        if mean is None:
            super().read(plane, reader)
        else:
            reader(
                (first, np.ascontiguousarray(mean[:, first : first + _ROWS]))
                for first in range(0, mean.shape[1], _ROWS)
            )

    def at(self, plane: Plane, places: Sequence[Selection]) -> list[RealArray]:
        """Stress (Pa) on ``plane`` at each of some ``places``, (6, …)."""
        mean = self._mean(plane)
        if mean is None:
            return super().at(plane, places)
        return [mean[(slice(None), *place.index)] for place in places]


def _displaced() -> InputError:
    return InputError(
        "displacement inside a body must be left out where it has flowed, since that by the plastic strain is "
        "known at the surface alone, but is asked for. result.plastic_flow.displacement is that of the "
        "surface."
    )


def residual_of(result: Any, of: Of, threads: int | None) -> Residual | None:
    """Residual stress that ``result`` knows of one of its bodies: that of plastic flow in the
    volume; None without."""
    flow = getattr(result, "plastic_flow", None)
    if flow is None or flow.of != of or not flow.flowed.points.size:
        return None
    found: Residual = flow.residual(threads)
    return found


def _planes_of(
    result: Loaded | LoadedBody,
    friction: float | Shear | None,
    direction: Direction,
    of: Of,
    *,
    displacement: bool = False,
) -> tuple[Tractions, object]:
    """Tractions of ``result`` on one of its bodies, and that body."""
    require.one_of(of, ("body", "counter_body"), "body in which stresses are asked")
    if isinstance(result, LoadedBody):
        if friction is not None or of != "body":
            raise InputError(
                "friction and counter body of prescribed tractions must be left out, since LoadedBody(body, "
                f"tractions) holds both, but are {friction!r} and {of!r}. Write Tractions(grid, pressure, "
                "Sliding(0.3)) for friction."
            )
        return result.tractions, result.body
    tractions, body = tractions_on(result, friction, direction, of), getattr(result.problem, of)
    if displacement:  # those that depend on the past are refused
        if any(isinstance(material, Viscoelastic) for material in materials_of(body)):
            raise InputError(
                "displacement inside a body must be left out where it is viscoelastic, since it depends on "
                "the past, but is asked for. The displacement of the surface is in the result."
            )
        if residual_of(result, of, None) is not None:
            raise _displaced()
    return tractions, body


def tractions_on(result: Loaded, friction: float | Shear | None, direction: Direction, of: Of) -> Tractions:
    """Tractions of ``result`` on one of its bodies; shear as for ``stress``, on the counter body in
    the other direction.

    Without ``friction`` the shear is that which the contact brings itself: found with stick and
    slip, or that of gross sliding.

    InputError if there are none, or the stresses by them depend on the past.
    """
    if not hasattr(result, "problem") or not hasattr(result, "pressure"):
        raise InputError(
            "result whose stresses are asked must be that of solve(problem, …) or LoadedBody(body, "
            f"tractions), but is of type {type(result).__name__}."
        )
    # Stresses must not depend on what has relaxed: layers that relax differently, a Poisson's ratio
    # that does. At the first instant all are elastic.
    materials, creep = materials_of(getattr(result.problem, of)), getattr(result, "creep", None)
    if creep is not None and creep.column("time")[-1] > 0.0 and materials and not alike(materials):
        raise InputError(
            "moduli of a viscoelastic body in which stresses are asked must relax in proportion to one "
            "another, with a constant Poisson's ratio, but do not: its stresses would depend on the past. Ask "
            "for those of an Elastic body with the moduli of that time."
        )
    found, own = getattr(result, "stick_slip", None), getattr(result.problem, "friction", None)
    shear: Shear
    if isinstance(friction, Sliding | ShearTraction):
        shear = friction
    elif friction is not None:
        if isinstance(direction, tuple):
            x, y = require.two(direction, "direction of sliding", "Write an angle in rad or a vector (x, y).")
            direction = math.atan2(require.finite(y, "direction of sliding"), require.finite(x, "direction of sliding"))
            if x == y == 0.0:
                raise InputError("direction of sliding must be a vector of some length, but is (0, 0).")
        shear = Sliding(friction, direction)
    elif found is not None:
        shear = ShearTraction(found.traction[0], found.traction[1])
    elif own is None or not hasattr(own, "coefficient"):
        shear = Sliding(0.0)
    elif isinstance(own.coefficient, np.ndarray):
        along = own.coefficient * result.pressure
        shear = ShearTraction(along * math.cos(own.direction), along * math.sin(own.direction))
    else:
        shear = Sliding(own.coefficient, own.direction)
    if of == "counter_body":
        if isinstance(shear, Sliding):
            shear = Sliding(shear.coefficient, shear.direction + math.pi)
        else:
            shear = ShearTraction(-shear.x, -shear.y)
    grid, boundary = result.problem.grid, result.problem.boundary
    return Tractions(grid, result.pressure, shear, boundary.name, getattr(boundary, "datum", None))


def stress(
    result: Loaded | LoadedBody,
    depths: Iterable[float],
    *,
    on: Where = Everywhere(),
    friction: float | Shear | None = None,
    direction: Direction = 0.0,
    of: Of = "body",
    displacement: bool = False,
    dtype: str = "float64",
    threads: int | None = None,
) -> StressField:
    """Stress inside a body of a contact, or under prescribed tractions, on planes parallel to its
    surface.

    InputError if the body is rigid, a depth negative or below a rigid base, a position outside the
    grid, or layers that can slip on a frictionless interface carry shear that nothing holds: a mean
    shear on the periodic boundary, and for the displacement any on the free one.

    Parameters
    ----------
    result
        Result of ``solve`` (or anything with its pressure and problem), or
        ``LoadedBody(body, tractions)``, which takes neither ``friction`` nor ``of``.
    depths
        Depths of the planes in m, >= 0; the depth of an interface gives the stress on both of its
        sides.
    on
        Points of the planes: ``Everywhere()``, a vertical ``Section(y="max")``, or a
        ``DepthProfile(x, y)``. Whatever is not asked for is not kept.
    friction
        Friction coefficient μ of a sliding contact, whose shear traction is μ times the pressure;
        or a ``ShearTraction(qx, qy)`` of fields. By default that of the problem of the result, if
        it has one. The pressure is taken as it is; ``solve`` couples the two where the problem has
        a friction.
    direction
        Direction of the shear traction on ``body`` where ``friction`` is a number: angle in rad
        from +x, or a vector.
    of
        ``"body"``, or ``"counter_body"``, whose z axis points into it, away from the body, and on
        which the shear traction acts the other way.
    displacement
        Whether to compute the displacements, too.
    dtype
        ``"float64"`` or ``"float32"``.
    threads
        Number of threads; ASPERITY_THREADS or all cores by default.

    Notes
    -----
    Periodic boundary: exact for the trigonometric interpolation of the tractions, no mean lateral
    strain, displacements relative to the mean of the surface (or to a rigid base). Free boundary:
    exact for constant tractions on pixels, to rounding in a homogeneous and to 1e-8 of the largest
    coefficient in a layered body; displacements zero at infinity (free line: at the datum of the
    contact). Plastic flow in the volume (``result.plastic_flow``): the residual stress of the
    plastic strain is added, which is constant in depth within each depth cell; yield is required of
    the mean over a cell, which ``result.plastic_flow.stress`` gives. Displacements are then
    refused. Stresses at the surface resolve what the grid resolves: at the edge of a contact they
    change within a pixel, and under friction the largest there are low by tens of percent.
    ``largest_tension``, ``largest_von_mises`` and their like take the edges between the pixels in,
    with an error.
    """
    loads, body = _planes_of(result, friction, direction, of, displacement=displacement)
    residual = residual_of(result, of, threads)
    job = StressPlanes(loads, body, depths, on=on, dtype=dtype, threads=threads, residual=residual)
    return _with_edges(job.whole(displacement=displacement), at_edges(result, loads, of, residual, threads))


def stress_planes(
    result: Loaded | LoadedBody,
    depths: Iterable[float],
    *,
    on: Where = Everywhere(),
    friction: float | Shear | None = None,
    direction: Direction = 0.0,
    of: Of = "body",
    displacement: bool = False,
    dtype: str = "float64",
    threads: int | None = None,
) -> Iterator[StressField]:
    """The planes of ``stress`` one by one, each a field of one plane: a volume need not fit in
    memory.

    Arguments and errors as for ``stress``; give the planes to ``save_stress`` or
    ``export_stress_vtk`` to write a volume.
    """
    loads, body = _planes_of(result, friction, direction, of, displacement=displacement)
    residual = residual_of(result, of, threads)
    job = StressPlanes(loads, body, depths, on=on, dtype=dtype, threads=threads, residual=residual)
    edges = at_edges(result, loads, of, residual, threads)
    return (_with_edges(field, edges) for field in job.each(displacement=displacement))


def _with_edges(field: StressField, edges: AtEdges | None) -> StressField:
    if edges is None:
        return field
    return replace(field, at_edges=OfTensor(edges.beside(field), field.tensor))


def at_edges(result: Any, loads: Tractions, of: Of, residual: Residual | None, threads: int | None) -> AtEdges | None:
    """What finds the largest stresses at the surface of the body ``of`` a contact under ``loads``;
    None of prescribed tractions and with a ``residual`` stress."""
    if residual is not None or not hasattr(type(result), "edges"):
        return None
    return AtEdges(result, loads, getattr(result.problem, of), partial(StressPlanes, threads=threads))


class StressPlanes:
    """Stress under any ``tractions`` on a body, and perhaps a ``residual`` one, ready to be
    computed; arguments and errors as for ``stress``.

    ``over_cells``: at depths within the cells of a body that flows the mean over the cell, of which
    yield is required.
    """

    def __init__(
        self,
        tractions: Tractions,
        body: object,
        depths: Iterable[float],
        *,
        on: Where = Everywhere(),
        dtype: str = "float64",
        threads: int | None = None,
        residual: Residual | None = None,
        over_cells: bool = False,
    ) -> None:
        require.one_of(dtype, ("float64", "float32"), "precision of stresses")
        self.planes = planes(body, depths)
        require_held(tractions, body)
        kind = PeriodicPlanes if tractions.boundary == "periodic" else FreePlanes
        by_load: Planes = kind(tractions, body, dtype=dtype, threads=threads)
        if residual is None:
            self._source = by_load
        elif over_cells:
            self._source = OverCells(by_load, residual, dtype, tractions)
        else:
            self._source = WithResidual(by_load, residual, dtype)
        self.dtype = dtype
        self._grid, self._pressure = tractions.grid, tractions.pressure
        self._place = self.place(on)
        keys = papers(body, tractions.boundary, sheared=tractions.sheared)
        self.citation_keys = keys if residual is None else tuple(sorted({*keys, *residual.citation_keys}))

    def each(self, *, displacement: bool = False) -> Iterator[StressField]:
        """One field after the other, each of one plane."""
        place = self._place
        for plane in self.planes:
            if place.index == (slice(None), slice(None)):
                tensor = self._source.stress(plane)
            else:
                tensor = StressTensor(*self._source.at(plane, [place])[0])
            moved = None
            if displacement:
                moved = self._source.displacement(plane).map(lambda c: c[place.index][None].copy())
            yield self._field((plane,), tensor.map(lambda c: c[None]), moved, place)

    def read(self, plane: Plane, reader: Reader) -> None:
        """Give the stress (Pa) on ``plane`` to ``reader`` a few rows at a time; each thread calls
        it with those of its share."""
        self._source.read(plane, reader)

    def along(self, lines: Sequence[Where], plane: Plane) -> list[StressField]:
        """Fields of ``plane`` on each of ``lines`` (sections and profiles)."""
        places = [self.place(line) for line in lines]
        found = zip(places, self._source.at(plane, places), strict=True)
        return [self.field(plane, place, fields) for place, fields in found]

    def place(self, where: Where) -> Selection:
        """Points of the grid at ``where``."""
        return selection(where, self._grid, self._pressure)

    def field(self, plane: Plane, place: Selection, components: RealArray) -> StressField:
        """Field of the ``components`` (6, …) of ``plane`` at ``place``."""
        return self._field((plane,), StressTensor(*components[:, None]), None, place)

    def whole(self, *, displacement: bool = False) -> StressField:
        """All planes in one field; needs the memory of the field and of one plane."""
        shape = len(self.planes), *self._place.shape
        tensor = StressTensor(*(np.empty(shape, self.dtype) for _ in STRESSES))
        moved = Displacement(*(np.empty(shape, self.dtype) for _ in AXES)) if displacement else None
        for number, field in enumerate(self.each(displacement=displacement)):
            for found, kept in ((field.tensor, tensor), (field.displacement, moved)):
                for name, component in vars(found).items() if found is not None else ():
                    getattr(kept, name)[number] = component[0]
        return self._field(self.planes, tensor, moved, self._place)

    def _field(
        self, planes: tuple[Plane, ...], tensor: StressTensor, moved: Displacement | None, place: Selection
    ) -> StressField:
        dims = ("plane", *place.dims)
        grid, keys = self._grid, self.citation_keys
        row = grid.shape[1] == 1
        return StressField(planes, tensor, moved, place.x, place.y, dims, grid.spacing, keys, single_row=row)


def papers(body: object, boundary: str, *, sheared: bool) -> tuple[str, ...]:
    """Keys of the papers that stresses in ``body`` rest on, under pressure and perhaps shear, for a
    ``boundary`` by name."""
    keys = {"Johnson1985"}
    if stack(body).layers:
        keys |= {"Burmister1945", "Tan2006"}
    if boundary == "free line":
        keys |= {"Liu2002", "Flamant1892"}
    elif boundary == "free":
        keys |= {"Liu2002", "Love1929"} | ({"Cerruti1882"} if sheared else set())
    return tuple(sorted(keys))
