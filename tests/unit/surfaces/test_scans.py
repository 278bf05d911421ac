"""Scans of one surface by several instruments: reliable bands, one spectrum, agreement,
generation."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from reference_data import FOLDER, reference
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.generate import SelfAffine, gaussian
from asperity.surfaces import Profile, Scan, Scans
from asperity.surfaces.characterise.scans_spectrum import ScansSpectrum

TRUTH = {str(row["scan"]): row for row in reference("profiles/scans_truth")}


def reference_scans(**factors: float) -> list[Scan]:
    """The three reference scans, heights times a factor by name."""
    heights = np.load(FOLDER / "profiles/scans.npz")
    return [
        Scan(factors.get(name, 1.0) * heights[f"A_{name}"].astype(float), float(row["spacing_m"]), name=name)
        for name, row in TRUTH.items()
    ]


@cache
def combined() -> ScansSpectrum:
    return Scans(reference_scans()).spectrum()


def criteria(found: ScansSpectrum) -> list[str]:
    return [item.criterion for item in found.findings]


def test_spectrum_of_three_instruments_is_that_of_the_reference_fit() -> None:
    (row,) = reference("profiles/scans_fit")
    found = combined()
    assert found.hurst == pytest.approx(float(row["hurst"]), abs=0.2 * float(row["hurst_se"]))
    assert found.hurst_error >= 0.999 * float(row["hurst_se"])
    assert found.hurst == pytest.approx(float(TRUTH["afm"]["hurst"]), abs=2.0 * found.hurst_error)


def test_roll_off_is_not_claimed_where_the_longest_scan_holds_three() -> None:
    found, truth = combined(), float(TRUTH["stylus"]["q0_rad_per_m"])
    assert not found.rolloff_seen
    assert truth < found.corner_bound < 10.0 * truth
    assert "roll-off" in criteria(found)


def test_combined_curve_holds_the_truth_within_its_errors() -> None:
    curve, truth = combined().curve, TRUTH["afm"]
    q0, H = float(truth["q0_rad_per_m"]), float(truth["hurst"])
    level = 4.0 * math.pi * H * float(truth["rms_height_m"]) ** 2 / q0**2
    factor = math.gamma(H + 0.5) / math.gamma(H + 1.0) / (2.0 * math.sqrt(math.pi))
    C1D = level * q0 * factor * (1.0 + (curve.q / q0) ** 2) ** -(0.5 + H)
    deviation = (curve.profile_psd / C1D - 1.0) / curve.error
    # χ² of n bands has the variance 2n, and lies within three of its standard deviations
    n = curve.q.size
    assert float(deviation @ deviation) == pytest.approx(n, abs=3.0 * math.sqrt(2.0 * n))
    assert curve.scans.max() == 2
    assert curve.lines.min() == 6


def test_scans_of_one_surface_agree() -> None:
    assert max(abs(item.deviation) for item in combined().agreements) < 3.0
    assert "agreement" not in criteria(combined())


def test_wrong_height_calibration_is_found() -> None:
    found = Scans(reference_scans(optical=3.0)).spectrum()
    off = {item.scan for item in found.agreements if abs(item.deviation) > 3.0}
    assert 1 in off
    (about,) = [item for item in found.findings if item.criterion == "agreement" and "optical" in item.fact]
    assert about.numbers["ratio"] == pytest.approx(9.0, rel=0.5)  # of some thirty modes


def test_lines_of_different_places_show_in_the_sandwich_error() -> None:
    rng = np.random.default_rng(7)
    scattered = [
        Scan(scan.heights * np.exp(0.5 * rng.standard_normal((scan.heights.shape[0], 1))), scan.spacing, name=scan.name)
        for scan in reference_scans()
    ]
    found = Scans(scattered).spectrum(corner="rounded")
    assert found.fit.error("H", by="sandwich") > found.fit.error("H")
    assert found.curve.scatter.max() > combined().curve.scatter.max()


def test_lines_of_a_map_are_not_independent() -> None:
    grid = asp.Grid((128, 128), (1e-6, 1e-6))
    spectrum = SelfAffine(
        amplitude=asp.generate.RmsHeight(1e-7), hurst=0.7, rolloff_wavelength=32e-6, shortest_wavelength=2e-6
    )
    flat = gaussian(grid, spectrum, seed=4, periodic=False)
    as_map = Scans([flat]).spectrum(corner="sharp")
    as_lines = Scans([Scan(flat.heights.T, flat.dx)]).spectrum(corner="sharp")
    assert as_map.fit.error("H") > 1.5 * as_lines.fit.error("H")
    assert as_map.hurst == pytest.approx(0.7, abs=3.0 * as_map.fit.error("H"))


def test_limits_say_what_ends_the_reliable_waves() -> None:
    (scan, *_) = reference_scans()
    limits = {
        by: Scan.of(scan, **known).limits()
        for by, known in {
            "sampling": {},
            "tip": {"tip_radius": 2e-3},
            "resolution": {"resolution": 20e-6},
            "filter": {"short_cutoff": 10e-6},
        }.items()
    }
    assert {by: item.by for by, item in limits.items()} == {by: by for by in limits}
    assert limits["sampling"].shortest == 4.0 * scan.spacing
    assert (limits["sampling"].first, limits["sampling"].last) == (3, 63)
    assert limits["resolution"].shortest == 40e-6
    assert limits["filter"].shortest == 40e-6
    assert limits["tip"].last < limits["sampling"].last


def test_transfer_of_a_lens_is_taken_out() -> None:
    (scan, *_) = reference_scans()
    plain = scan.modes()
    lens = Scan.of(scan, kind="optical", resolution=2e-6).modes()
    x = 2e-6 / (2.0 * np.pi / lens.q)
    wanted = 2.0 / np.pi * (np.arccos(x) - x * np.sqrt(1.0 - x**2))
    assert lens.transfer == pytest.approx(wanted**2, rel=1e-12)
    assert plain.transfer == pytest.approx(np.ones(plain.modes.size))


def test_generated_surface_has_the_combined_spectrum() -> None:
    found = combined()
    grid = asp.Grid((256, 256), (4e-6, 4e-6))
    made = gaussian(grid, found.extended(8e-6), seed=2, variant="fixed")
    m0 = float(np.mean(made.heights**2))
    psd = found.extended(8e-6).lattice_psd(grid)
    double = np.full(psd.shape[1], 2.0)
    double[[0, -1]] = 1.0
    assert m0 == pytest.approx(float((psd * double).sum()) / (grid.size[0] * grid.size[1]), rel=1e-9)
    assert "extrapolated" in found.extended(1e-9).describe(grid)
    assert "extrapolated" not in found.describe(grid)
    with refused(InputError, "grid of 3e-08 x 3e-08 m"):
        gaussian(asp.Grid((3, 3), (1e-8, 1e-8)), found, seed=1)


def test_moments_are_those_of_the_closed_form() -> None:
    found = combined()
    model, q = found.model, 2.0 * math.pi / found.shortest_wavelength
    H, x2 = model.hurst, (q / model.corner) ** 2
    assert found.moments()[0] == pytest.approx(model.variance * (1.0 - (1.0 + x2) ** -H), rel=1e-9)
    long, short = found.moments(longest_wavelength=1e-5), found.moments(1e-5)
    assert np.add(long, short) == pytest.approx(found.moments(), rel=1e-9)


def test_a_line_scan_brings_its_instrument() -> None:
    heights = reference_scans()[0].heights[0]
    line = Profile(heights, 1e-6, short_cutoff=2.5e-6).of_instrument(kind="stylus", tip_radius=2e-6, noise=1e-9)
    found = Scan.of(line)
    assert (found.kind, found.tip_radius, found.noise, found.short_cutoff) == ("stylus", 2e-6, 1e-9, 2.5e-6)
    assert found.heights.shape == (1, 256)


def test_missing_points_are_bridged_and_poor_lines_left_out() -> None:
    heights = np.tile(np.sin(np.arange(64.0)), (3, 1))
    heights[0, 10] = np.nan
    heights[1, 10:40] = np.nan
    scan = Scan(heights, 1.0)
    assert scan.levelled_lines().shape == (2, 64)
    assert np.isfinite(scan.levelled_lines()).all()


def test_scale_curves_follow_the_fitted_spectrum() -> None:
    curves = Scans(reference_scans()).scale_curves(combined())
    for name, curve in curves.items():
        assert (np.diff(curve.length) > 0.0).all(), name
        assert curve.lines.max() >= 12, name
        # the same lines as those of the fit: no length is off by much more than its own error
        off = np.log(curve.value / curve.expected) / curve.error
        assert np.median(np.abs(off)) < 2.0, name
    rms = 2.0 * math.pi / combined().model.corner
    assert curves["height"].value[-1] < math.sqrt(combined().model.variance)
    assert curves["height"].length[-1] < rms


def test_scale_curves_do_not_see_a_tilt() -> None:
    tilted = [Scan(scan.heights + 1e-2 * scan.spacing * np.arange(256), scan.spacing) for scan in reference_scans()]
    plain = Scans(reference_scans()).scale_curves(combined())
    for name, curve in Scans(tilted).scale_curves(combined()).items():
        assert curve.value == pytest.approx(plain[name].value, rel=1e-6)  # heights are differences of larger ones


def test_refusals() -> None:
    with refused(InputError, "scans of a surface"):
        Scans([])
    with refused(InputError, "scan of a surface", "str"):
        Scans(["stylus.txt"])
    with refused(InputError, "heights of a scan (m)", "(2, 3)"):
        Scan(np.zeros((2, 3)), 1e-6)
    with refused(InputError, "tip radius of a scan (m)", "-1e-06"):
        Scan(np.zeros((2, 16)), 1e-6, tip_radius=-1e-6)
    with refused(InputError, "scans of a surface", "resolution"):
        Scans([Scan(reference_scans()[0].heights, 1e-6, resolution=1e-3)]).spectrum()
    with refused(InputError, "corner of a spectrum", "soft"):
        Scans(reference_scans()).spectrum(corner="soft")
