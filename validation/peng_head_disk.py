"""Head-disk interface and coated silicon: chapter 4 of Peng (2001), from the ready studies of examples/campaigns."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from page import Claim, Page, Table, write_page
from ready_studies import PIXEL, axis, ready, results, without

from asperity.studies.critical_thickness import CriticalThickness, critical_thickness

if TYPE_CHECKING:
    import xarray

DISK, SILICON = 200e9, 170e9
"""Moduli below the carbon, Pa."""

QUANTITIES = {
    "area_fraction": "Aᵣ/Aₙ",
    "max_displacement": "largest u_z",
    "max_pressure": "pₘₐₓ",
    "relative_meniscus_force": "Fₘ/W",
}

UNITS = {"area_fraction": (100.0, " %"), "max_displacement": (1e9, " nm"), "max_pressure": (1e-9, " GPa")}
"""Factor from SI and the unit shown."""

ABOUT_FIVE = (1.5, 15.0)
"""Within a factor of about three of the published floor, nm: read from curves by eye, and ours scatter by pixels."""

ALIKE = 0.02
"""Silicon and disk have different X at the same load, which changes the ratios this much (from the pₘₐₓ law X^m)."""

FLOOR = 5e-9
CEILINGS = {"area_fraction": 1e-5, "max_pressure": 1e-7, "relative_meniscus_force": 1e-5}
"""Critical thicknesses as published, m."""

OVERCOATS = ("150 GPa", "350 GPa")
"""Moduli of the carbon on the disk; the others are extreme cases."""

ABOUT = (
    "Peng (2001, ch. 4, fig. 4.3; also Peng & Bhushan 2000b): a slider of Al₂O₃-TiC (450 GPa) on a magnetic disk (E₂ = 200 GPa) under "
    "diamond-like carbon of the thickness h with E₁/E₂ = 0.1, 0.75, 1.75 and 10 and hardness 0.1 E₁; σ = 1 nm, β* = 0.5 µm, film and "
    "menisci 2σ high, γ = 25 mN/m, θ = 10°, pₙ = 50 kPa. Ours: `examples/campaigns/head_disk_interface.toml` on {points} × {points} pixels of "
    "{pixel:.0f} nm, means over {seeds} surfaces; critical thicknesses are those of the means. The figure itself is not in the text at hand: "
    "published here are the critical thicknesses and what the text says of the curves."
)


@dataclass(frozen=True, eq=False)
class Curves:
    """Results of one study on several surfaces, by E1/E2."""

    data: xarray.Dataset
    base: float

    @property
    def ratios(self) -> list[float]:
        """E1/E2."""
        return [float(modulus) / self.base for modulus in self.data["modulus"]]

    @property
    def thickness(self) -> np.ndarray:
        """Thicknesses in m, from none to endless."""
        return np.asarray(self.data["thickness"], dtype=float)

    def mean(self, quantity: str, ratio: float) -> np.ndarray:
        """Mean over the surfaces against the thickness; NaN where one of them has no answer."""
        rows = self.data[quantity].isel(modulus=self._at(ratio)).transpose("surface", "thickness")
        return np.asarray(rows.mean("surface", skipna=False), dtype=float)

    def critical(self, quantity: str, ratio: float) -> CriticalThickness:
        """Floor and ceiling of the mean."""
        values = self.mean(quantity, ratio)
        return critical_thickness(self.thickness[1:-1], values[1:-1], float(values[0]), float(values[-1]))

    def effect(self, quantity: str, ratio: float) -> float:
        """Value with endless carbon over that without."""
        values = self.mean(quantity, ratio)
        return float(values[-1] / values[0])

    def near(self, thickness: float) -> int:
        """Number of the thickness next to ``thickness`` (m)."""
        return 1 + int(np.argmin(np.abs(np.log(self.thickness[1:-1] / thickness))))

    def answered(self, ratio: float) -> int:
        """Number of cases with an answer."""
        return int(np.isfinite(self.data["max_pressure"].isel(modulus=self._at(ratio))).sum())

    def _at(self, ratio: float) -> int:
        return int(np.argmin(np.abs(np.array(self.ratios) - ratio)))


@dataclass(frozen=True, eq=False)
class Studies:
    """The contact as published, and with something changed."""

    disk: Curves
    dry: Curves
    free: Curves
    rigid: Curves
    silicon: Curves


def compare(seeds: int = 4, points: int = 256, count: int = 16) -> Page:
    """Ours on ``seeds`` surfaces of ``points`` a side for ``count`` thicknesses; the free boundary on half as many."""
    found = _solved(seeds, points, count)
    parts = (
        _critical_table("With menisci, as in the ready study:", found.disk),
        _curves(found.disk),
        _critical_table("The same contact without liquid:", found.dry),
        _critical_table("With menisci, on a cell with nothing around it (free boundary):", found.free),
        _reading(found),
        _critical_table("Carbon on silicon, `examples/campaigns/carbon_on_silicon.toml`:", found.silicon),
        _critical_table("Beside it the disk under a rigid slider:", found.rigid),
        MEMS,
    )
    about = ABOUT.format(points=points, pixel=1e9 * PIXEL, seeds=seeds)
    return Page("Critical thickness of carbon: head-disk interface and silicon", about, parts, tuple(_claims(found)))


def _solved(seeds: int, points: int, count: int) -> Studies:
    disk, silicon = (ready(name, points=points, seeds=seeds) for name in ("head_disk_interface", "carbon_on_silicon"))
    for table in (disk, silicon):
        table["critical_thickness"]["count"] = count
    disk_alone = without(disk, "counter_body")
    free = ready("head_disk_interface", points=points // 2, seeds=seeds)
    free["critical_thickness"]["count"] = count
    free["problem"]["boundary"] = {"kind": "free"}
    free["problem"]["surface"]["periodic"] = False
    for table in (disk_alone, free):
        table["axes"] = [dict(item) for item in table["axes"]]
        axis(table, "modulus")["values"] = list(OVERCOATS)
    tables = ((disk, DISK), (without(disk, "film"), DISK), (free, DISK), (disk_alone, DISK), (silicon, SILICON))
    return Studies(*(Curves(results(table), base) for table, base in tables))


def _nanometres(thickness: float) -> str:
    return f"{float(f'{1e9 * thickness:.2g}'):g}" if np.isfinite(thickness) else "–"


def _critical_table(about: str, curves: Curves) -> Table:
    rows = []
    for quantity, name in QUANTITIES.items():
        if quantity not in curves.data:
            continue
        for ratio in curves.ratios:
            found = curves.critical(quantity, ratio)
            values = (found.at_zero, found.at_infinity)
            factor, unit = UNITS.get(quantity, (1.0, ""))
            shown = (f"{factor * value:.3g}{unit}" if np.isfinite(value) else "runs away" for value in values)
            theirs = CEILINGS.get(quantity)
            rows.append(
                (
                    name,
                    f"{ratio:.2f}",
                    *shown,
                    _nanometres(found.floor),
                    "5",
                    _nanometres(found.ceiling),
                    f"{1e9 * theirs:.0f}" if theirs else "",
                )
            )
    head = ("", "E₁/E₂", "no carbon", "endless", "floor (nm): ours", "theirs", "ceiling (nm): ours", "theirs")
    return Table(about, head, tuple(rows))


def _curves(curves: Curves) -> Table:
    inside = range(1, len(curves.thickness) - 1, 2)
    rows = []
    for quantity, name in QUANTITIES.items():
        for ratio in curves.ratios:
            values = curves.mean(quantity, ratio)
            relative = values[list(inside)] / values[0]
            rows.append((name, f"{ratio:g}", *(f"{value:.3f}" if np.isfinite(value) else "–" for value in relative)))
    head = ("", "E₁/E₂", *(f"{_nanometres(curves.thickness[number])} nm" for number in inside))
    return Table("Over the value without carbon, as fig. 4.3 shows it; – where menisci run away:", head, tuple(rows))


def _reading(found: Studies) -> str:
    disk, dry, free = found.disk, found.dry, found.free
    at = disk.near(FLOOR)
    wet_depth, dry_depth = (1e9 * float(one.mean("max_displacement", 0.75)[at]) for one in (disk, dry))
    force = disk.mean("relative_meniscus_force", 0.75)[0]
    sticking = disk.data["thickness"].size * disk.data["surface"].size - disk.answered(0.1)
    return f"""## Reading the tables

