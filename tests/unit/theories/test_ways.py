"""How theories are asked: every way of every theory answers, quickly, with its limits."""

from __future__ import annotations

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.core.citations import reference
from asperity.core.parameters import parameters
from asperity.theories import FAMILIES, THEORIES, evaluate, theory
from asperity.theories.ask import ways_of
from asperity.theories.catalogue import nearest

SUMMITS = {"E_star": 1e11, "density": 1e12, "radius": 1e-6, "height_deviation": 1e-8}
BALL = {"E_star": 1e11, "radius": 1e-6}
MOMENTS = {"m0": 1e-16, "m2": 1e-2, "m4": 2e12}
RNG = np.random.default_rng(1)
CRESTS = {
    "x": 3e-6 * RNG.random(20),
    "y": 3e-6 * RNG.random(20),
    "height": 1e-8 * RNG.standard_normal(20),
    "depth": np.full(20, 1e-7),
    "wavelength": np.full(20, 1e-6),
    "area": 9e-12,
}
WHEEL = {"semi_x": 6e-3, "semi_y": 4e-3, "shear": 8e10, "nu": 0.3}
FILM = {"surface_tension": 0.072, "film_thickness": 1e-9}
EXAMPLES = {
    "greenwood-williamson": SUMMITS,
    "greenwood-williamson-fits": SUMMITS,
    "kotwal-bhushan": {**SUMMITS, "skewness": 0.5, "kurtosis": 4.0},
    "chang-etsion-bogy": {**SUMMITS, "hardness": 8e9},
    "kogut-etsion": {**SUMMITS, "hardness": 8e9},
    "jackson-green": {**SUMMITS, "yield_stress": 3e9},
    "fuller-tabor": {**SUMMITS, "work": 0.05},
    "identical-asperities": {key: SUMMITS[key] for key in ("E_star", "density", "radius")},
    "discrete-summits": {"E_star": 1e11, "height": CRESTS["height"], "radius": np.full(20, 1e-6), "area": 9e-12},
    "interacting-crests": {"E_star": 1e11, **CRESTS},
    "greenwood-tripp": SUMMITS,
    "mccool": {"E_star": 1e11, **MOMENTS},
    "onions-archard": {"E_star": 1e11, "rms_height": 1e-8, "correlation_length": 1e-6},
    "bush-gibson-thomas": {"E_star": 1e11, **MOMENTS},
    "greenwood-elliptic": {"E_star": 1e11, **MOMENTS},
    "anisotropic-summits": {"E_star": 1e11, "m0": 1e-16, "steepest": 2e-2, "gentlest": 1e-2},
    "majumdar-bhushan": {"dimension": 1.4, "roughness": 1e-10, "E_star": 1e11, "hardness": 8e9, "nominal_area": 1e-8},
    "persson": {
        "E_star": 1e11,
        "rms_gradient": 0.1,
        "q": np.array([1e6, 1e7, 1e8]),
        "psd": np.array([1e-30, 1e-33, 1e-36]),
    },
    "persson-friction": {
        "relaxed": 2e6,
        "moduli": np.array([1e7, 2e7]),
        "times": np.array([1e-2, 1e-4]),
        "q": np.array([1e4, 1e5, 1e6]),
        "psd": np.array([1e-18, 1e-20, 1e-24]),
    },
    "westergaard": {"E_star": 1e11, "amplitude": 1e-9, "wavelength": 1e-6},
    "crossed-waves": {"E_star": 1e11, "amplitude": 1e-9, "wavelength": 1e-6},
    "jkr-wave": {"E_star": 1e6, "amplitude": 1e-6, "wavelength": 1e-4, "work": 2e-3},
    "hertz": BALL,
    "hertz-line": BALL,
    "hertz-ellipse": {"E_star": 1e11, "radius_x": 1e-6, "radius_y": 3e-6},
    "power-law-indenter": {"E_star": 1e11, "coefficient": 0.5e6, "exponent": 2.0},
    "cone": {"E_star": 1e11, "slope": 0.1},
    "flat-punch": BALL,
    "elliptic-punch": {"E_star": 1e11, "half_axis_x": 1e-6, "half_axis_y": 3e-6},
    "rigid-sphere": BALL,
    "line-power-law-indenter": {"E_star": 1e11, "coefficient": 0.5e6, "exponent": 2.0},
    "wedge": {"E_star": 1e11, "slope": 0.1},
    "line-flat-punch": {"E_star": 1e11, "half_width": 1e-6},
    "cylinder-in-hole": {"E_star": 1e11, "inner": 1e-6, "outer": 1.1e-6},
    "pin-in-hole": {"E_star": 1e11, "inner": 1e-6, "outer": 1.1e-6},
    "sphere-in-cavity": {"E_star": 1e11, "inner": 1e-6, "outer": 1.1e-6},
    "mindlin": {**BALL, "G_star": 8e10, "friction": 0.3},
    "mindlin-line": {**BALL, "friction": 0.3},
    "mindlin-wave": {"E_star": 1e11, "amplitude": 1e-9, "wavelength": 1e-6, "friction": 0.3},
    "tresca-disc": {"G_star": 8e10, "radius": 1e-6, "bound": 1e8},
    "tresca-twist": {"G_torsion": 4e10, "radius": 1e-6, "bound": 1e8},
    "tresca-line": {"half_width": 1e-6, "bound": 1e8},
    "sticking-twist": {"G_torsion": 4e10, "radius": 1e-6},
    "lubkin": {**BALL, "G_torsion": 4e10, "friction": 0.3},
    "carter": {**BALL, "friction": 0.3},
    "kalker-linear": WHEEL,
    "shen-hedrick-elkins": {**WHEEL, "load": 1e5, "friction": 0.3},
    "fastsim": {**WHEEL, "load": 1e5, "friction": 0.3},
    "sliding-cylinder": {**BALL, "beta": 0.25, "friction": 0.5},
    "sliding-punch": {"E_star": 1e11, "half_width": 1e-6, "beta": 0.25, "friction": 0.5},
    "sticking-indenter": {"E_star": 1e11, "coefficient": 0.5e6, "exponent": 2.0, "beta": 0.25},
    "sticking-punch": {**BALL, "beta": 0.25},
    "sticking-punch-line": {"E_star": 1e11, "half_width": 1e-6, "beta": 0.25},
    "sticking-indenter-line": {"E_star": 1e11, "coefficient": 0.5e6, "exponent": 2.0, "beta": 0.25},
    "frictional-punch": {**BALL, "beta": 0.25, "friction": 0.2},
    "frictional-indenter": {"E_star": 1e11, "coefficient": 0.5e6, "exponent": 2.0, "beta": 0.25, "friction": 0.2},
    "goodman-line": {"beta": 0.25, "friction": 0.2},
    "jkr": {**BALL, "work": 0.05},
    "dmt": {**BALL, "work": 0.05},
    "maugis-dugdale": {**BALL, "work": 0.05, "attraction": 1e8},
    "jkr-power-law": {"E_star": 1e6, "coefficient": 0.1, "exponent": 1.0, "work": 0.05},
    "jkr-cylinder": {"E_star": 1e6, "radius": 1e-4, "work": 0.05},
    "jkr-coated-sphere": {"coating": 1e7, "base": 1e6, "thickness": 1e-5, "radius": 1e-4, "work": 0.05},
    "chang-etsion-bogy-sphere": {**BALL, "hardness": 8e9},
    "kogut-etsion-sphere": {**BALL, "hardness": 8e9},
    "jackson-green-sphere": {**BALL, "yield_stress": 3e9},
    "sinusoidal-asperity": {"E_star": 1e11, "height": 1e-7, "wavelength": 1e-6},
    "hertz-stress": {**BALL, "friction": 0.2},
    "hertz-line-stress": {**BALL, "friction": 0.2},
    "hertz-ellipse-stress": {"E_star": 1e11, "radius_x": 1e-6, "radius_y": 3e-6},
    "first-yield": {},
    "first-yield-line": {},
    "shakedown": {"friction": 0.1},
    "shakedown-line": {"friction": 0.1},
    "boussinesq": {"load": 1e-3, "shear": 8e10},
    "cerruti": {"tangential": 1e-3, "shear": 8e10},
    "flamant": {"normal": 1.0, "shear": 8e10, "tangential": 0.5},
    "strip": {"half_width": 1e-6, "pressure": 1e9, "shear": 8e10, "traction": 2e8},
    "nayak": MOMENTS,
    "sampled-peaks": {"rho_1": 0.8, "rho_2": 0.6},
    "pastewka-robbins": {"E_star": 1e6, "slope": 0.1, "laplacian": 1e6, "work": 0.05, "reach": 1e-9},
    "persson-tosatti": {"work": 0.05, "elastic_energy": 0.02},
    "plasticity-index": {**{key: SUMMITS[key] for key in ("E_star", "radius", "height_deviation")}, "hardness": 8e9},
    "profile-plasticity-index": {"E_star": 1e11, "rms_height": 1e-8, "correlation_length": 1e-6, "hardness": 8e9},
    "least-area": {"hardness": 8e9},
    "effective-hardness": {"film": 15e9, "substrate": 9e9, "modulus_ratio": 0.7},
    "oliver-pharr": {"load": 1e-3, "depth": 1e-7, "stiffness": 4e4},
    "statistical-meniscus": {**SUMMITS, **FILM, "skewness": 0.3, "kurtosis": 3.5},
    "kinetic-meniscus": {**SUMMITS, **FILM, "viscosity": 0.1, "hamaker_constant": 5e-20},
    "droplet-meniscus": {"radius": 1e-6, "surface_tension": 0.072, "contact_angle": 0.5, "immersion": 5e-9},
    "film-meniscus": {"radius": 1e-6, "surface_tension": 0.072, "contact_angle": 0.5, "height": 5e-9},
    "vapour-meniscus": {"surface_tension": 0.072, "molar_volume": 1.8e-5},
}
"""Numbers for every theory of the catalogue; a new theory is one more entry."""

