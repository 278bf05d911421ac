"""Stick and slip in result files: fields and numbers of one step, columns of those of a history, and back to the bit."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ..core.quantity import Labelled, Quantity
from ..core.status import Outcome, Status
from ..physics.friction.answer import StickSlip
from ..physics.friction.fretting import NUMBERS
from ..physics.friction.law import FrictionLaw
from .description import describe, rebuild
from .tree import Node

VECTORS = (
    Quantity("traction", "Pa", "shear traction on the body"),
    Quantity("slip_increment", "m", "slip in the step"),
    Quantity("slip", "m", "slip since the start"),
    Quantity("tangential_displacement", "m", "elastic displacement along the surface"),
)
"""Fields with a component along x and one along y, which files keep apart."""

SHEAR_FIELDS = (
    Quantity("shear_displacement", "m", "normal displacement by shear"),
    Quantity("dissipation_density", "J/m**2", "energy dissipated by slip in the step per area"),
)
"""Fields of one number at each point."""

WORK = (
    Quantity("duality_gap", "1", "bound on the relative error of the tangential energy"),
    Quantity("complementarity", "1", "residual of gap and slip together"),
    Quantity("iterations", "1", "Newton steps of all tangential solves"),
    Quantity("fft_pairs", "1", "FFT pairs of all tangential solves"),
)
"""Error and work of the tangential solve."""

PREFIX = "stick_slip_"
"""Beginning of the names of columns in a history."""


def shear_variables(found: StickSlip) -> Iterator[Labelled]:
    """All that files hold of ``found`` but its law, each with its quantity."""
    for item in VECTORS:
        for axis, values in zip("xy", getattr(found, item.name), strict=True):
            named = replace(item, name=f"{item.name}_{axis}", label=f"{item.label} along {axis}", dims=("x", "y"))
            yield Labelled(named, values)
    for item in SHEAR_FIELDS:
        yield Labelled(replace(item, dims=("x", "y")), getattr(found, item.name))
    for item in (*NUMBERS, *WORK):
        yield Labelled(item, getattr(found, item.name))
    control = Quantity("tangential", "", "prescribed shift or tangential force, as JSON")
    yield Labelled(control, json.dumps(describe(found.tangential)))
    for name in ("outcome", "message", "remedy"):
        quantity = Quantity(f"status_{name}", "", f"{name} of the tangential solve")
        yield Labelled(quantity, str(getattr(found.status, name)))


def shear_node(found: StickSlip, lines: tuple[Labelled, ...]) -> Node:
    """Group of ``found`` on a grid with these ``lines`` of coordinates; texts are attributes."""
    items = list(shear_variables(found))
    texts = {item.quantity.name: item.values for item in items if not item.quantity.unit}
    return Node((*lines, *(item for item in items if item.quantity.unit)), texts)


def shear_in(node: Node, law: FrictionLaw) -> StickSlip:
    """Stick and slip of a group."""
    return shear_from({**node.attributes, **{item.quantity.name: item.values for item in node.values}}, law)


def shear_columns(steps: Sequence[StickSlip]) -> Iterator[Labelled]:
    """The same of every step of a history, under names with ``PREFIX``."""
    for columns in zip(*map(shear_variables, steps), strict=True):
        item = columns[0].quantity
        named = replace(item, name=f"{PREFIX}{item.name}", dims=("step", *item.dims))
        yield Labelled(named, np.asarray([column.values for column in columns]))


def shear_from(source: Mapping[str, Any], law: FrictionLaw, prefix: str = "") -> StickSlip:
    """Stick and slip from the variables of a group, or of one step of a history, by name."""

    def number(item: Quantity) -> Any:
        value = source[f"{prefix}{item.name}"]
        return value.item() if isinstance(value, np.generic | np.ndarray) else value

    fields: dict[str, Any] = {item.name: np.asarray(source[f"{prefix}{item.name}"]) for item in SHEAR_FIELDS}
    for item in VECTORS:
        fields[item.name] = np.stack([source[f"{prefix}{item.name}_{axis}"] for axis in "xy"])
    ended = [str(source[f"{prefix}status_{name}"]) for name in ("outcome", "message", "remedy")]
    return StickSlip(
        law=law,
        tangential=rebuild(json.loads(str(source[f"{prefix}tangential"]))),
        status=Status(Outcome(ended[0]), ended[1], ended[2]),
        **fields,
        **{item.name: number(item) for item in (*NUMBERS, *WORK)},
    )
