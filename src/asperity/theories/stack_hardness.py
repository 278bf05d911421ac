"""Hardness of a solid with several coatings, by indentation depth: films on substrates, one below the other."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from .effective_hardness import EffectiveHardness

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

    Parameters
    ----------
    faces
        The law of film and substrate at every face, from the top; the substrate of one is the film of the next.
    depths
        Depths t_k in m of the faces, increasing, > 0.

    Raises
    ------
    InputError
        If there is no face, the depths are not as many, positive and increasing, or neighbours do not agree.
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
        """Hardness in Pa at ``depth`` in m (any shape, >= 0).

        Raises
        ------
        InputError
            If a depth is negative.
        """
        d = np.asarray(depth, dtype=float)
        value: RealArray = np.full(d.shape, self.faces[-1].substrate)
        share: RealArray = np.zeros(d.shape)
        for face, thickness in zip(self.faces, self.depths, strict=True):
            share = np.maximum(share, face.film_share(d / thickness))
            value += (face.film - face.substrate) * share
        return value

    def work(self, depth: ArrayLike) -> RealArray:
        """∫ H dd from the surface to ``depth`` in m (any shape, >= 0): work per area in J/m².

        By Gauss's rule between knots a hundredth deeper one than the other; relative error about 1e-10, and 1e-6 where one
        share passes another between two knots.
        """
        d = np.asarray(depth, dtype=float)
        below = np.searchsorted(self._knots, d, side="right") - 1
        value: RealArray = self._works[below] + self._integral(self._knots[below], d)
        return value

    def _integral(self, low: RealArray, high: RealArray) -> RealArray:
        nodes, weights = np.polynomial.legendre.leggauss(_ORDER)
        half = 0.5 * (high - low)
        places = (low + half)[..., None] + half[..., None] * nodes
        value: RealArray = half * (self.at(places) @ weights)
        return value
