"""A self-contained HTML page on a comparison of theories with the numerical solution."""

from __future__ import annotations

import math
from collections.abc import Sequence
from operator import itemgetter
from pathlib import Path

import numpy as np

from ..core.units import percent, show
from ..io.description import software, surface_provenance
from ..io.words import Rows, body_text, modulus_label, surface_rows
from ..parts.part import Table
from ..plots.comparison import comparison_figures
from ..plots.picture import Figure
from ..studies.comparison import Comparison, TheoryCurve
from .page import shown, software_rows, write_page

# A comparison of theories in words for tables.


NONE = "–"
"""What stands for no number."""


def comparison_sentence(comparison: Comparison) -> str:
    """One or two sentences on what was compared, and which theory comes nearest within its
    limits."""
    p, count = comparison.pressures, len(comparison.curves)
    text = f"{count} theories at {p.size} loads from {show(float(p[0]), 'Pa', 3)} to {show(float(p[-1]), 'Pa', 3)}"
    if comparison.numerical is None:
        return f"{text}, without the numerical solution."
    text += (
        f", beside the boundary-element solution ({comparison.numerical.solver}, {comparison.numerical.seconds:.2g} s)."
    )
    ranked = [
        (_rms(comparison, curve), curve)
        for curve in comparison.curves
        if 2 * np.count_nonzero(curve.valid & np.isfinite(comparison.deviation(curve.name))) >= p.size
    ]
    if not ranked:
        return f"{text} No theory holds at half of the loads."
    off, best = min(ranked, key=itemgetter(0))
    return (
        f"{text} Of the theories that hold at half of the loads or more {best.name} comes nearest where it holds "
        f"({_range(comparison, best)}): its area is off by {percent(off, 2)} (rms)."
    )


def setup_rows(comparison: Comparison) -> Rows:
    """Bodies, modulus, law and roughness that all curves share."""
    problem, roughness = comparison.problem, comparison.roughness
    rows = [
        ("body", body_text(problem.body)),
        ("counter body", body_text(problem.counter_body)),
        (modulus_label(problem), show(comparison.E_star, "Pa")),
        ("boundary, law of the numerical solution", f"{problem.boundary.name}, {problem.law.name}"),
        ("rms height", show(roughness.rms_height, "m")),
        ("rms gradient h'", f"{roughness.rms_gradient:.4g}"),
        ("Nayak's parameter α", f"{roughness.alpha:.4g}"),
        ("skewness, kurtosis of the heights", f"{roughness.skewness:.3g}, {roughness.kurtosis:.3g}"),
    ]
    if roughness.anisotropy is not None:
        rows.append(("ratio of the principal mean square slopes", f"{roughness.anisotropy:.3g}"))
    if roughness.summits is not None:
        summits = roughness.summits
        rows.append(("summits", f"{summits.count}, {show(summits.density, '1/m**2', 3)}"))
        rows.append(("mean radius of the summits", show(1.0 / float(summits.curvature.mean()), "m", 3)))
    return rows


