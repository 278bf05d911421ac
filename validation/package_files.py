"""What SurfaceTopography and surfalize make of files, beside the map that is in them."""

from __future__ import annotations

import logging
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import small_files
from small_files import HEIGHTS, PIXEL

import asperity as asp
from asperity.core.arrays import RealArray
from asperity.core.units import unit_factor
from asperity.surfaces import Surface

Outcome = dict[str, Any]
"""``state`` "read" or "not read", and of what is read: whether it is ``turned`` over in y, the
``factor`` and ``offset`` (m) of its heights, its ``pixel`` over the right one, its ``channel``, and
the ``error`` of the heights over the largest one after these, infinite for other heights."""

ALIKE = 2e-6
"""Error of heights over the largest one, and of a pixel, up to which they are equal: the rounding
of 32-bit numbers and of Nanosurf's range."""

Reader = Callable[[Path, Mapping[str, Any]], tuple[RealArray, float, str]]
"""Heights (m) [x, y] with y upwards where rows count from the top, pixel (m) and channel of a
file."""


def judged(h: RealArray, pixel: float, channel: str) -> Outcome:
    """``h`` beside the map of all small files."""
    if h.shape != HEIGHTS.shape:
        return {"state": "read", "error": np.inf, "channel": channel}
    likeness = [float(np.corrcoef(h.ravel(), one.ravel())[0, 1]) for one in (HEIGHTS, HEIGHTS[:, ::-1])]
    turned = likeness[1] > likeness[0]
    right = HEIGHTS[:, ::-1] if turned else HEIGHTS
    factor, offset = np.polyfit(right.ravel(), h.ravel(), 1)
    error = float(np.abs(h - factor * right - offset).max() / np.abs(factor * right).max())
    if max(likeness) < 0.99:
        error = np.inf
    return {
        "state": "read",
        "turned": bool(turned),
        "factor": float(factor),
        "offset": float(offset),
        "pixel": pixel / PIXEL,
        "error": error,
        "channel": channel,
    }


def in_words(found: Outcome) -> str:
    """An outcome for a cell of a table."""
    if found["state"] != "read":
        return str(found["state"])
    if not np.isfinite(found["error"]) or found["error"] > ALIKE:
        return "other heights"
    words = []
    if abs(found["pixel"] - 1.0) > ALIKE:
        words.append(f"pixel × {found['pixel']:.4g}")
    if abs(found["factor"] - 1.0) > ALIKE:
        words.append(f"heights × {found['factor']:.4g}")
    if abs(found["offset"]) > ALIKE * abs(found["factor"]) * HEIGHTS.max():
        words.append(f"heights + {found['offset'] * 1e6:.4g} µm")
    if found["turned"]:
        words.append("turned over in y")
    return ", ".join(words) or "equal"


def by_surface_topography(path: Path, given: Mapping[str, Any]) -> tuple[RealArray, float, str]:
    """As the library's default channel has it; what a file lacks is ``given``."""
    logging.getLogger("igor2").setLevel(logging.CRITICAL)  # it prints the bytes of files of others
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # deprecations, and a parallel library that is not there
        from SurfaceTopography.IO import open_topography

        with open_topography(str(path)) as reader:
            channel = reader.default_channel
            sized = channel.physical_sizes is not None
            topography = reader.topography(**({} if sized else {"physical_sizes": given["size"]}))
            heights = np.ma.filled(np.ma.asarray(topography.heights(), dtype=float), np.nan)
            unit = topography.unit
            metre = unit_factor(unit or given["height_unit"], "length", "unit")
            lateral = metre if unit else unit_factor(given.get("lateral_unit", "m"), "length", "unit")
            pixel = float(topography.physical_sizes[0]) / heights.shape[0] * lateral
            return heights[:, ::-1] * metre, pixel, str(channel.name)


def by_surfalize(path: Path, given: Mapping[str, Any]) -> tuple[RealArray, float, str]:
    """As surfalize loads it: rows from the top, in µm."""
    import contextlib
    import io

    from surfalize import Surface as Theirs

    with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()):
        warnings.simplefilter("ignore")  # on endings, and on pixels of unequal sides
        found = Theirs.load(path)
        return np.asarray(found.data, dtype=float)[::-1].T * 1e-6, float(found.step_x) * 1e-6, ""


READERS: dict[str, Reader] = {"SurfaceTopography": by_surface_topography, "surfalize": by_surfalize}

NO_READER = ("CannotDetectFileFormat", "UnsupportedFileFormatError", "IndexError")
"""Errors with which they say that they know no such file."""


def outcome(reader: Reader, path: Path, given: Mapping[str, Any]) -> Outcome:
    """What a ``reader`` makes of the file at ``path``."""
    try:
        return judged(*reader(path, given))
    except Exception as error:  # many types
        name = type(error).__name__
        return {"state": "no reader" if name in NO_READER else f"refused ({name})"}


def outcomes(package: str, folder: Path) -> dict[str, Outcome]:
    """What a ``package`` makes of every kind of small file, written to a ``folder``."""
    paths = small_files.written(folder)
    return {kind.name: outcome(READERS[package], paths[kind.name], kind.given) for kind in small_files.KINDS}


def ours(folder: Path) -> dict[str, float]:
    """Largest error of ours over the largest height, and of the pixel, by kind."""
    found = {}
    for kind, path in zip(small_files.KINDS, small_files.written(folder).values(), strict=True):
        surface = asp.read(path, **kind.given)
        assert isinstance(surface, Surface)
        pixel = max(abs(d / PIXEL - 1.0) for d in surface.grid.spacing)
        found[kind.name] = max(float(np.abs(surface.heights - HEIGHTS).max() / HEIGHTS.max()), pixel)
    return found


def of_scan(path: Path) -> dict[str, Any]:
    """Shape, sides and missing points of a measured map, and the largest difference of the heights
    of others over its height from peak to valley."""
    surface = asp.read(path)
    assert isinstance(surface, Surface)
    h = surface.heights.astype(float)
    found: dict[str, Any] = {"shape": list(surface.shape), "size": list(surface.size), "missing": surface.n_missing}
    for package, reader in READERS.items():
        try:
            theirs, pixel, _ = reader(path, {})
        except ImportError:
            continue
        except Exception as error:  # many types
            found[package] = f"refused ({type(error).__name__})"
            continue
        same = theirs.shape == h.shape and bool((np.isnan(theirs) == np.isnan(h)).all())
        gap = float(np.nanmax(np.abs(theirs - h)) / np.ptp(h[~np.isnan(h)])) if same else np.inf
        found[package] = max(gap, abs(pixel / surface.dx - 1.0))
    return found
