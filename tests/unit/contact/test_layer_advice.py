"""Advice on layers: thinner than a pixel, thicker than the period can show."""

import numpy as np
from contact_cases import rough
from solid_cases import elastic, on_half_space

import asperity as asp


def found(body, *, counter=asp.Rigid(), boundary=asp.Periodic(), pressure=1e-6):
    problem = asp.ContactProblem(rough((32, 32), power=3.0), body, counter_body=counter, boundary=boundary)
    return {a.criterion: a for a in asp.contact.advise(problem, asp.MeanPressure(pressure)) if "layer" in a.criterion}


def test_layers_that_suit_the_grid_get_no_advice():
    assert found(on_half_space(2.0, 4.0)) == {}
    assert found(elastic(1.0, 0.3)) == {}


def test_layer_thinner_than_a_pixel():
    advice = found(on_half_space(2.0, 0.25))
    assert set(advice) == {"layer against pixel"}
    assert "thinnest 0.25 pixels" in advice["layer against pixel"].message
    assert advice["layer against pixel"].level == "note"
    both = asp.Layered([asp.Layer(elastic(2.0, 0.3), 0.5), asp.Layer(elastic(3.0, 0.3), 0.2)], elastic(1.0, 0.3))
    assert "2 layers are thinner than a pixel (the thinnest 0.2" in found(both)["layer against pixel"].message
    assert set(found(elastic(1.0, 0.3), counter=on_half_space(2.0, 0.25))) == {"layer against pixel"}
    assert found(on_half_space(2.0, 0.0)) == {}


def test_a_row_has_pixels_along_x_only():
    """The length along y, 1 m of a line contact, is no pixel."""
    row = asp.surfaces.sliced(rough((32, 32), power=3.0), y="middle")
    problem = asp.ContactProblem(row, on_half_space(2.0, 4.0), boundary=asp.FreeLine())
    assert not [a for a in asp.contact.advise(problem, asp.MeanPressure(1e-6)) if a.criterion == "layer against pixel"]


def test_layers_too_thick_for_the_period():
    assert set(found(on_half_space(2.0, 17.0))) == {"layer against period"}
    assert found(on_half_space(2.0, 15.0)) == {}
    assert found(on_half_space(2.0, 17.0), boundary=asp.Free()) == {}
    assert found(on_half_space(1.0, 17.0)) == {}, "a base of the same material makes no difference"
    assert set(found(asp.Layered([asp.Layer(elastic(1.0, 0.3), 17.0)], asp.RigidBase()))) == {"layer against period"}


def test_load_is_measured_by_the_softest_material():
    """A soft layer under a stiff one is strained by the mean pressure, whatever the surface
    material."""
    soft = asp.Layered([asp.Layer(elastic(1e3, 0.3), 2.0), asp.Layer(elastic(1e-3, 0.3), 2.0)], elastic(1e3, 0.3))
    problem = asp.ContactProblem(rough((32, 32), power=3.0), soft)
    advice = {a.criterion: a for a in asp.contact.advise(problem, asp.MeanPressure(1e-3))}
    assert "load" in advice
    assert np.isclose(problem.contact_modulus, 1e3 / 0.91)


def test_hardness_is_that_of_the_surface_material():
    weak = asp.Elastic(1.0, 0.3, asp.Strength(hardness=1e-3), name="varnish")
    strong = asp.Elastic(1.0, 0.3, asp.Strength(hardness=1e3), name="steel")
    for layers, base, warned in (([weak], strong, True), ([strong], weak, False)):
        body = asp.Layered([asp.Layer(m, 2.0) for m in layers], base)
        result = asp.solve(asp.ContactProblem(rough((16, 16), power=3.0), body), asp.MeanPressure(0.01))
        advice = {a.criterion: a for a in asp.contact.review(result)}
        assert ("hardness" in advice) == warned
        if warned:
            assert "varnish" in advice["hardness"].message


def test_harder_material_under_a_pressure_limit():
    """A limit that is the hardness of the top layer hides what lies below it."""

    def told(hardnesses, limit, base=None):
        solids = [asp.Elastic(1.0, 0.3, asp.Strength(hardness=h)) for h in hardnesses]
        *layers, bottom = [*solids, base] if base else solids
        body = asp.Layered([asp.Layer(solid, 2.0) for solid in layers], bottom)
        law = asp.plasticity.LayeredHardness(body) if limit is None else asp.Hardness(limit)
        found = asp.contact.advise(
            asp.ContactProblem(rough((16, 16), power=3.0), body, law=law), asp.MeanPressure(1e-6)
        )
        return {a.criterion: a.message for a in found if a.criterion.endswith("layers below")}

    found = told((216e6, 638e6, 369e6), 216e6)
    assert set(found) == {"harder layers below"}
    assert "638 MPa" in found["harder layers below"]
    assert set(told((216e6,), 216e6, asp.RigidBase())) == {"harder layers below"}
    assert set(told((216e6, float("nan")), 216e6)) == {"layers below"}
    assert told((216e6, 638e6), None) == {}
    assert told((216e6, 638e6), 100e6) == {}, (
        "a lower limit, of the other body or a number, has nothing to do with the layer"
    )
    assert set(told((216e6, 638e6, 100e6), 216e6)) == {"softer layers below", "harder layers below"}


def test_softer_material_under_a_pressure_limit():
    """The limit is that of the surface; there is a finding on what lies below it."""

    def told(hardnesses, limit):
        top, *middle, bottom = (asp.Elastic(1.0, 0.3, asp.Strength(hardness=h)) for h in hardnesses)
        body = asp.Layered([asp.Layer(top, 2.0), *(asp.Layer(m, 2.0) for m in middle)], bottom)
        law = asp.plasticity.HardWall() if limit is None else asp.Hardness(limit)
        problem = asp.ContactProblem(rough((16, 16), power=3.0), body, law=law)
        found = [a for a in asp.contact.advise(problem, asp.MeanPressure(1e-6)) if a.criterion == "softer layers below"]
        return [a.message for a in found]

    (message,) = told((15e9, 2e9), 15e9)
    assert "limited to 15 GPa" in message
    assert "only 2 GPa" in message
    assert "only 1 GPa" in told((15e9, float("nan"), 1e9), 15e9)[0]
    assert told((15e9, 2e9), None) == []
    assert told((15e9, 2e9), 1e9) == [], "a limit below both hardnesses keeps both elastic in this sense"
    assert told((2e9, 15e9), 2e9) == []
    assert told((15e9, float("nan")), 15e9) == []
