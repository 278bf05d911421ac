"""The table of an isotropic spectrum whose interpolation keeps the power of every ring of modes it was averaged over."""

from __future__ import annotations

import numpy as np

from ...core.arrays import RealArray
from ..characterise.spectrum import PowerSpectrum, default_edges, radial_spectrum
from .measured import TabulatedSpectrum

_PARTS = 8  # of a ring, for the sum of the interpolated spectrum over it
_MOST = 3.0  # factor that a mean is scaled by at most: between empty rings nothing keeps the power of one
_ROUNDS = 12  # they leave 1e-4 of the power of a ring of a smooth spectrum, 1e-2 where it is cut off within one


def ring_table(spectrum: PowerSpectrum, *, per_decade: int, lowest: float, floor: float) -> tuple[RealArray, RealArray]:
    """Wavenumbers (rad/m) and C (m⁴) of the rings beyond ``lowest`` (rad/m) to the corners of the grid, less the ``floor`` (m⁴).

    The means of C over the rings, between which a power law is taken, would lose power where C is curved: 2 % of the mean
    square height at a roll-off, 12 % of the mean square curvature at a cut-off. They are scaled until the interpolated
    spectrum sums up to the power of each ring.
    """
    edges = default_edges(spectrum, per_decade, corners=True)
    rings = radial_spectrum(spectrum, edges)
    kept = rings.q >= lowest
    q, modes = rings.q[kept], rings.modes[kept]
    wanted = np.maximum(rings.psd[kept] - floor, 0.0) * modes
    q, psd = np.append(q, rings.high[-1]), wanted / modes
    if not wanted.any():
        return q, np.append(psd, 0.0)
    steps = np.arange(_PARTS * (edges.size - 1) + 1) / _PARTS
    parts = radial_spectrum(spectrum, np.exp(np.interp(steps, np.arange(edges.size), np.log(edges))))
    middle = np.sqrt(parts.low * parts.high)
    inside = middle > rings.low[kept][0]
    ring = np.searchsorted(rings.high[kept], middle[inside])
    for _ in range(_ROUNDS):
        table = TabulatedSpectrum(q, np.append(psd, psd[-1]))
        found = np.bincount(ring, table.interpolated(parts.q[inside]) * parts.modes[inside], psd.size)
        psd *= np.divide(wanted, found, out=np.ones_like(psd), where=(found > 0.0) & (wanted > 0.0))
        psd = np.clip(psd, wanted / modes / _MOST, wanted / modes * _MOST)
    return q, np.append(psd, psd[-1])