RANGES = {
    "pressure": (1e5, 1e7),
    "separation": (0.0, 2e-8),
    "load": (1e-8, 1e-5),
    "approach": (1e-11, 1e-9),
    "interference": (1e-11, 1e-8),
    "contact_radius": (1e-9, 1e-7),
    "half_width": (1e-9, 1e-7),
    "gap": (0.0, 1e-8),
    "fraction": (0.01, 0.99),
    "humidity": (0.05, 0.95),
    "tangential": (0.0, 2e-7),
    "depth": (1e-9, 1e-6),
    "friction": (0.0, 0.6),
    "height": (-1e-8, 3e-8),
    "D": (-1.0, 4.0),
    "E_star": (1e9, 1e12),
    "depth_ratio": (0.0, 5.0),
    "time": (0.0, 1e-3),
    "local": (1e7, 1e10),
    "torque": (0.0, 1e-15),
    "creepage": (-0.01, 0.01),
    "speed": (1e-4, 1.0),
}
"""Between what the arguments run."""

WAYS = [(name, way) for name, kind in THEORIES.items() for way in ways_of(kind)]


def made(name: str):
    return theory(name)(**EXAMPLES[name])


@pytest.mark.parametrize(("name", "way"), WAYS, ids=lambda item: getattr(getattr(item, "axis", None), "name", item))
def test_every_way_of_every_theory_answers(name, way):
    low, high = RANGES[way.axis.name]
    values = np.linspace(low, high, 200)
    given = {item.name: {"load": 1e-6, "pressure": 1e6}[item.name] for item in way.given if item.required}
    model = made(name)
    found = evaluate(model, **{way.axis.name: values}, **given)
    axis, first = found.columns[0]
    assert axis.name == way.axis.name
    assert first == pytest.approx(values)
    assert len(found.columns) > 1
    for column, numbers in found.columns:
        assert numbers.shape == values.shape
        assert column.label
        assert not np.isnan(numbers).all()
    for limit in found.limits:
        assert np.broadcast_to(limit.value, values.shape).shape == values.shape
        assert reference(limit.citation)


