"""Layered bodies: any number of coatings on a half-space or on a rigid base; graded coatings as
thin layers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import ClassVar, Literal, TypeAlias

from ..core import require
from ..core.errors import InputError
from ..core.late import Shown
from .elastic import Conduction, Elastic, Rigid, Strength, never_yields, yield_pressure
from .viscoelastic import Viscoelastic


@dataclass(frozen=True)
class Bonded:
    """Perfect bond: all displacements and all tractions are continuous."""

    name: ClassVar[str] = "bonded"


@dataclass(frozen=True)
class Frictionless:
    """Free slip without opening: normal displacement and pressure are continuous, the shear
    traction is zero.

    The interface is taken to stay closed; add the mean pressure to see whether tension arises.
    """

    name: ClassVar[str] = "frictionless"


Interface: TypeAlias = Bonded | Frictionless
"""Lower interface of a layer."""


@dataclass(frozen=True)
class RigidBase:
    """Undeformable base to which the lowest layer is fixed."""

    name: ClassVar[str] = "rigid base"


Base: TypeAlias = Elastic | RigidBase
"""What lies under all layers."""


@dataclass(frozen=True)
class Layer:
    """One homogeneous layer.

    InputError if the material is no ``Elastic``, the thickness negative or no number, or the
    interface none of the two.

    Parameters
    ----------
    material
        ``Elastic(...)`` or a named material.
    thickness
        h in m, >= 0. A layer of zero thickness vanishes; under one of infinite thickness nothing
        matters.
    interface
        How it is joined to what lies below it: ``Bonded()`` or ``Frictionless()``.
    """

    material: Elastic
    thickness: float
    interface: Interface = Bonded()

    def __post_init__(self) -> None:
        require.instance(self.material, Elastic, "material of a layer", 'Write Elastic(E, nu) or material("DLC").')
        if self.thickness != math.inf:
            thickness = require.finite(self.thickness, "thickness of a layer (m)")
            if thickness < 0.0:
                raise InputError(f"thickness of a layer (m) must be at least zero, but is {thickness:g}.")
            object.__setattr__(self, "thickness", thickness)
        if not isinstance(self.interface, Interface):
            raise InputError(f"interface of a layer must be Bonded() or Frictionless(), but is {self.interface!r}.")


@dataclass(frozen=True, repr=False)
class Layered(Shown):
    """Layers on a base.

    InputError if a layer is no ``Layer``, or the base neither ``Elastic`` nor ``RigidBase``.

    Parameters
    ----------
    layers
        From the surface down; an empty sequence leaves the bare base.
    base
        Material of the half-space below, or ``RigidBase()``.
    name
        For tables and reports.
    """

    layers: Sequence[Layer]
    base: Base
    name: str = ""

    def __post_init__(self) -> None:
        if isinstance(self.layers, Layer):
            raise InputError("layers of a Layered body must be a list of Layer, but is a single Layer; write [layer].")
        if isinstance(self.layers, Elastic):
            raise InputError(
                "layers of a Layered body must be a list of Layer, but is the material "
                f"{self.layers.name or 'Elastic'} without a thickness; write [Layer(material, thickness)]."
            )
        layers = tuple(self.layers)
        for layer in layers:
            require.instance(layer, Layer, "each layer of a Layered body", "Write Layer(material, thickness).")
        if not isinstance(self.base, Elastic | RigidBase):
            raise InputError(
                "base of a Layered body must be Elastic(...), a named material or RigidBase(), "
                f"but is {type(self.base).__name__}."
            )
        object.__setattr__(self, "layers", layers)

    @property
    def reduced(self) -> Layered:
        """The same body without layers of zero thickness and without what lies under a layer of
        infinite thickness."""
        kept: list[Layer] = []
        for layer in self.layers:
            if layer.thickness == math.inf:
                return Layered(kept, layer.material, self.name)
            if layer.thickness > 0.0:
                kept.append(layer)
        return Layered(kept, self.base, self.name)

    @property
    def bare(self) -> Layered:
        """The reduced body with nothing but its elastic constants, so that equal ones deform alike
        and the reverse."""
        reduced = self.reduced
        layers = [Layer(_constants(layer.material), layer.thickness, layer.interface) for layer in reduced.layers]
        return Layered(layers, _constants(reduced.base) if isinstance(reduced.base, Elastic) else reduced.base)

    @property
    def slips(self) -> bool:
        """Whether some layer may slip on what lies below it."""
        return any(isinstance(layer.interface, Frictionless) for layer in self.reduced.layers)

    @property
    def surface_material(self) -> Base:
        """Material at the surface: of the first layer that is there at all, or the base."""
        reduced = self.reduced
        return reduced.layers[0].material if reduced.layers else reduced.base

    @property
    def thickness(self) -> float:
        """Sum of the thicknesses of all layers in m."""
        return sum(layer.thickness for layer in self.layers)


def _constants(material: Elastic) -> Elastic:
    return Elastic(material.youngs_modulus, material.poisson_ratio)


Body: TypeAlias = Elastic | Rigid | Layered
"""A body that can take part in a contact."""


def surface_material(body: Body) -> Elastic | None:
    """Material at the surface of ``body``: of its outermost layer where it is layered, None where
    it is rigid."""
    material = body.surface_material if isinstance(body, Layered) else body
    return material if isinstance(material, Elastic) else None


def materials_of(body: Body) -> tuple[Elastic, ...]:
    """Every elastic material in ``body`` that takes part, from the surface down."""
    if not isinstance(body, Layered):
        return (body,) if isinstance(body, Elastic) else ()
    reduced = body.reduced
    parts = (*(layer.material for layer in reduced.layers), reduced.base)
    return tuple(part for part in parts if isinstance(part, Elastic))


def relaxes(body: Body) -> bool:
    """Whether a material of ``body`` that takes part is viscoelastic, and its modulus falls in
    time."""
    return any(isinstance(material, Viscoelastic) and material.spectrum for material in materials_of(body))


def deformable(body: Body, counter_body: Body) -> tuple[tuple[Elastic | Layered, float], ...]:
    """The bodies that deform, each with the sign of the tractions it carries: 1 for ``body``, -1
    for ``counter_body``.

    InputError if both are rigid.
    """
    found = tuple(
        (solid, sign)
        for solid, sign in ((body, 1.0), (counter_body, -1.0))
        if not isinstance(solid, Rigid) and materials_of(solid)
    )
    if not found:
        raise InputError("body and counter_body must not both be rigid; make at least one of them Elastic.")
    return found


def contact_modulus(body: Body, counter_body: Body = Rigid()) -> float:
    """Contact modulus E* in Pa, 1/E* = (1 - nu1²)/E1 + (1 - nu2²)/E2 (Johnson 1985, eq. 4.22), of
    the surface materials.

    For a layered body the material of the outermost layer counts: it governs contacts much smaller
    than that layer is thick. Larger contacts depend on the layers below too, by the compliance and
    not by this number.

    InputError if both bodies are rigid.
    """
    solids = (surface_material(solid) for solid, _ in deformable(body, counter_body))
    return 1.0 / sum(1.0 / solid.plane_strain_modulus for solid in solids if solid is not None)


def weaker_strength(*bodies: Body) -> dict[str, float]:
    """Lowest known ``hardness`` and ``yield_stress`` (Pa) of the materials at the surfaces of
    ``bodies``, and ``nu``.

    Poisson's ratio is that of the material which yields first, else of the softest, else of the
    first. What is not known is left out.
    """
    materials = [material for material in map(surface_material, bodies) if material is not None]
    found = {"nu": materials[0].poisson_ratio} if materials else {}
    for name in ("hardness", "yield_stress"):
        known = [
            (getattr(m.strength, name), m.poisson_ratio) for m in materials if not math.isnan(getattr(m.strength, name))
        ]
        if known:
            found[name], found["nu"] = min(known)
    return found


# Graded coatings as stacks of thin homogeneous layers.


@dataclass(frozen=True)
class LinearGrading:
    """E changes in proportion to depth."""

    name: ClassVar[str] = "linear"

    def modulus(self, top: float, bottom: float, depth: float) -> float:
        """E at the relative ``depth`` 0…1 between ``top`` and ``bottom``, in their unit."""
        return top + (bottom - top) * depth


@dataclass(frozen=True)
class ExponentialGrading:
    """E changes by equal factors in equal depths."""

    name: ClassVar[str] = "exponential"

    def modulus(self, top: float, bottom: float, depth: float) -> float:
        """E at the relative ``depth`` 0…1 between ``top`` and ``bottom``, in their unit."""
        return float(top * (bottom / top) ** depth)


@dataclass(frozen=True)
class PowerGrading:
    """E changes from its value at the top in proportion to depth to the power ``exponent`` > 0.

    Below 1 the gradient is infinite at the top and the error of thin layers falls more slowly than
    their thickness squared.
    """

    exponent: float
    name: ClassVar[str] = "power law"

    def __post_init__(self) -> None:
        require.positive(self.exponent, "exponent of a graded layer")

    def modulus(self, top: float, bottom: float, depth: float) -> float:
        """E at the relative ``depth`` 0…1 between ``top`` and ``bottom``, in their unit."""
        return float(top + (bottom - top) * depth**self.exponent)


Grading: TypeAlias = LinearGrading | ExponentialGrading | PowerGrading
"""Young's modulus as a function of depth."""


