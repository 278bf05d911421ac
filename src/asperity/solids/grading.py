"""Graded coatings as stacks of thin homogeneous layers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, TypeAlias

from ..core import require
from ..core.errors import InputError
from .elastic import Elastic, Strength
from .layers import Bonded, Interface, Layer


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

    Below 1 the gradient is infinite at the top and the error of thin layers falls more slowly than their thickness squared.
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
    """Layers of a coating whose modulus changes with depth, to be put into ``Layered([*graded(...), …], base)``.

    Each sublayer has the values at its middle, so that the error of the compliance falls with the square of the number of
    sublayers: 1e-6 relative at 64 for a fourfold modulus and a contact as wide as the coating is thick.

    ``top``, ``bottom``: materials at the surface and at the lower end. Poisson's ratio and, where both are known,
    hardness and yield stress change in proportion to depth; ``thickness``: of the whole coating in m, > 0;
    ``grading``: ``LinearGrading()``, ``ExponentialGrading()`` or ``PowerGrading(exponent)``; ``sublayers``: number of
    equal layers, >= 1; ``interface``: of the lowest sublayer to what lies below; the others are bonded.

    InputError if a value is outside its range or of the wrong type.
    """
    require.instance(top, Elastic, "material at the top of a graded layer")
    require.instance(bottom, Elastic, "material at the bottom of a graded layer")
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
    def mixed(first: float, last: float) -> float:
        return first + (last - first) * depth

    return Elastic(
        grading.modulus(top.youngs_modulus, bottom.youngs_modulus, depth),
        mixed(top.poisson_ratio, bottom.poisson_ratio),
        Strength(
            mixed(top.strength.hardness, bottom.strength.hardness),
            mixed(top.strength.yield_stress, bottom.strength.yield_stress),
        ),
        name=f"graded {top.name} - {bottom.name}".strip(" -") if top.name or bottom.name else "",
    )
