"""Rms height against scan size by three instruments, from 4 to 800 µm: the trend of fig. 4.2 of
Peng (2001), on a surface of known spectrum."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from page import Claim, Page, Stated, Table, statements, write_page
from scan_size import MODEL, VARIANCE, sampled, scans
from scipy.special import spherical_jn

import asperity as asp
from asperity import roughness

SHORTEST = 50e-9
ROLLOFF = MODEL.rolloff_wavelength
SQUARES = {"AFM": (4e-6, 8e-6, 16e-6, 32e-6, 64e-6, 100e-6), "NOP": (256e-6,)}
"""Sides in m of the squares of 256 × 256 points."""

LINES = ((80e-6, 0.02e-6), (400e-6, 0.2e-6), (800e-6, 0.4e-6))
"""Lengths and sampling intervals in m of the stylus profiles."""

APART, STRIP, PITCH = 32, 64e-6, 1e-6
"""Lines that are used of a map of the width ``STRIP`` in m, every so many of its ``PITCH``."""

WINDOW = 20e-6
"""Side in m of the cells that Peng and Bhushan generate, "to cover the long wavelength"."""

ABOUT = (
    "Peng (2001, fig. 4.2, after Poon & Bhushan 1995): σ of six disk substrates by atomic force microscope (AFM, "
    "squares of 4 to 100 µm of 256² points), stylus (SP, lines of 80, 400 and 800 µm at 0.02, 0.2 and 0.4 µm) and "
    "optical profiler (NOP, 256 µm at 1 µm). σ grows with the scan and approaches a constant at about 16 µm. The data "
    "are in the figure only, and the surfaces are not at hand: here the same scans are made of random surfaces of one "
    "spectrum, that of [scan_size](scan_size.md): roll-off at 16 µm, Hurst exponent 0.8, shortest wave 50 nm, chosen "
    "freely. Heights are in units of the rms height of the infinite surface; expected values are integrals over the "
    "spectrum. An instrument is its size and its points here; its tip, its spot and its noise are left out."
)

WORDS = (
    "The three instruments see one curve: the size of the scan over the roll-off decides, not the instrument nor its "
    "sampling interval, as long as the height is in waves that it samples. Lines see less than squares of their "
    "length where that is short, and as much where it is long. The curve bends at one roll-off wavelength and is "
    "within 5 % of its limit at two: the published 16 µm, read as the longest wave of the surface, is its roll-off."
)


@dataclass(frozen=True)
class Scan:
    """Mean square heights (scans,) of one instrument and size, with what is expected."""

    instrument: str
    size: float
    interval: float
    squares: np.ndarray
    expected: float


def expected(size: float, *, line: bool = False) -> float:
    """Mean square height of a levelled square or line of the ``size`` in m, of unit variance."""
    if not line:
        found = roughness.mean_square_after_levelling(MODEL.psd, (size, size), "plane", shortest_wavelength=SHORTEST)
        return found / VARIANCE
    high = 2.0 * math.pi / SHORTEST
    q = np.geomspace(1e-4 / size, high, 4001)
    across = high * np.sinh(np.linspace(0.0, np.arcsinh(1e5), 2001)) / 1e5
    profile = np.array([np.trapezoid(MODEL.psd(np.hypot(one, across)), across) for one in q]) / np.pi
    left = 1.0 - spherical_jn(0, 0.5 * q * size) ** 2 - 3.0 * spherical_jn(1, 0.5 * q * size) ** 2
    return float(np.trapezoid(profile * left, q) / np.pi / VARIANCE)


def lines(length: float, interval: float, count: int) -> np.ndarray:
    """Mean square heights of ``count`` lines at least, less their mean and slope."""
    kept = round(length / interval)
    nodes = (kept + math.ceil(2.0 * ROLLOFF / interval) + 1) // 2 * 2
    grid = asp.Grid((nodes, round(STRIP / PITCH)), (interval, PITCH))
    spectrum, found = sampled(grid), []
    x = np.arange(kept) - 0.5 * (kept - 1)
    for seed in range(math.ceil(count * APART * PITCH / STRIP)):
        heights = asp.generate.gaussian(grid, spectrum, seed=seed).heights[:kept, ::APART]
        heights = heights - heights.mean(axis=0)
        heights = heights - np.outer(x, x @ heights / (x @ x))
        found.append((heights**2).mean(axis=0))
    return np.concatenate(found)


def compare(count: int = 24) -> Page:
    """The page, from ``count`` scans of each instrument and size."""
    found = [
        Scan(
            name,
            side,
            side / 256,
            np.array([one["Sq"] ** 2 for one in scans(side, count)]),
            expected(side),
        )
        for name, sides in SQUARES.items()
        for side in sides
    ]
    found += [
        Scan("SP", length, interval, lines(length, interval, count), expected(length, line=True))
        for length, interval in LINES
    ]
    found.sort(key=lambda one: one.size)
    rows = tuple(
        (
            one.instrument,
            f"{1e6 * one.size:g}",
            f"{1e6 * one.interval:.3g}",
            f"{math.sqrt(one.expected):.3f}",
            f"{math.sqrt(one.squares.mean()):.3f}",
            f"{np.sqrt(one.squares).std(ddof=1):.3f}",
        )
        for one in found
    )
    head = ("instrument", "size (µm)", "interval (µm)", "σ expected", "σ", "deviation of one scan")
    return Page(
        "Rms height against scan size by three instruments",
        ABOUT,
        (Table(f"{count} scans each:", head, rows), _stated(found), WORDS),
        _claims(found),
    )


def _rms(found: list[Scan], instrument: str) -> dict[float, float]:
    return {one.size: math.sqrt(one.squares.mean()) for one in found if one.instrument == instrument}


def _stated(found: list[Scan]) -> Table:
    afm, long = _rms(found, "AFM"), {**_rms(found, "SP"), **_rms(found, "NOP")}
    wide = [value for size, value in long.items() if size > 100e-6]
    return statements(
        "What the text states of the figure:",
        (
            Stated(
                "σ initially increases with the scan size",
                f"{afm[4e-6]:.2f}, {afm[8e-6]:.2f}, {afm[16e-6]:.2f} at 4, 8 and 16 µm",
                afm[4e-6] < afm[8e-6] < afm[16e-6],
            ),
            Stated(
                "it approaches a constant at about 16 µm",
                f"{afm[16e-6]:.2f} at 16 µm, {afm[32e-6]:.2f} at 32, {min(wide):.2f} to {max(wide):.2f} beyond 100",
                afm[16e-6] > 0.75 and afm[32e-6] > 0.9,
                "of a spectrum with its roll-off there",
            ),
            Stated(
                "cells of 20 µm cover the long waves",
                f"σ of such windows is {math.sqrt(expected(WINDOW)):.2f} of its limit",
                math.sqrt(expected(WINDOW)) > 0.95,
                "the longest waves are missing from windows of the size of their roll-off",
            ),
        ),
    )


def _claims(found: list[Scan]) -> tuple[Claim, ...]:
    claims = []
    for one in found:
        error = 5.0 * one.squares.std(ddof=1) / math.sqrt(one.squares.size) + 3e-3 * one.expected
        text = f"mean square height, {one.instrument} of {1e6 * one.size:g} µm"
        claims.append(Claim(text, float(one.squares.mean()), one.expected - error, one.expected + error))
    square, line = (math.sqrt(expected(256e-6, line=flag)) for flag in (False, True))
    near = math.sqrt(expected(16e-6, line=True) / expected(16e-6))
    return (
        *claims,
        Claim("expected σ of lines over that of squares, 256 µm", line / square, 0.95, 1.0),
        Claim("the same, 16 µm", near, high=0.95),
        Claim("expected σ of 32 µm, of its limit", math.sqrt(expected(32e-6)), 0.94, 0.97),
    )


if __name__ == "__main__":
    write_page(compare(), __file__)
