"""Surfaces with a prescribed spectrum and prescribed heights at once, by alternating between the two."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np

from ...core.arrays import ComplexArray, RealArray
from ...core.citations import citation_keys
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.parameters import checked
from ...core.spectral import RealTransform, mode_sum, thread_count
from ...core.status import NoProgress, Progress
from ...core.values import Count, Positive, Seed
from ..surface import Surface, generated
from .gaussian import Spectrum
from .non_gaussian import Marginal
from .power_laws import mean_square

_KEYS = ("Schreiber1996", "PerezRafols2019")
_PATIENCE, _SETTLED = 10, 0.97  # the error of the amplitudes has settled when so many iterations leave so much of it
_ERROR_LIMIT = 0.05  # relative error of the amplitudes beyond which spectrum and heights do not go together


@dataclass(frozen=True, eq=False)
class _Target:
    grid: Grid
    amplitude: RealArray
    heights: RealArray
    transform: RealTransform


@checked
def rank_ordered(
    grid: Grid,
    spectrum: Annotated[Spectrum, "spectrum"],
    heights: Annotated[Marginal, "distribution of heights"],
    *,
    seed: Annotated[Seed, "seed of the random numbers; equal seeds give equal surfaces"],
    last: Annotated[Literal["heights", "spectrum"], "whether heights or spectrum are exact in the end"] = "heights",
    tolerance: Annotated[Positive, "relative error of the waves' amplitudes at which to stop"] = 1e-4,
    max_iterations: Annotated[Count, "iterations after which to stop"] = 1000,
    progress: Progress = NoProgress(),
) -> Surface:
    """Periodic surface with the amplitudes of ``spectrum`` and the distribution of ``heights``.

    From a random arrangement of the heights two steps alternate: the amplitudes of the waves are replaced by those of the
    spectrum, then the values by the wanted heights in the same order of rank (Schreiber & Schmitz 1996; Pérez-Ràfols &
    Almqvist 2019). It ends at the ``tolerance``, or when ten more iterations improve the amplitudes by less than 3 %:
    spectra that end at long waves leave errors of 1e-3 to 1e-2 with heavy tails of the heights. The history records the
    error. Spectrum and histogram do not scatter between realisations. Rounding differences between FFT libraries are
    amplified by the ranks: another library gives another realisation.
    ``heights`` are ``HeightMoments``, ``HeightsOf`` a measured surface, ``TwoLevels``, or any with ``sorted_heights`` and
    ``describe``; ``progress`` receives the relative error of the amplitudes.
    Raises InputError if the spectrum cannot carry these heights: a relative error of the amplitudes above 5 % is left.
    """
    psd = spectrum.lattice_psd(grid)
    square = mean_square(grid, psd)
    wanted = heights.sorted_heights(grid.n_points)
    wanted = wanted - wanted.mean()
    wanted *= np.sqrt(square / np.mean(np.square(wanted)))
    amplitude = np.sqrt(psd * (grid.n_points / grid.pixel_area))
    target = _Target(grid, amplitude, wanted, RealTransform(grid.shape, thread_count()))
    values = np.random.Generator(np.random.PCG64(seed)).permutation(wanted).reshape(grid.shape)
    values, iterations, settled = _iterated(values, target, (tolerance, max_iterations), progress)
    error = _amplitude_error(target.transform.forward(values), target)
    if error > _ERROR_LIMIT:
        raise InputError(
            "spectrum and distribution of the heights must go together, but after "
            f"{iterations} iterations the amplitudes are off by {error:.2g}: waves of so few lengths cannot add up to heights "
            f"of {heights.describe()}. Use a broader spectrum or other heights."
        )
    exact = f"amplitudes to {error:.1e}"
    if last == "spectrum":
        values = _with_amplitudes(target.transform.forward(values), target)
        apart = np.sort(values, axis=None) - wanted
        exact = f"heights to {np.sqrt(np.mean(np.square(apart)) / np.mean(np.square(wanted))):.1e}"
    state = f"{iterations} iterations, {'settled' if settled else 'not settled'}, {exact}"
    text = f"rank-ordered, {spectrum.describe(grid)}, {heights.describe()}, {state}, PCG64 seed {seed}"
    keys = (*citation_keys(spectrum), *citation_keys(heights), *_KEYS)
    return generated(grid, values, "rank-ordered", text, citation_keys=keys)


def _iterated(
    values: RealArray, target: _Target, limits: tuple[float, int], progress: Progress
) -> tuple[RealArray, int, bool]:
    """Heights after the last step of ranks, the number of iterations, and whether the amplitudes have settled.

    ``limits`` are the tolerance and the most iterations.
    """
    tolerance, max_iterations = limits
    errors: list[float] = []
    for iteration in range(1, max_iterations + 1):
        modes = target.transform.forward(values)
        errors.append(_amplitude_error(modes, target))
        stalled = len(errors) > _PATIENCE and errors[-1] > _SETTLED * errors[-1 - _PATIENCE]
        if stalled or errors[-1] <= tolerance:
            return values, iteration - 1, True
        order = np.argsort(_with_amplitudes(modes, target), axis=None)
        values = np.empty(target.grid.shape)
        values.ravel()[order] = target.heights
        progress.update(iteration, errors[-1], 0.0)
    return values, max_iterations, False


def _with_amplitudes(modes: ComplexArray, target: _Target) -> RealArray:
    """Values of the ``modes``, which are overwritten, with their phases kept and their amplitudes replaced."""
    magnitude = np.abs(modes)
    modes *= np.divide(target.amplitude, magnitude, out=np.zeros_like(magnitude), where=magnitude > 0.0)
    return target.transform.backward(modes)


def _amplitude_error(modes: ComplexArray, target: _Target) -> float:
    """sqrt(Σ (|F| - |F0|)² / Σ |F0|²) over all modes."""
    missing = mode_sum(target.grid, np.square(np.abs(modes) - target.amplitude))
    return float(np.sqrt(missing / mode_sum(target.grid, np.square(target.amplitude))))
