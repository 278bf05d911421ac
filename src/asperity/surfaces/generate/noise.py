"""White noise: standard normal numbers in an order that no machine, thread count or tiling changes.

Streams are those of NumPy's bit generators PCG64 and Philox (Salmon et al. 2011), which NumPy keeps fixed, turned into
normal numbers by ``Generator.standard_normal``; a test holds their first values.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...core.arrays import ComplexArray, RealArray

BLOCK = 64
"""Nodes along the side of a block of noise that has a stream of its own."""


def sub_seeds(seed: int, count: int) -> tuple[int, ...]:
    """Seeds of ``count`` independent streams that belong to one ``seed``, by NumPy's ``SeedSequence``."""
    return tuple(int(number) for number in np.random.SeedSequence(seed).generate_state(count, np.uint64))


def node_noise(shape: tuple[int, int], seed: int) -> RealArray:
    """White noise at the nodes (nx, ny): PCG64 of ``seed``, drawn in the order of the array."""
    return np.random.Generator(np.random.PCG64(seed)).standard_normal(shape)


def noise_rows(shape: tuple[int, int], seed: int, rows: int) -> Iterator[RealArray]:
    """:func:`node_noise`, ``rows`` rows (the last time fewer) at a time."""
    draw = np.random.Generator(np.random.PCG64(seed))
    for start in range(0, shape[0], rows):
        yield draw.standard_normal((min(rows, shape[0] - start), shape[1]))


def block_noise(first: tuple[int, int], shape: tuple[int, int], seed: int) -> RealArray:
    """White noise (nx, ny) at the nodes of an infinite lattice from the node ``first`` (of either sign) on.

    The lattice is cut into blocks of 64 x 64 nodes. Block (bx, by) is drawn from Philox with the key ``seed`` and the
    counter (0, 0, bx, by), so that each node has the same number in whatever window it is asked for.
    """
    noise = np.empty(shape)
    starts_x, starts_y = (range(f // BLOCK, -(-(f + n) // BLOCK)) for f, n in zip(first, shape, strict=True))
    for block_x in starts_x:
        for block_y in starts_y:
            inside, part = [], []
            for block, f, n in zip((block_x, block_y), first, shape, strict=True):
                low, high = max(f, block * BLOCK), min(f + n, (block + 1) * BLOCK)
                inside.append(slice(low - f, high - f))
                part.append(slice(low - block * BLOCK, high - block * BLOCK))
            noise[inside[0], inside[1]] = _block(block_x, block_y, seed)[part[0], part[1]]
    return noise


def wave_noise(shape: tuple[int, int], seed: int) -> ComplexArray:
    """FFT (nx, ny // 2 + 1) of white noise whose waves are numbered by their whole wavenumbers (kx, ky).

    The complex amplitudes are drawn (PCG64 of ``seed``) ring by ring of max(|kx|, |ky|), so a finer grid of the same size
    has the waves of the coarser one and further ones. The zero mode is zero.
    """
    (nx, ny), draw = shape, np.random.Generator(np.random.PCG64(seed))
    half = np.zeros((nx, ny // 2 + 1), dtype=complex)
    for ring in range(1, max(nx, ny) // 2 + 1):
        waves = draw.standard_normal(8 * ring).view(complex)  # 4 ring waves; the opposite ones are their conjugates
        _place(half, shape, ring, waves)
    _make_hermitian(half, ny)
    half *= np.sqrt(0.5 * nx * ny)
    return half


def _block(block_x: int, block_y: int, seed: int) -> RealArray:
    counter = np.array([0, 0, block_x % 2**64, block_y % 2**64], dtype=np.uint64)
    return np.random.Generator(np.random.Philox(key=seed, counter=counter)).standard_normal((BLOCK, BLOCK))


def _place(half: ComplexArray, shape: tuple[int, int], ring: int, waves: ComplexArray) -> None:
    """Put the waves of one ring, in the order (r, 0…r), (-r, 1…r), (-r+1…r-1, r), where the grid has them."""
    nx, ny = shape
    top_x, top_y = nx // 2, ny // 2
    if ring <= top_x:
        count = min(ring, top_y)
        half[ring, : count + 1] = waves[: count + 1]
        if 2 * ring != nx:
            half[-ring, 1 : count + 1] = waves[ring + 1 : ring + 1 + count]
    if ring <= top_y:
        across = waves[2 * ring + 1 :]  # kx from -r + 1 to r - 1
        reach = min(ring - 1, top_x)
        half[: reach + 1, ring] = across[ring - 1 : ring + reach]
        negative = min(ring - 1, (nx - 1) // 2)
        if negative:
            half[-negative:, ring] = across[ring - 1 - negative : ring - 1]


def _make_hermitian(half: ComplexArray, ny: int) -> None:
    """Give the columns that are their own mirror image (ky = 0 and the Nyquist column) the symmetry of a real field."""
    nx = half.shape[0]
    for column in (0, ny // 2) if ny % 2 == 0 else (0,):
        positive = half[1 : (nx - 1) // 2 + 1, column]
        if positive.size:
            half[-positive.size :, column] = positive[::-1].conj()
        for row in (0, nx // 2) if nx % 2 == 0 else (0,):
            half[row, column] = np.sqrt(2.0) * half[row, column].real
