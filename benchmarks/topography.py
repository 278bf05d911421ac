"""Time to generate and to characterise surfaces, and what the parts of a characterisation take.

Usage: python benchmarks/topography.py [--sizes 512 1024 2048] [--threads 2] [--repeats 3] [--write]

The surface is not periodic and has no missing points, the most work: spectra are windowed and the
autocovariance padded. Medians of the rounds; ``pairs`` is the time over that of one real FFT pair
of the same size on the same threads.
"""

from __future__ import annotations

import argparse
import os
import statistics
import time
from collections.abc import Callable

import numpy as np
from surfaces import self_affine
from tables import add_option, made, show

import asperity as asp
from asperity import roughness as r


def parts(surface: asp.Surface) -> dict[str, Callable[[], object]]:
    """Work by name; the whole first."""
    curve = r.material_ratio_curve(surface)
    spectrum = r.power_spectrum(surface)
    covariance = r.autocovariance(surface)
    return {
        "everything": lambda: asp.characterise(surface),
        "heights": lambda: r.height_parameters(surface),
        "material ratio": lambda: r.functional_parameters(r.material_ratio_curve(surface)),
        "core alone": lambda: r.functional_parameters(curve),
        "spectrum, radial": lambda: r.radial_spectrum(r.power_spectrum(surface)),
        "spectra of profiles": lambda: [r.profile_spectrum(surface, axis=axis) for axis in "xy"],
        "fit of the spectrum": lambda: r.fit_spectrum(spectrum, model_error=0.1),
        "autocovariance": lambda: r.autocovariance(surface),
        "Sal, Str": lambda: r.texture_lengths(covariance),
        "structure functions": lambda: [r.structure_function(surface, axis=axis) for axis in "xy"],
        "scale dependence": lambda: [r.scale_dependence(surface, axis=axis) for axis in "xy"],
        "moments": lambda: (r.difference_moments(surface), r.spectral_moments(spectrum)),
        "developed area": lambda: r.developed_area_ratio(surface),
        "summits": lambda: (r.summits(surface), r.summits(surface, 4)),
        "peaks of profiles": lambda: [r.profile_peaks(surface, axis=axis) for axis in "xy"],
    }


def pair(n: int, threads: int) -> Callable[[], object]:
    """One real FFT pair with preallocated arrays."""
    from asperity.core.spectral import RealTransform

    transform, field = RealTransform((n, n), threads), np.random.default_rng(0).standard_normal((n, n))
    spectrum = transform.forward(field)
    return lambda: transform.backward(transform.forward(field, out=spectrum), out=field)


def median_time(work: Callable[[], object], repeats: int) -> float:
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", type=int, nargs="+", default=[512, 1024, 2048])
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--repeats", type=int, default=3)
    add_option(parser)
    options = parser.parse_args()
    rows = []
    os.environ["ASPERITY_THREADS"] = str(options.threads)
    asp.characterise(self_affine(64))  # imports
    for n in options.sizes:
        generated = self_affine(n)
        surface = asp.levelled(asp.Surface(generated.heights, generated.dx))
        one = median_time(pair(n, options.threads), options.repeats)
        print(f"{n} x {n} points, {options.threads} threads, FFT pair {1e3 * one:.1f} ms", flush=True)
        rows.append([n, "generation", f"{median_time(lambda n=n: self_affine(n), options.repeats):.3f}", None])
        for name, work in parts(surface).items():
            took = median_time(work, options.repeats)
            rows.append([n, name, f"{took:.3f}", f"{took / one:.0f}"])
    show(made("characterise", ("n", "work", "s", "pairs"), rows), write=options.write)


if __name__ == "__main__":
    main()
