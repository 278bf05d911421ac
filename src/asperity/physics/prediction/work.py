"""What is predicted beside a solved contact: computation, figure and words."""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np

from ...contact.boundary import Periodic
from ...contact.controls import MeanPressure
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...core.errors import InputError
from ...core.units import show
from ...parts.part import Found, Solved, Table, WithFacts, Words
from ...plots.picture import Figure, figures_by
from ...surfaces.surface import Surface
from .figures import PLOTS, Beside
from .part import GROUPS, SHOWN, PredictionAsked, predicted
from .predict import predict
from .prediction import Prediction

STRESSES = ("max_sqrtJ2", "max_sqrtJ2_layer", "max_sqrtJ2_base", "yield_factor")
"""Predicted numbers that friction changes, which the table does not have."""


class PredictionWork(WithFacts):
    """What the table expects of a contact: what is done for it."""

    citation_keys: ClassVar[tuple[str, ...]] = Prediction.citation_keys

    def check(self, ask: PredictionAsked, problem: ContactProblem) -> None:
        """Refuse contacts that are not like those of the table."""
        if ask.table is False:
            raise InputError(
                "surface of a prediction of its spectrum must be generated with one, kind rough, and used as it is, "
                "but is not. Predict it of its heights ({prediction.of=heights})."
            )
        if not isinstance(problem.boundary, Periodic) or min(problem.grid.shape) == 1:
            raise InputError(
                "boundary of a contact that is predicted must be periodic, on a map, but is "
                f"{problem.boundary!r} on {problem.grid.shape[0]} x {problem.grid.shape[1]} points. Give "
                "{boundary.kind=periodic}, or leave the prediction out."
            )
        others = [one.keyword or type(one).__name__ for one in problem.physics if one.keyword != "friction"]
        if others:
            raise InputError(
                "contact that is predicted must be elastic or hard, and without attraction, but has "
                f"{' and '.join(others)}. Leave the prediction out."
            )
        if np.max(problem.law.pressure_cap()) > np.min(problem.law.pressure_cap()):
            raise InputError(
                "hardness of a contact that is predicted must be the same everywhere, but is not. Leave the prediction "
                "out."
            )

    def compute(self, ask: PredictionAsked, solved: Solved) -> Found:
        """Every number that the table has, with its band."""
        problem, pressure = solved.problem, solved.result.mean_pressure
        if not pressure > 0.0:
            raise InputError(f"mean pressure must be positive for a prediction, but is {pressure:g} Pa.")
        cap = float(np.max(problem.law.pressure_cap()))
        grid, rough = problem.grid, Surface(problem.profile(), *problem.grid.spacing, periodic=problem.surface.periodic)
        of_table = ask.table is not None
        found = predict(
            ask.table.makes(**ask.table.given("kind")) if of_table else rough,
            problem.body,
            MeanPressure(pressure),
            grid=grid if of_table else None,
            counter_body=problem.counter_body,
            hardness=cap if math.isfinite(cap) else None,
        )
        values: dict[str, Any] = {}
        for quantity in SHOWN:
            one = getattr(found, quantity.name)
            rubbed = bool(problem.physics) and quantity.name in STRESSES
            numbers = (math.nan,) * 3 if rubbed or not math.isfinite(one.value) else (one.value, *one.band)
            values |= {item.name: number for item, number in zip(predicted(quantity), numbers, strict=True)}
        values |= dict(zip((item.name for item in GROUPS), (found.groups.y, found.waves.full_contact), strict=True))
        return Found(values, solved_numbers(solved.result), found.findings, self.citation_keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Solved numbers in the bands that were predicted."""
        return figures_by(PLOTS, Beside(tuple(_rows(found))))

    def words(self, found: Found, solved: Solved) -> Words:
        """Predicted and solved numbers side by side."""
        rows = _rows(found)
        outside = [label for label, _, _, low, high, value in rows if not low <= value <= high]
        if outside:
            sentence = f"Outside of what the table of solved contacts expects: {', '.join(outside)}."
        else:
            sentence = "All numbers lie where the table of solved contacts expects 19 of 20 surfaces."
        cells = tuple(
            (label, show(value, unit, 3), show(mean, unit, 3), f"{show(low, unit, 3)} … {show(high, unit, 3)}")
            for label, unit, mean, low, high, value in rows
        )
        table = Table(("", "solved", "predicted", "19 of 20 surfaces"), cells)
        return Words(sentence, tables=(("", table),) if cells else ())


def solved_numbers(result: ContactResult) -> dict[str, float]:
    """Numbers of ``result`` by the names of those that are predicted."""
    return {
        "area_fraction": float(result.area_fraction_corrected),
        "area_fraction_pixels": float(result.area_fraction),
        "peak_pressure": float(result.max_pressure),
        "mean_gap": float(np.mean(result.gap)),
    }


def _rows(found: Found) -> list[tuple[str, str, float, float, float, float]]:
    """Label, unit, predicted mean, ends of its band and solved number of all that are both."""
    rows = []
    for quantity in SHOWN:
        mean, low, high = (float(found.values[item.name]) for item in predicted(quantity))
        value = float((found.detail or {}).get(quantity.name, math.nan))
        if math.isfinite(mean + value):
            rows.append((quantity.label, quantity.unit, mean, low, high, value))
    return rows