def graded(
    top: Elastic,
    bottom: Elastic,
    thickness: float,
    *,
    grading: Grading = ExponentialGrading(),
    sublayers: int = 32,
    interface: Interface = Bonded(),
) -> tuple[Layer, ...]:
    """Layers of a coating whose modulus changes with depth, to be put into
    ``Layered([*graded(...), …], base)``.

    Each sublayer has the values at its middle, so that the error of the compliance falls with the
    square of the number of sublayers: 1e-6 relative at 64 for a fourfold modulus and a contact as
    wide as the coating is thick.

    ``top``, ``bottom``: materials at the surface and at the lower end. Poisson's ratio and, where
    both are known, hardness, yield stress, hardening, wear coefficient and what conducts change in
    proportion to depth;
    ``thickness``: of the whole coating in m, > 0; ``grading``: ``LinearGrading()``,
    ``ExponentialGrading()`` or ``PowerGrading(exponent)``; ``sublayers``: number of equal
    layers, >= 1; ``interface``: of the lowest sublayer to what lies below; the others are bonded.

    InputError if a value is outside its range or of the wrong type.
    """
    require.instance(top, Elastic, "material at the top of a graded layer")
    require.instance(bottom, Elastic, "material at the bottom of a graded layer")
    for end in (top, bottom):
        if isinstance(end, Viscoelastic) and end.spectrum:
            raise InputError(
                f"materials of a graded layer must be elastic, but {end.name or 'one'} relaxes. Give "
                "homogeneous layers instead."
            )
    require.positive(thickness, "thickness of a graded layer (m)")
    count = require.integer(sublayers, 1, "number of sublayers of a graded layer")
    if not isinstance(grading, Grading):
        raise InputError(
            "grading must be LinearGrading(), ExponentialGrading() or PowerGrading(exponent), "
            f"but is {type(grading).__name__}."
        )
    materials = [_between(top, bottom, (number + 0.5) / count, grading) for number in range(count)]
    interfaces = [Bonded()] * (count - 1) + [interface]
    return tuple(Layer(m, thickness / count, i) for m, i in zip(materials, interfaces, strict=True))


