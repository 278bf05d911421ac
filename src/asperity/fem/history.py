"""What a history of indentation gives: curves, zones of plastic flow, fields, tractions of
interfaces, tension in layers."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import minimize_scalar

from ..core.arrays import BoolArray, OfSteps, RealArray
from ..core.errors import InputError
from ..core.quantity import measured
from ..core.status import Advice
from ..solids.plasticity import von_mises
from ..theories.hardness.effective_hardness import PARABOLOID, OliverPharr
from .contact import Equilibrium
from .elements import GAUSS, Elements
from .indenters import Indenter, beyond_small_strain, radius_at
from .mesh import IntArray, Mesh

NOWHERE = (math.nan, math.nan)
"""Place (r, z) of what there is not."""


@dataclass(frozen=True, eq=False)
class PlasticZone:
    """Where one region has flowed.

    Attributes
    ----------
    region
        Number from the surface down; layers, then the base.
    volume
        In m³.
    top, bottom, radius
        Smallest and largest depth and largest distance from the axis in m, of points that have
        flowed; NaN if none has.
    largest
        Largest accumulated plastic strain, at ``place`` (r, z) in m.
    first_place, first_approach
        (r, z) in m where flow began, and the approach in m at the end of the step in which it did;
        NaN if it did not.
    """

    region: int = measured("1", "number of the region from the surface down")
    volume: float = measured("m**3", "volume that has flowed")
    top: float = measured("m", "smallest depth that has flowed", default=math.nan)
    bottom: float = measured("m", "largest depth that has flowed", default=math.nan)
    radius: float = measured("m", "largest distance from the axis that has flowed", default=math.nan)
    largest: float = measured("1", "largest accumulated plastic strain", default=0.0)
    place: tuple[float, float] = measured("m", "r and z of the largest plastic strain", "rz", default=NOWHERE)
    first_place: tuple[float, float] = measured("m", "r and z where flow began", "rz", default=NOWHERE)
    first_approach: float = measured("m", "approach at which flow began", default=math.nan)


@dataclass(frozen=True, eq=False)
class InterfaceTraction:
    """What a layer passes to the one below.

    Attributes
    ----------
    depth
        In m.
    r
        (points,) in m.
    normal, shear
        (points,) σ_zz and σ_rz in Pa, the same on both sides.
    """

    depth: float
    r: RealArray
    normal: RealArray
    shear: RealArray


@dataclass(frozen=True, eq=False)
class LayerTension:
    """Radial stress on the faces of a layer: tension at its surface beside the contact and at its
    bottom under it opens cracks.

    Attributes
    ----------
    region
        Number of the layer.
    r
        (points,) in m.
    top, bottom
        (points,) σ_rr in Pa on the upper and lower face.
    """

    region: int
    r: RealArray
    top: RealArray
    bottom: RealArray

    @property
    def largest_top(self) -> tuple[float, float]:
        """Largest σ_rr of the upper face in Pa, and where, r in m."""
        found = int(self.top.argmax())
        return float(self.top[found]), float(self.r[found])

    @property
    def largest_bottom(self) -> tuple[float, float]:
        """Largest σ_rr of the lower face in Pa, and where, r in m."""
        found = int(self.bottom.argmax())
        return float(self.bottom[found]), float(self.r[found])


@dataclass(frozen=True, eq=False)
class SolidFields:
    """Stresses and strains of the body at one step, at the Gauss points of its elements.

    Attributes
    ----------
    mesh, elements
        Of the body; points and places (r, z) in m.
    displacement
        (points of the mesh, 2) along r and z in m.
    stress, plastic_strain
        (elements, points, 6), components rr, θθ, zz, rθ, rz, θz; stress in Pa, tension positive.
    accumulated
        (elements, points) q.
    """

    mesh: Mesh
    elements: Elements
    displacement: RealArray
    stress: RealArray
    plastic_strain: RealArray
    accumulated: RealArray

    @property
    def places(self) -> RealArray:
        """(elements, points, 2) r and z in m."""
        return self.elements.places

    @property
    def von_mises(self) -> RealArray:
        """(elements, points) in Pa."""
        return von_mises(self.stress)

    def rows(self) -> tuple[RealArray, RealArray, IntArray]:
        """Lines r and z (m) between the elements, and numbers (rings, rows) of these, for drawing
        maps."""
        r, z = np.unique(self.mesh.points[:, 0]), np.unique(self.mesh.points[:, 1])
        return r, z, np.arange(len(self.mesh.cells)).reshape(len(r) - 1, len(z) - 1)

    def interface(self, number: int = 0) -> InterfaceTraction:
        """Tractions under layer ``number``, from the balance of the forces of the elements above.

        Raises
        ------
        InputError
            If there is no such interface.
        """
        self._layer(number)
        above = self.elements.region <= number
        own = (self.stress * self.elements.weights[..., None])[above][..., list(self.elements.components)]
        forces = np.einsum("epcn,epc->en", self.elements.strain_of[above], own)
        total = np.bincount(self.elements.unknowns[above].ravel(), forces.ravel(), minlength=self.elements.size)
        depth = self._faces(number)[1]
        line = np.flatnonzero(self.mesh.points[:, 1] == depth)
        line = line[np.argsort(self.mesh.points[line, 0])]
        r = self.mesh.points[line, 0]
        area = ring_areas(r)
        return InterfaceTraction(depth, r, total[2 * line + 1] / area, total[2 * line] / area)

    def tension(self, number: int = 0) -> LayerTension:
        """Radial stress on both faces of layer ``number``, extrapolated from the Gauss points.

        Raises
        ------
        InputError
            If there is no such layer.
        """
        self._layer(number)
        _, z, cells = self.rows()
        found = []
        rows = np.flatnonzero((z[:-1] >= self._faces(number)[0]) & (z[1:] <= self._faces(number)[1]))
        for row, near, far in ((rows[0], (0, 1), (3, 2)), (rows[-1], (3, 2), (0, 1))):
            stress = self.stress[cells[:, row], :, 0]
            beyond = (1.0 - GAUSS) / (2.0 * GAUSS)
            face = (1.0 + beyond) * stress[:, near] - beyond * stress[:, far]
            found.append(face.mean(axis=1))
        r = self.places[cells[:, rows[0]], :2, 0].mean(axis=1)
        return LayerTension(number, r, found[0], found[1])

    def net_axial_force(self) -> RealArray:
        """Force ∫ σ_zz dA in N through each row of elements, downwards from the surface: minus the
        load, and zero for residual stresses."""
        _, z, cells = self.rows()
        volume = (self.stress[..., 2] * self.elements.weights).sum(axis=1)
        found: RealArray = volume[cells].sum(axis=0) / np.diff(z)
        return found

    def _layer(self, number: int) -> None:
        layers = int(self.elements.region.max())
        if not 0 <= number < max(layers, 1) or layers == 0:
            raise InputError(f"number of a layer must be 0 to {layers - 1}, but is {number}.")

    def _faces(self, number: int) -> tuple[float, float]:
        z = self.mesh.points[self.mesh.cells[self.elements.region == number], 1]
        return float(z.min()), float(z.max())


def ring_areas(r: RealArray) -> RealArray:
    """Area in m² of the surface that belongs to each of the points ``r`` (m), by linear shape
    functions."""
    found, step = np.zeros_like(r), np.diff(r)
    found[:-1] += 2.0 * np.pi * step * (r[:-1] / 3.0 + r[1:] / 6.0)
    found[1:] += 2.0 * np.pi * step * (r[:-1] / 6.0 + r[1:] / 3.0)
    return found


@dataclass(frozen=True, eq=False)
class IndentationState:
    """From where a history goes on.

    Attributes
    ----------
    equilibrium
        Displacements, plastic strains and touching points.
    work, plastic_work
        In J, done so far by the indenter and in plastic flow.
    zones
        Of the last step, with the places where flow began.
    """

    equilibrium: Equilibrium = measured("", "balance of the last step")
    work: float = measured("J", "work of the indenter", default=0.0)
    plastic_work: float = measured("J", "plastic work", default=0.0)
    zones: tuple[PlasticZone, ...] = measured("", "where each region has flowed", default=())

    def require_sound(self) -> None:
        """Refuse fields of a file that do not fit each other, with a ValueError."""
        now = self.equilibrium
        now.state.require_sound()
        if now.stress.shape != now.state.plastic_strain.shape or now.displacement.ndim != 1:
            raise ValueError("stress and plastic strain do not fit each other")
        if not now.touching.shape == now.slipping.shape == now.normal_force.shape:
            raise ValueError("fields of the surface do not fit each other")


@dataclass(frozen=True, eq=False)
class IndentationStep:
    """Numbers and surface at the end of one step.

    Attributes
    ----------
    approach, load
        In m and N.
    contact_radius
        In m, between points of the mesh, from the gap beside the contact; 0 without contact.
    contact_stiffness
        dP/dδ in N/m of an elastic change with the contact as it is: that of unloading at its start.
    work, elastic_energy, plastic_work, stored_energy, hardening_work
        In J, since the virgin state: by the indenter; recoverable; stress times plastic strain;
        held by back stresses; ∫ Y dq dV of this model.
    zones
        One for each region, from the surface down.
    pressure, surface
        (points,) in Pa, and displacement into the body in m, at the distances ``r`` of the history.
    touching
        (points,) which points touch.
    iterations, cuts
        Of Newton's method, and cuts of the step.
    """

    approach: float
    load: float
    contact_radius: float
    contact_stiffness: float
    work: float
    elastic_energy: float
    plastic_work: float
    stored_energy: float
    hardening_work: float
    zones: tuple[PlasticZone, ...]
    pressure: RealArray = field(repr=False)
    surface: RealArray = field(repr=False)
    touching: BoolArray = field(repr=False)
    iterations: int = 0
    cuts: int = 0

    @property
    def mean_pressure(self) -> float:
        """Load over π a² in Pa, 0 without contact: the hardness when the body is fully plastic."""
        area = math.pi * self.contact_radius**2
        return self.load / area if area > 0.0 else 0.0


@dataclass(frozen=True, eq=False)
class IndentationHistory:
    """Steps of an indentation.

    Attributes
    ----------
    steps
        One for each step that was asked for.
    r
        (points,) of the surface in m.
    state
        From where the next history may start.
    fields
        Of the steps that were to be kept, by their number.
    ball
        Radius of the indenter in m where it is a ball or paraboloid, else infinite.
    """

    steps: tuple[IndentationStep, ...]
    r: RealArray
    state: IndentationState
    fields: dict[int, SolidFields]
    ball: float = math.inf

    @property
    def advice(self) -> tuple[Advice, ...]:
        """What should be known before its numbers are used: contacts of a ball that are too large
        for small strains."""
        return tuple(beyond_small_strain(float(self.contact_radius.max()), self.ball))

    approach = OfSteps("(steps,) in m.")
    load = OfSteps("(steps,) in N.")
    contact_radius = OfSteps("(steps,) in m.")
    mean_pressure = OfSteps("(steps,) in Pa.")
    work = OfSteps("(steps,) done by the indenter in J.")
    elastic_energy = OfSteps("(steps,) recoverable, in J.")

    @property
    def dissipated(self) -> RealArray:
        """(steps,) turned into heat, in J: plastic work less what back stresses hold."""
        return np.array([step.plastic_work - step.stored_energy for step in self.steps])

    @property
    def imprint(self) -> RealArray:
        """(points,) displacement of the surface into the body at the last step in m: the residual
        imprint when it is unloaded."""
        return self.steps[-1].surface

    @property
    def hardness(self) -> float:
        """Mean pressure in Pa at the largest load."""
        return float(self.mean_pressure[int(self.load.argmax())])

    @property
    def unloading_stiffness(self) -> float:
        """dP/dδ in N/m where unloading from the largest load begins, from a power law through the
        steps that follow above half that load (Oliver and Pharr 1992).

        Raises
        ------
        InputError
            If fewer than three steps of unloading follow the largest load.
        """
        top = int(self.load.argmax())
        down = np.flatnonzero(np.diff(self.load[top:]) >= 0.0)
        part = slice(top, top + 1 + int(down[0]) if len(down) else None)
        approach, load = self.approach[part], self.load[part]
        approach, load = approach[load > 0.5 * load[0]], load[load > 0.5 * load[0]]
        if len(load) < 4:
            raise InputError(
                f"unloading must be at least three steps above half the largest load, but is {len(load) - 1}. "
                "Add steps of unloading, or use contact_stiffness."
            )

        def law(residual: float) -> tuple[float, float]:
            x, y = np.log(approach - residual), np.log(load)
            slope, start = np.polyfit(x, y, 1)
            return float(((slope * x + start - y) ** 2).sum()), float(slope)

        span = approach[0] - approach[-1]
        found = minimize_scalar(
            lambda share: law(approach[-1] - np.exp(share) * span)[0], bounds=(-7.0, 7.0), method="bounded"
        )
        residual = approach[-1] - float(np.exp(found.x)) * span
        return law(residual)[1] * float(load[0]) / float(approach[0] - residual)

    def oliver_pharr(self, indenter: Indenter, *, shape: float = PARABOLOID) -> OliverPharr:
        """Hardness and modulus as they are read off a measured curve, with the area that
        ``indenter`` has at the contact depth.

        ``shape``: ε of the contact depth, 0.72 for a cone, 0.75 for a paraboloid, 1 for a punch.

        Raises
        ------
        InputError
            If fewer than three steps of unloading follow the largest load.
        """
        top, stiffness = self.steps[int(self.load.argmax())], self.unloading_stiffness
        depth = top.approach - shape * top.load / stiffness
        factor = math.pi * (radius_at(indenter, depth) / depth) ** 2
        return OliverPharr(top.load, top.approach, stiffness, shape, factor)
