"""Cost of a stress plane against six bare inverse transforms of its size, in one interleaved run,
and of its maxima, with the edges of a contact too.

python benchmarks/stress.py --size 1024 --threads 2 --repeats 15
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable

import numpy as np

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


def periodic(n: int, threads: int, repeats: int) -> None:
    """Print the ratio of a plane to six inverse transforms for every body, load and precision."""
    rng = np.random.default_rng(0)
    grid, pressure = asp.Grid((n, n), (DX, DX)), rng.random((n, n))
    print(
        f"{'precision':9} {'body':11} {'load':13} {'6 inverse FFTs':>14} {'plane':>8} {'ratio':>6}   (ms, "
        f"medians of {repeats})"
    )
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
                print(f"{dtype:9} {name:11} {load:13} {six:14.2f} {one:8.2f} {one / six:6.2f}")


def searched(n: int, threads: int, repeats: int) -> None:
    """Print the time of a plane that is kept, and of one that is read for its maxima, at several
    depths."""
    rough = np.fft.irfft2(np.fft.rfft2(np.random.default_rng(0).standard_normal((n, n))) * smooth(n), s=(n, n))
    pressure = np.maximum(rough / rough.std() - 1.0, 0.0)
    loads = Tractions(asp.Grid((n, n), (DX, DX)), pressure, asp.stresses.Sliding(0.3))
    print(f"\nmaxima of a plane, one layer, sliding: ms, medians of {repeats}")
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
            print(
                f"{dtype:9} depth {depth / DX:4.0f} pixels: plane {one:6.1f}, read with its maxima found {search:6.1f}"
            )


def smooth(n: int) -> np.ndarray:
    """Filter (n, n // 2 + 1) that leaves waves longer than about 30 pixels."""
    frequency = np.hypot(*np.meshgrid(np.fft.fftfreq(n), np.fft.rfftfreq(n), indexing="ij"))
    return np.exp(-((30.0 * frequency) ** 2))


def at_edges(n: int, repeats: int) -> None:
    """Print the time of a solve, of its surface stress under sliding, and of the largest tension
    with the edges of the contact."""
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
    print(f"\nlargest tension with the edges of a sliding contact, {n}²: ms, medians of {repeats}")
    print(
        f"solve {solve:.1f}, surface plane {plane:.1f}, largest tension {largest:.1f} ({largest / solve:.2f} "
        "of a solve)"
    )


def free(n: int, threads: int) -> None:
    """Print the time of a plane with nothing outside the grid: influence coefficients, their
    transforms, the products."""
    grid, pressure = asp.Grid((n, n), (DX, DX)), np.random.default_rng(0).random((n, n))
    print(f"\nfree boundary, {n}²: seconds for one plane")
    for name, body in BODIES.items():
        for load, shear in (("pressure", asp.stresses.Sliding(0.0)), ("sliding", asp.stresses.Sliding(0.3, 0.4))):
            source = FreePlanes(Tractions(grid, pressure, shear, "free"), body, threads=threads)
            seconds = 1e-3 * milliseconds(lambda s=source, b=body: s.stress(planes(b, [DEPTH])[0]))
            print(f"{name:11} {load:13} {seconds:6.2f}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=int, default=1024, help="points along a side")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--repeats", type=int, default=15)
    parser.add_argument("--no-free", action="store_true", help="leave out the free boundary")
    options = parser.parse_args()
    print(f"{options.size}², {options.threads} threads, transforms by {fft_library()}")
    periodic(options.size, options.threads, options.repeats)
    searched(options.size, options.threads, options.repeats)
    at_edges(options.size, options.repeats)
    if not options.no_free:
        free(options.size, options.threads)