def _between(top: Elastic, bottom: Elastic, depth: float, grading: Grading) -> Elastic:
    """Material at the relative ``depth``. InputError if top and bottom harden by laws of different
    kinds."""

    def mixed(first: float, last: float) -> float:
        return first + (last - first) * depth

    first, last = top.strength, bottom.strength
    hardening, lowest = first.hardening, last.hardening
    if hardening is not None or lowest is not None:
        if type(hardening) is not type(lowest) or not is_dataclass(hardening) or not is_dataclass(lowest):
            names = [getattr(item, "name", "perfectly plastic") for item in (hardening, lowest)]
            raise InputError(
                f"hardening of a graded layer must be of one kind at top and bottom, but is {names[0]} and "
                f"{names[1]}. Give both alike."
            )
        names = [item.name for item in fields(hardening)]
        values = {name: mixed(getattr(hardening, name), getattr(lowest, name)) for name in names}
        hardening = replace(hardening, **values)
    return Elastic(
        grading.modulus(top.youngs_modulus, bottom.youngs_modulus, depth),
        mixed(top.poisson_ratio, bottom.poisson_ratio),
        Strength(
            mixed(first.hardness, last.hardness),
            mixed(first.yield_stress, last.yield_stress) if first.hardening is None else math.nan,
            hardening,
            mixed(first.kinematic, last.kinematic),
            mixed(first.recall, last.recall),
            mixed(first.wear_coefficient, last.wear_coefficient),
        ),
        conduction=Conduction(
            *(
                mixed(getattr(top.conduction, key.name), getattr(bottom.conduction, key.name))
                for key in fields(Conduction)
            )
        ),
        name=f"graded {top.name} - {bottom.name}".strip(" -") if top.name or bottom.name else "",
    )


def unknown_strengths(body: Body) -> tuple[str, ...]:
    """What keeps the hardness of the layered ``body`` with its base from being known by depth:
    names of materials of unknown strength, a rigid base."""
    parts = materials_of(body)
    unknown = [part.name or "a material" for part in parts if yield_pressure(part.strength).value is None]
    rigid = isinstance(body, Layered) and isinstance(body.reduced.base, RigidBase)
    return (*dict.fromkeys(unknown), *(["the rigid base"] if rigid else []))


@dataclass(frozen=True)
class SurfaceStrength:
    """Contact pressure at which a body of a contact yields plastically at its surface.

    Attributes
    ----------
    body
        Which of the two bodies of the problem it is.
    material
        Name of the material at its surface, of a coated body that of its top layer; ``"the body"``
        or ``"the counter body"`` without a name.
    pressure
        Hardness, else 2.8 Y (Tabor 1951), in Pa; None where neither hardness nor yield stress is
        known.
    known_as
        How it is known, such as ``"H of DLC"`` or ``"2.8 Y of stainless steel"``; empty where it is
        not.
    """

    body: Literal["body", "counter_body"]
    material: str
    pressure: float | None
    known_as: str

    @property
    def by_hardness(self) -> bool:
        """Whether it is a stated hardness."""
        return self.known_as.startswith("H ")


def strength_of(body: Body, counter_body: Body) -> tuple[SurfaceStrength, ...]:
    """Strength of the surfaces of two bodies in contact, those left out that never yield: rigid
    ones and elastomers without a known strength."""
    found = (_surface("body", body), _surface("counter_body", counter_body))
    return tuple(strength for strength in found if strength is not None)


def _surface(which: Literal["body", "counter_body"], body: Body) -> SurfaceStrength | None:
    solid = surface_material(body)
    if solid is None or never_yields(solid):
        return None
    found, name = yield_pressure(solid.strength), solid.name or body.name or f"the {which.replace('_', ' ')}"
    return SurfaceStrength(which, name, found.value, f"{found.symbol} of {name}" if found.symbol else "")
