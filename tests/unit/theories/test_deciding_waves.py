"""Shares of octaves of wavelengths in area, plastic flow, gap and stiffness of a rough contact."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from refusals import refused

from asperity.core.errors import InputError
from asperity.theories.rough.deciding_waves import DecidingWaves, contact_areas, deciding_waves, part
from asperity.theories.rough.persson import IsotropicSpectrum, PerssonGap


def power_law(H: float, decades: int = 3) -> IsotropicSpectrum:
    q = 1e5 * 10.0 ** np.arange(decades + 1.0)
    return IsotropicSpectrum(q, 1e-25 * (q / q[0]) ** (-2.0 - 2.0 * H))


@cache
def octaves(H: float, *, hardness: float = math.inf) -> DecidingWaves:
    return deciding_waves(power_law(H), 1e11, 1e6, hardness=hardness)


@pytest.mark.parametrize(
    ("H", "m0", "m2"),
    [
        (0.3, (0.76, 0.19, 0.05), (0.002, 0.04, 0.96)),
        (0.5, (0.90, 0.09, 0.01), (0.01, 0.09, 0.90)),
        (0.8, (0.975, 0.02, 0.001), (0.10, 0.26, 0.64)),
    ],
)
def test_decades_of_a_power_law_share_its_moments(
    H: float, m0: tuple[float, float, float], m2: tuple[float, float, float]
) -> None:
    spectrum = power_law(H)
    for order, table in ((1, m0), (3, m2)):
        spans = np.log(10.0) * np.arange(4.0)
        sums = np.diff(spectrum.partial_moment(order, spans)) / spectrum.moment(order)
        assert sums == pytest.approx(table, abs=0.006)  # the table has two digits
    found = octaves(H)
    for name, order in (("height", 1), ("slope", 3), ("curvature", 5)):
        edges = np.log(1e8 * 2.0 ** np.arange(-9.0, 1.0) / 1e5)
        edges[0] = 0.0
        wanted = np.diff(spectrum.partial_moment(order, edges)) / spectrum.moment(order)
        assert found.shares[name] == pytest.approx(wanted, rel=1e-6)


@pytest.mark.parametrize(("H", "ratio"), [(0.8, 4.5), (0.5, 13.0)])
def test_waves_that_the_rms_height_needs(H: float, ratio: float) -> None:
    exact = (0.05 * (1.0 + H)) ** (-0.5 / H)  # tail of a plateau and a power law beyond it
    assert exact == pytest.approx(ratio, rel=0.03)
    q = np.array([1e3, 1e5, 1e8])
    spectrum = IsotropicSpectrum(q, 1e-25 * np.maximum(q / 1e5, 1.0) ** (-2.0 - 2.0 * H))
    need = deciding_waves(spectrum, 1e11, 1e6).needs["height"]
    wave = 2.0 * math.pi / 1e5 / exact
    step = 2.0**0.25  # wavenumbers are tried a quarter of an octave apart
    assert wave / step * 0.98 <= need.shortest <= wave * 1.02
    assert need.settled
    assert need.interval == 0.25 * need.shortest
    assert need.size == 4.0 * need.longest


def test_shortest_waves_decide_an_elastic_area_and_longest_the_gap() -> None:
    found = octaves(0.5)
    assert found.shares["area"][-1] > 0.5
    assert found.shares["mean_gap"][0] > 0.4
    assert not found.needs["area"].settled
    assert not found.needs["slope"].settled
    for name in ("height", "mean_gap"):  # no roll-off: no scan is long enough
        assert not found.needs[name].bounded
    assert found.needs["curvature"].bounded
    told = {item.criterion: item for item in found.findings(1.0, 1e-9)}
    assert "waves of the mean gap" in told
    assert "waves of the rms curvature" not in told or not found.needs["curvature"].settled
    assert "plastic" not in found.shares
    for shares in found.shares.values():
        assert float(shares.sum()) == pytest.approx(1.0, rel=1e-9)
    gap = PerssonGap(1e11, power_law(0.5))
    assert found.values["mean_gap"] == pytest.approx(float(gap.mean_gap(1e6)), rel=1e-6)


def test_plastic_flow_makes_short_waves_needless() -> None:
    found = octaves(0.3, hardness=1e9)
    assert found.needs["area"].settled
    assert found.values["plastic"] == pytest.approx(1e6 / 1e9, rel=1e-6)
    assert found.values["area"] == pytest.approx(1e6 / 1e9, rel=1e-6)


def test_pressure_between_two_absorbing_bounds() -> None:
    p, H = 3e7, 5e8
    reach = (H - p) / 8.999  # just where the series begins
    elastic, plastic = contact_areas(p, reach, H)
    assert elastic == pytest.approx(math.erf(p / (math.sqrt(2.0) * reach)), rel=1e-9)
    assert plastic == pytest.approx(0.0, abs=1e-12)
    spreads = np.geomspace(1e7, 5e9, 30)
    areas = np.array([contact_areas(p, float(spread), H) for spread in spreads])
    assert (np.diff(areas[:, 0]) <= 1e-12).all()
    assert (np.diff(areas[:, 1]) >= -1e-12).all()
    assert areas[-1] == pytest.approx([0.0, p / H], rel=1e-9, abs=1e-12)


def test_parts_of_a_spectrum_add_up() -> None:
    spectrum = power_law(0.8)
    long, short = part(spectrum, 1e5, 3e6), part(spectrum, 3e6, 1e8)
    for order in (1, 3, 5):
        assert long.moment(order) + short.moment(order) == pytest.approx(spectrum.moment(order), rel=1e-9)


def test_findings_recommend_size_and_interval() -> None:
    q = np.array([1e3, 1e5, 1e8])
    found = deciding_waves(IsotropicSpectrum(q, 1e-25 * np.maximum(q / 1e5, 1.0) ** -3.6), 1e11, 1e6)
    need = found.needs["mean_gap"]
    enough = found.findings(need.size, need.interval)
    assert not [item for item in enough if "mean gap" in item.criterion]
    short = [item for item in found.findings(0.5 * need.size, need.interval) if "mean gap" in item.criterion]
    coarse = [item for item in found.findings(need.size, 2.0 * need.interval) if "mean gap" in item.criterion]
    assert [item.numbers["size"] for item in short] == [need.size]
    assert [item.numbers["interval"] for item in coarse] == [need.interval]
    cut = [item for item in enough if item.criterion == "waves of the rms slope"]
    assert cut[0].level == "note"
    assert {item.level for item in enough if item.criterion == "waves of the real area"} == {"warning"}


def test_throats_of_the_leak_stand_where_contact_percolates() -> None:
    spectrum = power_law(0.8)
    found = deciding_waves(spectrum, 1e11, 2e8)
    q = 2.0 * math.pi / found.leak_wavelength
    h = part(spectrum, 1e5, q).rms_slope
    step = 2.0 ** (0.25 * 0.2)  # between quarters of an octave the fraction is taken as linear
    area = math.erf(math.sqrt(2.0) * 2e8 / (1e11 * h))
    assert area == pytest.approx(0.42, rel=step - 1.0)


def test_refusals() -> None:
    with refused(InputError, "pressure (Pa)", "2e+06"):
        deciding_waves(power_law(0.5), 1e11, 2e6, hardness=1e6)
    with refused(InputError, "tolerance of an answer", "2"):
        deciding_waves(power_law(0.5), 1e11, 1e6, tolerance=2.0)
    with refused(InputError, "spectrum"):
        deciding_waves(IsotropicSpectrum([1e5, 1.5e5], [1e-24, 1e-25]), 1e11, 1e6)
