"""Compiled passes over the half spectra of internal pressures against the same sums written out."""

from __future__ import annotations

import numpy as np
import pytest

import asperity as asp
from asperity.contact.operators import prepare_operator
from asperity.core.arrays import RealArray
from asperity.physics.viscoelastic.coupling import LayeredPast, Past, TimeWeights
from asperity.solids.compliance.creep import LayeredCreep, contact_creep

SOFT = asp.Viscoelastic.prony(1.0, ((2.0, 10.0), (3.0, 1.0)), 0.4)
BODY = asp.Layered([asp.Layer(SOFT, 6.0)], asp.Elastic(20.0, 0.3))
BOUNDARIES = (asp.Periodic(), asp.Free())


def prepared(boundary: asp.Periodic | asp.Free) -> LayeredPast:
    problem = asp.ContactProblem(asp.Surface(np.zeros((20, 18)), 1.0), BODY, boundary=boundary)
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary)
    creep = contact_creep(BODY, asp.Rigid())
    assert isinstance(creep, LayeredCreep)
    return LayeredPast.prepared(creep, operator)


def loads(number: int) -> list[RealArray]:
    return list(np.random.default_rng(1).random((number, 20, 18)))


def marched(kept: LayeredPast, pressures: list[RealArray], lengths: list[float]) -> list[Past]:
    """Pasts after steps of these ``lengths`` to the ``pressures``."""
    pasts = [kept.past({})]
    for pressure, length in zip(pressures, lengths, strict=True):
        weights = TimeWeights.of(kept.times, length)
        kernel = kept.operator.kernel + np.tensordot(weights.after, kept.kernels, 1)
        deflection = kept.field(kernel * kept.spectrum(pressure))
        pasts.append(kept.after(pasts[-1], weights, pressure, deflection, (0.0, 0.0, 0.0))[0])
    return pasts


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_displacement_and_energy_are_the_sums_over_all_terms(boundary: asp.Periodic | asp.Free) -> None:
    kept, (first, second) = prepared(boundary), loads(2)
    past = marched(kept, [first], [0.0])[-1]
    weights, next_weights = TimeWeights.of(kept.times, 0.7), TimeWeights.of(kept.times, 0.3)
    spectra = kept.spectrum(first), kept.spectrum(second)
    kernel = kept.operator.kernel + np.tensordot(weights.after, kept.kernels, 1)
    np.testing.assert_allclose(kept.operator.kernel + kept.summed(weights), kernel, rtol=1e-13)
    deflection = kept.field(kernel * spectra[1])
    after, stored = kept.after(past, weights, second, deflection, (0.0, 0.0, 0.0))
    xi = [b * spectra[0] + a * spectra[1] for b, a in zip(weights.before, weights.after, strict=True)]
    lift = sum(
        c * (e * x + b * spectra[1])
        for c, e, x, b in zip(kept.kernels, next_weights.e, xi, next_weights.before, strict=True)
    )
    expected = kept.field(np.asarray(lift))
    np.testing.assert_allclose(kept.lift(after, next_weights), expected, atol=1e-12 * np.abs(expected).max())
    fields = [kept.field(c * x) for c, x in zip(kept.kernels, xi, strict=True)]
    squares = [
        float((kept.field(x.copy()) * f).sum()) if boundary == asp.Periodic() else s
        for x, f, s in zip(xi, fields, after.squares, strict=True)
    ]
    springs = 0.5 * float((second * kept.operator.apply(second)).sum()) + 0.5 * sum(squares)
    assert stored == pytest.approx(springs, rel=1e-12)
    np.testing.assert_allclose(after.squares, squares, rtol=1e-10, atol=1e-12 * max(squares))


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_what_does_not_show_is_left_out_and_little(boundary: asp.Periodic | asp.Free) -> None:
    """Beyond the columns that are visited nothing is kept, and together it is a millionth of the
    displacement for each term."""
    kept = prepared(boundary)
    columns = np.arange(kept.kernels.shape[2])
    beyond = columns >= kept.passes.cuts[..., None]
    assert not kept.kernels[beyond].any()
    assert 0.3 < beyond.mean() < 1.0
    past = marched(kept, loads(3), [0.0, 0.2, 0.5])[-1]
    assert not np.asarray(past.xi)[beyond].any()


def test_curvature_is_the_second_difference() -> None:
    kept = prepared(asp.Periodic())
    pasts = marched(kept, loads(3), [0.1, 0.2, 0.5])[1:]
    weights = TimeWeights.of(kept.times, 0.5)
    spectra = [np.asarray(past.response) for past in pasts]
    second = 2.0 * ((spectra[2] - spectra[1]) / 0.5 - (spectra[1] - spectra[0]) / 0.2) / 0.7
    bent = np.linalg.norm(np.tensordot(weights.of_curvature, kept.kernels, 1) * second)
    whole = kept.operator.kernel + np.tensordot(weights.after, kept.kernels, 1)
    found = kept.curvature((pasts[0], pasts[1], pasts[2]), weights)
    assert found == pytest.approx(bent / np.linalg.norm(whole * spectra[2]), rel=1e-12)
