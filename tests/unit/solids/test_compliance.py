"""The compliance of a half-space and of two bodies: scaling, decay, superposition and refusals."""

import math

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.solids.compliance.halfspace import HalfSpace, contact_compliance
from asperity.solids.compliance.tensor import BodiesSurface

Q = np.geomspace(1e-3, 1e12, 31)
SOFT, STIFF = asp.Elastic(2e9, 0.45), asp.Elastic(200e9, 0.3)


def test_spectral_compliance_falls_like_one_over_modulus_and_wavenumber():
    found = HalfSpace(4.0).spectral(Q)
    np.testing.assert_allclose(found * Q, 0.5, rtol=1e-15)
    np.testing.assert_allclose(HalfSpace(8.0).spectral(Q), 0.5 * found, rtol=1e-15)
    np.testing.assert_allclose(HalfSpace(4.0).spectral(2.0 * Q), 0.5 * found, rtol=1e-15)
    assert HalfSpace(4.0).mean_mode() == 0.0


def test_influence_scales_with_length_over_modulus():
    """Coefficients for unit pressure are lengths over a modulus; 1e-13 is their rounding."""
    one = HalfSpace(1.0).influence(asp.Grid((6, 4), (1.0, 2.0)))
    other = HalfSpace(5e9).influence(asp.Grid((6, 4), (1e-7, 2e-7)))
    np.testing.assert_allclose(other, one * 1e-7 / 5e9, rtol=1e-13)
    assert (np.diff(one, axis=0) < 0.0).all()
    assert (np.diff(one, axis=1) < 0.0).all()


def test_compliances_of_two_bodies_add_up():
    both = contact_compliance(SOFT, STIFF).spectral(Q)
    alone = contact_compliance(SOFT, asp.Rigid()).spectral(Q) + contact_compliance(asp.Rigid(), STIFF).spectral(Q)
    np.testing.assert_allclose(both, alone, rtol=1e-14)
    np.testing.assert_allclose(contact_compliance(STIFF, SOFT).spectral(Q), both, rtol=1e-14)
    grid = asp.Grid((3, 5), (1e-7, 1e-7))
    single = [contact_compliance(body, asp.Rigid()).influence(grid) for body in (SOFT, STIFF)]
    np.testing.assert_allclose(contact_compliance(SOFT, STIFF).influence(grid), sum(single), rtol=1e-14)


COATED = asp.Layered([asp.Layer(STIFF, 5e-9)], base=SOFT)


@pytest.mark.parametrize(
    "compliance",
    [
        HalfSpace(4.0),
        contact_compliance(COATED, asp.Rigid()),
        contact_compliance(COATED, SOFT),
        BodiesSurface(COATED, SOFT),
    ],
    ids=["half-space", "layers", "two bodies", "along the surface"],
)
def test_a_compliance_takes_one_wavenumber_and_refuses_the_mean_mode(compliance):
    together = compliance.spectral(np.array([1e6, 1e9]))
    np.testing.assert_allclose([float(compliance.spectral(q)) for q in (1e6, 1e9)], together, rtol=1e-12)
    np.testing.assert_allclose(compliance.spectral([1e6, 1e9]), together, rtol=1e-12)
    for wrong in (0.0, [1e6, 0.0], -1.0, math.nan):
        with refused(asp.errors.InputError, "wavenumber of a compliance (rad/m)"):
            compliance.spectral(wrong)


def test_moduli_of_an_elastic_body():
    assert STIFF.plane_strain_modulus == pytest.approx(200e9 / 0.91, rel=1e-15)
    assert STIFF.shear_modulus == pytest.approx(200e9 / 2.6, rel=1e-15)


def test_refusals():
    with refused(asp.InputError, "body and counter_body"):
        contact_compliance(asp.Rigid(), asp.Rigid())
    for bad in (0.0, -1.0, np.nan, np.inf):
        with refused(asp.InputError, "plane-strain modulus of a half-space (Pa)"):
            HalfSpace(bad)
    with refused(asp.InputError, "strength of an elastic body"):
        asp.Elastic(1e9, 0.3, 5e7)
    for key in ("hardness", "yield_stress"):
        with refused(asp.InputError, f"{key.replace('_', ' ')} (Pa)", "0.0"):
            asp.Strength(**{key: 0.0})
