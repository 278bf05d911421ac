"""Contact area and meniscus force of surfaces with skewness and kurtosis: figs 41 and 42 of Bhushan
(1998)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from bhushan import LOAD, Interface, column, film, grid, shown, spectrum
from page import Claim, Page, Table, write_page

import asperity as asp

RMS = 2e-9
TENSION, ANGLE = 0.025, math.radians(10.0)
SHAPES = (
    (-0.5, 3.0),
    (-0.2, 3.0),
    (0.0, 3.0),
    (0.2, 3.0),
    (0.5, 3.0),
    (0.0, 2.5),
    (0.0, 5.0),
    (0.0, 10.0),
    (0.2, 5.0),
    (0.5, 5.0),
)
"""Skewness and kurtosis."""

LOADS = (0.328e6, 3.28e6, 32.8e6)
FILMS = (0.5, 1.0, 2.0)
"""Thickness over σ."""

ABOUT = (
    "Bhushan (1998, figs 41 and 42, after Bhushan & Chilamakuri 1996): surfaces with skewness Sk and kurtosis "
    "K by the two-dimensional digital filter, against a smooth flat with a film of a perfluoropolyether, γ = "
    "25 mN/m, θ = 10°. Roughness and loads are not in the text: ours have σ = {rms:g} nm, β* = 0.5 µm, E* = "
    "100 GPa, {pixels} × {pixels} pixels of 78 nm. Mean ± standard deviation over {count} surfaces of the "
    "steady values; areas are counted in pixels."
)

WORDS = """* Area and force fall with the kurtosis, as published, and by orders of magnitude at low loads: a
  few high peaks carry the load and hold the rest of the surface outside the film.
* The published optimum of the skewness, 0 to 0.2 at low loads and about 0.2 at higher ones, is found at K =
  3: area and force have a minimum near 0.2 and rise towards 0.5. (At 32.8 MPa, where summits interact, the
  area does so, but the force continues to fall.)
* It is not a function of the two moments alone. The governing quantity is the height range of the highest
  hundredth of the surface: from the height that 1 % exceeds to that of 0.01 % there are 0.75, 1.37, 1.50 and
  1.42 σ at a skewness of -0.5, 0, 0.2 and 0.5 with K = 3, because at constant K a larger skewness implies a
  shorter tail, and 3.4 σ at K = 5. There area and force continue to fall with the skewness.
