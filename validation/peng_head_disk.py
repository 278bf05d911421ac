"""Head-disk interface and coated silicon: chapter 4 of Peng (2001), from the ready studies of
examples/campaigns."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import head_disk_unfed
import numpy as np
from page import Claim, Page, Published, Table, write_page
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
"""Within a factor of about three of the published floor, nm: read from curves by eye, and those of
four surfaces scatter by pixels."""

ABOUT_THREE = (2.0, 5.0)
"""Floors in nm of contacts without fed-back menisci, means over many surfaces."""

ALIKE = 0.02
"""Silicon and disk have different X at the same load, which changes the ratios this much (from the
pₘₐₓ law X^m)."""

SMOOTH = ("max_displacement", "max_pressure", "relative_meniscus_force")
"""Quantities that do not change by whole pixels."""

CEILINGS_OF = ("area_fraction", "relative_meniscus_force", "max_pressure")

FLOOR = 5e-9
CEILINGS = {"area_fraction": 1e-5, "max_pressure": 1e-7, "relative_meniscus_force": 1e-5}
"""Critical thicknesses as published, m."""

OVERCOATS = ("150 GPa", "350 GPa")
"""Moduli of the carbon on the disk; the others are extreme cases."""

ABOUT = (
    "Peng (2001, ch. 4, fig. 4.3; also Peng & Bhushan 2000b): a slider of Al₂O₃-TiC (450 GPa) on a magnetic "
    "disk (E₂ = 200 GPa) under diamond-like carbon of the thickness h with E₁/E₂ = 0.1, 0.75, 1.75 and 10 and "
    "hardness 0.1 E₁; σ = 1 nm, β* = 0.5 µm, film and menisci 2σ high, γ = 25 mN/m, θ = 10°, pₙ = 50 kPa. "
    "Ours: `examples/campaigns/head_disk_interface.toml` on {points} × {points} pixels of {pixel:.0f} nm, "
    "means over {seeds} surfaces (first table: {unfed}); critical thicknesses are those of the means. The "
    "figure itself is not in the text at hand: published here are the critical thicknesses and what the text "
    "says of the curves."
)


@dataclass(frozen=True, eq=False)
class Curves:
    """Results of one study on several surfaces, by E1/E2."""

    data: xarray.Dataset
    base: float
    points: int = 256

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
        return np.asarray(self._rows(quantity, ratio).mean(axis=0))

    def critical(self, quantity: str, ratio: float) -> CriticalThickness:
        """Floor and ceiling of the mean."""
        return self._critical(self.mean(quantity, ratio))

    @property
    def pixels(self) -> tuple[float, float]:
        """Mean and deviation of the area without the layer, in pixels; the cell has ``points`` a
        side."""
        area = np.asarray(self.data["area_fraction"].isel(modulus=0, thickness=0)) * self.points**2
        return float(area.mean()), float(area.std(ddof=1))

    def scattered(self, quantities: Sequence[str], name: str, draws: int = 200) -> tuple[float, float]:
        """Geometric mean in nm of a critical thickness ("floor" or "ceiling") over ``quantities``
        and moduli of the overcoat.

        And how much it scatters: the deviation over samples of as many surfaces, drawn from them
        with replacement.
        """
        count, draw = self.data["surface"].size, np.random.default_rng(0)
        rows = [self._rows(quantity, ratio) for quantity in quantities for ratio in (0.75, 1.75)]

        def middle(surfaces: np.ndarray) -> float:
            return 1e9 * _middle([getattr(self._critical(row[surfaces].mean(axis=0)), name) for row in rows])

        samples = [middle(draw.integers(count, size=count)) for _ in range(draws)]
        return middle(np.arange(count)), float(np.nanstd(samples, ddof=1))

    def each(self, quantity: str, name: str) -> np.ndarray:
        """A critical thickness in nm on every surface and modulus of the overcoat; NaN where there
        is none."""
        single = [Curves(self.data.isel(surface=[number]), self.base) for number in range(self.data["surface"].size)]
        return np.array([[1e9 * getattr(one.critical(quantity, r), name) for r in (0.75, 1.75)] for one in single])

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

    def _rows(self, quantity: str, ratio: float) -> np.ndarray:
        """Values (surface, thickness)."""
        rows = self.data[quantity].isel(modulus=self._at(ratio)).transpose("surface", "thickness")
        return np.asarray(rows, dtype=float)

    def _critical(self, values: np.ndarray) -> CriticalThickness:
        """Floor and ceiling of ``values`` against the thickness."""
        return critical_thickness(self.thickness[1:-1], values[1:-1], float(values[0]), float(values[-1]))

    def _at(self, ratio: float) -> int:
        return int(np.argmin(np.abs(np.array(self.ratios) - ratio)))


@dataclass(frozen=True, eq=False)
class Studies:
    """The contact with menisci that are not fed back, with steady ones as in the ready study, and
    with something changed."""

    unfed: Curves
    disk: Curves
    dry: Curves
    free: Curves
    rigid: Curves
    silicon: Curves


def compare(seeds: int = 4, points: int = 256, count: int = 16, unfed: int = 64, unfed_points: int = 256) -> Page:
    """Ours on ``seeds`` surfaces of ``points`` a side for ``count`` thicknesses; the free boundary
    on half as many.

    The contact with menisci that are not fed back on ``unfed`` surfaces of ``unfed_points`` a side.
    """
    alone = Curves(head_disk_unfed.solved(unfed, unfed_points, count), DISK, unfed_points)
    found = Studies(alone, *_steady(seeds, points, count))
    approaches = 1e9 * head_disk_unfed.rigid_approaches(unfed, unfed_points)
    parts = (
        _headline(found.unfed, unfed),
        _critical_table("With steady menisci, as in the ready study:", found.disk),
        _curves(found.disk),
        _critical_table("The same contact without liquid:", found.dry),
        _critical_table("With menisci, on a cell with nothing around it (free boundary):", found.free),
        _reading(found),
        _critical_table("Carbon on silicon, `examples/campaigns/carbon_on_silicon.toml`:", found.silicon),
        _critical_table("Beside it the disk under a rigid slider:", found.rigid),
        MEMS,
    )
    about = ABOUT.format(points=points, pixel=1e9 * PIXEL, seeds=seeds, unfed=unfed)
    title, claims = "Critical thickness of carbon: head-disk interface and silicon", tuple(_claims(found))
    return Page(title, about, parts, claims, tuple(_published(found.unfed, approaches)))


def _headline(unfed: Curves, surfaces: int) -> Table:
    about = (
        "**As published: menisci in the gap of the contact under the external load, not fed back**; means "
        f"over {surfaces} surfaces, of which every one has {unfed.pixels[0]:.1f} ± {unfed.pixels[1]:.1f} "
        "pixels of contact without carbon:"
    )
    return _critical_table(about, unfed)


def _published(unfed: Curves, approaches: np.ndarray) -> Iterable[Published]:
    """The printed critical thicknesses beside those of unfed menisci, and the one printed
    approach."""
    source, digits = "Peng 2001, sec. 4.1.3", "read off curves as a power of ten"
    for text, theirs, quantities, name in (
        ("floor (nm), geometric mean of u_z, pₘₐₓ and Fₘ/W", "5", SMOOTH, "floor"),
        ("ceiling of Aᵣ/Aₙ (nm)", "10000", ("area_fraction",), "ceiling"),
        ("ceiling of Fₘ/W (nm)", "10000", ("relative_meniscus_force",), "ceiling"),
        ("ceiling of pₘₐₓ (nm)", "100", ("max_pressure",), "ceiling"),
    ):
        ours, spread = unfed.scattered(quantities, name)
        what = f"{text}, E₁/E₂ = 0.75 and 1.75"
        yield Published(source, what, theirs, ours, spread=spread, reason="" if name == "floor" else digits)
    rough = (
        f"rigid approach (nm), σ = {1e9 * head_disk_unfed.ROUGH:g} nm, E₁/E₂ = {head_disk_unfed.SOFT:g}, h "
        f"= {1e9 * head_disk_unfed.THIN:g} nm"
    )
    spread = float(approaches.std(ddof=1))
    yield Published(
        source, rough, "3", float(approaches.mean()), spread=spread, reason="two or three pixels touch: a weak check"
    )


def _steady(seeds: int, points: int, count: int) -> Iterator[Curves]:
    """Contacts of the ready studies: disk, without liquid, free boundary, rigid slider, silicon."""
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
    return (Curves(results(table), base) for table, base in tables)


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
    disk, dry, free, unfed = found.disk, found.dry, found.free, found.unfed
    area, force, peak = (unfed.each(name, "ceiling") for name in CEILINGS_OF)
    sizes = [f"{low:.0f} and {high:.0f}" for low, high in ((np.nanmin(x), np.nanmax(x)) for x in (area, force, peak))]
    alone, pull = 1e9 * float(unfed.mean("max_displacement", 0.75)[0]), unfed.mean("relative_meniscus_force", 0.75)[0]
    at = disk.near(FLOOR)
    wet_depth, dry_depth = (1e9 * float(one.mean("max_displacement", 0.75)[at]) for one in (disk, dry))
    steady = disk.mean("relative_meniscus_force", 0.75)[0]
    floor, known = unfed.scattered(SMOOTH, "floor")
    sticking = disk.data["thickness"].size * disk.data["surface"].size - disk.answered(0.1)
    return f"""## Reading the tables

