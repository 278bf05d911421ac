"""Meniscus force of the head-disk interface without feedback, at three roughnesses: figs 4.3 a, b
and c of Peng (2001)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import head_disk_unfed as hdi
import numpy as np
from page import Claim, Page, Stated, Table, statements, write_page
from peng_head_disk import DISK, Curves
from ready_studies import PIXEL

import asperity as asp

SIGMAS = {"a": 0.1e-9, "b": 1e-9, "c": 10e-9}
"""Parts of the figure, and rms height in m."""

OVERCOATS = (0.75, 1.75, 10.0)
THIN = 5e-9

ABOUT = (
    "Peng (2001, fig. 4.3): F_m/W against the thickness h of the carbon for E₁/E₂ = 0.1, 0.75, 1.75 and 10, at "
    "σ = 0.1, 1 and 10 nm, β* = 0.5 µm, film and menisci 2σ high, γ = 25 mN/m, θ = 10°, pₙ = 50 kPa. The curves are "
    "not in the text at hand; printed are a floor of 5 nm and a ceiling of about 10⁴ nm of F_m/W for σ = 1 nm, and "
    "that (a) and (c) are (b) through the normalisation. Ours: means over {seeds} surfaces of {points} × {points} "
    "pixels of {pixel:.0f} nm, menisci without feedback (`feedback=False`)."
)


def compare(seeds: int = 8, points: int = 256, count: int = 16) -> Page:
    """Ours on ``seeds`` surfaces of ``points`` a side for ``count`` thicknesses."""
    found = {part: Curves(hdi.solved(seeds, points, count, rms=rms), DISK, points) for part, rms in SIGMAS.items()}
    fed = {part: _fed(part, points) for part in SIGMAS}
    scaled = {part: _normalised(part, points) for part in SIGMAS}
    rows = [_row(part, ratio, curves) for part, curves in found.items() for ratio in hdi.RATIOS]
    head = ("fig. 4.3", "σ (nm)", "E₁/E₂", "no carbon", "endless", "floor (nm)", "ceiling (nm)")
    table = Table("F_m/W without feedback at 50 kPa:", head, tuple(rows))
    beside = Table(
        "One surface with 5 nm of carbon, E₁/E₂ = 0.75: without feedback, fed back, and at the load of equal "
        "X = pₙβ*/E₂σ, times (σ/1 nm)²:",
        ("fig. 4.3", "without feedback", "with feedback", "equal X, times (σ/1 nm)²"),
        tuple((part, f"{fed[part][0]:.4g}", _shown(fed[part][1]), f"{scaled[part]:.5g}") for part in SIGMAS),
    )
    about = ABOUT.format(seeds=seeds, points=points, pixel=1e9 * PIXEL)
    said = statements("", tuple(_stated(found)))
    return Page(
        "Meniscus force without feedback at three roughnesses",
        about,
        (table, beside, said, WORDS),
        _claims(found, fed, scaled),
    )


def _problem(part: str, points: int, load: float) -> tuple[asp.ContactProblem, asp.MeanPressure]:
    rms = SIGMAS[part]
    surface = hdi.shapes(1, points, rms)[0]
    film = replace(hdi.FILM, thickness=2.0 * rms, meniscus_height=2.0 * rms)
    law = asp.Hardness(hdi.hardness(0.75, THIN))
    body = hdi.body(0.75, THIN)
    return asp.ContactProblem(surface, body, counter_body=hdi.SLIDER, law=law, film=film), asp.MeanPressure(load)


def _fed(part: str, points: int) -> tuple[float, float]:
    """F_m/W of one surface without feedback and with it; infinite where that runs away."""
    problem, load = _problem(part, points, hdi.LOAD.value)
    unfed = asp.solve(problem, load, keep=hdi.KEEP).require_menisci().relative_meniscus_force
    film = problem.film
    assert film is not None
    try:
        steady = asp.solve(problem.with_physics(film=replace(film, feedback=True)), load, keep=hdi.KEEP)
    except asp.errors.NoSolutionError:
        return unfed, float("inf")
    return unfed, steady.require_menisci().relative_meniscus_force


def _normalised(part: str, points: int) -> float:
    """F_m/W (σ/1 nm)² without hardness at the load that goes with σ."""
    share = SIGMAS[part] / 1e-9
    problem, load = _problem(part, points, hdi.LOAD.value * share)
    elastic = replace(problem, law=asp.plasticity.HardWall())
    return asp.solve(elastic, load, keep=hdi.KEEP).require_menisci().relative_meniscus_force * share**2


def _shown(value: float) -> str:
    return f"{value:.4g}" if np.isfinite(value) else "runs away"


def _row(part: str, ratio: float, curves: Curves) -> tuple[str, ...]:
    values = curves.mean("relative_meniscus_force", ratio)
    found = curves.critical("relative_meniscus_force", ratio)
    ends = (f"{1e9 * each:.2g}" if np.isfinite(each) else "–" for each in (found.floor, found.ceiling))
    return (part, f"{1e9 * SIGMAS[part]:g}", f"{ratio:g}", f"{values[0]:.4g}", f"{values[-1]:.4g}", *ends)


def _ceilings(curves: Curves) -> Sequence[float]:
    return [1e9 * curves.critical("relative_meniscus_force", ratio).ceiling for ratio in OVERCOATS]


def _stated(found: dict[str, Curves]) -> list[Stated]:
    base = found["b"]
    floors = [1e9 * base.critical("relative_meniscus_force", ratio).floor for ratio in OVERCOATS]
    ceilings = _ceilings(base)
    floor, ceiling = (float(np.exp(np.nanmean(np.log(each)))) for each in (floors, ceilings))
    why = "waves of λ reach λ/2π down, and few are longer than some β* = 500 nm"
    stiff = base.mean("relative_meniscus_force", 10.0)[-1] < base.mean("relative_meniscus_force", 0.75)[-1]
    return [
        Stated(
            "floor of F_m/W at σ = 1 nm: 5 nm", f"{floor:.2g} nm", 5.0 / 3.0 < floor < 15.0, "within a factor of three"
        ),
        Stated("ceiling of F_m/W at σ = 1 nm: about 10⁴ nm", f"{ceiling:.2g} nm", ceiling > 3e3, why),
        Stated("a stiffer overcoat lowers F_m/W", "so" if stiff else "not so", bool(stiff)),
    ]


def _claims(
    found: dict[str, Curves], fed: dict[str, tuple[float, float]], scaled: dict[str, float]
) -> tuple[Claim, ...]:
    answered = min(int(np.isfinite(curves.data["relative_meniscus_force"]).all()) for curves in found.values())
    apart = max(abs(each / scaled["b"] - 1.0) for each in scaled.values())
    claims = [
        Claim("all cases at all roughnesses have an answer without feedback (1)", answered, 1.0, 1.0),
        Claim("σ = 0.1 nm with feedback runs away (1)", float(np.isinf(fed["a"][1])), 1.0, 1.0),
        Claim("σ = 10 nm with feedback over without", fed["c"][1] / fed["c"][0], 1.0, 1.5),
        Claim("F_m/W (σ/1 nm)² at equal X without hardness: largest difference between roughnesses", apart, 0.0, 1e-3),
    ]
    for part, curves in found.items():
        values = [float(curves.mean("relative_meniscus_force", ratio)[-1]) for ratio in hdi.RATIOS]
        fall = min(one / other for one, other in pairwise(values))
        claims.append(Claim(f"fig. 4.3 {part}: least fall of F_m/W with E₁/E₂, endless carbon", fall, 1.0))
        claims.append(
            Claim(f"fig. 4.3 {part}: largest ceiling (nm)", float(np.nanmax(_ceilings(curves))), 50.0, 3000.0)
        )
    return tuple(claims)


WORDS = """* **The force exists.** Without feedback every case has an answer, at σ = 0.1 nm several hundred times
  the load and more: fed back, those run away. That the figure has curves there says that its forces were not
  fed back.
* **Normalisation.** At equal X, with film and menisci scaled by σ, gap and meniscus area are those of one
  normalised contact, and F_m/W = γ(cos θ₁ + cos θ₂)/(h_m pₙ) Aₘ/Aₙ goes as 1/σ²: exact without hardness. Parts
  (a) and (c) are (b) times 100 and 1/100, at 5 and 500 kPa, if they were made so.
* **Ceilings** are where waves of the longest wavelengths with much power end, a few hundred nm at any
  roughness. The printed 10⁴ nm is not found; see also [peng_head_disk](peng_head_disk.md)."""


if __name__ == "__main__":
    write_page(compare(), __file__)
