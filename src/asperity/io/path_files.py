"""A load path as files: every step in one NetCDF-4 file, its scalars and energies as a CSV table."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..contact.energy import energy_balance
from ..contact.path import LoadPath
from ..contact.result import SCALARS
from ..core.quantity import Quantity
from .atomic import atomic_file
from .description import describe
from .results import dataset
from .words import FIELDS

if TYPE_CHECKING:
    import xarray

ENERGIES = (
    Quantity("external_work", "J", "external work along the path, by the trapezoidal rule"),
    Quantity("elastic_energy", "J", "elastic energy gained along the path"),
    Quantity("plastic_work", "J", "plastic work along the path"),
    Quantity("residual", "J", "external work less elastic energy and plastic work"),
)
"""Entries of an energy balance."""


def path_dataset(path: LoadPath, *, document: str | None = None) -> xarray.Dataset:
    """Dataset of ``path`` with dimensions step, x, y: scalars and fields of every step, and energies counted from its start.

    What all steps share (heights, bodies, law, provenance, the text of the problem ``document``) is that of ``dataset`` of
    the last step. ``converged`` and ``control`` (JSON text) say how each step ended and what it was told.

    Raises
    ------
    InputError
        If the problem holds a type that files do not know.
    """
    last = dataset(path.results[-1], document=document)
    shared = [name for name in ("heights", "counter_heights") if name in last]
    data = last[shared].assign_attrs(
        {key: value for key, value in last.attrs.items() if not key.startswith(("certificate_", "status_", "control"))}
    )
    variables: dict[str, Any] = {}
    for item in SCALARS:
        variables[item.name] = _column([getattr(r, item.name) for r in path.results], item)
    for item in FIELDS:
        stacked = np.stack([getattr(r, item.name) for r in path.results])
        variables[item.name] = (("step", "x", "y"), stacked, item.attributes)
    balance = energy_balance(path)
    for item in ENERGIES:
        variables[f"path_{item.name}"] = _column(getattr(balance, item.name), item)
    ended = Quantity("converged", "1", "whether the step reached its tolerance")
    variables["converged"] = _column([r.converged for r in path.results], ended)
    controls = [json.dumps(describe(r.control)) for r in path.results]
    return data.assign(variables).assign_attrs(title="load path of a contact", controls=json.dumps(controls))


def save_path(path: LoadPath, file: str | Path, *, document: str | None = None, overwrite: bool = False) -> None:
    """Write every step of ``path``, and the text of the problem ``document`` it came from, to the NetCDF-4 ``file``.

    ``open_dataset`` reads it; see ``path_dataset`` for what it holds.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    InputError
        If the problem holds a type that files do not know.
    """
    data = path_dataset(path, document=document)
    encoding: dict[str, dict[str, Any]] = {str(name): {"_FillValue": None} for name in data.variables}
    for item in FIELDS:
        nx, ny = path.results[0].problem.grid.shape
        packed = {"zlib": True, "complevel": 1, "shuffle": True, "chunksizes": (1, nx, ny)}
        encoding[item.name] |= packed  # one step is read at a time
    with atomic_file(file, overwrite=overwrite) as partial:
        data.to_netcdf(partial, engine="h5netcdf", encoding=encoding)


def export_path_csv(path: LoadPath, file: str | Path, *, overwrite: bool = False) -> None:
    """Write one row a step of ``path`` to ``file``: number, whether it converged, scalars and energies, SI, exact.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    balance = energy_balance(path)
    names = [f"{item.name} ({item.unit})" for item in SCALARS]
    names += [f"path_{item.name} ({item.unit})" for item in ENERGIES]
    with atomic_file(file, overwrite=overwrite) as partial, partial.open("w", newline="", encoding="utf-8") as text:
        writer = csv.writer(text)
        writer.writerow(("step", "converged", *names))
        for number, result in enumerate(path.results):
            energies = [float(getattr(balance, item.name)[number]) for item in ENERGIES]
            values = [getattr(result, item.name) for item in SCALARS]
            writer.writerow((number + 1, result.converged, *values, *energies))


def _column(values: Any, item: Quantity) -> tuple[str, Any, dict[str, str]]:
    return "step", np.asarray(values), item.attributes
