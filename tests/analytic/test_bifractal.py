"""The fractal contact of two dimensions against its reference rows and quadrature; shares of
spots."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused
from scipy.integrate import quad

import asperity as asp
from asperity.theories import BifractalMajumdarBhushan, MajumdarBhushan

# numbers of the rows have twelve digits
PRINTED = 1e-11


@every_row(reference("missing/bifractal"), label=lambda row: f"{row['case']:g}")
def test_areas_and_loads(row):
    theory = BifractalMajumdarBhushan(
        row["D1"], row["G1_m"], row["Estar_Pa"], row["H_Pa"], 1e-3, row["D2"], row["l12_m"]
    )
    largest = row["a_l_m2"]
    assert theory.fine_roughness == pytest.approx(row["G2_m"], rel=PRINTED)
    assert theory.coarse.critical_area == pytest.approx(row["a_c1_m2"], rel=PRINTED)
    assert theory.fine.critical_area == pytest.approx(row["a_c2_m2"], rel=PRINTED)
    assert float(theory.sizes.area(largest)) == pytest.approx(row["Ar_m2"], rel=PRINTED)
    assert float(theory.elastic_area(largest)) == pytest.approx(row["Ar_elastic_m2"], rel=PRINTED)
    assert float(theory.elastic_load(largest)) == pytest.approx(row["P_elastic_N"], rel=PRINTED)
    # a difference of areas, which leaves the rounding of the whole
    left = 1e-14 * theory.hardness * row["Ar_m2"]
    assert float(theory.plastic_load(largest)) == pytest.approx(row["P_plastic_N"], rel=PRINTED, abs=left)
    assert float(theory.load(largest)) == pytest.approx(row["P_total_N"], rel=PRINTED)
    # both critical areas lie on the same side of the crossover
    sides = [area < row["l12_m"] ** 2 for area in (row["a_c1_m2"], row["a_c2_m2"])]
    assert sides[0] == sides[1] == (theory.critical_area < row["l12_m"] ** 2)
    assert theory.largest_spot_under(row["P_total_N"]) == pytest.approx(largest, rel=1e-10)


def test_shares_are_sums_over_spots():
    theory = BifractalMajumdarBhushan(1.4, 1e-11, 1e11, 5e9, 1e-6, 1.6, 3e-7)
    pressure = 2e5
    found = theory.at_pressure(pressure)
    (largest,) = found.largest_spot
    sizes = theory.sizes

    def weight(log: float) -> float:
        """a² n(a), the area of spots per logarithm of their area."""
        a, step = math.exp(log), 1e-6
        more = sizes.larger_than(a * np.exp([-step, step]), largest)
        return float(a * (more[0] - more[1]) / (2.0 * step))

    ends = math.log(1e-40), math.log(theory.critical_area), math.log(sizes.crossover), math.log(largest)
    parts = [quad(weight, low, high, limit=400)[0] for low, high in pairwise(ends)]
    assert sum(parts) / 1e-6 == pytest.approx(found.area_fraction[0], rel=1e-5)
    assert sum(parts[1:]) / sum(parts) == pytest.approx(found.elastic_area_share[0], rel=1e-5)
    spots = theory.at_spot([theory.critical_area, sizes.crossover, largest], pressure)
    assert spots.share_below == pytest.approx(np.cumsum(parts) / sum(parts), rel=1e-5)
    assert spots.number[2] == 1.0
    assert theory.at_spot(theory.critical_area * np.array([0.99, 1.01]), pressure).elastic.tolist() == [0.0, 1.0]


def test_numbers_and_heights_are_continuous_at_the_crossover():
    theory = BifractalMajumdarBhushan(1.4, 1e-11, 1e11, 5e9, 1e-6, 1.6, 3e-7)
    a = theory.crossover**2 * np.array([1.0 - 1e-12, 1.0 + 1e-12])
    assert np.diff(theory.sizes.larger_than(a, 1e-10)) == pytest.approx(0.0, abs=1e-8)
    assert theory.fine.interference(a[:1]) == pytest.approx(theory.coarse.interference(a[1:]), rel=1e-10)


def test_shares_of_one_dimension_tell_the_largest_spot():
    theory = MajumdarBhushan(1.5, 1e-10, 1e11, 5e9, 1e-8)
    found = theory.at_pressure([1e5, 1e7])
    for n in range(2):
        largest = found.largest_spot[n]
        assert found.elastic_area_share[n] == pytest.approx(
            1.0 - float(theory.sizes.share_below(theory.critical_area, largest))
        )
        assert found.elastic_load_share[n] == pytest.approx(
            float(theory.elastic_load(largest)) / (found.pressure[n] * 1e-8)
        )


def test_what_is_no_dimension_is_refused():
    with refused(asp.InputError, "fine_dimension of bifractal", "2.5"):
        BifractalMajumdarBhushan(1.4, 1e-11, 1e11, 5e9, 1e-6, 2.5, 3e-7)
    with refused(asp.InputError, "areas of spots (m^2)", "0"):
        MajumdarBhushan(1.5, 1e-10, 1e11, 5e9, 1e-8).at_spot(0.0, 1e6)
