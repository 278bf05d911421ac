"""Statistical contact: table 1, fig. 13, exponential heights, limits of the plasticity indices and
skewed summits of Bhushan (1998)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from page import Claim, Page, Published, Table, write_page

from asperity.theories import GaussianHeights, KotwalBhushan
from asperity.theories.rough import profile_peaks
from asperity.theories.rough.greenwood_williamson import (
    NOTICEABLE,
    FittedLaws,
    plastic_area_share,
    separation_at_plastic_onset,
)
from asperity.theories.wet.summits import StatisticalMeniscus

FITTED = (1e-6, 0.1)
"""P_a between which our laws are fitted; theirs is not stated."""


@dataclass(frozen=True)
class Law:
    """Published fit of a quantity: ``factor`` · P_a^``power``, and the linear approximation's
    ``factor``."""

    name: str
    factor: float
    power: float
    linear: float
    order: int
    """Power of P_a in the linear approximation."""


LAWS = (
    Law("pᵣ/[E*(σₚ/Rₚ)^½]", 0.42, 0.04, 0.32, 0),
    Law("Aᵣ/(Aₐ η Rₚ σₚ)", 2.40, 0.96, 3.20, 1),
    Law("n/(η Aₐ)", 1.21, 0.88, 2.64, 1),
    Law("(Aᵣ/n)/(Rₚ σₚ)", 2.00, 0.08, 1.21, 0),
)

SKEWNESS = (-0.5, 0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0)
KURTOSIS = (3.0, 4.0, 5.0, 7.0, 10.0)
SUMMITS = (100e9, 1e10, 10e-6, 4e-9)
"""E* (Pa), density (1/m²), radius and standard deviation of the heights (m), as on the page on
summits in a film."""

LOADS = (1e-4, 1e-3, 1e-2)
"""P_a at which the linear approximations are compared."""

PRESSURES = (10e3, 100e3, 1e6)
FILMS = (1e-9, 4e-9)

ABOUT = (
    "Bhushan (1998): the fits of table 1 for Gaussian summits, the elastic and plastic areas of fig. 13, and "
    "the statement on the theory of Kotwal & Bhushan (1996), that a skewness of 0.3 to 0.7 with a large "
    "kurtosis lowers area and meniscus force. Theirs: printed numbers. Ours: the integrals themselves, to 11 "
    "digits. The interval of their fits is not stated; ours are least squares of logarithms on {low:g} < Pₐ < "
    "{high:g}, chosen freely. Skewed summits: E* = 100 GPa, η = 0.01/µm², R = 10 µm, σₚ = 4 nm, water, γ = 73 "
    "mN/m, θ = 60°; also chosen freely, as the review states none."
)

WORDS = """* The printed powers are those of the integrals within 0.01, and the printed laws follow the
  integrals within a fifth: area and real pressure within 6 %, number and area of the contacts within 20 %,
  where the number is too small by that much at the light end. The separation is within 0.16 standard
  deviations, and within 0.03 below Pₐ = 0.001.
* The approximations that are proportional to the load are exact somewhere between Pₐ = 0.002 and 0.012; at
  0.001 the printed number of contacts is a quarter too small.
* Where the printed approximations meet the printed fits, near Pₐ = 0.001, those of pressure and area are the
  integrals within 5 %; that of the number is a fifth too small and that of the area of a contact a fifth too
  large. The constants for exponential heights are exact.
* Of Greenwood and Williamson's summits 2 % of the area flow at ψ = 0.6 under the heaviest load of table 1
  (D = 0), which is the printed limit of elastic contact; at ψ = 1 they do at {light:.0e} of that load. Onions
  and Archard's 0.45 is on the safe side of the same criterion, and so is their 0.25.
* At light load the area has a minimum at a skewness of 0.4 to 0.6 for a kurtosis of 3 and 4 and the meniscus
  force at 0.5 to 0.6, which is the published interval; with a kurtosis of 5 the minima lie at 0.6 and 0.7 to
  0.8, and with a larger kurtosis they move beyond 0.7. Under larger loads they vanish: area and force fall
  with the skewness up to the largest that we computed.
