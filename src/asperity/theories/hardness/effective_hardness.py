"""Hardness of coatings on substrates, of several coatings, and from an indentation curve."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, field
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quadrature import gauss
from ...core.quantity import Quantity
from ...core.values import Force, HardnessValue, Length, Number, Positive
from ..ask import Way, asked
from ..protocol import Theory, checked


@dataclass(frozen=True, eq=False, repr=False)
class HardnessAnswer(Tabled):
    """``hardness`` in Pa and ``coating_share`` of it, (n,)."""

    hardness: RealArray
    coating_share: RealArray


@dataclass(frozen=True)
class EffectiveHardness(Theory):
    """Hardness H_e of a coating (1) of thickness h on a substrate (2), indented to the depth h_c.

        H_e = H_2 + (H_1 - H_2) exp[-((Y_1/Y_2)/(E_1/E_2)) (h_c/h)²]  (H_1 ≤ H_2),
        H_e = H_2 + (H_1 - H_2) exp[-(H_1/H_2)/((Y_1/Y_2) sqrt(E_1/E_2)) (h_c/h)]  (H_1 > H_2).

    Notes
    -----
    Fitted to finite elements with a rigid cone, for depths up to about h; beyond, the formulas tend
    to the substrate.

    Examples
    --------
    >>> hard = EffectiveHardness(15e9, 9e9, modulus_ratio=140 / 190)
    >>> [f"{value / 1e9:.2f}" for value in hard.at([0.0, 0.3, 1.0, 30.0])]
    ['15.00', '13.23', '10.87', '9.00']
    """

    coating: Annotated[HardnessValue, Help("hardness of the coating", of="bodies")]
    substrate: Annotated[HardnessValue, Help("hardness of the substrate", of="bodies")]
    modulus_ratio: Annotated[Positive, Help("Young's modulus of the coating over that of the substrate", of="bodies")]
    yield_ratio: Annotated[
        Positive | None, Help("yield stress of coating over substrate; that of the hardnesses by default", of="bodies")
    ] = None
    name: ClassVar[str] = "effective-hardness"
    title: ClassVar[str] = "Effective hardness of a coating on a substrate"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhattacharya1988", "Peng2001")
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("depth_ratio", "", "depth of the indentation over the thickness of the coating"),
            "at_depth_ratio",
            (
                Quantity("hardness", "Pa", "hardness that the indenter meets"),
                Quantity("coating_share", "1", "weight of the coating, from one down to zero"),
            ),
        ),
    )

    def at(self, depth_ratio: ArrayLike) -> RealArray:
        """H_e in Pa at h_c/h = ``depth_ratio`` (any shape, >= 0). InputError if a depth is
        negative."""
        return self.substrate + (self.coating - self.substrate) * self.coating_share(depth_ratio)

    def at_depth_ratio(self, depth_ratio: ArrayLike) -> HardnessAnswer:
        """Hardness and share of the coating at h_c/h = ``depth_ratio`` (any shape, >= 0)."""
        return HardnessAnswer(self.at(depth_ratio), self.coating_share(depth_ratio))

    def coating_share(self, depth_ratio: ArrayLike) -> RealArray:
        """Weight (H_e - H2)/(H1 - H2) of the coating at h_c/h = ``depth_ratio`` (any shape, >= 0),
        from one down to zero."""
        depth = checked(depth_ratio, "depth of an indentation")
        hardness_ratio = self.coating / self.substrate
        yield_ratio = hardness_ratio if self.yield_ratio is None else self.yield_ratio
        if hardness_ratio <= 1.0:
            return np.asarray(np.exp(-yield_ratio / self.modulus_ratio * depth**2))
        return np.asarray(np.exp(-hardness_ratio / (yield_ratio * self.modulus_ratio**0.5) * depth))


# Several coatings, each treated as one on a substrate.


_KNOTS = 2000
_SHALLOWEST, _DEEPEST = 1e-3, 1e4
_ORDER = 4


@dataclass(frozen=True, eq=False)
class StackHardness:
    """Hardness at the depth d of coatings whose lower faces lie at the depths t_k: H = H_N + Σ
    (H_k - H_(k+1)) s_k(d).

    s_k is the share of the coating in the law of Bhattacharya & Nix for the materials above and
    below the face k, at the depth ratio d/t_k, but at least s_(k-1): every material keeps a
    weight >= 0, so that H lies between the extremes of the stack. One coating gives their law
    itself, a face between equal materials changes nothing, d -> 0 the hardness of the top, d -> ∞
    that of the base, and coatings of well separated thicknesses each other's hardness in between.
    The sum over faces is an extension of this package; one coating is what was fitted.

    InputError if there is no face, the depths are not as many, positive and increasing, or
    neighbours do not agree.

    Parameters
    ----------
    faces
        The law of coating and substrate at every face, from the top; the substrate of one is the
        coating of the next.
    depths
        Depths t_k in m of the faces, increasing, > 0.
    """

    faces: tuple[EffectiveHardness, ...]
    depths: tuple[float, ...]
    _knots: RealArray = field(init=False, repr=False)
    _works: RealArray = field(init=False, repr=False)
    citation_keys: ClassVar[tuple[str, ...]] = EffectiveHardness.citation_keys

    def __post_init__(self) -> None:
        if not self.faces or len(self.faces) != len(self.depths):
            raise InputError(
                f"depths of a stack must be as many as its faces, at least one, but are {len(self.depths)} for "
                f"{len(self.faces)} faces."
            )
        above = 0.0
        for depth in self.depths:
            above = require.between(depth, above, np.inf, "depth of a face of a stack (m)", "Give them in order.")
        for upper, lower in itertools.pairwise(self.faces):
            if upper.substrate != lower.coating:
                raise InputError(
                    f"coating of each face of a stack must have the hardness {upper.substrate:g} Pa of the "
                    f"substrate of the face above, but has {lower.coating:g} Pa."
                )
        knots = np.geomspace(_SHALLOWEST * self.depths[0], _DEEPEST * self.depths[-1], _KNOTS)
        knots = np.concatenate([[0.0], knots])
        works = np.concatenate([[0.0], np.cumsum(self._integral(knots[:-1], knots[1:]))])
        object.__setattr__(self, "_knots", knots)
        object.__setattr__(self, "_works", works)

    def at(self, depth: ArrayLike) -> RealArray:
        """Hardness in Pa at ``depth`` in m (any shape, >= 0). InputError if a depth is negative."""
        d = np.asarray(depth, dtype=float)
        value: RealArray = np.full(d.shape, self.faces[-1].substrate)
        share: RealArray = np.zeros(d.shape)
        for face, thickness in zip(self.faces, self.depths, strict=True):
            share = np.maximum(share, face.coating_share(d / thickness))
            value += (face.coating - face.substrate) * share
        return value

    @property
    def extremes(self) -> tuple[float, float]:
        """Lowest and highest hardness in Pa at any depth, from the surface to far below all faces,
        where it is that of the base."""
        values = self.at(self._knots)
        return float(values.min()), float(values.max())

    def work(self, depth: ArrayLike) -> RealArray:
        """∫ H dd from the surface to ``depth`` in m (any shape, >= 0): work per area in J/m².

        By Gauss's rule between knots a hundredth deeper one than the other; relative error about
        1e-10, and 1e-6 where one share passes another between two knots.
        """
        d = np.asarray(depth, dtype=float)
        below = np.searchsorted(self._knots, d, side="right") - 1
        return self._works[below] + self._integral(self._knots[below], d)

    def _integral(self, low: RealArray, high: RealArray) -> RealArray:
        places, weights = gauss(np.stack([low, high], axis=-1), _ORDER)
        return np.asarray((self.at(places) * weights).sum(axis=-1))


# Hardness and modulus from an indentation curve (Oliver & Pharr 1992).


CONE, PARABOLOID, PUNCH = 0.72, 0.75, 1.0
"""ε of h_c = h_max - ε W/S by the shape of the indenter; Berkovich indenters behave as the
paraboloid."""

BERKOVICH = 24.5
"""Area over depth squared of an ideal Berkovich pyramid."""


@dataclass(frozen=True)
class OliverPharr(Theory):
    """Hardness and modulus from the initial unloading.

        h_c = h_max - ε W_max/S,  H = W_max/A(h_c),  E_r = (sqrt(π)/2) S/sqrt(A).

    InputError if a value is not positive, or the indenter would rebound further than it went in.
    """

    load: Annotated[Force, Help("peak load W_max", of="bodies")]
    depth: Annotated[Length, Help("depth h_max at peak load", of="bodies")]
    stiffness: Annotated[
        float, Number("N/m", above=0.0), Help("contact stiffness S = dW/dh at the start of unloading", of="bodies")
    ]
    shape: Annotated[
        float, Number(above=0.0, most=1.0), Help("ε: 0.72 cone, 0.75 paraboloid and Berkovich, 1 punch", of="bodies")
    ] = PARABOLOID
    area_factor: Annotated[Positive, Help("area over contact depth squared", of="bodies")] = BERKOVICH
    name: ClassVar[str] = "oliver-pharr"
    title: ClassVar[str] = "Oliver-Pharr, hardness and modulus from unloading"
    citation_keys: ClassVar[tuple[str, ...]] = ("Oliver1992",)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("hardness", "Pa", "hardness"),
        Quantity("contact_modulus", "Pa", "reduced modulus of indenter and body"),
        Quantity("contact_depth", "m", "depth of the contact"),
        Quantity("area", "m^2", "area of the contact"),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.contact_depth <= 0.0:
            raise InputError(
                f"depth at peak load must exceed the elastic part {self.depth - self.contact_depth:.4g} m, "
                f"but is {self.depth:.4g} m. Check the unit of the stiffness (N/m)."
            )

    @property
    def contact_depth(self) -> float:
        """h_c in m."""
        return self.depth - self.shape * self.load / self.stiffness

    @property
    def area(self) -> float:
        """A(h_c) in m²."""
        return self.area_factor * self.contact_depth**2

    @property
    def hardness(self) -> float:
        """H in Pa."""
        return self.load / self.area

    @property
    def contact_modulus(self) -> float:
        """E_r in Pa, 1/E_r = (1 - ν1²)/E1 + (1 - ν0²)/E0 with the indenter 0."""
        return 0.5 * math.sqrt(math.pi / self.area) * self.stiffness
