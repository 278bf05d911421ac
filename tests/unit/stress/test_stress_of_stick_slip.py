"""Stresses under the tractions of stick and slip: signs on both bodies, and whatever is made of
stresses."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from contact_cases import rough

import asperity as asp

COATED = asp.Layered([asp.Layer(asp.Elastic(4.0, 0.3, asp.Strength(yield_stress=1.0)), 2.0)], asp.Elastic(1.0, 0.2))
SOFT = asp.Elastic(0.5, 0.4, asp.Strength(yield_stress=0.3))
DEPTHS = (0.0, 0.5, 2.0)


@pytest.fixture(scope="module")
def result() -> asp.ContactResult:
    problem = asp.ContactProblem(rough((24, 20), 4), COATED, counter_body=SOFT, friction=asp.Coulomb(0.4))
    return asp.solve(problem, asp.Step(asp.MeanPressure(0.1), asp.Shift(0.06, 0.03)))


def test_the_surface_bears_the_traction(result: asp.ContactResult) -> None:
    """Traction on a surface whose outward normal is -z: σzz = -p and σxz = -q on the body; on the
    counter body q turns."""
    shear = result.stick_slip
    assert shear is not None
    size = np.abs(shear.traction).max()
    assert 0 < np.count_nonzero(shear.slipping) < np.count_nonzero(result.contact)
    for of, sign in (("body", -1.0), ("counter_body", 1.0)):
        tensor = asp.stress(result, [0.0], of=of).tensor  # type: ignore[arg-type]
        assert np.abs(tensor.zz[0] + result.pressure).max() <= 1e-9 * result.max_pressure
        assert np.abs(tensor.xz[0] - sign * shear.traction[0]).max() <= 1e-9 * size
        assert np.abs(tensor.yz[0] - sign * shear.traction[1]).max() <= 1e-9 * size


@pytest.mark.parametrize("of", ["body", "counter_body"])
def test_it_is_the_shear_given_by_hand(result: asp.ContactResult, of: Any) -> None:
    """To the bit; yield and fracture are judged by it, not by the pressure alone."""
    shear = result.stick_slip
    assert shear is not None
    own = asp.stress(result, DEPTHS, of=of)
    given = asp.stress(result, DEPTHS, of=of, friction=asp.stresses.ShearTraction(*shear.traction))
    smooth = asp.stress(result, DEPTHS, of=of, friction=0.0)
    for name in ("xx", "yy", "zz", "xy", "yz", "xz"):
        np.testing.assert_array_equal(getattr(own.tensor, name), getattr(given.tensor, name))
    yields, without = asp.first_yield(own), asp.first_yield(smooth)
    assert yields.regions[0].peak.value == asp.first_yield(given).regions[0].peak.value
    assert yields.regions[0].load_factor < without.regions[0].load_factor
    torn, pressed = asp.stresses.fracture_indicators(own), asp.stresses.fracture_indicators(smooth)
    assert torn[0].peak.value > 1.2 * pressed[0].peak.value


def test_a_document_takes_it_unless_told_otherwise() -> None:
    """Largest stresses of the part [stress] with the shear of the contact, and without."""
    table: dict[str, Any] = {
        "version": 2,
        "surface": {
            "kind": "rough",
            "points": [16, 16],
            "size": "10 um",
            "seed": 1,
            "spectrum": {"kind": "gaussian", "rms_height": "1 nm", "correlation_length": "2 um"},
        },
        "body": "E=100GPa,nu=0.3,H=5GPa",
        "control": {"mean_pressure": "20 MPa"},
        "friction": {"law": "full stick"},
        "shear": {"shift": "0.4 nm"},
        "stress": {"depths": ["0 nm", "100 nm"]},
    }
    with_shear = asp.run(table)
    without = asp.run(table | {"stress": {**table["stress"], "shear": False}})
    field = asp.stress(with_shear.result, [0.0, 1e-7])
    assert with_shear.values["max_von_mises"] == pytest.approx(field.von_mises.max(), rel=1e-3)
    assert with_shear.values["max_von_mises"] > 1.1 * without.values["max_von_mises"]
    smooth = asp.stress(without.result, [0.0, 1e-7], friction=0.0)
    assert without.values["max_von_mises"] == pytest.approx(smooth.von_mises.max(), rel=1e-3)