* A kurtosis above 5 lowers the meniscus force at light load severalfold, and with it a force that grows with
  the film less."""


def compare(pressures: Sequence[float] = PRESSURES) -> Page:
    """Ours beside theirs; skewed summits at ``pressures`` in Pa, of which the first is the light
    one."""
    curves = _integrals()
    fits = {law.name: _fit(curves["P"], curves[law.name]) for law in LAWS}
    skewed = {(p, K): _skewed(p, K) for p in pressures for K in KURTOSIS}
    parts = (
        _laws(curves, fits),
        _linear(curves),
        _separation(curves),
        _index(curves),
        *(_shapes(skewed, pressure) for pressure in pressures),
        WORDS.format(light=_light_load(1.0)),
    )
    about = ABOUT.format(low=FITTED[0], high=FITTED[1])
    return Page(
        "Statistical contact: fits, areas, skewed summits",
        about,
        parts,
        _claims(curves, fits, skewed),
        _published(curves, fits),
    )


def _integrals() -> dict[str, np.ndarray]:
    """The quantities of table 1 over the separations D, from the moments of the Gaussian tail (eqs
    12 to 18)."""
    D = np.linspace(0.0, 5.5, 221)
    F0, F1, F32 = (np.asarray(GaussianHeights().tail_moment(D, order)) for order in (0.0, 1.0, 1.5))
    names = [law.name for law in LAWS]
    values = (4.0 * F32 / (3.0 * np.pi * F1), np.pi * F1, F0, np.pi * F1 / F0)
    return {"D": D, "P": 4.0 / 3.0 * F32, **dict(zip(names, values, strict=True))}


def _fit(P: np.ndarray, values: np.ndarray) -> tuple[float, float]:
    """Factor and power of the least squares line through the logarithms."""
    inside = (FITTED[0] <= P) & (FITTED[1] >= P)
    power, logarithm = np.polyfit(np.log(P[inside]), np.log(values[inside]), 1)
    return math.exp(logarithm), float(power)


def _at(curves: dict[str, np.ndarray], name: str, P: float) -> float:
    return float(np.interp(-math.log(P), -np.log(curves["P"]), curves[name]))


def _laws(curves: dict[str, np.ndarray], fits: dict[str, tuple[float, float]]) -> Table:
    rows = []
    for law in LAWS:
        factor, power = fits[law.name]
        inside = (FITTED[0] <= curves["P"]) & (FITTED[1] >= curves["P"])
        ratio = law.factor * curves["P"][inside] ** law.power / curves[law.name][inside]
        numbers = (f"{law.factor:.2f}", f"{factor:.3f}", f"{law.power:.2f}", f"{power:.3f}")
        rows.append((law.name, *numbers, f"{ratio.min():.3f} to {ratio.max():.3f}"))
    head = ("quantity", "factor: theirs", "ours", "power: theirs", "ours", "their law over the integral")
    return Table("Table 1, factor · Pₐ^power:", head, tuple(rows))


def _linear(curves: dict[str, np.ndarray]) -> Table:
    rows = [
        (
            law.name,
            f"{law.linear:.2f}",
            *(f"{_at(curves, law.name, P) / P**law.order:.3f}" for P in LOADS),
            f"{_exact_at(curves, law):.1e}",
        )
        for law in LAWS
    ]
    about = (
        "Approximations independent of the load (pᵣ, Aᵣ/n) or proportional to it (over Pₐ). At D = 0 the number is "
        f"{curves[LAWS[2].name][0]:.3f} (theirs 0.5) and Pₐ is {curves['P'][0]:.4f} (theirs 0.57):"
    )
    head = ("quantity", "theirs", *(f"ours, Pₐ = {P:g}" for P in LOADS), "equal at Pₐ")
    return Table(about, head, tuple(rows))


def _exact_at(curves: dict[str, np.ndarray], law: Law) -> float:
    """P_a at which the integral has the value of the linear approximation; all four change
    steadily."""
    values = curves[law.name] / curves["P"] ** law.order
    order = np.argsort(values)
    return float(np.exp(np.interp(law.linear, values[order], np.log(curves["P"])[order])))


def _published(curves: dict[str, np.ndarray], fits: dict[str, tuple[float, float]]) -> tuple[Published, ...]:
    """Printed coefficients beside those of our fits; the interval of the fits is chosen freely."""
    source, free = "Bhushan 1998, table 1", "interval of the fit"
    inside = (FITTED[0] <= curves["P"]) & (FITTED[1] >= curves["P"])
    P, D = curves["P"][inside], curves["D"][inside]
    power, logarithm = np.polyfit(np.log(np.log10(0.57 / P)), np.log(D), 1)
    laws = [
        Published(source, f"{what} of {law.name}", f"{theirs:.2f}", ours, 0.2, rests_on=free)
        for law in LAWS
        for what, theirs, ours in zip(("factor", "power"), (law.factor, law.power), fits[law.name], strict=True)
    ]
    return (
        *laws,
        Published(source, "factor of the separation D", "1.40", math.exp(logarithm), 0.2, rests_on=free),
        Published(source, "power of the separation D", "0.65", float(power), 0.2, rests_on=free),
        Published(source, "Pₐ at D = 0", "0.57", float(curves["P"][0])),
        Published(source, "n/(η Aₐ) at D = 0", "0.5", float(curves[LAWS[2].name][0])),
        *_approximations(curves),
        *_exponential(),
        *_plastic(),
    )


def _approximations(curves: dict[str, np.ndarray]) -> Iterator[Published]:
    """Factors of the approximations of table 1, at the Pₐ where the printed law has the value of
    the printed approximation."""
    for law in LAWS:
        P = (law.linear / law.factor) ** (1.0 / (law.power - law.order))
        ours = _at(curves, law.name, P) / P**law.order
        what = f"approximation of {law.name}, where it meets its fit (Pₐ = {P:.1e})"
        yield Published(
            "Bhushan 1998, table 1", what, f"{law.linear:.2f}", ours, 0.05, rests_on="load at which it is read"
        )


def _exponential(D: float = 1.5) -> Iterator[Published]:
    """The constants of eqs 20 for summits of exponential heights, from quadratures of eqs 11 at one
    separation ``D``."""
    from scipy.integrate import quad

    number, area, load = (quad(lambda s, m=m: (s - D) ** m * math.exp(-s), D, np.inf)[0] for m in (0.0, 1.0, 1.5))
    pressure = 4.0 / 3.0 * load
    constants = (
        ("eq. 20a", "pᵣ/[E*(σₚ/Rₚ)^½], (4/3π)(1.5!)", "0.5642", pressure / (math.pi * area)),
        ("eq. 20c", "n Rₚσₚ E*(σₚ/Rₚ)^½/(pₐAₐ), 3/(4·1.5!)", "0.5642", number / pressure),
        ("eq. 20d", "(Aᵣ/n)/(Rₚσₚ), π", "3.1416", math.pi * area / number),
    )
    for place, what, theirs, ours in constants:
        yield Published(f"Bhushan 1998, {place}", f"exponential heights: {what}", theirs, ours)


def _plastic() -> Iterator[Published]:
    """Plasticity indices at which 2 % of the area flow."""
    review = "Bhushan 1998, text"
    heaviest = _index_of(lambda psi: float(plastic_area_share(0.0, psi)))
    yield Published(review, "ψ up to which 2 % of the area flow at no load of table 1 (D ≥ 0)", "0.6", heaviest)
    lightest = _index_of(lambda psi: float(profile_peaks.plastic_area_share(5.0, psi)))
    reason = "at 0.45 a ten-thousandth flows: the bound is on the safe side"
    yield Published(
        review,
        "ψ of Onions & Archard from which 2 % of the area flow at trivial loads (five σ)",
        "0.45",
        lightest,
        reason=reason,
        rests_on="five σ as trivial load",
    )


def _light_load(psi: float) -> float:
    """Pₐ at which 2 % of the area flow, over that at D = 0."""
    D = separation_at_plastic_onset(psi)
    loads = np.asarray(GaussianHeights().tail_moment(np.array([D, 0.0]), 1.5))
    return float(loads[0] / loads[1])


def _index_of(share: Callable[[float], float]) -> float:
    """Plasticity index at which the plastic share of the area is 2 %, by bisection."""
    low, high = 0.1, 3.0
    while high - low > 1e-6:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if share(middle) < NOTICEABLE else (low, middle)
    return high


def _separation(curves: dict[str, np.ndarray]) -> Table:
    loads = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
    theirs = FittedLaws().separation(np.array(loads))
    rows = tuple((f"{P:g}", f"{D:.3f}", f"{_at(curves, 'D', P):.3f}") for P, D in zip(loads, theirs, strict=True))
    return Table("Separation D = 1.40 [log(0.57/Pₐ)]^0.65 of table 1:", ("Pₐ", "theirs", "ours"), rows)


def _index(curves: dict[str, np.ndarray]) -> Table:
    """Elastic area over the plastic one p/H: (A_r/P_a)/ψ, from eqs (14), (29) and (30)."""
    loads = (1e-5, 1e-3, 1e-1)
    name = LAWS[1].name
    rows = tuple(
        (f"{psi:g}", *(f"{_at(curves, name, P) / P / psi:.2f}" for P in loads)) for psi in (0.1, 0.3, 0.6, 1.0, 2.0)
    )
    return Table(
        "Fig. 13, elastic real area over the plastic one, Aᵣₑ H/(pₐ Aₐ); 3.2/ψ by eq. 21:",
        ("ψ", *(f"Pₐ = {P:g}" for P in loads)),
        rows,
    )


@dataclass(frozen=True)
class Skewed:
    """Area over that of no skewness, meniscus force over load, by skewness (and film, (n,
    films))."""

    area: np.ndarray
    force: np.ndarray


def _skewed(pressure: float, kurtosis: float) -> Skewed:
    areas, forces = [], []
    for skewness in SKEWNESS:
        theory = KotwalBhushan(*SUMMITS, skewness=skewness, kurtosis=kurtosis)
        areas.append(float(theory.at_pressure(pressure).area_fraction[0]))
        made = [StatisticalMeniscus(theory, 0.073, film, math.radians(60.0), 0.28e-9) for film in FILMS]
        forces.append([float(one.at_pressure(pressure).meniscus_pressure[0]) / pressure for one in made])
    return Skewed(np.array(areas) / areas[SKEWNESS.index(0.0)], np.array(forces))


def _shapes(skewed: dict[tuple[float, float], Skewed], pressure: float) -> Table:
    rows = []
    for index, skewness in enumerate(SKEWNESS):
        found = [skewed[pressure, K] for K in KURTOSIS]
        rows.append((f"{skewness:g}", *(f"{one.area[index]:.3f}; {one.force[index, 0]:.3f}" for one in found)))
    about = f"Kotwal & Bhushan at {pressure / 1e3:g} kPa: area over that at Sk = 0, and Fₘ/W with a film of 1 nm:"
    return Table(about, ("Sk", *(f"K = {K:g}" for K in KURTOSIS)), tuple(rows))


def _claims(
    curves: dict[str, np.ndarray], fits: dict[str, tuple[float, float]], skewed: dict[tuple[float, float], Skewed]
) -> tuple[Claim, ...]:
    powers = max(abs(fits[law.name][1] - law.power) for law in LAWS)
    inside = (FITTED[0] <= curves["P"]) & (FITTED[1] >= curves["P"])
    P = curves["P"][inside]
    apart_laws = [np.abs(law.factor * P**law.power / curves[law.name][inside] - 1.0).max() for law in LAWS]
    places = [_exact_at(curves, law) for law in LAWS]
    apart = np.abs(FittedLaws().separation(P) - curves["D"][inside]).max()
    light = {K: skewed[PRESSURES[0], K] for K in KURTOSIS}
    lowest = [SKEWNESS[int(values.argmin())] for K in (3.0, 4.0) for values in (light[K].area, light[K].force[:, 0])]
    zero = SKEWNESS.index(0.0)
    growth = {K: light[K].force[:, 1] / light[K].force[:, 0] for K in KURTOSIS}
    middle = [index for index, skewness in enumerate(SKEWNESS) if 0.3 <= skewness <= 0.7]
    area = _at(curves, LAWS[1].name, 1e-3) / 1e-3
    return (
        Claim("table 1: largest difference of the powers of the load", powers, 0.0, 0.02),
        Claim("table 1: area and real pressure off the integrals by", float(max(apart_laws[:2])), 0.0, 0.1),
        Claim("table 1: number and area of contacts off the integrals by", float(max(apart_laws[2:])), 0.0, 0.2),
        Claim("table 1: least Pₐ at which a linear approximation is exact", min(places), 5e-4),
        Claim("table 1: largest Pₐ at which a linear approximation is exact", max(places), high=0.05),
        Claim("table 1: largest difference of the separation, standard deviations", float(apart), 0.0, 0.2),
        Claim("table 1: Pₐ at which the planes of the mean summit heights meet", float(curves["P"][0]), 0.565, 0.575),
        Claim("fig. 13: elastic over plastic area at ψ = 1 (least area when contact is plastic)", area, 1.0),
        Claim("skewed summits, light load, K = 3 and 4: least skewness of a minimum", min(lowest), 0.3, 0.7),
        Claim("skewed summits, light load, K = 3 and 4: largest skewness of a minimum", max(lowest), 0.3, 0.7),
        Claim(
            "area at a skewness of 0.3 to 0.7 over that at 0, K > 5, largest",
            float(max(light[K].area[middle].max() for K in (7.0, 10.0))),
            0.0,
            1.0,
        ),
        Claim(
            "meniscus force at a skewness of 0.3 to 0.7 and K > 5 over that of Gaussian summits, largest",
            float(max(light[K].force[middle, 0].max() for K in (7.0, 10.0)) / light[3.0].force[zero, 0]),
            0.0,
            0.25,
        ),
        Claim(
            "growth of the force from 1 to 4 nm at a skewness of 0.3 to 0.7 and K > 5 over that of Gaussian "
            "summits, largest",
            float(max(growth[K][middle].max() for K in (7.0, 10.0)) / growth[3.0][zero]),
            0.0,
            1.0,
        ),
    )


if __name__ == "__main__":
    write_page(compare(), __file__)