* With h/σ the force changes less the larger the skewness, and by far least at a kurtosis of five or more, as published.
* A kurtosis below 2.42 is not possible with this filter on this grid. At 0.3 MPa and K ≥ 5 contact is a pixel
  or two. Maps are finite: those of K = 10 have 8.4 on average."""


class Menisci:
    """Every contact of this page, each solved when it is first asked for."""

    def __init__(self, count: int, pixels: int) -> None:
        self._count, self._pixels = count, pixels
        self._surfaces: dict[tuple[float, float], list[Interface]] = {}
        self._found: dict[tuple[tuple[float, float], float, float], tuple[np.ndarray, np.ndarray]] = {}

    def of(self, shape: tuple[float, float], load: float, ratio: float) -> tuple[np.ndarray, np.ndarray]:
        """Area fraction and steady force over load, by surface, of ``shape`` at ``load`` in Pa and
        h/σ = ``ratio``."""
        case = shape, load, ratio
        if case not in self._found:
            liquid = film(ratio * RMS, TENSION, ANGLE)
            found = [face.menisci(liquid, load) for face in self.interfaces(shape)]
            self._found[case] = column(found, "area"), column(found, "steady")
        return self._found[case]

    def interfaces(self, shape: tuple[float, float]) -> list[Interface]:
        """Contacts of the surfaces with that skewness and kurtosis."""
        if shape not in self._surfaces:
            skewness, kurtosis = shape
            cell, options = grid(self._pixels), {"skewness": skewness, "kurtosis": kurtosis, "periodic": True}
            self._surfaces[shape] = [
                Interface(asp.generate.digital_filter(cell, spectrum(RMS), seed=seed, **options))  # type: ignore[arg-type]
                for seed in range(self._count)
            ]
        return self._surfaces[shape]

    def moments(self, shape: tuple[float, float]) -> np.ndarray:
        """Skewness and kurtosis of every surface, (surfaces, 2)."""
        surfaces = [face.problem.surface for face in self.interfaces(shape)]
        return np.array([(asp.roughness.skewness(one), asp.roughness.kurtosis(one)) for one in surfaces])


def compare(
    count: int = 8,
    pixels: int = 128,
    shapes: Sequence[tuple[float, float]] = SHAPES,
    loads: Sequence[float] = LOADS,
) -> Page:
    """Ours on ``count`` surfaces of every one of ``shapes``, under all ``loads`` in Pa, which
    include ``LOAD``."""
    menisci = Menisci(count, pixels)
    parts = (
        _made(menisci, shapes),
        *(_at_load(menisci, shapes, load) for load in loads),
        _films(menisci, shapes),
        WORDS,
    )
    about = ABOUT.format(rms=1e9 * RMS, pixels=pixels, count=count)
    return Page(
        "Contact area and menisci of surfaces with skewness and kurtosis", about, parts, _claims(menisci, count)
    )


def _name(shape: tuple[float, float]) -> tuple[str, str]:
    return f"{shape[0]:g}", f"{shape[1]:g}"


def _made(menisci: Menisci, shapes: Sequence[tuple[float, float]]) -> Table:
    rows = []
    for shape in shapes:
        skewness, kurtosis = menisci.moments(shape).T
        rows.append((*_name(shape), shown(skewness, ".2f"), shown(kurtosis, ".2f")))
    return Table("Surfaces as generated (fig. 41):", ("Sk", "K", "Sk of the maps", "K of the maps"), tuple(rows))


def _at_load(menisci: Menisci, shapes: Sequence[tuple[float, float]], load: float) -> Table:
    rows = []
    for shape in shapes:
        area, force = menisci.of(shape, load, 1.0)
        rows.append((*_name(shape), shown(100.0 * area), shown(force)))
    about = f"{1e-6 * load:g} MPa, film h = σ (fig. 42a):"
    return Table(about, ("Sk", "K", "Aᵣ/Aₙ (%)", "Fₘ/W"), tuple(rows))


def _films(menisci: Menisci, shapes: Sequence[tuple[float, float]]) -> Table:
    rows = [(*_name(shape), *(shown(menisci.of(shape, LOAD, ratio)[1]) for ratio in FILMS)) for shape in shapes]
    head = ("Sk", "K", *(f"h/σ = {ratio:g}" for ratio in FILMS))
    return Table(f"Fₘ/W at {1e-6 * LOAD:g} MPa against the film (fig. 42b):", head, tuple(rows))


def _claims(menisci: Menisci, count: int) -> tuple[Claim, ...]:
    gauss, optimum, skewed, sharp, sharper = (0.0, 3.0), (0.2, 3.0), (0.5, 3.0), (0.0, 5.0), (0.0, 10.0)
    area, force = (
        {shape: menisci.of(shape, LOAD, 1.0)[kind].mean() for shape in (gauss, optimum, skewed, sharp, sharper)}
        for kind in (0, 1)
    )
    rise = {shape: _rise(menisci, shape) for shape in (gauss, optimum, sharp)}
    moments = menisci.moments(optimum)
    off = np.abs(moments.mean(axis=0) - optimum) / (moments.std(axis=0, ddof=1) / math.sqrt(count))
    return (
        Claim(
            "fig. 41: mean skewness and kurtosis of the maps from 0.2 and 3, in standard errors",
            float(off.max()),
            0.0,
            4.0,
        ),
        Claim("fig. 42a: area at Sk = 0.2 over that at 0", float(area[optimum] / area[gauss]), 0.0, 1.0),
        Claim("fig. 42a: area at Sk = 0.2 over that at 0.5", float(area[optimum] / area[skewed]), 0.0, 1.0),
        Claim("fig. 42a: force at Sk = 0.2 over that at 0", float(force[optimum] / force[gauss]), 0.0, 1.0),
        Claim("fig. 42a: force at Sk = 0.2 over that at 0.5", float(force[optimum] / force[skewed]), 0.0, 1.0),
        Claim("fig. 42a: area at K = 5 over that at 3", float(area[sharp] / area[gauss]), 0.0, 0.8),
        Claim("fig. 42a: force at K = 5 over that at 3", float(force[sharp] / force[gauss]), 0.0, 0.8),
        Claim("fig. 42a: area at K = 10 over that at 5", float(area[sharper] / area[sharp]), 0.0, 1.0),
        Claim(
            "fig. 42b: rise of Fₘ/W from h = σ/2 to 2σ at Sk = 0.2 over that at 0",
            rise[optimum] / rise[gauss],
            0.0,
            1.0,
        ),
        Claim("fig. 42b: rise of Fₘ/W from h = σ/2 to 2σ at K = 5 over that at 3", rise[sharp] / rise[gauss], 0.0, 0.6),
    )


def _rise(menisci: Menisci, shape: tuple[float, float]) -> float:
    low, high = (menisci.of(shape, LOAD, ratio)[1].mean() for ratio in (FILMS[0], FILMS[-1]))
    return float(high - low)


if __name__ == "__main__":
    write_page(compare(), __file__)
