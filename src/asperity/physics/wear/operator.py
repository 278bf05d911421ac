"""The compliance of a step in which the bodies wear: that of the bodies and what each pressure
wears away under it.

An implicit step of the sliding distance puts k p ds into the gap, so that the surfaces give way to
the pressure as if they lay on a bed of springs as well (Winkler): K + b I, better conditioned than
K. A track, which wears by the mean of the pressure along x, adds a bed under these means.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ...contact.operators.convolution import (
    Octaves,
    Operator,
    PreparedOperator,
    restricted,
)
from ...core.arrays import RealArray
from ...core.engine import Convolution, Engine
from ...solids.compliance.halfspace import Compliance


@dataclass(eq=False)
class _Raised(Octaves):
    """Values of ``whole`` and the bed."""

    whole: Octaves
    bed: float

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """Displacement per pressure (m/Pa) at each ``wavenumber`` (rad/m)."""
        return np.asarray(self.whole.spectral(wavenumber) + self.bed)


@dataclass(eq=False)
class _WithBed:
    """Product with a compliance that holds one value of the bed, and what the bed is beside it."""

    whole: Convolution
    uneven: Any
    track: Any

    def apply(self, field: Any, out: Any) -> Any:
        """Displacement by ``field`` into ``out``, which is returned."""
        self.whole.apply(field, out)
        if self.uneven is not None:
            out += self.uneven * field
        if self.track is not None:
            out += self.track * field.mean(axis=0)
        return out


class WearOperator(PreparedOperator):
    """``whole`` and a ``bed``: u = K p + b p + t mean_x p.

    Parameters
    ----------
    whole
        Operator of the bodies.
    bed
        b in m/Pa, >= 0: a number or an array (nx, ny).
    track
        t in m/Pa, >= 0, (ny,): of a body that wears alike all along x; None for none.
    least
        Least value of the bed where the surfaces touch: the systems are preconditioned with a body
        on such a bed, whose points yield by the rest beside it; the least of all if not given.
    """

    def __init__(
        self, whole: Operator, bed: float | RealArray, track: RealArray | None = None, least: float | None = None
    ) -> None:
        self.whole, self.bed, self.track = whole, bed, track
        self.even = bed if isinstance(bed, float) else float(np.min(bed)) if least is None else least
        self.beside = np.maximum(bed - self.even, 0.0) if isinstance(bed, np.ndarray) else None
        self.grid, self.padded, self.boundary = whole.grid, whole.padded, whole.boundary
        self.engine: Engine = whole.engine
        self.compliance: Compliance = whole.compliance
        self.pairs_per_application = whole.pairs_per_application
        self.zero_mean_mode = whole.zero_mean_mode and not np.any(bed) and track is None
        self.translation_invariant = track is None and not isinstance(bed, np.ndarray)
        self.octaves: Octaves = _Raised(whole.octaves, self.even)

    @cached_property
    def kernel(self) -> RealArray:  # type: ignore[override]
        """Compliance (m/Pa) on the half spectrum, with the least value of the bed."""
        return np.asarray(self.whole.kernel + self.even)

    @cached_property
    def smallest(self) -> float:
        """Least compliance (m/Pa) of all waves."""
        whole = 0.0 if self.whole.zero_mean_mode else self.whole.smallest
        return whole + float(np.min(self.bed))

    @cached_property
    def coarsened(self) -> WearOperator:
        """The same on half as many points per side."""
        bed = restricted(self.bed) if isinstance(self.bed, np.ndarray) else self.bed
        track = None if self.track is None else restricted(self.track[None])[0]
        return WearOperator(self.whole.coarsened, bed, track, self.even)

    def convolution(self, dtype: str, scale: float = 1.0) -> Convolution:
        """Prepared product with the compliance over ``scale`` in the precision ``dtype``."""
        found = super().convolution(dtype, scale)
        if self.translation_invariant:
            return found
        known: dict[tuple[str, float], Convolution] = vars(self).setdefault("_with_bed", {})
        if (dtype, scale) not in known:
            uneven = np.asarray(self.bed) - self.even if isinstance(self.bed, np.ndarray) else None
            parts = (
                None if part is None else self.engine.array(np.ascontiguousarray(part / scale), dtype)
                for part in (uneven, self.track)
            )
            known[dtype, scale] = _WithBed(found, *parts)
        return known[dtype, scale]

    def matrix(self) -> RealArray:
        """Dense matrix in m/Pa."""
        nx, ny = self.grid.shape
        found = self.whole.matrix() + np.diag(np.broadcast_to(self.bed, (nx, ny)).ravel())
        if self.track is not None:
            means = np.kron(np.full((nx, nx), 1.0 / nx), np.diag(self.track))
            found = found + means
        return np.asarray(found)
