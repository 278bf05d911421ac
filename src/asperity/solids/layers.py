"""Layered bodies: any number of coatings on a half-space or on a rigid base."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

from ..core import require
from ..core.errors import InputError
from ..core.late import Shown
from .elastic import Elastic
from .interface import Bonded, Frictionless, Interface


@dataclass(frozen=True)
class RigidBase:
    """Undeformable base to which the lowest layer is fixed."""

    name: ClassVar[str] = "rigid base"


Base: TypeAlias = Elastic | RigidBase
"""What lies under all layers."""


@dataclass(frozen=True)
class Layer:
    """One homogeneous layer.

    Parameters
    ----------
    material
        ``Elastic(...)`` or a named material.
    thickness
        h in m, >= 0. A layer of zero thickness vanishes; under one of infinite thickness nothing matters.
    interface
        How it is joined to what lies below it: ``Bonded()`` or ``Frictionless()``.

    Raises
    ------
    InputError
        If the material is no ``Elastic``, the thickness negative or no number, or the interface none of the two.
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

    Parameters
    ----------
    layers
        From the surface down; an empty sequence leaves the bare base.
    base
        Material of the half-space below, or ``RigidBase()``.
    name
        For tables and reports.

    Raises
    ------
    InputError
        If a layer is no ``Layer``, or the base neither ``Elastic`` nor ``RigidBase``.
    """

    layers: Sequence[Layer]
    base: Base
    name: str = ""

    def __post_init__(self) -> None:
        if isinstance(self.layers, Layer):
            raise InputError("layers of a Layered body must be a list of Layer, but is a single Layer; write [layer].")
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
        """The same body without layers of zero thickness and without what lies under a layer of infinite thickness."""
        kept: list[Layer] = []
        for layer in self.layers:
            if layer.thickness == math.inf:
                return Layered(kept, layer.material, self.name)
            if layer.thickness > 0.0:
                kept.append(layer)
        return Layered(kept, self.base, self.name)

    @property
    def bare(self) -> Layered:
        """The reduced body with nothing but its elastic constants, so that equal ones deform alike and the reverse."""
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
