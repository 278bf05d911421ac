"""Values with which a generator, spectrum, distribution of heights or step of preparation begins
when a person chooses it, so that what it makes is shown at once.

They suit the size of the surface at hand; what a person has typed goes before them.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from types import MappingProxyType
from typing import Any, TypeAlias

from ..core.errors import InputError
from ..core.settings import Settings, declared
from ..core.units import show
from ..io.schemas.surfaces import (
    AMPLITUDES,
    HEIGHTS,
    REGIONS,
    SPECTRA,
    STEPS,
    SURFACE_TABLES,
    SURFACES,
    FileReading,
    ScanFile,
)
from .beginning import GRID, measured
from .draft import Keys
from .session import Session

SURFACE, COUNTER = "surface", "counter_surface"

UNSEEN = "unseen.bin"
"""Name of the file with heights of a surface of which only the size is asked."""


@dataclass(frozen=True)
class Extent:
    """Size of the surface at hand: its ``sides`` in m and ``points`` along them, and the ``files``
    with heights from which one is taken where one is needed, the last first."""

    sides: tuple[float, float] = (10e-6, 10e-6)
    points: tuple[int, int] = (256, 256)
    files: tuple[str, ...] = ()

    @classmethod
    def stated(cls, table: Mapping[str, Any], files: tuple[str, ...] = ()) -> Extent | None:
        """What the ``table`` of a generated surface states; None if it does not, or wrongly."""
        grid = SURFACE_TABLES["flat"].model_fields
        with suppress(InputError):
            size, points = (declared(key, grid[key]).values.read(_text(table.get(key)), key) for key in GRID_KEYS)
            return cls((float(size[0]), float(size[1])), (points[0], points[1]), files)
        return None

    @property
    def side(self) -> float:
        """The shorter side, in m; of a line scan its length."""
        return self.sides[0] if self.points[1] == 1 else min(self.sides)

    @property
    def pixel(self) -> float:
        """The larger distance of points, in m."""
        return max(side / points for side, points in zip(self.sides, self.points, strict=True) if points > 1)

    @property
    def file(self) -> dict[str, Any]:
        """Table of the surface in the last file; without its path if there is none."""
        table = measured(self.files[0] if self.files else "")
        return {key: value for key, value in table.items() if value}


GRID_KEYS = ("size", "points")


def _text(value: Any) -> str:
    """``value`` of a grid as text: two numbers with a cross between."""
    return "x".join(map(str, value)) if isinstance(value, list | tuple) else str(value)


Value: TypeAlias = Any | Callable[[Extent], Any]


def length(share: float, pixels: float = 0.0) -> Callable[[Extent], str]:
    """Text of this ``share`` of the shorter side, but of at least so many ``pixels``."""
    return lambda extent: show(max(share * extent.side, pixels * extent.pixel), "m", 6)


def whole_waves(extent: Extent) -> str:
    """A wavelength of which both sides hold a whole number, if there is any, two or more."""
    ratio = Fraction(extent.sides[0] / extent.sides[1]).limit_denominator(32)
    return show(extent.sides[0] / ratio.numerator / (2 if max(ratio.numerator, ratio.denominator) < 4 else 1), "m", 12)


def pitches(share: float) -> Callable[[Extent], list[str]]:
    """This ``share`` of either side."""
    return lambda extent: [show(share * side, "m", 12) for side in extent.sides]


def middle_half(axis: int) -> Callable[[Extent], list[str] | None]:
    """The middle half of a side; nothing of the width of a line scan."""

    return interval(axis, 0.25, 0.75)


def interval(axis: int, *shares: float) -> Callable[[Extent], list[str] | None]:
    """Places along one ``axis`` at these ``shares`` of its side; none across a line scan."""

    def places(extent: Extent) -> list[str] | None:
        if extent.points[axis] == 1:
            return None
        return [show(share * extent.sides[axis], "m", 10) for share in shares]

    return places


def corners(extent: Extent) -> list[str]:
    """Those of a triangle in the middle, along y."""
    return [show(share * extent.sides[1], "m", 10) for share in (0.45, 0.45, 0.55)]


def middle(extent: Extent) -> list[str]:
    """The middle of the map."""
    return [show(0.5 * side, "m", 10) for side in extent.sides]


def half_of_points(extent: Extent) -> str:
    """Half as many points along each side."""
    return "x".join(str(max(1, points // 2)) for points in extent.points)


ROUGH = MappingProxyType({"kind": "gaussian", "rms_height": length(5e-4), "correlation_length": length(0.05, 4)})
COARSE = MappingProxyType({"kind": "gaussian", "rms_height": length(2e-3), "correlation_length": length(0.2)})
FINE = MappingProxyType({"kind": "gaussian", "rms_height": length(2e-4), "correlation_length": length(0.03, 4)})

OF_SURFACES: Mapping[str, Mapping[str, Value]] = MappingProxyType(
    {
        "rough": {"spectrum": ROUGH, "seed": 1},
        "digital_filter": {"spectrum": ROUGH, "seed": 1},
        "translated": {"spectrum": {**ROUGH, "kind": "exponential"}, "skewness": "-0.5", "kurtosis": "4", "seed": 1},
        "rank_ordered": {
            "spectrum": ROUGH,
            "heights": {"kind": "moments", "skewness": "-1", "kurtosis": "5"},
            "seed": 1,
        },
        "from_line_scan": {"profile": lambda extent: {**extent.file, "prepare": []}, "seed": 1},
        "bimodal": {
            "first": ROUGH,
            "second": FINE,
            "share": "0.4",
            "separation": length(2e-3),
            "patches": COARSE,
            "seed": 1,
        },
        "two_process": {"plateau": FINE, "valleys": COARSE, "offset": length(1e-3), "seed": 1},
        "particles": {
            "matrix": ROUGH,
            "density": lambda extent: f"{30e-12 / (extent.sides[0] * extent.sides[1]):.3g} um**-2",
            "radius": length(0.02),
            "exposure": "1",
            "seed": 1,
        },
        "weierstrass_mandelbrot": {"dimension": "2.4", "roughness": length(1e-7), "seed": 1},
        "weierstrass_mandelbrot_profile": {"dimension": "1.4", "roughness": length(1e-7), "seed": 1},
        "sphere": {"radius": length(10.0)},
        "elliptic_paraboloid": {"radius_x": length(10.0), "radius_y": length(20.0)},
        "cylinder": {"radius": length(10.0)},
        "cone": {"slope": "0.05"},
        "wedge": {"slope": "0.05"},
        "power_law": {"exponent": "4", "radius": length(0.25), "height": length(0.01)},
        "flat_punch": {"radius": length(0.25), "depth": length(0.01)},
        "sinusoid": {"amplitude": length(1e-3), "wavelength": lambda extent: show(extent.sides[0] / 4, "m", 12)},
        "bisinusoid": {"amplitude": length(1e-3), "wavelength": whole_waves},
        "flat": {},
        "laser_bumps": {
            "pitch": pitches(0.25),
            "rim_height": length(2e-3),
            "rim_radius": length(0.06),
            "rim_width": length(0.03),
            "depth": length(2e-3),
        },
        "dimples": {"pitch": pitches(0.25), "radius": length(0.06), "depth": length(2e-3)},
        "grooves": {
            "pitch": lambda extent: show(extent.sides[0] / 4, "m", 12),
            "width": length(0.1),
            "depth": length(2e-3),
        },
    }
)
"""Of each kind of generated surface, beside the grid."""

OF_SPECTRA: Mapping[str, Mapping[str, Value]] = MappingProxyType(
    {
        "exponential": ROUGH,
        "gaussian": ROUGH,
        "self_affine": {
            "hurst": "0.8",
            "rolloff_wavelength": length(0.25),
            "shortest_wavelength": length(0.02, 4),
            "rms_height": length(5e-4),
        },
        "two_slopes": {
            "exponents": ["2", "4"],
            "rolloff_wavelength": length(0.25),
            "crossover_wavelength": length(0.05, 4),
            "rms_height": length(5e-4),
        },
        "table": {
            "wavelengths": lambda extent: [show(share * extent.side, "m", 10) for share in (0.5, 0.1, 0.02)],
            "psd": lambda extent: [show(share * extent.side**4, "m**4", 3) for share in (1e-9, 1e-10, 1e-12)],
        },
        "measured": {"surface": lambda extent: extent.file},
        "scans": {"scans": lambda extent: [{"path": path} for path in reversed(extent.files)] or [{}]},
    }
)
"""Of each kind of spectrum."""

OF_HEIGHTS: Mapping[str, Mapping[str, Value]] = MappingProxyType(
    {
        "moments": {"skewness": "-1", "kurtosis": "5"},
        "measured": {"surface": lambda extent: extent.file},
        "two_levels": {"share": "0.3", "separation": "3"},
        "weibull": {"shape": "2"},
    }
)
"""Of each distribution of heights."""

OF_STEPS: Mapping[str, Mapping[str, Value]] = MappingProxyType(
    {
        "crop": {"x": middle_half(0), "y": middle_half(1)},
        "resample": {"points": half_of_points},
        "filter": {"short": length(0.1, 6)},
        "tip": {"radius": length(0.05)},
        "tip_limit": {"radius": length(0.05)},
        "slice": {"y": "middle"},
        "mask": {"regions": lambda extent: [{"kind": "rectangle", **_filled(OF_REGIONS["rectangle"], extent)}]},
    }
)
"""Of each step of preparation that needs any."""

OF_REGIONS: Mapping[str, Mapping[str, Value]] = MappingProxyType(
    {
        "rectangle": {"x": interval(0, 0.45, 0.55), "y": interval(1, 0.45, 0.55)},
        "ellipse": {"centre": middle, "radii": lambda extent: [show(0.05 * extent.side, "m", 10)] * 2},
        "polygon": {"x": interval(0, 0.45, 0.55, 0.5), "y": corners},
    }
)
"""Of each region of a mask."""


BEGINNINGS = (
    (SURFACES, OF_SURFACES),
    (SPECTRA, OF_SPECTRA),
    (HEIGHTS, OF_HEIGHTS),
    (STEPS, OF_STEPS),
    (REGIONS, OF_REGIONS),
)


def starting(model: type[Settings], extent: Extent) -> dict[str, Any]:
    """Values with which the table ``model`` begins on a surface of this ``extent``; nothing for
    tables that begin empty."""
    if model is ScanFile:
        return {"path": extent.files[0]} if extent.files else {}
    if issubclass(model, FileReading):
        return extent.file
    for kinds, values in BEGINNINGS:
        for word, made in kinds.items():
            if made is model.makes:
                own = _filled(values.get(word, {}), extent)
                own = {key: value for key, value in own.items() if key in model.model_fields and key != "kind"}
                return {**GRID, **own} if kinds is SURFACES else own
    return {}


def _filled(value: Any, extent: Extent) -> Any:
    """``value`` of a table of this module on a surface of this ``extent``."""
    if callable(value):
        return value(extent)
    if isinstance(value, Mapping):
        found = {key: _filled(item, extent) for key, item in value.items()}
        return {key: item for key, item in found.items() if item is not None}
    return list(value) if isinstance(value, list) else value


def begun(
    tables: Mapping[str, type[Settings]], tag: str, word: str, before: Mapping[str, Any], extent: Extent
) -> dict[str, Any]:
    """The table of the kind ``word`` of ``tables``, which the key ``tag`` tells apart: what a
    person has typed into the one ``before`` it, and else starting values."""
    new = starting(tables[word], extent)
    last = tables.get(str(before.get(tag)))
    old = {} if last is None else starting(last, extent)
    fields = tables[word].model_fields
    typed = {
        key: value
        for key, value in before.items()
        if key in fields and key != tag and (value != old.get(key) or value == new.get(key))
    }
    if any(key in typed for key in AMPLITUDES):  # a spectrum has exactly one
        new = {key: value for key, value in new.items() if key not in AMPLITUDES}
    return {tag: word, **new, **typed}


@dataclass
class Starting:
    """Fills tables of surfaces of a ``session`` that a person chooses in a form.

    ``files`` tells the files with heights, ``shown`` the answer to what is shown of the surface of
    the page, whose size need not be asked for again. Tables are filled in ``turn``, so that they
    stand as they were chosen.
    """

    session: Session
    files: Callable[[], Sequence[str]]
    shown: Callable[[], Mapping[str, Any]] = dict
    left: dict[tuple[Keys, str], dict[str, Any]] = field(default_factory=dict)
    turn: asyncio.Lock = field(default_factory=asyncio.Lock)

    def chosen(
        self,
        keys: Keys,
        tables: Mapping[str, type[Settings]],
        tag: str,
        word: str,
        before: Mapping[str, Any],
        extent: Extent,
    ) -> dict[str, Any]:
        """Table at ``keys`` when the kind ``word`` is chosen after the table ``before``, for a
        surface of this ``extent``; what was typed into this kind earlier is there again."""
        last = str(before.get(tag))
        if last in tables:
            own = starting(tables[last], extent)
            self.left[keys, last] = {key: value for key, value in before.items() if value != own.get(key)}
        made = begun(tables, tag, word, {**self.left.get((keys, word), {}), **before}, extent)
        if keys == (COUNTER,) and word == "file":
            made.setdefault("mirror", "x")  # as on the command line
        return made

    async def extent(self, keys: Keys) -> Extent:
        """Size of the surface to which the table at ``keys`` belongs: as it states, or as it is
        after the steps of preparation to which another one is added."""
        files, of_step = tuple(reversed(self.files())), keys[-1] == "prepare"
        place = keys[:-1] if of_step else keys[:1]
        table = self._table(place)
        if place == (COUNTER,) and not {"size", "path"} & table.keys():
            place, table = (SURFACE,), self._table((SURFACE,))
        stated, steps = Extent.stated(table, files), bool(table.get("prepare"))
        if stated is not None and not (of_step and steps):
            return stated
        answer = self.shown() if place == (SURFACE,) else {}
        if "full" not in answer and (table.get("path") or steps):
            asked = {"table": {"kind": "file", **table}, "steps": None, "folder": str(self.session.folder)}
            answer = await self.session.helper.call("surface", **asked, out=str(self.session.scratch / UNSEEN))
        if "full" in answer:
            (lx, ly), (nx, ny) = answer["size"], answer["full"]
            return Extent((lx, ly), (nx, ny), files)
        return stated or Extent(files=files)

    def _table(self, keys: Keys) -> dict[str, Any]:
        found = self.session.draft.get(*keys)
        return dict(found) if isinstance(found, Mapping) else {}
