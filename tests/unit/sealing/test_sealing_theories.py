"""Theories of gaps and of roughness in a film: reference values, limits, what is refused."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from reference_data import Row, every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.theories import (
    AnnularGap,
    CriticalJunction,
    EffectiveMedium,
    GroovedGap,
    ObstacleArray,
    ParabolicChannel,
    ParabolicThroat,
    ParallelGap,
    PatirCheng,
    SaddleThroat,
    TaperedGap,
    evaluate,
)

WAVES = [row for row in reference("lubrication/flow_factors") if str(row["surface"]).startswith("wave_")]
FAR = [row for row in reference("lubrication/flow_factors_random") if float(row["H"]) >= 3.0]
LENGTHS = {"iso": 1.0, "iso_half": 1.0, "gamma3": 3.0, "gamma1_3": 1.0 / 3.0}
OF_GAPS = [row for row in reference("transport/gap_flow") if not str(row["geometry"]).startswith(("step", "sinus"))]


@every_row(OF_GAPS, lambda row: f"{row['geometry']} {row['parameter']}")
def test_leak_rates_of_single_gaps(row: Row) -> None:
    """12 η Q/ΔP of a gap of one metre that is one metre long and wide."""
    q = float(row["parameter"])
    made: dict[str, Any] = {
        "taper_along_flow": lambda: TaperedGap(1.0, q, 1.0, 1.0, 1.0),
        "parabolic_channel_closed_at_sides": lambda: ParabolicChannel(1.0, 1.0, 1.0, 1.0),
        "parabolic_throat_R1_h0": lambda: ParabolicThroat(q, 1.0, 1.0, 1.0),
        "annulus_full_circle_ro_over_ri": lambda: AnnularGap(1.0, 1.0, 1.0, q),
    }
    found = made[str(row["geometry"])]().at_drop([12.0]).rate
    assert found[0] == pytest.approx(float(row["transmissivity"]), rel=1e-12)


@every_row(WAVES, lambda row: f"{row['surface']} {row['H']}")
def test_flow_factors_of_grooves(row: Row) -> None:
    """Also where the crests are cut off."""
    found = GroovedGap(math.sqrt(2.0)).at_mean_gap(float(row["H"]))
    names = ("pressure_across", "pressure_along") if row["surface"] == "wave_across" else None
    first, second = names or ("pressure_along", "pressure_across")
    assert getattr(found, first)[0] == pytest.approx(float(row["phi_x"]), abs=float(row["abs_error"]) + 1e-9)
    assert getattr(found, second)[0] == pytest.approx(float(row["phi_y"]), abs=float(row["abs_error"]) + 1e-9)
    if names:
        assert found.shear[0] == pytest.approx(float(row["phi_s"]), abs=float(row["abs_error"]) + 1e-9)


@every_row(FAR, lambda row: f"{row['kind']} {row['H']}")
def test_fits_of_patir_and_cheng(row: Row) -> None:
    """φ within 7 % and φ_s within 12 % of random surfaces from H/σ = 3 on, and three standard
    errors; at H/σ = 4 the fit of φ_s is 11 % above the exact 3 σ/2H of small roughness."""
    fit = PatirCheng(1e-7, LENGTHS[str(row["kind"])]).at_mean_gap(1e-7 * float(row["H"]))
    shares = {"phi_x": (fit.pressure_along, 0.07), "phi_y": (fit.pressure_across, 0.07), "phi_s": (fit.shear, 0.12)}
    for name, (value, share) in shares.items():
        exact = float(row[name])
        assert abs(value[0] - exact) <= share * exact + 3.0 * float(row[f"se_{name}"])


def test_flow_of_a_gas_goes_with_the_squares() -> None:
    plain, slipping = ParallelGap(1e-6, 1.8e-5, 1e-2, 1e-3), ParallelGap(1e-6, 1.8e-5, 1e-2, 1e-3, 6.8e-8)
    inlet = np.array([1e5, 2e5])
    found = plain.at_inlet(inlet, 5e4)
    np.testing.assert_allclose(found.throughput, plain.at_drop(0.5 * (inlet**2 - 5e4**2)).rate, rtol=1e-12)
    more = slipping.at_inlet(inlet, 5e4)
    np.testing.assert_allclose(more.throughput / found.throughput, 1.0 + 6.0 * more.knudsen, rtol=1e-12)
    assert [limit.holds.all() for limit in plain.validity(found)] == [True, True]
    # in vacuum what slips is all
    assert slipping.at_inlet(0.0).throughput == 0.0
    assert slipping.at_inlet(1.0).throughput > 1e4 * plain.at_inlet(1.0).throughput
    assert not slipping.validity(slipping.at_inlet([1.0]))[1].holds.any()
    with refused(InputError, "pressure at the inlet (Pa)", "100000", "99000"):
        plain.at_inlet(9.9e4, 1e5)


def test_media_answer_and_refuse() -> None:
    medium = EffectiveMedium([1e-6, 2e-6, 0.0], [0.4, 0.4, 0.2])
    assert medium.lower == 0.0 < medium.transmissivity < medium.upper
    assert medium.equivalent_gap == pytest.approx(medium.transmissivity ** (1.0 / 3.0))
    assert EffectiveMedium([1e-6, 0.0], [0.4, 0.6]).transmissivity == 0.0
    assert EffectiveMedium([1e-6]).lower == pytest.approx(EffectiveMedium([1e-6]).upper)
    with refused(InputError, "gaps and their shares", "2", "1"):
        EffectiveMedium([1e-6, 2e-6], [1.0])
    with refused(InputError, "gaps of an effective medium"):
        EffectiveMedium([0.0, 0.0])
    with refused(InputError, "area fraction of obstacles", "0.8"):
        ObstacleArray().at_covered([0.1, 0.8])
    with refused(InputError, "outer radius of an annular gap", "1"):
        AnnularGap(1e-6, 1e-3, 2.0, 1.0)
    with refused(InputError, "Peklenik number of the fits of Patir and Cheng", "2"):
        PatirCheng(1e-6, 2.0)


def test_saddle_has_a_bracket() -> None:
    found = SaddleThroat(0.05, 1.0, 0.2, 0.3).at_drop([12.0])
    assert found.upper[0] / found.lower[0] == pytest.approx(36.0 / 35.0)


def test_critical_junction_closes_with_the_load() -> None:
    """The gap falls with the load faster than a power and is zero from the sealing pressure on."""
    q = np.geomspace(1e4, 1e7, 40)
    theory = CriticalJunction(1e9, q, 1e-22 * (q / 1e4) ** -3.6)
    closing = theory.sealing_pressure
    loads = closing * np.array([0.01, 0.1, 0.5, 0.99, 1.0, 2.0])
    found = theory.at_pressure(loads)
    assert (np.diff(found.critical_gap[:5]) < 0.0).all()
    assert found.critical_gap[4] < 1e-3 * found.critical_gap[0]
    assert found.critical_gap[5] == found.transmissivity[5] == 0.0
    assert math.isnan(found.wavelength[5])
    assert (np.diff(found.wavelength[:4]) < 0.0).all()
    assert 0.0 < found.critical_gap[0] < 3.0 * theory.spectrum.rms_height
    columns = {column.name: values for column, values in evaluate(theory, pressure=loads).columns}
    np.testing.assert_allclose(columns["critical_gap"], found.critical_gap)
