"""Results for other programs: tables as CSV, fields as VTK image data and rectilinear grids."""

from __future__ import annotations

import base64
import math
import shutil
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import IO, Any
from xml.sax.saxutils import quoteattr

import numpy as np

from ..contact.answer import Answer
from ..contact.history import HistoryResult
from ..contact.result import SCALARS, ContactResult
from ..core.errors import InputError
from ..core.quantity import Labelled, Quantity
from ..physics.friction.fretting import SHEAR_SCALARS, shear_numbers
from ..physics.stress.field import Peak, StressField
from ..physics.stress.survey import StressSurvey
from .atomic import atomic_file
from .paths import ENERGIES
from .stress_files import Fields, components, peeked
from .tables import write_table
from .words import CERTIFICATE

VTK_TYPES = {"float64": "Float64", "float32": "Float32", "uint8": "UInt8"}
"""VTK's names of array types."""


def export_csv(
    result: ContactResult | HistoryResult | StressSurvey,
    path: str | Path,
    *,
    scalars: Iterable[Labelled] = (),
    overwrite: bool = False,
) -> None:
    """Write the numbers of ``result`` to ``path`` as a table, SI, exact.

    Of a contact: scalars, further ``scalars`` such as those of an outcome, certificate and status, with the columns name, value,
    unit, label. Of a load path: one row a step, with its number, whether it converged, scalars and energies. Of stresses: the
    maxima of layers and interfaces with their places, and the load factors.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    rows: Iterable[Any]
    if isinstance(result, HistoryResult):
        rows = _step_table(result)
    else:
        rows = _stress_table(result) if isinstance(result, StressSurvey) else _table(result, scalars)
    write_table(rows, path, overwrite=overwrite)


def _table(result: ContactResult, scalars: Iterable[Labelled]) -> Iterator[tuple[Any, ...]]:
    yield ("name", "value", "unit", "label")
    known = [Labelled(q, getattr(result, q.name)) for q in SCALARS]
    known += [Labelled(q, getattr(answer, q.name)) for answer in result.answers for q in answer.quantities]
    known += [Labelled(q, value) for q, value in _shear(result)]
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
    names += [f"{item.name} ({item.unit})" for item, _ in _shear(path.last)]
    columns = _columns(path)
    names += [f"{name} ({item.unit})" for _, name, item in columns]
    yield ("step", "converged", *names, *(f"path_{item.name} ({item.unit})" for item in ENERGIES))
    for number, result in enumerate(path.steps):
        energies = [float(getattr(balance, item.name)[number]) for item in ENERGIES]
        shear: list[Any] = [value for _, value in _shear(result)]
        shear += [getattr(result.couplings.get(coupling), item.name, "") for coupling, _, item in columns]
        yield (number + 1, result.converged, *(getattr(result, item.name) for item in SCALARS), *shear, *energies)


def _columns(path: HistoryResult) -> list[tuple[str, str, Quantity]]:
    """Coupling, name and quantity of each number that what couplings find has in tables; a name that two have is that of the first."""
    found: dict[str, tuple[str, str, Quantity]] = {}
    for coupling, answer in path.last.couplings.items():
        for item in answer.quantities if isinstance(answer, Answer) else ():
            name = f"{coupling}_{item.name}" if item.name in found else item.name
            found[name] = coupling, name, item
    return list(found.values())


def _shear(result: ContactResult) -> list[tuple[Quantity, float]]:
    """Scalars of stick and slip, if the result has any."""
    if result.stick_slip is None:
        return []
    numbers = shear_numbers(result)
    return [(item, numbers[item.name]) for item in SHEAR_SCALARS]


def _stress_table(survey: StressSurvey) -> Iterator[tuple[Any, ...]]:
    """Maxima, interface tractions and load factors, one row each; x and y in the middle of a pixel, as in figures."""
    yield ("part", "name", "top", "bottom", "quantity", "value", "unit", "x", "y", "depth", "side", "error", "doubt")
    grid, root = survey.result.problem.grid, math.sqrt(1.0 / 3.0)

    def at(peak: Peak) -> tuple[Any, ...]:
        x, y = (place + 0.5 * step for place, step in zip((peak.x, peak.y), grid.spacing, strict=True))
        return peak.value, "Pa", x, y, peak.depth, peak.side, peak.error, peak.doubt

    for part in survey.maxima:
        region = ("layer", part.region.name, part.region.top, part.region.bottom)
        yield (*region, "max_von_mises", *at(part.von_mises))
        yield (
            *region,
            "max_sqrt_J2",
            *at(replace(part.von_mises, value=root * part.von_mises.value, error=root * part.von_mises.error)),
        )
        yield (*region, "max_principal", *at(part.tension))
        yield (*region, "max_shear", *at(part.shear))
    for name, peak in survey.whole.items():
        yield ("body", "", "", "", f"max_{name}", *at(peak))
    for item in survey.interfaces:
        pair = ("interface", f"{item.above}/{item.below}", item.shear.depth, item.shear.depth)
        yield (*pair, "max_shear", *at(item.shear))
        yield (*pair, "max_peel", *at(item.peel))
    for state in survey.yielding.regions:
        region = ("layer", state.region.name, state.region.top, state.region.bottom)
        place = (*at(state.peak)[2:6], state.load_factor_error, state.peak.doubt)
        yield (*region, "yield_stress", state.limit.value, "Pa", "", "", "", "", "", "")
        yield (*region, "load_factor_to_yield", state.load_factor, "1", *place)
        yield (*region, "yielded_volume", state.yielded_volume, "m**3", "", "", "", "", "", "")


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


def export_stress_vtk(fields: Fields, path: str | Path, *, overwrite: bool = False) -> None:
    """Write a stress field, or its planes as they come from ``stress_planes``, to ``path`` (.vtr), lengths in m.

    Point data: the components, von Mises stress, and the number of the region; z is the depth, and the two planes of an
    interface share theirs. Only one plane is in memory at a time.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    InputError
        If there are no planes, or the field is a depth profile, which is no grid.
    """
    first, planes = peeked(fields)
    if first.dims == ("plane",):
        raise InputError(
            "stress field for VTK must be a section or whole planes, but is a depth profile; use save_stress."
        )
    with atomic_file(path, overwrite=overwrite) as partial, ExitStack() as stack:
        parts: dict[str, IO[bytes]] = {}
        kinds: dict[str, np.dtype[Any]] = {}
        depths = []
        for field in planes:
            depths.append(field.planes[0].depth)
            for name, values in _point_data(field):
                if name not in parts:
                    parts[name] = stack.enter_context(tempfile.TemporaryFile(dir=partial.parent))
                    kinds[name] = values.dtype
                # x runs fastest in VTK
                parts[name].write(np.ascontiguousarray(values.T).astype(values.dtype.newbyteorder("<")).tobytes())
        with partial.open("wb") as file:
            _write(file, first, depths, parts, kinds)


def _point_data(field: StressField) -> Iterator[tuple[str, np.ndarray[Any, Any]]]:
    yield from components(field).items()
    yield "von_mises", field.von_mises[0]
    shape = field.tensor.xx.shape[1:]
    yield "region", np.full(shape, field.planes[0].region.index, np.uint8)


def _write(
    file: IO[bytes],
    first: StressField,
    depths: list[float],
    parts: dict[str, IO[bytes]],
    kinds: dict[str, np.dtype[Any]],
) -> None:
    """Header with the place of every array, then the arrays themselves, raw, each after its length."""
    lines = {"x": np.atleast_1d(first.x), "y": np.atleast_1d(first.y), "z": np.array(depths)}
    extent = '"' + " ".join(f"0 {line.size - 1}" for line in lines.values()) + '"'
    offset = 0

    def entry(name: str, kind: str, size: int) -> str:
        nonlocal offset
        text = f'<DataArray type="{kind}" Name={quoteattr(name)} format="appended" offset="{offset}"/>\n'
        offset += 8 + size
        return text

    header = '<?xml version="1.0"?>\n'
    header += '<VTKFile type="RectilinearGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
    header += f"<RectilinearGrid WholeExtent={extent}>\n<Piece Extent={extent}>\n"
    header += '<PointData Scalars="von_mises">\n'
    header += "".join(entry(name, VTK_TYPES[kinds[name].name], part.tell()) for name, part in parts.items())
    header += "</PointData>\n<Coordinates>\n"
    header += "".join(entry(axis, "Float64", 8 * line.size) for axis, line in lines.items())
    header += '</Coordinates>\n</Piece>\n</RectilinearGrid>\n<AppendedData encoding="raw">\n_'
    file.write(header.encode("ascii"))
    for part in parts.values():
        file.write(np.uint64(part.tell()).astype("<u8").tobytes())
        part.seek(0)
        shutil.copyfileobj(part, file)
    for line in lines.values():
        file.write(np.uint64(8 * line.size).astype("<u8").tobytes() + line.astype("<f8").tobytes())
    file.write(b"\n</AppendedData>\n</VTKFile>\n")
