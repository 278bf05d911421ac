"""Onset of yield, yielded volume, load at yield, fracture indicators: Hertz, scaling, streams,
unknown strengths."""

import functools

import numpy as np
import pytest
from reference_data import reference
from refusals import refused

import asperity as asp
from asperity.physics.stress.compute import StressPlanes
from asperity.physics.stress.criteria import MaxPrincipal, Tresca, VonMises
from asperity.physics.stress.tractions import Tractions
from asperity.physics.stress.yielding import first_yield, fracture_indicators, load_at_yield

A = 40.0


def hertz_field(nu, depths, *, on=asp.stresses.DepthProfile(), friction=0.0, yield_stress=1.0, a=A, p0=1.0):
    """Stress under the exact pressure p0 sqrt(1 - r²/a²) on pixels of 1."""
    n = 2 * int(1.5 * a) + 1
    grid = asp.Grid((n, n), (1.0, 1.0))
    x, y = grid.centred_coordinates()
    pressure = p0 * np.sqrt(np.maximum(1.0 - (x**2 + y**2) / a**2, 0.0))
    body = asp.Elastic(1.0, nu, asp.Strength(yield_stress=yield_stress))
    return StressPlanes(Tractions(grid, pressure, asp.stresses.Sliding(friction), "free"), body, depths, on=on).whole()


@functools.cache
def around_the_onset(nu):
    return hertz_field(nu, np.linspace(0.36, 0.56, 41) * A)


@pytest.mark.parametrize(
    "row", [r for r in reference("hertz_yield_onset") if r["nu"] > 0.0], ids=lambda r: f"nu{r['nu']:g}"
)
@pytest.mark.parametrize("criterion", [VonMises(), Tresca()], ids=lambda c: c.name)
def test_onset_under_a_sphere(row, criterion):
    """Pixels of a/40 and depths a/200 apart: 6e-5 in the factor was found, the depth is within one
    step."""
    report = first_yield(around_the_onset(row["nu"]), criterion)
    assert report.load_factor == pytest.approx(row["p0_over_Y"], rel=2e-4)
    assert report.first.peak.depth / A == pytest.approx(row["z_over_a"], abs=0.005)
    assert report.first.place == "inside substrate"
    assert not report.yields
    assert "Tabor" in asp.cite(report)


def test_friction_brings_yield_to_the_surface():
    """At μ = 0.5 the largest √J2 = 0.5523 p0 lies at the trailing edge (a cusp, rounded off by the
    pixels), ν = 0.3."""
    depths = np.concatenate([[0.0], np.linspace(0.05, 0.8, 16) * A])
    report = first_yield(hertz_field(0.3, depths, on=asp.stresses.Section(y="max"), friction=0.5))
    assert report.first.peak.side == "surface"
    assert report.first.place == "surface of substrate"
    assert report.first.peak.x == pytest.approx(60.0 - A, abs=1.5)
    assert report.load_factor * np.sqrt(3.0) * 0.5523 == pytest.approx(1.0, rel=np.sqrt(1.0 / A))
    below = first_yield(hertz_field(0.3, depths[1:], on=asp.stresses.Section(y="max"), friction=0.2))
    assert below.load_factor * np.sqrt(3.0) * 0.3682 == pytest.approx(1.0, rel=0.01)
    assert below.first.peak.side == "inside"


def test_factor_times_stress_is_the_strength():
    """Twice the stress halves the factor; at the factor nothing exceeds the strength, just above
    some does."""
    depths = np.linspace(0.1, 1.0, 10) * A
    report = first_yield(hertz_field(0.3, depths))
    assert first_yield(hertz_field(0.3, depths, p0=2.0)).load_factor == pytest.approx(0.5 * report.load_factor)
    for scale, yields in ((0.999, False), (1.001, True)):
        at = first_yield(hertz_field(0.3, depths, p0=scale * report.load_factor, on=asp.stresses.Section(y="max")))
        assert at.yields is yields
        assert (at.first.yielded_volume > 0.0) is yields


def test_yielded_volume_is_that_of_a_known_zone():
    """√(3J2) under uniform pressure is largest at half the strength's level: count the zone on a
    finer set of planes."""
    coarse, fine = (
        first_yield(
            hertz_field(0.3, np.linspace(0.1, 1.4, n) * A, p0=2.5, on=asp.stresses.Everywhere(), a=16.0)
        ).first.yielded_volume
        for n in (27, 53)
    )
    assert fine == pytest.approx(coarse, rel=0.05)
    field = hertz_field(0.3, [0.48 * 16.0], p0=2.5, on=asp.stresses.Everywhere(), a=16.0)
    area = np.count_nonzero(field.von_mises > 1.0)
    assert 0.2 * area * 16.0 < fine < 1.4 * area * 16.0


COATED = asp.Layered(
    [asp.Layer(asp.Elastic(4.0, 0.25, asp.Strength(hardness=28.0), name="hard"), 10.0)],
    asp.Elastic(1.0, 0.3, asp.Strength(yield_stress=0.9), name="soft"),
)


def coated_planes(body, depths, p0=1.0):
    grid = asp.Grid((49, 49), (1.0, 1.0))
    x, y = grid.centred_coordinates()
    pressure = p0 * np.sqrt(np.maximum(1.0 - (x**2 + y**2) / 16.0**2, 0.0))
    return StressPlanes(Tractions(grid, pressure, asp.stresses.Sliding(0.2), "free"), body, depths)


