"""Debris that stays in the gap: a third body, as a layer that gives way to the pressure."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from ...contact.answer import Answer
from ...contact.couplings.protocol import Contact, Coupling, Exchange, Memory, Posed
from ...contact.problem import ContactProblem, Physics, Preparing
from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quantity import measured

if TYPE_CHECKING:
    from ...contact.operators import Operator

TOLERANCE = 1e-6
"""Relative L2 change of the displacement of the layer that does not count."""


@dataclass(frozen=True)
class Debris:
    """What stays of the material that is worn away.

    Parameters
    ----------
    share
        Share of the worn volume that stays where it was worn off, 0 to 1.
    modulus
        Modulus (Pa, > 0) of the layer in one-dimensional compression, pressure over relative
        change of its thickness.

    Raises
    ------
    InputError
        If a value is out of its range.
    """

    share: float
    modulus: float

    def __post_init__(self) -> None:
        if not 0.0 <= self.share < 1.0:
            raise InputError(
                f"share of the debris that stays must be at least 0 and below 1, but is {self.share:g}. With 1 nothing "
                "would be worn."
            )
        require.positive(self.modulus, "modulus of the debris (Pa)")


@dataclass(frozen=True, eq=False)
class ThirdBody(Physics):
    """A layer of debris between the surfaces that carries no load sideways: it is compressed by p
    t/M (Winkler).

    Its thickness is part of the heights of a surface. Give it to a problem as
    ``physics=[ThirdBody(thickness, modulus)]``.

    Parameters
    ----------
    thickness
        t in m, >= 0: (nx, ny).
    modulus
        M in Pa, > 0.

    Raises
    ------
    InputError
        If a value is out of its range.
    """

    thickness: RealArray
    modulus: float
    moving: ClassVar[str] = ""

    def __post_init__(self) -> None:
        found = require.field(self.thickness, "thickness of a third body (m)")
        if not (found.min() >= 0.0 and np.isfinite(found).all()):
            raise InputError(
                f"thickness of a third body (m) must be finite and not negative, but its smallest value is "
                f"{found.min():g}."
            )
        require.positive(self.modulus, "modulus of a third body (Pa)")

    def check(self, problem: ContactProblem) -> None:
        """Its thickness has the shape of the surface."""
        require.field(self.thickness, "thickness of a third body (m)", problem.surface.shape)

    def couplings(self, problem: ContactProblem, operator: Operator, how: Preparing) -> Iterator[Coupling]:
        """Its compression."""
        yield Compression(self.thickness / self.modulus, operator.smallest)

    def rows(self) -> list[tuple[str, str]]:
        """Largest thickness and modulus."""
        return [("Third body", f"up to {self.thickness.max():.3g} m thick, modulus {self.modulus:.3g} Pa")]


@dataclass(frozen=True, eq=False)
class CompressedLayer(Answer):
    """What the pressure does to a third body.

    Attributes
    ----------
    compression
        By how much it is compressed, (nx, ny) in m.
    energy
        Elastic energy that it stores, J.
    """

    compression: RealArray = measured("m", "compression of the third body", "x", "y")
    energy: float = measured("J", "elastic energy of the third body")

    def lifted(self) -> RealArray:
        """The compression."""
        return self.compression


@dataclass(frozen=True, eq=False)
class Compression(Coupling):
    """Displacement by a layer of the ``compliance`` (nx, ny) in m/Pa; the unknown is that
    displacement.

    More of it takes pressure away, over the ``stiffest`` compliance (m/Pa) of the bodies at most,
    so that the target is between the last displacement and that under its pressure.
    """

    compliance: RealArray
    stiffest: float
    name: ClassVar[str] = "third_body"
    feedback: ClassVar[bool] = True
    settled_text: ClassVar[str] = "The compression of the third body is settled"
    unsettled_text: ClassVar[str] = "The compression of the third body still changes by {change:.1e}"
    remedy: ClassVar[str] = "Take a stiffer layer, or a thinner one."

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """The compression under the pressure to start from."""
        start = posed.start
        x = np.zeros(posed.profile.shape) if start is None else self.compliance * start
        return Exchange(x, x, np.inf, TOLERANCE)

    def reply(self, exchange: Exchange, contact: Contact) -> Exchange:
        """The compression under the pressure of ``contact``."""
        wanted = self.compliance * contact.pressure
        size, change = float(np.linalg.norm(wanted)), float(np.linalg.norm(wanted - exchange.x))
        target = exchange.x + (wanted - exchange.x) / (1.0 + self.compliance / self.stiffest)
        return replace(exchange, target=target, residual=change / size if size else change, scale=size or 1.0)

    def end(self, exchange: Exchange, contact: Contact) -> tuple[Memory, CompressedLayer]:
        """Nothing to remember: the compression follows from the pressure."""
        pixel = contact.posed.operator.grid.pixel_area
        energy = 0.5 * float((contact.pressure * exchange.x).sum()) * pixel
        return {}, CompressedLayer(exchange.x, energy)
