"""Nominally flat surfaces on a smooth flat, dry: figs 26 to 31 and 33 of Bhushan (1998), after Yu &
Bhushan (1996)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from bhushan import BODY, PIXEL, column, shown
from page import Claim, Page, Published, Table, within_scatter, write_page

import asperity as asp

PIXELS = 256
NOMINAL = 32.8e3
"""Pa, the pressure of their figs 26 to 28."""

PRESSURES = tuple(NOMINAL * factor for factor in (1.0, 10.0, 100.0, 1000.0))
SMOOTH, ROUGH = (1e-9, 0.5e-6), (3e-9, 0.1e-6)
"""σ and β* in m: the surface of most figures, and the rougher one of fig. 31."""

PUBLISHED_SPOTS = 6
"""Contact spots of the smoother surface at 32.8 kPa (fig. 26)."""

PUBLISHED_POINTS = 1570
"""Contact points of the rougher surface at 32.8 MPa (fig. 31)."""

RATIOS = (1e-9, 2e-9, 4e-9)
"""σ in m with β* = 0.5 µm, for the law of Poon & Bhushan."""

LENGTHS = (0.25e-6, 0.5e-6, 1e-6, 2e-6)
"""β* in m with σ = 1 nm, for the same law."""

FRICTIONS = (0.0, 0.25, 0.5)
DEPTHS = (0.0, 2e-9, 5e-9, 10e-9, 20e-9, 40e-9, 80e-9, 160e-9, 320e-9)
"""Planes of the stresses in m; the radius of the contacts is a few pixels of 78 nm."""

EVERY = (8, 4, 2, 1)
"""Sampling intervals of fig. 33 in pixels."""

ABOUT = (
    "Bhushan (1998, figs 26 to 31 and 33, after Yu & Bhushan 1996 and Poon & Bhushan 1996): "
    "computer-generated Gaussian surfaces with an exponential autocorrelation, 256 × 256 points on 20 × 20 "
    "µm², on a rigid smooth flat, E* = 100 GPa, no parameter chosen freely but ν = 0.3 for the stresses. "
    "Theirs: one surface, contact points and spots as printed. Ours: mean ± standard deviation over {count} "
    "surfaces, {pixels} × {pixels} pixels of 78 nm, periodic boundary; points are pixels in contact, spots "
    "are connected regions of them."
)

WORDS = """* Both printed counts, 6 spots and 1570 points, lie within the scatter of ours, without any fitted
  number; the mean of ours is 3 % above the second.
* As published, area and number of contacts grow almost in proportion to the load while they are small, the
  largest pressure grows with the load, and the rougher surface has the smaller area and the larger pressure.
* 'Contact area inversely proportional, pressure proportional to σ/β*' holds in σ: within 11 % and 25 % over
  a factor of four. In β* at a fixed sampling interval Δ it does not: (Aᵣ/Aₙ)σ/β* falls and pₘₐₓβ*/σ rises
  several times over from β* = 0.25 to 2 µm. The slopes of an exponential autocorrelation go as σ/(Δβ*)^½, and
  area over load as their inverse: (Aᵣ/Aₙ)σ/(Δβ*)^½ with the edges between the pixels is constant within a
  fifth. The law in σ/β* is exact where Δ grows with β*, as the similarity of [peng_scaling](peng_scaling.md)
  says.
* The bearing area, the part of the surface above the plane that the flat has reached, greatly overestimates
  the real area of contact, as published: about two times that with the edges between the pixels, as on a
  smooth sphere. Beside counted pixels it hardly does, since a spot of a pixel or two is counted much too large.
* The largest von Mises stress lies within a third of a pixel of the surface without friction and with µ =
  0.25, on it with µ = 0.5: contacts are one pixel, and place and size of this maximum are those of a pixel
  under uniform pressure. Friction raises it, and raises the largest tension more.
