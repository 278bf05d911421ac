"""Contact area and largest pressure of a rough surface against the thickness of the layer: figs
3.19 and 3.20 of Peng (2001)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from page import Claim, Page, Published, Table, within_scatter, write_page
from peng import BASE, CORRELATION_LENGTH, PIXELS, SIDE, Case, Found, coated, contacts, ensemble, grid, surfaces

import asperity as asp

RATIOS = (0.5, 2.0)
THICKNESSES = (0.001, 0.01, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 100.0)
"""h/β*; the last is 2.5 times the side of the cell."""

PUBLISHED = {0.5: (0.2322 / 0.1215, 0.0066 / 0.0115), 2.0: (0.0631 / 0.1215, 0.0185 / 0.0115)}
"""E1/E2 -> area and largest pressure at h/β* = 2 over those of E1 = E2, from table 3.1."""

RMS = 1e-9
LOAD = 4e-6

ABOUT = (
    "Peng (2001, fig. 3.20): X = pₙβ*/E₂σ = 2·10⁻³, hardness 0.05 E₁. Aᵣ₀ and p₀ are area and largest "
    "pressure of the same surface on the base alone. Ours: mean ± standard deviation over {count} surfaces of "
    "the ratio on each. Published are the limits (with E₁/E₂ = 2 the area is approximately halved, with 0.5 "
    "doubled) and, in table 3.1, the values at h/β* = 2, of one surface."
)


def compare(count: int = 20, thicknesses: Sequence[float] = THICKNESSES) -> Page:
    """Ours on ``count`` surfaces for every thickness, which includes 2 and ends with one far beyond
    the cell."""
    shapes = surfaces(count, grid())
    bare = ensemble(contacts(Case(1.0, LOAD, RMS), shapes))
    tables: list[Table] = []
    claims: list[Claim] = []
    laws: list[Published] = []
    for ratio in RATIOS:
        case = Case(ratio, LOAD, RMS)
        found = [ensemble(contacts(case, shapes, body=coated(ratio, h * CORRELATION_LENGTH))) for h in thicknesses]
        only_layer = asp.Layered([], asp.Elastic(ratio * BASE.youngs_modulus, BASE.poisson_ratio))
        limit = ensemble(contacts(case, shapes, body=only_layer))
        tables.append(_table(ratio, thicknesses, found, bare))
        claims += _claims(ratio, thicknesses, found, bare, limit)
        laws += _published(ratio, _ratios(found[thicknesses.index(2.0)], bare))
    about = ABOUT.format(count=count)
    return Page("Effect of the layer on rough contact", about, (*tables, WORDS), tuple(claims), tuple(laws))


def _published(ratio: float, found: tuple[np.ndarray, np.ndarray]) -> Iterator[Published]:
    """The printed law that the area is inversely and the largest pressure directly proportional to
    E₁/E₂, at h/β* = 2."""
    source, reason = "Peng 2001, sec. 3.2.6.1", "the printed rows give 0.574 and 1.609 themselves"
    area, peak = found
    for what, theirs, ours, why in (("Aᵣ/Aᵣ₀", 1.0 / ratio, area, ""), ("pₘₐₓ/p₀", ratio, peak, reason)):
        spread = float(ours.std(ddof=1))
        text = f"{what} by the law, E₁/E₂ = {ratio:g}"
        yield Published(source, text, f"{theirs:.1f}", float(ours.mean()), spread=spread, reason=why)


def _ratios(found: Found, bare: Found) -> tuple[np.ndarray, np.ndarray]:
    """Area and largest pressure over those of the base, by surface."""
    return found.pixels / bare.pixels, found.peak / bare.peak


def _table(ratio: float, thicknesses: Sequence[float], found: Sequence[Found], bare: Found) -> Table:
    rows = []
    for thickness, one in zip(thicknesses, found, strict=True):
        area, peak = _ratios(one, bare)
        theirs = PUBLISHED[ratio] if thickness == 2.0 else None
        numbers = [f"{values.mean():.3f} ± {values.std(ddof=1):.3f}" for values in (area, peak)]
        published = [f"{value:.3f}" for value in theirs] if theirs else ["", ""]
        rows.append((f"{thickness:g}", numbers[0], published[0], numbers[1], published[1]))
    head = ("h/β*", "Aᵣ/Aᵣ₀: ours", "theirs", "pₘₐₓ/p₀: ours", "theirs")
    return Table(f"E₁/E₂ = {ratio:g}:", head, tuple(rows))


WORDS = f"""* The limits are those of elasticity: the base for h → 0 and the material of the layer for h → ∞.
  (Sec. 3.2.6.2 states the reverse, a slip.)
* Nearly all of the change happens between 0.01 and 1 β*: contacts are about as wide as a pixel,
  {SIDE / PIXELS * 1e9:.0f} nm or 0.16 β*. At the h/β* = 2 of table 3.1 the layer is all but infinitely
  thick."""


def _claims(
    ratio: float, thicknesses: Sequence[float], found: Sequence[Found], bare: Found, limit: Found
) -> tuple[Claim, ...]:
    name = f"E₁/E₂ = {ratio:g}"
    areas = np.array([_ratios(one, bare)[0].mean() for one in found])
    peaks = np.array([_ratios(one, bare)[1].mean() for one in found])
    at_two = _ratios(found[thicknesses.index(2.0)], bare)
    soft = ratio < 1.0
    steps = np.diff(areas) if soft else -np.diff(areas)
    return (
        Claim(
            f"{name}: area under the thickest layer over that of the base",
            float(areas[-1]),
            *((1.8, 2.1) if soft else (0.45, 0.6)),
        ),
        Claim(
            f"{name}: largest pressure under the thickest layer over that of the base",
            float(peaks[-1]),
            *((0.5, 0.7) if soft else (1.5, 2.0)),
        ),
        within_scatter(f"{name}: their area at h/β* = 2", PUBLISHED[ratio][0], at_two[0]),
        within_scatter(f"{name}: their pressure at h/β* = 2", PUBLISHED[ratio][1], at_two[1]),
        Claim(
            f"{name}: smallest step of the area from one thickness to the next, in the direction of the limit",
            float(steps.min()),
            -0.01,
        ),
        Claim(
            f"{name}: contact pixels under the thickest layer that a half-space of its material has not",
            float(np.abs(found[-1].pixels - limit.pixels).max()),
            0,
            0,
        ),
        Claim(f"{name}: change of the area by the thinnest layer", float(abs(areas[0] - 1.0)), 0, 0.02),
    )


if __name__ == "__main__":
    write_page(compare(), __file__)
