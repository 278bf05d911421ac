"""Generators and steps of preparation begin with values that make a surface at once."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

from asperity.core.settings import Settings
from asperity.io.schemas.surfaces import HEIGHTS_TABLES, REGION_TABLES, SPECTRUM_TABLES, SURFACE_TABLES, AnyStep
from asperity.run.build import build_surface
from asperity.run.document import document_model
from asperity.web.forms import Asked, asked_of
from asperity.web.session import Session
from asperity.web.starting import Extent, Starting, begun, starting
from asperity.web.tasks import _table
from asperity.web.workers import Limits

SURFACE = next(item for item in asked_of(document_model()) if item.name == "surface")
PREPARE = next(item for item in asked_of(SURFACE.tables["file"]) if item.name == "prepare")  # type: ignore[index]

EXTENTS = (
    Extent(),
    Extent((3e-3, 1e-3), (96, 64)),
    Extent((40e-9, 50e-9), (40, 50)),
)


def files(folder: Path, long: float = 1e-5) -> tuple[str, ...]:
    """A map, and a line scan that is so ``long``."""
    x = np.linspace(0.0, long, 64)
    rng = np.random.default_rng(1)
    waves = sum(
        a * np.sin(2 * np.pi * n * x / long + p)
        for n, a, p in zip(range(1, 30), rng.normal(size=29), 6 * rng.random(29), strict=True)
    )
    heights = 1e-4 * long * np.asarray(waves)
    with (folder / "line.csv").open("w") as out:
        out.write("x (um), z (nm)\n" + "\n".join(f"{a * 1e6},{b * 1e9}" for a, b in zip(x, heights, strict=True)))
    from asperity.core.grid import Grid
    from asperity.files import save_surface
    from asperity.generate import ExponentialAutocorrelation, gaussian

    save_surface(
        gaussian(Grid((64, 64), (1e-7, 1e-7)), ExponentialAutocorrelation(1e-9, 8e-7), seed=1), folder / "map.nc"
    )
    return "map.nc", "line.csv"


def heights(table: Mapping[str, Any], folder: Path, *, missing: bool = False) -> Any:
    """Heights of the surface of a ``table`` as the page computes them."""
    built = build_surface(_table({"table": table}), folder)
    found = np.asarray(built.heights, dtype=float)
    assert missing or np.isfinite(found).all()
    return found


@pytest.fixture
def at(tmp_path: Path, request: Any) -> Any:
    """Builds a surface of a table in a folder with two files."""
    extent = request.node.callspec.params.get("extent", Extent()) if hasattr(request.node, "callspec") else Extent()
    names = files(tmp_path, extent.side)
    return lambda table, **more: heights(table, tmp_path, **more), names


@pytest.mark.parametrize("extent", EXTENTS)
@pytest.mark.parametrize("kind", SURFACE_TABLES)
def test_a_generator_begins_with_a_surface(kind: str, extent: Extent, at: Any) -> None:
    build, (a_map, line) = at
    extent = Extent(extent.sides, extent.points, (line if kind == "from_line_scan" else a_map,))
    grid = {"points": list(extent.points), "size": " x ".join(f"{side * 1e6:.10g} um" for side in extent.sides)}
    table = begun(SURFACE.tables, "kind", kind, grid, extent)  # type: ignore[arg-type]
    assert {key: table[key] for key in grid} == grid
    made = build(table)
    assert made.shape == extent.points
    assert kind == "flat" or np.ptp(made) > 0.0


@pytest.mark.parametrize("kind", SPECTRUM_TABLES)
def test_a_spectrum_begins_with_a_surface(kind: str, at: Any) -> None:
    build, (a_map, _) = at
    extent = Extent(points=(64, 64), files=(a_map,))
    spectrum = begun(SPECTRUM_TABLES, "kind", kind, {}, extent)
    assert np.ptp(build({"kind": "rough", "points": "64x64", "size": "10 um", "seed": 1, "spectrum": spectrum})) > 0.0


@pytest.mark.parametrize("kind", HEIGHTS_TABLES)
def test_heights_begin_with_a_surface(kind: str, at: Any) -> None:
    build, (a_map, _) = at
    extent = Extent(files=(a_map,))
    table = begun(SURFACE.tables, "kind", "rank_ordered", {"points": "64x64"}, extent)  # type: ignore[arg-type]
    assert np.ptp(build(table | {"heights": begun(HEIGHTS_TABLES, "kind", kind, {}, extent)})) > 0.0


@pytest.mark.parametrize("extent", EXTENTS)
@pytest.mark.parametrize("step", PREPARE.tables or ())
def test_a_step_begins_with_a_surface(step: str, extent: Extent, at: Any) -> None:
    build, _ = at
    grid = {"points": list(extent.points), "size": " x ".join(f"{side * 1e6:.10g} um" for side in extent.sides)}
    table = begun(SURFACE.tables, "kind", "rough", grid, extent)  # type: ignore[arg-type]
    before = build(table)
    model = (PREPARE.tables or {})[step]
    assert issubclass(model, AnyStep)
    after = build(table | {"prepare": [{"step": step, **starting(model, extent)}]}, missing=step in ("despike", "mask"))
    if step in ("crop", "resample", "filter", "slice", "taper"):
        assert before.shape != after.shape or np.abs(before - after).max() > 0.0


@pytest.mark.parametrize("extent", EXTENTS)
@pytest.mark.parametrize("kind", REGION_TABLES)
def test_a_region_of_a_mask_begins_with_points(kind: str, extent: Extent, at: Any) -> None:
    build, _ = at
    grid = {"points": list(extent.points), "size": " x ".join(f"{side * 1e6:.10g} um" for side in extent.sides)}
    table = begun(SURFACE.tables, "kind", "rough", grid, extent)  # type: ignore[arg-type]
    region = {"kind": kind, **starting(REGION_TABLES[kind], extent)}
    found = build(table | {"prepare": [{"step": "mask", "regions": [region]}]}, missing=True)
    share = np.count_nonzero(np.isnan(found)) / found.size
    assert 0.0 < share < 0.2


def test_every_generator_and_step_has_what_it_must(at: Any) -> None:
    _, (a_map, _) = at
    tables: dict[str, type[Settings]] = {
        **SURFACE_TABLES,
        **SPECTRUM_TABLES,
        **HEIGHTS_TABLES,
        **(PREPARE.tables or {}),
        **REGION_TABLES,
    }
    for word, model in tables.items():
        given = starting(model, Extent(files=(a_map,)))
        needed = {item.name for item in asked_of(model, frozenset({"kind", "step"})) if item.required}
        assert needed <= given.keys(), word


def test_what_was_typed_is_kept() -> None:
    tables, extent = SURFACE_TABLES, Extent()
    sphere = begun(tables, "kind", "sphere", {}, extent)
    assert begun(tables, "kind", "flat_punch", sphere, extent)["radius"] != sphere["radius"], "nobody typed it"
    typed = {**sphere, "radius": "3 um", "points": "64x32"}
    punch = begun(tables, "kind", "flat_punch", typed, extent)
    assert (punch["radius"], punch["points"]) == ("3 um", "64x32")
    slope = begun(SPECTRUM_TABLES, "kind", "two_slopes", {"kind": "self_affine", "rms_slope": "0.1"}, extent)
    assert slope["rms_slope"] == "0.1"
    assert "rms_height" not in slope, "a spectrum has one amplitude"


def awaited(work: Coroutine[Any, Any, Any]) -> Any:
    """What ``work`` gives, in a thread of its own: a browser may have left a loop in this one."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, work).result()


