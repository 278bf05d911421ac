"""The operator of one step of time: a multiple of that of the first instant, or that of a sum of
retarded compliances."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ...core.arrays import RealArray
from ...core.engine import Engine
from ...solids.compliance.creep import AnyCreep, SharedCreep
from ...solids.compliance.halfspace import Compliance
from .convolution import Octaves, Operator, PreparedOperator, coarse_grid, prepare_operator


class MultipleOperator(PreparedOperator):
    """``factor`` times the operator ``whole``, with buffers of its own."""

    def __init__(self, whole: Operator, factor: float) -> None:
        self.whole, self.factor = whole, factor
        self.grid, self.padded, self.boundary = whole.grid, whole.padded, whole.boundary
        self.engine: Engine = whole.engine
        self.compliance: Compliance = whole.compliance
        self.zero_mean_mode, self.pairs_per_application = whole.zero_mean_mode, whole.pairs_per_application
        self.octaves: Octaves = _Multiple(whole.octaves, factor)

    @cached_property
    def kernel(self) -> RealArray:  # type: ignore[override]
        """Compliance (m/Pa) on the half spectrum."""
        return np.asarray(self.factor * self.whole.kernel)

    @cached_property
    def coarsened(self) -> MultipleOperator:
        """The same on half as many points per side."""
        return MultipleOperator(self.whole.coarsened, self.factor)

    def matrix(self) -> RealArray:
        """Dense matrix in m/Pa."""
        return np.asarray(self.factor * self.whole.matrix())


@dataclass(eq=False)
class _Multiple(Octaves):
    """``factor`` times the values of ``whole``."""

    whole: Octaves
    factor: float

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """Displacement per pressure (m/Pa) at each ``wavenumber`` (rad/m)."""
        return np.asarray(self.factor * self.whole.spectral(wavenumber))


class SummedOperator(PreparedOperator):
    """Operator of a ``compliance`` whose ``kernel`` (m/Pa) on the half spectrum of ``whole``, the
    operator at the first instant, is known."""

    def __init__(self, whole: Operator, compliance: Compliance, kernel: RealArray) -> None:
        self.whole, self.compliance, self.kernel = whole, compliance, kernel
        self.grid, self.padded, self.boundary = whole.grid, whole.padded, whole.boundary
        self.engine: Engine = whole.engine
        self.zero_mean_mode, self.pairs_per_application = whole.zero_mean_mode, whole.pairs_per_application
        self.octaves = Octaves(compliance)

    @cached_property
    def coarsened(self) -> Operator:
        """The same on half as many points per side."""
        return prepare_operator(self.compliance, coarse_grid(self.grid), self.boundary, engine=self.engine)

    def matrix(self) -> RealArray:
        """Dense matrix in m/Pa."""
        return prepare_operator(self.compliance, self.grid, self.boundary, engine=self.engine).matrix()


@dataclass(eq=False)
class OperatorsInTime:
    """Operators of the steps of time of one problem, whose operator at the first instant is
    ``instantaneous``; the last one is kept."""

    creep: AnyCreep
    instantaneous: Operator
    _last: tuple[bytes, Operator] | None = field(default=None, init=False)

    def at(self, weights: RealArray, added: RealArray | None) -> Operator:
        """Operator of the instantaneous compliance and ``weights`` (terms,) of those that are
        retarded.

        ``added`` is the sum of these (m/Pa) on the half spectrum, for layers.
        """
        if not weights.any():
            return self.instantaneous
        key = weights.tobytes()
        if self._last is None or self._last[0] != key:
            whole, made = self.instantaneous, self.instantaneous
            if isinstance(self.creep, SharedCreep):
                made = MultipleOperator(whole, 1.0 + float(self.creep.shares @ weights))
            else:
                assert added is not None
                made = SummedOperator(whole, self.creep.with_terms(weights), whole.kernel + added)
            self._last = key, made
        return self._last[1]
