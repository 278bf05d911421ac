"""Results for other programs: a table of scalars as CSV, the fields as VTK image data."""

from __future__ import annotations

import base64
import csv
from pathlib import Path
from typing import IO, Any
from xml.sax.saxutils import quoteattr

import numpy as np

from ..contact.result import SCALARS, ContactResult
from ..contact.wet_result import WET_SCALARS, WetContactResult
from .atomic import atomic_file
from .words import CERTIFICATE

VTK_TYPES = {"float64": "Float64", "float32": "Float32", "uint8": "UInt8"}
"""VTK's names of array types."""


def export_csv(result: ContactResult | WetContactResult, path: str | Path, *, overwrite: bool = False) -> None:
    """Write scalars, certificate and status of ``result`` to ``path``: columns name, value, unit, label; SI, exact.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    contact = result.contact if isinstance(result, WetContactResult) else result
    rows = [(q.name, getattr(contact, q.name), q.unit, q.label) for q in SCALARS]
    if isinstance(result, WetContactResult):
        rows += [(q.name, getattr(result, q.name), q.unit, q.label) for q in WET_SCALARS]
    for q in CERTIFICATE:
        rows.append((f"certificate.{q.name}", getattr(contact.certificate, q.name), q.unit, q.label))
    rows.append(("status.outcome", str(result.status.outcome), "", "how the solver ended"))
    with atomic_file(path, overwrite=overwrite) as partial, partial.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(("name", "value", "unit", "label"))
        writer.writerows(rows)


def export_vtk(result: ContactResult, path: str | Path, *, overwrite: bool = False) -> None:
    """Write the fields of ``result`` as point data on the nodes to ``path``, VTK image data (.vti), lengths in m.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    names = ("pressure", "gap", "displacement", "permanent_indentation")
    fields: dict[str, np.ndarray[Any, Any]] = {"heights": result.problem.surface.heights}
    fields |= {name: getattr(result, name) for name in names}
    fields["contact"] = (result.contact.astype(np.uint8) + result.plastic).astype(np.uint8)
    grid = result.problem.grid
    with atomic_file(path, overwrite=overwrite) as partial, partial.open("w", encoding="ascii") as file:
        _write_image(file, grid.spacing, fields)


def _write_image(file: IO[str], spacing: tuple[float, float], fields: dict[str, np.ndarray[Any, Any]]) -> None:
    """VTK image data of ``fields``, arrays [x, y]; in VTK x runs fastest, hence the transposition."""
    nx, ny = fields["heights"].shape
    extent = f'"0 {nx - 1} 0 {ny - 1} 0 0"'
    file.write('<?xml version="1.0"?>\n')
    file.write('<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n')
    file.write(f'<ImageData WholeExtent={extent} Origin="0 0 0" Spacing="{spacing[0]!r} {spacing[1]!r} 1">\n')
    file.write(f'<Piece Extent={extent}>\n<PointData Scalars="pressure">\n')
    for name, values in fields.items():
        little = np.ascontiguousarray(values.T).astype(values.dtype.newbyteorder("<"), copy=False)
        kind = VTK_TYPES[values.dtype.name]
        file.write(f'<DataArray type="{kind}" Name={quoteattr(name)} format="binary">\n')
        data = little.tobytes()
        file.write(base64.b64encode(np.uint64(len(data)).astype("<u8").tobytes() + data).decode("ascii"))
        file.write("\n</DataArray>\n")
    file.write("</PointData>\n</Piece>\n</ImageData>\n</VTKFile>\n")
