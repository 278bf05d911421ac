"""A result as one labelled NetCDF-4 file: written whole, read back exactly."""

from __future__ import annotations

import json
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..contact.certificate import Certificate
from ..contact.couplings.menisci import Menisci
from ..contact.couplings.sliding import GrossSliding
from ..contact.problem import ContactProblem
from ..contact.result import ContactResult
from ..contact.wetting import wetting
from ..core.arrays import BoolArray, RealArray, array_digest
from ..core.errors import FileFormatError
from ..core.status import Outcome, Status
from ..surfaces.surface import Origin, Surface
from .atomic import atomic_file
from .description import describe, rebuild
from .provenance import provenance, surface_provenance
from .words import ALL_SCALARS, FIELDS

if TYPE_CHECKING:
    import xarray

FORMAT_VERSION = 1
"""Version of the layout of result files; raised whenever an older asperity could misread a newer file."""

PARTS = ("body", "counter_body", "boundary", "law", "control")
"""Attributes that describe problem and control, each a JSON text."""

PHYSICS = ("film", "friction")
"""The same for physics that a problem need not have."""

_LATER = ("couplings", "rounds")
"""Entries of the certificate that older files lack, written as JSON texts."""

_MENISCI = ("external_force", "meniscus_force", "dry_friction", "viscous_force", "feedback")
"""Numbers of the menisci that do not follow from contact and film."""


def dataset(result: ContactResult, *, document: str | None = None) -> xarray.Dataset:
    """Dataset of ``result`` with dimensions x, y (m) and spot, units and labels on every variable.

    Scalars are 0-d variables; bodies, boundary, law, control, certificate, status, provenance, citation keys and the
    text of the problem ``document`` are attributes.

    Raises
    ------
    InputError
        If the problem holds a type that files do not know.
    """
    arrays: dict[str, RealArray] = {}
    owners = {"control": result} | dict.fromkeys(PARTS[:4], result.problem)
    parts = {part: json.dumps(describe(getattr(owners[part], part), arrays, part)) for part in PARTS}
    attributes = _attributes(result) | parts | ({} if document is None else {"document": document})
    return _labelled(result, arrays).assign_attrs(attributes)


def save(result: ContactResult, path: str | Path, *, document: str | None = None, overwrite: bool = False) -> None:
    """Write ``result``, and the text of the problem ``document`` it came from, to the NetCDF-4 file ``path``.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    InputError
        If the problem holds a type that files do not know.
    """
    write(dataset(result, document=document), path, overwrite=overwrite)


def write(data: xarray.Dataset, path: str | Path, *, overwrite: bool = False) -> None:
    """Write ``data`` as ``dataset`` or ``wet_dataset`` made it to ``path``; errors as for ``save``."""
    encoding: dict[str, dict[str, Any]] = {str(name): {"_FillValue": None} for name in data.variables}
    sparse = ("pressure", "permanent_indentation", "contact", "plastic", "menisci", "wetted")
    for name in (name for name in sparse if name in data):  # mostly zero, so packing costs little and saves much
        encoding[name] |= {"zlib": True, "complevel": 1, "shuffle": True}
    with atomic_file(path, overwrite=overwrite) as partial:
        data.to_netcdf(partial, engine="h5netcdf", encoding=encoding)


def open_dataset(path: str | Path) -> xarray.Dataset:
    """The result file ``path`` as an ``xarray.Dataset`` in memory, for analysis.

    Raises
    ------
    FileFormatError
        If the file is missing, damaged, not NetCDF-4, not a result of asperity, or of a newer format.
    """
    import xarray

    if Path(path).exists() and not Path(path).is_file():
        raise FileFormatError(f"result file must be a file, but {path} is a folder or device; give the .nc file in it.")
    if not Path(path).is_file():
        raise FileFormatError(f"result file must exist, but {path} does not; check the path.")
    try:
        data = xarray.load_dataset(path, engine="h5netcdf", decode_times=False)
    except MemoryError:
        raise
    except Exception as error:  # the readers below raise many types on foreign or damaged bytes
        raise FileFormatError(
            f"result file must be a whole NetCDF-4 file, but {path} is not ({error}). Was the copy interrupted?"
        ) from error
    version = data.attrs.get("asperity_format")
    if not isinstance(version, int | np.integer):
        raise FileFormatError(f"result file must be written by asperity, but {path} is another NetCDF-4 file.")
    if version > FORMAT_VERSION:
        raise FileFormatError(
            f"result file must be of format {FORMAT_VERSION} or older, but {path} is of {version}; update asperity."
        )
    return data


