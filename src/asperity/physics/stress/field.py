"""Stresses that were computed: components by plane, derived stresses, maxima with their places,
interfaces."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from operator import attrgetter
from typing import Any, cast

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Stored
from ...core.quantity import Quantity
from ...core.tensor import Displacement, StressTensor
from ...core.units import show
from ...solids.library import full_name
from . import criteria as invariants
from .largest import largest
from .peaks import MAXIMA, Peak, SurfaceMaxima, peak_text
from .regions import Plane, Region

DERIVED = (
    Quantity("sqrt_J2", "Pa", "√J2"),
    Quantity("von_mises", "Pa", "von Mises stress"),
    Quantity("tresca", "Pa", "Tresca stress"),
    Quantity("max_shear", "Pa", "largest shear stress"),
    Quantity("max_principal", "Pa", "largest principal stress"),
    Quantity("principal_tensile", "Pa", "principal stress in the plane"),
    Quantity("hydrostatic", "Pa", "mean normal stress"),
    Quantity("normal_xx", "Pa", "σxx"),
    Quantity("normal_yy", "Pa", "σyy"),
    Quantity("normal_zz", "Pa", "σzz"),
    Quantity("shear_xy", "Pa", "σxy"),
    Quantity("shear_xz", "Pa", "σxz"),
    Quantity("shear_yz", "Pa", "σyz"),
)
"""Attributes of a ``StressField`` that are stresses at its points."""


class FromTensor:
    """Attribute of a stress field that follows from its ``tensor`` alone: what ``of`` gives of
    that."""

    def __init__(self, of: Callable[[StressTensor], RealArray], text: str) -> None:
        self._of, self.__doc__ = of, text

    def __get__(self, field: Any, kind: type | None = None) -> RealArray:
        return cast("RealArray", self) if field is None else self._of(field.tensor)


@dataclass(frozen=True, eq=False)
class OfTensor:
    """What the ``edges`` of a contact give beside the ``tensor`` that was computed under the same
    loads, or planes of it; nothing beside another, such as a sum."""

    edges: Callable[[], SurfaceMaxima | None]
    tensor: StressTensor

    def __call__(self, tensor: StressTensor) -> SurfaceMaxima | None:
        """None where it is another tensor."""
        return self.edges() if tensor is self.tensor else None

    def kept(self, whole: StressTensor, part: StressTensor) -> OfTensor | None:
        """The same beside ``part``, some planes of the ``whole``."""
        return OfTensor(self.edges, part) if whole is self.tensor else None


@dataclass(frozen=True, eq=False)
class InterfaceStress:
    """Tractions an interface must carry, arrays over its points.

    ``shear`` is the magnitude of the shear traction in Pa, ``peel`` the normal one, positive in
    tension.
    """

    above: Region
    below: Region | None
    depth: float
    shear: RealArray
    peel: RealArray


@dataclass(frozen=True, eq=False, repr=False)
class StressField(Stored):
    """Stress inside a body on planes parallel to its surface; arrays (n, …) over planes and their
    points, in Pa.

    Attributes
    ----------
    planes
        The n planes in order of depth; the depth of an interface appears twice, above and below it.
    tensor
        Components xx, yy, zz, xy, xz, yz, tension positive. x and y are those of the contact, z
        points into the body.
    displacement
        Components x, y, z in m, or None where not asked for.
    x, y
        Coordinates of the points in m.
    dims
        Names of the axes of the arrays: "plane", then "x" and "y" as far as they are left.
    spacing
        Grid spacing (dx, dy) in m.
    citation_keys
        Keys of the papers the numbers rest on.
    single_row
        Whether the grid has one point along y, as in plane strain.
    at_edges
        Finds the largest stresses at the surface with the edges of the contact, of the tensor that
        was computed and of no other; None where there is no contact. Fields from files know them
        where they hold the whole plane at the surface.
    """

    planes: tuple[Plane, ...]
    tensor: StressTensor
    displacement: Displacement | None
    x: RealArray
    y: RealArray
    dims: tuple[str, ...]
    spacing: tuple[float, float]
    citation_keys: tuple[str, ...] = ()
    single_row: bool = False
    at_edges: OfTensor | None = None

    def in_words(self) -> tuple[str, list[tuple[str, str]]]:
        """Heading, planes and largest stresses."""
        counts = " × ".join(
            f"{n} along {axis}" for n, axis in zip(self.tensor.xx.shape[1:], self.dims[1:], strict=True)
        )
        first, last = (show(float(self.depth[end]), "m") for end in (0, -1))
        rows = [
            ("planes", f"{len(self.planes)}, depths {first} to {last}"),
            ("points of a plane", counts or "one"),
            ("regions", " / ".join(dict.fromkeys(region.name for region in self.regions))),
        ]
        for name, peak in (("von_mises", self.largest_von_mises), ("max_principal", self.largest_tension)):
            quantity = next(item for item in DERIVED if item.name == name)
            place = f"in {peak.region.name} at a depth of {show(peak.depth, 'm')}"
            rows.append((f"largest {quantity.label.removeprefix('largest ')}", f"{peak_text(peak)} {place}"))
        return "Stress field", rows

    @property
    def surface_maxima(self) -> SurfaceMaxima | None:
        """Largest stresses at the surface, with the edges of the contact that lie between the
        points; None where these are not known.

        They are found when first asked for. The field must hold the whole plane at the surface.
        """
        whole = self.dims == ("plane", "x", "y") and any(plane.side == "surface" for plane in self.planes)
        return self.at_edges(self.tensor) if whole and self.at_edges is not None else None

    def largest(self, name: str, plane: int | None = None) -> Peak:
        """Largest ``tension`` (σ1), ``von_mises``, ``shear`` ((σ1 - σ3)/2) or ``in_plane``
        principal stress with its place, of all planes or one; at the surface with its error."""
        require.one_of(name, MAXIMA, "largest stress")
        first, part = (0, self.tensor) if plane is None else (plane, self.tensor.map(lambda c: c[plane : plane + 1]))
        numbers, values = largest(name, part)
        best = int(np.argmax(values))
        number, *index = (int(k) for k in np.unravel_index(int(numbers[best]), part.xx.shape))
        peak = self._peak(float(values[best]), number + first, index)
        at_surface = plane is None or self.planes[plane].side == "surface"
        edges = self.surface_maxima if at_surface else None
        return peak if edges is None else edges.joined(name, peak)

    @property
    def largest_tension(self) -> Peak:
        """Largest principal stress, with the edges of the contact where the field holds its
        surface: value, ``error``, place."""
        return self.largest("tension")

    @property
    def largest_von_mises(self) -> Peak:
        """The same of the von Mises stress."""
        return self.largest("von_mises")

    @property
    def largest_shear(self) -> Peak:
        """The same of (σ1 - σ3)/2."""
        return self.largest("shear")

    @property
    def largest_principal_tensile(self) -> Peak:
        """The same of the larger principal stress within planes parallel to the surface, σ_t of
        Peng (2001, eq. 3.34)."""
        return self.largest("in_plane")

    @property
    def largest_sqrt_J2(self) -> Peak:
        """The same of √J2."""
        peak, factor = self.largest("von_mises"), math.sqrt(1.0 / 3.0)
        return replace(peak, value=factor * peak.value, error=factor * peak.error)

    @property
    def depth(self) -> RealArray:
        """Depth of each plane in m, (n,)."""
        return np.array([plane.depth for plane in self.planes])

    @property
    def region(self) -> RealArray:
        """Number of the region of each plane, 0 the outermost layer, (n,)."""
        return np.array([plane.region.index for plane in self.planes])

    @property
    def regions(self) -> tuple[Region, ...]:
        """The regions that have planes, from the surface down."""
        return tuple(dict.fromkeys(plane.region for plane in self.planes))

    normal_xx = FromTensor(attrgetter("xx"), "σ_xx.")
    normal_yy = FromTensor(attrgetter("yy"), "σ_yy.")
    normal_zz = FromTensor(attrgetter("zz"), "σ_zz.")
    shear_xy = FromTensor(attrgetter("xy"), "σ_xy.")
    shear_xz = FromTensor(attrgetter("xz"), "σ_xz.")
    shear_yz = FromTensor(attrgetter("yz"), "σ_yz.")
    von_mises = FromTensor(invariants.von_mises, "√(3 J2), see ``invariants``.")
    sqrt_J2 = FromTensor(invariants.sqrt_J2, "√J2.")
    tresca = FromTensor(invariants.tresca, "σ1 - σ3.")
    max_shear = FromTensor(invariants.max_shear, "(σ1 - σ3)/2.")
    max_shear_normal = FromTensor(invariants.max_shear_normal, "Unit normal of a plane of largest shear, (3, n, …).")
    principal = FromTensor(invariants.principal_stresses, "σ1 >= σ2 >= σ3, (3, n, …).")

    @property
    def max_principal(self) -> RealArray:
        """σ1."""
        return np.asarray(self.principal[0])

    principal_tensile = FromTensor(
        invariants.principal_tensile,
        "Larger principal stress within planes parallel to the surface (Peng 2001, eq. 3.34).",
    )
    hydrostatic = FromTensor(invariants.hydrostatic, "Mean normal stress.")

    @property
    def interfaces(self) -> tuple[InterfaceStress, ...]:
        """Tractions on the interfaces that have a plane."""
        found = []
        for number, plane in enumerate(self.planes):
            if plane.side == "above":
                below = next((p.region for p in self.planes if p.region.index == plane.region.index + 1), None)
                shear = np.hypot(self.tensor.xz[number], self.tensor.yz[number])
                found.append(InterfaceStress(plane.region, below, plane.depth, shear, self.tensor.zz[number]))
        return tuple(found)

    def within(self, region: int | str) -> StressField:
        """The planes of one region, by its number, its name, or another name of its material in the
        library.

        InputError if no plane lies in such a region.
        """
        keep = self._inside(region) or (self._inside(full_name(region)) if isinstance(region, str) else [])
        if not keep:
            names = ", ".join(f"{part.index} ({part.name})" for part in self.regions)
            raise InputError(f"region of a stress field must be one of {names}, but is {region!r}.")
        moved = None if self.displacement is None else self.displacement.map(lambda component: component[keep])
        planes = tuple(self.planes[k] for k in keep)
        return self._with(planes, self.tensor.map(lambda c: c[keep]), moved)

    def _inside(self, region: int | str) -> list[int]:
        """Numbers of the planes of one region."""
        return [k for k, plane in enumerate(self.planes) if region in (plane.region.index, plane.region.name)]

    def only(self, plane: int) -> StressField:
        """The field of one plane, by its position; its arrays are views."""
        part = slice(plane, plane + 1)
        moved = None if self.displacement is None else self.displacement.map(lambda component: component[part])
        return self._with(self.planes[part], self.tensor.map(lambda c: c[part]), moved)

    def _with(self, planes: tuple[Plane, ...], tensor: StressTensor, moved: Displacement | None) -> StressField:
        """The field of some ``planes`` of this one."""
        edges = None if self.at_edges is None else self.at_edges.kept(self.tensor, tensor)
        return replace(self, planes=planes, tensor=tensor, displacement=moved, at_edges=edges)

    @property
    def cell(self) -> float:
        """What one point of a plane stands for: m² on whole planes, m on a section, 1 on a depth
        profile."""
        return math.prod(step for step, axis in zip(self.spacing, "xy", strict=True) if axis in self.dims)

    def peak(self, values: RealArray, plane: int | None = None) -> Peak:
        """Largest of ``values``, an array (n, …) such as ``field.von_mises``, and its place; on one
        ``plane`` or on all.

        InputError if ``values`` has another shape than the components of the field.
        """
        if values.shape != self.tensor.xx.shape:
            raise InputError(
                f"values of a peak must have the shape {self.tensor.xx.shape} of the field, but have {values.shape}."
            )
        first, searched = (0, values) if plane is None else (plane, values[plane : plane + 1])
        number, *index = (int(k) for k in np.unravel_index(int(np.argmax(searched)), searched.shape))
        return self._peak(float(searched[number, *index]), number + first, index)

    def _peak(self, value: float, plane: int, index: list[int]) -> Peak:
        """A ``value`` at the point of a ``plane`` with this ``index``."""
        section, at = self.planes[plane], dict(zip(self.dims[1:], index, strict=True))
        x, y = (float(line[at[axis]]) if axis in at else float(line) for axis, line in (("x", self.x), ("y", self.y)))
        return Peak(value, x, y, section.depth, section.region, section.side)
