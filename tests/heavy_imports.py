"""Packages that cost time to import and must wait until something needs them."""

from __future__ import annotations

HEAVY = (
    "PIL",
    "SurfaceTopography",
    "dask",
    "ducc0",
    "h5netcdf",
    "h5py",
    "jinja2",
    "joblib",
    "matplotlib",
    "numba",
    "numpy",
    "pandas",
    "pint",
    "pydantic",
    "scipy",
    "xarray",
)

NOT_FOR_COMMANDS = (
    "SurfaceTopography.IO.NMM",
    "dask",
    "jinja2",
    "joblib",
    "matplotlib",
    "pandas",
    "pint",
    "requests",
    "scipy.optimize",
    "scipy.signal",
    "scipy.stats",
    "xarray",
)
"""What `info` and `contact` do without as long as no file is to be written."""
