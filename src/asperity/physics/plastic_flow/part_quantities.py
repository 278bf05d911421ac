"""Quantities and tables that the parts on plastic flow share; nothing here takes long to import."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from ...core.quantity import Quantity
from ...core.units import show
from ...parts.part import Found, Rows, Solved, Stored, Table, Work

CUT = (
    ("across", "m", "edges of the cells of the cut", "edge_across"),
    ("depth", "m", "depths of the edges of the cells of the cut", "edge_depth"),
    ("interfaces", "m", "depths of the interfaces", "interface"),
    ("strain", "1", "accumulated plastic strain on the cut", "cell_across cell_depth"),
    ("residual", "Pa", "residual stress along the cut", "cell_across cell_depth"),
    ("stress", "Pa", "von Mises stress on the cut under the largest load", "cell_across cell_depth"),
)
"""Name, unit, label and axes of what a cut holds."""

CURVE = (
    ("approach", "m", "approach of the history", "step"),
    ("force", "N", "force of the history", "step"),
    ("elastic_force", "N", "force of the elastic contact at the same approach", "step"),
    ("area", "m**2", "contact area of the history", "step"),
    ("work_lost", "J", "work that plastic flow has taken so far", "step"),
)
"""The same of what a history of load holds."""

IMPRINT = (
    ("place", "m", "coordinate of the residual surface along the cut", "place"),
    ("imprint", "m", "height of the residual surface along the cut", "place"),
)
"""The same of the surface that stays."""


def quantities_of(prefix: str) -> tuple[Quantity, ...]:
    """Cut, curve and imprint as quantities whose names and axes begin with ``prefix``."""
    return tuple(
        Quantity(f"{prefix}_{name}", unit, label, tuple(f"{prefix}_{axis}" for axis in axes.split()))
        for name, unit, label, axes in (*CUT, *CURVE, *IMPRINT)
    )


@dataclass(frozen=True, eq=False)
class Detail:
    """What words and figures of finite elements need beside the values: ``facts`` as in JSON, and
    the run itself, which files do not keep."""

    facts: Mapping[str, Any] = field(default_factory=dict)
    run: Any = None


class OfElements(Work):
    """What is done for a part by finite elements, whose ``Detail`` files keep without the run."""

    def stored(self, found: Found) -> Stored:
        """The facts."""
        return Stored(facts=found.detail.facts)

    def restored(self, stored: Stored, solved: Solved) -> Detail:
        """The same again."""
        return Detail(dict(stored.facts))


def number_rows(scalars: Sequence[Quantity], values: Mapping[str, Any]) -> Rows:
    """What is known of the ``scalars``, without those of ``tension_table``."""
    from ...io.words import value_text

    known = [item for item in scalars if not ("_tension" in item.name or "interface" in item.name)]
    found = [(item, float(values[item.name])) for item in known]
    return [(item.label, value_text(item, value)) for item, value in found if math.isfinite(value)]


def zones_table(facts: Mapping[str, Any]) -> Table:
    """Plastic zones from the ``facts`` that files keep."""
    headings, cells = facts["zones"]
    return Table(tuple(map(str, headings)), tuple(tuple(map(str, row)) for row in cells))


def tension_table(values: Mapping[str, Any], prefix: str) -> Table:
    """Tension at surface and bottom of layers, shear and peel of interfaces, under load and after
    it."""
    places = {
        "surface_tension": "tension along the surface",
        "layer_tension": "tension at the bottom of a layer",
        "interface_shear": "shear of an interface",
        "interface_peel": "peel of an interface",
    }
    cells = []
    for key, label in places.items():
        under, after = (float(values[f"{prefix}_{state}{key}"]) for state in ("", "residual_"))
        if math.isfinite(under):
            cells.append((label, show(under, "Pa", 3), show(after, "Pa", 3)))
    return Table(("Largest", "Under load", "Residual"), tuple(cells))
