"""Layered bodies as data: what they refuse, what they leave out, and what others ask them."""

import math

import numpy as np
import pytest
from refusals import refused
from solid_cases import elastic

import asperity as asp
from asperity.solids.compliance.halfspace import HalfSpace, contact_compliance
from asperity.solids.layers import materials_of, surface_material

HARD, SOFT, BASE = elastic(400e9, 0.2), elastic(3e9, 0.4), elastic(200e9, 0.3)


@pytest.mark.parametrize(
    ("make", "subject", "shown"),
    [
        (lambda: asp.Layer("DLC", 1e-9), "material of a layer", "'DLC'"),
        (lambda: asp.Layer(HARD, -1e-9), "thickness of a layer (m)", "-1e-09"),
        (lambda: asp.Layer(HARD, math.nan), "thickness of a layer (m)", "nan"),
        (lambda: asp.Layer(HARD, "5 nm"), "thickness of a layer (m)", "'5 nm'"),
        (lambda: asp.Layer(HARD, 1.0, "bonded"), "interface of a layer", "'bonded'"),
        (lambda: asp.Layered(asp.Layer(HARD, 1.0), BASE), "layers of a Layered body", "[layer]"),
        (lambda: asp.Layered([HARD], BASE), "each layer of a Layered body", "Elastic E ="),
        (lambda: asp.Layered([], asp.Rigid()), "base of a Layered body", "Rigid"),
        (lambda: asp.solids.graded(HARD, "steel", 1.0), "material at the bottom of a graded layer", "'steel'"),
        (lambda: asp.solids.graded(HARD, SOFT, 0.0), "thickness of a graded layer (m)", "0.0"),
        (lambda: asp.solids.graded(HARD, SOFT, math.inf), "thickness of a graded layer (m)", "inf"),
        (lambda: asp.solids.graded(HARD, SOFT, 1.0, sublayers=0), "number of sublayers of a graded layer", "0"),
        (lambda: asp.solids.graded(HARD, SOFT, 1.0, grading="linear"), "grading", "str"),
        (lambda: asp.solids.PowerGrading(-1.0), "exponent of a graded layer", "-1.0"),
    ],
)
def test_refusals(make, subject, shown):
    with refused(asp.InputError, subject, shown):
        make()


def test_layers_are_frozen_and_equal_by_value():
    body = asp.Layered([asp.Layer(HARD, 5e-9), asp.Layer(SOFT, 1e-8)], BASE)
    again = asp.Layered((asp.Layer(HARD, 5e-9), asp.Layer(SOFT, 1e-8)), BASE)
    assert body == again
    assert hash(body) == hash(again)
    assert contact_compliance(body, asp.Rigid()) == contact_compliance(again, asp.Rigid())
    assert body.thickness == pytest.approx(1.5e-8, rel=1e-15)


def test_compliances_are_equal_where_elastic_constants_are():
    """Names, sources and strengths (nan where unknown) do not count, so prepared operators serve
    equal bodies."""
    one = asp.Layered([asp.Layer(asp.material("DLC"), 5e-9), asp.Layer(SOFT, 0.0)], asp.material("steel"), name="disk")
    steel = asp.material("steel")
    plain = asp.Elastic(steel.youngs_modulus, steel.poisson_ratio, asp.Strength(yield_stress=float("nan")))
    other = asp.Layered([asp.Layer(asp.material("DLC"), 5e-9)], plain)
    assert contact_compliance(one, asp.Rigid()) == contact_compliance(other, asp.Rigid())
    thicker = asp.Layered([asp.Layer(asp.material("DLC"), 6e-9)], plain)
    assert contact_compliance(one, asp.Rigid()) != contact_compliance(thicker, asp.Rigid())


def test_what_takes_part():
    body = asp.Layered(
        [asp.Layer(SOFT, 0.0), asp.Layer(HARD, 1e-9), asp.Layer(SOFT, math.inf), asp.Layer(HARD, 1.0)], BASE
    )
    assert body.reduced == asp.Layered([asp.Layer(HARD, 1e-9)], SOFT)
    assert materials_of(body) == (HARD, SOFT)
    assert surface_material(body) == HARD
    assert surface_material(asp.Layered([], BASE)) == BASE
    assert surface_material(asp.Rigid()) is None
    assert surface_material(asp.Layered([asp.Layer(HARD, 0.0)], asp.RigidBase())) is None
    assert materials_of(asp.Layered([asp.Layer(HARD, 1.0)], asp.RigidBase())) == (HARD,)


