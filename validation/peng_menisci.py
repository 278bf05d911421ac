"""Meniscus force of coated rough surfaces: its similarity, its law, and the thickness of the layer
(Peng 2001)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from page import Claim, Page, Table, write_page
from peng import BASE, CORRELATION_LENGTH, HARDNESS_RATIO, coated, grid, surfaces
from peng_scaling import Factors
from ready_studies import PIXEL, ready, results

import asperity as asp

if TYPE_CHECKING:
    import xarray

WATER, ANGLE = 72.75e-3, math.radians(60.0)
RATIOS = (0.5, 1.0, 2.0)
SIZES = (1e-9, 10e-9)
"""Rms heights in m."""

X = (1e-3, 2e-3, 4e-3)
"""p_n β*/(E2 σ)."""

ORDINATE = 2000.0
"""Tick of (Fm/W)/X of fig. 3.20 beside which Fm/Fm0 = 1 stands; the next ones are 0 and 4000 beside
0 and 2."""

TRIALS = (
    ("heights, film and pₙ × 0.1, γ × 0.01", Factors(height=0.1)),
    ("all lengths × 2, γ × 2", Factors(length=2.0, height=2.0)),
    ("E₁, E₂, Hₛ, pₙ and γ × 3", Factors(modulus=3.0)),
)

ABOUT = (
    "Peng (2001, sec. 3.2.6.1, figs 3.18 and 3.20): the meniscus force with film and menisci of the height σ, "
    "water (72.75 mN/m, 60° on both sides), β* = 0.5 µm, E₂ = 100 GPa, hardness 0.05 E₁. With X = pₙβ*/E₂σ "
    "his law is Fₘ ∝ γAₙX/σ. Area and pressure are on the pages [peng_scaling](peng_scaling.md) and "
    "[peng_layer_effect](peng_layer_effect.md). Two forces are distinguished: that of the menisci in the "
    "contact under the external load W alone, and the steady one, for which the contact bears W and the "
    "menisci."
)


@dataclass(frozen=True)
class Forces:
    """Fm/W of one contact under the load alone and steady (NaN where it runs away), and the menisci
    of the first, pixels."""

    alone: float
    steady: float
    pixels: int


def compare(seeds: int = 3, points: int = 192, count: int = 13) -> Page:
    """Ours on ``seeds`` surfaces of ``points`` a side; the layer has ``count`` thicknesses."""
    shapes = surfaces(seeds, grid(points, points * PIXEL))
    exact, exact_claims = _exact(points)
    law, law_claims = _law(shapes)
    table = ready("layer_thickness", points=points, seeds=seeds)
    table["critical_thickness"]["count"] = count
    data = results({**table, "quantities": [*table["quantities"], "feedback"]})
    layer, layer_claims = _layer(data)
    parts = (exact, law, LAW, layer, LAYER)
    return Page("Meniscus force of coated rough surfaces", ABOUT, parts, (*exact_claims, *law_claims, *layer_claims))


def forces(surface: asp.Surface, ratio: float, x: float, *, rms: float, factors: Factors = Factors()) -> Forces:
    """Forces at E1/E2 = ``ratio`` on ``surface``, heights over σ, with everything multiplied by
    ``factors``."""
    modulus, height = factors.modulus * BASE.youngs_modulus, factors.height * rms
    spacing = [factors.length * step for step in surface.grid.spacing]
    body = coated(ratio, factors.length * 1e-6)
    if factors.modulus != 1.0:
        layer = asp.Layer(asp.Elastic(ratio * modulus, BASE.poisson_ratio), factors.length * 1e-6)
        body = asp.Layered([layer], asp.Elastic(modulus, BASE.poisson_ratio))
    law = asp.Hardness(HARDNESS_RATIO * ratio * BASE.youngs_modulus * factors.stress)
    problem = asp.ContactProblem(asp.Surface(height * surface.heights, *spacing, periodic=True), body, law=law)
    # the suction γ/h_m must scale as stresses do
    tension = WATER * factors.stress * factors.height
    film = asp.LiquidFilm(surface_tension=tension, thickness=height, contact_angles=(ANGLE, ANGLE))
    load = asp.MeanPressure(x * rms / CORRELATION_LENGTH * BASE.youngs_modulus * factors.stress)
    first = asp.solve(replace(problem, film=film), load, rounds=asp.solvers.Rounds(most=1), on_failure="return")
    try:
        steady = asp.solve(replace(problem, film=film), load).menisci.relative_meniscus_force
    except asp.errors.NoSolutionError:
        steady = math.nan
    return Forces(first.menisci.relative_meniscus_force, steady, int(first.menisci.wetting.menisci.sum()))


def _exact(points: int) -> tuple[Table, tuple[Claim, ...]]:
    surface = surfaces(1, grid(points, points * PIXEL))[0]
    base = forces(surface, 2.0, 2e-3, rms=2e-9)
    rows, worst = [], 0.0
    for name, factors in TRIALS:
        other = forces(surface, 2.0, 2e-3, rms=2e-9, factors=factors)
        numbers = (
            other.pixels - base.pixels,
            abs(other.alone / base.alone - 1.0),
            abs(other.steady / base.steady - 1.0),
        )
        rows.append((name, f"{numbers[0]}", *(f"{number:.1e}" for number in numbers[1:])))
        worst = max(worst, *numbers[1:])
    about = (
        "Exact similarity: a contact with X = 2·10⁻³, E₁/E₂ = 2, σ = 2 nm, whose menisci pull with "
        f"{base.alone:.3g} W and {base.steady:.3g} W, and the same with other sizes. Fₘ/W depends on X, on "
        "γβ*/E₂σ², and on h/β*, hf/σ and hm/σ:"
    )
    head = ("scaled", "menisci: pixels more", "Fₘ/W under W: deviation", "steady: deviation")
    # a pixel at the rim may be counted or not, where rounding moves the gap: a few of thousands
    return Table(about, head, tuple(rows)), (Claim("exact similarity: largest deviation of Fₘ/W", worst, 0.0, 1e-2),)


def _law(shapes: Sequence[asp.Surface]) -> tuple[Table, tuple[Claim, ...]]:
    rows, claims = [], []
    for ratio in RATIOS:
        alone, steady = (np.empty((len(X), len(SIZES), len(shapes))) for _ in range(2))
        for i, x in enumerate(X):
            for j, rms in enumerate(SIZES):
                found = [forces(shape, ratio, x, rms=rms) for shape in shapes]
                scale = BASE.youngs_modulus * rms**2 / (WATER * CORRELATION_LENGTH)
                alone[i, j], steady[i, j] = np.array([(scale * one.alone, scale * one.steady) for one in found]).T
            shown = [f"{alone[i, 0].mean():.2f}", *(f"{value:.2f}" for value in steady[i].mean(axis=1))]
            rows.append((f"{ratio:g}", f"{x:.0e}", *shown))
        slope = np.polyfit(np.log(X), np.log(alone[:, 0].mean(axis=1) * np.array(X)), 1)[0]
        name = f"E₁/E₂ = {ratio:g}"
        claims.append(
            Claim(f"{name}: exponent of X in Fₘ under the load alone, below the 1 of the law", float(slope), 0.4, 0.9)
        )
        above = steady[:, 0].mean() / alone[:, 0].mean()
        claims.append(Claim(f"{name}: steady force over that under the load alone, σ = 1 nm", float(above), 3.0))
    head = ("E₁/E₂", "X", "under W, σ = 1 nm", *(f"steady, σ = {1e9 * rms:g} nm" for rms in SIZES))
    about = "The law: (Fₘ/W)·E₂σ²/γβ*, by which each column would be constant for given E₁/E₂:"
    return Table(about, head, tuple(rows)), tuple(claims)


LAW = """* Under the external load alone Fₘ rises more slowly than X. Menisci form around summits that nearly
  touch, which are relatively more numerous at small load. Peng takes the force as proportional to the area
  "for the sake of simplification".
