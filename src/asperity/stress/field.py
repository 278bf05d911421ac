"""Stresses that were computed: components by plane, derived stresses, maxima with their places, interfaces."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from importlib import import_module

import numpy as np
from numpy.typing import NDArray

from ..core.arrays import RealArray
from ..core.engine.cpu import Blocks
from ..core.errors import InputError
from ..core.late import Stored
from ..core.quantity import Quantity
from ..core.spectral import thread_count
from ..core.tensor import Displacement, StressTensor
from ..solids.library import full_name
from . import criteria as invariants
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


@dataclass(frozen=True)
class Peak:
    """Extreme ``value`` of a field and where it is, lengths in m; ``region`` and ``side`` as for ``Plane``."""

    value: float
    x: float
    y: float
    depth: float
    region: Region
    side: str


@dataclass(frozen=True, eq=False)
class InterfaceStress:
    """Tractions an interface must carry, arrays over its points.

    ``shear`` is the magnitude of the shear traction in Pa, ``peel`` the normal one, positive in tension.
    """

    above: Region
    below: Region | None
    depth: float
    shear: RealArray
    peel: RealArray


@dataclass(frozen=True, eq=False, repr=False)
class StressField(Stored):
    """Stress inside a body on planes parallel to its surface; arrays (n, …) over planes and their points, in Pa.

    Attributes
    ----------
    planes
        The n planes in order of depth; the depth of an interface appears twice, above and below it.
    tensor
        Components xx, yy, zz, xy, xz, yz, tension positive. x and y are those of the contact, z points into the body.
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

    @property
    def normal_xx(self) -> RealArray:
        """σ_xx."""
        return self.tensor.xx

    @property
    def normal_yy(self) -> RealArray:
        """σ_yy."""
        return self.tensor.yy

    @property
    def normal_zz(self) -> RealArray:
        """σ_zz."""
        return self.tensor.zz

    @property
    def shear_xy(self) -> RealArray:
        """σ_xy."""
        return self.tensor.xy

    @property
    def shear_xz(self) -> RealArray:
        """σ_xz."""
        return self.tensor.xz

    @property
    def shear_yz(self) -> RealArray:
        """σ_yz."""
        return self.tensor.yz

    @property
    def von_mises(self) -> RealArray:
        """√(3 J2), see ``invariants``."""
        return invariants.von_mises(self.tensor)

    @property
    def sqrt_J2(self) -> RealArray:
        """√J2."""
        return invariants.sqrt_J2(self.tensor)

    @property
    def tresca(self) -> RealArray:
        """σ1 - σ3."""
        return invariants.tresca(self.tensor)

    @property
    def max_shear(self) -> RealArray:
        """(σ1 - σ3)/2."""
        return invariants.max_shear(self.tensor)

    @property
    def max_shear_normal(self) -> RealArray:
        """Unit normal of a plane of largest shear, (3, n, …)."""
        return invariants.max_shear_normal(self.tensor)

    @property
    def principal(self) -> RealArray:
        """σ1 >= σ2 >= σ3, (3, n, …)."""
        return invariants.principal_stresses(self.tensor)

    @property
    def max_principal(self) -> RealArray:
        """σ1."""
        return np.asarray(self.principal[0])

    @property
    def principal_tensile(self) -> RealArray:
        """Larger principal stress within planes parallel to the surface (Peng 2001, eq. 3.34)."""
        return invariants.principal_tensile(self.tensor)

    @property
    def hydrostatic(self) -> RealArray:
        """Mean normal stress."""
        return invariants.hydrostatic(self.tensor)

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
        """The planes of one region, by its number, its name, or another name of its material in the library.

        InputError if no plane lies in such a region.
        """
        keep = self._inside(region) or (self._inside(full_name(region)) if isinstance(region, str) else [])
        if not keep:
            names = ", ".join(f"{part.index} ({part.name})" for part in self.regions)
            raise InputError(f"region of a stress field must be one of {names}, but is {region!r}.")
        moved = None if self.displacement is None else self.displacement.map(lambda component: component[keep])
        planes = tuple(self.planes[k] for k in keep)
        return replace(self, planes=planes, tensor=self.tensor.map(lambda c: c[keep]), displacement=moved)

    def _inside(self, region: int | str) -> list[int]:
        """Numbers of the planes of one region."""
        return [k for k, plane in enumerate(self.planes) if region in (plane.region.index, plane.region.name)]

    def only(self, plane: int) -> StressField:
        """The field of one plane, by its position; its arrays are views."""
        part = slice(plane, plane + 1)
        moved = None if self.displacement is None else self.displacement.map(lambda component: component[part])
        return replace(self, planes=self.planes[part], tensor=self.tensor.map(lambda c: c[part]), displacement=moved)

    @property
    def cell(self) -> float:
        """What one point of a plane stands for: m² on whole planes, m on a section, 1 on a depth profile."""
        return math.prod(step for step, axis in zip(self.spacing, "xy", strict=True) if axis in self.dims)

    def peak(self, values: RealArray, plane: int | None = None) -> Peak:
        """Largest of ``values``, an array (n, …) such as ``field.von_mises``, and its place; on one ``plane`` or on all.

        InputError if ``values`` has another shape than the components of the field.
        """
        if values.shape != self.tensor.xx.shape:
            raise InputError(
                f"values of a peak must have the shape {self.tensor.xx.shape} of the field, but have {values.shape}."
            )
        first, searched = (0, values) if plane is None else (plane, values[plane : plane + 1])
        number, *index = np.unravel_index(int(np.argmax(searched)), searched.shape)
        place = (int(number) + first, *map(int, index))
        return peak_at(self, float(values[place]), place)


