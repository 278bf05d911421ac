"""The shared result and the catalogue of theories."""

from __future__ import annotations

import numpy as np
import pytest
from refusals import refused

from asperity.core.errors import InputError
from asperity.theories.protocol import QUANTITIES, Limit, Prediction, checked, curve, prediction


def test_every_field_of_a_prediction_has_its_unit():
    assert [quantity.name for quantity in QUANTITIES] == list(Prediction.__dataclass_fields__)


def test_what_a_theory_does_not_define_is_nan():
    found = prediction(np.array([1e5, 2e5]), area_fraction=np.array([0.0, 0.01]))
    assert len(found) == 2
    assert np.isnan(found.separation).all()
    assert np.isnan(found.mean_real_pressure[0])  # no area carries nothing
    assert found.mean_real_pressure[1] == pytest.approx(2e7)


def test_a_limit_does_not_hold_where_its_value_is_undefined():
    limit = Limit("area fraction", np.array([0.05, 0.3, np.nan]), 0.0, 0.2, "Greenwood1966", "Asperities interact.")
    assert limit.holds.tolist() == [True, False, False]


def test_text_is_refused_where_numbers_are_expected():
    for ask, subject, shown in (
        (lambda: curve("1MPa", "pressures (Pa)"), "pressures (Pa)", "'1MPa'"),
        (lambda: checked(["1 N"], "load (N)"), "load (N)", "['1 N']"),
    ):
        with refused(InputError, subject, shown):
            ask()


def test_unusable_curves_are_refused():
    assert curve(3.0, "pressures (Pa)").shape == (1,)
    with refused(InputError, "pressures (Pa)"):
        curve(np.ones((2, 2)), "pressures (Pa)")
    with refused(InputError, "pressures (Pa)"):
        curve([1.0, np.nan], "pressures (Pa)")
    with refused(InputError, "pressures (Pa)"):
        curve([1.0, 0.0], "pressures (Pa)", positive=True)
