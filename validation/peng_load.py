"""Area, largest pressure and meniscus force against the load: fig. 3.14 of Peng (2001), from the
ready study of it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from page import Claim, Page, Table, write_page
from peng_table_3_1 import PUBLISHED
from peng_table_3_1 import score as _score
from ready_studies import PIXEL, ready, results, without

if TYPE_CHECKING:
    import xarray

BASE = 100e9
RMS = 10.0
"""Rms height in nm."""

LOADS = ("10 kPa", "40 kPa", "100 kPa", "400 kPa", "1 MPa", "4 MPa", "10 MPa", "100 MPa")
"""From 1e-7 to 1e-3 of E2."""

ROWS = ("40 kPa", "100 kPa", "400 kPa", "1 MPa", "4 MPa")
"""Loads of the rows of table 3.1."""

LINEAR = (0.9, 1.1)
"""Exponents that pass for linear: from a contact of 0.05 % to one of 6 %, where the summits begin
to be used up."""

TOP = 10.0
"""End of the printed axis of the area, per cent; that of Fm/W runs from 0.01 to 1."""

AREA = 20e-6**2
"""Published nominal area in m²."""

ABOUT = (
    "Peng (2001, fig. 3.14; also Peng & Bhushan 2001a): σ = 10 nm, β* = 0.5 µm, h = 0.5 µm, E₂ = 100 GPa, "
    "hardness 0.05 E₁, water (72.75 mN/m, 60° on both sides) with film and menisci of the height σ. Ours: "
    "`examples/campaigns/load_dependence.toml` on {points} × {points} pixels of {pixel:.0f} nm, mean ± "
    "standard deviation over {seeds} surfaces, dry {dry}. The curves are not in the text at hand; published "
    "here are the ends of the axes, that the area is linear in the load, that the pressure ends at the "
    "hardness, and the rows of table 3.1 with σ = 10 nm, which are dry and of h = 1 µm."
)

WORDS = """* The area is linear in the load over four decades, plastic or not. Below about 10⁻⁶ E₂ it is only
  a few pixels.
* The pressure reaches the hardness at a load that rises with E₁/E₂, as in the figure.
* Fₘ/W falls with the load. At small loads it is the force of one summit, independent of the load; at large
  loads it falls slowly, as the meniscus area grows less than the contact area. As in the figure it falls from
  about 1 to 10⁻², and is smaller under a stiffer layer.
