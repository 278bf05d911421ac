"""Where on a page it stands what is wrong with a table: beside the entry, or the item of a list."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from nicegui import ui
from nicegui.elements.mixins.validation_element import ValidationElement

from .draft import Keys
from .layout import failure


@dataclass
class Places:
    """Entries of the form and slots of its tables, by their keys."""

    entries: dict[Keys, Any] = field(default_factory=dict)
    slots: dict[Keys, ui.element] = field(default_factory=dict)
    marked: dict[Keys, str] = field(default_factory=dict)

    def slot(self, keys: Keys) -> None:
        """Here stands what is wrong with the table at ``keys``."""
        name = ".".join(map(str, keys))
        self.slots[keys] = ui.element("div").classes("refused").props(f'data-wrong="{name}" role="alert"')

    def clear(self) -> None:
        """Nothing is wrong any more."""
        for slot in self.slots.values():
            if not slot.is_deleted:
                slot.clear()
        for keys, text in self.marked.items():
            entry = self.entries.get(keys)
            if entry is not None and not entry.is_deleted and entry.error == text:
                entry.error = None
        self.marked = {}

    def show(self, keys: Keys, text: str) -> bool:
        """Say ``text`` beside the entry at ``keys``, or in the slot of the smallest table that
        holds it; whether there is a place for it."""
        self.clear()
        entry = self.entries.get(keys)
        if isinstance(entry, ValidationElement) and not entry.is_deleted:
            if entry.error is None and "hint" not in entry.props:  # else the entry says it itself
                entry.error = self.marked[keys] = text
            return True
        for end in range(len(keys), 0, -1):
            slot = self.slots.get(keys[:end])
            if slot is not None and not slot.is_deleted:
                with slot:
                    failure(text)
                return True
        return False
