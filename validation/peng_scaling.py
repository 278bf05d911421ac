"""Scaling laws of section 3.2.6.1 of Peng (2001): which are exact, and how good the fitted ones
are."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from page import Claim, Page, Published, Table, within_scatter, write_page
from peng import BASE, CORRELATION_LENGTH, PIXELS, SIDE, THICKNESS, Case, contacts, grid, surfaces
from peng_table_3_1 import PUBLISHED, ROUNDING

import asperity as asp

RMS = 1e-9
LOAD = 4e-6
FRICTION = 0.3
CAP = 0.01
"""Hardness over E2 of the surface on which the exact laws are tried, so low that part of the
contact is plastic."""

DEPTHS = (0.0, 0.05, 0.2, 1.0, 2.0)
"""Depths over h, the interface among them."""

VALUES = (2e-4, 5e-4, 1e-3, 2e-3, 4e-3)
"""X of the fitted laws, the range of table 3.1."""

FEWEST = 20
"""Contact pixels a row of table 3.1 must have."""

COMMON = (1e-3, 2e-3, 4e-3)
"""X at which table 3.1 has that many; exponents and coefficients are compared here."""

RATIOS = (0.5, 1.0, 2.0)

FOUND = "printed as found by trial and error; that of the rows of table 3.1 is 0.245"

EXACT = 1e-7
"""Bound of the deviation from an exact law: the solves take the same steps up to rounding, so they
agree far better than any of them is solved (1e-10 of the energy)."""

ABOUT = (
    "Peng (2001, sec. 3.2.6.1; also Peng & Bhushan 2002). With X = pₙβ*/E₂σ the laws that follow from linear "
    "elasticity alone are Aᵣ/Aₙ = f(X), pₘₐₓβ*/E₂σ = g(X) and the same for every stress, at given h/β*, "
    "E₁/E₂, ν and shape of the surface. The fitted ones are Aᵣ/Aₙ ∝ X, pₘₐₓ and all stresses ∝ X^(1/3), Aᵣ ∝ "
    "E₂/E₁, pₘₐₓ ∝ E₁/E₂."
)


@dataclass(frozen=True)
class Factors:
    """What everything is multiplied with: moduli, lengths along the surface and into it,
    heights."""

    modulus: float = 1.0
    length: float = 1.0
    height: float = 1.0

    @property
    def stress(self) -> float:
        """Factor of pressures and stresses at the same X."""
        return self.modulus * self.height / self.length


TRIALS = (
    ("σ and pₙ × 0.1 (fig. 3.16)", Factors(height=0.1)),
    ("σ, β*, h and the cell × 2 (fig. 3.17)", Factors(length=2.0, height=2.0)),
    ("E₁, E₂, Hₛ and pₙ × 3", Factors(modulus=3.0)),
    ("E × 1.7, lengths × 3.1, heights × 0.37, pₙ and Hₛ × 0.2029", Factors(1.7, 3.1, 0.37)),
)


@dataclass(frozen=True, eq=False)
class Curve:
    """Area fraction, largest pressure and largest √J2 over E2σ/β* for one E1/E2, arrays (surfaces,
    X)."""

    ratio: float
    x: np.ndarray
    area: np.ndarray
    peak: np.ndarray
    root: np.ndarray

    def at_common(self, name: str) -> np.ndarray:
        """Values at the X of ``COMMON``, (surfaces, 3); rows of table 3.1 with equal X are
        averaged."""
        values = getattr(self, name)
        return np.stack([values[:, np.isclose(self.x, x)].mean(axis=1) for x in COMMON], axis=1)

    def exponents(self, name: str) -> np.ndarray:
        """Power of X in a quantity, by surface."""
        slopes: np.ndarray = np.polyfit(np.log(COMMON), np.log(self.at_common(name)).T, 1)[0]
        return slopes

    @property
    def coefficients(self) -> np.ndarray:
        """Mean of A_r/A_nX, by surface."""
        means: np.ndarray = (self.at_common("area") / np.array(COMMON)).mean(axis=1)
        return means


def compare(count: int = 30, stressed: int = 6, pixels: int = PIXELS) -> Page:
    """Exact laws on a surface of ``pixels`` a side; fitted ones on ``count`` surfaces, stresses on
    the first ``stressed``."""
    exact, exact_claims = _exact(pixels)
    curves = [curve(ratio, count, stressed) for ratio in RATIOS]
    theirs = [published(ratio) for ratio in RATIOS]
    parts = (exact, _fitted(curves), _exponents(curves, theirs), _words(curves, theirs, count, stressed))
    claims, laws = (*exact_claims, *_claims(curves, theirs)), _published(curves[RATIOS.index(1.0)])
    return Page("Scaling laws of coated rough surfaces", ABOUT, parts, claims, laws)


def _published(curve: Curve) -> tuple[Published, ...]:
    """The powers of X that the fitted laws print, of the body without a layer."""
    quantities = (
        ("area", "Aᵣ/Aₙ", "1", ""),
        ("peak", "pₘₐₓ", "0.3333", FOUND),
        ("root", "largest √J2", "0.3333", FOUND),
    )
    return tuple(
        Published(
            "Peng 2001, sec. 3.2.6.1",
            f"power of X in {quantity}, E₁ = E₂",
            theirs,
            float(curve.exponents(name).mean()),
            spread=float(curve.exponents(name).std(ddof=1)),
            reason=reason,
        )
        for name, quantity, theirs, reason in quantities
    )


def _exact(pixels: int) -> tuple[Table, tuple[Claim, ...]]:
    contact, field = _scaled(Factors(), pixels)
    rows, worst = [], np.zeros(3)
    for name, factors in TRIALS:
        other, stresses = _scaled(factors, pixels)
        pressure = np.abs(other.pressure / factors.stress - contact.pressure).max() / contact.max_pressure
        deviation = max(
            float(np.abs(getattr(stresses.tensor, part) / factors.stress - getattr(field.tensor, part)).max())
            for part in ("xx", "yy", "zz", "xy", "xz", "yz")
        )
        numbers = (other.contact != contact.contact).sum(), pressure, deviation / field.sqrt_J2.max()
        rows.append((name, f"{numbers[0]}", *(f"{number:.1e}" for number in numbers[1:])))
        worst = np.maximum(worst, numbers)
    about = (
        f"Exact laws. One surface with E₁/E₂ = 2, X = 2·10⁻³, a hardness that {contact.plastic.sum()} of "
        f"{contact.contact.sum()} contact pixels reach, and friction {FRICTION:g}; all six stresses on planes "
        "at 0, 0.05, 0.2, 1 (both sides of the interface) and 2 h. Deviation from the law, over the largest "
        "pressure and the largest √J2:"
    )
    head = ("scaled", "pixels that differ", "pressure", "stresses")
    claims = (
        Claim("exact laws: contact pixels that differ", float(worst[0]), 0, 0),
        Claim("exact laws: largest deviation of the pressure", float(worst[1]), 0, EXACT),
        Claim("exact laws: largest deviation of a stress", float(worst[2]), 0, EXACT),
        Claim("exact laws: plastic share of the contact", contact.plastic_area_fraction, 0.05, 0.95),
    )
    return Table(about, head, tuple(rows)), claims


def _scaled(factors: Factors, pixels: int) -> tuple[asp.ContactResult, asp.stresses.StressField]:
    heights = factors.height * RMS * surfaces(1, grid(pixels))[0].heights
    cell = grid(pixels, factors.length * SIDE)
    modulus, thickness = factors.modulus * BASE.youngs_modulus, factors.length * THICKNESS
    layer = asp.Layer(asp.Elastic(2.0 * modulus, BASE.poisson_ratio), thickness)
    law = asp.Hardness(factors.stress * CAP * BASE.youngs_modulus)
    body = asp.Layered([layer], asp.Elastic(modulus, BASE.poisson_ratio))
    problem = asp.ContactProblem(asp.Surface(heights, *cell.spacing, periodic=True), body, law=law)
    load = asp.MeanPressure(factors.stress * LOAD * BASE.youngs_modulus)
    contact = asp.solve(problem, load, solver=asp.solvers.ActiveSet(tolerance=1e-10), keep=asp.Keep(stiffness=False))
    return contact, asp.stress(contact, np.array(DEPTHS) * thickness, friction=FRICTION)


def curve(ratio: float, count: int, stressed: int, values: Sequence[float] = VALUES) -> Curve:
    """Ours on ``count`` surfaces at the X of ``values``, stresses on the first ``stressed``."""
    shapes = surfaces(count, grid())
    unit = BASE.youngs_modulus * RMS / CORRELATION_LENGTH
    area, peak, root = [], [], []
    for x in values:
        case = Case(ratio, x * RMS / CORRELATION_LENGTH, RMS)
        found = list(contacts(case, shapes, capped=False))
        area.append([one.area_fraction for one in found])
        peak.append([one.max_pressure / unit for one in found])
        root.append([_largest_root(one) / unit for one in found[:stressed]])
    return Curve(ratio, np.array(values), np.array(area).T, np.array(peak).T, np.array(root).T)


def _largest_root(result: asp.ContactResult) -> float:
    """Largest √J2 on planes down to one pixel, about the width of a contact."""
    depths = np.array((0.0, 0.1, 0.2, 0.35, 0.5, 1.0)) * result.problem.grid.spacing[0]
    return max(float(field.sqrt_J2.max()) for field in asp.stresses.stress_planes(result, depths))


def published(ratio: float, fewest: int = FEWEST) -> Curve:
    """The rows of table 3.1 below the hardness with ``fewest`` pixels or more; no √J2."""
    rows = [
        (load * CORRELATION_LENGTH / (rms * 1e-9), area / 100.0, peak * CORRELATION_LENGTH / (rms * 1e-9))
        for found, load, rms, area, peak in PUBLISHED
        if found == ratio and peak < 0.05 * ratio - ROUNDING and round(area / 100.0 * PIXELS**2) >= fewest
    ]
    x, area, peak = np.array(sorted(rows)).T
    return Curve(ratio, x, area[None], peak[None], np.full((1, x.size), np.nan))


def _fitted(curves: Iterable[Curve]) -> Table:
    rows = []
    for curve in curves:
        for x, area, peak, root in zip(
            curve.x, curve.area.mean(axis=0), curve.peak.mean(axis=0), curve.root.mean(axis=0), strict=True
        ):
            numbers = (area / x, x / area, peak / x ** (1.0 / 3.0), root / x ** (1.0 / 3.0))
            rows.append((f"{curve.ratio:g}", f"{x:.0e}", *(f"{number:.2f}" for number in numbers)))
    head = ("E₁/E₂", "X", "Aᵣ/AₙX", "pᵣβ*/E₂σ", "pₘₐₓβ*/E₂σX^(1/3)", "√J2ₘₐₓβ*/E₂σX^(1/3)")
    about = "Fitted laws, ours: by them each column would be constant for given E₁/E₂ (pᵣ mean real pressure):"
    return Table(about, head, tuple(rows))


def _spread(values: np.ndarray) -> str:
    return f"{values.mean():.3f} ± {values.std(ddof=1):.3f}"


def _exponents(curves: Sequence[Curve], theirs: Sequence[Curve]) -> Table:
    rows = []
    for our, their in zip(curves, theirs, strict=True):
        row = [f"{our.ratio:g}"]
        for name in ("area", "peak"):
            row += [_spread(our.exponents(name)), f"{their.exponents(name)[0]:.3f}"]
        row += [_spread(our.exponents("root")), _spread(our.coefficients), f"{their.coefficients[0]:.3f}"]
        rows.append(tuple(row))
    head = ("E₁/E₂", "area: ours", "theirs", "pₘₐₓ: ours", "theirs", "√J2ₘₐₓ: ours", "mean Aᵣ/AₙX: ours", "theirs")
    about = (
        f"Exponents of X from 10⁻³ to 4·10⁻³, where the table has {FEWEST} pixels or more: ours as mean ± "
        "standard deviation over the surfaces, theirs from his rows below the hardness. The laws say 1 for "
        "the area and 1/3 for the stresses:"
    )
    return Table(about, head, tuple(rows))


def _of_ratio(curves: Sequence[Curve], name: str) -> np.ndarray:
    """Power of E1/E2 in a quantity at X = 2e-3, by surface."""
    values = np.array([curve.at_common(name)[:, 1] for curve in curves])
    slopes: np.ndarray = np.polyfit(np.log([curve.ratio for curve in curves]), np.log(values), 1)[0]
    return slopes


def _words(curves: Sequence[Curve], theirs: Sequence[Curve], count: int, stressed: int) -> str:
    return f"""Ours are {count} surfaces (stresses: {stressed}), without hardness.