def of(session: Session, names: tuple[str, ...] = ()) -> Starting:
    return Starting(session, lambda: names)


def tables_of(item: Asked) -> Mapping[str, type[Settings]]:
    assert item.tables is not None
    return item.tables


def test_what_was_typed_is_there_again(tmp_path: Path) -> None:
    session = Session(tmp_path, Limits(float("inf"), 60.0), 1, kept=False)
    fills, tables = of(session), tables_of(SURFACE)

    def choose(word: str, before: dict[str, Any]) -> dict[str, Any]:
        session.draft.set(("surface",), before)
        return fills.chosen(("surface",), tables, "kind", word, before, awaited(fills.extent(("surface",))))

    sphere = choose("sphere", {}) | {"radius": "3 um"}
    rough = choose("rough", sphere) | {"size": "20 um x 20 um"}
    again = choose("sphere", rough)
    assert (again["radius"], again["size"]) == ("3 um", "20 um x 20 um")
    session.abandon()


def test_sizes_are_those_of_the_surface_at_hand(tmp_path: Path) -> None:
    session = Session(tmp_path, Limits(float("inf"), 60.0), 1, kept=False)
    a_map, _ = files(tmp_path)
    fills = of(session, (str(tmp_path / a_map),))
    crop = {"step": "crop", "x": ["0 um", "1.6 um"]}
    session.draft.set(("surface",), {"kind": "file", "path": str(tmp_path / a_map), "prepare": [crop]})

    async def asked() -> tuple[Extent, Extent]:
        found = await fills.extent(("surface", "prepare")), await fills.extent(("counter_surface",))
        await session.helper.end()
        return found

    step, counter = awaited(asked())
    assert step.points == counter.points == (16, 64)
    assert step.sides == pytest.approx((1.6e-6, 6.4e-6))
    session.abandon()
