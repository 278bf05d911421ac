"""Solves the contacts behind ``asperity.predict`` and writes its tables.

    python validation/predictor_table.py [--seeds 16] [--only master,layer,several,capped]

Surfaces have an exponential autocorrelation whose 10 % length β is the unit of length, and press on
a half-space or on one layer. Everything is kept by dimensionless groups, so the numbers of metres
and pascals do not matter. The tables stand in ``src/asperity/data/predictor``; their first lines
record seeds and commit. To enlarge them give more ``--seeds``, or add to ``GRIDS``, ``PRESSURES``,
``RATIOS`` and ``THICKNESSES``: the functions that read the tables take any rows.
"""

from __future__ import annotations

import argparse
import csv
import itertools
import subprocess
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

import asperity as asp
from asperity.generate import ExponentialAutocorrelation, RmsHeight, SelfAffine, gaussian, translated
from asperity.physics.prediction.waves import Waves
from asperity.theories.rough.predictor import HEIGHTS, MIDDLE, PERIMETER, Groups, predictor

DATA = Path(asp.__file__).parent / "data" / "predictor"
BETA, RMS, E, NU = 1e-6, 2e-9, 100e9, 0.3
GRIDS = (
    *((32, 10.0), (64, 20.0), (128, 40.0)),
    *((64, 10.0), (128, 20.0), (256, 40.0)),
    *((128, 10.0), (256, 20.0), (512, 40.0)),
    *((256, 10.0), (512, 20.0)),
    *((512, 10.0),),
)
"""Points along a side, and side over β."""

PRESSURES = np.geomspace(1e-4, 3.0, 14)
"""Mean pressure over the rms pressure of full contact."""

LAYER_GRIDS = ((64, 20.0), (128, 20.0), (192, 15.0), (256, 10.0))
LAYER_PRESSURES = (0.002, 0.006, 0.02, 0.06, 0.2, 0.5)
RATIOS = (0.25, 0.35, 0.5, 0.7, 1.4, 2.0, 2.8, 4.0, 5.6)
THICKNESSES = (0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 1.0, 2.0, 5.0)
LAYER_SEEDS = 4

FIRST_SEED = 4900
KEEP, HARD = asp.Keep(stiffness=False), asp.plasticity.HardWall()


def body(ratio: float = 1.0, thickness: float = 1.0, nu: tuple[float, float] = (NU, NU)) -> Any:
    """Half-space of E and ν[1], with a layer of ``ratio`` E, ν[0] and ``thickness`` β unless the
    ratio is one."""
    base = asp.Elastic(E, nu[1])
    if ratio == 1.0:
        return base
    return asp.Layered([asp.Layer(asp.Elastic(ratio * E, nu[0]), thickness=thickness * BETA)], base=base)


def grid_of(n: int, size: float) -> asp.Grid:
    """Square grid of ``n`` points and a side of ``size`` β."""
    return asp.Grid((n, n), (size * BETA / n,) * 2)


def exponential(n: int, size: float, seed: int) -> asp.Surface:
    """Realisation ``seed`` of the exponential surface."""
    return gaussian(grid_of(n, size), ExponentialAutocorrelation(RMS, BETA), seed=seed)


def solved(
    surface: asp.Surface, solid: Any, pressure: float, rms: float, s: float, law: Any = HARD
) -> dict[str, float]:
    """What is kept of one contact: areas as shares, the largest pressure over ``s``, gap
    and shares of small gaps over ``rms``."""
    result = asp.solve(asp.ContactProblem(surface, solid, law=law), asp.MeanPressure(pressure), keep=KEEP)
    contact = result.contact
    edges = sum(float((contact != np.roll(contact, 1, axis)).mean()) for axis in (0, 1))
    row = {
        "area_pixels": result.area_fraction,
        "area": result.area_fraction - PERIMETER * edges,
        "peak": float(result.pressure.max()) / s,
        "gap": float(result.gap.mean()) / rms,
    }
    for h in HEIGHTS:
        row[f"below_{h:g}"] = float((result.gap <= h * rms).mean()) - result.area_fraction
    return row


