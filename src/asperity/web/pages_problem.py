"""Pages on the problem: bodies with their layers, and load, boundary, law and the settings of every
part."""

from __future__ import annotations

import html
import math
from contextlib import suppress
from pathlib import Path
from typing import Any

from nicegui import events, ui

from ..core.errors import AsperityError, InputError
from ..core.units import parse, show
from ..io.schemas.bodies import BESIDE, body_from_text
from ..run.document import document_model
from ..solids.library import materials
from ..solids.moduli_file import fitted_file
from .draft import Keys, moduli_files
from .forms import Asked, asked_of
from .layout import drop
from .refused import Refused
from .session import Session
from .widgets import Context, form, listed, nested

OF_PAGES = frozenset({"version", "title", "surface", "counter_surface", "body", "counter_body"})
"""Keys of the document that other pages fill."""

FILLS = ("#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00")
"""Colours of layers in the drawing."""


def bodies_page(key: str, session: Session) -> None:
    """Body and counter body: one material, layers on a base, or rigid, with a drawing to scale."""
    drawings: dict[str, Any] = {}
    refused = Refused(session, of_bodies=True)

    def changed(keys: Keys) -> None:
        for draw in drawings.values():
            draw.refresh()
        refused.later()

    context = Context(session, changed)
    model = document_model()
    for name, title in (("body", "Body"), ("counter_body", "Counter body")):
        item = next(item for item in asked_of(model) if item.name == name)
        with ui.element("div").classes("two"):
            with ui.element("section"):
                ui.html(f"<h2>{title}</h2>", sanitize=False)
                _body(context, item, name)
                refused.slot(name)

            @ui.refreshable
            def drawing(name: str = name) -> None:
                ui.html(drawn(session.draft.get(name), title=name.replace("_", " ")), sanitize=False)

            with ui.element("section").classes("drawing"):
                drawing()
            drawings[name] = drawing
    _library()
    _own_files(key, session)


def _body(context: Context, item: Asked, name: str) -> None:
    """Which kind of body it is, and the form of that kind."""
    assert item.tables is not None
    table = item.tables[""]
    entries = {entry.name: entry for entry in asked_of(table)}
    own = frozenset(entries) - {"youngs_modulus", "relaxation", "poisson_ratio", *BESIDE, "name"}

    def kind() -> str:
        value = context.get((name,))
        if isinstance(value, str):
            try:
                value = body_from_text(value)
            except AsperityError:
                value = {"material": value}
            context.session.draft.set((name,), value)
        if not isinstance(value, dict):
            return "rigid" if name == "counter_body" else ""
        found = (("rigid", "rigid"), ("layers", "layers"), ("youngs_modulus", "constants"), ("relaxation", "constants"))
        return next((word for entry, word in found if value.get(entry)), "constants" if "name" in value else "material")

    def choose(word: str) -> None:
        start: dict[str, Any] = {
            "material": {"material": "steel"},
            "constants": {"name": "own material"},
            "layers": {"layers": [{"kind": "layer", "material": "DLC"}], "base": {"material": "steel"}},
            "rigid": {"rigid": True},
        }
        context.set((name,), start[word])
        inside.refresh()

    @ui.refreshable
    def inside() -> None:
        word = kind()
        if word == "material":
            form(context, table, (name,), frozenset(entries) - {"material", *BESIDE})
        elif word == "constants":
            form(context, table, (name,), own)
        elif word == "layers":
            ui.label("Layers, from the surface down").classes("table-title")
            listed(context, entries["layers"], (name, "layers"), titled=False)
            ui.label("Base, below all layers").classes("table-title")
            form(context, next(iter((entries["base"].tables or {}).values())), (name, "base"))
        if word in ("material", "layers"):
            with ui.expansion("Own materials from a file").classes("wide"):
                form(context, table, (name,), frozenset(entries) - {"materials_file"})

    words = {"material": "A material", "constants": "Own constants", "layers": "Layers", "rigid": "Rigid"}
    ui.toggle(words, value=kind() or None, on_change=lambda e: choose(e.value)).props(
        f'no-caps dense data-key="{name}.kind"'
    )
    inside()


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


