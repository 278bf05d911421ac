"""Effective hardness of a coated solid as a function of indentation depth (Bhattacharya & Nix 1988; Peng 2001, app. C)."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.parameters import Help
from ...core.quadrature import gauss
from ...core.quantity import Quantity
from ...core.values import Positive, Pressure
from ..ask import Way, asked
from ..protocol import Theory, checked


@dataclass(frozen=True, eq=False)
class HardnessAnswer:
    """``hardness`` in Pa and ``film_share`` of it, (n,)."""

    hardness: RealArray
    film_share: RealArray


@dataclass(frozen=True)
class EffectiveHardness(Theory):
    """Hardness H_e of a film (1) of thickness h on a substrate (2), indented to the depth h_c.

    Soft film, H1 <= H2: H_e = H2 + (H1 - H2) exp[-(Y1/Y2)/(E1/E2) (h_c/h)²].
    Hard film, H1 > H2: H_e = H2 + (H1 - H2) exp[-(H1/H2)/((Y1/Y2) (E1/E2)^½) h_c/h].

    Notes
    -----
    Fitted to finite elements with a rigid cone, for depths up to about h; beyond, the formulas tend to the substrate.

    Examples
    --------
    >>> hard = EffectiveHardness(15e9, 9e9, modulus_ratio=140 / 190)
    >>> [f"{value / 1e9:.2f}" for value in hard.at([0.0, 0.3, 1.0, 30.0])]
    ['15.00', '13.23', '10.87', '9.00']
    """

    film: Annotated[Pressure, Help("hardness of the film", of="bodies")]
    substrate: Annotated[Pressure, Help("hardness of the substrate", of="bodies")]
    modulus_ratio: Annotated[Positive, Help("Young's modulus of the film over that of the substrate", of="bodies")]
    yield_ratio: Annotated[
        Positive | None, Help("yield stress of film over substrate; that of the hardnesses by default", of="bodies")
    ] = None
    name: ClassVar[str] = "effective-hardness"
    title: ClassVar[str] = "Effective hardness of a film on a substrate"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhattacharya1988", "Peng2001")
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("depth_ratio", "", "depth of the indentation over the thickness of the film"),
            "at_depth_ratio",
            (
                Quantity("hardness", "Pa", "hardness that the indenter meets"),
                Quantity("film_share", "1", "weight of the film, from one down to zero"),
            ),
        ),
    )

    def at(self, depth_ratio: ArrayLike) -> RealArray:
        """H_e in Pa at h_c/h = ``depth_ratio`` (any shape, >= 0). InputError if a depth is negative."""
        return self.substrate + (self.film - self.substrate) * self.film_share(depth_ratio)

    def at_depth_ratio(self, depth_ratio: ArrayLike) -> HardnessAnswer:
        """Hardness and share of the film at h_c/h = ``depth_ratio`` (any shape, >= 0)."""
        return HardnessAnswer(self.at(depth_ratio), self.film_share(depth_ratio))

    def film_share(self, depth_ratio: ArrayLike) -> RealArray:
        """Weight (H_e - H2)/(H1 - H2) of the film at h_c/h = ``depth_ratio`` (any shape, >= 0), from one down to zero."""
        depth = checked(depth_ratio, "depth of an indentation")
        hardness_ratio = self.film / self.substrate
        yield_ratio = hardness_ratio if self.yield_ratio is None else self.yield_ratio
        if hardness_ratio <= 1.0:
            return np.asarray(np.exp(-yield_ratio / self.modulus_ratio * depth**2))
        return np.asarray(np.exp(-hardness_ratio / (yield_ratio * self.modulus_ratio**0.5) * depth))


# Several coatings, treated successively as films on substrates.


_KNOTS = 2000
_SHALLOWEST, _DEEPEST = 1e-3, 1e4
_ORDER = 4


@dataclass(frozen=True, eq=False)
class StackHardness:
    """Hardness at the depth d of coatings whose lower faces lie at the depths t_k: H = H_N + Σ (H_k - H_(k+1)) s_k(d).

    s_k is the share of the film in the law of Bhattacharya & Nix for the materials above and below the face k, at the
    depth ratio d/t_k, but at least s_(k-1): every material keeps a weight >= 0, so that H lies between the extremes of
    the stack. One coating gives their law itself, a face between equal materials changes nothing, d -> 0 the hardness
    of the top, d -> ∞ that of the base, and coatings of well separated thicknesses each other's hardness in between.
    The sum over faces is an extension of this package; one coating is what was fitted.

    InputError if there is no face, the depths are not as many, positive and increasing, or neighbours do not agree.

    Parameters
    ----------
    faces
        The law of film and substrate at every face, from the top; the substrate of one is the film of the next.
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
            if upper.substrate != lower.film:
                raise InputError(
                    f"film of each face of a stack must have the hardness {upper.substrate:g} Pa of the substrate of "
                    f"the face above, but has {lower.film:g} Pa."
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
            share = np.maximum(share, face.film_share(d / thickness))
            value += (face.film - face.substrate) * share
        return value

    def work(self, depth: ArrayLike) -> RealArray:
        """∫ H dd from the surface to ``depth`` in m (any shape, >= 0): work per area in J/m².

        By Gauss's rule between knots a hundredth deeper one than the other; relative error about 1e-10, and 1e-6 where
        one share passes another between two knots.
        """
        d = np.asarray(depth, dtype=float)
        below = np.searchsorted(self._knots, d, side="right") - 1
        return self._works[below] + self._integral(self._knots[below], d)

    def _integral(self, low: RealArray, high: RealArray) -> RealArray:
        places, weights = gauss(np.stack([low, high], axis=-1), _ORDER)
        return np.asarray((self.at(places) * weights).sum(axis=-1))
