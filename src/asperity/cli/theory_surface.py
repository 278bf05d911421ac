"""Theories for a surface in a file and bodies by name: the numbers that they need, measured and looked up."""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..core.errors import InputError
from ..theories.protocol import Described
from .reading import level_of, read_surface

if TYPE_CHECKING:
    from .options import ReadingOptions

BODY_INPUTS = ("E_star", "hardness", "yield_stress", "nu")
"""Inputs that follow from the bodies."""


def of_bodies(kind: type[Described], given: dict[str, Any], body: str, counter: str | None) -> dict[str, Any]:
    """``given`` with what the bodies say of the inputs of ``kind`` that are not given; the weaker body yields.

    Raises
    ------
    InputError
        If a body is not understood, or its strength is needed and not known.
    """
    from ..io.build_body import body_of_text
    from ..solids.elastic import Rigid
    from ..solids.layers import contact_modulus, weaker_strength

    first = body_of_text(body, "--body")
    second = Rigid() if counter is None else body_of_text(counter, "--counter")
    known = {"E_star": contact_modulus(first, second)} | weaker_strength(first, second)
    for item in kind.inputs:
        if item.name in ("hardness", "yield_stress") and item.required and item.name not in (given | known):
            option = "--" + item.name.replace("_", "-")
            raise InputError(f"{option} must be given: no body states its {item.name.replace('_', ' ')}.")
    names = {item.name for item in kind.inputs}
    return {name: value for name, value in known.items() if name in names} | given


def from_surface(
    kind: type[Described], given: dict[str, Any], file: Path, reading: ReadingOptions, level: str
) -> Described:
    """The theory ``kind`` of the surface in ``file``, filled and levelled.

    Raises
    ------
    InputError
        If a number that is measured is also given, or another is missing.
    """
    from ..contact.roughness import roughness_of
    from ..surfaces.prepare.fill import filled
    from ..surfaces.prepare.level import levelled

    method: Any = getattr(kind, "from_roughness", getattr(kind, "of_roughness", None))
    parameters = list(inspect.signature(method).parameters.values())[1:]
    taken = {parameter.name for parameter in parameters}
    surplus = sorted(set(given) - taken)
    if surplus:
        options = ", ".join("--" + name.replace("_", "-") for name in surplus)
        raise InputError(f"{options} must be left out with --surface, which measures what {kind.name} needs.")
    needed = [p.name for p in parameters if p.default is inspect.Parameter.empty and p.name not in given]
    if needed:
        options = ", ".join("--" + name.replace("_", "-") for name in needed)
        raise InputError(f"{kind.name} of a surface must also be given {options}, but is not; --body names a material.")
    surface = read_surface(file, reading)
    found = level_of(surface, level)
    whole = filled(surface) if surface.n_missing else surface
    flat = levelled(whole, int(found) if found.isdigit() else found)
    theory: Described = method(roughness_of(flat), **given)
    return theory
