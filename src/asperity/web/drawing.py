"""Drawing of a body to scale: its layers on what lies below them, as SVG with a line of text."""

from __future__ import annotations

import html
import itertools
import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, Literal

from ..core.errors import AsperityError
from ..core.units import parse, show
from .resolved import Materials, as_tables

FILLS = ("#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00")
"""Colours of materials in the drawing, in the order in which they come."""

NOT_CHOSEN = "not chosen yet"

LEFT, WIDE, TOP, TALL, LABELS = 26.0, 150.0, 10.0, 220.0, 184.0
"""Place and size of the stack in units of the drawing, of about a pixel, and room for labels."""

LINE = 15.0
"""Height of a line of text."""

THIN, LEAST = 1.0, 5.0
"""Height below which a layer would not be seen, and with which it is drawn instead."""

LONGEST = 24
"""Letters of a label; the whole text is that of its title."""


@dataclass(frozen=True)
class Piece:
    """One layer, or what lies below all.

    ``state`` is whether it is there, rigid or still to be chosen; ``colours`` are those at its top
    and bottom, ``weights`` how the second one comes in with depth.
    """

    name: str
    state: Literal["chosen", "rigid", "open"]
    thickness: float = math.nan
    slips: bool = False
    colours: tuple[str, str] = ("", "")
    power: float = 1.0
    missing: str = ""

    @property
    def text(self) -> str:
        """Its label."""
        return f"{self.name}, {show(self.thickness, 'm', 4)}" if math.isfinite(self.thickness) else self.name


@dataclass(frozen=True)
class Stack:
    """The ``layers`` of a body from the surface down, and its ``base``."""

    layers: tuple[Piece, ...]
    base: Piece

    @property
    def total(self) -> float:
        """Thickness of all layers that have one, in m."""
        return sum(piece.thickness for piece in self.layers if math.isfinite(piece.thickness))


def stack_of(body: Any, materials: Materials, *, default: str = "") -> Stack:
    """What is drawn of the ``body`` of a draft, whose ``materials`` are resolved; ``default`` is
    what the document takes for one that is not given, empty where it must be."""
    body = as_tables(body)
    if not isinstance(body, Mapping):
        return Stack((), Piece(default or NOT_CHOSEN, "rigid" if default else "open"))
    library = str(body.get("materials_file") or "") or None
    colours: dict[str, str] = {}

    def piece(part: Any, **more: Any) -> Piece:
        if isinstance(part, Mapping) and part.get("rigid"):
            return Piece("rigid", "rigid")
        found = materials.of(part, library)
        if not found.name:
            return Piece(NOT_CHOSEN, "open", **more)
        missing = "" if found.known else "E or ν missing"
        named = colours.setdefault(found.identity, FILLS[len(colours) % len(FILLS)])
        return Piece(found.name, "chosen" if found.known else "open", colours=(named, named), missing=missing, **more)

    layers = [layer for layer in body.get("layers") or () if isinstance(layer, Mapping)]
    if not layers:
        return Stack((), piece(body))
    made = []
    for layer in layers:
        more: dict[str, Any] = {"thickness": _thickness(layer), "slips": layer.get("interface") == "frictionless"}
        if layer.get("kind", "layer") == "layer":
            made.append(piece(layer, **more))
            continue
        top, bottom = (piece(layer.get(end)) for end in ("top", "bottom"))
        state: Literal["chosen", "open"] = "chosen" if top.state == bottom.state == "chosen" else "open"
        names = f"{top.name} to {bottom.name}" if top.name != bottom.name else top.name
        power = _number(layer.get("exponent"))
        made.append(Piece(names, state, colours=(top.colours[0], bottom.colours[0]), power=power, **more))
    return Stack(tuple(made), piece(body.get("base") or {}))


def _thickness(layer: Mapping[str, Any]) -> float:
    with suppress(AsperityError):
        found = parse(str(layer.get("thickness", "")), "length", "")
        return found if found >= 0.0 else math.nan
    return math.nan


def _number(value: Any) -> float:
    try:
        return min(max(float(value), 0.05), 20.0)
    except (TypeError, ValueError):
        return 1.0


def heights(thicknesses: Sequence[float], room: float) -> tuple[list[float], list[int]]:
    """Heights of layers of these ``thicknesses`` in a drawing with ``room`` for all of them, and
    the numbers of those that are drawn thicker than they are, since they would be thinner than a
    pixel.

    A thickness that is not known has the least height.
    """
    known = {number: value for number, value in enumerate(thicknesses) if math.isfinite(value)}
    thin: set[int] = set()
    while True:
        left = {number: value for number, value in known.items() if number not in thin}
        scale = max(room - LEAST * (len(thicknesses) - len(left)), LEAST) / (sum(left.values()) or 1.0)
        below = {number for number, value in left.items() if value * scale < THIN}
        if not below:
            break
        thin |= below
    return [left[number] * scale if number in left else LEAST for number in range(len(thicknesses))], sorted(thin)