@pytest.mark.parametrize("name", THEORIES)
def test_every_theory_can_be_asked_and_cited(name):
    kind = theory(name)
    assert ways_of(kind) or kind.numbers
    names = [item.name for item in parameters(kind)]
    axes = {item.name for way in ways_of(kind) for item in (way.axis, *way.given)}
    assert not axes & set(names), "an option cannot be both"
    model = made(name)
    assert asp.cite(model) == asp.cite(kind)
    assert all(f"[{key}]" in asp.cite(model) for key in kind.citation_keys)
    if kind.numbers:
        found = evaluate(model)
        assert len(found.numbers) == len(kind.numbers)
        assert all(np.isfinite(value) for _, value in found.numbers)
        assert found.columns == ()


def test_the_families_hold_every_theory_once():
    names = [kind.name for family in FAMILIES.values() for kind in family]
    assert sorted(names) == sorted(set(names)) == sorted(THEORIES)
    assert list(EXAMPLES) == list(THEORIES)


NO_NUMBERS = (
    "1MPa",
    "1",
    b"1",
    ["1"],
    None,
    True,
    1j,
    {},
    {1.0},
    object(),
    [[1.0], [1.0, 2.0]],
    np.datetime64("2026-01-01"),
)


def test_no_theory_takes_what_is_not_a_number():
    """Every argument of every way of the catalogue: text, truth values, complex numbers and other things are refused."""
    taken = []
    for name, way in WAYS:
        arguments = {item.name: 1.0 if item.required else item.default for item in (way.axis, *way.given)}
        for argument in arguments:
            for wrong in NO_NUMBERS:
                try:
                    getattr(made(name), way.method)(**arguments | {argument: wrong})
                except asp.InputError:
                    continue
                taken.append((name, argument, wrong))
    assert taken == []


