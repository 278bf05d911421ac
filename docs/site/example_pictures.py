"""Pictures of the examples of the application, each drawn from a run of its document.

``python docs/site/example_pictures.py [NAME …]`` writes them beside the documents; it takes a
minute. Each picture says of which text of a document it is.
"""

from __future__ import annotations

import argparse
import hashlib
import io
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

import matplotlib as mpl
import numpy as np
from PIL import Image, PngImagePlugin
from scipy import ndimage

import asperity as asp
from asperity.run.document import EXAMPLES, built_in, loads

FOLDER = Path(asp.__file__).parent / "data" / "examples"

SIZE = (360, 240)
"""Pixels of a picture."""

COLOURS = (96, 64, 48, 32, 24, 16)
"""Colours of a picture: as many as keep its file small."""

TONES = 9
"""Tones of a surface beside one another."""

LARGEST = 25_000
"""Bytes of a picture at most."""

PAPER, CONTACT, WATER, SLIP = (233, 237, 241), (178, 58, 30), (84, 154, 214), (238, 150, 40)


def digest(name: str) -> str:
    """What tells the document of the example ``name`` apart from what it was before a change."""
    return hashlib.sha256(built_in(name).encode()).hexdigest()


def drawn_from(png: bytes) -> str:
    """Digest of the document from whose run a picture was drawn."""
    with Image.open(io.BytesIO(png)) as picture:
        return str(picture.info.get("document", ""))


