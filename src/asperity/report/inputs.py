"""Surfaces, bodies, law and load in words for a table: label and text with units."""

from __future__ import annotations

import math
from dataclasses import fields, is_dataclass
from typing import TypeAlias

import numpy as np

from ..contact.result import ContactResult
from ..core.units import show
from ..surfaces.characterise.heights import peak_to_valley, rms_height
from ..surfaces.surface import Surface

Rows: TypeAlias = list[tuple[str, str]]
"""Label and text of each row of a table."""

TERMS = {
    "youngs_modulus": ("Young's modulus E", "Pa"),
    "poisson_ratio": ("Poisson's ratio ν", "1"),
    "hardness": ("hardness H", "Pa"),
    "yield_stress": ("yield stress", "Pa"),
    "thickness": ("thickness", "m"),
}
"""Label and SI unit of the fields of bodies; a field that is not listed is shown by its name."""


def surface_rows(surface: object) -> Rows:
    """What the ``surface`` is, where it comes from and what was done to it."""
    if not isinstance(surface, Surface):
        return [("shape", "perfectly flat")]
    origin, (nx, ny), (width, height) = surface.origin, surface.shape, surface.size
    rows = [
        ("source", origin.source or "given as an array"),
        ("channel", origin.channel),
        ("size", f"{show(width, 'm')} × {show(height, 'm')}"),
        ("points", f"{nx} × {ny}"),
        ("pixel", f"{show(surface.dx, 'm')} × {show(surface.dy, 'm')}"),
        ("rms height", show(rms_height(surface), "m")),
        ("peak to valley", show(peak_to_valley(surface), "m")),
        ("periodic", "yes" if surface.periodic else "no"),
        *((f"step {number}", step) for number, step in enumerate(origin.history, start=1)),
        *((str(key), str(value)) for key, value in origin.instrument.items()),
    ]
    return [row for row in rows if row[1]]


def body_rows(body: object) -> Rows:
    """Elastic constants and strength of ``body``, with the sources of the values; layers one after another."""
    kind, name = type(body).__name__.lower(), str(getattr(body, "name", ""))
    rows: Rows = [("material" if name not in ("", kind) else "kind", name or kind)]
    sources: Rows = []
    for field in fields(body) if is_dataclass(body) else ():
        value = getattr(body, field.name)
        if field.name == "name":
            continue
        if field.name == "sources":
            sources += [_source_row(str(source)) for source in value]
        elif isinstance(value, tuple):
            for number, part in enumerate(value, start=1):
                rows += _prefixed(f"{field.name} {number}", part)
        elif is_dataclass(value):
            rows += body_rows(value)[1:] if field.name == "strength" else _prefixed(field.name, value)
        else:
            rows += _value_row(field.name, value)
    return rows + sources


def setting_rows(result: ContactResult) -> Rows:
    """Boundary, law and load of ``result``."""
    problem, control = result.problem, result.control
    cap = problem.law.pressure_cap()
    hardness = cap if isinstance(cap, np.ndarray) else np.array([cap])
    rows = [("boundary", problem.boundary.name), ("interface law", problem.law.name)]
    if np.isfinite(hardness).all():
        low, high = show(float(hardness.min()), "Pa"), show(float(hardness.max()), "Pa")
        rows.append(("pressure limit", low if low == high else f"{low} to {high}, by point"))
    rows.append(("contact modulus E*", show(problem.contact_modulus, "Pa")))
    rows.append((f"prescribed {control.name}", show(control.value, control.unit)))
    return rows


def _prefixed(prefix: str, part: object) -> Rows:
    return [(f"{prefix}: {label}", text) for label, text in body_rows(part)]


def _source_row(source: str) -> tuple[str, str]:
    """``"youngs_modulus: handbook"`` names the value that it is the source of; any other text stands alone."""
    key, _, text = source.partition(": ")
    return (f"source of {TERMS[key][0]}", text) if key in TERMS else ("source", source)


def _value_row(name: str, value: object) -> Rows:
    """The row of a number or text; nothing where it is empty or not known."""
    label, unit = TERMS.get(name, (name.replace("_", " "), "1"))
    if isinstance(value, float | int) and not isinstance(value, bool):
        return [] if math.isnan(value) else [(label, show(float(value), unit))]
    return [(label, str(value))] if str(value) else []
