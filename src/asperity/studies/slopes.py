"""Derivatives of quantities of a case to scalars of its document, by the sensitivities of the
contact."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..contact.result import ContactResult
from ..core.registry import ROLES, role
from ..io.schemas.bodies import LayerTable
from ..io.schemas.problem import PerLength
from ..run.document import ProblemDocument
from ..run.execute import Outcome

SAME = 1e-3
"""Relative difference of a quantity and of the output that is differentiated, up to which the
derivative is that of the quantity."""


QUANTITIES = ("approach", "mean_gap", "elastic_energy", "force", "max_pressure")
"""Quantities that have derivatives."""

_ROLE = "derivatives"
"""What gives them, where this package has it."""

CONSTANTS = ("thickness", "youngs_modulus", "poisson_ratio")
"""Constants of layers and bases that have derivatives."""


def slope_name(quantity: str, path: str) -> str:
    """Name in a record of the derivative of a ``quantity`` to the scalar at ``path``."""
    return f"{quantity} by {path}"


def differentiable(quantities: Iterable[str]) -> tuple[str, ...]:
    """Those of the ``quantities`` that may have derivatives."""
    return tuple(name for name in quantities if name in QUANTITIES) if _ROLE in ROLES else ()


class Parameter(NamedTuple):
    """A parameter of the sensitivities by its ``name``, and its change by one of the scalar, of
    heights relative."""

    name: str
    factor: float


def parameter(document: ProblemDocument, path: str, result: ContactResult) -> Parameter | None:
    """The parameter of ``result`` that the scalar at ``path`` of its ``document`` sets; None where
    there is none.

    A mean pressure p is the force p A; heights of a random surface are proportional to its rms
    height.
    """
    keys, given = path.split("."), document.control
    if path == "control.mean_pressure":
        return Parameter("force", result.problem.grid.area)
    if path == "control.force" and not isinstance(given.force, PerLength):
        return Parameter("force", 1.0)
    if path == "control.approach":
        return Parameter("approach", 1.0)
    if path == "law.hardness":
        return Parameter("hardness", 1.0)
    if path == "surface.spectrum.rms_height":
        found: Any = document.surface
        plain = found.kind == "rough" and not found.prepare and document.counter_surface is None
        return Parameter("heights", 1.0 / float(found.spectrum.rms_height)) if plain else None
    if keys[0] not in ("body", "counter_body") or keys[-1] not in CONSTANTS:
        return None
    layers = getattr(document, keys[0]).layers
    if len(keys) == 2:
        return Parameter(path, 1.0)
    if keys[1] == "base" and len(keys) == 3:
        return Parameter(path, 1.0)
    if keys[1] != "layers" or len(keys) != 4:
        return None
    number = int(keys[2])
    if not all(isinstance(layer, LayerTable) for layer in layers[: number + 1]):
        return None  # a graded layer is several
    return Parameter(f"{keys[0]}.layers[{number}].{keys[3]}", 1.0)


def slopes(outcome: Outcome, quantities: Sequence[str], paths: Sequence[str]) -> dict[str, float]:
    """Derivatives of those of the ``quantities`` that have one to the scalars at ``paths``, by
    ``slope_name``; what has none is left out."""
    result, found = outcome.result, dict[str, float]()
    if not paths or outcome.case is None or not isinstance(result, ContactResult):
        return found
    known = {path: parameter(outcome.case.document, path, result) for path in paths}
    wanted = {path: each for path, each in known.items() if each is not None}
    if not wanted or _ROLE not in ROLES:
        return found
    for quantity in (name for name in quantities if name in QUANTITIES):
        value = float(outcome.values.get(quantity, math.nan))
        made = role(_ROLE)(result, quantity, [each.name for each in wanted.values()])
        if made is None or not abs(made.value - value) <= SAME * abs(value):
            continue
        for path, each in wanted.items():
            if each.name not in made.values:
                continue
            slope = made[each.name]
            if each.name == "heights":
                slope = (np.asarray(slope) * result.problem.profile()).sum()
            found[slope_name(quantity, path)] = float(np.sum(slope)) * each.factor
    return found