* With σ = 10 nm the force that the menisci add to the load matters only where the load is smallest."""


def compare(seeds: int = 4, points: int = 256, loads: tuple[str, ...] = LOADS, dry_seeds: int = 20) -> Page:
    """Ours on ``seeds`` surfaces of ``points`` a side under ``loads``, which rise from 1e-7 to 1e-3
    of E2, and on more dry."""
    wet = results(_under(ready("load_dependence", points=points, seeds=seeds), loads))
    dry = results(without(_under(ready("load_dependence", points=points, seeds=dry_seeds), ROWS), "film"))
    about = ABOUT.format(points=points, pixel=1e9 * PIXEL, seeds=seeds, dry=dry_seeds)
    parts = (_curves(wet), WORDS, _rows(dry))
    return Page(
        "Load dependence of coated rough surfaces", about, parts, tuple(_claims(wet, dry, (points * PIXEL) ** 2))
    )


def _under(table: dict[str, Any], loads: tuple[str, ...]) -> dict[str, Any]:
    kept = [item for item in table["axes"] if item["name"] != "load"]
    return {**table, "axes": [*kept, {"name": "load", "path": "control.mean_pressure", "values": list(loads)}]}


def values(data: xarray.Dataset, quantity: str, ratio: float, load: float) -> np.ndarray:
    """``quantity`` at E1/E2 and p_n/E2, by surface."""
    found = data[quantity].sel(modulus=ratio * BASE, load=load * BASE, method="nearest")
    return np.asarray(found.transpose("surface"), dtype=float)


def _ratios(data: xarray.Dataset) -> list[float]:
    return [float(modulus) / BASE for modulus in data["modulus"]]


def _loads(data: xarray.Dataset) -> list[float]:
    return [float(load) / BASE for load in data["load"]]


def _curves(data: xarray.Dataset) -> Table:
    rows = []
    for ratio in _ratios(data):
        for load in _loads(data):
            area, pressure, force, plastic = (
                factor * values(data, name, ratio, load)
                for name, factor in (
                    ("area_fraction", 100.0),
                    ("max_pressure", 1.0 / BASE),
                    ("relative_meniscus_force", 1.0),
                    ("plastic_area_fraction", 100.0),
                )
            )
            shown = [f"{found.mean():.3g} ± {found.std(ddof=1):.1g}" for found in (area, pressure, force)]
            rows.append((f"{ratio:g}", f"{load:.0e}", *shown, f"{plastic.mean():.0f}"))
    head = ("E₁/E₂", "pₙ/E₂", "Aᵣ/Aₙ (%)", "pₘₐₓ/E₂", "Fₘ/W", "plastic share (%)")
    return Table("With menisci, fed back into the load:", head, tuple(rows))


def _published() -> list[tuple[float, float, float, float]]:
    return [
        (ratio, load, area, peak)
        for ratio, load, rms, area, peak in PUBLISHED
        if rms == RMS and load in (4e-7, 1e-6, 4e-6, 1e-5, 4e-5)
    ]


def _rows(dry: xarray.Dataset) -> Table:
    rows = []
    for ratio, load, area, peak in _published():
        ours = 100.0 * values(dry, "area_fraction", ratio, load), values(dry, "max_pressure", ratio, load) / BASE
        shown = [f"{found.mean():.4f} ± {found.std(ddof=1):.4f}" for found in ours]
        rows.append((f"{ratio:g}", f"{load:.0e}", shown[0], f"{area:.4f}", shown[1], f"{peak:.4f}"))
    head = ("E₁/E₂", "pₙ/E₂", "Aᵣ/Aₙ (%): ours", "theirs", "pₘₐₓ/E₂: ours", "theirs")
    about = (
        "Without liquid, beside the rows of table 3.1. All of his are of one surface, and in his the rows of "
        "X = 2·10⁻⁴ (pₙ/E₂ = 4·10⁻⁶) do not gain area by the hardness, see "
        "[peng_table_3_1](peng_table_3_1.md):"
    )
    return Table(about, head, tuple(rows))


def _slope(data: xarray.Dataset, quantity: str, ratio: float, *, above: float) -> float:
    """Exponent of the load in the mean of ``quantity`` at loads from ``above`` E2 on."""
    loads = [load for load in _loads(data) if load >= above * (1.0 - 1e-9)]
    means = [values(data, quantity, ratio, load).mean() for load in loads]
    return float(np.polyfit(np.log(loads), np.log(means), 1)[0])


def _claims(wet: xarray.Dataset, dry: xarray.Dataset, cell: float) -> Iterable[Claim]:
    least, most = _loads(wet)[0], _loads(wet)[-1]
    for ratio in _ratios(wet):
        name = f"E₁/E₂ = {ratio:g}"
        area = 100.0 * values(wet, "area_fraction", ratio, most).mean()
        yield Claim(
            f"{name}: exponent of the load in the area, from 10⁻⁵ E₂ on",
            _slope(wet, "area_fraction", ratio, above=1e-5),
            *LINEAR,
        )
        yield Claim(f"{name}: area (%) at 10⁻³ E₂, on their axis", float(area), 1.0, TOP)
        peaks = values(wet, "max_pressure", ratio, most) / (0.05 * ratio * BASE)
        yield Claim(
            f"{name}: largest pressure at 10⁻³ E₂ over the hardness", float(peaks.min()), 1.0 - 1e-9, 1.0 + 1e-9
        )
        forces = [values(wet, "relative_meniscus_force", ratio, load).mean() for load in (least, most)]
        # a summit or two bear this load, so the force does not grow with the cell, but W does
        scaled = float(forces[0]) * cell / AREA
        yield Claim(f"{name}: Fₘ/W at 10⁻⁷ E₂ and 20 × 20 µm², near the upper end 1 of their axis", scaled, 0.3, 3.0)
        yield Claim(f"{name}: Fₘ/W at 10⁻³ E₂, near the lower end 0.01 of their axis", float(forces[1]), 0.5e-2, 3e-2)
    steps = [
        np.diff([values(wet, "relative_meniscus_force", ratio, load).mean() for ratio in _ratios(wet)]).max()
        for load in _loads(wet)
        if load >= 1e-6
    ]
    yield Claim("largest rise of Fₘ/W with E₁/E₂ at any load from 10⁻⁶ E₂ on", float(max(steps)), high=0.0)
    areas = [_score(area, 100.0 * values(dry, "area_fraction", *at)) for *at, area, _ in _published()]
    peaks = [_score(peak, values(dry, "max_pressure", *at) / BASE) for *at, _, peak in _published()]
    for name, scores in (("area", areas), ("largest pressure", peaks)):
        inside = sum(abs(score) <= 2.0 for score in scores)
        text = f"rows of table 3.1 whose {name} lies within two standard deviations of ours, of {len(scores)}"
        yield Claim(text, inside, len(scores) - 2, len(scores))


if __name__ == "__main__":
    write_page(compare(), __file__)
