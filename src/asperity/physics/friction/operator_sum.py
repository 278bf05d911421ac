"""Sums of tangential operators, of bodies and of materials whose shear compliance is a sum."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...contact.operators.convolution import Octaves
from ...core.arrays import RealArray
from .operator import CouplingKernel, TangentialOperator


class SummedTangential(TangentialOperator):
    """Sum of the operators ``parts``, of one grid and boundary, times ``factors``."""

    def __init__(self, parts: Sequence[TangentialOperator], factors: Sequence[float]) -> None:
        self.parts, self.factors = tuple(parts), tuple(float(factor) for factor in factors)
        first = self.parts[0]
        octaves = _SummedOctaves([part.octaves for part in self.parts], self.factors)
        super().__init__(first.grid, first.compliance, first.boundary, engine=first.engine, octaves=octaves)

    @cached_property
    def entries(self) -> tuple[RealArray, RealArray, RealArray]:
        """``xx``, ``yy`` and ``xy`` (m/Pa) on the half spectrum of the grid or of its padded
        form."""
        xx, yy, xy = (self._sum([part.entries[number] for part in self.parts]) for number in range(3))
        return xx, yy, xy

    def _sum(self, values: Sequence[RealArray]) -> RealArray:
        return np.asarray(sum(factor * each for factor, each in zip(self.factors, values, strict=True)))

    @cached_property
    def coupling(self) -> CouplingKernel:
        """Coupling with the normal direction."""
        own = [part.coupling for part in self.parts]
        return CouplingKernel(
            self._sum([each.zx for each in own]), self._sum([each.zy for each in own]), own[0].transform
        )

    @cached_property
    def coarsened(self) -> TangentialOperator:
        """Operator on the grid of half as many points per side."""
        return SummedTangential([part.coarsened for part in self.parts], self.factors)


@dataclass(eq=False)
class _SummedOctaves(Octaves):
    """Sum of ``parts`` times ``factors`` at a few wavenumbers."""

    parts: Sequence[Octaves]
    factors: Sequence[float]

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """Displacement per traction (m/Pa) at each ``wavenumber`` (rad/m)."""
        found = [factor * part.spectral(wavenumber) for factor, part in zip(self.factors, self.parts, strict=True)]
        return np.asarray(sum(found))
