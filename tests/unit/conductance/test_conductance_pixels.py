"""What pixels take from a conductance: closed forms of given sets of pixels and of contacts."""

from __future__ import annotations

import math

import numpy as np
import pytest

import asperity as asp
from asperity.contact.edge_tables import EdgePixels
from asperity.contact.edges import Edges, Setting, edges_of
from asperity.contact.operators import prepare_operator
from asperity.physics.conductance.conductance import conductance
from asperity.physics.conductance.law import ConductingInterface
from asperity.physics.conductance.pixels import freed_of_pixels
from asperity.physics.conductance.solver import flux
from asperity.solids import Conduction
from asperity.solids.compliance.halfspace import HalfSpace
from asperity.theories.conductance import spots

K = 20.0
BODY = asp.Elastic(0.91, 0.3, conduction=Conduction(K))
UNUSED = np.array([0.1, 1.0])


def edges_of_pixels(contact: np.ndarray, grid: asp.Grid, *, wraps: bool) -> Edges:
    """The borders of the pixels, as of a contact at the limit of its pressure everywhere."""
    setting = Setting(grid, (wraps, wraps), 1.0, EdgePixels(UNUSED, UNUSED, UNUSED, UNUSED))
    return edges_of(contact.astype(float), np.zeros(contact.shape), contact, setting)


def errors(contact: np.ndarray, grid: asp.Grid, boundary, true: float) -> tuple[float, float, float]:
    """Relative error of the conductance of these pixels, the same freed of them, and its bound."""
    found = flux(prepare_operator(HalfSpace(1.0), grid, boundary), contact)
    total = found.mean * grid.area
    edges = edges_of_pixels(contact, grid, wraps=any(boundary.wraps))
    freed = freed_of_pixels(edges, found.density, 1.0)
    return total / true - 1.0, (total + freed.gain) / true - 1.0, freed.error / true


def places(n: int, x: float, y: float) -> tuple[np.ndarray, np.ndarray]:
    place = np.arange(n) - 0.5 * (n - 1)
    return place[:, None] - x, place[None, :] - y


def ellipse(a: float, b: float, angle: float) -> np.ndarray:
    x, y = places(int(2 * a) + 5, 0.31, 0.17)
    cos, sin = math.cos(angle), math.sin(angle)
    return ((x * cos + y * sin) / a) ** 2 + ((y * cos - x * sin) / b) ** 2 < 1.0


def assert_freed(raw: float, freed: float, bound: float, times: float = 3.0) -> None:
    assert abs(freed) < abs(raw) / times
    assert abs(freed) < bound


@pytest.mark.parametrize("radius", [3.0, 5.0, 8.0, 12.3, 20.0, 40.0])
def test_circles(radius: float) -> None:
    contact = ellipse(radius, radius, 0.0)
    true = float(spots.circle(1.0, math.sqrt(contact.sum() / math.pi)))
    assert_freed(*errors(contact, asp.Grid(contact.shape, (1.0, 1.0)), asp.Free(), true))


@pytest.mark.parametrize(("a", "b", "angle"), [(16.0, 8.0, 0.0), (16.0, 8.0, 0.4), (20.0, 5.0, 0.7), (24.0, 6.0, 1.3)])
def test_ellipses(a: float, b: float, angle: float) -> None:
    contact = ellipse(a, b, angle)
    scale = math.sqrt(contact.sum() / (math.pi * a * b))  # of the area of the pixels
    true = spots.ellipse(1.0, a * scale, b * scale)
    assert_freed(*errors(contact, asp.Grid(contact.shape, (1.0, 1.0)), asp.Free(), true))


@pytest.mark.parametrize("side", [6, 8, 16, 32])
def test_squares(side: int) -> None:
    """1.1523 k_s s, of one side 2.3045 k s; the corners are not corrected for."""
    contact = np.pad(np.ones((side, side), dtype=bool), 1)
    true = spots.square(1.0, float(side))
    assert_freed(*errors(contact, asp.Grid(contact.shape, (1.0, 1.0)), asp.Free(), true))


@pytest.mark.parametrize("fraction", [0.1, 0.3, 0.5, 0.8])
def test_strips_along_the_grid(fraction: float) -> None:
    n = 64
    contact = np.zeros((n, 1), dtype=bool)
    contact[: round(fraction * n)] = True
    true = float(spots.strips(1.0, contact.mean(), float(n))) * n * n
    assert_freed(*errors(contact, asp.Grid(contact.shape, (1.0, float(n))), asp.Periodic(), true), times=20.0)


