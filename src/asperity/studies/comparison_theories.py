"""The theories of a comparison, made of what is known of surface and bodies, and where they leave
their validity."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..contact.boundary import Periodic
from ..contact.law import HardWall, LimitByDepth
from ..contact.problem import ContactProblem
from ..core import require
from ..core.arrays import BoolArray
from ..core.errors import AsperityError, InputError
from ..core.parameters import parameters
from ..core.units import show
from ..solids.layers import Layered, weaker_strength
from ..theories.protocol import Prediction, SurfaceTheory, Theory
from ..theories.statistics.roughness import Roughness


@dataclass(frozen=True)
class LeftOut:
    """A theory that could not be made or evaluated: its name, its title and the reason."""

    name: str
    title: str
    reason: str


@dataclass(frozen=True)
class Chosen:
    """Theories by the names they have in a comparison, and those that were left out."""

    theories: dict[str, SurfaceTheory]
    left_out: tuple[LeftOut, ...]


def _offered() -> dict[str, Any]:
    """Theories of the catalogue that are made from the roughness of a surface, by name."""
    from ..theories.catalogue import THEORIES

    return {name: kind for name, kind in THEORIES.items() if hasattr(kind, "from_roughness")}


def surface_theories() -> tuple[str, ...]:
    """Names of the theories that are made from the roughness of a surface, in the order of the
    catalogue."""
    return tuple(_offered())


def chosen_theories(
    roughness: Roughness,
    E_star: float,
    *,
    theories: Iterable[str | SurfaceTheory] | None,
    known: Mapping[str, float],
) -> Chosen:
    """Theories for the ``roughness`` and the contact modulus ``E_star`` in Pa.

    Parameters
    ----------
    theories
        Names out of ``surface_theories()``, theories made already, or both; all of the catalogue if
        None.
    known
        Values of parameters that belong to the bodies, in SI units, see ``known_of_bodies``.

    Raises
    ------
    InputError
        If a name is unknown or something is no theory.
    """
    if isinstance(theories, str):
        raise InputError(
            f"theories of a comparison must be a list of names, but is {theories!r}. Write [{theories!r}]."
        )
    offered = _offered()
    made: dict[str, SurfaceTheory] = {}
    left_out: list[LeftOut] = []
    for item in tuple(offered) if theories is None else theories:
        if not isinstance(item, str) and not all(
            hasattr(item, part) for part in ("at_pressure", "validity", "name", "title")
        ):
            raise InputError(
                f"theories of a comparison must be names or theories with at_pressure and validity, but hold {item!r}."
            )
        found: SurfaceTheory
        if isinstance(item, str):
            kind = offered[require.one_of(item, tuple(offered), "name of a theory to compare")]
            wanted = [part for part in parameters(kind) if part.of == "bodies" and part.name != "E_star"]
            missing = [part for part in wanted if part.required and part.name not in known]
            if missing:
                needs = " and ".join(f"the {part.help} ({part.name}, {part.unit})" for part in missing)
                left_out.append(LeftOut(item, kind.title, f"It needs {needs}, which is not known as one number."))
                continue
            values = {part.name: known[part.name] for part in wanted if part.name in known}
            try:
                found = kind.from_roughness(roughness, E_star, **values)
            except InputError as error:
                left_out.append(LeftOut(item, kind.title, str(error)))
                continue
        else:
            found = item
        number = 1 + sum(other == found.name or other.startswith(f"{found.name} ") for other in made)
        made[found.name if number == 1 else f"{found.name} {number}"] = found
    return Chosen(made, tuple(left_out))


def family(theory: SurfaceTheory) -> str:
    """``elastic``, or one of the kinds that the catalogue recognises by the parameters of the
    ``theory``."""
    from ..theories.catalogue import RECOGNISED

    names = {parameter.name for parameter in parameters(type(theory))}
    return next((kind for kind, known in RECOGNISED.items() if names.intersection(known)), "elastic")


def known_of_bodies(problem: ContactProblem) -> dict[str, float]:
    """Parameters of theories that bodies and law of ``problem`` give: hardness, yield stress (Pa),
    nu.

    The hardness is that of the law if it is one number, and none if it is a map or follows the
    depth; see also ``weaker_strength``.
    """
    found = weaker_strength(problem.body, problem.counter_body)
    cap = problem.law.pressure_cap()
    if isinstance(problem.law, LimitByDepth) or isinstance(cap, np.ndarray):
        found.pop("hardness", None)
    elif math.isfinite(cap):
        found["hardness"] = cap
    return found


# Where the theories leave their validity, with the numbers.


@dataclass(frozen=True, eq=False)
class Checked:
    """Where the limits of a theory hold that concern a quantity, (n,) each, and one sentence for
    each that is left somewhere."""

    valid_for: Mapping[str, BoolArray]
    notes: tuple[str, ...]


def check(theory: SurfaceTheory, prediction: Prediction, roughness: Roughness) -> Checked:
    """Limits of ``theory`` along its ``prediction``, those on what was measured included."""
    names = {"area_fraction": "area_fraction", "contact_density": "contact_density"}
    names["gap"] = "mean_gap" if np.isfinite(prediction.mean_gap).any() else "separation"
    try:
        own = isinstance(theory, Theory)
        limits = theory.validity(prediction, roughness) if own else theory.validity(prediction)  # type: ignore[call-arg]
    except AsperityError as error:  # a theory that has to solve again for its limits
        nowhere = np.zeros(len(prediction), dtype=bool)
        return Checked(dict.fromkeys(names, nowhere), (f"Its limits could not be checked: {error}",))
    valid = {name: np.ones(len(prediction), dtype=bool) for name in names}
    sentences = []
    for limit in limits:
        for name, quantity in names.items():
            if limit.concerns(quantity):
                valid[name] &= limit.holds
        if limit.holds.all():
            continue
        outside, pressures = ~limit.holds, prediction.pressure
        value = limit.value[outside]
        finite = value[np.isfinite(value)]
        end = limit.high if math.isfinite(limit.high) else limit.low  # from which excess is measured
        worst = float(finite[np.argmax(np.abs(finite - end))]) if finite.size else math.nan
        first, first_inside = int(np.argmax(outside)), int(np.argmin(outside))
        if outside.all():
            where = "at every load"
        elif outside[-1] and outside[:first].sum() == 0 and outside[first:].all():
            where = f"from {show(float(pressures[first]), 'Pa', 3)} on"
        elif outside[0] and outside[:first_inside].all() and not outside[first_inside:].any():
            where = f"below {show(float(pressures[first_inside]), 'Pa', 3)}"
        else:
            where = f"at {int(outside.sum())} of {outside.size} loads"
        sentences.append(
            f"{limit.criterion} {worst:.3g}, not {limit.bounds}, {where}: {limit.message} [{limit.citation}]"
        )
    return Checked(valid, tuple(sentences))


def remarks(problem: ContactProblem, theories: dict[str, SurfaceTheory], largest_spot: float) -> tuple[str, ...]:
    """What bodies, law and boundary mean for the comparison.

    ``largest_spot`` is the mean radius in m of the contact spots at the highest load, NaN if it is
    not known.
    """
    from ..theories.catalogue import NOT_SOLVED

    found: list[str] = []
    coated = [b for b in (problem.body, problem.counter_body) if isinstance(b, Layered) and b.reduced.layers]
    if coated:
        thin = min(body.reduced.layers[0].thickness for body in coated)
        size = ""
        if math.isfinite(largest_spot):
            size = f" (at the highest load their mean radius is {show(largest_spot, 'm', 3)})"
        found.append(
            "A body is layered. The numerical solution includes its layers; every theory assumes homogeneous "
            f"half-spaces and takes E* = {show(problem.contact_modulus, 'Pa')} of the materials at the "
            "surfaces, which holds while contacts are much smaller than the top layer of "
            f"{show(thin, 'm', 3)}{size}."
        )
    plastic = [name for name, theory in theories.items() if family(theory) == "elastic-plastic"]
    if not isinstance(problem.law, HardWall):
        known = f"; so do {_listed(plastic)}" if plastic else ", which no theory here does"
        found.append(
            f"The numerical solution limits the pressure by the law {problem.law.name}{known}. Elastic "
            "theories have no such limit."
        )
    elif plastic:
        found.append(
            f"The numerical solution is elastic at any pressure; in {_listed(plastic)} summits flow, which "
            "adds to the area."
        )
    for kind, remark in NOT_SOLVED.items():
        if of_kind := [name for name, theory in theories.items() if family(theory) == kind]:
            found.append(remark.format(_listed(of_kind)))
    if not isinstance(problem.boundary, Periodic):
        found.append(
            f"The boundary is {problem.boundary.name}: the contact is that of a patch whose borders carry more than "
            "its middle; theories assume an unbounded surface. Compare with a periodic boundary."
        )
    elif "interacting-crests" in theories:
        found.append(
            "The separation of interacting-crests includes the sinking of the whole patch under its load, "
            "which a periodic contact does not have: it is no mean gap and is not compared as one."
        )
    return tuple(found)


def _listed(names: list[str]) -> str:
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last