def peak_at(field: StressField, value: float, place: tuple[int, ...]) -> Peak:
    """``value`` of a quantity of ``field`` at the indices ``place``: plane, then those of its points."""
    section, at = field.planes[place[0]], dict(zip(field.dims[1:], place[1:], strict=True))
    x, y = (float(line[at[axis]]) if axis in at else float(line) for axis, line in (("x", field.x), ("y", field.y)))
    return Peak(value, x, y, section.depth, section.region, section.side)


# Largest stresses of each region and interface of a body, found plane by plane as a stream of planes goes by.


@dataclass(frozen=True, eq=False)
class RegionMaxima:
    """Largest stresses of one region on the planes that were computed: von Mises, tension (σ1), and shear (σ1 - σ3)/2."""

    region: Region
    von_mises: Peak
    tension: Peak
    shear: Peak


@dataclass(frozen=True, eq=False)
class InterfaceMaxima:
    """Largest tractions on an interface: ``shear`` magnitude and ``peel``, positive in tension."""

    above: str
    below: str
    shear: Peak
    peel: Peak


_BOUNDED = ("tension", "shear")
"""What the compiled pass bounds only; of everything else it finds the largest value of each block."""


class Maxima:
    """Maxima of the planes that have been taken in, searched with ``threads`` threads."""

    def __init__(self, threads: int | None = None) -> None:
        self.drawn: dict[str, Peak] = {}
        self.citation_keys: tuple[str, ...] = ()
        self._regions: dict[Region, dict[str, Peak]] = {}
        self._interfaces: list[tuple[Region, Peak, Peak]] = []
        self._blocks = Blocks(thread_count(threads))

    def watching(self, fields: Iterable[StressField]) -> Iterator[StressField]:
        """The same ``fields``, each of one whole plane, taken in as they pass."""
        for field in fields:
            self.take(field)
            yield field

    def take(self, field: StressField) -> None:
        """Take in one whole plane."""
        self.citation_keys = field.citation_keys
        plane, search = field.planes[0], _Search(field, self._blocks)
        von_mises = search.peak("von_mises", invariants.von_mises)
        largest = self._regions.setdefault(plane.region, {})
        _keep(largest, "von_mises", von_mises)
        _keep(largest, "tension", search.peak("tension", lambda s: invariants.principal_stresses(s)[0]))
        _keep(largest, "shear", search.peak("shear", invariants.max_shear))
        _keep(self.drawn, "von_mises", von_mises)
        _keep(self.drawn, "principal_tensile", search.peak("in_plane", invariants.principal_tensile))
        _keep(self.drawn, "shear_xz", search.peak("shear_xz", lambda s: np.abs(s.xz)))
        _keep(self.drawn, "shear_yz", search.peak("shear_yz", lambda s: np.abs(s.yz)))
        if plane.side == "above":
            shear = search.peak("traction", lambda s: np.hypot(s.xz, s.yz))
            self._interfaces.append((plane.region, shear, search.peak("zz", lambda s: s.zz)))

    def regions(self) -> tuple[RegionMaxima, ...]:
        """The largest stresses of each region."""
        return tuple(RegionMaxima(region, **peaks) for region, peaks in self._regions.items())

    def interfaces(self) -> tuple[InterfaceMaxima, ...]:
        """The largest tractions on each interface."""
        names = {region.index: region.name for region in self._regions}
        return tuple(
            InterfaceMaxima(region.name, names.get(region.index + 1, "rigid base"), shear, peel)
            for region, shear, peel in self._interfaces
        )


def _keep(peaks: dict[str, Peak], name: str, peak: Peak) -> None:
    if name not in peaks or peak.value > peaks[name].value:
        peaks[name] = peak


class _Search:
    """Search of one plane: exact values only at points whose upper bound allows them to be largest."""

    def __init__(self, field: StressField, blocks: Blocks) -> None:
        self._kernels = import_module(".kernels.planes", __package__)
        self._field, self._size = field, int(self._kernels.BLOCK)
        self._flat = field.tensor.map(np.ravel)
        self._components = tuple(vars(self._flat).values())
        count = -(-self._flat.xx.size // self._size)
        found = np.empty((count, len(self._kernels.BOUNDS)))
        blocks.share(self._kernels.block_bounds, count, self._components, found, serial=count < 64)
        self._bounds = dict(zip(self._kernels.BOUNDS, found.T, strict=True))
        self._margin = 16.0 * float(np.finfo(self._flat.xx.dtype).eps * np.abs(found).max())  # rounding of the bounds

    def peak(self, name: str, function: Callable[[StressTensor], RealArray]) -> Peak:
        """Largest ``function`` of the stress, whose bounds are those of ``name``."""
        bounds = self._bounds[name]
        first = int(np.argmax(bounds)) * self._size
        value, place = self._largest(np.arange(first, min(first + self._size, self._flat.xx.size)), function)
        if name in _BOUNDED:  # points of other blocks may be larger
            least = value - self._margin
            blocks = np.flatnonzero(bounds > least)
            points = self._kernels.points_beyond(blocks, self._components, name == "shear", least)
            value, place = self._largest(points, function) if points.size else (value, place)
        indices = np.unravel_index(place, self._field.tensor.xx.shape[1:])
        return peak_at(self._field, value, (0, *map(int, indices)))

    def _largest(self, points: NDArray[np.intp], function: Callable[[StressTensor], RealArray]) -> tuple[float, int]:
        """Largest value at ``points`` of the plane, and its place."""
        values = function(self._flat.map(lambda component: component[points]))
        best = int(np.argmax(values))
        return float(values[best]), int(points[best])