def load(path: str | Path) -> ContactResult:
    """The result in the file ``path``, equal to the one that was saved: same fields to the bit, same problem.

    Raises
    ------
    FileFormatError
        If the file is missing, damaged, not NetCDF-4, not a result of asperity, or of a newer format.
    """
    data = open_dataset(path)
    try:
        return _result(data)
    except FileFormatError:
        raise
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise FileFormatError(f"result file must hold a whole result, but {path} lacks or garbles {error}.") from error


def document_in(path: str | Path) -> str | None:
    """Text of the problem document in the result file ``path``, None if it was saved without one.

    Raises
    ------
    FileFormatError
        If the file is missing or no NetCDF-4 file.
    """
    import h5netcdf

    try:
        with h5netcdf.File(path, "r") as file:
            text = file.attrs.get("document")
    except OSError as error:
        raise FileFormatError(f"result file must be a whole NetCDF-4 file, but {path} is not ({error}).") from error
    return None if text is None else str(text)


def _result(data: xarray.Dataset) -> ContactResult:
    attributes = data.attrs
    arrays = {str(name): np.asarray(variable) for name, variable in data.data_vars.items() if variable.ndim == 2}
    parts = {part: rebuild(json.loads(attributes[part]), arrays) for part in PARTS}
    control = parts.pop("control")
    surface = _surface(arrays["heights"], attributes["surface"])
    if "counter_heights" in arrays:
        parts["counter_surface"] = _surface(arrays["counter_heights"], attributes["counter_surface"])
    parts |= {part: rebuild(json.loads(attributes[part])) for part in PHYSICS if part in attributes}
    problem = ContactProblem(surface=surface, **parts)
    certificate = {
        f.name: _plain(attributes[f"certificate_{f.name}"]) for f in fields(Certificate) if f.name not in _LATER
    }
    certificate |= {
        name: rebuild(json.loads(attributes[f"certificate_{name}"]))
        for name in _LATER
        if f"certificate_{name}" in attributes
    }
    certificate["couplings"] = tuple(certificate.get("couplings", ()))
    values: dict[str, Any] = {item.name: arrays[item.name] for item in FIELDS}
    values |= {item.name: data[item.name].item() for item in ALL_SCALARS}
    return ContactResult(
        problem=problem,
        control=control,
        plastic=arrays["plastic"].astype(bool),
        spot_areas=np.asarray(data["spot_areas"]),
        certificate=Certificate(**certificate),
        status=Status(Outcome(attributes["status_outcome"]), attributes["status_message"], attributes["status_remedy"]),
        citation_keys=tuple(attributes["citation_keys"].split()),
        couplings=_couplings(problem, arrays, values["gap"], values["pressure"] > 0.0, attributes),
        memory=_memories(attributes),
        **values,
    )


def _couplings(
    problem: ContactProblem, arrays: dict[str, Any], gap: RealArray, contact: BoolArray, attributes: dict[str, Any]
) -> dict[str, Any]:
    """What the couplings found, from the fields and what ``_physics`` wrote."""
    found: dict[str, Any] = {}
    if problem.film is not None and "menisci" in attributes:
        stands = wetting(gap, contact, problem.film, wraps=problem.boundary.wraps)
        found["menisci"] = Menisci(problem.film, stands, **rebuild(json.loads(attributes["menisci"])))
    if problem.friction is not None and "shear_displacement" in arrays:
        friction = problem.friction
        found["sliding"] = GrossSliding(friction.coefficient, friction.direction, arrays["shear_displacement"])
    return found


def _memories(attributes: dict[str, Any]) -> dict[str, dict[str, RealArray]]:
    described = json.loads(attributes.get("memory", "{}"))
    return {name: {key: np.asarray(value) for key, value in item.items()} for name, item in described.items()}


