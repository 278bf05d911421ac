"""Stresses of a contact with plastic flow: by tractions and plastic strain together, and what is
said of yield then."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.physics.stress.part import Yielding
from asperity.physics.stress.survey import StressRequest, WantedProfile, WantedSection, survey
from asperity.physics.stress.work import remarks, yield_words
from asperity.solids.eigenstrain.cells import DepthCells, depth_edges
from asperity.solids.eigenstrain.slices import slice_at
from asperity.solids.plasticity import J2, LinearHardening, von_mises

STEEL = asp.Elastic(200e9, 0.3, asp.Strength(yield_stress=0.8e9))
FILM = asp.Elastic(400e9, 0.25, asp.Strength(yield_stress=2e9))
BODY = asp.Layered([asp.Layer(FILM, 60e-9)], STEEL)
FLOW = asp.PlasticFlow((J2(FILM, LinearHardening(2e9, 20e9)), J2(STEEL, LinearHardening(0.8e9, 4e9))), cells=14)
NAMES = ("xx", "yy", "zz", "xy", "xz", "yz")


def problem(**changes: Any) -> asp.ContactProblem:
    n, m = 24, 20
    x, y = 2.0 * np.pi * np.arange(n)[:, None] / n, 2.0 * np.pi * np.arange(m)[None, :] / m
    heights = 1.2e-9 * (np.cos(x + 0.3) * np.cos(y) + 0.4 * np.cos(2 * x - y + 1.0))
    return replace(asp.ContactProblem(asp.Surface(heights, 25e-9, 25e-9), BODY, plastic_flow=FLOW), **changes)


@cache
def solved(boundary: str = "periodic") -> asp.ContactResult:
    free = boundary == "free"
    changes: dict[str, Any] = {"boundary": asp.Free()} if free else {"friction": asp.Coulomb(0.2, direction=0.4)}
    return asp.solve(problem(**changes), asp.MeanPressure(0.4e9))


def planes(field: asp.stresses.StressField) -> np.ndarray:
    return np.stack([getattr(field.tensor, name) for name in NAMES], axis=1)


@pytest.mark.parametrize("number", [0, 4, 8])
def test_means_over_cells_are_those_of_the_flow(number: int) -> None:
    """Gauss points over a depth cell, from sweeps over other cells; what is beside the stress of
    the elastic contact."""
    result = solved()
    flow = result.plastic_flow
    assert flow.residual_energy > 0.0
    edges, (points, weights) = flow.flowed.edges, np.polynomial.legendre.leggauss(4)
    low, high = edges[number], edges[number + 1]
    depths = 0.5 * (low + high) + 0.5 * (high - low) * points
    found = planes(asp.stress(result, depths)) - planes(asp.stress(replace(result, couplings={}), depths))
    mean = np.tensordot(0.5 * weights, found, (0, 0))
    wanted = flow.stress()[number]
    np.testing.assert_allclose(mean, wanted, rtol=0.0, atol=1e-6 * np.abs(wanted).max())


def test_flow_takes_the_stress_down_to_the_yield_stress() -> None:
    """In the middle of the cell that has flowed most; the elastic stress there is far beyond."""
    flow = solved().plastic_flow
    zone = max(flow.zones, key=lambda each: each.largest_strain)
    x, y, depth = zone.place
    here = asp.stresses.DepthProfile(x, y)
    held = float(asp.stress(solved(), [depth], on=here).von_mises[0])
    elastic = float(asp.stress(replace(solved(), couplings={}), [depth], on=here).von_mises[0])
    law = FLOW.plasticity[0 if zone.name == "layer 1" else 1]
    limit = float(law.hardening.yield_stress(np.array([zone.largest_strain]))[0])
    assert elastic > 1.15 * limit
    assert held == pytest.approx(limit, rel=0.05)


@pytest.mark.parametrize("boundary", ["periodic", "free"])
def test_tractions_at_surface_and_interface(boundary: str) -> None:
    """The surface carries the tractions alone; tractions pass the interface, lateral stresses jump
    there."""
    result = solved(boundary)
    field = asp.stress(result, [0.0, 60e-9])
    surface, above, below = planes(field)
    assert np.array_equal(surface[2], -result.pressure)
    scale = np.abs(above).max()
    np.testing.assert_allclose(above[[2, 4, 5]], below[[2, 4, 5]], rtol=0.0, atol=2e-4 * scale)
    assert np.abs(above[0] - below[0]).max() > 0.05 * scale
    elastic = planes(asp.stress(replace(result, couplings={}), [0.0, 60e-9]))
    assert np.abs(np.stack([surface, above, below]) - elastic).max() > 0.02 * scale


def test_below_the_cells_it_decays() -> None:
    """Deeper than the last cell the residual stress goes on without a jump, and falls by exp(-q z)
    of the longest wave or faster."""
    residual, flow = solved().plastic_flow.residual(), solved().plastic_flow
    end = float(flow.flowed.edges[-1])
    inside, outside = (residual.at(end * (1.0 + sign * 1e-5), above=True, below=True) for sign in (-1, 1))
    np.testing.assert_allclose(inside[2], outside[2], rtol=0.0, atol=1e-3 * np.abs(inside).max())
    length = solved().problem.grid.size[0]
    far = residual.at(end + 2.0 * length, above=True, below=True)
    assert np.abs(far).max() < 1e-3 * np.abs(outside).max()


def test_lines_and_sections_are_cut_from_the_planes() -> None:
    result, depths = solved(), [10e-9, 90e-9]
    whole = asp.stress(result, depths)
    section = asp.stress(result, depths, on=asp.stresses.Section(y="max"))
    j = int(np.unravel_index(result.pressure.argmax(), result.pressure.shape)[1])
    np.testing.assert_allclose(section.tensor.xx, whole.tensor.xx[:, :, j], atol=1e-9 * np.abs(whole.tensor.xx).max())


def test_displacements_are_refused() -> None:
    with refused(InputError, "displacement inside a body"):
        asp.stress(solved(), [10e-9], displacement=True)


def test_yield_is_told_by_the_flow() -> None:
    """A survey of the same contact without its plastic strain says that the body yields; with it
    what has flowed, and no factor."""
    request = StressRequest(friction=0.2, direction=0.4, sections=(), profiles=(WantedProfile("max", "max"),))
    flowed = survey(request, solved(), threads=1)
    elastic = survey(request, replace(solved(), couplings={}), threads=1)
    assert elastic.yielding.yields
    assert yield_words(elastic).alarming
    words = yield_words(flowed)
    assert not words.alarming
    assert not words.tables
    assert "base" in words.sentence
    pressure = solved().pressure
    shear = 0.2 * pressure * np.array([np.cos(0.4), np.sin(0.4)])[:, None, None]
    means = von_mises(np.moveaxis(solved().plastic_flow.stress(pressure, shear), 1, -1))
    largest = max(part.von_mises.value for part in flowed.maxima)
    assert largest == pytest.approx(float(means.max()), rel=1e-9)
    assert max(part.von_mises.value for part in elastic.maxima) > 1.05 * largest
    assert remarks(flowed)[0] != remarks(elastic)[0]
    for found, known in ((flowed, False), (elastic, True)):
        stage: Any = SimpleNamespace(found={"stress": SimpleNamespace(detail=found)})
        assert np.isfinite(Yielding().at_work.compute(None, stage).values["yield_load_factor"]) == known
    assert set(FLOW.citation_keys[:2]) <= set(flowed.citation_keys)


def test_layers_that_stay_elastic_are_not_averaged() -> None:
    """On an elastic film the survey gives the stress at the depths themselves; in the base that
    flows the means of its cells, on planes in their middle."""
    _, base = FLOW.plasticity
    result = asp.solve(problem(plastic_flow=asp.PlasticFlow((None, base), cells=14)), asp.MeanPressure(0.3e9))
    found = survey(StressRequest(sections=(WantedSection("y", "pressure"),)), result, threads=1)
    field, edges = found.sections[0].field, result.plastic_flow.flowed.edges
    means, depths = result.plastic_flow.stress(result.pressure), np.array([plane.depth for plane in field.planes])
    j = int(np.unravel_index(result.pressure.argmax(), result.pressure.shape)[1])
    exact = planes(asp.stress(result, depths[depths < 60e-9], on=asp.stresses.Section(y="pressure")))
    shown = planes(field)
    np.testing.assert_allclose(shown[: len(exact)], exact, rtol=0.0, atol=1e-9 * np.abs(exact).max())
    for number, middle in enumerate(0.5 * (edges[1:] + edges[:-1])):
        if middle > 60e-9:
            (row,) = np.flatnonzero(np.isclose(depths, middle, rtol=1e-9, atol=0.0))
            np.testing.assert_allclose(shown[row], means[number, :, :, j], rtol=1e-9)


def test_slices_hold_interfaces_and_depth() -> None:
    """At an edge, within a cell, below the last one with an interface between, and at the
    surface."""
    body = asp.Layered([asp.Layer(FILM, 1.0), asp.Layer(STEEL, 2.0)], FILM)
    cells = DepthCells(body, depth_edges(body, 0.8, 0.1, 8))
    for depth in (0.0, float(cells.edges[2]), 0.33, 2.0, 4.0):
        cut = slice_at(cells, depth, above=depth > 0.0, below=True)
        DepthCells(body, cut.edges)  # no cell crosses an interface
        assert depth in cut.edges
        for row in cut.rows:
            assert depth in cut.edges[row : row + 2]
            assert cut.edges[row + 1] - cut.edges[row] < 1e-4
        for number, owner in enumerate(cut.owner):
            middle = 0.5 * (cut.edges[number] + cut.edges[number + 1])
            inside = middle < cells.edges[-1]
            assert (owner >= 0) == inside
            assert not inside or cells.edges[owner] < middle < cells.edges[owner + 1]


def two_layers(load: float) -> asp.ContactResult:
    body = asp.Layered([asp.Layer(FILM, 60e-9), asp.Layer(STEEL, 30e-9)], FILM)
    film, steel = FLOW.plasticity
    return asp.solve(
        problem(body=body, plastic_flow=asp.PlasticFlow((film, steel, None), cells=14)), asp.MeanPressure(load)
    )


@pytest.mark.parametrize("load", [0.4e9, 1e6])
def test_faces_of_layers_are_those_of_the_stress_field(load: float) -> None:
    """Tractions by the sweeps over depth cells and by the transfer functions of stresses; tensions
    of layers that flow are means over the cells at their faces."""
    result = two_layers(load)
    flow = result.plastic_flow
    means, edges = flow.stress(result.pressure), flow.flowed.edges
    assert bool(result.plastic_flow.flowed.points.size) == (load > 1e8)
    layers = result.plastic_flow.layers(result.pressure)
    assert [layer.name for layer in layers] == ["layer 1", "layer 2"]
    field = planes(asp.stress(result, [0.0, *(layer.bottom for layer in layers)]))  # faces from the surface down
    scale = np.abs(field).max()
    for number, layer in enumerate(layers):
        upper, lower = field[2 * number], field[2 * number + 1]
        faces = upper, lower
        if means.size:
            faces = (
                means[np.searchsorted(edges, layer.top * (1.0 + 1e-9), "right") - 1],
                means[np.searchsorted(edges, layer.bottom * (1.0 - 1e-9)) - 1],
            )
        for found, face in zip((layer.top_tension, layer.bottom_tension), faces, strict=True):
            largest = np.linalg.eigvalsh(np.moveaxis(face[[[0, 3], [3, 1]]], (0, 1), (-2, -1))).max()
            assert found == pytest.approx(largest, abs=2e-3 * scale)
        np.testing.assert_allclose(layer.normal, lower[2], rtol=0.0, atol=3e-4 * scale)
        np.testing.assert_allclose(layer.shear, lower[4:6], rtol=0.0, atol=3e-4 * scale)
        assert layer.largest_shear == pytest.approx(np.hypot(lower[4], lower[5]).max(), abs=3e-4 * scale)


def test_interfaces_carry_the_load_and_nothing_without_it() -> None:
    """Mean tractions balance those at the surface; what remains has no mean, but tension across the
    interface somewhere."""
    result, shear = two_layers(0.4e9), np.stack([0.1 * np.ones((24, 20)), -0.2 * np.ones((24, 20))]) * 1e9
    for layer in result.plastic_flow.layers(result.pressure, shear):
        assert layer.normal.mean() == pytest.approx(-result.mean_pressure, rel=1e-9)
        np.testing.assert_allclose(layer.shear.mean(axis=(1, 2)), [-0.1e9, 0.2e9], rtol=1e-9)
    for layer in result.plastic_flow.layers():
        assert abs(layer.normal.mean()) < 1e-9 * np.abs(layer.normal).max()
        assert layer.peel > 0.0
    assert not asp.solve(problem(), asp.MeanPressure(1e6)).plastic_flow.layers()[0].normal.any()
