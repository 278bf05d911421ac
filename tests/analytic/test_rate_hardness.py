"""Hardness at the strain rate of an asperity against its reference rows and of mean spots."""

from __future__ import annotations

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused

import asperity as asp
from asperity.theories import GreenwoodWilliamson, RateHardness


@every_row(reference("missing/rate_hardness"), label=lambda row: f"{row['case']:g}")
def test_one_fully_plastic_spot(row):
    theory = RateHardness(row["H0_Pa"], row["law"].replace("_", "-"), row["parameter"], row["reference_rate_per_s"])
    found = theory.at_speed(row["speed_m_per_s"], row["load_N"])
    assert found.contact_radius == pytest.approx(row["spot_radius_m"], rel=1e-10)
    assert found.strain_rate == pytest.approx(row["strain_rate_per_s"], rel=1e-10)
    assert found.hardness == pytest.approx(row["H_Pa"], rel=1e-10)
    assert found.ratio == pytest.approx(row["H_over_H0"], rel=1e-10)
    assert theory.at_rate(found.strain_rate).hardness == pytest.approx(found.hardness, rel=1e-12)
    assert theory.at_diameter(row["speed_m_per_s"], 2.0 * found.contact_radius) == pytest.approx(found.hardness)


def test_the_mean_spot_of_a_theory():
    summits = GreenwoodWilliamson(1e11, 1e12, 1e-6, 1e-8).at_pressure([1e6, 1e7])
    hard = RateHardness(3e9, "power", 0.02, 1e-3)
    found = hard.at_contacts(summits, 1.0)
    area = summits.area_fraction / summits.contact_density
    assert found.hardness == pytest.approx(hard.at_diameter(1.0, 2.0 * np.sqrt(area / np.pi)))
    assert np.all(found.hardness > 3e9)


def test_creep_is_told():
    slow = RateHardness(3e9, "power", 0.02, 1e-3)
    (limit,) = slow.validity(slow.at_rate([1e-4, 1.0]))
    assert limit.holds.tolist() == [False, True]
    assert slow.at_rate(1e-4).hardness[0] < 3e9
    assert RateHardness(3e9, "johnson-cook", 0.02, 1.0).validity(slow.at_rate(1e-4)) == ()


def test_laws_without_an_answer_are_refused():
    for law, sensitivity in (("power", 1.5), ("cowper-symonds", 0.5)):
        with refused(asp.InputError, "sensitivity of the hardness to the rate", f"{sensitivity:g}"):
            RateHardness(3e9, law, sensitivity, 1.0)
