"""What every theory in the catalogue declares and answers."""

from __future__ import annotations

import inspect

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.core.citations import reference
from asperity.core.parameters import parameters
from asperity.theories.catalogue import THEORIES, theory

SURFACE = [name for name, kind in THEORIES.items() if hasattr(kind, "from_roughness")]
E_STAR = 1e11
BODIES = {"E_star": E_STAR, "hardness": 8e9, "yield_stress": 8e9 / 2.8, "work": 0.05}
"""What theories may ask of the bodies; a new input of the bodies is one more entry."""


@pytest.fixture(scope="module")
def roughness() -> asp.roughness.Roughness:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.1), hurst=0.8, rolloff_wavelength=5e-7, shortest_wavelength=1.2e-7
    )
    return asp.roughness_of(asp.generate.gaussian(asp.Grid((128, 128), (2e-8, 2e-8)), spectrum, seed=1))


@pytest.mark.parametrize("name", THEORIES)
def test_every_theory_is_described(name):
    kind = theory(name)
    assert kind.name == name == name.lower().replace(" ", "-")
    assert kind.title
    assert [reference(key) for key in kind.citation_keys]
    assert [item.name for item in parameters(kind)] == list(inspect.signature(kind).parameters)
    assert kind.inputs == parameters(kind)
    assert all(item.help for item in parameters(kind))


@pytest.mark.parametrize("name", SURFACE)
def test_every_theory_answers_about_the_same_surface(name, roughness):
    kind = theory(name)
    bodies = {item.name: BODIES[item.name] for item in parameters(kind) if item.of == "bodies" and item.required}
    made = kind.from_roughness(roughness, **bodies)
    # a sixth of a per cent to six per cent of area: light loads at which all theories hold
    pressures = 0.1 * E_STAR * np.geomspace(1e-3, 2e-2, 200)
    found = made.at_pressure(pressures)
    assert found.pressure == pytest.approx(pressures, rel=1e-8)
    assert np.all(np.diff(found.area_fraction) > 0.0)
    for limit in made.validity(found):
        assert limit.value.shape == pressures.shape
        assert limit.low < limit.high
        assert reference(limit.citation)
        assert limit.message.endswith(".")
    if hasattr(made, "at_separation"):
        again = made.at_separation(found.separation)
        assert again.pressure == pytest.approx(pressures, rel=1e-8)
        assert again.area_fraction == pytest.approx(found.area_fraction, rel=1e-8)
        if not np.isnan(found.stiffness).any():
            slope = -np.gradient(np.log(found.pressure), found.separation)[1:-1]
            # second-order differences over a fiftieth in ln p
            assert (found.stiffness / found.pressure)[1:-1] == pytest.approx(slope, rel=1e-2)
    if set(bodies) == {"E_star"}:
        # elasticity has a coefficient of about two; Onions and Archard, who only know waves longer
        # than the correlation length, come to eight
        coefficient = found.area_fraction * E_STAR * roughness.rms_gradient / pressures
        assert np.all((coefficient > 0.7) & (coefficient < 10.0))


def test_every_theory_is_in_the_public_namespace():
    assert [kind.__name__ for kind in THEORIES.values() if kind.__name__ not in asp.theories.__all__] == []
    assert sorted(set(asp.theories.__all__)) == sorted(asp.theories.__all__)
    assert all(getattr(asp.theories, name).__doc__ or name in ("FAMILIES", "THEORIES") for name in asp.theories.__all__)


def test_a_near_miss_of_a_class_names_it():
    with pytest.raises(AttributeError) as caught:
        _ = asp.theories.HertzPont
    assert "HertzPoint" in str(caught.value)
    assert (caught.value.name, caught.value.obj) == ("HertzPont", asp.theories)


def test_unknown_theories_are_refused():
    with refused(asp.InputError, "name of a theory"):
        theory("phlogiston")
