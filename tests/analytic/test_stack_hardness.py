"""Hardness of several coatings by depth: one coating, equal neighbours, separated scales, bounds,
work."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from refusals import refused
from scipy.integrate import quad

from asperity.core.errors import InputError
from asperity.theories.hardness.effective_hardness import EffectiveHardness, StackHardness

values = st.floats(0.05, 20.0)
parts = st.lists(st.tuples(values, values, values), min_size=1, max_size=4)


def stack(layers, base=(1.0, 1.0)) -> StackHardness:
    """Layers of hardness, modulus and thickness on a base of hardness and modulus."""
    solids = [*((h, e) for h, e, _ in layers), base]
    faces = tuple(EffectiveHardness(a[0], b[0], a[1] / b[1]) for a, b in itertools.pairwise(solids))
    return StackHardness(faces, tuple(np.cumsum([t for _, _, t in layers])))


@given(values, values, values, st.floats(0.0, 5.0))
def test_one_coating_is_the_law_itself(hardness, modulus, thickness, ratio):
    found = stack([(hardness, modulus, thickness)]).at(ratio * thickness)
    assert float(found) == pytest.approx(float(EffectiveHardness(hardness, 1.0, modulus).at(ratio)), rel=1e-12)


@given(parts, st.floats(0.0, 100.0))
def test_lies_between_the_extremes_from_the_top_to_the_base(layers, depth):
    law, all_of_it = stack(layers), [h for h, _, _ in layers] + [1.0]
    assert min(all_of_it) * (1 - 1e-12) <= float(law.at(depth)) <= max(all_of_it) * (1 + 1e-12)
    assert float(law.at(0.0)) == pytest.approx(layers[0][0], rel=1e-12)
    assert float(law.at(1e9)) == pytest.approx(1.0, rel=1e-12)


def test_separated_thicknesses_show_each_material_in_turn():
    law = stack([(3.0, 1.0, 1e-3), (8.0, 1.0, 1.0), (2.0, 1.0, 1e3)])
    for depth, hardness in ((1e-6, 3.0), (0.03, 8.0), (30.0, 2.0), (1e6, 1.0)):
        # a hard film lets the one below through linearly, depth over thickness
        assert float(law.at(depth)) == pytest.approx(hardness, rel=0.05)


@pytest.mark.parametrize("film", [0.3, 4.0])
def test_a_film_cut_in_two_is_the_same_film(film):
    whole, cut = stack([(film, 1.0, 1.0)]), stack([(film, 1.0, 0.4), (film, 1.0, 0.6)])
    depths = np.linspace(0.0, 5.0, 30)
    if film < 1.0:  # the face inside is of the kind of a soft film, whose share falls with the square, too
        np.testing.assert_allclose(cut.at(depths), whole.at(depths), rtol=0.07)
    nearly = stack([(film * 1.0001, 1.0, 0.4), (film, 1.0, 0.6)])
    np.testing.assert_allclose(nearly.at(depths[depths > 1.0]), cut.at(depths[depths > 1.0]), rtol=1e-3)


@pytest.mark.parametrize(
    "layers", [[(4.0, 1.0, 1.0)], [(0.3, 2.0, 1.0)], [(2.0, 1.0, 0.1), (9.0, 3.0, 0.2), (0.5, 1.0, 3.0)]]
)
def test_work_is_the_integral_of_the_hardness(layers):
    law = stack(layers)
    for depth in (0.0, 1e-5, 0.01, 0.7, 4.0, 60.0, 1e6):
        exact = sum(quad(law.at, a, b, epsrel=1e-12)[0] for a, b in _panels(depth))
        assert float(law.work(depth)) == pytest.approx(exact, rel=1e-6)  # kinks where one share passes the other
    assert law.work(np.array([[0.1, 0.2]])).shape == (1, 2)


def _panels(depth):
    ends = [0.0, *(10.0**k for k in range(-6, 7) if 10.0**k < depth), depth]
    return list(itertools.pairwise(ends))


@given(parts, st.floats(1e-6, 50.0))
@example([(13.0, 19.0, 14.5625), (17.0, 3.25, 7.0)], 42.0)  # a share passes the other within the step
def test_the_derivative_of_the_work_is_the_hardness(layers, depth):
    law, step = stack(layers), 1e-4 * depth
    slope = (float(law.work(depth + step)) - float(law.work(depth - step))) / (2 * step)
    assert slope == pytest.approx(float(law.at(depth)), rel=2e-3)


def test_faces_must_fit_together():
    one, two = EffectiveHardness(3.0, 2.0, 1.0), EffectiveHardness(2.0, 1.0, 1.0)
    with refused(InputError, "depths of a stack", "1", "2"):
        StackHardness((one, two), (1.0,))
    with refused(InputError, "depth of a face of a stack (m)"):
        StackHardness((one, two), (1.0, 1.0))
    with refused(InputError, "coating of each face of a stack", "1", "3"):
        StackHardness((two, one), (1.0, 2.0))
    with refused(InputError, "depth of an indentation"):
        StackHardness((one,), (1.0,)).at(-1.0)
    assert math.isclose(float(StackHardness((one,), (1.0,)).at(0.0)), 3.0)


def test_no_depths_have_no_hardness_and_no_work():
    law = stack([(3.0, 1.0, 1e-3)])
    assert law.at(np.zeros(0)).shape == law.work(np.zeros((0, 2))[:, 0]).shape == (0,)
