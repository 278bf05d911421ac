"""Forms on a page, drawn from ``forms``: every entry writes into the draft at once and says what is
wrong with it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from nicegui import ui

from ..core.errors import AsperityError
from ..core.settings import Settings
from ..core.words import first_paragraph
from ..run.document import names_file
from ..solids.library import liquids, materials
from .draft import Keys
from .forms import Asked, asked_of
from .places import Places
from .session import Session
from .starting import Starting, starting


@dataclass(frozen=True)
class Context:
    """What entries write to: the ``session``, what is called after a change of the ``keys``, what
    fills a table of a surface that is chosen, and where it stands what is wrong."""

    session: Session
    changed: Callable[[Keys], None]
    fills: Starting | None = None
    places: Places = field(default_factory=Places)

    def get(self, keys: Keys) -> Any:
        """What the draft holds at ``keys``."""
        return self.session.draft.get(*keys)

    def set(self, keys: Keys, value: Any) -> None:
        """Write ``value`` at ``keys``, if it is another one, and tell."""
        if self.get(keys) != value:
            self.session.draft.set(keys, value)
            self.session.touched(ui.context.client.id)
            self.changed(keys)


def form(context: Context, model: type[Settings], keys: Keys, leave: frozenset[str] = frozenset()) -> None:
    """Entries for the table ``model`` at ``keys``: what must be given first, what has tables of its
    own last."""
    _entries(context, asked_of(model, leave), keys)


def _entries(context: Context, entries: Sequence[Asked], keys: Keys) -> None:
    plain = [item for item in entries if item.tables is None]
    with ui.element("div").classes("fields"):
        for item in sorted(plain, key=lambda item: not item.required):
            entry(context, item, (*keys, item.name))
    for item in entries:
        if item.tables is not None:
            nested(context, item, (*keys, item.name))


def folded(context: Context, model: type[Settings], keys: Keys, basic: tuple[str, ...] = ()) -> None:
    """Entries for the table ``model`` at ``keys``: what must be given and what is ``basic`` first,
    the rest folded under details, which stand open where one of them has been given."""
    entries = asked_of(model)
    first = [item for item in entries if item.required or item.name in basic] or list(entries[:FIRST])
    rest = [item for item in entries if item not in first]
    _entries(context, first, keys)
    if rest:
        given = any(context.get((*keys, item.name)) is not None for item in rest)
        dotted = ".".join(map(str, keys))
        with ui.expansion("Details", value=given).classes("wide details-fold").props(f'dense data-details="{dotted}"'):
            ui.label(first_paragraph(model).replace("``", "")).classes("hint")
            form(context, model, keys, frozenset(item.name for item in first))


FIRST = 3
"""Entries that stand before the details of a table of which none must be given and none is
basic."""


def entry(context: Context, item: Asked, keys: Keys, *, bare: bool = False) -> Any:
    """One number, text, choice or flag; a ``bare`` number or text shows no label, which stands
    above it."""
    value = context.get(keys)
    made: Any
    if (item.name in LIBRARIES and item.shape == "text") or names_file(item.name):
        made = _chosen(context, item, keys, value)
    elif item.shape == "flag":
        default = item.parameter.default is True
        current = default if value is None else value in (True, "true", "True")
        made = ui.switch(
            item.label, value=current, on_change=lambda e: context.set(keys, None if e.value is default else e.value)
        )
    elif item.shape == "choice":
        made = ui.select(
            list(item.choices),
            label=f"{item.label} ({item.hint})" if item.hint else item.label,
            value=value if value in item.choices else None,
            clearable=not item.required,
            on_change=lambda e: context.set(keys, e.value),
        )
    else:
        made = ui.input(
            None if bare else item.label + (" *" if item.required else ""),
            value=item.text_of(value),
            placeholder=item.hint,
            validation=item.problem,
            on_change=lambda e: context.set(keys, (e.value or "").strip() or None),
        ).props("debounce=350 stack-label")
    made.props(f'data-key="{".".join(map(str, keys))}" dense').classes("field")
    made.props["aria-label"] = f"{item.label}. {item.help}" if item.help else item.label
    context.places.entries[keys] = made
    if item.help:
        with made:
            ui.tooltip(item.help)
    return made


def _chosen(context: Context, item: Asked, keys: Keys, value: Any) -> Any:
    """Choice of a name of the library, or of a file of the session."""
    named = not names_file(item.name)
    own = str(context.get((keys[0], "materials_file")) or "") or None
    options = {name: name for name in LIBRARIES[item.name](own)} if named else dict(context.session.labels)
    if value and value not in options:
        options[value] = str(value)
    made = ui.select(
        options,
        label=item.label + (" *" if item.required else ""),
        value=value,
        clearable=True,
        with_input=named,
        on_change=lambda e: context.set(keys, e.value),
    )
    if not named and not options:  # nothing to choose from yet, and nothing that could be guessed
        made.props["hint"] = "Drop the file on this page first."
    return made


def _material_names(own: str | None) -> list[str]:
    try:
        return [record.name for record in materials(own)]
    except AsperityError:
        return [record.name for record in materials()]


def _liquid_names(own: str | None) -> list[str]:
    return [record.name for record in liquids()]


LIBRARIES = MappingProxyType({"material": _material_names, "liquid": _liquid_names})
"""Names of the library for keys that take them."""


def nested(context: Context, item: Asked, keys: Keys) -> None:
    """A table, one of several kinds of tables, or a list of them."""
    if item.shape == "list":
        listed(context, item, keys)
    elif item.shape == "kinds":
        kinds(context, item, keys)
    else:
        optional(context, item, keys)


def optional(context: Context, item: Asked, keys: Keys) -> None:
    """A table that is there or not; one that every document has stands open."""
    assert item.tables is not None
    word, model = next(iter(item.tables.items()))
    always = item.required or item.parameter.default is not None

    @ui.refreshable
    def inside() -> None:
        value = context.get(keys)
        if always or value is not None:
            said = isinstance(value, dict) and word and value.get("kind") == word  # the only kind, which is given
            form(context, model, keys, frozenset({"kind"} if said else ()))

    def use(there: bool) -> None:
        context.set(keys, {} if there else None)
        inside.refresh()

    with ui.card().classes("table").props("flat bordered"):
        if always:
            ui.label(item.label).classes("table-title")
        else:
            ui.switch(item.label, value=context.get(keys) is not None, on_change=lambda e: use(e.value)).props(
                f'data-key="{".".join(map(str, keys))}"'
            ).classes("table-title")
        ui.label(item.help or first_paragraph(model).replace("``", "")).classes("hint")
        inside()


def kinds(
    context: Context, item: Asked, keys: Keys, leave: frozenset[str] = frozenset(), only: tuple[str, ...] = ()
) -> None:
    """A table of one of several kinds; what the kinds share is kept when another one is chosen."""
    assert item.tables is not None
    tables, tag = item.tables, item.tag
    words = [word for word in tables if not only or word in only]

    async def choose(word: str | None) -> None:
        extent = None if word is None or context.fills is None else await context.fills.extent(keys)
        before = context.get(keys)
        before = before if isinstance(before, dict) else {}
        made: dict[str, Any] | None = None
        if word is not None and context.fills is not None and extent is not None:
            made = context.fills.chosen(keys, tables, tag, word, before, extent)
        elif word is not None:
            made = {**{k: v for k, v in before.items() if k in tables[word].model_fields}, tag: word}
        context.set(keys, made)
        inside.refresh()

    @ui.refreshable
    def inside() -> None:
        word = str((context.get(keys) or {}).get(tag))
        if word in tables:
            ui.label(first_paragraph(tables[word]).replace("``", "")).classes("hint")
            form(context, tables[word], keys, leave | {tag})

    with ui.card().classes("table").props("flat bordered"):
        current = (context.get(keys) or {}).get(tag)
        ui.select(
            {word: word.replace("_", " ") for word in words},
            label=item.label,
            value=current if current in words else None,
            clearable=not item.required,
            with_input=len(words) > 8,
            on_change=lambda e: choose(e.value),
        ).props(f'dense data-key="{".".join(map(str, (*keys, tag)))}"').classes("field wide")
        context.places.slot(keys)
        inside()


def listed(
    context: Context,
    item: Asked,
    keys: Keys,
    *,
    titled: bool = True,
    changed: Callable[[], None] | None = None,
    head: Callable[[int, str], None] | None = None,
) -> None:
    """A list of tables: added, moved and removed; ``head`` draws the name of one."""
    assert item.tables is not None
    tables, tag = item.tables, item.tag

    def items() -> list[Any]:
        found = context.get(keys)
        return list(found) if isinstance(found, list | tuple) else []

    def put(new: list[Any]) -> None:
        context.set(keys, new or None)
        inside.refresh()
        if changed is not None:
            changed()

    async def add(word: str) -> None:
        new = {tag: word} if tag and len(tables) > 1 else {}
        if context.fills is None:
            put([*items(), new])
            return
        async with context.fills.turn:
            new |= starting(tables[word], await context.fills.extent(keys))
            put([*items(), new])

    def moved(number: int, by: int) -> None:
        new = items()
        if 0 <= number + by < len(new):
            new[number], new[number + by] = new[number + by], new[number]
            put(new)

    @ui.refreshable
    def inside() -> None:
        present = items()
        for number, value in enumerate(present):
            word = str(value.get(tag, next(iter(tables)))) if isinstance(value, dict) else next(iter(tables))
            with ui.card().classes("table item").props("flat bordered"):
                with ui.row().classes("item-head"):
                    text = f"{number + 1}. {word.replace('_', ' ') or item.label}"
                    head(number, text) if head is not None else ui.label(text).classes("table-title")
                    ui.space()
                    for icon, by, way in (("arrow_upward", -1, "earlier"), ("arrow_downward", 1, "later")):
                        ui.button(icon=icon, on_click=lambda n=number, b=by: moved(n, b)).props(
                            f'flat dense round size=sm aria-label="move {way}"'
                        )
                    ui.button(
                        icon="close", on_click=lambda n=number: put([v for i, v in enumerate(items()) if i != n])
                    ).props('flat dense round size=sm aria-label="remove"')
                model = tables.get(word, next(iter(tables.values())))
                ui.label(first_paragraph(model).replace("``", "")).classes("hint")
                if isinstance(value, str):  # the whole table as one line of text
                    ui.input(
                        item.label, value=value, on_change=lambda e, n=number: context.set((*keys, n), e.value or "")
                    ).props("dense debounce=350 stack-label").classes("wide")
                else:
                    context.places.slot((*keys, number))
                    form(context, model, (*keys, number), frozenset({tag}))

    if titled:
        ui.label(item.label).classes("table-title")
    inside()
    with ui.row().classes("adders"):
        for word in tables:
            ui.button(
                word.replace("_", " ") or "add",
                icon="add",
                on_click=lambda w=word: add(w),
            ).props(f'outline dense no-caps size=sm data-add="{word or item.name}"')
