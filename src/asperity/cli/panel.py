"""Options of commands, shown in the help under the heading of a panel."""

from __future__ import annotations

from typing import Any, Protocol

from typer import Option


class PanelOption(Protocol):
    """Makes the options of one panel."""

    def __call__(self, name: str, text: str, metavar: str | None = None) -> Any:
        """Option ``name`` with the ``text`` of its help."""


def option(name: str, text: str, panel: str, metavar: str | None = None) -> Any:
    """Option ``name`` with the ``text`` of its help, under the heading ``panel``."""
    return Option(name, help=text, rich_help_panel=panel, metavar=metavar)


def options_of(panel: str) -> PanelOption:
    """What makes the options under the heading ``panel``."""

    def panel_option(name: str, text: str, metavar: str | None = None) -> Any:
        return option(name, text, panel, metavar)

    return panel_option