def fitted(values: np.ndarray, order: int = 1) -> np.ndarray:
    """The middle of a map (nx, ny) with the shape of a picture, rows from the top."""
    values = np.asarray(values, dtype=float)
    height = min(values.shape[1], values.shape[0] * SIZE[1] // SIZE[0])
    start = (values.shape[1] - height) // 2
    rows = values[:, start : start + height].T[::-1]
    zoom = (SIZE[1] / rows.shape[0], SIZE[0] / rows.shape[1])
    return ndimage.zoom(rows, zoom, order=order, mode="nearest", grid_mode=True)


def coloured(values: np.ndarray, colours: str, low: float | None = None, high: float | None = None) -> np.ndarray:
    """Pixels of ``values`` between ``low`` and ``high`` on a scale of colours."""
    low = float(np.nanmin(values)) if low is None else low
    high = float(np.nanmax(values)) if high is None else high
    share = np.clip((values - low) / (high - low), 0.0, 1.0)
    return np.asarray(mpl.colormaps[colours](share)[..., :3] * 255, dtype=np.uint8)


def relief(heights: np.ndarray) -> np.ndarray:
    """Pixels of a surface in pale grey, lit from the left."""
    rows = fitted(ndimage.gaussian_filter(heights, 1.0, mode="wrap"))
    slope = np.gradient(rows, axis=1)
    light = np.clip(0.5 + 0.16 * slope / slope.std(), 0.0, 1.0)
    level = np.clip(0.5 + 0.2 * (rows - rows.mean()) / rows.std(), 0.0, 1.0)
    shade = np.round((0.4 * light + 0.6 * level) * TONES) / TONES
    return np.asarray(np.array([138, 149, 162]) + shade[..., None] * np.array([105, 97, 88]), dtype=np.uint8)


def painted(pixels: np.ndarray, where: np.ndarray, colour: tuple[int, int, int]) -> None:
    """Paint ``pixels`` where a map holds, with smooth edges."""
    share = np.clip(4.0 * fitted(ndimage.gaussian_filter(np.asarray(where, dtype=float), 0.6)) - 1.5, 0.0, 1.0)[
        ..., None
    ]
    pixels[:] = (1.0 - share) * pixels + share * np.array(colour)


def spots(outcome: Any) -> np.ndarray:
    """The surface with the spots that touch."""
    result = outcome.result
    pixels = relief(result.problem.profile())
    painted(pixels, ndimage.binary_dilation(result.contact), CONTACT)
    return pixels


def below(outcome: Any, deepest: float = 1.0) -> np.ndarray:
    """Stress below the largest pressure on a true scale, to this share of the section's depth; the
    surface is at the top, layers end at a line."""
    field = outcome.found["stress"].detail.sections[0].field
    x, planes, values = np.ravel(field.x), np.ravel(field.depth), np.asarray(field.von_mises)
    down = deepest * planes.max() * (np.arange(SIZE[1]) + 0.5) / SIZE[1]
    middle = x[np.argmax(values.max(axis=0))]
    across = middle + (down[1] - down[0]) * (np.arange(SIZE[0]) - 0.5 * (SIZE[0] - 1))
    rows = np.stack([np.interp(across, x, row, period=x.size * (x[1] - x[0])) for row in values])
    at = np.interp(down, planes + 1e-9 * planes.max() * np.arange(planes.size), np.arange(planes.size))
    pixels = coloured(
        ndimage.map_coordinates(rows, np.meshgrid(at, np.arange(SIZE[0]), indexing="ij"), order=1), "magma", 0.0
    )
    for interface in field.interfaces:
        pixels[np.abs(down - interface.depth).argmin()] = PAPER
    return pixels


def growth(outcome: Any) -> np.ndarray:
    """At which step each point was first touched."""
    first = np.full(outcome.result.contact.shape, np.nan)
    for number, step in reversed(list(enumerate(outcome.path.steps))):
        first[step.contact] = number
    pixels = relief(outcome.result.problem.profile())
    for number in reversed(range(len(outcome.path.steps))):
        colour = mpl.colormaps["YlOrRd"](0.25 + 0.75 * (1.0 - number / (len(outcome.path.steps) - 1)))
        painted(pixels, first <= number, tuple(int(255 * part) for part in colour[:3]))
    return pixels


def flattened(outcome: Any) -> np.ndarray:
    """How deep the summits have been pressed in for good."""
    last = outcome.path.steps[-1]
    depth = fitted(last.permanent_indentation)
    pixels = relief(outcome.result.problem.profile())
    share = np.clip(depth / (0.02 * depth.max()), 0.0, 1.0)[..., None]
    return np.asarray((1.0 - share) * pixels + share * coloured(depth, "inferno_r", 0.0, 1.2 * depth.max()), np.uint8)


def menisci(outcome: Any) -> np.ndarray:
    """Water around the spots that touch."""
    result = outcome.result
    pixels = relief(result.problem.profile())
    painted(pixels, result.menisci.wetting.menisci, WATER)
    painted(pixels, result.contact, CONTACT)
    return pixels


def sticking(outcome: Any) -> np.ndarray:
    """Where the spots stick and slip at the end of the first shift."""
    step = outcome.path.steps[8]
    pixels = relief(outcome.result.problem.profile())
    painted(pixels, step.contact, (24, 66, 120))
    painted(pixels, step.stick_slip.slipping, SLIP)
    return pixels


def current(outcome: Any) -> np.ndarray:
    """Density of the current through the spots."""
    density = np.abs(outcome.found["conductance"].values["electrical_density"])
    shown = fitted(np.sqrt(density))
    pixels = relief(outcome.result.problem.profile())
    share = np.clip(3.0 * fitted(outcome.result.contact) - 0.5, 0.0, 1.0)[..., None]
    return np.asarray((1.0 - share) * pixels + share * coloured(shown, "plasma"), np.uint8)


def leak(outcome: Any) -> np.ndarray:
    """Flow through the gap, around the spots that touch."""
    found = outcome.found["sealing"].values
    flux = np.hypot(np.asarray(found["leak_flux_x"]), np.asarray(found["leak_flux_y"]))
    shown = fitted(np.cbrt(flux))
    pixels = coloured(shown, "Blues", 0.0, 0.8 * float(shown.max()))
    painted(pixels, outcome.result.contact, (74, 66, 60))
    return pixels


def worn(outcome: Any) -> np.ndarray:
    """How deep the summits have worn."""
    depth = fitted(outcome.found["wear"].values["worn_body"])
    pixels = relief(outcome.result.problem.profile())
    share = np.clip(depth / (0.05 * depth.max()), 0.0, 1.0)[..., None]
    return np.asarray((1.0 - share) * pixels + share * coloured(depth, "YlOrBr", 0.0, 1.1 * depth.max()), np.uint8)


DRAWN: Mapping[str, Callable[[Any], np.ndarray]] = MappingProxyType(
    {
        "coated-disk": lambda outcome: below(outcome, 0.6),
        "ball-on-coating": below,
        "rubber-on-ground": growth,
        "flattened-metal": flattened,
        "humid-air": menisci,
        "fretting": sticking,
        "connector": current,
        "metal-seal": leak,
        "running-in": worn,
    }
)
"""What of a run the picture of each example shows."""


def draw(name: str) -> bytes:
    """Picture (PNG) of a run of the example ``name``."""
    pixels = np.ascontiguousarray(DRAWN[name](asp.run(loads(built_in(name)))))
    told = PngImagePlugin.PngInfo()
    told.add_text("document", digest(name))
    made = b""
    for colours in COLOURS:
        picture = Image.fromarray(pixels).quantize(colours, dither=Image.Dither.NONE)
        with io.BytesIO() as file:
            picture.save(file, "png", optimize=True, pnginfo=told)
            made = file.getvalue()
        if len(made) < LARGEST:
            break
    return made


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Pictures of the examples of the application.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(EXAMPLES)} (default: all)")
    for name in parser.parse_args().names or EXAMPLES:
        made = draw(name)
        (FOLDER / f"{name}.png").write_bytes(made)
        print(f"{name}: {len(made)} bytes" + (", too many" if len(made) > LARGEST else ""))