* **Which menisci.** Those of the first table are what the printed sizes speak for: a largest displacement
  below 0.3 h = 1.5 nm at h = 5 nm (ours is {alone:.2g} nm), and curves for all four E₁/E₂, where steady
  menisci run away with the softest carbon. They pull with {pull:.0f} times the external force.
* **Floor.** Published about 5 nm for every quantity: below it the carbon has no effect. Ours are 2 to 6 nm;
  of displacement, pressure and force of the first table it is {floor:.2f} ± {known:.2f} nm (geometric mean
  for E₁/E₂ = 0.75 and 1.75, scatter of the mean of all surfaces), that of the area is known to a factor for
  want of pixels.
* **Ten pixels.** Without fed-back menisci {unfed.pixels[0]:.0f} pixels touch on a surface like the published
  one. Its area changes by whole pixels, so that its ceiling is the thickness at which the last of them joins
  or leaves: on single surfaces of ours (E₁/E₂ = 0.75 and 1.75) anywhere between {sizes[0]} nm. A ceiling of
  10⁴ nm of the area is within reach of one surface, then, and says nothing of another. Those of the meniscus
  force lie between {sizes[1]} nm, those of the largest pressure between {sizes[2]} nm: neither 10⁴ nor 10² nm
  is found there.
* **Ceiling.** Published are 10⁴ nm for area and meniscus force and 10² nm for the largest pressure, ours are
  between {_range(disk)} nm for all of them; that of the pressure is the lowest in ours, too. Waves of the
  surface of length λ reach about λ/2π down, and the longest with much power have some β* = 500 nm: on a
  periodic cell a depth of 10⁴ nm has no influence. On an isolated cell (free boundary) the load makes a dent
  as wide as the cell; then the largest displacement has its ceiling beyond 10⁴ nm
  ({_ceilings(free, "max_displacement")} nm) and the largest pressure one of {_ceilings(free, "max_pressure")}
  nm. The published split by two powers of ten is characteristic of a finite patch, but area and meniscus
  force have their ceilings at {_ceilings(free, "area_fraction")} and
  {_ceilings(free, "relative_meniscus_force")} nm there, too.
