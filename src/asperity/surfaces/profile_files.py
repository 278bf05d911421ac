"""Line scans in files: columns of text, and the stylus formats of the reader library."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..core.citations import Origin
from ..core.errors import FileFormatError, InputError, UnitError
from ..core.status import Advice
from ..core.units import unit_factor
from .prepare.level import value_findings
from .profile import Instrument, Profile
from .reader_library import ANY, Family, height_doubt, lateral_doubt, scale_finding
from .text_points import LineScan

_KINDS = {"contact-based": "stylus", "microscope-based": "optical"}  # words of the reader library


@dataclass(frozen=True)
class Units:
    """Units of ``height`` and along a line (``lateral``) that the caller gives, as text, None for
    what is not given."""

    height: str | None
    lateral: str | None


def profile_of_text(file: Path, scan: LineScan, understood: str, given: Units) -> Profile:
    """Profile of the line ``scan`` that a text holds, in the units that it states or that are
    ``given``; the history says how the text was ``understood``.

    Raises FileFormatError if a unit is missing or contradicts the one in the file, or the points
    are no line scan, UnitError if one is no unit of length.
    """
    if not ((scan.x_unit or given.lateral) and (scan.z_unit or given.height)):
        stated = scan.x_unit or scan.z_unit
        lacking = "their units" if not stated else "the unit of its heights" if scan.x_unit else "the unit of x"
        asked = [
            name
            for name, unit in (("{give_lateral_unit}", scan.x_unit), ("{give_height_unit}", scan.z_unit))
            if not unit
        ]
        raise FileFormatError(
            f"file {file} has two columns and does not state {lacking}: give {' and '.join(asked)} for a line scan of "
            f"{len(scan.x)} points x z with x from {scan.x.min():g} to {scan.x.max():g}, or {{give_size}} and "
            "{give_height_unit} for a map two points wide ({axes}: none).",
            subject=f"units of file {file}",
        )
    origin = Origin(file.name, "heights", history=(f"read: line scan in {file.name}; points x z, {understood}",))
    return _made(file, scan, given, ANY, origin)


def profile_of_reader(
    file: Path, scan: LineScan, given: Units, family: Family, origin: Origin, topography: Any
) -> Profile:
    """Profile of the line ``scan`` that the reader library has read as ``topography`` with an
    instrument of that ``family``.

    Raises FileFormatError as :func:`profile_of_text` does.
    """
    what = f"line scan {origin.channel!r} of file {file}"
    asked = [
        name
        for name, units in (
            ("{give_lateral_unit}", (scan.x_unit, given.lateral)),
            ("{give_height_unit}", (scan.z_unit, given.height)),
        )
        if not any(units)
    ]
    if asked:
        raise FileFormatError(
            f"{what} does not state its units: give {' and '.join(asked)}.", subject=f"units of file {file}"
        )
    more = {"periodic": bool(topography.is_periodic), "instrument": _instrument(dict(topography.info))}
    return _made(file, scan, given, family, origin, **more)


class _Unit(NamedTuple):
    """``metres`` per unit, and ``words`` on the one that was given instead of the one in the file,
    or that the caller gave; ``doubt`` why the one in the file cannot be right."""

    metres: float
    words: str
    doubt: str


def _made(file: Path, scan: LineScan, given: Units, family: Family, origin: Origin, **more: Any) -> Profile:
    """Profile of ``scan``, with what is doubtful in it among the findings of its ``origin``."""
    n, what = len(scan.x), f"line scan {origin.channel!r} of file {file}"
    extent = float(np.ptp(scan.x)) * n / max(n - 1, 1)

    def along(metres: float) -> str:
        return lateral_doubt(family, (extent * metres,), (n,)) if math.isfinite(extent) and extent > 0.0 else ""

    def across(metres: float) -> str:
        return height_doubt(family, scan.z * metres)

    x = _unit(file, what, "lateral_unit", scan.x_unit, given.lateral, along)
    z = _unit(file, what, "height_unit", scan.z_unit, given.height, across)
    doubts = [scale_finding(x.doubt, z.doubt, line=True)] if x.doubt or z.doubt else list[Advice]()
    findings = (*doubts, *value_findings(scan.z[:, None], scan.z_unit or str(given.height)))
    first = f"{origin.history[0]}; x in {x.words}, heights in {z.words}"
    found = replace(origin, history=(first,), findings=findings)
    try:
        return Profile.from_points(scan.x * x.metres, scan.z * z.metres, origin=found, **more)
    except InputError as exc:
        raise FileFormatError(f"file {file} does not hold a usable line scan: {exc}", subject=exc.subject) from exc


def _unit(file: Path, what: str, name: str, stated: str, given: str | None, doubt: Callable[[float], str]) -> _Unit:
    """The unit that is ``stated`` in a file or ``given`` as the argument ``name``.

    Raises FileFormatError if both are there, differ, and there is no ``doubt`` of the one in the
    file, or if that is no length.
    """
    of = {"lateral_unit": "along it", "height_unit": "of its heights"}[name]
    if not stated:
        return _Unit(unit_factor(str(given), "length", name), str(given), "")
    try:
        metres = unit_factor(stated, "length", name)
    except UnitError as exc:
        raise FileFormatError(
            f"{what} must hold heights, but its unit is {stated}. Choose another channel ({{channel}})."
        ) from exc
    found = doubt(metres)
    if given is None:
        return _Unit(metres, stated, found)
    other = unit_factor(given, "length", name)
    if other == metres:
        return _Unit(metres, stated, "")
    if not found:
        raise FileFormatError(
            f"{what} states {stated} as the unit {of}, but {given} is given: leave out {{{name}}}, or give the same.",
            subject=f"units of file {file}",
        )
    return _Unit(other, f"{given} as given, the file states {stated}", "")


def _instrument(info: Mapping[str, Any]) -> Instrument:
    """What the file states of its instrument."""
    stated = info.get("instrument", {})
    stated = stated if isinstance(stated, Mapping) else dict(stated)
    known = stated.get("parameters") or {}
    known = known if isinstance(known, Mapping) else dict(known)
    lengths = {}
    for name in ("tip_radius", "resolution"):
        value = known.get(name)
        value = value if isinstance(value, Mapping) or value is None else dict(value)
        try:
            lengths[name] = (
                float(value["value"]) * unit_factor(str(value["unit"]), "length", name) if value else math.nan
            )
        except (KeyError, TypeError, ValueError, UnitError):
            lengths[name] = math.nan
        if not lengths[name] > 0.0:
            lengths[name] = math.nan
    kind = str(stated.get("type") or "")
    kind = _KINDS.get(kind, kind) or ("stylus" if lengths["tip_radius"] > 0.0 else "")
    return Instrument(kind, **lengths)
