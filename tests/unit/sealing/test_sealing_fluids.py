"""Liquids and gases that leak: closed forms, limits, and what is refused."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from refusals import refused
from scipy import ndimage

from asperity.core.errors import ConvergenceError, InputError
from asperity.core.grid import Grid
from asperity.core.units import parse
from asperity.physics.sealing import fluids
from asperity.physics.sealing.flow import GapFlow, flow_through
from asperity.physics.sealing.fluids import GASES, IdealGas, Leak, ViscousLiquid
from asperity.theories.sealing.gaps import ATMOSPHERE

GRID = Grid((48, 48), (1e-5, 1e-5))
AIR = GASES["air"]


def even(gap: float, repeats: bool = False) -> GapFlow:
    return flow_through(np.full(GRID.shape, gap), GRID, wraps=(True, True), repeats=repeats)


def rough(repeats: bool = False, scale: float = 1e-6) -> GapFlow:
    heights = ndimage.gaussian_filter(np.random.default_rng(3).standard_normal(GRID.shape), 2.0, mode="wrap")
    gap = scale * np.maximum(heights / heights.std() + 0.6, 0.0)
    return flow_through(gap, GRID, wraps=(True, True), repeats=repeats)


@pytest.mark.parametrize("repeats", [False, True])
def test_liquid_in_an_even_gap(repeats: bool) -> None:
    found = ViscousLiquid(1e-3).leak(even(2e-6, repeats), 3e5, 1e5)
    assert found.rate == pytest.approx((2e-6) ** 3 * 2e5 / 12e-3, rel=1e-12)
    middle = found.pressure.mean(axis=1)
    np.testing.assert_allclose(middle, 1e5 + 2e5 * (1.0 - (np.arange(48) + 0.5) / 48), rtol=1e-9)


@pytest.mark.parametrize("repeats", [False, True])
@pytest.mark.parametrize(("inlet", "outlet"), [(2e5, 1e5), (1e5, 0.0), (2e3, 1e3)])
def test_gas_in_an_even_gap(repeats: bool, inlet: float, outlet: float) -> None:
    """Throughput g³ (P1² - P2²)/2 + 6 λP g² (P1 - P2) over 12 η, at any Knudsen number."""
    gap = 1e-6
    exact = gap**3 * (inlet**2 - outlet**2) / 2.0 + 6.0 * AIR.slip_length * gap**2 * (inlet - outlet)
    found = AIR.leak(even(gap, repeats), inlet, outlet)
    assert found.rate == pytest.approx(exact / (12.0 * AIR.viscosity), rel=1e-8)
    assert found.slip_factor > 1.0


def test_gas_without_slip_is_a_liquid_at_the_mean_pressure() -> None:
    flow, gas = rough(), IdealGas(18e-6, 0.0)
    liquid = ViscousLiquid(18e-6).leak(flow, 2e5, 1e5)
    assert gas.leak(flow, 2e5, 1e5).rate == pytest.approx(1.5e5 * liquid.rate, rel=1e-12)
    faint = IdealGas(18e-6, 1e-14).leak(flow, 2e5, 1e5)
    assert faint.rate == pytest.approx(1.5e5 * liquid.rate, rel=1e-5)
    np.testing.assert_allclose(faint.pressure, gas.leak(flow, 2e5, 1e5).pressure, rtol=1e-5)


def test_slip_adds_and_pressures_stay_between_both_sides() -> None:
    for repeats in (False, True):
        before = 0.0
        for path in (0.0, 10e-9, 65e-9, 300e-9):
            found = IdealGas(18e-6, path).leak(rough(repeats), 2e5, 1e5)
            assert found.rate > before
            before = found.rate
    inside = found.pressure[np.isfinite(found.pressure)]
    assert inside.min() > 0.0
    sides = AIR.leak(rough(), 2e5, 1e5).pressure
    assert 1e5 <= np.nanmin(sides) < np.nanmax(sides) <= 2e5


def test_diffuse_walls_slip_least() -> None:
    flow = even(1e-6)
    assert IdealGas(18e-6, 65e-9, 0.8).leak(flow, 2e5, 1e5).rate > AIR.leak(flow, 2e5, 1e5).rate
    assert IdealGas(18e-6, 65e-9, 0.8).slip_length == pytest.approx(1.5 * 65e-9 * ATMOSPHERE)


def test_mean_free_paths_of_the_table() -> None:
    """Air 65.4 nm at 20 °C (Jennings 1988); helium three times as long."""
    assert pytest.approx(65.4e-9, rel=5e-3) == AIR.mean_free_path
    assert 2.7 < GASES["helium"].mean_free_path / AIR.mean_free_path < 3.1


def test_nothing_leaks_where_it_is_sealed() -> None:
    wall = np.full(GRID.shape, 1e-6)
    wall[20] = 0.0
    flow = flow_through(wall, GRID)
    assert ViscousLiquid(1e-3).leak(flow, 2e5, 1e5).rate == 0.0
    assert AIR.leak(flow, 2e5, 1e5).rate == 0.0


def test_units_of_leak_rates() -> None:
    assert parse("1 mm**3/s", "m**3/s", "rate") == pytest.approx(1e-9)
    assert parse("1 mbar*l/s", "Pa*m**3/s", "rate") == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("made", "subject", "shown"),
    [
        (lambda: ViscousLiquid(0.0), "viscosity of a liquid (Pa s)", "0"),
        (lambda: IdealGas(-1.0, 0.0), "viscosity of a gas (Pa s)", "-1"),
        (lambda: IdealGas(1e-5, -1.0), "mean free path of a gas (m)", "-1"),
        (lambda: IdealGas(1e-5, 0.0, 1.5), "accommodation of a gas", "1.5"),
        (lambda: ViscousLiquid(1e-3).leak(even(1e-6), 1e5, 2e5), "pressure at the inlet", "100000"),
        (lambda: AIR.leak(even(1e-6), 1e5, -1.0), "pressure of a gas", "-1"),
    ],
)
def test_wrong_input(made: Callable[[], Leak], subject: str, shown: str) -> None:
    with refused(InputError, subject, shown):
        made()


def test_gas_whose_pressure_is_not_found_is_said_to_be_so(monkeypatch: pytest.MonkeyPatch) -> None:
    flow = rough(scale=1e-7)
    AIR.leak(flow, 2e5, 1e5)
    monkeypatch.setattr(fluids, "ROUNDS", 1)
    with pytest.raises(ConvergenceError) as caught:
        AIR.leak(flow, 2e5, 1e5)
    assert caught.value.subject == "pressure of a gas that slips"
