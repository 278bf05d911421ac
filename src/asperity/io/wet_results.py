"""Wet contacts in result files: the menisci beside the fields of the contact, and back."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..contact.wet_result import WET_SCALARS, WetContactResult
from ..contact.wetting import LiquidFilm, wetting
from ..core.errors import FileFormatError
from ..core.status import Outcome, Status
from .description import describe, rebuild
from .results import dataset as contact_dataset
from .results import load, open_dataset, write

if TYPE_CHECKING:
    import xarray

_STORED = ("external_force", "meniscus_force", "dry_friction", "viscous_force", "rounds", "change", "feedback")
"""Numbers of a result that do not follow from contact and film."""


def wet_dataset(result: WetContactResult, *, document: str | None = None) -> xarray.Dataset:
    """Dataset of the contact of ``result`` (see ``open_dataset``) with its menisci, forces and film.

    Variables ``menisci`` and ``wetted`` (x, y), and one scalar for each of ``WET_SCALARS``; film, numbers of the
    repeated solution and status are attributes that begin with ``wet_``.

    Raises
    ------
    InputError
        If the problem holds a type that files do not know.
    """
    data = contact_dataset(result.contact, document=document)
    for name, label in (
        ("menisci", "whether a meniscus bridges the gap"),
        ("wetted", "whether the gap is in the film"),
    ):
        data[name] = ("x", "y"), getattr(result.wetting, name), {"units": "1", "long_name": label}
    for item in WET_SCALARS:
        data[item.name] = (), getattr(result, item.name), item.attributes
    attributes: dict[str, Any] = {f"wet_{name}": getattr(result, name) for name in _STORED}
    attributes |= {
        "wet_film": json.dumps(describe(result.film)),
        "wet_control": json.dumps(describe(result.control)),
        "wet_regime": result.wetting.regime,
        "wet_outcome": str(result.status.outcome),
        "wet_message": result.status.message,
        "wet_remedy": result.status.remedy,
        "citation_keys": " ".join(result.citation_keys),
    }
    return data.assign_attrs(attributes)


def save_wet(
    result: WetContactResult, path: str | Path, *, document: str | None = None, overwrite: bool = False
) -> None:
    """Write ``result`` to the NetCDF-4 file ``path``, which ``load`` reads as a contact and ``load_wet`` as a whole.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    InputError
        If the problem holds a type that files do not know.
    """
    write(wet_dataset(result, document=document), path, overwrite=overwrite)


def is_wet(path: str | Path) -> bool:
    """Whether the result file ``path`` holds a contact with a film of liquid.

    Raises
    ------
    FileFormatError
        If it is no result file.
    """
    return "wet_film" in open_dataset(path).attrs


def load_wet(path: str | Path) -> WetContactResult:
    """The wet contact in the file ``path``, equal to the one that was saved.

    Raises
    ------
    FileFormatError
        If the file is missing, damaged, or holds no wet contact.
    """
    contact, attributes = load(path), open_dataset(path).attrs
    if "wet_film" not in attributes:
        raise FileFormatError(f"result file must hold a wet contact, but {path} holds a dry one; use load.")
    film = rebuild(json.loads(attributes["wet_film"]))
    if not isinstance(film, LiquidFilm):
        raise FileFormatError(f"result file must describe its film, but {path} does not.")
    numbers = {name: float(attributes[f"wet_{name}"]) for name in _STORED if name != "rounds"}
    return WetContactResult(
        control=rebuild(json.loads(attributes["wet_control"])),
        contact=contact,
        film=film,
        wetting=wetting(contact.gap, contact.contact, film, wraps=contact.problem.boundary.wraps),
        rounds=int(attributes["wet_rounds"]),
        status=Status(Outcome(attributes["wet_outcome"]), attributes["wet_message"], attributes["wet_remedy"]),
        **numbers,
    )