* **Floor.** About 5 nm, as published, for every quantity: below it the carbon has no effect.
* **Ceiling.** Published are 10⁴ nm for area and meniscus force and 10² nm for the largest pressure, ours are between {_range(disk)} nm
  for all of them; that of the pressure is the lowest in ours, too. Waves of the surface of length λ reach about λ/2π down, and the longest with much
  power have some β* = 500 nm: on a periodic cell a depth of 10⁴ nm has no influence. On an isolated cell (free boundary) the load makes a dent as
  wide as the cell; then the largest displacement has its ceiling beyond 10⁴ nm ({_ceilings(free, "max_displacement")} nm) and the largest pressure
  one of {_ceilings(free, "max_pressure")} nm. The published split by two powers of ten is characteristic of a finite patch, but area and meniscus
  force have their ceilings at {_ceilings(free, "area_fraction")} and {_ceilings(free, "relative_meniscus_force")} nm there, too.
* **No floor.** With E₁/E₂ = 0.1 the hardness of the carbon, 2 GPa, limits the pressure however thin it is. Without liquid the contact is
  some ten pixels, and its area changes by whole ones.
* **Stiffness.** A stiff overcoat lowers area, displacement and meniscus force and raises the pressure, a compliant one does the
  opposite, as published.
* **Menisci.** They pull with {force:.0f} times the external force: films of 2σ cover much of the area, and closing the gap enlarges the menisci
  further. With E₁/E₂ = 0.1 they run away in {sticking} cases, all with thick layers: such a disk sticks. The published largest displacement stays
  below 0.3 h, 1.5 nm at h = 5 nm; ours at that h and E₁/E₂ = 0.75 is {wet_depth:.1f} nm with the menisci and {dry_depth:.1f} nm without. This and
  fig. 3.20 (see [peng_menisci](peng_menisci.md)) speak for menisci that were not, or not fully, fed back into the published loads."""


def _range(curves: Curves) -> str:
    ceilings = [curves.critical(name, ratio).ceiling * 1e9 for name in CEILINGS for ratio in (0.75, 1.75, 10.0)]
    return f"{min(ceilings):.0f} and {max(ceilings):.0f}"


def _ceilings(curves: Curves, quantity: str) -> str:
    return " and ".join(_nanometres(curves.critical(quantity, ratio).ceiling) for ratio in curves.ratios)


MEMS = """Peng gives no computed values for silicon (E₂ = 170 GPa, counter face rigid, E₁/E₂ = 0.82 and 1.65), but infers that it lies between the two
disks. It does so: relative to no carbon, each quantity changes less than with E₁/E₂ = 0.75 and 1.75 on the disk under the same
counter face."""


def _claims(found: Studies) -> Iterable[Claim]:
    disk = found.disk
    for quantity, name in QUANTITIES.items():
        floors = [disk.critical(quantity, ratio).floor for ratio in (0.75, 1.75)]
        yield Claim(f"{name}: floor (nm), geometric mean of E₁/E₂ = 0.75 and 1.75", 1e9 * _middle(floors), *ABOUT_FIVE)
    for quantity, name in QUANTITIES.items():
        ceilings = [disk.critical(quantity, ratio).ceiling for ratio in (0.75, 1.75)]
        yield Claim(f"{name}: ceiling (nm), the same mean", 1e9 * _middle(ceilings), 200.0, 2000.0)
    for quantity, sign in (("area_fraction", -1), ("relative_meniscus_force", -1), ("max_pressure", 1)):
        curves = np.array([disk.mean(quantity, ratio)[1:-1] for ratio in (0.75, 1.75, 10.0)])
        step = sign * np.diff(curves, axis=0) / disk.mean(quantity, 1.75)[0]
        direction = "rise" if sign > 0 else "fall"
        yield Claim(
            f"{QUANTITIES[quantity]}: least {direction} with E₁/E₂ at any thickness, over the value without carbon",
            float(step.min()),
            0.0,
        )
    depths = [found.free.critical("max_displacement", ratio).ceiling for ratio in (0.75, 1.75)]
    # beyond the last thickness there is no ceiling: then it is larger than that
    beyond = [depth if np.isfinite(depth) else float(found.free.thickness[-2]) for depth in depths]
    yield Claim("free boundary: ceiling of the largest displacement (nm), least", 1e9 * min(beyond), 3e3)
    yield from _inference(found.silicon, found.rigid)


def _inference(silicon: Curves, disk: Curves) -> Iterable[Claim]:
    for quantity, name in QUANTITIES.items():
        low, high = sorted(disk.effect(quantity, ratio) for ratio in (0.75, 1.75))
        for ratio in silicon.ratios:
            yield Claim(
                f"{name}: endless over no carbon on silicon, E₁/E₂ = {ratio:.2f}, between those of the disk",
                silicon.effect(quantity, ratio),
                low * (1.0 - ALIKE),
                high * (1.0 + ALIKE),
            )


def _middle(values: Sequence[float]) -> float:
    return float(np.exp(np.mean(np.log(values))))


if __name__ == "__main__":
    write_page(compare(), __file__)
