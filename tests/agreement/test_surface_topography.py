"""The field's library SurfaceTopography has many of the same quantities: where it is right, ours
are equal."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from importlib.metadata import version
from typing import Any

import numpy as np
import pytest

import asperity as asp
from asperity import roughness as r

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # the library warns where MPI is missing
    from SurfaceTopography import Topography

if tuple(map(int, version("SurfaceTopography").split(".")[:2])) < (1, 27):
    pytest.skip("older ones fail here: slopes along y and means over rings of odd grids", allow_module_level=True)

pytestmark = pytest.mark.filterwarnings("ignore:Function/property:DeprecationWarning")  # of their own short names

SHAPES = {"even": ((48, 36), 0.5, 0.75), "odd": ((35, 27), 0.2, 0.3), "square": ((64, 64), 1.0, 1.0)}


def heights(shape: tuple[int, int]) -> np.ndarray:
    noise = np.random.default_rng(sum(shape)).standard_normal(shape)
    return sum(np.roll(noise, (i, j), (0, 1)) for i in range(4) for j in range(3))


@pytest.fixture(params=SHAPES)
def shape(request: pytest.FixtureRequest) -> tuple[tuple[int, int], float, float]:
    return SHAPES[request.param]


def both(shape: tuple[tuple[int, int], float, float], *, periodic: bool) -> tuple[asp.Surface, Any]:
    points, dx, dy = shape
    h = heights(points)
    theirs = Topography(h, (points[0] * dx, points[1] * dy), periodic=periodic)
    return asp.Surface(h, dx, dy, periodic=periodic), theirs


PERIODIC: dict[str, tuple[Callable[[asp.Surface], float], Callable[[Any], float]]] = {
    "rms height": (asp.roughness.rms_height, lambda t: t.rms_height_from_area()),
    "rms gradient": (asp.roughness.rms_slope, lambda t: t.rms_gradient()),
    "rms slope along x": (lambda s: r.rms_profile_slope(s, axis="x"), lambda t: t.rms_slope_from_profile()),
    "rms slope along y": (lambda s: r.rms_profile_slope(s, axis="y"), lambda t: t.transpose().rms_slope_from_profile()),
    "rms curvature along x": (
        lambda s: r.rms_profile_curvature(s, axis="x"),
        lambda t: t.rms_curvature_from_profile(),
    ),
    "rms Laplacian": (r.rms_laplacian, lambda t: t.rms_laplacian()),
}


@pytest.mark.parametrize("name", PERIODIC)
def test_scalars(shape, name):
    surface, theirs = both(shape, periodic=True)
    ours, other = PERIODIC[name]
    assert ours(surface) == pytest.approx(other(theirs), rel=1e-12)


@pytest.mark.parametrize("name", ["rms height"])
def test_scalars_of_maps_that_are_not_periodic(shape, name):
    surface, theirs = both(shape, periodic=False)
    ours, other = PERIODIC[name]
    assert ours(surface) == pytest.approx(other(theirs), rel=1e-12)


def test_gradient_where_both_differences_exist(shape):
    """Theirs is restricted to common nodes, as our slope tensor is."""
    surface, theirs = both(shape, periodic=False)
    tensor = r.slope_tensor(surface)
    assert math.sqrt(tensor.xx + tensor.yy) == pytest.approx(theirs.rms_gradient(), rel=1e-12)


@pytest.mark.parametrize("axis", ["x", "y"])
def test_profile_spectra(shape, axis):
    surface, theirs = both(shape, periodic=True)
    along = theirs if axis == "x" else theirs.transpose()
    q, psd = along.power_spectrum_from_profile(window=None, reliable=False, resampling_method=None)
    ours = r.profile_spectrum(surface, axis=axis)
    number = min(len(q) - 1, ours.q.size)
    assert q[1 : number + 1] == pytest.approx(ours.q[:number], rel=1e-12)
    assert np.asarray(psd[1 : number + 1]) == pytest.approx(ours.psd[:number], rel=1e-9)


@pytest.mark.parametrize("periodic", [True, False])
def test_spectrum_of_the_map(shape, periodic):
    """Their window of maps that are not periodic is the radial one, of the full width of square
    maps."""
    surface, theirs = both(shape if periodic else SHAPES["square"], periodic=periodic)
    heights_ = surface.heights - surface.heights.mean()
    centred = Topography(heights_, theirs.physical_sizes, periodic=periodic)
    *_, full = centred.power_spectrum_from_area(return_map=True, reliable=False)
    ours = r.power_spectrum(surface, "none" if periodic else "radial hann")
    half = np.asarray(full)[:, : ours.psd.shape[1]].copy()
    half[0, 0] = 0.0
    assert half == pytest.approx(ours.psd, rel=1e-9, abs=1e-12 * ours.psd.max())


def test_radial_mean(shape):
    surface, theirs = both(shape, periodic=True)
    edges = np.linspace(0.0, math.pi / max(surface.dx, surface.dy), 9) * (1.0 + 1e-9)  # no mode lies on an edge
    _, psd = theirs.power_spectrum_from_area(reliable=False, collocation=edges)
    ours = r.radial_spectrum(r.power_spectrum(surface), edges)
    assert np.asarray(psd)[1:] == pytest.approx(ours.psd[1:], rel=1e-9)  # their first bin counts the mean


@pytest.mark.parametrize("holes", [False, True])
@pytest.mark.parametrize("periodic", [True, False])
def test_height_difference_autocorrelation_is_half_the_structure_function(shape, periodic, holes):
    surface, theirs = both(shape, periodic=periodic)
    if holes:
        h = np.where(np.random.default_rng(3).random(surface.shape) < 0.05, np.nan, surface.heights)
        surface = asp.Surface(h, surface.dx, surface.dy, periodic=periodic)
        theirs = Topography(np.ma.masked_invalid(h), theirs.physical_sizes, periodic=periodic)
    distance, half = theirs.autocorrelation_from_profile(reliable=False, resampling_method=None)
    ours = r.structure_function(surface, lags=range(1, 6))
    assert np.asarray(distance)[1:6] == pytest.approx(ours.lag, rel=1e-12)
    assert 2.0 * np.asarray(half)[1:6] == pytest.approx(ours.value, rel=1e-9)


def test_scale_dependent_slope_and_curvature(shape):
    surface, theirs = both(shape, periodic=True)
    steps = [1, 2, 4]
    ours = r.scale_dependence(surface, steps=steps, structure=r.structure_function(surface, lags=steps))

    def rms(along_x, along_y=None):
        return np.sqrt(np.mean(along_x**2))

    def least(along_x, along_y=None):
        return np.min(along_x)

    distances = surface.dx * np.array(steps, dtype=float)
    _, slope = theirs.scale_dependent_statistical_property(rms, n=1, distance=distances)
    _, curvature = theirs.scale_dependent_statistical_property(rms, n=2, distance=2.0 * distances)
    _, sharpest = theirs.scale_dependent_statistical_property(least, n=2, distance=2.0 * distances)
    assert np.asarray(slope).ravel() == pytest.approx(ours.slope, rel=1e-10)
    assert np.asarray(curvature).ravel() == pytest.approx(ours.curvature, rel=1e-10)
    assert np.asarray(sharpest).ravel() == pytest.approx(ours.sharpest, rel=1e-10)


@pytest.mark.parametrize("radius", [0.3, 1.0, 4.0])
def test_tip_cutoff(radius):
    """Theirs finds the root of the interpolated curvature along x, ours lies between the same two
    stencils."""
    surface, theirs = both(((256, 32), 0.1, 0.1), periodic=True)
    scaled = asp.Surface(0.02 * surface.heights, surface.dx, surface.dy, periodic=True)
    theirs = theirs.scale(0.02)
    expected = theirs.scanning_probe_reliability_cutoff(radius)
    dependence = r.scale_dependence(scaled, axis="x", steps=range(1, 64))
    found = r.tip_cutoff(dependence, radius)
    if expected is None:
        assert found == 0.0
    else:
        # the least curvature of noise is no smooth function of the length, several roots lie within
        # some pixels
        assert found == pytest.approx(expected, abs=8.0 * surface.dx)


def test_missing_points_are_ours_alone():
    """They drop whole stencil positions around a missing point; a stencil without one counts
    here."""
    h = heights((40, 30))
    h[7, 11] = np.nan
    surface = asp.Surface(h, 1.0)
    differences = np.diff(h, axis=0)
    expected = np.sqrt(np.nanmean(differences**2))
    assert r.rms_profile_slope(surface, axis="x") == pytest.approx(expected, rel=1e-13)