def test_contact_modulus_is_that_of_the_surface_materials():
    body = asp.Layered([asp.Layer(HARD, 5e-9)], BASE)
    assert (
        asp.solids.contact_modulus(body)
        == asp.solids.contact_modulus(body, asp.Rigid())
        == asp.solids.contact_modulus(HARD, asp.Rigid())
    )
    assert asp.solids.contact_modulus(SOFT, body) == asp.solids.contact_modulus(SOFT, HARD)
    stiff_as_stone = asp.Layered([], asp.RigidBase())
    assert asp.solids.contact_modulus(stiff_as_stone, SOFT) == asp.solids.contact_modulus(asp.Rigid(), SOFT)
    with refused(asp.InputError, "body and counter_body"):
        asp.solids.contact_modulus(stiff_as_stone, asp.Rigid())


def test_bodies_without_layers_are_half_spaces():
    """Exactly, so that old results do not change by rounding."""
    endless = asp.Layered([asp.Layer(HARD, math.inf)], BASE)
    for body in (asp.Layered([], HARD), endless, asp.Layered([asp.Layer(SOFT, 0.0)], HARD)):
        assert contact_compliance(body, SOFT) == HalfSpace(asp.solids.contact_modulus(HARD, SOFT))


def test_sum_of_compliances():
    body = asp.Layered([asp.Layer(HARD, 5e-9)], BASE)
    on_rock = asp.Layered([asp.Layer(SOFT, 1e-6)], asp.RigidBase())
    q = np.geomspace(1e5, 1e10, 7)
    pairs = [(body, SOFT), (body, body), (on_rock, on_rock), (asp.Rigid(), body), (SOFT, on_rock)]
    for pair in pairs:
        both = contact_compliance(*pair)
        single = [contact_compliance(part, asp.Rigid()) for part in pair if part != asp.Rigid()]
        np.testing.assert_allclose(both.spectral(q), sum(part.spectral(q) for part in single), rtol=1e-14)
        np.testing.assert_allclose(
            both.line_influence(asp.Grid((4, 1), (1e-7, 1.0)), 1e-6),
            sum(part.line_influence(asp.Grid((4, 1), (1e-7, 1.0)), 1e-6) for part in single),
            rtol=1e-13,
        )
    assert (
        contact_compliance(on_rock, on_rock).mean_mode() == 2.0 * contact_compliance(on_rock, asp.Rigid()).mean_mode()
    )
    assert contact_compliance(on_rock, asp.Rigid()).mean_mode() > 0.0
    assert contact_compliance(on_rock, SOFT).mean_mode() == 0.0, (
        "the datum is the mean wherever a half-space takes part"
    )


def test_grading():
    coating = asp.solids.graded(
        HARD, SOFT, 8e-9, grading=asp.solids.LinearGrading(), sublayers=4, interface=asp.Frictionless()
    )
    assert [layer.thickness for layer in coating] == [2e-9] * 4
    assert [layer.interface for layer in coating] == [asp.solids.Bonded()] * 3 + [asp.Frictionless()]
    shares = (0.125, 0.375, 0.625, 0.875)
    for layer, share in zip(coating, shares, strict=True):
        assert layer.material.youngs_modulus == pytest.approx(400e9 - 397e9 * share, rel=1e-14)
        assert layer.material.poisson_ratio == pytest.approx(0.2 + 0.2 * share, rel=1e-14)
    first = asp.solids.graded(HARD, SOFT, 1e-9, sublayers=1)[0].material.youngs_modulus
    assert first == pytest.approx(math.sqrt(400e9 * 3e9), rel=1e-14)
    cubed = asp.solids.graded(HARD, SOFT, 1e-9, grading=asp.solids.PowerGrading(3.0), sublayers=1)[
        0
    ].material.youngs_modulus
    assert cubed == pytest.approx(400e9 - 397e9 / 8.0, rel=1e-14)


def test_strength_of_a_graded_coating_where_both_ends_are_known():
    hard = asp.Elastic(4e11, 0.2, asp.Strength(hardness=30e9), name="DLC")
    soft = asp.Elastic(2e11, 0.3, asp.Strength(hardness=10e9, yield_stress=3e9), name="steel")
    middle = asp.solids.graded(hard, soft, 1e-9, sublayers=1)[0].material
    assert middle.strength.hardness == pytest.approx(20e9, rel=1e-14)
    assert math.isnan(middle.strength.yield_stress)
    assert middle.name == "graded DLC - steel"