def _labelled(result: ContactResult, arrays: dict[str, RealArray]) -> xarray.Dataset:
    """Fields, scalars, coordinates and the ``arrays`` of the law (Pa), each with unit and label."""
    import xarray

    problem = result.problem
    variables: dict[str, Any] = {"heights": _field(problem.surface.heights, "m", "heights of the surface")}
    if isinstance(problem.counter_surface, Surface):
        heights = problem.counter_surface.heights
        variables["counter_heights"] = _field(heights, "m", "heights of the counter surface")
    for item in FIELDS:
        variables[item.name] = _field(getattr(result, item.name), item.unit, item.label)
    if result.sliding is not None:
        lift = result.sliding.shear_displacement
        variables["shear_displacement"] = _field(lift, "m", "normal displacement by shear")
    variables["contact"] = _field(result.contact, "1", "whether the bodies touch")
    variables["plastic"] = _field(result.plastic, "1", "whether the pressure is at its limit")
    variables["spot_areas"] = ("spot", result.spot_areas, _labels("m**2", "areas of the contact spots"))
    for item in ALL_SCALARS:
        variables[item.name] = ((), getattr(result, item.name), _labels(item.unit, item.label))
    variables |= {name: _field(values, "Pa", "hardness") for name, values in arrays.items()}
    x, y = problem.grid.coordinates()
    coordinates = {
        "x": ("x", x[:, 0], _labels("m", "position along x")),
        "y": ("y", y[0], _labels("m", "position along y")),
    }
    return xarray.Dataset(variables, coordinates)


def _attributes(result: ContactResult) -> dict[str, Any]:
    """Everything that is neither field nor scalar nor a part of the problem described elsewhere."""
    status, counter = result.status, result.problem.counter_surface
    described = {
        "title": "contact of rough surfaces",
        "asperity_format": FORMAT_VERSION,
        "surface": _surface_text(result.problem.surface),
        "status_outcome": str(status.outcome),
        "status_message": status.message,
        "status_remedy": status.remedy,
        "provenance": json.dumps(provenance(result)),
        "citation_keys": " ".join(result.citation_keys),
    }
    if isinstance(counter, Surface):
        described["counter_surface"] = _surface_text(counter)
    checks = {f"certificate_{f.name}": getattr(result.certificate, f.name) for f in fields(Certificate)}
    checks |= {f"certificate_{name}": json.dumps(describe(getattr(result.certificate, name))) for name in _LATER}
    return described | checks | _physics(result)


def _physics(result: ContactResult) -> dict[str, str]:
    """Film and friction of the problem, the numbers of the menisci, and what couplings remember, as JSON texts."""
    found: dict[str, Any] = {
        part: describe(value) for part in PHYSICS if (value := getattr(result.problem, part)) is not None
    }
    if result.menisci is not None:
        found["menisci"] = {name: describe(getattr(result.menisci, name)) for name in _MENISCI}
    if result.memory:
        found["memory"] = {
            name: {key: np.asarray(value).tolist() for key, value in memory.items()}
            for name, memory in result.memory.items()
        }
    return {name: json.dumps(item) for name, item in found.items()}


def _surface_text(surface: Surface) -> str:
    grid = {"dx": surface.dx, "dy": surface.dy, "periodic": surface.periodic}
    return json.dumps(grid | surface_provenance(surface))


def _surface(heights: np.ndarray[Any, Any], text: str) -> Surface:
    described = json.loads(text)
    if array_digest(heights) != described["digest"]:
        raise ValueError("heights: they do not match their digest")
    history, keys = tuple(described["history"]), tuple(described["citation_keys"])
    origin = Origin(described["source"], described["channel"], described["instrument"], history, keys)
    return Surface(heights, described["dx"], described["dy"], periodic=described["periodic"], origin=origin)


def _field(values: np.ndarray[Any, Any], unit: str, label: str) -> tuple[tuple[str, str], Any, dict[str, str]]:
    return ("x", "y"), values, _labels(unit, label)


def _labels(unit: str, label: str) -> dict[str, str]:
    return {"units": unit, "long_name": label}


def _plain(value: Any) -> Any:
    return value.item() if isinstance(value, np.generic | np.ndarray) else value
