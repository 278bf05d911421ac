"""Generated surfaces of a document: every key of a table becomes an argument of the function of its kind."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from ..core.grid import Grid
from ..core.settings import Settings
from ..surfaces import generate
from ..surfaces.surface import Surface
from .quantities import si_values
from .schemas import random_surfaces, shapes, spectra
from .schemas.base import FileSurface

Reader = Callable[[FileSurface, Path], Surface]
"""Reads and prepares the surface of a file, for spectra and heights that are measured."""

FUNCTIONS = {"rough": "gaussian"}
"""Function of ``asperity.generate`` for the kinds that have another name."""

_COMMON = ("kind", "points", "size", "prepare", "mirror", "place")  # keys that are no arguments


def build_generated(
    table: shapes.Shape | random_surfaces.RandomSurface, folder: Path, read: Reader, **more: Any
) -> Surface:
    """Surface that ``table`` describes, before its preparation; ``more`` arguments go to the generator.

    Relative paths of measured surfaces start at ``folder``.
    """
    grid = table_grid(table)
    arguments = si_values(table, leave=_COMMON)
    for key, value in arguments.items():
        if isinstance(value, Settings):
            arguments[key] = _part(value, folder, read)
    function: Callable[..., Surface] = getattr(generate, FUNCTIONS.get(table.kind, table.kind))
    return function(grid, **arguments, **more)


def table_grid(table: shapes.Shape | random_surfaces.RandomSurface) -> Grid:
    """Grid of a generated surface."""
    (nx, ny), (length_x, length_y) = table.points, si_values(table)["size"]
    return Grid((nx, ny), (length_x / nx, length_y / ny))


def build_spectrum(table: spectra.SpectrumTable, folder: Path, read: Reader) -> generate.Spectrum:
    """Spectrum that ``table`` describes."""
    values = si_values(table, leave=("kind", "surface", *spectra.AMPLITUDES))
    if isinstance(table, spectra.ExponentialSpectrum):
        return generate.ExponentialAutocorrelation(si_values(table)["rms_height"], **values)
    if isinstance(table, spectra.GaussianSpectrum):
        return generate.GaussianAutocorrelation(si_values(table)["rms_height"], **values)
    if isinstance(table, spectra.SelfAffineSpectrum):
        return generate.SelfAffine(amplitude=_amplitude(table), **values)
    if isinstance(table, spectra.TwoSlopesSpectrum):
        return generate.TwoSlopes(amplitude=_amplitude(table), **values)
    if isinstance(table, spectra.TableSpectrum):
        return generate.TabulatedSpectrum(2.0 * np.pi / np.array(values["wavelengths"]), values["psd"])
    return generate.spectrum_of(read(table.surface, folder), **values)


def _part(table: Settings, folder: Path, read: Reader) -> Any:
    """Spectrum or distribution of heights that ``table`` describes."""
    if isinstance(table, spectra.MomentsHeights):
        return generate.HeightMoments(table.skewness, table.kurtosis, table.system)
    if isinstance(table, spectra.TwoLevelsHeights):
        return generate.TwoLevels(table.share, table.separation, table.upper_deviation)
    if isinstance(table, spectra.MeasuredHeights):
        return generate.HeightsOf(read(table.surface, folder))
    return build_spectrum(table, folder, read)  # type: ignore[arg-type]


def _amplitude(table: spectra.SelfAffineSpectrum | spectra.TwoSlopesSpectrum) -> Any:
    given = si_values(table)
    kinds = {"rms_height": generate.RmsHeight, "rms_slope": generate.RmsSlope, "plateau": generate.PlateauPSD}
    return next(kind(given[key]) for key, kind in kinds.items() if key in given)