* With a smaller sampling interval the real area falls and the largest pressure rises, as published, without a
  limit in this range: an exponential autocorrelation has no shortest wavelength."""


def surface(shape: tuple[float, float], seed: int, pixels: int = PIXELS) -> asp.Surface:
    """Surface of σ and β* in m."""
    grid = asp.Grid((pixels, pixels), (PIXEL, PIXEL))
    return asp.generate.gaussian(grid, asp.generate.ExponentialAutocorrelation(*shape), seed=seed)


@dataclass(frozen=True)
class Dry:
    """What is counted on one contact: points and spots, real area by points and with the edges
    between them and bearing area over the nominal one, largest pressure in Pa."""

    points: int
    spots: int
    area: float
    corrected: float
    bearing: float
    peak: float


def solved(heights: asp.Surface, pressure: float) -> asp.ContactResult:
    """Contact under the ``pressure`` in Pa."""
    return asp.solve(asp.ContactProblem(heights, BODY), asp.MeanPressure(pressure), keep=asp.Keep(stiffness=False))


def seen(result: asp.ContactResult) -> Dry:
    """What is counted on a ``result``; the bearing area lies above the highest point less the
    approach."""
    heights = result.problem.surface.heights
    bearing = float((heights >= heights.max() - result.approach).mean())
    areas = result.area_fraction, result.area_fraction_corrected, bearing
    return Dry(int(result.contact.sum()), result.n_spots, *areas, result.max_pressure)


def compare(count: int = 24, pixels: int = PIXELS, stressed: int = 3) -> Page:
    """Ours on ``count`` surfaces, stresses on ``stressed`` of them."""
    loads = {p: [seen(solved(surface(SMOOTH, seed, pixels), p)) for seed in range(count)] for p in PRESSURES}
    rough = [seen(solved(surface(ROUGH, seed, pixels), PRESSURES[-1])) for seed in range(count)]
    by_ratio = {
        sigma: [seen(solved(surface((sigma, SMOOTH[1]), seed, pixels), 100.0 * NOMINAL)) for seed in range(count)]
        for sigma in RATIOS
    }
    by_length = {
        beta: [seen(solved(surface((SMOOTH[0], beta), seed, pixels), 100.0 * NOMINAL)) for seed in range(count)]
        for beta in LENGTHS
    }
    sampled = {
        step: [seen(solved(_sampled(surface(SMOOTH, seed, pixels), step), 1000.0 * NOMINAL)) for seed in range(count)]
        for step in EVERY
    }
    stresses = {
        friction: [_stresses(solved(surface(SMOOTH, seed, pixels), NOMINAL), friction) for seed in range(stressed)]
        for friction in FRICTIONS
    }
    scale = (pixels / PIXELS) ** 2  # points and spots per map of theirs
    parts = (
        _table(loads, rough, scale),
        _ratios(by_ratio),
        _lengths(by_length),
        _stress_table(stresses),
        _sampling(sampled, pixels),
        WORDS,
    )
    claims = (*_claims(loads, rough, by_ratio, sampled, stresses, scale), *_length_claims(by_length))
    about = ABOUT.format(count=count, pixels=pixels)
    published = tuple(
        Published(source, what, f"{theirs}", float(ours.mean() / scale), spread=float(ours.std(ddof=1) / scale))
        for source, what, theirs, ours in (
            ("Bhushan 1998, fig. 26", "contact spots, 32.8 kPa", PUBLISHED_SPOTS, column(loads[NOMINAL], "spots")),
            (
                "Bhushan 1998, fig. 31",
                "contact points, rough surface, 32.8 MPa",
                PUBLISHED_POINTS,
                column(rough, "points"),
            ),
        )
    )
    return Page("Nominally flat surfaces on a flat: points, pressures, stresses", about, parts, claims, published)


def _sampled(full: asp.Surface, step: int) -> asp.Surface:
    return asp.Surface(full.heights[::step, ::step], step * full.dx, step * full.dy, periodic=True)


@dataclass(frozen=True)
class Stresses:
    """Largest von Mises stress in Pa and its depth in m, and the largest principal stress in Pa."""

    von_mises: float
    depth: float
    tension: float


def _stresses(result: asp.ContactResult, friction: float) -> Stresses:
    def planes() -> Iterator[tuple[float, float, float]]:
        for field in asp.stresses.stress_planes(result, DEPTHS, friction=friction):
            yield float(field.von_mises.max()), field.planes[0].depth, float(field.principal[0].max())

    found = list(planes())
    largest, depth, _ = max(found)
    return Stresses(largest, depth, max(tension for *_, tension in found))


def _table(loads: dict[float, list[Dry]], rough: list[Dry], scale: float) -> Table:
    rows = []
    for (sigma, beta), pressure, found in (
        *((SMOOTH, p, all_) for p, all_ in loads.items()),
        (ROUGH, PRESSURES[-1], rough),
    ):
        theirs = {(SMOOTH, NOMINAL): f"{PUBLISHED_SPOTS} spots", (ROUGH, PRESSURES[-1]): f"{PUBLISHED_POINTS} points"}
        rows.append(
            (
                f"{1e9 * sigma:g}",
                f"{1e6 * beta:g}",
                f"{1e-6 * pressure:g}",
                theirs.get(((sigma, beta), pressure), "–"),
                shown(column(found, "spots") / scale, ".0f"),
                shown(column(found, "points") / scale, ".0f"),
                shown(100.0 * column(found, "area")),
                shown(100.0 * column(found, "corrected")),
                shown(100.0 * column(found, "bearing")),
                shown(1e-9 * column(found, "peak")),
            )
        )
    head = (
        "σ (nm)",
        "β* (µm)",
        "p (MPa)",
        "theirs",
        "spots",
        "points",
        "Aᵣ/Aₙ (%)",
        "with edges",
        "bearing area (%)",
        "pₘₐₓ (GPa)",
    )
    return Table("Contacts (figs 26, 29, 30 and 31):", head, tuple(rows))


def _ratios(by_ratio: dict[float, list[Dry]]) -> Table:
    rows = []
    for sigma, found in by_ratio.items():
        area, peak = column(found, "area").mean(), column(found, "peak").mean()
        slope = sigma / SMOOTH[1]
        rows.append(
            (
                f"{1e9 * sigma:g}",
                f"{100.0 * area:.3g}",
                f"{1e5 * area * slope:.4g}",
                f"{1e-9 * peak:.3g}",
                f"{1e-12 * peak / slope:.3g}",
            )
        )
    head = ("σ (nm)", "Aᵣ/Aₙ (%)", "10⁵ (Aᵣ/Aₙ) σ/β*", "pₘₐₓ (GPa)", "pₘₐₓ β*/σ (TPa)")
    return Table(
        "β* = 0.5 µm at 3.28 MPa: area inversely proportional, pressure proportional to σ/β*:", head, tuple(rows)
    )


def _lengths(by_length: dict[float, list[Dry]]) -> Table:
    rows = []
    for beta, found in by_length.items():
        area, edged, peak = (column(found, name).mean() for name in ("area", "corrected", "peak"))
        slope, step = SMOOTH[0] / beta, (beta / PIXEL) ** 0.5
        numbers = (1e5 * area * slope, 1e5 * edged * slope, 1e5 * edged * slope * step, 1e-12 * peak / slope)
        rows.append((f"{1e6 * beta:g}", f"{100.0 * area:.3g}", *(f"{number:.3g}" for number in numbers)))
    head = (
        "β* (µm)",
        "Aᵣ/Aₙ (%)",
        "10⁵ (Aᵣ/Aₙ) σ/β*",
        "with edges: 10⁵ (Aᵣ/Aₙ) σ/β*",
        "with edges: 10⁵ (Aᵣ/Aₙ) σ/(Δβ*)^½",
        "pₘₐₓ β*/σ (TPa)",
    )
    return Table("σ = 1 nm at 3.28 MPa, other β*, the same sampling interval Δ:", head, tuple(rows))


def _length_claims(by_length: dict[float, list[Dry]]) -> tuple[Claim, ...]:
    beta = np.array(list(by_length))
    area, peak = (np.array([column(found, name).mean() for found in by_length.values()]) for name in ("area", "peak"))
    rooted = np.array([column(found, "corrected").mean() for found in by_length.values()]) / np.sqrt(beta)
    return (
        Claim(
            "other β*: (Aᵣ/Aₙ) σ/β*, logarithm of largest over smallest: not constant",
            float(np.ptp(np.log(area / beta))),
            0.5,
        ),
        Claim(
            "other β*: pₘₐₓ β*/σ, logarithm of largest over smallest: not constant",
            float(np.ptp(np.log(peak * beta))),
            0.5,
        ),
        Claim(
            "other β*: (Aᵣ/Aₙ) σ/(Δβ*)^½ with edges, largest over smallest",
            float(rooted.max() / rooted.min()),
            1.0,
            1.3,
        ),
    )


def _stress_table(stresses: dict[float, list[Stresses]]) -> Table:
    rows = [
        (
            f"{friction:g}",
            shown(1e-9 * column(found, "von_mises")),
            shown(1e9 * column(found, "depth")),
            shown(1e-9 * column(found, "tension")),
        )
        for friction, found in stresses.items()
    ]
    head = ("µ", "largest von Mises stress (GPa)", "its depth (nm)", "largest principal stress (GPa)")
    return Table("σ = 1 nm, β* = 0.5 µm, 32.8 kPa (figs 27 and 28):", head, tuple(rows))


def _sampling(sampled: dict[int, list[Dry]], pixels: int) -> Table:
    rows = [
        (
            f"{1e9 * step * PIXEL:.0f}",
            f"{pixels // step}",
            shown(100.0 * column(found, "area")),
            shown(1e-9 * column(found, "peak")),
        )
        for step, found in sampled.items()
    ]
    head = ("sampling interval (nm)", "points per side", "Aᵣ/Aₙ (%)", "pₘₐₓ (GPa)")
    return Table("Every n-th point of the same surfaces, 32.8 MPa (fig. 33):", head, tuple(rows))


def _claims(
    loads: dict[float, list[Dry]],
    rough: list[Dry],
    by_ratio: dict[float, list[Dry]],
    sampled: dict[int, list[Dry]],
    stresses: dict[float, list[Stresses]],
    scale: float,
) -> tuple[Claim, ...]:
    area = {p: column(found, "area").mean() for p, found in loads.items()}
    peak = {p: column(found, "peak").mean() for p, found in loads.items()}
    spots = [column(found, "spots").mean() for found in loads.values()]
    products = np.array([sigma * column(found, "area").mean() for sigma, found in by_ratio.items()])
    quotients = np.array([column(found, "peak").mean() / sigma for sigma, found in by_ratio.items()])
    bearing = min(
        column(found, "bearing").mean() / column(found, "corrected").mean() for found in (*loads.values(), rough)
    )
    mises = [column(found, "von_mises").mean() for found in stresses.values()]
    tension = [column(found, "tension").mean() for found in stresses.values()]
    depth = max(float(column(found, "depth").max()) for found in stresses.values())
    areas = np.array([column(found, "area").mean() for found in sampled.values()])
    peaks = np.array([column(found, "peak").mean() for found in sampled.values()])
    points = column(rough, "points") / scale
    return (
        within_scatter("fig. 26: contact spots at 32.8 kPa", PUBLISHED_SPOTS, column(loads[NOMINAL], "spots") / scale),
        within_scatter("fig. 31: contact points of the rough surface", PUBLISHED_POINTS, points),
        Claim("fig. 31: mean of ours over theirs", float(points.mean()) / PUBLISHED_POINTS, 0.95, 1.05),
        Claim(
            "figs 29 and 30: smallest growth of the spots for ten times the load",
            float(np.min(np.divide(spots[1:], spots[:-1]))),
            1.0,
        ),
        Claim(
            "fig. 30: area at 3.28 MPa over ten times that at 0.328 MPa",
            float(area[PRESSURES[2]] / area[PRESSURES[1]]) / 10.0,
            0.7,
            1.3,
        ),
        Claim(
            "fig. 30: smallest growth of the largest pressure for ten times the load",
            float(np.min(np.diff(np.log10(list(peak.values()))))),
            0.0,
        ),
        Claim(
            "fig. 31: area of the rough surface over that of the smoother one",
            float(column(rough, "area").mean() / area[PRESSURES[-1]]),
            0.0,
            1.0,
        ),
        Claim(
            "fig. 31: largest pressure of the rough surface over that of the smoother one",
            float(column(rough, "peak").mean() / peak[PRESSURES[-1]]),
            1.0,
        ),
        Claim("(Aᵣ/Aₙ) σ/β*: largest over smallest", float(products.max() / products.min()), 1.0, 1.15),
        Claim("pₘₐₓ β*/σ: largest over smallest", float(quotients.max() / quotients.min()), 1.0, 1.6),
        Claim("fig. 29: bearing area over real area with edges, smallest", bearing, 1.5),
        Claim("fig. 27: greatest depth of the largest von Mises stress, pixels", depth / PIXEL, 0.0, 0.5),
        Claim(
            "fig. 27: smallest growth of the von Mises stress from one µ to the next",
            float(np.min(np.divide(mises[1:], mises[:-1]))),
            1.0,
        ),
        Claim(
            "fig. 28: smallest growth of the tension from one µ to the next",
            float(np.min(np.divide(tension[1:], tension[:-1]))),
            1.0,
        ),
        Claim(
            "fig. 33: largest area over that of twice the sampling interval",
            float((areas[1:] / areas[:-1]).max()),
            0.0,
            1.0,
        ),
        Claim(
            "fig. 33: smallest pressure over that of twice the sampling interval",
            float((peaks[1:] / peaks[:-1]).min()),
            1.0,
        ),
    )


if __name__ == "__main__":
    write_page(compare(), __file__)