* **No floor.** With E₁/E₂ = 0.1 the hardness of the carbon, 2 GPa, limits the pressure however thin it is.
  Without liquid the contact is some ten pixels, and its area changes by whole ones.
* **Stiffness.** A stiff overcoat lowers area, displacement and meniscus force and raises the pressure, a
  compliant one does the opposite, as published.
* **Menisci.** They pull with {steady:.0f} times the external force: films of 2σ cover much of the area, and
  closing the gap enlarges the menisci further. With E₁/E₂ = 0.1 they run away in {sticking} cases, all with
  thick layers: such a disk sticks. The published largest displacement stays below 0.3 h, 1.5 nm at h = 5 nm;
  ours at that h and E₁/E₂ = 0.75 is {wet_depth:.1f} nm with the menisci and {dry_depth:.1f} nm without. This
  and fig. 3.20 (see [peng_menisci](peng_menisci.md)) speak for menisci that were not, or not fully, fed back
  into the published loads."""


def _range(curves: Curves) -> str:
    ceilings = [curves.critical(name, ratio).ceiling * 1e9 for name in CEILINGS for ratio in (0.75, 1.75, 10.0)]
    return f"{min(ceilings):.0f} and {max(ceilings):.0f}"


def _ceilings(curves: Curves, quantity: str) -> str:
    return " and ".join(_nanometres(curves.critical(quantity, ratio).ceiling) for ratio in curves.ratios)


MEMS = """Peng gives no computed values for silicon (E₂ = 170 GPa, counter face rigid, E₁/E₂ = 0.82 and 1.65),
but infers that it lies between the two disks. It does so: relative to no carbon, each quantity changes less
than with E₁/E₂ = 0.75 and 1.75 on the disk under the same counter face."""


def _claims(found: Studies) -> Iterable[Claim]:
    disk, unfed = found.disk, found.unfed
    for quantity in SMOOTH:
        middle = _middle([unfed.critical(quantity, ratio).floor for ratio in (0.75, 1.75)])
        yield Claim(
            f"{QUANTITIES[quantity]}: floor (nm) without feedback, geometric mean of E₁/E₂ = 0.75 and 1.75",
            1e9 * middle,
            *ABOUT_THREE,
        )
    area, force, _ = (unfed.each(name, "ceiling") for name in CEILINGS_OF)
    yield Claim("Aᵣ/Aₙ: largest over smallest ceiling on one surface", float(np.nanmax(area) / np.nanmin(area)), 10.0)
    yield Claim("Fₘ/W: largest ceiling on one surface (nm), far below 10⁴", float(np.nanmax(force)), high=3e3)
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