* The steady force depends on γβ*/E₂σ² as well. At σ = 10 nm it is nearly that under W; at σ = 1 nm it is many
  times as large, because there the menisci press the surfaces together more than the load does, and hardly
  depends on the load (Fₘ/W ∝ 1/X). So a law in X alone holds for weak menisci, or without feedback."""


def _layer(data: xarray.Dataset) -> tuple[Table, tuple[Claim, ...]]:
    share = data["relative_meniscus_force"]
    kinds = {"under W": share * (1.0 - data["feedback"]), "steady": share}
    thickness = np.asarray(data["thickness"]) / CORRELATION_LENGTH
    ratios = [float(modulus) / BASE.youngs_modulus for modulus in data["modulus"]]
    means = {name: np.asarray(one.mean("surface").transpose("modulus", "thickness")) for name, one in kinds.items()}
    rows = [
        (
            f"{h:.3g}" if 0.0 < h < math.inf else ("no layer" if h == 0.0 else "endless"),
            *(f"{means[name][i, k] / means[name][i, 0]:.3f}" for i in range(len(ratios)) for name in kinds),
        )
        for k, h in enumerate(thickness)
    ]
    head = ("h/β*", *(f"E₁/E₂ = {ratio:g}: {name}" for ratio in ratios for name in kinds))
    x = 4e5 * CORRELATION_LENGTH / (BASE.youngs_modulus * 1e-9)
    bare = {name: float(one[0, 0]) for name, one in means.items()}
    about = (
        "Layer thickness (fig. 3.20), `examples/campaigns/layer_thickness.toml`: Fₘ/Fₘ₀ over that of the base "
        f"alone, X = 2·10⁻³, σ = 1 nm. On the base alone (Fₘ/W)/X is {bare['under W'] / x:.0f} under W and "
        f"{bare['steady'] / x:.0f} steady; the figure has {ORDINATE:.0f} beside Fₘ/Fₘ₀ = 1."
    )
    return Table(about, head, tuple(rows)), tuple(_layer_claims(means, bare["under W"] / x, bare["steady"] / x))


def _layer_claims(means: dict[str, np.ndarray], alone: float, steady: float) -> Iterable[Claim]:
    yield Claim("(Fₘ/W)/X of the base under W, their 2000", alone, 0.75 * ORDINATE, 1.25 * ORDINATE)
    yield Claim("the same, steady: many times theirs", steady, 5.0 * ORDINATE)
    for name, (soft, stiff) in means.items():
        yield Claim(f"{name}: endless compliant layer over no layer", float(soft[-1] / soft[0]), 1.2, 2.1)
        yield Claim(f"{name}: endless stiff layer over no layer", float(stiff[-1] / stiff[0]), 0.4, 0.9)


LAYER = """* The ordinate of the figure is that of menisci under the external load alone, though the flow
  chart of Peng includes the feedback. Table 3.1 is also dry: its rows of one pixel carry pₙ alone. With σ = 1
  nm and water the steady force is some ten times as large, and the interface far from the published one.
* A compliant layer raises the force and a stiff one lowers it, most of it between 0.02 and 1 β*, as in the figure."""


if __name__ == "__main__":
    write_page(compare(), __file__)
