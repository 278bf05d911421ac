"""A body in one line of text: ``rigid``, a material, its constants, or layers from the surface down and then the base.

DLC                               a material of the library
E=140GPa,nu=0.25,H=15GPa          elastic constants: E, nu, and if known hardness H, yield stress Y, name
DLC:5nm/Cr:2nm/steel              5 nm of DLC on 2 nm of Cr on steel
DLC:5nm~/rigid                    ~ : the layer slips without friction on what lies below it
"""

from __future__ import annotations

from types import MappingProxyType
from typing import Any

from ...core.errors import InputError

SYMBOLS = MappingProxyType(
    {"E": "youngs_modulus", "nu": "poisson_ratio", "H": "hardness", "Y": "yield_stress", "name": "name"}
)
"""Key of the document for each symbol in the text of a material."""

SLIP = "~"
"""Mark behind the thickness of a layer that slips on what lies below."""

EXAMPLE = '"DLC:5nm/Cr:2nm/steel"'


def body_from_text(text: str) -> dict[str, Any]:
    """Table of a body for the ``text``.

    Raises
    ------
    InputError
        If the text is none of the above; the message lacks the name of the option or key at its beginning.
    """
    if ":" not in text and ("=" in text or "/" not in text):  # a unit such as N/mm**2 may hold a slash
        return base_from_text(text)
    *layers, base = (part.strip() for part in text.split("/"))
    bare = [part for part in layers if part and ":" not in part]
    if ":" in base and bare:
        raise InputError(
            f" must have the base as its last part, but {bare[0]!r}, without thickness, stands before {base!r}; "
            f"write layers from the surface down, such as {EXAMPLE}."
        )
    if ":" in base:
        raise InputError(
            f' must end in the base, without thickness, such as {EXAMPLE} or "DLC:5nm/rigid", but ends in {base!r}.'
        )
    found = [_layer(part, number) for number, part in enumerate(layers, start=1)]
    if not base:
        raise InputError(f" must end in the base, such as {EXAMPLE}, but nothing stands behind the last slash.")
    return {"layers": found, "base": base_from_text(base)}


def _layer(part: str, number: int) -> dict[str, Any]:
    name, _, thickness = (piece.strip() for piece in part.partition(":"))
    if not name:
        found = repr(part) if part else "empty"
        raise InputError(f" must name a material in each part, such as {EXAMPLE}, but layer {number} is {found}.")
    if not thickness.rstrip(SLIP).strip():
        raise InputError(
            f" must give the thickness of every layer, such as {name.rstrip(SLIP)}:5nm, but layer {number} is {part!r}; "
            "only the last part, the base, has none."
        )
    if name.casefold() == "rigid":
        raise InputError(f" must have rigid as its last part only, but layer {number} is {part!r}.")
    slips = thickness.endswith(SLIP)
    if SLIP in name or SLIP in thickness[:-1]:
        raise InputError(
            f" must have {SLIP} behind the thickness of the layer that slips, such as DLC:5nm{SLIP}/steel, "
            f"but layer {number} is {part!r}."
        )
    joined = {"interface": "frictionless"} if slips else {}
    return {**material_from_text(name), "thickness": thickness.rstrip(SLIP).strip(), **joined}


def base_from_text(text: str) -> dict[str, Any]:
    """Table of a body without layers, or of what lies under them; errors as above."""
    return {"rigid": True} if text.strip().casefold() == "rigid" else material_from_text(text)


def material_from_text(text: str) -> dict[str, Any]:
    """Table of a material by its name or its constants; errors as above."""
    if "=" not in text:
        return {"material": text.strip()}
    return dict(_constant(part) for part in text.split(","))


def _constant(part: str) -> tuple[str, Any]:
    symbol, _, value = (piece.strip() for piece in part.partition("="))
    if symbol not in SYMBOLS:
        raise InputError(
            f' must be a material, constants such as "E=140GPa,nu=0.25,H=15GPa" ({", ".join(SYMBOLS)}), or layers such '
            f"as {EXAMPLE}, but holds {part.strip()!r}."
        )
    return SYMBOLS[symbol], _number(value) if symbol == "nu" else value


def _number(text: str) -> float | str:
    """The number, or the ``text`` that is none and that the schema refuses under its key."""
    try:
        return float(text)
    except ValueError:
        return text
