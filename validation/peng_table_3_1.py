"""Table 3.1 of Peng (2001): contact area and largest pressure of rough surfaces on a coated
half-space, 34 cases.

His numbers come from one generated surface, ours from many of the same statistics.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from page import Claim, Page, Table, write_page
from peng import PIXELS, Case, Found, coated, contacts, ensemble, grid, surfaces

import asperity as asp

PUBLISHED = (
    (0.5, 4e-7, 0.1, 0.2261, 0.0007),
    (0.5, 4e-7, 1.0, 0.0246, 0.0039),
    (0.5, 4e-7, 10.0, 0.0046, 0.0227),
    (0.5, 2e-6, 0.5, 0.2322, 0.0033),
    (0.5, 2e-6, 2.0, 0.0615, 0.0095),
    (0.5, 4e-6, 0.5, 0.4813, 0.0036),
    (0.5, 4e-6, 1.0, 0.2322, 0.0066),
    (0.5, 4e-6, 2.0, 0.1230, 0.0115),
    (0.5, 4e-6, 10.0, 0.0246, 0.0250),
    (0.5, 1e-5, 10.0, 0.0708, 0.0250),
    (0.5, 4e-5, 10.0, 0.2753, 0.0250),
    (1.0, 4e-7, 0.1, 0.1215, 0.0012),
    (1.0, 4e-7, 1.0, 0.0200, 0.0065),
    (1.0, 4e-7, 10.0, 0.0015, 0.0260),
    (1.0, 1e-6, 10.0, 0.0077, 0.0490),
    (1.0, 2e-6, 0.5, 0.1215, 0.0058),
    (1.0, 2e-6, 2.0, 0.0292, 0.0163),
    (1.0, 4e-6, 0.5, 0.2338, 0.0066),
    (1.0, 4e-6, 1.0, 0.1215, 0.0115),
    (1.0, 4e-6, 2.0, 0.0584, 0.0188),
    (1.0, 4e-6, 10.0, 0.0200, 0.0500),
    (1.0, 1e-5, 10.0, 0.0308, 0.0500),
    (2.0, 4e-7, 0.1, 0.0631, 0.0019),
    (2.0, 4e-7, 1.0, 0.0108, 0.0111),
    (2.0, 4e-7, 10.0, 0.0015, 0.0260),
    (2.0, 1e-6, 10.0, 0.0015, 0.0650),
    (2.0, 2e-6, 0.5, 0.0631, 0.0093),
    (2.0, 2e-6, 2.0, 0.0215, 0.0272),
    (2.0, 2e-6, 10.0, 0.0062, 0.0977),
    (2.0, 4e-6, 0.5, 0.1277, 0.0116),
    (2.0, 4e-6, 1.0, 0.0631, 0.0185),
    (2.0, 4e-6, 2.0, 0.0308, 0.0323),
    (2.0, 4e-6, 10.0, 0.0108, 0.1000),
    (2.0, 4e-5, 10.0, 0.0708, 0.1000),
)
"""E1/E2, p_n/E2, σ (nm), A_r/A_n (%), p_max/E2 as printed."""

ROUNDING = 5e-5
"""Half a unit of the last printed digit of the area in per cent and of p_max/E2."""

MANY = 30
"""Contact pixels from which on an area is more than a few pixels."""

ABOUT = (
    "Peng (2001, table 3.1; also Peng & Bhushan 2001a, 2002): a rigid rough surface on one layer, β* = 0.5 µm "
    "(10 % length of an exponential autocorrelation), h = 1 µm, E₂ = 100 GPa, pressure limited by the "
    "hardness 0.05 E₁. Theirs: one surface, quasi-Newton minimisation. Ours: mean ± standard deviation over "
    "{count} Gaussian surfaces (seeds 0 to {last}), `asperity.solve` with `Hardness(0.05 E₁)`. z is (theirs − "
    "mean)/standard deviation."
)

ASSUMPTIONS = f"""## Assumptions

* Poisson's ratio 0.3 in layer and base, frictionless, rigid counter body.
* {PIXELS} × {PIXELS} points on 20 × 20 µm²: all 34 printed areas are whole multiples of 1/{PIXELS}², though
  the text says 256.
* Periodic boundary, pressure and displacement trigonometric (`Periodic()`): his influence coefficients come
  from an inverse discrete Fourier transform of the response to a load on one patch, which is the same
  discretisation but for the wavevectors next to zero.
* Surfaces periodic, autocovariance exact at every lag, σ that of the ensemble; his digital filter (Hu &
  Tønder 1992) has the same expectation.

