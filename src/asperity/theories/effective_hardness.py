"""Hardness that an indenter meets in a coated solid, by its depth (Bhattacharya & Nix 1988; Peng 2001, app. C)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from .protocol import Input
from .ways import Column, Way, asked


@dataclass(frozen=True, eq=False)
class HardnessAnswer:
    """``hardness`` in Pa and ``film_share`` of it, (n,)."""

    hardness: RealArray
    film_share: RealArray


@dataclass(frozen=True)
class EffectiveHardness:
    """Hardness H_e of a film (1) of thickness h on a substrate (2), indented to the depth h_c.

    Soft film, H1 <= H2: H_e = H2 + (H1 - H2) exp[-(Y1/Y2)/(E1/E2) (h_c/h)²].
    Hard film, H1 > H2: H_e = H2 + (H1 - H2) exp[-(H1/H2)/((Y1/Y2) (E1/E2)^½) h_c/h].

    Parameters
    ----------
    film, substrate
        Hardnesses H1 and H2 in Pa, > 0.
    modulus_ratio
        E1/E2 of the Young's moduli, > 0.
    yield_ratio
        Y1/Y2 of the yield stresses, > 0; H1/H2 if not given, as Y = H/2.8 (Tabor 1951) says of both.

    Notes
    -----
    Fitted to finite elements with a rigid cone, for depths up to about h; beyond, the formulas tend to the substrate.

    Examples
    --------
    >>> hard = EffectiveHardness(15e9, 9e9, modulus_ratio=140 / 190)
    >>> [f"{value / 1e9:.2f}" for value in hard.at([0.0, 0.3, 1.0, 30.0])]
    ['15.00', '13.23', '10.87', '9.00']

    Raises
    ------
    InputError
        If a value is not positive.
    """

    film: float
    substrate: float
    modulus_ratio: float
    yield_ratio: float | None = None
    name: ClassVar[str] = "effective-hardness"
    title: ClassVar[str] = "Effective hardness of a film on a substrate"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhattacharya1988", "Peng2001")
    inputs: ClassVar[tuple[Input, ...]] = (
        Input("film", "Pa", "hardness of the film", of="bodies"),
        Input("substrate", "Pa", "hardness of the substrate", of="bodies"),
        Input("modulus_ratio", "", "Young's modulus of the film over that of the substrate", of="bodies"),
        Input(
            "yield_ratio",
            "",
            "yield stress of film over substrate; that of the hardnesses by default",
            of="bodies",
            optional=True,
        ),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("depth_ratio", "", "depth of the indentation over the thickness of the film"),
            "at_depth_ratio",
            (
                Column("hardness", "Pa", "hardness that the indenter meets"),
                Column("film_share", "", "weight of the film, from one down to zero"),
            ),
        ),
    )

    def __post_init__(self) -> None:
        require.positive(self.film, "hardness of the film (Pa)")
        require.positive(self.substrate, "hardness of the substrate (Pa)")
        require.positive(self.modulus_ratio, "ratio E1/E2 of film and substrate")
        if self.yield_ratio is not None:
            require.positive(self.yield_ratio, "ratio Y1/Y2 of film and substrate")

    def at(self, depth_ratio: ArrayLike) -> RealArray:
        """H_e in Pa at h_c/h = ``depth_ratio`` (any shape, >= 0).

        Raises
        ------
        InputError
            If a depth is negative.
        """
        value: RealArray = self.substrate + (self.film - self.substrate) * self.film_share(depth_ratio)
        return value

    def at_depth_ratio(self, depth_ratio: ArrayLike) -> HardnessAnswer:
        """Hardness and share of the film at h_c/h = ``depth_ratio`` (any shape, >= 0)."""
        return HardnessAnswer(self.at(depth_ratio), self.film_share(depth_ratio))

    def film_share(self, depth_ratio: ArrayLike) -> RealArray:
        """Weight (H_e - H2)/(H1 - H2) of the film at h_c/h = ``depth_ratio`` (any shape, >= 0), from one down to zero."""
        depth = _depth(depth_ratio)
        hardness_ratio = self.film / self.substrate
        yield_ratio = hardness_ratio if self.yield_ratio is None else self.yield_ratio
        if hardness_ratio <= 1.0:
            soft: RealArray = np.exp(-yield_ratio / self.modulus_ratio * depth**2)
            return soft
        hard: RealArray = np.exp(-hardness_ratio / (yield_ratio * self.modulus_ratio**0.5) * depth)
        return hard


def _depth(values: ArrayLike) -> RealArray:
    depth = np.asarray(values, dtype=float)
    if depth.size and not depth.min() >= 0.0:
        raise InputError(f"depth of an indentation must be at least zero, but is {depth.min():g}.")
    return depth