@pytest.mark.parametrize(("a", "b"), [(1, 8), (1, 3), (2, 3), (1, 1)])
def test_oblique_strips(a: int, b: int) -> None:
    n = 128
    x = np.arange(n)
    repeats = max(1, round(4 / math.hypot(a, b)))
    phase = ((a * x[:, None] + b * x[None, :]) * repeats / n + 0.123) % 1.0
    contact = phase < 0.4
    true = float(spots.strips(1.0, contact.mean(), n / math.hypot(a, b) / repeats)) * n * n
    assert_freed(*errors(contact, asp.Grid((n, n), (1.0, 1.0)), asp.Periodic(), true), times=5.0)


def sphere(pixels: float, offset: float) -> tuple[asp.ContactResult, float]:
    """Hertz's contact of so many pixels in the radius, and that radius."""
    x, y = places(int(2.6 * pixels), offset, offset)
    dx = 0.1 / pixels
    surface = asp.Surface(-0.25 * (x**2 + y**2) * dx**2, dx)
    force = asp.Force(4.0 / 3.0 * 0.1**3 / 2.0)
    return asp.solve(asp.ContactProblem(surface, BODY, boundary=asp.Free()), force), 0.1


def test_hertzian_contacts() -> None:
    """The uncorrected error scatters with the place of the spot on the grid; the largest falls at
    least threefold."""
    raw, freed = [], []
    for pixels in (4.0, 6.0, 8.0, 12.0, 24.0):
        for offset in (0.0, 0.1, 0.3):
            result, a = sphere(pixels, offset)
            found = conductance(result, "thermal")
            true = float(spots.circle(2.0 * K, a))
            raw.append(abs(found.total / true - 1.0))
            freed.append(abs(found.extrapolated / true - 1.0))
            assert freed[-1] < found.extrapolated_error
    assert max(freed) < max(raw) / 3.0
    assert max(freed) < 5e-3


@pytest.mark.parametrize("film", [0.002, 0.02, 1.0])
def test_films_on_hertzian_contacts(film: float) -> None:
    """Beside a contact of five times as many pixels; a thick film conducts by the area."""
    fine = conductance(sphere(40.0, 0.3)[0], "thermal", ConductingInterface(film_resistance=film))
    found = conductance(sphere(8.0, 0.3)[0], "thermal", ConductingInterface(film_resistance=film))
    assert fine.extrapolated_error < 0.35 * found.extrapolated_error
    assert abs(found.extrapolated - fine.extrapolated) < abs(found.total - fine.extrapolated) / 3.0
    assert abs(found.extrapolated / fine.extrapolated - 1.0) < found.extrapolated_error


@pytest.mark.parametrize("hardness", [None, 0.05])
def test_rough_contacts_agree_with_finer_grids(hardness: float | None) -> None:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.2), hurst=0.8, rolloff_wavelength=72.0, shortest_wavelength=24.0
    )
    surface = asp.generate.gaussian(asp.Grid((288, 288), (1.0, 1.0)), spectrum, seed=1)
    more = {} if hardness is None else {"law": asp.Hardness(hardness)}
    found = []
    for step in (1, 2, 3):
        coarse = asp.Surface(np.ascontiguousarray(surface.heights[::step, ::step]), float(step), periodic=True)
        result = asp.solve(asp.ContactProblem(coarse, BODY, **more), asp.MeanPressure(0.005))
        found.append(conductance(result, "thermal"))
    fine = found[0]
    for each in found[1:]:
        assert abs(each.extrapolated / fine.extrapolated - 1.0) < each.extrapolated_error + fine.extrapolated_error


def test_without_contact_and_in_full_contact_there_is_nothing_to_extrapolate() -> None:
    surface = asp.Surface(np.random.default_rng(1).standard_normal((16, 16)) * 0.01, 1.0, periodic=True)
    problem = asp.ContactProblem(surface, BODY)
    none = conductance(asp.solve(problem, asp.Unloaded()), "thermal")
    assert (none.extrapolated, none.extrapolated_error) == (0.0, 0.0)
    full = conductance(asp.solve(problem, asp.MeanPressure(10.0)), "thermal")
    assert (full.extrapolated, full.extrapolated_error) == (math.inf, 0.0)
