"""Bodies in words: one line for a table, and rows of everything that is known of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import fields, is_dataclass
from itertools import groupby

from ..core.units import show
from ..solids.body import materials_of
from ..solids.elastic import Elastic
from ..solids.interface import Frictionless
from ..solids.layers import Layer, Layered
from .inputs import Rows

TERMS = {
    "youngs_modulus": ("Young's modulus E", "Pa"),
    "poisson_ratio": ("Poisson's ratio ν", "1"),
    "hardness": ("hardness H", "Pa"),
    "yield_stress": ("yield stress", "Pa"),
    "thickness": ("thickness", "m"),
}
"""Label and SI unit of the fields of bodies; a field that is not listed is shown by its name."""


def body_text(body: object) -> str:
    """What ``body`` is in one line: its layers from the surface down, or its name and constants."""
    if isinstance(body, Layered):
        parts = [_short(group) for group in _alike(body.layers)]
        return " / ".join([*parts, material_name(body.base) if isinstance(body.base, Elastic) else body.base.name])
    return _material_text(body) if isinstance(body, Elastic) else "rigid"


def body_rows(body: object) -> Rows:
    """Elastic constants and strength of ``body``, with the sources of the values; layers one after another."""
    return _layered_rows(body) if isinstance(body, Layered) else _rows(body)


def _layered_rows(body: Layered) -> Rows:
    rows: Rows = [("name", body.name)] if body.name else []
    first = 1
    for group in _alike(body.layers):
        last = first + len(group) - 1
        label = f"layer {first}" if len(group) == 1 else f"layers {first} to {last}"
        joined = "slips without friction on what is below" if _slips(group) else "bonded to what is below"
        rows.append((label, f"{_group_text(group)}; {joined}"))
        first = last + 1
    rows.append(("base", _material_text(body.base) if isinstance(body.base, Elastic) else body.base.name))
    seen = dict.fromkeys((material.name, source) for material in materials_of(body) for source in material.sources)
    return rows + [
        (f"{label} ({name})" if name else label, text)
        for name, source in seen
        for label, text in [_source_row(source)]
        if name or text != "user"
    ]


def _alike(layers: Sequence[Layer]) -> list[list[Layer]]:
    """Runs of layers of one name, as those of a graded coating are; any other layer is alone."""
    numbered = enumerate(layers)
    runs = groupby(numbered, key=lambda item: item[1].material.name or item[0])
    return [[layer for _, layer in run] for _, run in runs]


def _slips(group: list[Layer]) -> bool:
    return isinstance(group[-1].interface, Frictionless)


def _short(group: list[Layer]) -> str:
    thickness = sum(layer.thickness for layer in group)
    count = f" in {len(group)} layers" if len(group) > 1 else ""
    return f"{material_name(group[0].material)} {show(thickness, 'm')}{count}{' (slips)' if _slips(group) else ''}"


def _group_text(group: list[Layer]) -> str:
    first, last = group[0], group[-1]
    if len(group) == 1:
        return f"{show(first.thickness, 'm')} of {_material_text(first.material)}"
    thickness = sum(layer.thickness for layer in group)
    moduli = f"E = {show(first.material.youngs_modulus, 'Pa')} … {show(last.material.youngs_modulus, 'Pa')}"
    return f"{show(thickness, 'm')} of {first.material.name} in {len(group)} layers: {moduli}"


def material_name(material: Elastic) -> str:
    """Name of ``material``, or its constants where it has none."""
    return material.name or f"({_material_text(material)})"


def _material_text(material: Elastic) -> str:
    strength = material.strength
    values = [("E", material.youngs_modulus), ("H", strength.hardness), ("Y", strength.yield_stress)]
    texts = [f"{symbol} = {show(value, 'Pa')}" for symbol, value in values if not math.isnan(value)]
    texts.insert(1, f"ν = {material.poisson_ratio:g}")
    constants = ", ".join(texts)
    return f"{material.name}: {constants}" if material.name else constants


def _rows(body: object) -> Rows:
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
            rows += _rows(value)[1:] if field.name == "strength" else _prefixed(field.name, value)
        else:
            rows += _value_row(field.name, value)
    return rows + sources


def _prefixed(prefix: str, part: object) -> Rows:
    return [(f"{prefix}: {label}", text) for label, text in _rows(part)]


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
