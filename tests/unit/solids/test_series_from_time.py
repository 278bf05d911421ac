"""Prony series through relaxation moduli and creep compliances measured in time."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.io.schemas.bodies import BodyTable, body_from_text
from asperity.run.build import build_body
from asperity.solids.moduli_file import fitted_file
from asperity.solids.relaxation import Creep, Relaxation, creep_through, relaxation_through

v = asp.viscoelasticity
TIMES = np.geomspace(1e-2, 1e3, 61)
BETWEEN = 0.5 * math.log(10.0) / 4
"""Half the distance of two times of a series, as a logarithm: a term between is the sum of both
with a difference of at most BETWEEN²/2 of its own height, whose second derivative is below 1."""


def test_standard_linear_solid_comes_back_exactly() -> None:
    """E = E_inf + E_1 exp(-t/τ) has J = 1/E_inf - (1/E_inf - 1/E_0) exp(-t E_inf/(τ E_0))."""
    relaxed, first, tau = 1e6, 10e6, 1.0
    modulus = relaxed + (first - relaxed) * np.exp(-TIMES / tau)
    compliance = 1 / relaxed - (1 / relaxed - 1 / first) * np.exp(-TIMES * relaxed / (tau * first))
    from_modulus = v.fitted_relaxation(TIMES, modulus, poisson_ratio=0.4)
    from_compliance = v.fitted_creep(TIMES, compliance, poisson_ratio=0.4)
    for found in (from_modulus, from_compliance):
        assert found.largest_error < 1e-12
        assert found.rms_error <= found.largest_error
        assert found.solid.youngs_modulus == pytest.approx(first, rel=1e-12)
        ((share, time),) = found.solid.spectrum
        assert (share, time) == pytest.approx((0.9, tau), rel=1e-12)
    np.testing.assert_allclose(from_modulus.solid.uniaxial_creep.at(TIMES), compliance, rtol=1e-12)


@pytest.mark.parametrize("tau", [0.3, 0.7, 20.0, 45.0])
def test_times_between_those_of_the_series(tau: float) -> None:
    series = Relaxation(1e6, ((3e6, tau),))
    found = relaxation_through(TIMES, series.at(TIMES))
    np.testing.assert_allclose(found.at(TIMES), series.at(TIMES), rtol=BETWEEN**2 / 2)
    creep = creep_through(TIMES, series.creep.at(TIMES))
    np.testing.assert_allclose(creep.at(TIMES), series.creep.at(TIMES), rtol=BETWEEN**2 / 2)
    # round trip through the other form, which is exact for the series found
    np.testing.assert_allclose(creep.relaxation.creep.at(TIMES), creep.at(TIMES), rtol=1e-9)


@pytest.mark.parametrize("exponent", [0.1, 0.3, 0.6])
def test_power_law_over_a_band(exponent: float) -> None:
    """E = t^-α has J = t^α/(Γ(1 - α) Γ(1 + α)), each from the other within the band."""
    modulus = 1e6 * TIMES**-exponent
    compliance = TIMES**exponent / (1e6 * math.gamma(1 - exponent) * math.gamma(1 + exponent))
    relaxation, creep = relaxation_through(TIMES, modulus), creep_through(TIMES, compliance)
    np.testing.assert_allclose(relaxation.at(TIMES), modulus, rtol=BETWEEN**2 / 2)
    np.testing.assert_allclose(creep.at(TIMES), compliance, rtol=BETWEEN**2 / 2)
    # what happened before the band is forgotten as a power of the time since
    lowest, highest = 30 * TIMES[0], TIMES[-1] / 10
    inside = (lowest < TIMES) & (highest > TIMES)
    missed = 30.0 ** -(1.0 - exponent)
    np.testing.assert_allclose(relaxation.creep.at(TIMES)[inside], compliance[inside], rtol=missed)
    np.testing.assert_allclose(creep.relaxation.at(TIMES)[inside], modulus[inside], rtol=missed)


def test_fluids() -> None:
    maxwell = Creep(1e-6, (), 1e-6)
    found = creep_through(TIMES, maxwell.at(TIMES), fluid=True)
    assert (found.instantaneous, found.fluidity) == pytest.approx((1e-6, 1e-6), rel=1e-12)
    solid = v.fitted_creep(TIMES, maxwell.at(TIMES), poisson_ratio=0.5, fluid=True).solid
    assert solid.relaxed_share == 0.0
    early = TIMES[TIMES < 10.0]
    solid = v.fitted_relaxation(early, maxwell.relaxation.at(early), poisson_ratio=0.5, fluid=True).solid
    assert solid.relaxed_share == 0.0
    assert solid.spectrum[0] == pytest.approx((1.0, 1.0), rel=1e-9)
    assert creep_through(TIMES, maxwell.at(TIMES)).fluidity == 0.0


def test_order_of_the_rows_is_free() -> None:
    series = Relaxation(1e6, ((3e6, 2.0),))
    found = v.fitted_relaxation(TIMES[::-1], series.at(TIMES[::-1]), poisson_ratio=0.4)
    np.testing.assert_array_equal(found.time, TIMES[::-1])
    np.testing.assert_allclose(found.fitted, found.measured, rtol=BETWEEN**2 / 2)
    assert found.solid == v.fitted_relaxation(TIMES, series.at(TIMES), poisson_ratio=0.4).solid


@pytest.mark.parametrize("kind", ["relaxation", "creep"])
def test_files_of_both(tmp_path: Path, kind: str) -> None:
    series = Relaxation(1e6, ((3e6, 1.0),))
    rows, head = np.column_stack([TIMES * 1e3, series.at(TIMES) / 1e6]), "time (ms); Relaxation modulus E (MPa)"
    if kind == "creep":
        rows, head = np.column_stack([1e6 * series.creep.at(TIMES), TIMES * 1e3]), "creep compliance (1/MPa); time (ms)"
    np.savetxt(tmp_path / "m.csv", rows, fmt="%.17g", delimiter=";", header=head, comments="")
    found = fitted_file(tmp_path / "m.csv", poisson_ratio=0.4)
    assert found.solid.relaxation.relaxed == pytest.approx(1e6, rel=BETWEEN**2 / 2)
    table = BodyTable.model_validate(body_from_text("moduli=m.csv,nu=0.4"))
    solid = build_body(table, tmp_path)
    assert isinstance(solid, asp.Viscoelastic)
    assert solid.spectrum == found.solid.spectrum
    assert any("m.csv" in source for source in solid.sources)
    table = BodyTable.model_validate(
        {"relaxation": {"kind": "measured", "moduli_file": "m.csv", "fluid": True}, "poisson_ratio": 0.4}
    )
    fluid = build_body(table, tmp_path)
    assert isinstance(fluid, asp.Viscoelastic)
    assert (fluid.relaxed_share == 0.0) or kind == "creep"


def test_columns_that_do_not_fit_are_refused() -> None:
    good = Relaxation(1e6, ((3e6, 1.0),)).at(TIMES)
    with refused(asp.InputError, "time and relaxation modulus", "(61,)", "(60,)"):
        relaxation_through(TIMES, good[1:])
    with refused(asp.InputError, "times (s) of a creep compliance"):
        creep_through(np.append(TIMES[1:], -1.0), 1 / good)
    with refused(asp.InputError, "times (s) of a relaxation modulus"):
        relaxation_through(np.append(TIMES[1:], TIMES[1]), good)
    with refused(asp.InputError, "relaxation modulus (Pa)"):
        relaxation_through(TIMES, -good)
    with refused(asp.InputError, "relaxation modulus"):
        relaxation_through(TIMES, 1 / good)
    with refused(asp.InputError, "creep compliance"):
        creep_through(TIMES, good)
    with refused(asp.InputError, "creep compliance"):
        creep_through(TIMES, 1e-6 * TIMES, fluid=True)
    with refused(asp.InputError, "number of terms of a fitted series"):
        relaxation_through(TIMES, good, per_decade=100)
