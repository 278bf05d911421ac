"""Flow factors asked for by a document: the factors of its contact, and their table against the
separation, in numbers, figures and words."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np

from ...contact.problem import ContactProblem, Flat
from ...core.arrays import RealArray
from ...core.status import Advice
from ...core.units import show
from ...parts.part import Found, Rows, Solved, Table, WithFacts, Words
from ...plots.picture import Figure, figures_by
from ...theories.sealing.roughness import patir_cheng
from .factors import Overlap, flow_factors, require_averaged, tabulated_flow_factors, with_its_spectrum
from .figures import FACTORS_PLOT, FactorPicture
from .part_flow_factors import SCALARS, TABLE, FlowFactorsSettings

FITTED_FROM = 0.5
"""H/σ from which the fit is defined."""

SCATTERED = 0.1
"""Standard error over the factor from which more surfaces are needed."""


class FlowFactorsWork(WithFacts):
    """What roughness does to the flow in a film: what is done for it."""

    citation_keys: ClassVar[tuple[str, ...]] = ("PatirCheng1978", "PatirCheng1979")

    def check(self, ask: FlowFactorsSettings, problem: ContactProblem) -> None:
        """Refuse what does not repeat, is flat, or is a line."""
        require_averaged(problem)

    def compute(self, ask: FlowFactorsSettings, solved: Solved) -> Found:
        """Factors of the contact, and the table where lines are kept."""
        problem, result = solved.problem, solved.result
        sigma, along = require_averaged(problem), ask.direction
        gap = np.where(result.contact, 0.0, np.maximum(result.gap, 0.0))
        with solved.stage("flow factors"):
            own = flow_factors(gap, problem.grid, sigma) if gap.any() else None
        now = [math.nan] * 4
        if own is not None:
            factors = (own.separation_over_roughness, *(getattr(own, f"pressure_{a}") for a in (along, _other(along))))
            now = [float(item[0]) for item in (*factors, getattr(own, f"shear_{along}"))]
        values: dict[str, Any] = dict(zip((item.name for item in SCALARS), (*now, sigma), strict=True))
        if solved.lines:
            values |= _table(ask, solved)
        facts = {"direction": along, "realisations": ask.realisations, "overlap": ask.overlap}
        return Found(values, facts, _scattered(values), self.citation_keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """The factors against the separation."""
        if np.size(found.values.get("factors_separation_ratio", ())) < 2:
            return ()
        return figures_by((FACTORS_PLOT,), FactorPicture(found.columns("factors_"), found.detail))

    def words(self, found: Found, solved: Solved) -> Words:
        """The factors of the contact, the table, and how it was made."""
        values, facts = found.values, found.detail
        along = facts["direction"]
        ratio, first, second, shear = (float(values[item.name]) for item in SCALARS[:4])
        if math.isnan(ratio):
            sentence = "The contact has no gap, and no flow factors."
        else:
            sentence = (
                f"At the mean gap of the contact, {ratio:.3g} σ, roughness lets {first:.3g} times the flow of smooth "
                f"surfaces through along {along} and {second:.3g} times across; the shear factor is {shear:.3g}."
            )
        summits = "deformed by the contact" if facts["overlap"] == "deformed" else "cut off"
        count = int(facts["realisations"])
        surfaces = "this surface" if count == 1 else f"this surface and {count - 1} more with its power spectrum"
        rows: Rows = [
            ("rms height σ", show(float(values["flow_roughness"]), "m", 3)),
            ("summits that touch", summits),
        ]
        made = "factors_separation_ratio" in values
        rows += [("table of", surfaces)] if made else []
        tables = (("Flow factors against the separation", _cells(found, along)),) if made else ()
        headline = [] if math.isnan(ratio) else [("pressure flow factor", f"{first:.3g} along {along}")]
        return Words(sentence, headline, rows, tables, (REMARK,))


REMARK = (
    "Flow per width q = -φ H³/(12 η) ∂P/∂x + u_m h_T + Δu σ φ_s/2 with the rough body 1 as the faster one: the sign "
    "of φ_s turns where the other surface is rough. The fits are Patir and Cheng's of isotropic Gaussian roughness "
    "that is cut off, good to 7 % from H/σ = 2 on and too low below."
)
"""What the factors mean."""

_SHOWN = (
    ("separation_ratio", "H/σ"),
    ("pressure_along", "φ along"),
    ("pressure_across", "φ across"),
    ("shear", "φ_s"),
    ("contact_fraction", "contact"),
    ("mean_gap_ratio", "h_T/σ"),
    ("fitted_pressure", "φ fitted"),
    ("fitted_shear", "φ_s fitted"),
)
"""Columns of the table that are shown, and their headings."""


def _cells(found: Found, along: str) -> Table:
    columns = found.columns("factors_")
    cells = tuple(
        tuple("" if math.isnan(value) else f"{value:.3g}" for value in row)
        for row in zip(*(columns[name] for name, _ in _SHOWN), strict=True)
    )
    axes = {"φ along": f"φ along {along}", "φ across": f"φ along {_other(along)}"}
    return Table(tuple(axes.get(head, head) for _, head in _SHOWN), cells)


def _other(axis: str) -> str:
    return "yx"["xy".index(axis)]


_NAMES = ("along", "across", "oblique", "shear", "contact", "gap", "pressure")


def _likeness(problem: ContactProblem, seed: int) -> ContactProblem:
    """The problem with another surface of the same spectrum."""
    profile = np.asarray(problem.profile())
    heights = with_its_spectrum(profile, seed)
    return replace(problem, surface=problem.surface.with_heights(heights, "same spectrum"), counter_surface=Flat())


def _table(ask: FlowFactorsSettings, solved: Solved) -> dict[str, Any]:
    """Columns of the table: means over the realisations, and their standard errors."""
    ratios = np.linspace(ask.least, ask.largest if ask.points > 1 else ask.least, ask.points)
    made = []
    with solved.stage("table of flow factors") as progress:
        for number in range(ask.realisations):
            other = solved.problem if number == 0 else _likeness(solved.problem, number)
            made.append(_columns(other, ratios, ask))
            progress.update(number + 1, 1.0 - (number + 1) / ask.realisations, 0.0)
    mean, error = np.mean(made, axis=0), np.full((len(_NAMES), ratios.size), np.nan)
    if ask.realisations > 1:
        error = np.std(made, axis=0, ddof=1) / math.sqrt(ask.realisations)
    fitted = [np.where(ratios >= FITTED_FROM, column, np.nan) for column in patir_cheng(ratios)]
    columns = (ratios, *mean, error[0], error[1], error[3], *fitted)
    return {item.name: np.asarray(column) for item, column in zip(TABLE, columns, strict=True)}


def _columns(problem: ContactProblem, ratios: RealArray, ask: FlowFactorsSettings) -> RealArray:
    """(7, n) columns by ``_NAMES`` of one surface at the ``ratios``."""
    overlap: Overlap = "cut" if ask.overlap == "cut" else "deformed"
    made = tabulated_flow_factors(problem, ratios, overlap=overlap)
    along = ask.direction
    names = [f"pressure_{along}", f"pressure_{_other(along)}", "pressure_xy", f"shear_{along}"]
    names += ["contact_fraction", "mean_gap_over_roughness", "mean_pressure"]
    return np.array([getattr(made, name) for name in names])


def _scattered(values: dict[str, Any]) -> tuple[Advice, ...]:
    """Where the realisations differ by much."""
    if "factors_separation_ratio" not in values:
        return ()
    share = values["factors_pressure_along_error"] / np.maximum(values["factors_pressure_along"], 1e-300)
    if not np.any(share > SCATTERED):
        return ()
    worst = int(np.nanargmax(share))
    ratio = float(values["factors_separation_ratio"][worst])
    fact = (
        f"The standard error of the pressure flow factor is {float(share[worst]):.2g} of it at H/σ = {ratio:.3g}: the "
        "surfaces of one spectrum differ there."
    )
    numbers = {"share": float(share[worst]), "largest": SCATTERED, "separation": ratio}
    remedy = "Average over more surfaces ({flow_factors.realisations}), or take a larger one."
    concerns = ("factors_pressure_along", "factors_pressure_across", "factors_shear")
    return (Advice("note", "scatter of the flow factors", fact, remedy, numbers, concerns),)