def drawn(stack: Stack, name: str) -> str:
    """The drawing of the ``stack`` of the body ``name``, with a line of text below it."""
    title = name.replace("_", " ")
    deep = (0.3 if stack.layers else 0.5) * TALL
    sizes, thin = heights([piece.thickness for piece in stack.layers], TALL - deep)
    tops = list(itertools.accumulate(sizes, initial=TOP))
    parts, labels = [], []
    for number, (piece, y, tall) in enumerate(zip((*stack.layers, stack.base), tops, (*sizes, deep), strict=True)):
        kind = "base" if number == len(sizes) else "thin" if number in thin else ""
        parts.append(_shape(piece, y, tall, f"{name}-{number}", kind))
        labels.append((y + tall / 2, piece.text, "gap" if piece.state == "open" else ""))
        if piece.missing:
            labels.append((y + tall / 2, piece.missing, "soft"))
        if piece.slips:
            parts.append(
                f'<line x1="{LEFT}" x2="{LEFT + WIDE}" y1="{y + tall:.2f}" y2="{y + tall:.2f}" class="slips"/>'
            )
            labels.append((y + tall, "slips without friction", "soft"))
    if stack.layers:
        parts.append(f'<path d="M{LEFT - 9} {TOP}h5m-2.5 0V{tops[-1]:.2f}m-2.5 0h5" class="measure"/>')
    placed = _apart([y for y, _, _ in labels])
    for (y, text, kind), at in zip(labels, placed, strict=True):
        parts.append(_label(y, at, text, kind))
    high = max(tops[-1] + deep + 6.0, max(placed) + LINE)
    return (
        f'<figure class="stack-figure"><svg viewBox="0 0 {LEFT + WIDE + LABELS:.0f} {high:.0f}" role="img" '
        f'aria-label="{html.escape(title)} to scale" class="stack">{"".join(parts)}</svg>'
        f"<figcaption>{html.escape(_caption(stack, thin))}</figcaption></figure>"
    )


def _shape(piece: Piece, y: float, tall: float, name: str, kind: str) -> str:
    """One layer, or the base; one that is too thin to be to scale is broken by a zigzag."""
    place = f'x="{LEFT}" y="{y:.2f}" width="{WIDE}" height="{tall:.2f}"'
    if piece.state != "chosen":
        return f'<rect {place} class="{"rigid" if piece.state == "rigid" else "open"}"/>' + (
            _hatched(y, tall) if piece.state == "rigid" else ""
        )
    top, bottom = piece.colours
    fill, before = top, ""
    if top != bottom:
        stops = "".join(
            f'<stop offset="{part / 8:g}" stop-color="{_mixed(top, bottom, (part / 8) ** piece.power)}"/>'
            for part in range(9)
        )
        before = f'<linearGradient id="stack-{name}" x1="0" y1="0" x2="0" y2="1">{stops}</linearGradient>'
        fill = f"url(#stack-{name})"
    broken = ""
    if kind == "thin":
        zigzag = " ".join(f"l3 {3 if step % 2 else -3}" for step in range(4))
        broken = f'<path d="M{LEFT + WIDE / 2 - 6} {y + tall / 2 + 1.5:.2f} {zigzag}" class="broken"/>'
    return f'{before}<rect {place} fill="{fill}" class="chosen {kind}"/>{broken}'


def _hatched(y: float, tall: float) -> str:
    """Lines across a rigid body."""
    step, lines = 12.0, []
    for number in range(int((WIDE + tall) / step)):
        start = (number + 1) * step
        x1, y1 = min(start, WIDE), max(start - WIDE, 0.0)
        x2, y2 = max(start - tall, 0.0), min(start, tall)
        lines.append(f"M{LEFT + x1:.1f} {y + y1:.1f}L{LEFT + x2:.1f} {y + y2:.1f}")
    return f'<path d="{"".join(lines)}" class="hatch"/>'


def _label(y: float, at: float, text: str, kind: str) -> str:
    """``text`` at the height ``at``, with a line to the height ``y`` that it is about."""
    edge = LEFT + WIDE
    short = text if len(text) <= LONGEST else f"{text[: LONGEST - 1]}…"
    named = f"<title>{html.escape(text)}</title>" if short != text else ""
    return (
        f'<path d="M{edge + 1} {y:.1f}L{edge + 10} {at:.1f}h3" class="leader"/>'
        f'<text x="{edge + 16}" y="{at + 4:.1f}" class="{kind}">{named}{html.escape(short)}</text>'
    )


def _apart(heights: Sequence[float]) -> list[float]:
    """Heights of labels as near to these as they can stand without touching."""
    placed = list(heights)
    for number in range(1, len(placed)):
        placed[number] = max(placed[number], placed[number - 1] + LINE)
    over = max((placed[-1] if placed else 0.0) - (TOP + TALL - 4.0), 0.0)
    for number in range(len(placed) - 1, -1, -1):
        if number < len(placed) - 1:
            over = max(placed[number] - (placed[number + 1] - LINE), 0.0)
        placed[number] = max(placed[number] - over, TOP + 4.0 + number * LINE)
    return placed


def _caption(stack: Stack, thin: Sequence[int]) -> str:
    """What the drawing says in words."""
    if not stack.layers:
        return "Of any depth." if stack.base.state == "chosen" else ""
    said = [f"Layers {show(stack.total, 'm', 4)} in total, the base of any depth."] if stack.total else []
    unknown = sum(not math.isfinite(piece.thickness) for piece in stack.layers)
    if unknown:
        said.append("A thickness is missing." if unknown == 1 else f"{unknown} thicknesses are missing.")
    if thin:
        named = ", ".join(stack.layers[number].text for number in thin)
        said.append(f"Broken scale: {named} would be thinner than a pixel.")
    return " ".join(said)


def _mixed(first: str, second: str, share: float) -> str:
    """Colour between two, of the ``share`` of the second."""
    pairs = ((int(first[at : at + 2], 16), int(second[at : at + 2], 16)) for at in (1, 3, 5))
    return "#" + "".join(f"{round(a + (b - a) * share):02x}" for a, b in pairs)
