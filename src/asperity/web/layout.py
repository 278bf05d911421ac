"""The frame of every page: steps of the work, undo, copying as Python, command or document, keeping
the session."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from types import MappingProxyType

from nicegui import ui

from ..core.errors import AsperityError
from .draft import forms_of
from .security import FORWARDED
from .session import Place, Session

STEPS = MappingProxyType(
    {
        "surface": ("Surface", "terrain"),
        "prepare": ("Prepare", "tune"),
        "roughness": ("Roughness", "show_chart"),
        "bodies": ("Bodies", "layers"),
        "load": ("Load and physics", "compress"),
        "run": ("Run", "play_arrow"),
        "explore": ("Explore", "travel_explore"),
        "sweep": ("Sweep", "stacked_line_chart"),
    }
)
"""Pages in the order of the work: title and icon."""


@contextmanager
def frame(place: Place, key: str, session: Session, step: str) -> Iterator[None]:
    """Header and steps of the page ``step``; its content is drawn inside."""
    title, _ = STEPS[step]
    ui.page_title(f"{title} – asperity")
    dark = look()
    drawer = ui.left_drawer(value=False, bordered=True).classes("steps").props("width=210 breakpoint=900 show-if-above")
    with drawer, ui.element("nav").props('aria-label="steps"'):
        for number, (name, (text, icon)) in enumerate(STEPS.items(), start=1):
            with ui.link(target=f"/s/{key}/{name}").classes("step" + (" here" if name == step else "")) as link:
                if name == step:
                    link.props('aria-current="page"')
                ui.icon(icon)
                ui.label(f"{number}  {text}")
    with ui.header().classes("bar"):
        ui.button(icon="menu", on_click=lambda: drawer.toggle()).props('flat round dense aria-label="steps"').classes(
            "only-small"
        )
        ui.link("asperity", "/start").classes("brand")
        ui.label(str(session.draft.get("title") or "")).classes("of")
        ui.space()
        ui.button(icon="undo", on_click=lambda: _back(session)).props('flat round dense aria-label="undo"').tooltip(
            "undo"
        )
        ui.button(icon="redo", on_click=lambda: _back(session, again=True)).props(
            'flat round dense aria-label="redo"'
        ).tooltip("redo")
        _copies(session)
        _keeping(place, session)
        _colours_of_the_page(dark)
    main_named(title)
    with ui.element("div").classes(f"content page-{step}"):
        ui.html(f"<h1>{title}</h1>", sanitize=False)
        yield
    own, seen = ui.context.client.id, session.version

    def watch() -> None:
        """Draw the page again when another window has changed the document."""
        nonlocal seen
        if session.version != seen:
            seen = session.version
            if session.changed_by not in ("", own):
                ui.navigate.reload()

    ui.timer(1.0, watch)


def root_path() -> str:
    """Path below which all addresses of the application lie, for elements that do not add it."""
    return str(ui.context.client.request.headers.get(FORWARDED.decode(), ""))


def look() -> ui.dark_mode:
    """Style and scripts of every page, dark or light as it was chosen; gives what changes that."""
    dark = ui.dark_mode(value=LOOKS[_chosen_look()][1])
    ui.colors(primary="#005a9c", positive="#1b6e3c", negative="#a31515", warning="#8a5300", info="#005a9c")
    root = root_path()
    for name in ("viewer.css", "app.css", "problem.css", "measure.css"):
        ui.add_head_html(f'<link rel="stylesheet" href="{root}/static/{name}">')
    for name in ("viewer.js", "app.js", "explore.js", "measure.js"):
        ui.add_head_html(f'<script defer src="{root}/static/{name}"></script>')
    return dark


LOOKS = MappingProxyType({"system": ("as the system", None), "light": ("light", False), "dark": ("dark", True)})
"""What a person chooses between: how it is called, and what it means to the page."""

LOOK_COOKIE = "asperity-look"
"""Keeps the choice in the browser, for the pages of this application only."""


def main_named(title: str) -> None:
    """Name the landmark of the content, which is that of the frame around every page."""
    slot = ui.context.client.content.parent_slot
    if slot is not None:
        slot.parent.props(f'aria-label="{title}"')


def _chosen_look() -> str:
    """The choice of this browser."""
    found = ui.context.client.request.cookies.get(LOOK_COOKIE, "")
    return found if found in LOOKS else "system"


def _colours_of_the_page(dark: ui.dark_mode) -> None:
    """The menu that chooses dark or light."""
    root = ui.context.client.request.headers.get(FORWARDED.decode(), "")

    def choose(name: str) -> None:
        kept = f"{LOOK_COOKIE}={name}; path={root}/; max-age=31536000; samesite=strict"
        ui.run_javascript(f"document.cookie = {kept!r}")
        dark.set_value(LOOKS[name][1])
        for key, item in items.items():
            item.props(f'aria-checked="{str(key == name).lower()}"')

    items = {}
    button = ui.button(icon="contrast").props('flat round dense aria-label="dark or light" aria-haspopup="menu"')
    with button, ui.menu():
        for name, (text, _) in LOOKS.items():
            item = ui.menu_item(text.capitalize(), on_click=lambda name=name: choose(name))
            items[name] = item.props(f'role="menuitemradio" data-look="{name}"')
            item.props(f'aria-checked="{str(name == _chosen_look()).lower()}"')


def _back(session: Session, *, again: bool = False) -> None:
    """Undo or redo, and draw the page again."""
    session.draft.redo() if again else session.draft.undo()
    session.touched()
    ui.navigate.reload()


def _copies(session: Session) -> None:
    """The menu that copies the problem as it stands."""

    def copy(kind: str) -> None:
        forms = forms_of(session.draft.table, session.labels)
        text = {"Python": forms.python, "command": forms.command, "document": forms.document}[kind]
        with ui.dialog() as dialog, ui.card().classes("copy"):
            ui.label(f"The problem as {kind}").classes("table-title")
            code = ui.code(text, language={"Python": "python", "command": "bash", "document": "toml"}[kind])
            code.classes("code").copy_button.props('aria-label="copy"')
            with ui.row():
                ui.button("Copy", icon="content_copy", on_click=lambda: ui.clipboard.write(text)).props("no-caps")
                name = {"Python": "problem.py", "command": "problem.sh", "document": "problem.toml"}[kind]
                ui.button("Save as file", icon="download", on_click=lambda: ui.download.content(text, name)).props(
                    "no-caps outline"
                )
                ui.button("Close", on_click=dialog.close).props("no-caps flat")
        dialog.open()

    with ui.button("Copy as", icon="content_copy").props("flat dense no-caps").classes("copy-as"), ui.menu():
        for kind in ("Python", "command", "document"):
            ui.menu_item(kind, on_click=lambda k=kind: copy(k)).props('role="menuitem"')


def _keeping(place: Place, session: Session) -> None:
    """The dialog that keeps the session in a folder."""

    def keep() -> None:
        try:
            session.save_as(place.allowed(str(folder.value or "")))
        except AsperityError as error:
            ui.notify(str(error), type="negative", multi_line=True)
            return
        ui.notify(f"Kept in {session.folder}", type="positive")
        dialog.close()

    with ui.dialog() as dialog, ui.card():
        ui.label("Keep this session").classes("table-title")
        ui.label("All files, results and the document go into a folder, from where the session can be opened again.")
        folder = ui.input("New or empty folder", placeholder="~/contacts/disk").classes("wide")
        with ui.row():
            ui.button("Keep", on_click=keep).props("no-caps")
            ui.button("Close", on_click=dialog.close).props("no-caps flat")

    def opened() -> None:
        if session.kept:
            ui.notify(f"This session is kept in {session.folder}")
        else:
            dialog.open()

    ui.button(icon="save", on_click=opened).props('flat round dense aria-label="keep the session"').tooltip(
        "keep the session in a folder"
    )


def drop(key: str, name: str, text: str, hint: str) -> None:
    """Area on which files are dropped, or that opens the choice of files."""
    area = ui.element("div").classes("drop")
    with area.props(f'tabindex=0 role="button" data-upload="/upload/{key}" aria-label="{name}"'):
        ui.icon("upload_file").classes("drop-icon")
        ui.label(text)
        ui.label(hint).classes("hint")
        ui.label("").classes("drop-state").props('role="status"')


def failure(text: str) -> None:
    """A message that something could not be done."""
    with ui.card().classes("failure").props('flat bordered role="alert"'):
        ui.label(text)


def rows(pairs: list[list[str]] | list[tuple[str, str]]) -> None:
    """Label and text of each row."""
    with ui.element("dl").classes("rows"):
        for label, text in pairs:
            with ui.element("dt"):
                ui.label(str(label))
            with ui.element("dd"):
                ui.label(str(text))


def text_table(headings: list[str], rows: list[list[str]], *, tall: bool = True) -> None:
    """A table of text that scrolls where it is wide, and unless it may be ``tall`` along its
    rows."""
    box = ui.element("div").classes("spots texts" if tall else "spots").props('tabindex=0 role="region"')
    box.props["aria-label"] = ", ".join(filter(None, headings))
    with box, ui.element("table"):
        with ui.element("thead"), ui.element("tr"):
            for text in headings:
                with ui.element("th").props('scope="col"'):
                    ui.label(text)
        with ui.element("tbody"):
            for row in rows:
                with ui.element("tr"):
                    for text in row:
                        with ui.element("td"):
                            ui.label(text)