The last table below shows what other choices change: less than the scatter, except for the size of the pixel.
An exponential autocorrelation has no finest wavelength, its slopes grow without limit as pixels shrink, and
with them all values of the table; they hold for pixels of 78 nm."""


@dataclass(frozen=True, eq=False)
class Row:
    """One row: the published numbers beside the ensemble."""

    case: Case
    area: float
    peak: float
    found: Found

    @property
    def areas(self) -> np.ndarray:
        """Ours in per cent."""
        return 100.0 * self.found.pixels / PIXELS**2

    @property
    def published_pixels(self) -> int:
        """Contact pixels of the published surface."""
        return round(self.area / 100.0 * PIXELS**2)

    @property
    def at_cap(self) -> bool:
        """Whether the published pressure reaches the hardness."""
        return self.peak >= self.case.cap - ROUNDING

    @property
    def scores(self) -> tuple[float, float]:
        """z of the area and of the pressure."""
        return score(self.area, self.areas), score(self.peak, self.found.peak)

    @property
    def within(self) -> tuple[bool, bool]:
        """Whether area and pressure lie within two standard deviations of the mean."""
        return abs(self.scores[0]) <= 2.0, abs(self.scores[1]) <= 2.0


def score(published: float, values: np.ndarray) -> float:
    """Distance of a published number from the mean in standard deviations; zero where rounding
    explains it."""
    distance = published - float(values.mean())
    spread = float(values.std(ddof=1))
    if abs(distance) <= ROUNDING or spread == 0.0:
        return 0.0 if abs(distance) <= ROUNDING else np.copysign(np.inf, distance)
    return distance / spread


def compare(count: int = 40, published: Sequence[tuple[float, ...]] = PUBLISHED, *, variants: bool = True) -> Page:
    """Ours on ``count`` surfaces for every row of ``published``."""
    shapes = surfaces(count, grid())
    rows = []
    for ratio, load, nanometres, area, peak in published:
        case = Case(ratio, load, nanometres * 1e-9)
        rows.append(Row(case, area, peak, ensemble(contacts(case, shapes))))
    parts: list[str | Table] = [_main_table(rows), _reading(rows), _capped(rows, shapes), ASSUMPTIONS]
    if variants:
        parts.append(_variants(count // 2))
    about = ABOUT.format(count=count, last=count - 1)
    return Page("Contact area and largest pressure of coated rough surfaces", about, tuple(parts), _claims(rows))


def _main_table(rows: list[Row]) -> Table:
    head = ("E₁/E₂", "pₙ/E₂", "σ (nm)", "Aᵣ/Aₙ (%): ours", "theirs", "z", "pₘₐₓ/E₂: ours", "theirs", "z", "within 2 sd")
    lines = []
    for row in rows:
        z_area, z_peak = row.scores
        area, peak = row.areas, row.found.peak
        lines.append(
            (
                f"{row.case.ratio:g}",
                f"{row.case.load:g}",
                f"{row.case.rms * 1e9:g}",
                f"{area.mean():.4f} ± {area.std(ddof=1):.4f}",
                f"{row.area:.4f}",
                f"{z_area:+.1f}",
                f"{peak.mean():.5f} ± {peak.std(ddof=1):.5f}",
                f"{row.peak:.4f}",
                f"{z_peak:+.1f}",
                " and ".join(name for name, inside in zip(("area", "pressure"), row.within, strict=True) if inside)
                or "none",
            )
        )
    return Table("", head, tuple(lines))


def _elastic(rows: list[Row]) -> list[Row]:
    """Rows below the hardness and with many contact pixels."""
    return [row for row in rows if not row.at_cap and row.published_pixels >= MANY]


def _claims(rows: list[Row]) -> tuple[Claim, ...]:
    elastic = _elastic(rows)
    ratio = float(np.mean([row.area / row.areas.mean() for row in elastic]))
    common = float(np.mean([row.scores[1] for row in elastic]))
    return (
        Claim(
            "rows whose area lies within two standard deviations", sum(r.within[0] for r in rows), len(rows), len(rows)
        ),
        Claim("rows whose largest pressure does", sum(r.within[1] for r in rows), len(rows), len(rows)),
        Claim(f"area, theirs over ours, mean of the elastic rows of {MANY} pixels or more", ratio, 0.95, 1.05),
        Claim("mean z of the largest pressure in these rows", common, -2.0, 2.0),
        Claim(
            "largest of our pressures over the hardness",
            max(float((r.found.peak / r.case.cap).max()) for r in rows),
            0,
            1,
        ),
    )


def _reading(rows: list[Row]) -> str:
    """What the deviations say, in numbers."""
    elastic = _elastic(rows)
    count = rows[0].found.peak.size
    marks = np.array([(r.found.peak - r.found.peak.mean()) / r.found.peak.std(ddof=1) for r in elastic])
    theirs = float(np.mean([row.scores[1] for row in elastic]))
    blunter = int((marks.mean(axis=0) < theirs).sum())
    alike = float(np.corrcoef(marks)[np.triu_indices(len(elastic), 1)].mean())
    return f"""## Reading the table