def test_every_region_has_its_own_strength():
    report = first_yield(coated_planes(COATED, np.linspace(0.0, 30.0, 16)).whole())
    hard, soft = report.regions
    assert (hard.region.name, soft.region.name) == ("hard", "soft")
    assert hard.limit.inferred
    assert hard.limit.value == pytest.approx(10.0)  # hardness over 2.8
    assert not soft.limit.inferred
    assert soft.load_factor == pytest.approx(0.9 / soft.peak.value)
    assert report.first is min(report.regions, key=lambda part: part.load_factor)
    assert soft.peak.side == "below"
    assert soft.place == "interface at the upper side of soft"


def test_a_stream_of_planes_gives_the_same_report():
    depths = np.linspace(0.0, 30.0, 13)
    whole, stream = (
        first_yield(f) for f in (coated_planes(COATED, depths).whole(), coated_planes(COATED, depths).each())
    )
    for one, other in zip(whole.regions, stream.regions, strict=True):
        assert one.peak == other.peak
        assert one.load_factor == other.load_factor
        assert one.yielded_volume == other.yielded_volume


def test_unknown_strengths_are_no_number():
    nameless = asp.Layered([asp.Layer(asp.Elastic(4.0, 0.25), 10.0)], asp.Elastic(1.0, 0.3))
    report = first_yield(coated_planes(nameless, [0.0, 15.0]).whole())
    assert np.isnan(report.load_factor)
    assert report.first is None
    assert not report.yields
    assert all(np.isnan(part.yielded_volume) for part in report.regions)
    known = first_yield(coated_planes(nameless, [0.0, 15.0]).whole(), MaxPrincipal(0.1))
    assert known.first.region.index == 0
    assert known.load_factor == pytest.approx(0.1 / known.first.peak.value)


def test_load_at_yield_of_a_sphere():
    """Force 4 a³E'/3R at p0 = 1.613 Y (ν = 0.3); pixels resolve the contact by 1/12, a few per cent
    of the force."""
    R, Y, nu = 400.0, 0.03, 0.3
    grid = asp.Grid((49, 49), (1.0, 1.0))
    x, y = grid.centred_coordinates()
    body = asp.Elastic(1.0, nu, asp.Strength(yield_stress=Y))
    problem = asp.ContactProblem(asp.Surface(-(x**2 + y**2) / (2 * R), 1.0, 1.0), body, boundary=asp.Free())
    modulus = problem.contact_modulus
    p0 = 1.6128 * Y
    a = np.pi * R * p0 / (2 * modulus)
    force = 4 * a**3 * modulus / (3 * R)
    depths = np.linspace(0.3, 0.7, 21) * a
    found = load_at_yield(
        lambda load: asp.stress(asp.solve(problem, asp.Force(load)), depths, on=asp.stresses.DepthProfile(24.0, 24.0)),
        0.05 * force,
    )
    assert found.load == pytest.approx(force, rel=0.02)
    assert found.report.load_factor == pytest.approx(1.0, abs=1e-3)
    assert found.evaluations <= 6
    linear = first_yield(
        asp.stress(asp.solve(problem, asp.Force(0.125 * force)), depths * 0.5, on=asp.stresses.DepthProfile(24.0, 24.0))
    )
    assert linear.load_factor == pytest.approx(
        2.0, rel=0.02
    )  # at an eighth of the load, stresses are half, not an eighth


def test_load_at_yield_gives_up_in_words():
    with refused(asp.errors.NoSolutionError, "strength of the body"):
        load_at_yield(lambda load: hertz_field(0.3, [10.0], yield_stress=float("nan")), 1.0)
    with refused(asp.errors.NoSolutionError, "load at yield", "3 loads"):
        load_at_yield(
            lambda load: hertz_field(0.3, [10.0], a=8.0), 1.0, max_evaluations=3
        )  # stress that no load changes
    with refused(asp.InputError, "first guess of the load at yield"):
        load_at_yield(lambda load: hertz_field(0.3, [10.0]), 0.0)
    with refused(asp.InputError, "fields of a yield report"):
        first_yield(iter(()))


def test_fracture_indicators():
    field = coated_planes(COATED, [0.0, 5.0, 10.0, 20.0]).whole()
    found = {i.name: i for i in fracture_indicators(field, tensile=0.5, interface_shear=0.2)}
    assert list(found) == [
        "tension at the surface",
        "tension in hard",
        "tension in soft",
        "shear of the interface hard/soft",
        "peel of the interface hard/soft",
    ]
    surface = found["tension at the surface"]
    assert surface.peak.value == pytest.approx(field.max_principal[0].max())
    assert surface.ratio == pytest.approx(surface.peak.value / 0.5)
    shear = found["shear of the interface hard/soft"]
    assert shear.peak.value == pytest.approx(np.hypot(field.shear_xz[2], field.shear_yz[2]).max())
    assert shear.ratio == pytest.approx(shear.peak.value / 0.2)
    assert np.isnan(found["peel of the interface hard/soft"].ratio)


def test_peaks_on_chosen_planes():
    field = coated_planes(COATED, [0.0, 5.0, 20.0]).whole()
    peak = field.peak(field.von_mises, plane=1)
    assert peak.depth == 5.0
    assert peak.value == field.von_mises[1].max()
    assert field.von_mises[1, int(peak.x), int(peak.y)] == peak.value
    with refused(asp.InputError, "values of a peak"):
        field.peak(np.zeros(3))