def test_an_answer_is_that_of_the_theory():
    model = made("hertz")
    found = {column.name: values for column, values in evaluate(model, load=[1e-6, 1e-5]).columns}
    answer = model.at_load([1e-6, 1e-5])
    assert found["approach"].tolist() == answer.approach.tolist()
    assert found["mean_pressure"].tolist() == answer.mean_pressure.tolist()
    nayak = {column.name: value for column, value in evaluate(made("nayak")).numbers}
    assert nayak["density"] == made("nayak").density


def test_what_a_theory_does_not_define_is_left_out():
    columns = [column.name for column, _ in evaluate(made("hertz-line"), load=1.0).columns]
    assert "approach" not in columns
    assert "max_pressure" in columns


@pytest.mark.parametrize(
    ("name", "arguments", "subject", "shown"),
    [
        ("hertz", {}, "hertz", "nothing"),
        ("hertz", {"pressure": 1e6}, "hertz", "pressure"),
        ("hertz-stress", {"depth": 1e-9}, "hertz-stress", "load"),
        ("sampled-peaks", {"load": 1.0}, "sampled-peaks", "nothing"),
        ("mindlin", {"tangential": 1e-7, "load": [1.0, 2.0]}, "load", "2"),
        ("boussinesq", {"depth": 0.0}, "depth (m)", "0"),
        ("hertz", {"load": -1.0}, "load (N)", "-1"),
    ],
)
def test_what_cannot_be_asked_is_refused(name, arguments, subject, shown):
    with refused(asp.InputError, subject, shown):
        evaluate(made(name), **arguments)


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("gw", "greenwood-williamson"),
        ("BGT", "bush-gibson-thomas"),
        ("herz", "hertz"),
        ("HertzPoint", "hertz"),
        ("greenwood_wiliamson", "greenwood-williamson"),
        ("meniscus", "statistical-meniscus"),
    ],
)
def test_names_that_are_meant_are_found(written, meant):
    assert meant in nearest(written)
    with refused(asp.InputError, "name of a theory", meant):
        theory(written)


def test_a_name_like_no_other_is_answered_with_all():
    with refused(asp.InputError, "name of a theory"):
        theory("xxxxxx")
