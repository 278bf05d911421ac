"""What stands in the row of a layer: the choice of its material, and each constant as the document
resolves it, with its source on demand."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any

from nicegui import ui

from ..io.schemas.bodies import BESIDE, CONSTANTS, MaterialTable
from ..solids.library import MaterialRecord
from .draft import Keys
from .forms import asked_of
from .resolved import SHOWN, Materials, Resolved, Value, is_own, record_of, shown
from .widgets import Context, entry

ENTRIES = MappingProxyType({item.name: item for item in asked_of(MaterialTable)})
"""Entries of a material by their keys."""

OWN, RELAXING, RIGID = "=own", "=relaxing", "=rigid"
"""What stands for a way to give a material that is no name of the library."""

WAYS = MappingProxyType({OWN: "own constants", RELAXING: "own constants that relax", RIGID: "rigid"})

OF_MATERIAL = frozenset({*MaterialTable.model_fields, "rigid"})
"""Keys of the table of a layer that are those of its material."""

START = MappingProxyType({"name": "own material"})
"""Own constants before any is typed."""


def way_of(part: Mapping[str, Any], record: MaterialRecord | None) -> str | None:
    """What the choice of a material shows for the table ``part``, of which the library knows the
    ``record``; None where nothing has been chosen."""
    if part.get("rigid"):
        return RIGID
    if is_own(part):
        return RELAXING if part.get("relaxation") else OWN
    return record.name if record else part.get("material")


def with_way(part: Mapping[str, Any], way: str | None, library: str | None) -> dict[str, Any]:
    """The table ``part`` of a layer or base with another material, chosen by its ``way``; own
    constants begin with those of the material before."""
    kept = {key: value for key, value in part.items() if key not in OF_MATERIAL}
    if way is None:
        return kept
    if way == RIGID:
        return {**kept, "rigid": True}
    if way not in WAYS:
        return {**kept, "material": way}
    before = {key: value for key, value in part.items() if key in OF_MATERIAL} if is_own(part) else {}
    record = record_of(part, library)
    if record is not None and record.relaxation is None:
        before = {"name": record.name, **taken(record), **{key: part[key] for key in BESIDE if key in part}}
    before = before or dict(START)
    if way == OWN:
        before.pop("relaxation", None)
    else:
        before.pop("youngs_modulus", None)
        before.setdefault("relaxation", {"kind": "prony"})
    return {**kept, **before}


HARDENING: Mapping[str, Mapping[str, str]] = MappingProxyType(
    {
        "linear": {"modulus": "hardening_modulus"},
        "swift": {"exponent": "swift_exponent", "reference_strain": "swift_strain"},
        "voce": {"gain": "voce_gain", "rate": "voce_rate"},
    }
)
"""Values of each law of hardening in documents, and where the library has them."""


def taken(record: MaterialRecord) -> dict[str, Any]:
    """Constants of the library as text of a document."""
    values = record.values
    found: dict[str, Any] = {key: shown(key, values[key].value, 12) for key in (*CONSTANTS, *BESIDE) if key in values}
    for kind, keys in HARDENING.items():
        if values.keys() >= {*keys.values()}:
            found["hardening"] = {"kind": kind, **{key: repr(values[own].value) for key, own in keys.items()}}
            for key in found["hardening"].keys() & {"modulus", "gain"}:
                found["hardening"][key] += " Pa"
    return found


def material_choice(
    context: Context,
    resolving: Materials,
    keys: Keys,
    library: str | None,
    chosen: Callable[[str | None], None],
) -> None:
    """Choice of the material of the table at ``keys``; ``chosen`` takes its way."""
    part = context.get(keys) or {}
    way = way_of(part, resolving.of(part, library).record)
    ways = [OWN, RELAXING, *([RIGID] if keys[-1] == "base" else [])]
    options = {**{word: WAYS[word] for word in ways}, **{name: name for name in resolving.names(library)}}
    if way is not None and way not in options:
        options[way] = WAYS.get(way, str(way))
    if way == OWN and part.get("name") not in (None, START["name"]):
        options[OWN] = f"{part['name']} (own)"

    def choose(word: str | None) -> None:
        now = context.get(keys) or {}
        if word != way_of(now, resolving.of(now, library).record):
            chosen(word)

    made = ui.select(options, value=way, with_input=True, on_change=lambda e: choose(e.value))
    made.classes("field").props(
        f'dense options-dense data-key="{".".join(map(str, (*keys, "material")))}" placeholder="choose" '
        'aria-label="Material"'
    )


class Cell:
    """The constant ``key`` of the material at ``keys``: typed, or a button that opens its source.

    ``own_constants`` takes all constants of the library as own ones.
    """

    def __init__(
        self,
        context: Context,
        materials: Materials,
        keys: Keys,
        key: str,
        library: Callable[[], str | None],
        own_constants: Callable[[], None],
    ) -> None:
        self.own: Any = None
        self.menu: ui.menu | None = None
        self.context, self.materials, self.keys, self.key, self.library = context, materials, keys, key, library
        self.own_constants = own_constants
        part = context.get(keys) or {}
        with ui.element("div").classes("cell").props(f'data-symbol="{SHOWN[key]}"'):
            self.typed = self._typed() if is_own(part) else None
            self.button = ui.button(on_click=self.open).props("flat dense no-caps align=left").classes("value")
            self.mark = ui.label().classes("mark")
        self.update()

    @property
    def place(self) -> Keys:
        """Where its value stands."""
        return (*self.keys, self.key)

    def value(self) -> tuple[Resolved, Value]:
        """The material, and this constant of it."""
        found = self.materials.of(self.context.get(self.keys) or {}, self.library())
        return found, found.values[self.key]

    def _typed(self) -> Any:
        made = entry(self.context, ENTRIES[self.key], self.place, bare=True)
        return made.props(f'placeholder="{"needed" if self.key in CONSTANTS else "unknown"}"')

    def open(self) -> None:
        """Open the source, which is drawn when it is asked for first."""
        if self.menu is None:
            with self.button:
                self.menu = ui.menu().props('anchor="bottom left" self="top left"')
            with self.menu:
                self._source()
            self.update()
            self.menu.open()

    def _source(self) -> None:
        """What the button opens."""
        with ui.element("div").classes("source").props(f'data-source="{".".join(map(str, self.place))}"'):
            self.title = ui.label().classes("table-title")
            self.said, self.note = ui.label(), ui.label().classes("hint")
            if self.key in BESIDE and self.typed is None:
                own = self.own = entry(self.context, replace(ENTRIES[self.key], label="Own value"), self.place)
                self.back = ui.button("Give it back to the library", icon="undo", on_click=lambda: own.set_value(""))
                self.back.props(f'flat dense no-caps data-back="{".".join(map(str, self.place))}"')
            elif self.typed is None:
                self.back = ui.button("Take these as own constants", icon="edit", on_click=self.own_constants)
                self.back.props("flat dense no-caps")

    def update(self) -> None:
        """Show the constant as it is now."""
        material, value = self.value()
        relaxes = value.relaxes
        if self.typed is not None:
            there = self.context.get(self.place)
            inline = not relaxes or there is not None
            self.typed.set_visibility(inline)
            self.button.set_visibility(not inline)
            plain = str(there or "").replace(" ", "") == value.text.replace(" ", "")
            self.mark.set_text("" if not (inline and value.text) else "own" if plain else f"= {value.text}")
        else:
            self.mark.set_text("own" if value.own else "assumed" if value.assumed else "relaxes" if relaxes else "")
        self.mark.set_visibility(bool(self.mark.text))
        self.button.set_text(value.text or ("–" if not material.name else "not known"))
        self.button.props["aria-label"] = f"{value.label}: {value.text or 'not known'}. Press for its source"
        for one in (self.button, self.mark):
            one.classes(add="own" if value.own else "", remove="" if value.own else "own")
        self.button.classes(add="unknown" if not value.text else "", remove="unknown" if value.text else "")
        if self.menu is not None:
            self._say(material, value)

    def _say(self, material: Resolved, value: Value) -> None:
        """Show the source as it is now."""
        if self.own is not None:
            self.back.set_visibility(value.own)
            if self.own.value and not value.own:
                self.own.set_value("")
        self.title.set_text(f"{value.label} of {material.name}" if material.name else value.label)
        self.said.set_text(said(value))
        self.note.set_text(material.note)
        self.note.set_visibility(bool(material.note))


def said(value: Value) -> str:
    """Where a ``value`` comes from, as a sentence or two."""
    if value.own:
        instead = f" The library has {value.library}." if value.library else ""
        falls = " at the first instant, from the relaxation below details" if value.relaxes else ""
        return f"{value.text}{falls}, {value.source}.{instead}".lstrip(", ")
    if not value.text:
        return "Not known: no source gives it, or no material has been chosen."
    said = value.source.removeprefix("assumed:").strip()
    return f"{value.text}, assumed: {said}" if value.assumed else f"{value.text}. Source: {said}"
