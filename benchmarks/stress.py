"""Cost of a stress plane against six bare inverse transforms of its size, in one interleaved run,
and of its maxima.

python benchmarks/stress.py --size 1024 --threads 2 --repeats 15
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections import defaultdict
from collections.abc import Callable

import numpy as np
from tables import Table, add_option, made, show

import asperity as asp
from asperity.core.spectral import RealTransform, fft_library
from asperity.core.tensor import STRESSES, StressTensor
from asperity.physics.stress.boundaries import FreePlanes, PeriodicPlanes
from asperity.physics.stress.criteria import VonMises
from asperity.physics.stress.extremes import Extremes
from asperity.physics.stress.regions import planes
from asperity.physics.stress.tractions import Tractions

DX = 10e-9
SUBSTRATE = asp.Elastic(70e9, 0.33)
BODIES = {
    "half-space": SUBSTRATE,
    "1 layer": asp.Layered([asp.Layer(asp.Elastic(280e9, 0.25), 5 * DX)], SUBSTRATE),
    "5 layers": asp.Layered([asp.Layer(asp.Elastic(280e9 - k * 40e9, 0.25), 2 * DX) for k in range(5)], SUBSTRATE),
}
DEPTH = 3 * DX


def milliseconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return 1e3 * (time.perf_counter() - start)


def shears(
    shape: tuple[int, int], rng: np.random.Generator
) -> dict[str, asp.stresses.Sliding | asp.stresses.ShearTraction]:
    """Pressure alone, shear in proportion to it along an axis and askew, shear of its own."""
    fields = asp.stresses.ShearTraction(*rng.standard_normal((2, *shape)))
    return {
        "pressure": asp.stresses.Sliding(0.0),
        "along x": asp.stresses.Sliding(0.3),
        "sliding": asp.stresses.Sliding(0.3, 0.4),
        "shear fields": fields,
    }


def periodic(n: int, threads: int, repeats: int) -> Table:
    """Ratio of a plane to six inverse transforms for every precision and load, least and largest of
    all bodies."""
    rng = np.random.default_rng(0)
    grid, pressure = asp.Grid((n, n), (DX, DX)), rng.random((n, n))
    times: dict[tuple[str, str], list[tuple[float, float]]] = defaultdict(list)
    for dtype in ("float64", "float32"):
        transform = RealTransform((n, n), threads)
        given = transform.forward(pressure.astype(dtype))
        spectra = [np.empty_like(given) for _ in STRESSES]
        fields = [np.empty((n, n), dtype) for _ in STRESSES]

        def bare(given=given, spectra=spectra, fields=fields, transform=transform) -> float:
            for spectrum in spectra:  # which transforms overwrite, and numbers that shrink to denormal ones are slow
                spectrum[...] = given
            return milliseconds(lambda: [transform.backward(s, f) for s, f in zip(spectra, fields, strict=True)])

        for name, body in BODIES.items():
            for load, shear in shears((n, n), rng).items():
                source = PeriodicPlanes(Tractions(grid, pressure, shear), body, dtype=dtype, threads=threads)
                out = StressTensor(*(np.empty((n, n), dtype) for _ in STRESSES))
                plane = planes(body, [DEPTH])[0]
                source.stress(plane, out)
                rounds = [
                    (bare(), milliseconds(lambda s=source, p=plane, o=out: s.stress(p, o))) for _ in range(repeats)
                ]
                six, one = (statistics.median(column) for column in zip(*rounds, strict=True))
                times[dtype, load].append((six, one))
                print(f"{dtype:9} {name:11} {load:13} {six:14.2f} {one:8.2f} {one / six:6.2f}", flush=True)
    rows = []
    for (dtype, load), both in times.items():
        six, one = (statistics.fmean(column) for column in zip(*both, strict=True))
        least, most = (extreme(plane / bare for bare, plane in both) for extreme in (min, max))
        rows.append([n, dtype, load, f"{six:.1f}", f"{one:.1f}", f"{least:.2f}–{most:.2f}"])
    columns = ("n", "precision", "load", "six inverse transforms (ms)", "plane (ms)", "ratio, all bodies")
    return made("stress-planes", columns, rows)


def searched(n: int, threads: int, repeats: int) -> Table:
    """Time of a plane that is kept, and of one that is read for its maxima, at several depths."""
    rough = np.fft.irfft2(np.fft.rfft2(np.random.default_rng(0).standard_normal((n, n))) * smooth(n), s=(n, n))
    pressure = np.maximum(rough / rough.std() - 1.0, 0.0)
    loads = Tractions(asp.Grid((n, n), (DX, DX)), pressure, asp.stresses.Sliding(0.3))
    rows = []
    for dtype in ("float64", "float32"):
        source = PeriodicPlanes(loads, BODIES["1 layer"], dtype=dtype, threads=threads)
        for depth in (0.0, 3 * DX, 20 * DX, 200 * DX):
            plane = planes(BODIES["1 layer"], [depth])[0]
            found = Extremes(loads.grid, VonMises())
            rounds = [
                (
                    milliseconds(lambda s=source, p=plane: s.stress(p)),
                    milliseconds(lambda s=source, p=plane, f=found: f.take(p, s.read)),
                )
                for _ in range(repeats)
            ]
            one, search = (statistics.median(column) for column in zip(*rounds, strict=True))
            rows.append([n, dtype, f"{depth / DX:.0f}", f"{one:.1f}", f"{search:.1f}"])
    columns = ("n", "precision", "depth (pixels)", "plane (ms)", "read for its maxima (ms)")
    return made("stress-maxima", columns, rows)


def smooth(n: int) -> np.ndarray:
    """Filter (n, n // 2 + 1) that leaves waves longer than about 30 pixels."""
    frequency = np.hypot(*np.meshgrid(np.fft.fftfreq(n), np.fft.rfftfreq(n), indexing="ij"))
    return np.exp(-((30.0 * frequency) ** 2))


def at_edges(n: int, repeats: int) -> Table:
    """Time of a solve, of its surface stress under sliding, and of the largest tension with the
    edges of the contact."""
    spectrum = asp.generate.SelfAffine(
        hurst=0.8,
        rolloff_wavelength=n * DX / 8,
        shortest_wavelength=10 * DX,
        amplitude=asp.generate.RmsSlope(0.1),
    )
    surface = asp.generate.gaussian(asp.Grid((n, n), (DX, DX)), spectrum, seed=1)
    problem, load = asp.ContactProblem(surface, SUBSTRATE), asp.MeanPressure(4e8)
    rounds = []
    for _ in range(repeats):
        found: list[object] = []
        solve = milliseconds(lambda found=found: found.append(asp.solve(problem, load)))
        plane = milliseconds(lambda found=found: found.append(asp.stress(found[0], [0.0], friction=0.3)))
        rounds.append((solve, plane, milliseconds(lambda found=found: found[1].largest_tension)))
    solve, plane, largest = (statistics.median(column) for column in zip(*rounds, strict=True))
    columns = ("n", "solve (ms)", "surface plane (ms)", "largest tension (ms)", "over the solve")
    row = [n, f"{solve:.1f}", f"{plane:.1f}", f"{largest:.1f}", f"{largest / solve:.2f}"]
    return made("stress-edges", columns, [row])


def free(n: int, threads: int) -> Table:
    """Time of a plane with nothing outside the grid: influence coefficients, their transforms, the
    products."""
    grid, pressure = asp.Grid((n, n), (DX, DX)), np.random.default_rng(0).random((n, n))
    rows = []
    for name, body in BODIES.items():
        for load, shear in (("pressure", asp.stresses.Sliding(0.0)), ("sliding", asp.stresses.Sliding(0.3, 0.4))):
            source = FreePlanes(Tractions(grid, pressure, shear, "free"), body, threads=threads)
            seconds = 1e-3 * milliseconds(lambda s=source, b=body: s.stress(planes(b, [DEPTH])[0]))
            rows.append([n, name, load, f"{seconds:.2f}"])
    return made("stress-free", ("n", "body", "load", "a plane (s)"), rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=int, default=1024, help="points along a side")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--repeats", type=int, default=15)
    parser.add_argument("--no-free", action="store_true", help="leave out the free boundary")
    add_option(parser)
    options = parser.parse_args()
    print(f"{options.size}², {options.threads} threads, transforms by {fft_library()}")
    size, threads, repeats = options.size, options.threads, options.repeats
    found = [periodic(size, threads, repeats), searched(size, threads, repeats), at_edges(size, repeats)]
    show(*found, *([] if options.no_free else [free(size, threads)]), write=options.write)
