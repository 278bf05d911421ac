"""Meniscus force against the thickness of a water film and the roughness: figs 39 and 40b of
Bhushan (1998)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from bhushan import LOAD, Found, Interface, column, film, grid, shown, spectrum
from page import Claim, Page, Published, Table, write_page

import asperity as asp

ROUGHNESSES = (1e-9, 2e-9, 3e-9)
THICKNESSES = (0.5e-9, 1e-9, 1.5e-9, 2e-9, 3e-9, 4e-9)
LIGHT = 32.8e3
"""Pa, the load of the dry figures of the review."""

LOADS = (0.328e6, 1e6, LOAD, 10e6, 32.8e6)
"""Pa, for fig. 39: its load is not stated, so it is shown for many."""

PUBLISHED = 3.0
"""Fig. 39: meniscus over normal force at σ = 1 nm and 1 nm of water."""

ABOUT = (
    "Bhushan (1998, figs 39 and 40b, after Tian & Bhushan 1996 and Poon & Bhushan 1996): generated Gaussian "
    "surfaces, β* = 0.5 µm, against a smooth flat with a film of water, γ = 73 mN/m, θ = 60°, E* = 100 GPa, "
    "elastic; menisci as high as the film is thick. The load is not in the text: ours is {load:g} MPa, a "
    "hundred times the 32.8 kPa of the dry figures. Mean ± standard deviation over {count} surfaces. "
    "*Unfed*: menisci in the gap of the contact under the load alone (`film.feedback = false`), a single pass as "
    "described in the review. *Steady*: their force added to the load and iterated. *Theory*: the summits of the "
    "same surfaces by the statistical model (eqs 56 and 57, with the skewness and kurtosis of their heights)."
)

WORDS = """* The published 3 W for fig. 39 is that of menisci without feedback at this load, which was chosen
  freely: the agreement is one of size only, and the table of loads says between which the force is 3 W. With
  feedback, the force on such a smooth surface is four times as large,
  and at 32.8 kPa it ends near 1300 W: the real area is then determined by the meniscus force and hardly by
  the load. The review introduces the film *over the deformed surfaces* and does not say that the contact is
  solved again; Peng (2001, fig. 3.12) does so.
* The rougher the surface, the thicker the film needed for the same force, as published. There is no threshold
  in our curves, but a thickness above which the unfed force rises faster than the film thickness:
  its exponent grows from 0.5 at σ/3 through one at 0.7 σ to 1.3 at 1.4 σ, for σ = 2 nm and 3 nm alike. So the
  critical film thickness of the review, printed as "on the order of 3/4 of the liquid film thickness", is
  probably 3/4 of σ.
* On the smoothest surface the force falls again where the film is thicker than 2σ: menisci fill the area, and
  the suction falls as 1/h.
