"""Time to generate surfaces of every random kind, beside one real FFT pair of the same size.

Usage: python benchmarks/generation.py [--sizes 1024 4096] [--threads 2] [--repeats 3] [--all]
[--write]

Medians of the rounds; ``beyond`` is the time without the pair, ``pairs`` the time over it. Kinds
that iterate (rank ordering) or add up particles are timed on the smallest size only, unless
``--all`` is given.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable

from tables import add_option, made, show
from topography import median_time, pair

import asperity as asp

g = asp.generate


def kinds(n: int) -> dict[str, Callable[[], object]]:
    """Generators by name, on n x n unit pixels."""
    grid = asp.Grid((n, n), (1.0, 1.0))
    band = g.SelfAffine(amplitude=g.RmsHeight(1.0), hurst=0.8, rolloff_wavelength=n / 4, shortest_wavelength=8.0)
    decay = g.ExponentialAutocorrelation(1.0, 16.0)
    return {
        "self-affine": lambda: g.gaussian(grid, band, seed=1),
        "self-affine, fixed amplitudes": lambda: g.gaussian(grid, band, seed=1, variant="fixed"),
        "self-affine, nested": lambda: g.gaussian(grid, band, seed=1, variant="nested"),
        "exponential autocorrelation": lambda: g.gaussian(grid, decay, seed=1),
        "window of a periodic surface": lambda: g.gaussian(grid, decay, seed=1, periodic=False),
        "digital filter": lambda: g.digital_filter(grid, decay, seed=1),
        "digital filter, skewness 0.2, kurtosis 4": lambda: g.digital_filter(
            grid, decay, seed=1, skewness=0.2, kurtosis=4.0
        ),
        "translation to -1, 4": lambda: g.translated(grid, decay, seed=1, skewness=-1.0, kurtosis=4.0),
        "translation to -1, 4, Pearson": lambda: g.translated(
            grid, decay, seed=1, skewness=-1.0, kurtosis=4.0, system="pearson"
        ),
        "two processes": lambda: g.two_process(grid, decay, decay, offset=1.0, seed=1),
        "Weierstrass-Mandelbrot": lambda: g.weierstrass_mandelbrot(grid, dimension=2.4, roughness=1e-3, seed=1),
    }


def slow_kinds(n: int) -> dict[str, Callable[[], object]]:
    """Generators whose time is not a few transforms."""
    grid = asp.Grid((n, n), (1.0, 1.0))
    decay = g.ExponentialAutocorrelation(1.0, 16.0)
    return {
        "rank ordering to -1, 4": lambda: g.rank_ordered(grid, decay, g.HeightMoments(-1.0, 4.0), seed=1),
        "particles, 0.001 per pixel": lambda: g.particles(grid, decay, density=1e-3, radius=6.0, seed=1),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", type=int, nargs="+", default=[1024, 4096])
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--all", action="store_true")
    add_option(parser)
    options = parser.parse_args()
    rows = []
    os.environ["ASPERITY_THREADS"] = str(options.threads)
    for work in kinds(64).values():  # imports
        work()
    for n in options.sizes:
        one = median_time(pair(n, options.threads), options.repeats)
        print(f"{n} x {n} points, {options.threads} threads, FFT pair {one:.3f} s", flush=True)
        works = kinds(n) | (slow_kinds(n) if options.all or n == min(options.sizes) else {})
        for name, work in works.items():
            took = median_time(work, options.repeats)
            rows.append([n, name, f"{took:.2f}", f"{took - one:.2f}", f"{took / one:.1f}"])
    columns = ("n", "surface", "s", "s beyond a pair", "pairs")
    show(made("generate", columns, rows), write=options.write)


if __name__ == "__main__":
    main()