def drawn(body: Any, *, title: str) -> str:
    """Drawing of a body to scale as SVG; what has no thickness yet is said."""
    layers, base = _stack(body)
    width, height, left = 320.0, 260.0, 8.0
    total = sum(thick for _, thick, _ in layers if math.isfinite(thick))
    under = 0.35 * total if total else 1.0
    scale = (height - 30.0) / ((total + under) or 1.0)
    parts = [
        (
            f'<svg viewBox="0 0 {width + 210:.0f} {height:.0f}" role="img" aria-label="{html.escape(title)} to '
            'scale" class="stack">'
        )
    ]
    y = 14.0
    for number, (text, thick, slips) in enumerate(layers):
        tall = max(thick * scale, 1.0) if math.isfinite(thick) else 6.0
        parts.append(
            f'<rect x="{left}" y="{y:.2f}" width="{width - 2 * left}" height="{tall:.2f}" '
            f'fill="{FILLS[number % 6]}" fill-opacity="0.75"/>'
        )
        label = f"{text}, {show(thick, 'm', 4)}" if math.isfinite(thick) else f"{text}, thickness missing"
        parts.append(f'<text x="{width + 4}" y="{y + max(tall / 2 + 4, 9):.1f}">{html.escape(label)}</text>')
        y += tall
        if slips:
            parts.append(f'<line x1="{left}" x2="{width - left}" y1="{y:.2f}" y2="{y:.2f}" class="slips"/>')
    parts.append(
        f'<rect x="{left}" y="{y:.2f}" width="{width - 2 * left}" height="{max(height - 4 - y, 12):.2f}" class="base"/>'
    )
    parts.append(f'<text x="{width + 4}" y="{min(y + 24, height - 8):.1f}">{html.escape(base)}</text></svg>')
    return "".join(parts)


def _stack(body: Any) -> tuple[list[tuple[str, float, bool]], str]:
    """Name, thickness and whether it slips of every layer, and the name of the base."""
    if isinstance(body, str):
        try:
            body = body_from_text(body)
        except AsperityError:
            return [], body
    if not isinstance(body, dict):
        return [], "rigid" if body is None else "?"
    found = []
    for layer in body.get("layers") or ():
        if isinstance(layer, dict):
            graded = " to ".join(_name(layer[key]) for key in ("top", "bottom") if key in layer)
            thickness = math.nan
            with suppress(AsperityError):
                thickness = parse(str(layer.get("thickness", "")), "length", "")
            slips = layer.get("interface") == "frictionless"
            found.append((graded or _name(layer), thickness if thickness >= 0.0 else math.nan, slips))
    return found, _name(body.get("base") if found else body)


def _name(part: Any) -> str:
    if not isinstance(part, dict):
        return str(part or "base")
    if part.get("rigid"):
        return "rigid"
    named = part.get("name") or part.get("material")
    if part.get("relaxation"):
        return str(named or "viscoelastic")
    return str(named or (f"E {part['youngs_modulus']}" if part.get("youngs_modulus") else "material missing"))


def load_page(key: str, session: Session) -> None:
    """Load and history, boundary and law, and every part that declares settings."""
    refused = Refused(session)
    context = Context(session, refused.later)
    model = document_model()
    core = ("control", "boundary", "law", "solver")
    entries = {item.name: item for item in asked_of(model, OF_PAGES)}
    with ui.element("div").classes("two"):
        with ui.element("section"):
            refused.slot("")
            for name in core:
                nested(context, entries[name], (name,))
                refused.slot(name)
        with ui.element("section"):
            ui.label("Physics of the interface and analyses").classes("table-title")
            for name, item in entries.items():
                if name not in core:
                    nested(context, item, (name,))
                    refused.slot(name)