* The theory of summits lies within a factor of three of both, nearest to the steady force. It does not
  include flooding, because the force of each summit is independent of the others."""


def compare(
    count: int = 6, roughnesses: Sequence[float] = ROUGHNESSES, thicknesses: Sequence[float] = THICKNESSES
) -> Page:
    """Ours on ``count`` surfaces of each roughness in m, 1 nm first and 2 nm among them, for every
    thickness in m, 0.5, 1 and 2 nm among them."""
    faces = {rms: _interfaces(rms, count) for rms in roughnesses}
    found = {
        (rms, h): [face.menisci(film(h), theory=True) for face in faces[rms]]
        for rms in roughnesses
        for h in thicknesses
    }
    smooth = faces[roughnesses[0]]
    light = [face.menisci(film(1e-9), LIGHT) for face in smooth]
    single = {load: _unfed(smooth, load) for load in LOADS}
    parts = (_table(found), _single(single), _light(light), WORDS)
    about = ABOUT.format(load=1e-6 * LOAD, count=count)
    claims = (*_claims(found, roughnesses, thicknesses), *_single_claims(single, column(found[1e-9, 1e-9], "first")))
    title = "Meniscus force against film thickness and roughness"
    return Page(title, about, parts, claims, (_published(single[LOAD]),))


def _unfed(faces: list[Interface], load: float) -> np.ndarray:
    """F_m/W of 1 nm of water on each surface, not fed back."""
    return np.array([face.unfed(film(1e-9), load).menisci.relative_meniscus_force for face in faces])


def _published(values: np.ndarray) -> Published:
    return Published(
        "Bhushan 1998, fig. 39, after Poon & Bhushan 1996",
        "Fₘ/W without feedback, σ = 1 nm, film 1 nm",
        f"{PUBLISHED:g}",
        float(values.mean()),
        spread=float(values.std(ddof=1)),
        rests_on="load",
    )


def _single(single: dict[float, np.ndarray]) -> Table:
    about = "Fig. 39 (σ = 1 nm, 1 nm of water; published 3) without feedback under other loads, Fₘ/W:"
    return Table(about, tuple(f"{1e-6 * load:.3g} MPa" for load in single), (tuple(map(shown, single.values())),))


def _single_claims(single: dict[float, np.ndarray], first: np.ndarray) -> tuple[Claim, ...]:
    means = np.array([values.mean() for values in single.values()])
    above, below = ([load for load in single if sign * (single[load].mean() - PUBLISHED) > 0] for sign in (1.0, -1.0))
    return (
        Claim("fig. 39: largest growth of the unfed Fₘ/W with the load", float(np.diff(means).max()), high=0.0),
        Claim("fig. 39: largest load (MPa) of the table whose unfed force is above 3 W", 1e-6 * max(above), 3.2, 10.0),
        Claim("fig. 39: smallest whose unfed force is below it", 1e-6 * min(below), 3.2, 10.1),
        Claim("fig. 39: unfed force of both tables, difference", float(np.abs(single[LOAD] - first).max()), high=1e-6),
    )


def _interfaces(rms: float, count: int) -> list[Interface]:
    return [Interface(asp.generate.gaussian(grid(), spectrum(rms), seed=seed)) for seed in range(count)]


def _table(found: dict[tuple[float, float], list[Found]]) -> Table:
    rows = []
    for (rms, h), ones in found.items():
        numbers = [shown(column(ones, name)) for name in ("first", "steady", "theory")]
        rows.append((f"{1e9 * rms:g}", f"{1e9 * h:g}", *numbers))
    head = ("σ (nm)", "film (nm)", "unfed", "steady", "theory of summits")
    return Table("Meniscus force over load, Fₘ/W:", head, tuple(rows))


def _light(light: list[Found]) -> Table:
    about = (
        f"The interface of fig. 39 (σ = 1 nm, 1 nm of water) at {1e-3 * LIGHT:g} kPa, where contact is "
        "five to ten pixels:"
    )
    row = (shown(column(light, "first")), shown(column(light, "steady"), ".4g"))
    return Table(about, ("unfed", "steady"), (row,))


def _claims(
    found: dict[tuple[float, float], list[Found]], roughnesses: Sequence[float], thicknesses: Sequence[float]
) -> tuple[Claim, ...]:
    means = {name: _means(found, name, roughnesses, thicknesses) for name in ("first", "steady", "theory")}
    column_39 = list(thicknesses).index(1e-9)
    at = [list(thicknesses).index(h) for h in (0.5e-9, 1e-9, 2e-9)]
    powers = [float(power) for power in np.diff(np.log2(means["first"][list(roughnesses).index(2e-9), at]))]
    thin = [number for number, h in enumerate(thicknesses) if h <= 1.5 * min(roughnesses)]
    return (
        Claim("fig. 39: Fₘ/W without feedback, published 3", float(means["first"][0, column_39]), 2.4, 4.2),
        Claim("fig. 39: gain by feedback", float((means["steady"] / means["first"])[0, column_39]), 2.0),
        Claim(
            "fig. 40b: smallest growth of the steady force from one film to the next, films up to 1.5 σ",
            float(np.diff(np.log(means["steady"][:, thin]), axis=1).min()),
            0.0,
        ),
        Claim(
            "fig. 40b: smallest growth of the unfed force, σ ≥ 2 nm, all films",
            float(np.diff(np.log(means["first"][1:]), axis=1).min()),
            0.0,
        ),
        Claim("fig. 40b: power of the film in the unfed force, 0.5 to 1 nm at σ = 2 nm", powers[0], 0.2, 0.8),
        Claim(
            "fig. 40b: power of the film in the unfed force, 1 to 2 nm (about 0.7 σ) at σ = 2 nm", powers[1], 0.8, 1.2
        ),
        Claim(
            "fig. 40b: largest ratio of the steady forces of one roughness and the one before",
            float((means["steady"][1:, :-1] / means["steady"][:-1, :-1]).max()),
            0.0,
            1.0,
        ),
        Claim(
            "theory over steady force, smallest",
            float((means["theory"] / means["steady"]).min()),
            1.0 / 3.0,
        ),
        Claim("theory over steady force, largest", float((means["theory"] / means["steady"]).max()), 0.0, 3.0),
    )


def _means(
    found: dict[tuple[float, float], list[Found]],
    name: str,
    roughnesses: Sequence[float],
    thicknesses: Sequence[float],
) -> np.ndarray:
    """Means (roughnesses, thicknesses); none of these interfaces may run away."""
    means = np.array([[column(found[rms, h], name).mean() for h in thicknesses] for rms in roughnesses])
    if not all(map(math.isfinite, means.ravel())):
        raise ValueError("an interface runs away, but its force is compared")
    return means


if __name__ == "__main__":
    write_page(compare(), __file__)
