"""Results for other programs: tables as CSV, fields as VTK image data."""

from __future__ import annotations

import base64
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any, Protocol
from xml.sax.saxutils import quoteattr

import numpy as np

from ..contact.answer import Answer
from ..contact.history import HistoryResult
from ..contact.result import SCALARS, ContactResult
from ..core.quantity import Labelled, Quantity
from .atomic import atomic_file
from .paths import ENERGIES
from .tables import write_table
from .words import CERTIFICATE

VTK_TYPES = {"float64": "Float64", "float32": "Float32", "uint8": "UInt8"}
"""VTK's names of array types."""


class Tabled(Protocol):
    """What makes a table of itself, such as the stresses of a survey."""

    def table(self) -> Iterator[tuple[Any, ...]]:
        """Its rows, the headings first."""


def export_csv(
    result: ContactResult | HistoryResult | Tabled,
    path: str | Path,
    *,
    scalars: Iterable[Labelled] = (),
    overwrite: bool = False,
) -> None:
    """Write the numbers of ``result`` to ``path`` as a table, SI, exact.

    Of a contact: scalars, further ``scalars`` such as those of an outcome, certificate and status,
    with the columns name, value, unit, label. Of a load path: one row a step, with its number,
    whether it converged, scalars and energies. Of stresses: the maxima of layers and interfaces
    with their places, and the load factors.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    rows: Iterable[Any]
    if isinstance(result, HistoryResult):
        rows = _step_table(result)
    else:
        rows = _table(result, scalars) if isinstance(result, ContactResult) else result.table()
    write_table(rows, path, overwrite=overwrite)


def _table(result: ContactResult, scalars: Iterable[Labelled]) -> Iterator[tuple[Any, ...]]:
    yield ("name", "value", "unit", "label")
    known = [Labelled(q, getattr(result, q.name)) for q in SCALARS]
    known += [Labelled(q, getattr(answer, q.name)) for answer in result.answers for q in answer.quantities]
    known += _numbers(result)
    values = {item.quantity.name: item for item in (*scalars, *known)}
    first = dict.fromkeys(item.quantity.name for item in known)
    for q, value in ((values[name].quantity, values[name].values) for name in first | dict.fromkeys(values)):
        yield q.name, value, q.unit, q.label
    for q in CERTIFICATE:
        yield f"certificate.{q.name}", getattr(result.certificate, q.name), q.unit, q.label
    yield "status.outcome", str(result.status.outcome), "", "how the solver ended"


def _step_table(path: HistoryResult) -> Iterator[tuple[Any, ...]]:
    balance = path.energies
    names = [f"{item.name} ({item.unit})" for item in SCALARS]
    names += [f"{item.quantity.name} ({item.quantity.unit})" for item in _numbers(path.last)]
    # coupling and quantity of each number of what couplings find, by its name; one that two have is
    # that of the first
    columns: dict[str, tuple[str, Quantity]] = {}
    for coupling, answer in path.last.couplings.items():
        for item in answer.quantities if isinstance(answer, Answer) else ():
            columns[f"{coupling}_{item.name}" if item.name in columns else item.name] = coupling, item
    names += [f"{name} ({item.unit})" for name, (_, item) in columns.items()]
    yield ("step", "converged", *names, *(f"path_{item.name} ({item.unit})" for item in ENERGIES))
    for number, result in enumerate(path.steps):
        energies = [float(getattr(balance, item.name)[number]) for item in ENERGIES]
        found: list[Any] = [item.values for item in _numbers(result)]
        found += [getattr(result.couplings.get(coupling), item.name, "") for coupling, item in columns.values()]
        yield (number + 1, result.converged, *(getattr(result, item.name) for item in SCALARS), *found, *energies)


def _numbers(result: ContactResult) -> list[Labelled]:
    """Numbers that follow from what the couplings of ``result`` found and from it."""
    return [item for answer in result.answers for item in answer.tabled(result)]


def export_vtk(result: ContactResult, path: str | Path, *, overwrite: bool = False) -> None:
    """Write the fields of ``result`` as point data on the nodes to ``path``, VTK image data (.vti),
    lengths in m.

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
        (nx, ny), (dx, dy) = grid.shape, grid.spacing
        extent = f'"0 {nx - 1} 0 {ny - 1} 0 0"'
        file.write('<?xml version="1.0"?>\n')
        file.write('<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n')
        file.write(f'<ImageData WholeExtent={extent} Origin="0 0 0" Spacing="{dx!r} {dy!r} 1">\n')
        file.write(f'<Piece Extent={extent}>\n<PointData Scalars="pressure">\n')
        for name, values in fields.items():
            little = np.ascontiguousarray(values.T).astype(values.dtype.newbyteorder("<"), copy=False)  # x runs fastest
            kind = VTK_TYPES[values.dtype.name]
            file.write(f'<DataArray type="{kind}" Name={quoteattr(name)} format="binary">\n')
            data = little.tobytes()
            file.write(base64.b64encode(np.uint64(len(data)).astype("<u8").tobytes() + data).decode("ascii"))
            file.write("\n</DataArray>\n")
        file.write("</PointData>\n</Piece>\n</ImageData>\n</VTKFile>\n")
