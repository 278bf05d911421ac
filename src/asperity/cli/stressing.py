"""Options for the stresses inside a body, and the table of the document they stand for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Annotated, Any

from ..core.errors import InputError
from .panel import options_of

STRESS = "Stresses inside the body"

_option = options_of(STRESS)


@dataclass(frozen=True)
class StressOptions:
    """Which stresses are wanted; none unless one of these is given."""

    friction: Annotated[
        float | None, _option("--friction", "Shear traction over pressure of a sliding contact: 0.3.", "NUMBER")
    ] = None
    direction: Annotated[
        str | None, _option("--direction", "Of the shear traction on the body, from x towards y: 90deg.", "ANGLE")
    ] = None
    coupled: Annotated[bool, _option("--coupled", "Let the shear traction change the pressure.")] = False
    stress_in: Annotated[str | None, _option("--stress-in", "body (default) or counter.", "BODY")] = None
    depths: Annotated[str | None, _option("--depths", "Whole planes: 1nm,5nm,20nm.", "LENGTH,…")] = None
    section: Annotated[
        list[str] | None,
        _option(
            "--section",
            "Vertical plane through each maximum: y=max; x=30nm, y=pressure. May be repeated.",
            "AXIS=PLACE",
        ),
    ] = None
    profile: Annotated[
        list[str] | None,
        _option("--profile", "Line into the body: x=max,y=max; x=30nm,y=pressure. May be repeated.", "x=PLACE,y=PLACE"),
    ] = None
    deepest: Annotated[
        str | None, _option("--deepest", "End of sections and profiles; suits the contact by default.", "LENGTH")
    ] = None
    criterion: Annotated[str | None, _option("--criterion", "Of yield: von_mises (default) or tresca.")] = None
    tensile_strength: Annotated[
        str | None, _option("--tensile-strength", "To compare the largest tension with.", "PRESSURE")
    ] = None
    interface_shear_strength: Annotated[
        str | None, _option("--interface-shear-strength", "To compare the shear of interfaces with.", "PRESSURE")
    ] = None
    interface_peel_strength: Annotated[
        str | None, _option("--interface-peel-strength", "To compare the peel of interfaces with.", "PRESSURE")
    ] = None
    stress_precision: Annotated[str | None, _option("--stress-precision", "double (default) or single.")] = None


_KEYS = {"stress_in": "inside", "section": "sections", "profile": "profiles", "stress_precision": "precision"}


def with_stress(table: Mapping[str, Any], options: StressOptions, *, wanted: bool) -> dict[str, Any]:
    """``table`` of a document with the stresses that the ``options`` ask for, over those it asks for already.

    ``wanted`` says that stresses are to be computed even if no option asks for any.
    """
    given: dict[str, Any] = {}
    for field in fields(options):
        value = getattr(options, field.name)
        if value is not None and value is not False and value != []:
            given[_KEYS.get(field.name, field.name)] = value
    if "inside" in given:
        given["inside"] = _inside(given["inside"])
    if "depths" in given:
        given["depths"] = [part.strip() for part in given["depths"].split(",")]
    for key, option in (("sections", "--section"), ("profiles", "--profile")):
        if key in given:
            given[key] = [_positions(text, option) for text in given[key]]
    before = table.get("stress")
    if not given and not (wanted and before is None):
        return dict(table)
    return {**table, "stress": {**(before if isinstance(before, dict) else {}), **given}}


def stress_names(table: Mapping[str, Any]) -> dict[str, str]:
    """What the user calls the keys of the stresses in ``table``."""
    stress = table.get("stress")
    if not isinstance(stress, dict):
        return {}
    names = {f"stress.{_KEYS.get(f.name, f.name)}": f"--{f.name.replace('_', '-')}" for f in fields(StressOptions)}
    names |= {f"stress.depths[{n}]": f"part {n} of --depths" for n in range(1, len(stress.get("depths", ())) + 1)}
    for key, option in (("sections", "--section"), ("profiles", "--profile")):
        for number in range(1, len(stress.get(key, ())) + 1):
            names[f"stress.{key}[{number}]"] = option
            names |= {f"stress.{key}[{number}].{axis}": f"{axis} of {option}" for axis in "xy"}
    return names


def _inside(text: str) -> str:
    from ..core import require

    chosen = require.one_of(
        text.strip().casefold().replace("counter_body", "counter"), ("body", "counter"), "--stress-in"
    )
    return "counter_body" if chosen == "counter" else "body"


def _positions(text: str, option: str) -> dict[str, str]:
    from ..io.schemas.stress import positions_from_text

    try:
        return positions_from_text(text)
    except InputError as error:
        raise InputError(f"{option}{error}") from None
