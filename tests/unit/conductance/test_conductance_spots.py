"""Closed forms of conducting spots: against reference values, limits, and one another."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.physics.conductance import law
from asperity.physics.conductance.tube import tube_factor_exact
from asperity.theories.conductance import spots

CLUSTERS: dict[str, list[list[float]]] = {}
for _row in reference("transport/spot_cluster_spots"):
    CLUSTERS.setdefault(str(_row["configuration"]), []).append([float(_row[key]) for key in ("x", "y", "radius")])


@every_row(reference("transport/spot_clusters"), label=lambda row: str(row["configuration"]))
def test_clusters_of_greenwood(row: dict[str, float]) -> None:
    """One half-space of k is two of k_s = 2 k with half of the resistance of k_s = k."""
    x, y, a = np.array(CLUSTERS[str(row["configuration"])]).T
    assert spots.cluster(2.0, x, y, a) == pytest.approx(row["R_greenwood_times_k"], rel=1e-11)
    assert spots.cluster(2.0, x, y, a) == pytest.approx(row["R_times_k"], rel=1e-2)


@every_row(reference("transport/periodic_strips"), label=lambda row: str(row["case"]))
def test_strips(row: dict[str, float]) -> None:
    found = spots.strips(3.0, row["contact_fraction"], 0.5)
    assert float(found) == pytest.approx(row["h_lambda_over_ks"] * 3.0 / 0.5, rel=1e-12)


@every_row(reference("transport/flux_tube"), label=lambda row: str(row["case"]))
def test_tube(row: dict[str, float]) -> None:
    """The reference has eight digits."""
    assert tube_factor_exact(row["a_over_b"]) == pytest.approx(row["psi_isothermal"], abs=1e-8)
    assert float(spots.tube_factor(row["a_over_b"])) == pytest.approx(row["psi_cmy_1_minus_eps_1p5"], abs=1e-8)


def test_circles_are_ellipses_and_lie_between_squares() -> None:
    assert spots.ellipse(5.0, 2.0, 2.0) == pytest.approx(float(spots.circle(5.0, 2.0)), rel=1e-14)
    side = 1.7
    inscribed, equal = (float(spots.circle(5.0, r)) for r in (0.5 * side, side / math.sqrt(math.pi)))
    circumscribed = float(spots.circle(5.0, side / math.sqrt(2.0)))
    assert inscribed < equal < spots.square(5.0, side) < circumscribed
    thin = spots.ellipse(1.0, 1.0, 1e-9)
    assert thin == pytest.approx(math.pi / math.log(4.0e9), rel=1e-12)  # K(e) -> ln(4 a/b)


def test_narrow_strips_and_touching_ones() -> None:
    f = 1e-6
    assert float(spots.strips(1.0, f, 1.0)) == pytest.approx(math.pi / (-2.0 * math.log(0.5 * math.pi * f)), rel=1e-9)
    assert spots.strips(1.0, 1.0, 1.0) == math.inf


def test_one_circle_is_a_cluster_and_many_far_apart_conduct_in_parallel() -> None:
    assert spots.cluster(3.0, 0.0, 0.0, 2.0) == pytest.approx(1.0 / float(spots.circle(3.0, 2.0)), rel=1e-15)
    far = np.arange(5) * 1e7
    assert spots.cluster(3.0, far, 0.0 * far, np.full(5, 2.0)) == pytest.approx(1.0 / 60.0, rel=1e-6)


def test_ballistic_spots_have_both_limits_of_wexler() -> None:
    assert float(spots.wexler(0.0)) == 1.0
    assert float(spots.wexler(1e12)) == pytest.approx(9.0 * math.pi**2 / 128.0, rel=1e-10)
    K = np.logspace(-3, 3, 200)
    assert np.all(np.diff(spots.wexler(K)) < 0.0)
    np.testing.assert_allclose(
        spots.wexler(K[K < 1.0]), (1.0 + 0.83 * K[K < 1.0]) / (1.0 + 1.33 * K[K < 1.0]), atol=0.03
    )
    # Sharvin's resistance of a circle of one mean free path is 8/(3 pi) of Holm's
    assert float(spots.sharvin(1.0, 1.0, 1.0)) == pytest.approx(8.0 / (3.0 * math.pi) * 0.5, rel=1e-15)


def test_a_tenth_of_a_volt_heats_a_spot_to_its_softening() -> None:
    """Holm: copper softens at 0.12 V, 190 °C; gold melts at 0.43 V, 1336 K."""
    assert law.softens(spots.hottest(0.12))
    assert not law.softens(spots.hottest(0.09))
    assert spots.hottest(0.43) == pytest.approx(1336.0, rel=0.06)
    assert spots.hottest(0.0, 300.0) == 300.0


def test_gas_and_radiation_across_a_gap() -> None:
    between = law.ConductingInterface(gap_conductivity=0.026, jump=0.3e-6, radiation=6.0)
    np.testing.assert_allclose(
        1.0 / between.gap_resistance(np.array([0.0, 1e-6])), 0.026 / np.array([0.3e-6, 1.3e-6]) + 6.0
    )
    assert between.bridges
    assert not law.ConductingInterface(film_resistance=1e-6).bridges
    assert law.radiation(300.0, (0.5, 0.5)) == pytest.approx(law.radiation(300.0) / 3.0)
    one_sided = law.temperature_jump(68e-9, (1.0, 1.0))
    assert one_sided == pytest.approx(2.0 * 2.0 * 1.4 / 2.4 / 0.71 * 68e-9)


@pytest.mark.parametrize(
    ("call", "subject"),
    [
        (lambda: spots.circle(1.0, [1.0, 0.0]), "radius of a spot (m)"),
        (lambda: spots.circle(-1.0, 1.0), "harmonic mean of the conductivities"),
        (lambda: spots.ellipse(1.0, 1.0, 2.0), "semi-minor axis of a spot (m)"),
        (lambda: spots.strips(1.0, 1.1, 1.0), "contact fraction of strips"),
        (lambda: spots.cluster(1.0, [0.0, 1.0], [0.0, 0.0], [1.0, 1.0]), "spots of a cluster"),
        (lambda: spots.tube_factor(1.5), "ratio of the radii"),
        (lambda: tube_factor_exact(1.0), "ratio of the radii"),
        (lambda: spots.hottest(-1.0), "voltage (V)"),
        (lambda: law.ConductingInterface(film_resistance=-1.0), "specific resistance of the film"),
        (lambda: law.radiation(300.0, (0.0, 1.0)), "emissivity"),
        (lambda: law.temperature_jump(68e-9, (1.1, 1.0)), "accommodation coefficient"),
    ],
)
def test_what_cannot_be_is_refused(call, subject: str) -> None:
    with refused(InputError, subject):
        call()
