"""The theories of a comparison: which of the catalogue can be made for a surface and its bodies, and why the others
cannot.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from ..contact.laws import LayeredHardness
from ..contact.problem import ContactProblem
from ..core import require
from ..core.errors import InputError
from ..core.parameters import parameters
from ..solids.layers import weaker_strength
from ..theories.protocol import SurfaceTheory
from ..theories.statistics.roughness import Roughness

YIELDING, ADHESIVE = ("hardness", "yield_stress"), ("work",)
"""Parameters by which theories with plastic deformation, and with adhesion, are recognised."""


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


def surface_theories() -> tuple[str, ...]:
    """Names of the theories that are made from the roughness of a surface, in the order of the catalogue."""
    from ..theories.catalogue import THEORIES

    return tuple(name for name, kind in THEORIES.items() if hasattr(kind, "from_roughness"))


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
        Names out of ``surface_theories()``, theories made already, or both; all of the catalogue if None.
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
    made: dict[str, SurfaceTheory] = {}
    left_out: list[LeftOut] = []
    for item in surface_theories() if theories is None else theories:
        found = _made(item, roughness, E_star, known) if isinstance(item, str) else _given(item)
        if isinstance(found, LeftOut):
            left_out.append(found)
        else:
            made[_unused(found.name, made)] = found
    return Chosen(made, tuple(left_out))


def family(theory: SurfaceTheory) -> str:
    """``elastic-plastic``, ``adhesive`` or ``elastic``, by the parameters of the ``theory``."""
    names = {parameter.name for parameter in parameters(type(theory))}
    if names.intersection(YIELDING):
        return "elastic-plastic"
    return "adhesive" if names.intersection(ADHESIVE) else "elastic"


def known_of_bodies(problem: ContactProblem) -> dict[str, float]:
    """Parameters of theories that bodies and law of ``problem`` give: hardness, yield stress (Pa), nu.

    The hardness is that of the law if it is one number, and none if it is a map or follows the depth; see also
    ``weaker_strength``.
    """
    found = weaker_strength(problem.body, problem.counter_body)
    cap = problem.law.pressure_cap()
    if isinstance(problem.law, LayeredHardness) or isinstance(cap, np.ndarray):
        found.pop("hardness", None)
    elif math.isfinite(cap):
        found["hardness"] = cap
    return found


def _made(name: str, roughness: Roughness, E_star: float, known: Mapping[str, float]) -> SurfaceTheory | LeftOut:
    from ..theories.catalogue import THEORIES

    kind = THEORIES[require.one_of(name, surface_theories(), "name of a theory to compare")]
    wanted = [item for item in parameters(kind) if item.of == "bodies" and item.name != "E_star"]
    missing = [item for item in wanted if item.required and item.name not in known]
    if missing:
        needs = " and ".join(f"the {item.help} ({item.name}, {item.unit})" for item in missing)
        return LeftOut(name, kind.title, f"It needs {needs}, which is not known as one number.")
    values = {item.name: known[item.name] for item in wanted if item.name in known}
    try:
        theory: SurfaceTheory = kind.from_roughness(roughness, E_star, **values)  # type: ignore[attr-defined]
    except InputError as error:
        return LeftOut(name, kind.title, str(error))
    return theory


def _given(theory: SurfaceTheory) -> SurfaceTheory:
    if not all(hasattr(theory, part) for part in ("at_pressure", "validity", "name", "title")):
        raise InputError(
            f"theories of a comparison must be names or theories with at_pressure and validity, but hold {theory!r}."
        )
    return theory


def _unused(name: str, taken: Mapping[str, object]) -> str:
    """``name``, with a number behind it if it is taken."""
    number = 1 + sum(other == name or other.startswith(f"{name} ") for other in taken)
    return name if number == 1 else f"{name} {number}"