* **One surface.** Rows of equal E₁/E₂ and X = pₙβ*/E₂σ have the same contact pixels (79 in three rows of
  E₁/E₂ = 1, 41 in three of E₁/E₂ = 2), so all of his rows are from one surface and their deviations are
  correlated. On ours the largest pressures of the {len(elastic)} elastic rows of {MANY} pixels or more have a
  mean correlation of {alike:.2f}: they are hardly more than one independent number. His surface is one whose
  highest summits are somewhat blunter than most (mean z = {theirs:.1f}; {blunter} of our {count} are blunter
  still), which is why his pressures lie on one side in all of these rows. That all values are within two
  standard deviations therefore amounts to a few independent checks, not {2 * len(rows)}.
* **His accuracy.** The three rows of X = 2·10⁻³ and E₁/E₂ = 0.5 must have the same pixels, too, but have 147,
  151 and 151: 3 %.
* **Few pixels.** One pixel is 0.0015 %. The rows of one pixel carry {PIXELS}² pₙ there, whatever the surface:
  0.02601 and 0.06503 against the printed 0.0260 and 0.0650."""


def _capped(rows: list[Row], shapes: list[asp.Surface]) -> Table:
    """Contact pixels where the hardness is reached, with and without it."""
    lines = []
    for row in (row for row in rows if row.at_cap):
        elastic = ensemble(contacts(row.case, shapes, capped=False)).pixels
        numbers = (f"{row.published_pixels}", f"{row.found.pixels.mean():.1f}", f"{elastic.mean():.1f}")
        lines.append((f"{row.case.ratio:g}", f"{row.case.x:.0e}", *numbers))
    about = (
        "Contact pixels of the rows at the hardness. Limiting the pressure enlarges the contact. In his rows "
        "of X = 2·10⁻⁴ it does not: they have 16, 13 and 7 pixels, as the elastic rows of the same X, and the "
        "16 is farthest of all from our mean."
    )
    head = ("E₁/E₂", "X", "printed, in pixels", "our pixels", "without hardness")
    return Table(about, head, tuple(lines))


def _variants(count: int) -> Table:
    case = Case(1.0, 4e-6, 1e-9)
    body = coated(1.0)
    spectrum = asp.generate.ExponentialAutocorrelation(1.0, 0.5e-6)
    windows = [asp.generate.gaussian(grid(), spectrum, seed=seed, periodic=False) for seed in range(count)]
    rescaled = [asp.generate.gaussian(grid(), spectrum, seed=seed, exact_rms=True) for seed in range(count)]
    standard = surfaces(count, grid())
    found = {
        "as above": ensemble(contacts(case, standard)),
        "256 × 256 points": ensemble(contacts(case, surfaces(count, grid(256)))),
        "every surface rescaled to σ": ensemble(contacts(case, rescaled)),
        "windows of larger surfaces, periodic boundary": ensemble(contacts(case, windows)),
        "the same, free boundary, constant pressure on pixels": ensemble(
            contacts(case, windows, body=body, boundary=asp.Free())
        ),
        "Poisson's ratio 0.25": ensemble(contacts(case, standard, body=coated(1.0, poisson=0.25))),
        "pixels of twice the side (127 × 127)": ensemble(contacts(case, surfaces(count, grid(127)))),
        "pixels of half the side (510 × 510)": ensemble(contacts(case, surfaces(count, grid(510)))),
    }
    sizes = {
        "256 × 256 points": 256,
        "pixels of twice the side (127 × 127)": 127,
        "pixels of half the side (510 × 510)": 510,
    }
    rows = []
    for name, values in found.items():
        areas = 100.0 * values.pixels / sizes.get(name, PIXELS) ** 2
        rows.append(
            (
                name,
                f"{areas.mean():.4f} ± {areas.std(ddof=1):.4f}",
                f"{values.peak.mean():.4f} ± {values.peak.std(ddof=1):.4f}",
            )
        )
    about = (
        f"Other choices for the row E₁/E₂ = 1, pₙ/E₂ = 4·10⁻⁶, σ = 1 nm (published: 0.1215 %, 0.0115), mean ± standard "
        f"deviation over {count} surfaces:"
    )
    return Table(about, ("choice", "Aᵣ/Aₙ (%)", "pₘₐₓ/E₂"), tuple(rows))


if __name__ == "__main__":
    write_page(compare(), __file__)