def averaged(rows: Sequence[dict[str, float]]) -> dict[str, float]:
    """Means and standard deviations over surfaces."""
    made: dict[str, float] = {"samples": len(rows)}
    for key in rows[0]:
        values = np.array([row[key] for row in rows])
        made[key], made[f"{key}_sd"] = float(values.mean()), float(values.std(ddof=1))
    return made


def master(seeds: int) -> Iterator[dict[str, float]]:
    """Homogeneous half-space on all grids and at all pressures."""
    for n, size in GRIDS:
        count = seeds if n < 512 else max(4, seeds // 2)
        waves = Waves.of_spectrum(grid_of(n, size), ExponentialAutocorrelation(RMS, BETA), body())
        surfaces = [exponential(n, size, FIRST_SEED + number) for number in range(count)]
        for y in PRESSURES:
            p = y * waves.full_contact
            rows = [solved(surface, body(), p, waves.rms, waves.full_contact) for surface in surfaces]
            groups = {"points": n, "size": size, "pixel": size / n, "nayak": waves.nayak, "y": y}
            groups["X"] = p * BETA / (waves.modulus * waves.rms)
            yield groups | averaged(rows)


def layer() -> Iterator[dict[str, float]]:
    """One layer: factors on the values of the half-space at the same y, on the same surfaces."""
    spectrum = ExponentialAutocorrelation(RMS, BETA)
    for n, size in LAYER_GRIDS:
        surfaces = [exponential(n, size, FIRST_SEED + number) for number in range(LAYER_SEEDS)]

        def at(solid: Any, y: float, surfaces: Any = surfaces, n: int = n, size: float = size) -> Any:
            waves = Waves.of_spectrum(grid_of(n, size), spectrum, solid)
            return [solved(one, solid, y * waves.full_contact, RMS, waves.full_contact) for one in surfaces]

        bare = {y: averaged(at(body(), y)) for y in LAYER_PRESSURES}
        for ratio in RATIOS:
            for thickness in THICKNESSES:
                solid = body(ratio, thickness)
                found = [averaged(at(solid, y)) for y in LAYER_PRESSURES]
                nayak = Waves.of_spectrum(grid_of(n, size), spectrum, solid).nayak
                row: dict[str, float] = {"nayak": nayak, "ratio": ratio, "thickness": thickness}
                for key in ("area", "area_pixels", "peak"):
                    factors = [one[key] / bare[y][key] for one, y in zip(found, LAYER_PRESSURES, strict=True)]
                    decades = np.log10(np.array(LAYER_PRESSURES) / MIDDLE)
                    slope, middle = np.polyfit(decades, np.log(factors), 1)
                    left = np.log(factors) - middle - slope * decades
                    row |= {key: float(np.exp(middle)), f"{key}_slope": float(slope)}
                    row[f"{key}_sd"] = float(np.sqrt(left @ left / (left.size - 2)))
                yield row


WITHHELD = (
    *((192, 25.0, 1.0, 1.0, NU, NU), (144, 30.0, 1.0, 1.0, NU, NU), (240, 12.0, 1.0, 1.0, NU, NU)),
    *((192, 25.0, 3.0, 0.7, NU, NU), (144, 20.0, 1.4, 0.3, NU, NU), (216, 18.0, 0.35, 0.08, NU, NU)),
    *((160, 30.0, 2.5, 0.05, NU, NU), (160, 16.0, 5.0, 0.15, NU, NU), (200, 16.0, 0.3, 0.03, NU, NU)),
    *((160, 16.0, 3.0, 0.15, 0.2, 0.4), (160, 16.0, 3.0, 0.15, 0.4, 0.2), (160, 16.0, 0.4, 0.15, 0.4, 0.2)),
)
"""Points, side over β, E1/E2, thickness over β, ν1 and ν2 of contacts that the tables have not
seen."""

SELF_AFFINE = ((0.8, 0.3, 4.0), (0.8, 0.6, 4.0), (0.8, 0.0, 4.0), (0.5, 0.3, 4.0), (0.3, 0.3, 4.0), (0.8, 0.3, 10.0))
"""Hurst exponent, shortest and roll-off wavelength over β of surfaces of another kind."""

WITHHELD_PRESSURES = (0.003, 0.03, 0.3)
WITHHELD_SEEDS = range(7001, 7009)


def withheld() -> Iterator[dict[str, Any]]:
    """Contacts that the tables have not seen, solved on eight surfaces and predicted."""
    for n, size, ratio, thickness, *nu in WITHHELD:
        solid = body(ratio, thickness, (nu[0], nu[1]))
        label = f"exponential, E1/E2 {ratio:g}, h {thickness:g} β, ν {nu[0]:g} and {nu[1]:g}"
        yield from beside(label, grid_of(n, size), ExponentialAutocorrelation(RMS, BETA), solid)
    for hurst, shortest, rolloff in SELF_AFFINE:
        waves = {"shortest_wavelength": shortest * BETA, "rolloff_wavelength": rolloff * BETA}
        model = SelfAffine(amplitude=RmsHeight(RMS), hurst=hurst, **waves)
        label = f"self-affine, H {hurst:g}, λs {shortest:g} β, λr {rolloff:g} β"
        with suppress(asp.InputError):  # a bandwidth beyond the table
            yield from beside(label, grid_of(256, 30.0), model, body())


SEVERAL = (
    *(((2.0, 0.1), (1.5, 0.3)), ((4.0, 0.05), (2.0, 0.2)), ((0.4, 0.15), (0.7, 0.4)), ((5.0, 0.1), (3.0, 0.15))),
    *(((1.5, 0.05), (2.5, 0.1), (1.3, 0.4)), ((0.6, 0.1), (3.0, 0.1), (0.8, 0.2))),
    *(((2.0, 0.15), (0.4, 0.15), (3.0, 0.3)), ((3.0, 0.1), (0.5, 0.2)), ((0.5, 0.1), (2.0, 0.3))),
    ((0.3, 0.05), (4.0, 0.2)),
)
"""E1/E2 and thickness over β of the layers of bodies with several, from the top."""


def several() -> Iterator[dict[str, Any]]:
    """Bodies of two and three layers, solved and predicted by the one layer nearest to theirs;
    those that are refused are left out."""
    for layers in SEVERAL:
        made = [asp.Layer(asp.Elastic(ratio * E, NU), thickness=thickness * BETA) for ratio, thickness in layers]
        label = "layers " + ", ".join(f"{ratio:g} E2 of {thickness:g} β" for ratio, thickness in layers)
        for n, size in ((128, 20.0), (160, 16.0)):
            with suppress(asp.InputError):
                rough = ExponentialAutocorrelation(RMS, BETA)
                yield from beside(label, grid_of(n, size), rough, asp.Layered(made, base=asp.Elastic(E, NU)))


def beside(label: str, grid: asp.Grid, spectrum: Any, solid: Any) -> Iterator[dict[str, Any]]:
    """Means of solved contacts, and what is predicted with its error."""
    waves = Waves.of_spectrum(grid, spectrum, solid)
    surfaces = [gaussian(grid, spectrum, seed=seed) for seed in WITHHELD_SEEDS]
    for y in WITHHELD_PRESSURES:
        p = y * waves.full_contact
        rows = [solved(one, solid, p, waves.rms, waves.full_contact) for one in surfaces]
        found = asp.studies.predict(spectrum, solid, asp.MeanPressure(p), grid=grid)
        row: dict[str, Any] = {"case": label, "points": grid.shape[0], "size": found.groups.size, "y": y}
        row |= {"nayak": waves.nayak, **averaged(rows)}
        for key, value, unit in (
            ("area", found.area_fraction, 1.0),
            ("area_pixels", found.area_fraction_pixels, 1.0),
            ("peak", found.peak_pressure, waves.full_contact),
            ("gap", found.mean_gap, waves.rms),
        ):
            row |= {f"{key}_predicted": value.value / unit, f"{key}_error": value.error / unit}
            row[f"{key}_scatter"] = value.scatter / unit
        for height in (0.5, 1.0, 2.0):
            reading = predictor().share_below(found.groups, height) if y < 0.1 else None
            row[f"below_{height:g}_predicted"] = reading.value if reading else np.nan
        yield row


STRESS_GRIDS = (*LAYER_GRIDS, (64, 10.0), (128, 40.0))
STRESS_RATIOS = (0.25, 0.5, 0.75, 1.0, 1.6, 2.8, 5.6)
STRESS_THICKNESSES = (0.15, 0.35, 0.6, 0.9, 1.4, 2.2, 3.5, 6.0, 12.0, 30.0, 100.0)
"""Thickness over λ, rms gradient over rms curvature of the surface."""

STRESS_PRESSURES = (0.002, 0.015, 0.1, 0.7)
STRESS_SEEDS = 4
WITHHELD_STRESSES = tuple(
    (n, size, ratio, thickness, *nu)
    for n, size in ((96, 12.0), (160, 24.0), (224, 10.0))
    for ratio, nu in (
        *((0.3, (NU, NU)), (0.6, (0.35, 0.25)), (1.0, (NU, NU)), (1.7, (0.2, 0.4))),
        *((2.6, (NU, NU)), (4.2, (0.22, 0.3))),
    )
    for thickness in (0.25, 0.75, 1.8, 5.0, 20.0, 60.0)
)
"""Points, side over β, E1/E2, thickness over λ and Poisson's ratios of contacts whose stresses no
fit has seen."""

UNDER_SPOTS = (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.5, 2.0, 3.0, 5.0)
BELOW_INTERFACE = (0.15, 0.3, 0.5, 0.8, 1.2, 2.0, 3.5)
"""Depths in pixels from the surface and from the interface."""


def roots(surface: asp.Surface, solid: Any, thickness: float, pressure: float) -> dict[str, float]:
    """Largest pressure, and largest √J₂ in the layer and in the base; ``thickness`` in m."""
    pixel = surface.grid.spacing[0]
    layer = [pixel * part for part in UNDER_SPOTS if pixel * part < thickness]
    layer += [thickness * part for part in (0.1, 0.25, 0.5, 0.75, 0.9, 1.0)]  # the last is both sides of the interface
    base = [thickness + pixel * part for part in BELOW_INTERFACE]
    base += [thickness * (1.0 + part) for part in (0.15, 0.3, 0.6, 1.0)]
    result = asp.solve(asp.ContactProblem(surface, solid, law=HARD), asp.MeanPressure(pressure), keep=KEEP)
    found = {"peak": float(result.pressure.max()), "layer": 0.0, "base": 0.0, "pixels": result.area_fraction}
    for field in asp.stresses.stress_planes(result, np.unique([*layer, *base])):
        key = "base" if field.planes[0].region.index else "layer"
        found[key] = max(found[key], float(field.sqrt_J2.max()))
    return found


def stress_rows(cases: Iterable[tuple[Any, ...]], pressures: Sequence[float], seeds: range) -> Iterator[dict[str, Any]]:
    """Largest √J₂ in layer and base over the largest pressure, means over surfaces, and their
    relative standard deviations."""
    spectrum = ExponentialAutocorrelation(RMS, BETA)
    for n, size, ratio, thickness, *nu in cases:
        grid = grid_of(n, size)
        surfaces = [exponential(n, size, seed) for seed in seeds]
        bare = Waves.of_spectrum(grid, spectrum, body())
        h = thickness * bare.summit_length
        materials = asp.Elastic(ratio * E, nu[0]), asp.Elastic(E, nu[1])
        solid = asp.Layered([asp.Layer(materials[0], thickness=h)], base=materials[1])
        waves = Waves.of_spectrum(grid, spectrum, solid)
        for y in pressures:
            found = averaged([roots(one, solid, h, y * waves.full_contact) for one in surfaces])
            row = {"points": n, "size": size, "nayak": waves.nayak, "ratio": ratio, "thickness": thickness}
            row |= {"nu1": nu[0], "nu2": nu[1], "y": y, "samples": len(surfaces)}
            row |= {"pixels": found["pixels"] * grid.n_points, "peak": found["peak"] / waves.full_contact}
            for key in ("layer", "base"):
                row |= {key: found[key] / found["peak"], f"{key}_sd": found[f"{key}_sd"] / found[key]}
            yield row


def stressed() -> Iterator[dict[str, Any]]:
    """Largest √J₂ in layers and below."""
    cases = itertools.product(STRESS_GRIDS, STRESS_RATIOS, STRESS_THICKNESSES)
    seeds = range(FIRST_SEED, FIRST_SEED + STRESS_SEEDS)
    return stress_rows(((*grid, *other, NU, NU) for grid, *other in cases), STRESS_PRESSURES, seeds)


def poisson_stresses() -> Iterator[dict[str, Any]]:
    """Largest √J₂ at other Poisson's ratios, one of them at a time, on one grid and at one load."""
    pairs = ((0.2, NU), (0.4, NU), (NU, 0.2), (NU, 0.4))
    cases = itertools.product(STRESS_RATIOS, STRESS_THICKNESSES, pairs)
    seeds = range(FIRST_SEED, FIRST_SEED + STRESS_SEEDS)
    return stress_rows(((128, 20.0, *other, *nu) for *other, nu in cases), (0.03,), seeds)


def withheld_stresses() -> Iterator[dict[str, Any]]:
    """Other surfaces, grids, moduli, thicknesses and Poisson's ratios."""
    return stress_rows(WITHHELD_STRESSES, (0.004, 0.05, 0.3), WITHHELD_SEEDS)


CAPPED = (
    *((64, 20.0, 1.0, 1.0, True), (128, 20.0, 1.0, 1.0, True), (256, 20.0, 1.0, 1.0, True)),
    *((128, 16.0, 3.0, 0.15, False), (96, 14.0, 0.4, 0.2, False), (160, 24.0, 1.0, 1.0, False)),
)
"""Points, side over β, E1/E2 and thickness over β, and whether the factor of a hardness is fitted
to them."""

HARDNESSES = (0.3, 0.5, 0.8, 1.2, 1.8, 2.7, 4.0)


def capped() -> Iterator[dict[str, Any]]:
    """Elastic-perfectly plastic contacts on four surfaces each."""
    for n, size, ratio, thickness, fitted in CAPPED:
        solid = body(ratio, thickness)
        s = Waves.of_spectrum(grid_of(n, size), ExponentialAutocorrelation(RMS, BETA), solid).full_contact
        first = FIRST_SEED if fitted else WITHHELD_SEEDS[0]
        surfaces = [exponential(n, size, first + number) for number in range(4)]
        for y in (0.01, 0.03, 0.1, 0.3):
            elastic = averaged([solved(one, solid, y * s, RMS, s) for one in surfaces])
            for hardness in HARDNESSES:
                if y > 0.8 * hardness:
                    continue
                law = asp.Hardness(hardness * s)
                rows = [solved(one, solid, y * s, RMS, s, law) for one in surfaces]
                row = {"fitted": fitted, "points": n, "size": size, "ratio": ratio, "thickness": thickness}
                row |= {"y": y, "hardness": hardness, "u": y / (hardness * elastic["area_pixels"])}
                found = averaged(rows)
                for key in ("area_pixels", "area", "gap"):
                    row |= {key: found[key], f"{key}_elastic": elastic[key]}
                yield row


SHAPES = (
    *((0.0, 3.0), (0.3, 3.2), (-0.3, 3.2), (0.5, 3.5), (-0.5, 3.5), (0.7, 3.9), (-0.7, 3.9), (1.0, 4.6), (-1.0, 4.6)),
    *((0.0, 2.3), (0.0, 2.7), (0.0, 3.5), (0.0, 4.0), (0.0, 5.0)),
)
"""Skewness and kurtosis of surfaces that are not Gaussian."""


def shaped() -> Iterator[dict[str, Any]]:
    """Surfaces of given skewness and kurtosis, four each, beside what Gaussian ones would do."""
    grid = grid_of(256, 20.0)
    for skewness, kurtosis in SHAPES:
        shape = {"skewness": skewness, "kurtosis": kurtosis}
        surfaces = [
            translated(grid, ExponentialAutocorrelation(RMS, BETA), seed=n, **shape) for n in WITHHELD_SEEDS[:4]
        ]
        surfaces = [asp.Surface(one.heights - one.heights.mean(), *grid.spacing, periodic=True) for one in surfaces]
        for y in (0.005, 0.03, 0.2):
            rows = []
            for one in surfaces:
                waves = Waves.of_surface(one, body())
                s, x = waves.full_contact, waves.modulus * waves.rms / waves.length
                groups = Groups(y, y * s / x, waves.nayak, 20.0 * BETA / waves.length, grid.n_points)
                found = solved(one, body(), y * s, waves.rms, s)
                row = {key: found[key] / getattr(predictor(), key)(groups).value - 1.0 for key in ("area", "peak")}
                rows.append(row | {"gap": found["gap"] - predictor().gap(groups).value})
            yield shape | {"y": y} | averaged(rows)


def write(name: str, rows: Iterable[dict[str, Any]], about: str) -> None:
    """Write ``rows`` as they come, with what they are in the first lines."""
    start = perf_counter()
    commit = subprocess.run(["git", "rev-parse", "HEAD"], capture_output=True, text=True, check=True).stdout.strip()
    found = list(rows)
    folder = DATA if name in ("master", "layer", "stress", "stress_poisson") else Path(__file__).parent / "predictor"
    folder.mkdir(exist_ok=True)
    with (folder / f"{name}.csv").open("w", encoding="utf-8", newline="\n") as file:
        file.write(
            f"# {about}\n# made by validation/predictor_table.py at commit {commit}; seeds from {FIRST_SEED}, "
            f"withheld ones from {WITHHELD_SEEDS.start}\n"
        )
        writer = csv.DictWriter(file, list(found[0]), lineterminator="\n")
        writer.writeheader()
        for row in found:
            writer.writerow({key: f"{value:.6g}" if isinstance(value, float) else value for key, value in row.items()})
    print(f"{name}: {len(found)} rows in {perf_counter() - start:.0f} s", flush=True)


def main() -> None:
    """Write the tables that are asked for."""
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("--seeds", type=int, default=16)
    asked.add_argument(
        "--only", default="master,layer,stress,stress_poisson,stress_withheld,withheld,several,capped,shaped"
    )
    given = asked.parse_args()
    makers = {
        "master": (
            lambda: master(given.seeds),
            "contacts of exponential surfaces on a half-space; lengths over the 10 % length",
        ),
        "layer": (
            layer,
            f"factors of one layer at y = {MIDDLE}, slope of their logarithm per decade of y and what it leaves, over "
            f"y = {LAYER_PRESSURES}, {LAYER_SEEDS} surfaces",
        ),
        "withheld": (withheld, "contacts that the tables have not seen, solved and predicted"),
        "several": (several, "contacts with two and three layers, solved and predicted by the one nearest layer"),
        "capped": (capped, "contacts under a hardness over the rms pressure of full contact, beside the elastic ones"),
        "shaped": (shaped, "relative deviation of solved from predicted means of surfaces that are not Gaussian"),
        "stress": (
            stressed,
            "largest sqrt(J2) in a layer and in its base over the largest pressure, means over surfaces, and their "
            "relative standard deviations; thickness over rms gradient / rms curvature",
        ),
        "stress_poisson": (poisson_stresses, "the same with Poisson's ratios other than 0.3"),
        "stress_withheld": (withheld_stresses, "the same of contacts that no fit has seen"),
    }
    for name in given.only.split(","):
        make, about = makers[name]
        write(name, make(), about)


if __name__ == "__main__":
    main()
