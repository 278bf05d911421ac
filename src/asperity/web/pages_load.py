"""Page of the load and the physics: the load first, then the settings of the contact, then a card
for each physics and analysis."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib import resources
from types import MappingProxyType
from typing import Any

from nicegui import ui

from ..core.registry import FORMS
from ..core.words import first_paragraph, label_of
from ..io.schemas.problem import CONTROLS
from ..parts.part import Part
from ..parts.registry import parts
from ..run.document import document_model
from .draft import Keys
from .forms import Asked, asked_of
from .refused import Refused
from .session import Session
from .widgets import Context, entry, folded, form, kinds, nested

OF_PAGES = frozenset({"version", "title", "surface", "counter_surface", "body", "counter_body"})
"""Keys of the document that other pages fill."""

LOAD = "control"

SETTINGS = MappingProxyType(
    {"boundary": "periodic", "law": "no limit of the pressure", "solver": "chosen by the package"}
)
"""Tables of the core beside the load, and what they are where nothing is said."""

OTHERS = "Of other packages"
"""Heading of parts that ``core.registry.FORMS`` does not name."""

NEUTRAL = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 64 40" fill="none" stroke="currentColor" '
    'stroke-width="1.6" stroke-linecap="round"><path d="M14 4a18 18 0 0 0 36 0M2 30c5-8 10-8 15 0s10 4 15-4 10-4 15 '
    '4 10 0 15-4"/></svg>'
)
"""Picture of a part that has none."""


def load_page(key: str, session: Session) -> None:
    """The load, boundary, law and solver, and every part that declares settings."""
    refused = Refused(session)
    captions: dict[str, Any] = {}

    def changed(keys: Keys) -> None:
        if keys[0] in captions:
            captions[str(keys[0])].props["caption"] = summary(str(keys[0]), session.draft.get(keys[0]))
        refused.later(keys)

    context = Context(session, changed)
    entries = {item.name: item for item in asked_of(document_model(), OF_PAGES)}
    refused.slot("")
    with ui.element("section").classes("load").props('aria-label="load"'):
        ui.html("<h2>Load</h2>", sanitize=False)
        _load(context, entries[LOAD])
        refused.slot(LOAD)
    with ui.element("section").classes("settings").props('aria-label="settings of the contact"'):
        for name in SETTINGS:
            with ui.element("div").classes("setting"):
                fold = ui.expansion(label_of(name), caption=summary(name, session.draft.get(name)))
                with fold.classes("wide").props(f'data-setting="{name}"'):
                    nested(context, entries[name], (name,))
                captions[name] = fold
                refused.slot(name)
    for heading, items in grouped({name: item for name, item in entries.items() if name not in (LOAD, *SETTINGS)}):
        with ui.element("section").props(f'aria-label="{heading.lower()}"'):
            ui.html(f"<h2>{heading}</h2>", sanitize=False)
            with ui.element("div").classes("cards"):
                for item in items:
                    _card(context, item, refused)


def grouped(entries: Mapping[str, Asked]) -> Iterator[tuple[str, list[Asked]]]:
    """The ``entries`` of parts by the headings under which they stand, in order."""
    named = {name for names in FORMS.values() for name in names}
    groups = {**FORMS, OTHERS: tuple(name for name in entries if name not in named)}
    for heading, names in groups.items():
        items = [entries[name] for name in names if name in entries]
        if items:
            yield heading, items


def summary(name: str, table: Any) -> str:
    """What the table ``name`` says, in a few words."""
    if not isinstance(table, Mapping) or not table:
        return SETTINGS[name]
    kind = str(table.get("kind", ""))
    named = [kind.replace("_", " ")] if kind and kind not in table else []
    return ", ".join([*named, *(f"{label_of(key).lower()} {value}" for key, value in table.items() if key != "kind")])


def _load(context: Context, item: Asked) -> None:
    """What is prescribed: one value, or a path of them."""
    assert item.tables is not None
    model = item.tables[""]
    inside = {item.name: item for item in asked_of(model)}

    def given() -> list[str]:
        value = context.get((LOAD,))
        return [name for name in CONTROLS if isinstance(value, Mapping) and value.get(name) is not None]

    chosen = next(iter(given()), CONTROLS[0])

    def choose(word: str) -> None:
        nonlocal chosen
        if word != chosen:
            chosen = word
            context.set((LOAD,), {"path": {}} if word == "path" else None)
            shown.refresh()

    @ui.refreshable
    def shown() -> None:
        names = list(dict.fromkeys([chosen, *given()]))
        with ui.element("div").classes("fields"):
            for name in names:
                if inside[name].tables is None:
                    entry(context, inside[name], (LOAD, name))
        if "path" in names:
            tables = inside["path"].tables or {}
            ui.label(first_paragraph(tables[""]).replace("``", "")).classes("hint")
            form(context, tables[""], (LOAD, "path"))

    with ui.card().classes("table").props("flat bordered"):
        ui.label("Control: what is prescribed").classes("table-title")
        words = {name: "Load path" if name == "path" else label_of(name) for name in CONTROLS}
        ui.toggle(words, value=chosen, on_change=lambda e: choose(e.value)).props(
            f'no-caps dense data-key="{LOAD}.kind"'
        ).classes("choices")
        shown()


def _card(context: Context, item: Asked, refused: Refused) -> None:
    """One physics or analysis: its picture, what it answers, and where it is chosen its
    settings."""
    tables = item.tables or {}
    part = next((one for one in parts() if one.table == item.name and one.settings is not None), None)
    keys: Keys = (item.name,)

    def use(there: bool) -> None:
        context.set(keys, {} if there else None)
        unfold(there)

    def unfold(there: bool) -> None:
        cell.classes(add="chosen" if there else "", remove="" if there else "chosen")
        inside.clear()
        if there and item.shape == "table":
            with inside:
                folded(context, tables[""], keys, part.basic if part is not None else ())
        inside.set_visibility(there)

    cell = ui.element("div").classes("physics").props(f'data-card="{item.name}"')
    with cell:
        with ui.card().classes("table").props("flat bordered"):
            with ui.element("div").classes("physics-head"):
                ui.html(picture_of(part), sanitize=False).classes("picture").props("aria-hidden=true")
                with ui.element("div").classes("physics-words"):
                    with ui.element("div").classes("physics-title"):
                        ui.label(item.label).classes("table-title")
                        if part is not None and part.title.casefold() != item.label.casefold():
                            ui.label(part.title).classes("hint")
                    ui.label(purpose_of(part, tables)).classes("hint")
                if item.shape == "table":
                    ui.switch(value=context.get(keys) is not None, on_change=lambda e: use(e.value)).props(
                        f'dense data-key="{item.name}" aria-label="{item.label}"'
                    )
            inside = ui.element("div").classes("physics-settings")
            if item.shape == "kinds":
                kinds(context, item, keys)
            elif item.shape != "table":
                nested(context, item, keys)
        refused.slot(item.name)
    unfold(context.get(keys) is not None)


def purpose_of(part: Part | None, tables: Mapping[str, Any]) -> str:
    """What a part answers, one sentence: its own, or the first of what it says of itself or its
    table."""
    said = part.purpose or first_paragraph(type(part)) if part is not None else ""
    return (said or first_paragraph(next(iter(tables.values()), None))).replace("``", "")


def picture_of(part: Part | None) -> str:
    """Picture of a ``part``, which stands in its folder; a neutral one where it has none."""
    package = "" if part is None else type(part).__module__.rpartition(".")[0]
    if part is None or not package:
        return NEUTRAL
    file = resources.files(package).joinpath(f"{part.table}.svg")
    return file.read_text(encoding="utf-8") if file.is_file() else NEUTRAL
