"""Surfaces of a problem document: read or generated, then prepared step by step."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TypeAlias

from ..core import units
from ..core.grid import Grid
from ..surfaces import generate
from ..surfaces.pair import turned_over
from ..surfaces.prepare.crop import cropped
from ..surfaces.prepare.fill import filled
from ..surfaces.prepare.level import levelled
from ..surfaces.prepare.resample import resampled
from ..surfaces.prepare.window import periodised, tapered
from ..surfaces.read import read
from ..surfaces.surface import Surface
from .schemas import surfaces as tables
from .schemas.preparation import Crop, Fill, Level, Resample, Step, Taper

_Table: TypeAlias = tables.SurfaceTable


def build_surface(table: _Table, folder: Path) -> Surface:
    """Surface of ``table`` after its preparation steps; a relative file path starts at ``folder``."""
    surface = _from_file(table, folder) if isinstance(table, tables.FileSurface) else _generated(table)
    for step in table.prepare:
        surface = prepared(surface, step)
    return surface


def build_counter_surface(table: _Table, folder: Path) -> Surface:
    """Counter surface of ``table``, mirrored as it asks so that it lies in the frame of the other surface."""
    surface = build_surface(table, folder)
    return surface if table.mirror in (None, "none") else turned_over(surface, axis=str(table.mirror))


def prepared(surface: Surface, step: Step) -> Surface:
    """``surface`` after one preparation step."""
    if isinstance(step, Level):
        return levelled(surface, step.form)
    if isinstance(step, Crop):
        return cropped(surface, x=_interval(step.x), y=_interval(step.y))
    if isinstance(step, Resample):
        return resampled(surface, step.points)
    if isinstance(step, Fill):
        return filled(surface, step.method)
    if isinstance(step, Taper):
        return tapered(surface, step.width)
    return periodised(surface)


def _from_file(table: tables.FileSurface, folder: Path) -> Surface:
    return read(
        folder / table.path,
        channel=table.channel,
        size=None if table.size is None else units.parse_size(table.size),
        height_unit=table.height_unit,
        z_scale=None if table.z_scale is None else _length(table.z_scale),
    )


def _generated(table: tables.Shape | tables.Rough) -> Surface:
    (nx, ny), (length_x, length_y) = table.points, units.parse_size(table.size)
    grid = Grid((nx, ny), (length_x / nx, length_y / ny))
    if isinstance(table, tables.Rough):
        return generate.gaussian(grid, _spectrum(table.spectrum), seed=table.seed, exact_rms=table.exact_rms)
    if isinstance(table, tables.Sphere):
        return generate.sphere(grid, radius=_length(table.radius), exact=table.exact)
    if isinstance(table, tables.EllipticParaboloid):
        radii = _length(table.radius_x), _length(table.radius_y)
        return generate.elliptic_paraboloid(grid, radius_x=radii[0], radius_y=radii[1])
    if isinstance(table, tables.Cylinder):
        return generate.cylinder(grid, radius=_length(table.radius), axis=table.axis)
    if isinstance(table, tables.Cone):
        return generate.cone(grid, slope=table.slope)
    if isinstance(table, tables.FlatPunch):
        return generate.flat_punch(grid, radius=_length(table.radius), depth=_length(table.depth))
    if isinstance(table, tables.FlatSurface):
        return generate.flat(grid)
    amplitude, wavelength = _length(table.amplitude), _length(table.wavelength)
    if isinstance(table, tables.Sinusoid):
        return generate.sinusoid(grid, amplitude=amplitude, wavelength=wavelength, axis=table.axis)
    return generate.bisinusoid(grid, amplitude=amplitude, wavelength=wavelength)


def _spectrum(table: tables.ExponentialSpectrum | tables.SelfAffineSpectrum) -> generate.Spectrum:
    if isinstance(table, tables.ExponentialSpectrum):
        along_y = None if table.correlation_length_y is None else _length(table.correlation_length_y)
        return generate.ExponentialAutocorrelation(
            _length(table.rms_height), _length(table.correlation_length), table.drop, along_y
        )
    amplitude = (
        generate.RmsSlope(table.rms_slope or 0.0)
        if table.rms_height is None
        else generate.RmsHeight(_length(table.rms_height))
    )
    return generate.SelfAffine(
        amplitude=amplitude,
        hurst=table.hurst,
        rolloff_wavelength=_length(table.rolloff_wavelength),
        shortest_wavelength=_length(table.shortest_wavelength),
        longest_wavelength=math.inf if table.longest_wavelength is None else _length(table.longest_wavelength),
    )


def _interval(ends: tuple[str, str] | None) -> tuple[float, float] | None:
    return None if ends is None else (_length(ends[0]), _length(ends[1]))


def _length(text: str) -> float:
    return units.parse(text, "length", "length")
