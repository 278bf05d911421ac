"""Page of the bodies: one row for each layer and the base, with its constants as the document
resolves them, beside a drawing to scale."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from nicegui import events, ui

from ..core.errors import AsperityError, InputError
from ..core.units import show
from ..run.document import document_model
from ..solids.library import materials
from ..solids.moduli_file import fitted_file
from .cells import OF_MATERIAL, OWN, START, Cell, material_choice, with_way
from .draft import Keys, moduli_files
from .drawing import drawn, stack_of
from .forms import asked_of
from .layout import drop, rows
from .refused import Refused
from .resolved import SHOWN, Materials, as_tables, is_own, record_of
from .session import Session
from .widgets import Context, entry, form

BODIES = (("body", "Body"), ("counter_body", "Counter body"))

DEFAULT = "rigid (default)"
"""What the document takes for a counter body that is not given."""

HEADINGS = ("", "Material", "Thickness", "E", "ν", "H", "Y", "")

HINT = "From the surface down. Press a value for its source."


def bodies_page(key: str, session: Session) -> None:
    """Body and counter body: rows of layers beside a drawing of each."""
    resolving = Materials(session.folder)
    refused = Refused(session, of_bodies=True)
    for name, title in BODIES:
        BodyForm(session, name, title, resolving, refused)
    _library()
    _own_files(key, session)


class BodyForm:
    """The body ``name`` of the draft: what kind it is, its rows, and the drawing that follows
    them."""

    def __init__(self, session: Session, name: str, title: str, resolving: Materials, refused: Refused) -> None:
        self.session, self.name, self.resolving, self.refused = session, name, resolving, refused
        self.client = ui.context.client
        self.context = Context(session, self.changed)
        item = next(item for item in asked_of(document_model()) if item.name == name)
        assert item.tables is not None
        self.table = item.tables[""]
        self.entries = {entry.name: entry for entry in asked_of(self.table)}
        self.cells: list[Cell] = []
        self.swatches: list[ui.element] = []
        self.beside: list[tuple[Keys, ui.element]] = []
        before = session.draft.get(name)
        if before != as_tables(before):
            session.draft.set((name,), as_tables(before))
        with ui.element("section").classes("body-form").props(f'data-body="{name}" aria-label="{title.lower()}"'):
            ui.html(f"<h2>{title}</h2>", sanitize=False).classes("body-title")
            with ui.element("div").classes("drawing"):
                self.drawing = ui.html(self.drawn(), sanitize=False)
            with ui.element("div").classes("body-rows"):
                self._kind()
                self.rows = ui.element("div").classes("layer-rows")
                refused.slot(name)
        self.redraw()

    # What the draft holds.

    @property
    def value(self) -> dict[str, Any]:
        """Table of the body; empty where none has been chosen."""
        found = self.context.get((self.name,))
        return dict(found) if isinstance(found, dict) else {}

    @property
    def layers(self) -> list[dict[str, Any]]:
        """Tables of its layers, from the surface down."""
        return [dict(layer) for layer in self.value.get("layers") or () if isinstance(layer, dict)]

    def library(self) -> str | None:
        """File of own materials of the body."""
        return str(self.value.get("materials_file") or "") or None

    def kind(self) -> str | None:
        """Which kind of body it is; None where none has been chosen."""
        value = self.value
        if not value:
            return "rigid" if self.name == "counter_body" else None
        if value.get("rigid"):
            return "rigid"
        return "layers" if value.get("layers") else "constants" if is_own(value) else "material"

    def drawn(self) -> str:
        """The drawing as it is now."""
        default = DEFAULT if self.name == "counter_body" else ""
        return drawn(stack_of(self.context.get((self.name,)), self.resolving, default=default), self.name)

    # Changes.

    def changed(self, keys: Keys) -> None:
        """Drawing and values follow the draft; a relaxation takes the place of Young's modulus, and
        names are those of the own file."""
        if keys[-1] == "materials_file":
            self.redraw()
        if keys[-1] == "relaxation" and self.context.get(keys):
            for cell in self.cells:
                if cell.place == (*keys[:-1], "youngs_modulus") and cell.typed is not None:
                    cell.typed.set_value("")
        self.drawing.set_content(self.drawn())
        self._coloured()
        for cell in self.cells:
            cell.update()
        for place, inside in self.beside:
            self._beside(place, inside)
        self.refused.later()

    def put(self, value: dict[str, Any], focus: str = "") -> None:
        """Take ``value`` for the body and draw its rows again; ``focus`` is what the keyboard is on
        then."""
        self.context.set((self.name,), value or None)
        self.toggle.set_value(self.kind())
        self.redraw()
        if focus:
            self.client.run_javascript(f"document.querySelector('{focus}')?.focus()")

    def put_layers(self, layers: list[dict[str, Any]], focus: str = "") -> None:
        """Take ``layers``; without any the base is the body."""
        value = self.value
        shared = {key: value[key] for key in ("materials_file",) if key in value}
        if layers:
            base = value["base"] if "base" in value else {k: v for k, v in value.items() if k in OF_MATERIAL}
            self.put(
                {
                    **shared,
                    **({"name": value["name"]} if "base" in value and "name" in value else {}),
                    "layers": layers,
                    "base": base,
                },
                focus,
            )
        else:
            self.put({**({} if (value.get("base") or {}).get("rigid") else shared), **(value.get("base") or {})}, focus)

    def put_part(self, keys: Keys, part: dict[str, Any]) -> None:
        """Take ``part`` for the table at ``keys``, and draw the rows again where they have other
        entries then."""
        before = self.context.get(keys) or {}
        self.context.set(keys, part if len(keys) > 1 else part or None)
        self.toggle.set_value(self.kind())
        named = all(not is_own(one) and not one.get("rigid") and "top" not in one for one in (before, part))
        if not named or before.keys() - part.keys() - {"material"} or part.get("kind") != before.get("kind"):
            self.redraw()

    def choose(self, word: str | None) -> None:
        """Take another kind of body."""
        if word is None or word == self.kind():
            return
        value = self.value
        part = {k: v for k, v in (value.get("base") or value).items() if k in OF_MATERIAL and k != "rigid"}
        shared = {key: value[key] for key in ("materials_file",) if key in value and word in ("material", "layers")}
        start: dict[str, dict[str, Any]] = {
            "material": part if part.get("material") else {"material": "steel"},
            "constants": with_way(part, OWN, self.library()) if part else dict(START),
            "layers": {"layers": [{"kind": "layer", "material": "DLC"}], "base": part or {"material": "steel"}},
            "rigid": {"rigid": True},
        }
        self.put({**shared, **start[word]})

    # What is shown.

    def _kind(self) -> None:
        words = {"material": "A material", "constants": "Own constants", "layers": "Layers", "rigid": "Rigid"}
        self.toggle = ui.toggle(words, value=self.kind(), on_change=lambda e: self.choose(e.value))
        self.toggle.props(f'no-caps dense data-key="{self.name}.kind"')

    def redraw(self) -> None:
        """Draw all rows again."""
        self.cells, self.swatches, self.beside = [], [], []
        self.rows.clear()
        with self.rows:
            if self.kind() is None:
                ui.label("Choose above what this body is.").classes("hint")
            elif self.kind() == "rigid":
                ui.label("It does not deform.").classes("hint")
            else:
                self._rows()
        self._coloured()

    def _rows(self) -> None:
        layers = self.layers
        ui.label(HINT).classes("hint")
        with ui.element("div").classes("layer-row layer-head").props("aria-hidden=true"):
            for text in HEADINGS:
                ui.label(text)
        for number, layer in enumerate(layers):
            self._layer(number, layer, len(layers))
        below: Keys = (self.name, "base") if layers else (self.name,)
        self._row(below, "base" if layers else "body", lambda: ui.label("any depth").classes("hint depth"))
        with ui.row().classes("adders"):
            for kind, text in (("layer", "Add a layer"), ("linear", "Add a graded layer")):
                ui.button(text, icon="add", on_click=lambda k=kind: self.put_layers([*self.layers, {"kind": k}])).props(
                    f'outline dense no-caps size=sm data-add="{kind}"'
                )
        if self.session.labels or self.library():
            with ui.expansion("Own materials from a file", value=bool(self.library())).classes("wide"):
                entry(self.context, self.entries["materials_file"], (self.name, "materials_file"))

    def _layer(self, number: int, layer: dict[str, Any], count: int) -> None:
        keys: Keys = (self.name, "layers", number)
        tables = self.entries["layers"].tables
        assert tables is not None
        kind = str(layer.get("kind", "layer"))
        inside = {item.name: item for item in asked_of(tables.get(kind, tables["layer"]))}

        def thickness() -> None:
            made = entry(self.context, inside["thickness"], (*keys, "thickness"), bare=True)
            made.props["aria-label"] = f"Thickness of layer {number + 1}"
            made.props('placeholder="needed"')

        moves = (number, count)
        if kind == "layer":
            self._row(keys, f"layer {number + 1}", thickness, moves)
            return
        with ui.element("div").classes("layer-row graded").props(f'data-row="{_dotted(keys)}"'):
            self._swatch()
            laws = {word: f"graded, {word}" for word in tables if word != "layer"}
            ui.select(
                laws,
                value=kind,
                on_change=lambda e: self.put_part(keys, _of_law({**self.context.get(keys), "kind": e.value})),
            ).props(
                f'dense options-dense data-key="{_dotted((*keys, "kind"))}" aria-label="Law of the grading"'
            ).classes("field of-material")
            with ui.element("div").classes("cell").props('data-symbol="Thickness"'):
                thickness()
            ui.label("from top to bottom, see the two rows below").classes("hint spanned")
            details = self._actions(keys, moves)
        self._details(details, keys, frozenset({"kind", "thickness", "top", "bottom"}))
        for end in ("top", "bottom"):
            self._row((*keys, end), end, lambda: None)

    def _row(
        self,
        keys: Keys,
        text: str,
        thickness: Callable[[], Any],
        moves: tuple[int, int] | None = None,
    ) -> None:
        """One material: of a layer that can be moved, of the base or the whole body, or of one end
        of a graded layer."""
        part = self.context.get(keys) or {}
        within = keys[-1] in ("top", "bottom")
        with (
            ui.element("div")
            .classes("layer-row" + (" end" if within else ""))
            .props(f'role="group" aria-label="{text}" data-row="{_dotted(keys)}"')
        ):
            ui.label(text).classes("hint end-name") if within else self._swatch()
            with ui.element("div").classes("cell of-material").props('data-symbol="Material"'):
                material_choice(
                    self.context,
                    self.resolving,
                    keys,
                    self.library(),
                    lambda way: self.put_part(keys, self._with_way(keys, way)),
                )
            with ui.element("div").classes("cell").props(f'data-symbol="{"" if within else "Thickness"}"'):
                thickness()
            if part.get("rigid"):
                ui.label("does not deform").classes("hint spanned")
            else:
                for key in SHOWN:
                    own = lambda: self.put_part(keys, self._with_way(keys, OWN))  # noqa: E731
                    self.cells.append(Cell(self.context, self.resolving, keys, key, self.library, own))
            if part.get("rigid"):
                return
            details = self._actions(keys, moves)
        leave = frozenset({"kind", "thickness", "material", "rigid", "layers", "base", "materials_file", *SHOWN})
        if not is_own(part):
            leave |= {"relaxation", "name"}
        self._details(details, keys, leave)

    def _with_way(self, keys: Keys, way: str | None) -> dict[str, Any]:
        return with_way(self.context.get(keys) or {}, way, self.library())

    def _swatch(self) -> None:
        self.swatches.append(ui.element("span").classes("swatch").props("aria-hidden=true"))

    def _coloured(self) -> None:
        """Swatches as the drawing has them."""
        stack = stack_of(self.value, self.resolving)
        for swatch, piece in zip(self.swatches, (*stack.layers, stack.base), strict=False):
            top, bottom = piece.colours if piece.state == "chosen" else ("transparent", "transparent")
            swatch.style(f"background: linear-gradient({top}, {bottom})")

    def _actions(self, keys: Keys, moves: tuple[int, int] | None) -> ui.element:
        """Buttons at the end of a row; gives the one that opens its details."""
        with ui.element("div").classes("actions"):
            if moves is not None:
                number, count = moves
                for icon, by, text in (("arrow_upward", -1, "earlier"), ("arrow_downward", 1, "later")):
                    made = ui.button(icon=icon, on_click=lambda b=by: self._moved(number, b))
                    made.props(f'flat dense round size=sm aria-label="move {text}" data-move="{_dotted(keys)}.{text}"')
                    made.set_enabled(0 <= number + by < count)
                without = lambda: self.put_layers([v for i, v in enumerate(self.layers) if i != number])  # noqa: E731
                ui.button(icon="close", on_click=without).props(
                    f'flat dense round size=sm aria-label="remove" data-remove="{_dotted(keys)}"'
                )
            return ui.button("details", icon="expand_more").props(
                f'flat dense no-caps size=sm data-details="{_dotted(keys)}" aria-expanded=false'
            )

    def _moved(self, number: int, by: int) -> None:
        layers = self.layers
        if 0 <= number + by < len(layers):
            layers[number], layers[number + by] = layers[number + by], layers[number]
            word = "earlier" if by < 0 else "later"
            self.put_layers(layers, f'[data-move="{self.name}.layers.{number + by}.{word}"]')

    def _details(self, button: Any, keys: Keys, leave: frozenset[str]) -> None:
        """All else of a row, drawn when its ``button`` is pressed."""
        model = self._model(keys)
        inside = ui.element("div").classes("details")
        inside.set_visibility(False)

        def fold() -> None:
            there = not inside.visible
            if there and not inside.default_slot.children:
                with inside:
                    self._library_again(keys)
                    form(self.context, model, keys, leave)
                    self.beside.append((keys, ui.element("div")))
                    self._beside(*self.beside[-1])
            inside.set_visibility(there)
            button.props(f"icon={'expand_less' if there else 'expand_more'} aria-expanded={str(there).lower()}")

        button.on_click(fold)
        value = self.context.get(keys) or {}
        if "top" not in value and value.get("kind", "layer") == "layer" and (value.get("relaxation") or {}).get("kind"):
            fold()

    def _model(self, keys: Keys) -> Any:
        """Table of the form of the row at ``keys``."""
        if len(keys) == 1:
            return self.table
        base = next(iter((self.entries["base"].tables or {}).values()))
        if keys[1] == "base" or keys[-1] in ("top", "bottom"):
            return base
        tables = self.entries["layers"].tables or {}
        return tables[str((self.context.get(keys) or {}).get("kind", "layer"))]

    def _library_again(self, keys: Keys) -> None:
        """Takes the material of the library whose name the own constants have."""
        part = self.context.get(keys) or {}
        record = record_of({"material": part.get("name")}, self.library()) if is_own(part) else None
        if record is not None:
            way = record.name
            ui.button(
                f"Give all values back to {way} of the library",
                icon="undo",
                on_click=lambda: self.put_part(keys, self._with_way(keys, way)),
            ).props(f'flat dense no-caps data-back="{_dotted(keys)}"').classes("back")

    def _beside(self, keys: Keys, inside: ui.element) -> None:
        """Show ``inside`` what the library knows of a material beside what its row has."""
        found = self.resolving.of(self.context.get(keys) or {}, self.library()).values.values()
        known = [v for v in found if v.key not in SHOWN and v.text and v.source and not v.own]
        inside.clear()
        if known:
            with inside:
                ui.label("Of the library").classes("table-title")
                rows([(value.label, f"{value.text} – {value.source}") for value in known])


def _dotted(keys: Keys) -> str:
    return ".".join(map(str, keys))


def _of_law(layer: dict[str, Any]) -> dict[str, Any]:
    """A graded layer without what its law has not."""
    return {key: value for key, value in layer.items() if key != "exponent" or layer["kind"] == "power"}


def _library() -> None:
    """All materials with the source of every value."""
    with (
        ui.expansion("Materials of the library and their sources").classes("wide"),
        ui.element("div").classes("scroll"),
    ):
        for record in materials():
            with ui.element("div").classes("material"):
                constants = f"E {show(record.youngs_modulus.value, 'Pa', 3)}, ν {record.poisson_ratio.value:g}"
                constants += f", H {show(record.hardness.value, 'Pa', 3)}" if record.hardness else ""
                ui.label(f"{record.name}: {constants}").classes("table-title")
                for text in (record.note, *record.sources):
                    if text:
                        ui.label(text).classes("hint")


def _own_files(key: str, session: Session) -> None:
    """Takes a file of own materials, for every body that names one, or of measured moduli, for
    every relaxation that is measured.

    The file is read once, so that it is refused here.
    """

    def uploaded(event: events.GenericEventArguments) -> None:
        path = str(event.args.get("path") if isinstance(event.args, dict) else "")
        if path not in session.labels:
            return
        bodies = {name: session.draft.get(name) for name in ("body", "counter_body")}
        places: list[Keys]
        try:
            if path.endswith(".toml"):
                materials(path)
                named = [
                    n for n, body in bodies.items() if isinstance(body, dict) and {"material", "layers"} & body.keys()
                ]
                places = [(name, "materials_file") for name in named]
            else:
                fitted_file(Path(path), poisson_ratio=0.5)
                places = [keys for name, body in bodies.items() for keys in moduli_files(body, (name,))]
                if not places:
                    raise InputError(
                        "relaxation of a body must be measured to take a file of moduli, but none is. Choose "
                        "own constants and the relaxation measured first. A file of materials ends in .toml."
                    )
        except AsperityError as error:
            ui.notify(session.said(str(error)), type="negative", multi_line=True)
            return
        for keys in places:
            session.draft.set(keys, path)
        session.touched()
        ui.navigate.reload()

    text = "Drop a file of own materials or of moduli here, or press to choose"
    hint = (
        "TOML with a table for each material; or CSV with frequency, storage and loss modulus, or with time and "
        "relaxation modulus or creep compliance, for a relaxation that is measured; see the how-to"
    )
    drop(key, "drop a file of own materials or of moduli, or choose it", text, hint)
    ui.on("asperity-uploaded", uploaded)
