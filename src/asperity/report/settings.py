"""Boundary, law and load in words for a table."""

from __future__ import annotations

import numpy as np

from ..contact.laws import LayeredHardness
from ..contact.problem import ContactProblem
from ..contact.result import ContactResult
from ..core.units import show
from ..solids.elastic import Elastic
from ..solids.layers import Layered
from .bodies import material_name
from .inputs import Rows


def setting_rows(result: ContactResult) -> Rows:
    """Boundary, law and load of ``result``."""
    problem, control = result.problem, result.control
    rows = [("boundary", problem.boundary.name), ("interface law", problem.law.name)]
    limit = limit_text(problem)
    if limit:
        rows.append(("pressure limit", limit))
    rows.append((modulus_label(problem), show(problem.contact_modulus, "Pa")))
    rows.append((f"prescribed {control.name}", show(control.value, control.unit)))
    return rows


def limit_text(problem: ContactProblem) -> str:
    """Pressure limit of the law of ``problem``, and whose hardness it is; empty without a limit."""
    if isinstance(problem.law, LayeredHardness):
        top, base = show(problem.law.pressure_cap(), "Pa"), show(problem.law.base_hardness, "Pa")
        return f"{top} at the surface to {base} deep in the base, by local indentation"
    cap = np.asarray(problem.law.pressure_cap())
    if not np.isfinite(cap).all():
        return ""
    low, high = show(float(cap.min()), "Pa"), show(float(cap.max()), "Pa")
    if low != high:
        return f"{low} to {high}, by point"
    owners = [name for body in (problem.body, problem.counter_body) for name in _owner(body, float(cap.min()))]
    return f"{low} ({' and '.join(owners)})" if owners else low


def modulus_label(problem: ContactProblem) -> str:
    """What to call the contact modulus of ``problem``: that of a coated body is of its top layer alone."""
    coated = any(isinstance(body, Layered) for body in (problem.body, problem.counter_body))
    return "contact modulus E* of the materials at the surfaces" if coated else "contact modulus E*"


def _owner(body: object, limit: float) -> list[str]:
    """The material at the surface of ``body`` if the ``limit`` is its hardness."""
    if isinstance(body, Elastic):
        return [f"of {body.name}"] if body.name and body.strength.hardness == limit else []
    material = body.surface_material if isinstance(body, Layered) else None
    if not isinstance(material, Elastic) or material.strength.hardness != limit:
        return []
    return [f"of {material_name(material)}, the top layer"]
