"""Packages that cost time to import and must wait until something needs them."""

from __future__ import annotations

HEAVY = (
    "PIL",
    "SurfaceTopography",
    "h5netcdf",
    "h5py",
    "jinja2",
    "matplotlib",
    "numba",
    "pandas",
    "pint",
    "pydantic",
    "scipy",
    "xarray",
)
