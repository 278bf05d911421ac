"""Spectra column by column of the half spectrum, for grids whose modes do not fit into the memory."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from .embedding import Spectrum
from .measured import TabulatedSpectrum
from .power_laws import lattice_level
from .spectra import SelfAffine, TwoSlopes

Columns = Callable[[slice], RealArray]
"""C in m⁴ on the columns of the half spectrum that a slice names, shape (nx, columns)."""


def spectrum_columns(spectrum: Spectrum, grid: Grid, width: int) -> Columns:
    """``spectrum.lattice_psd(grid)`` in pieces; ``width`` columns at a time where a sum over all modes is needed first.

    Raises
    ------
    InputError
        If the spectrum is not a function of the wavenumber alone, or the grid does not suit it.
    """
    if isinstance(spectrum, TabulatedSpectrum):
        table = spectrum
        return lambda columns: table.interpolated(_wavenumber(grid, columns))
    if not isinstance(spectrum, SelfAffine | TwoSlopes):
        raise InputError(
            "spectrum of a surface beyond the memory must be SelfAffine, TwoSlopes or a table of the wavenumber, but is "
            f"{type(spectrum).__name__}. Use endless(), or on the command line digital_filter, for autocorrelations."
        )
    law = spectrum.law
    level = lattice_level(
        law, spectrum.amplitude, grid, ((c, law.relative(_wavenumber(grid, c))) for c in column_slices(grid, width))
    )
    return lambda columns: level * law.relative(_wavenumber(grid, columns))


def column_slices(grid: Grid, width: int) -> Iterator[slice]:
    """All columns of the half spectrum of ``grid``, ``width`` at a time."""
    count = grid.shape[1] // 2 + 1
    return (slice(start, min(start + width, count)) for start in range(0, count, width))


def _wavenumber(grid: Grid, columns: slice) -> RealArray:
    qx, qy = grid.wavevector()
    return np.hypot(qx, qy[:, columns])