* The area is nearly proportional to X. At small X there are few contact pixels, and the highest summit of a
  finite surface has an influence.
* The largest pressure and √J2 have the same exponent, which is below 1/3, in his results as in ours.
* At X = 2·10⁻³ the area goes as E₁/E₂ to the power {_spread(_of_ratio(curves, "area"))} (theirs
  {_of_ratio(theirs, "area")[0]:.2f}), and pₘₐₓ to {_spread(_of_ratio(curves, "peak"))} (theirs
  {_of_ratio(theirs, "peak")[0]:.2f}), where the laws say −1 and 1. The second is at odds with the others:
  contacts of one pixel are governed by the layer alone, for which X and the unit of stress contain E₁, so
  that pₘₐₓ ∝ X^m at given E₁/E₂ entails pₘₐₓ ∝ (E₁/E₂)^(1−m), the power found.
* The coefficient Aᵣ/AₙX holds for his pixel size of 78 nm (see [peng_table_3_1](peng_table_3_1.md))."""


def _claims(curves: Sequence[Curve], theirs: Sequence[Curve]) -> tuple[Claim, ...]:
    claims = []
    for our, their in zip(curves, theirs, strict=True):
        name = f"E₁/E₂ = {our.ratio:g}"
        area = our.exponents("area")
        uncertain = 2.0 * float(area.std(ddof=1)) / len(area) ** 0.5
        cube = our.peak.mean(axis=0) / our.x ** (1.0 / 3.0)
        claims += [
            Claim(f"{name}: exponent of the area", float(area.mean()), 0.9 - uncertain, 1.0 + uncertain),
            within_scatter(f"{name}: their exponent of the area", float(their.exponents("area")[0]), area),
            within_scatter(f"{name}: their exponent of pₘₐₓ", float(their.exponents("peak")[0]), our.exponents("peak")),
            within_scatter(f"{name}: their Aᵣ/AₙX", float(their.coefficients[0]), our.coefficients),
            Claim(f"{name}: largest over smallest pₘₐₓ/X^(1/3)", float(cube.max() / cube.min()), 1.0, 1.5),
            Claim(
                f"{name}: exponent of √J2 less that of pₘₐₓ on the same surfaces",
                float((our.exponents("root") - our.exponents("peak")[: len(our.root)]).mean()),
                -0.05,
                0.05,
            ),
        ]
    claims += [
        within_scatter(
            "their power of E₁/E₂ in the area", float(_of_ratio(theirs, "area")[0]), _of_ratio(curves, "area")
        ),
        within_scatter("their power of E₁/E₂ in pₘₐₓ", float(_of_ratio(theirs, "peak")[0]), _of_ratio(curves, "peak")),
    ]
    return tuple(claims)


if __name__ == "__main__":
    write_page(compare(), __file__)
