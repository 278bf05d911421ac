"""What differs between two runs that are shown side by side: their numbers, and a map that the
browser makes of the maps of both."""

from __future__ import annotations

import base64
from collections.abc import Callable
from typing import Any

from nicegui import ui

from ..contact.result import SCALARS
from ..core.quantity import Quantity
from ..core.units import percent
from ..io.words import HEADLINE, value_text
from ..plots.picture import colour_table
from .layout import text_table
from .session import Run

COLOURS = "RdBu_r"
"""Colours of a difference: blue below zero, white there, red above."""


def run_name(run: Run) -> str:
    """What a run is called where two are compared."""
    return f"run {run.key.split('-')[0]}"


class Told:
    """Numbers of a run, by the names of their quantities, once they are known; ``heard`` is called
    then."""

    def __init__(self) -> None:
        self.numbers: dict[str, float | None] | None = None
        self.heard: Callable[[], None] = lambda: None

    def tell(self, numbers: list[list[Any]]) -> None:
        """Take the ``numbers``, names and values."""
        self.numbers = dict(numbers)
        self.heard()


def difference(first: Told, second: Told, names: tuple[str, str]) -> None:
    """Section with the map of the ``first`` run less the ``second``, their ``names``, and the
    numbers of both."""
    palette = base64.b64encode(colour_table(COLOURS)).decode("ascii")
    box = ui.element("section").classes("whole difference").props("hidden data-difference")
    box.props(f'data-palette="{palette}" aria-label="difference of the two runs"')
    with box:
        with ui.element("h2"):
            ui.label(f"{names[0].capitalize()} minus {names[1]}")
        ui.element("div").props("data-difference-map")
        table = ui.element("div").props("data-difference-numbers").classes("whole")

    def fill() -> None:
        if first.numbers is None or second.numbers is None:
            return
        table.clear()
        with table:
            text_table(
                ["quantity", names[0], names[1], "difference"], rows_of_differences(first.numbers, second.numbers)
            )

    first.heard = second.heard = fill


def rows_of_differences(first: dict[str, float | None], second: dict[str, float | None]) -> list[list[str]]:
    """Label, value of the ``first`` and of the ``second``, and the first less the second, of every
    headline quantity."""
    quantities, rows = {quantity.name: quantity for quantity in SCALARS}, []
    for name, label in HEADLINE.items():
        pair = [first.get(name), second.get(name)]
        if None in pair:
            continue
        one, other = (float(value) for value in pair if value is not None)
        rows.append([label, *(_text(quantities[name], value) for value in (one, other, one - other))])
    return rows


def _text(quantity: Quantity, value: float) -> str:
    """``value`` with its unit; whole numbers in full, shares in percent."""
    if quantity.name == "n_spots":
        return str(round(value))
    return percent(value) if quantity.unit == "1" else value_text(quantity, value)