def slope_table(comparison: Comparison) -> Table:
    """κ and deviation of the area of every theory at the lowest, a middle and the highest load, and
    where it holds.

    The last columns are root mean squares over the loads at which the theory holds for the
    quantity, the gap in rms heights σ, and the loads at which it holds for the area.
    """
    at = sorted({0, comparison.pressures.size // 2, comparison.pressures.size - 1})
    loads = [show(float(comparison.pressures[number]), "Pa", 3) for number in at]
    headings = [
        "Theory",
        *(f"κ at {load}" for load in loads),
        *(f"area (%) at {load}" for load in loads),
        "area (%), rms",
        "gap (σ), rms",
        "holds",
    ]
    cells: list[tuple[str, ...]] = []
    solved = comparison.numerical is not None
    if comparison.numerical is not None:
        area = comparison.numerical.area_fraction_corrected
        shares = [_share(area[number]) for number in at]
        kappas = [_number(comparison.kappa(area)[number]) for number in at]
        cells.append(("numerical", *kappas, *shares, NONE, NONE, NONE))
    for curve in comparison.curves:
        kappa = comparison.kappa(curve.prediction.area_fraction)
        off = comparison.deviation(curve.name) if solved else curve.prediction.area_fraction
        gap = _rms(comparison, curve, "gap")
        cells.append(
            (
                curve.name,
                *(_number(kappa[number]) for number in at),
                *(_share(off[number], signed=solved) for number in at),
                _share(_rms(comparison, curve)),
                NONE if math.isnan(gap) else f"{gap:.2g}",
                _range(comparison, curve),
            )
        )
    return Table(tuple(headings), tuple(cells))


def limit_rows(comparison: Comparison) -> Rows:
    """Every note on a curve, under the name of its theory where it is the first."""
    rows: Rows = []
    solved = comparison.numerical
    of_all = [("numerical", () if solved is None else solved.notes)]
    of_all += [(curve.name, curve.notes) for curve in comparison.curves]
    for name, notes in of_all:
        rows += [(name if number == 0 else "", note) for number, note in enumerate(notes)]
    return rows


def left_out_rows(comparison: Comparison) -> Rows:
    """Theories without a curve, and why."""
    return [(item.name, item.reason) for item in comparison.left_out]


def _range(comparison: Comparison, curve: TheoryCurve) -> str:
    """At which of the loads all limits of the theory hold that concern the area."""
    inside = np.flatnonzero(curve.valid)
    if inside.size == 0:
        return "nowhere"
    if inside.size == curve.valid.size:
        return "everywhere"
    low, high = (show(float(comparison.pressures[end]), "Pa", 3) for end in (inside[0], inside[-1]))
    if inside[0] == 0:
        return f"to {high}"
    return f"from {low}" if inside[-1] == curve.valid.size - 1 else f"{low} to {high}"


def _rms(comparison: Comparison, curve: TheoryCurve, quantity: str = "area_fraction") -> float:
    """Root mean square of the deviations of ``quantity`` at the loads where the theory holds for
    it."""
    deviations = comparison.deviation(curve.name, quantity)
    inside = deviations[curve.valid_for[quantity] & np.isfinite(deviations)]
    return float(np.sqrt(np.mean(inside**2))) if inside.size else math.nan


def _number(value: float) -> str:
    return f"{value:.2f}" if math.isfinite(value) else NONE


def _share(value: float, *, signed: bool = False) -> str:
    if not math.isfinite(value):
        return NONE
    return f"{100.0 * value:+.1f}" if signed else f"{100.0 * value:.3g}"


# A self-contained HTML page on a comparison of theories with the numerical solution.


def write_comparison_report(
    comparison: Comparison,
    path: str | Path,
    *,
    title: str = "",
    figures: Sequence[Figure] | None = None,
    overwrite: bool = False,
) -> None:
    """Write a page on ``comparison`` to the HTML file ``path``; it needs no network and no other
    file.

    The ``title`` is made from the source of the surface if empty; ``figures`` are those that have
    been drawn already.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    source = comparison.surface.origin.source
    heading = "Theories beside the numerical solution"
    write_page(
        path,
        "comparison.html",
        title=title or (f"{heading}: {source}" if source else heading),
        summary=comparison_sentence(comparison),
        findings=comparison.findings,
        remarks=comparison.remarks,
        table=slope_table(comparison),
        setup=setup_rows(comparison),
        surface=surface_rows(comparison.surface),
        limits=limit_rows(comparison),
        left_out=left_out_rows(comparison),
        figures=shown(comparison_figures(comparison.dataset) if figures is None else figures),
        provenance=software_rows(software(), heights=surface_provenance(comparison.surface)["digest"]),
        citation_keys=comparison.citation_keys,
        overwrite=overwrite,
    )
