"""Tools on the map of a surface: profiles with two cursors, regions that are masked, and which step
of the preparation is looked at."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from nicegui import events, ui

from ..core.errors import AsperityError
from ..core.units import show
from ..core.values import Number
from . import maps
from .draft import Draft
from .measuring import (
    Point,
    Section,
    drawn_range,
    drawn_region,
    line_scan,
    place_of_mask,
    reading,
    section,
    with_region,
    without_region,
)
from .widgets import Context

ON_MAPS = MappingProxyType(
    {
        "zoom": ("Zoom", "zoom_in", "Drag a rectangle to come nearer; press twice to see all."),
        "line": ("Profile", "timeline", "Drag on the map for another line, or its ends; Shift keeps it straight."),
        "rectangle": ("Mask a rectangle", "crop_square", "Drag a rectangle: points inside are taken as missing."),
        "ellipse": ("Mask an ellipse", "panorama_fish_eye", "Drag an ellipse; with Shift it is a circle."),
        "polygon": (
            "Mask a polygon",
            "pentagon",
            "Press at each corner, twice at the last; Escape gives up.",
        ),
        "freehand": ("Mask free-hand", "gesture", "Draw around what is to be masked."),
    }
)
"""Tools of a map by their names: label, icon and how they are used."""

ON_LINES = MappingProxyType(
    {
        "zoom": ON_MAPS["zoom"],
        "line": ("Cursors", "timeline", "Drag the cursors A and B, or move them with the arrow keys."),
        "range": ("Mask a range", "swap_horiz", "Drag along the curve: points in between are taken as missing."),
    }
)
"""The same of a line scan."""


class Heard:
    """Messages of the pictures of a page, each to what it belongs to."""

    def __init__(self) -> None:
        self._by_key: dict[str, Callable[[dict[str, Any]], None]] = {}
        ui.on("asperity-measure", self._heard)

    def of(self, key: str, handler: Callable[[dict[str, Any]], None]) -> None:
        """Let ``handler`` have the messages of the picture ``key``."""
        self._by_key[key] = handler

    def _heard(self, event: events.GenericEventArguments) -> None:
        told = event.args if isinstance(event.args, dict) else {}
        handler = self._by_key.get(str(told.get("key")))
        if handler is not None:
            handler(told)


class Picture:
    """A picture that is measured on: what its drawing shows, and the heights behind it."""

    def __init__(self, key: str, file: Path, name: str = "") -> None:
        self.key, self.file, self.name = key, file, name
        self.answer: dict[str, Any] = {}
        self.client = ui.context.client

    @property
    def there(self) -> bool:
        """Whether a surface is shown."""
        return "full" in self.answer

    @property
    def is_line(self) -> bool:
        """Whether it is a line scan."""
        return bool(self.answer["full"][1] == 1)

    @property
    def size(self) -> Point:
        """Extent of the surface along x and y in m."""
        return self.answer["size"][0], self.answer["size"][1]

    def heights(self) -> Any:
        """All heights (nx, ny) in m, as they lie in the file."""
        return np.load(self.file, mmap_mode="r", allow_pickle=False)

    def push(self, **state: Any) -> None:
        """Let the drawing show another ``state``."""
        if not self.client.is_deleted:
            self.client.run_javascript(f"AsperityMeasure.set({json.dumps(self.key)}, {json.dumps(state)})")

    def frame(self, kind: str) -> Any:
        """Element in which the picture is drawn; a ``map`` or a ``curve``."""
        return ui.element("div").classes("measured").props(f'data-measure="{self.key}" data-kind="{kind}"')


class Toolbar:
    """Buttons that choose what the mouse does on a picture; without those of masks unless
    ``masking``."""

    def __init__(self, picture: Picture, chosen: Callable[[str], None], *, masking: bool = True) -> None:
        self.picture, self.tool, self._chosen = picture, "zoom", chosen
        self._buttons: dict[str, Any] = {}
        tools = ON_LINES if picture.is_line else ON_MAPS
        self._tools = {name: text for name, text in tools.items() if masking or name in ("zoom", "line")}
        with ui.element("div").classes("map-tools").props('role="toolbar" aria-label="tools of the map"'):
            for name, (label, icon, _) in self._tools.items():
                text = label if name in ("zoom", "line") else ""
                if name in ("rectangle", "range"):
                    ui.label("Mask:").classes("hint")
                button = ui.button(text, icon=icon, color=None, on_click=lambda n=name: self.choose(n))
                button.props(f'flat dense no-caps size=sm aria-label="{label}" data-tool="{name}"')
                self._buttons[name] = button
                if not text:
                    button.tooltip(label)
            self._hint = ui.label().classes("hint map-hint").props('role="status"')
        self._show()

    def choose(self, name: str) -> None:
        """Let the mouse do that."""
        self.tool = name if name in self._tools else "zoom"
        self._show()
        self._chosen(self.tool)

    def _show(self) -> None:
        for name, button in self._buttons.items():
            button.props(f"aria-pressed={'true' if name == self.tool else 'false'}")
        self._hint.set_text(self._tools[self.tool][2])
        self.picture.push(tool=self.tool)


class Profiles:
    """The profile along a line, with two cursors and what is between them; the same line on all
    ``pictures`` of a page, whose first is measured on."""

    def __init__(self, heard: Heard, name: str, pictures: Sequence[Picture]) -> None:
        self.pictures, self._name, self._heard = pictures, name, heard
        self.on = False
        self.line: tuple[float, float, float, float] | None = None
        self.shares = (0.25, 0.75)
        self.found: Section | None = None
        self._fields: dict[str, Any] = {}
        self._setting, self._drawn = False, ""
        self.curve = Picture(f"curve-{name}", pictures[0].file)
        heard.of(self.curve.key, self.told)
        self.box = ui.element("section").classes("profile")
        self.box.set_visibility(False)

    def use(self, there: bool) -> None:
        """Show a profile, or none."""
        if there != self.on:
            self.on = there
            self.draw()

    def told(self, told: dict[str, Any]) -> None:
        """What a person did on a picture: the line or the cursors moved."""
        if told.get("what") == "line" and _finite(told.get("line"), 4):
            self.line = tuple(map(float, told["line"]))  # type: ignore[assignment]
            self.use(True)
            self.measure()
        elif told.get("what") == "cursors" and _finite(told.get("cursors"), 2) and self.found is not None:
            self._cursors_at(*map(float, told["cursors"]))

    def draw(self) -> None:
        """Draw it again, of what the pictures now show."""
        main = self.pictures[0]
        kind = "" if not (self.on and main.there) else "line scan" if main.is_line else "map"
        if kind != self._drawn:
            self._drawn = kind
            self.box.set_visibility(bool(kind))
            self.box.clear()
            self._fields.clear()
            if kind:
                with self.box:
                    self._panel(main)
        if not kind:
            self.found = None
            for picture in self.pictures:
                picture.push(line=None, marks=[], cursors=None, dots=[])
        self.measure()

    def _panel(self, main: Picture) -> None:
        with ui.row().classes("item-head"):
            ui.label("Between the cursors" if main.is_line else "Profile along the line").classes("table-title")
            ui.space()
            ui.button("Copy", icon="content_copy", on_click=self._copy).props("flat dense no-caps size=sm")
            ui.button("CSV", icon="download", on_click=self._save).props(
                'flat dense no-caps size=sm aria-label="download the profile as CSV"'
            )
            ui.button(icon="close", on_click=lambda: self.use(False)).props(
                'flat dense round size=sm aria-label="remove the profile"'
            )
        if not main.is_line:
            with self.curve.frame("curve"):
                self._plot = ui.plotly(maps.profile_curves([("", [0.0], [0.0])], 1.0)).classes("curve")
                self._plot.props('role="img" aria-label="profile along the line"')
        self._rows = ui.element("div").props('role="status" aria-label="readings"').classes("readings")
        with ui.element("div").classes("fields"):
            names = {} if main.is_line else {"x0": "From x", "y0": "From y", "x1": "To x", "y1": "To y"}
            for key, label in (names | {"a": "Cursor A at", "b": "Cursor B at"}).items():
                field = ui.input(label, validation=_not_a_length, on_change=lambda e, k=key: self._typed(k, e.value))
                field.props(f'dense stack-label debounce=350 data-measured="{key}"').classes("field")
                self._fields[key] = field
        self._note = ui.label().classes("hint")

    def measure(self) -> None:
        """Take the heights along the line, and what is between the cursors."""
        main = self.pictures[0]
        if not (self.on and main.there and self._fields):
            return
        if main.is_line:
            self.found = line_scan(np.asarray(main.heights())[:, 0], main.answer["pixel"][0])
            self._note.set_text(_lines_note(main))
        else:
            self.found = self._along(main)
            self.line = (*self.found.start, *self.found.end)
            for picture in self.pictures:
                picture.push(line=list(self.line) if self._fits(picture) else None)
            others = [other for other in self.pictures[1:] if self._fits(other)]
            curves = [(main.name, self.found)] + [(other.name, self._along(other)) for other in others]
            self._plot.update_figure(
                maps.profile_curves([(name, c.distance, c.heights) for name, c in curves], self.found.length or 1.0)
            )
            told = f"{self.found.heights.size} points at the full resolution of the surface"
            thin = main.answer["step"] > 1
            self._note.set_text(f"{told}; the map is thinned out." if thin else f"{told}.")
        self._place(self.shares)

    def _along(self, picture: Picture) -> Section:
        x, y = picture.size
        line = self.line or (0.05 * x, 0.5 * y, 0.95 * x, 0.5 * y)
        return section(picture.heights(), tuple(picture.answer["pixel"]), line[:2], line[2:])

    def _fits(self, picture: Picture) -> bool:
        """Whether places on this picture are those on the first."""
        return picture.there and not picture.is_line and np.allclose(picture.size, self.pictures[0].size, rtol=1e-9)

    def _cursors_at(self, a: float, b: float) -> None:
        assert self.found is not None
        low, high = float(self.found.distance[0]), float(self.found.distance[-1])
        first, second = ((min(max(at, low), high) - low) / ((high - low) or 1.0) for at in (a, b))
        self._place((first, second))

    def _place(self, shares: tuple[float, float]) -> None:
        """Put the cursors at these shares of the line, and say what is between them."""
        found = self.found
        assert found is not None
        low, high = float(found.distance[0]), float(found.distance[-1])
        self.shares = shares
        read = reading(found, *(low + share * (high - low) for share in shares))
        extent = self.pictures[0].size[0] if self.pictures[0].is_line else high or 1.0
        x_unit, x_scale = maps.scaled(extent)
        heights = [value if math.isfinite(value) else None for value in read.heights]
        known = np.abs(found.heights[np.isfinite(found.heights)])
        state = {
            "scale": x_scale,
            "unit": x_unit,
            "zscale": maps.scaled(float(known.max(initial=0.0)))[1],
            "extent": [low, high],
            "step": (high - low) / max(found.distance.size - 1, 1),
            "cursors": list(read.at),
            "dots": [[at, height] for at, height in zip(read.at, heights, strict=True)],
        }
        if self.pictures[0].is_line:
            self.pictures[0].push(**state)
        else:
            self.curve.push(**state)
            marks = [at / (high or 1.0) for at in read.at]
            for picture in self.pictures:
                picture.push(marks=marks if self._fits(picture) else [])
        self._rows.clear()
        with self._rows:
            with ui.element("dl").classes("numbers"):
                for name, text in read.words():
                    with ui.element("div"):
                        with ui.element("dt"):
                            ui.label(name)
                        with ui.element("dd"):
                            ui.label(text)
            ui.label(
                "Pa, Pq and Pt of the part between the cursors, about its straight line of least squares; "
                "the angle is that of heights and distances on the same scale."
            ).classes("hint")
        self._show({"a": read.at[0], "b": read.at[1]})

    def _show(self, cursors: dict[str, float]) -> None:
        """Let the entries say where line and cursors stand."""
        line = dict(zip(("x0", "y0", "x1", "y1"), self.line or (), strict=False))
        self._setting = True
        for key, value in (line | cursors).items():
            if key in self._fields:
                self._fields[key].set_value(show(value, "m", 5) if value else "0 m")
        self._setting = False

    def _typed(self, key: str, text: str | None) -> None:
        """Take what a person typed, once it is a length."""
        if self._setting or _not_a_length(text) is not None or self.found is None:
            return
        value = float(_LENGTH.read(str(text), ""))
        if key in ("a", "b"):
            now = [float(self.found.distance[0] + s * np.ptp(self.found.distance)) for s in self.shares]
            now["ab".index(key)] = value
            self._cursors_at(*now)
        elif self.line is not None:
            line = list(self.line)
            line[("x0", "y0", "x1", "y1").index(key)] = value
            self.line = tuple(line)  # type: ignore[assignment]
            self.measure()

    def _copy(self) -> None:
        if self.found is not None:
            ui.clipboard.write(self.found.csv())
            ui.notify(f"{self.found.heights.size} points copied")

    def _save(self) -> None:
        if self.found is not None:
            ui.download.content(self.found.csv(), "profile.csv")


_LENGTH = Number("length")


def _not_a_length(text: str | None) -> str | None:
    """Why ``text`` is no length; None if it is one."""
    try:
        _LENGTH.read(str(text or ""), "length")
    except AsperityError as error:
        return str(error)
    return None


def _finite(values: Any, count: int) -> bool:
    """Whether ``values`` of a message are so many numbers."""
    return (
        isinstance(values, list)
        and len(values) == count
        and all(isinstance(value, int | float) and math.isfinite(value) for value in values)
    )


def _lines_note(picture: Picture) -> str:
    """How many points the curve of a line scan shows of those that are measured on."""
    count = picture.answer["full"][0]
    step = picture.answer["step"]
    shown = "" if step == 1 else f"; the curve shows every {step}th"
    return f"{count} points at the full resolution of the line scan{shown}."


def steps_of(draft: Draft) -> list[Any]:
    """The steps of preparation of the document, as they were typed."""
    found = draft.get("surface", "prepare")
    return list(found) if isinstance(found, list) else []


class Masks:
    """Regions that are drawn become steps of the preparation; ``after`` is called when they have,
    and the ``stage`` stays at its step."""

    def __init__(self, context: Context, stage: Stage | None = None, after: Callable[[], None] | None = None) -> None:
        self._context, self._stage, self._after = context, stage, after

    def told(self, told: Mapping[str, Any], picture: Picture, shown: int) -> None:
        """Mask what was drawn on a ``picture`` of the surface after the first ``shown`` steps, or
        take a region out of a mask."""
        steps, what = steps_of(self._context.session.draft), told.get("what")
        if what == "remove":
            self._put(steps, without_region(steps, int(told["step"]), int(told["number"])), int(told["step"]))
            return
        region = None
        if what == "range":
            region = drawn_range(told["from"], told["to"], picture.size[0])
        elif what == "region":
            region = drawn_region(str(told["shape"]), told["points"], picture.size, max(picture.answer["pixel"]))
        if region is None:
            return
        place, _ = place_of_mask(steps, shown)
        new = with_region(steps, region, shown)
        self._put(steps, new, place)
        if len(new) > len(steps) and not any(step.get("step") == "fill" for step in new[place:]):
            ui.notify("These points are missing now. The step fill on the page Prepare puts heights in their place.")

    def _put(self, before: list[Any], steps: list[Any], place: int) -> None:
        """Take ``steps`` for those ``before``; a mask was added or left out at that ``place``."""
        if self._stage is not None and self._stage.step is not None and place <= self._stage.step:
            chosen = self._stage.step + len(steps) - len(before)
            self._stage.chosen = None if chosen < 0 else chosen
        self._context.set(("surface", "prepare"), steps or None)
        if self._after is not None:
            self._after()


class Stage:
    """Which step of the preparation is looked at: one of them, or all."""

    def __init__(self, steps: Callable[[], list[Any]]) -> None:
        self._steps = steps
        self.chosen: int | None = None

    @property
    def since(self) -> int:
        """Steps before what is looked at."""
        return 0 if self.step is None else self.step

    @property
    def upto(self) -> int:
        """Steps up to the end of what is looked at."""
        return len(self._steps()) if self.step is None else self.step + 1

    @property
    def step(self) -> int | None:
        """Place of the one that is looked at, if it is there; None for all."""
        return self.chosen if self.chosen is not None and self.chosen < len(self._steps()) else None

    def title(self, what: str) -> str:
        """Words for the surface ``before`` or ``after`` it, or what is ``removed``."""
        steps = self._steps()
        if self.step is None:
            return {"before": "Before any step", "after": "After all steps", "removed": "What all steps remove"}[what]
        held = steps[self.step]
        name = str(held.get("step", "") if isinstance(held, dict) else "").replace("_", " ")
        which = f"step {self.step + 1} of {len(steps)}"
        named = {"before": f"Before {which}: {name}", "after": f"After {which}: {name}"}
        return named.get(what, f"What {which} removes: {name}")
