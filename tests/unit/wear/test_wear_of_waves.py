"""Wear of waves in full contact: decay of homogeneous and layered bodies, order of the steps, and
the length above which explicit steps are unstable."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from reference_data import Row, every_row, reference

import asperity as asp
from asperity.contact.problem import ContactProblem
from asperity.solids.layers import Layer, Layered
from asperity.wear import WearHistory, WearSteps, archard, worn

N = 32


def waved(row: Row, height: float = 1e-4) -> tuple[ContactProblem, asp.MeanPressure]:
    """A wave of a ``row``, of which the amplitude is ``height``, pressed to full contact."""
    q = float(row["q"])
    side = 2.0 * math.pi / q
    x = np.arange(N) * side / N
    heights = np.repeat((height * np.cos(q * x))[:, None], N, axis=1)
    layer = Layer(asp.Elastic(float(row["E1"]), float(row["nu1"])), float(row["h"]))
    body = Layered([layer], asp.Elastic(float(row["E2"]), float(row["nu2"])))
    surface = asp.Surface(heights, side / N, periodic=True)
    return ContactProblem(surface, body), asp.MeanPressure(20.0 * height / float(row["c"]))


def left(history: WearHistory) -> float:
    """Amplitude of the pressure at the end over that at the start."""
    return float(np.ptp(history.last.pressure) / np.ptp(history.kept[0][1].pressure))


@every_row(reference("transport/wear_wave_decay"))
def test_waves_decay_at_the_rate_of_the_reference_by_exact_factors(row: Row) -> None:
    """Of backward Euler 1/(1 + k s/c) a step; pressure and heights alike."""
    problem, control = waved(row)
    rate, steps = float(row["decay_rate_over_kv"]), 8
    history = worn(problem, control, 1.0 / rate, archard(1.0), steps=WearSteps(number=steps))
    factor = (1.0 + 1.0 / steps) ** -steps
    # the pressure is to a relative error of 1e-7 in energy, so of its square
    assert left(history) == pytest.approx(factor, rel=1e-6)
    heights = np.ptp(history.last.problem.profile()) / np.ptp(problem.profile())
    assert heights == pytest.approx(factor, rel=1e-6)
    assert history.dose_balance < 1e-12


ROW: Row = {"E1": 1.0, "nu1": 0.3, "E2": 1.0, "nu2": 0.3, "h": 1.0, "q": 0.5, "c": 3.64}


@pytest.mark.parametrize("order", [1, 2])
def test_steps_converge_at_their_order(order: int) -> None:
    problem, control = waved(ROW)
    errors = []
    for number in (4, 8, 16):
        history = worn(problem, control, 3.64, archard(1.0), steps=WearSteps(number=number, order=order))
        errors.append(abs(left(history) - math.exp(-1.0)))
    ratios = [before / after for before, after in itertools.pairwise(errors)]
    assert ratios == pytest.approx([2.0**order] * 2, rel=0.15)


def test_the_error_stated_bounds_the_error_of_the_depth() -> None:
    problem, control = waved(ROW)
    coarse = worn(problem, control, 3.64, archard(1.0))
    fine = worn(problem, control, 3.64, archard(1.0), steps=WearSteps(number=64, order=2))
    off = float(np.abs(coarse.depth - fine.depth).sum() / fine.depth.sum())
    assert off < coarse.error


def test_explicit_steps_above_their_limit_make_a_checkerboard() -> None:
    """c(q) of the shortest wave, sqrt(2) pi / pixel, limits k ds to 2 c: above it the pressure of
    neighbouring points alternates, and an implicit step of the same length does not."""
    generator = np.random.default_rng(3)
    side = 1.0
    surface = asp.Surface(1e-5 * generator.standard_normal((N, N)), side / N, periodic=True)
    body = asp.Elastic(1.0, 0.3)
    problem = ContactProblem(surface, body)
    control = asp.MeanPressure(1e-2)  # full contact
    shortest = math.sqrt(2.0) * math.pi * N / side
    limit = 2.0 * 2.0 * (1.0 - 0.3**2) / shortest

    def alternating(method: str, length: float) -> float:
        steps = WearSteps(number=40, method=method)  # type: ignore[arg-type]
        history = worn(problem, control, 40.0 * length, archard(1.0), steps=steps)
        signs = (-1.0) ** np.add.outer(np.arange(N), np.arange(N))
        start, end = (abs(float((signs * at.pressure).mean())) for at in (history.kept[0][1], history.last))
        return end / start

    assert alternating("explicit", 0.8 * limit) < 1.0
    assert alternating("explicit", 1.2 * limit) > 10.0
    assert alternating("implicit", 1.2 * limit) < 1e-6
