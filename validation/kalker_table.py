"""Kalker's linear coefficients of rolling, found by rolling without slip at small creepages on two grids each."""

from __future__ import annotations

import numpy as np
from page import Claim, Page, Published, Table, write_page

import asperity as asp

PUBLISHED = {
    (0.6, 0.25): (3.72, 3.14, 1.03, 1.68),
    (1.0, 0.0): (3.40, 3.40, 1.33, 1.21),
    (1.0, 0.25): (4.12, 3.67, 1.47, 1.19),
    (2.0, 0.25): (5.10, 4.90, 2.62, 0.819),
}
"""C11, C22, C23 and C33 by half-axis along the rolling direction over that across, and Poisson's ratio (Kalker 1967, 1990)."""

NAMES = ("C11", "C22", "C23", "C33")
SMALL = 1e-6

ABOUT = (
    "Two equal bodies touch on an ellipse of half-axes a along and b across the rolling direction, and roll with a creepage so small that nothing slips. Forces on the other body are "
    "-abG C11 ξx, -abG C22 ξy - (ab)^(3/2) G C23 φ, the torque (ab)^(3/2) G C23 ξy - (ab)² G C33 φ. Theirs: the table of Kalker (1967; 1990), three digits. Ours: `asp.roll` with `FullStick` on a flat "
    "punch of that shape, which has the same coefficients, on grids whose error falls with the pixel, extrapolated from two of them. No parameter is chosen."
)

WORDS = """* Both the series of Kalker and our pixels are approximations: his table is good to about half a per cent, the extrapolation to one.
* On the grids themselves C11 and C22 are within two per cent, C23 is up to two and a half per cent too small and C33, which hangs most on the edge, up to eleven per cent too large."""


def page(pixels: tuple[int, int] = (48, 96)) -> Page:
    """The page, with so many ``pixels`` over the longer axis of the ellipse on the two grids, the second twice the first."""
    rows, numbers, off = [], [], []
    for (ratio, nu), theirs in PUBLISHED.items():
        coarse, fine = (coefficients(ratio, nu, n) for n in pixels)
        ours = 2.0 * fine - coarse
        for name, printed, one, two, found in zip(NAMES, theirs, coarse, fine, ours, strict=True):
            rows.append((f"{ratio:g}", f"{nu:g}", name, f"{printed:g}", f"{one:.3f}", f"{two:.3f}", f"{found:.3f}"))
            numbers.append(
                Published("Kalker 1967", f"{name} at a/b = {ratio:g}, ν = {nu:g}", f"{printed:g}", float(found), 0.02)
            )
            off.append(abs(found / printed - 1.0))
    return Page(
        "Kalker's linear coefficients of rolling",
        ABOUT,
        (
            Table(
                f"Coefficients on grids with {pixels[0]} and {pixels[1]} pixels over the longer axis, and extrapolated:",
                ("a/b", "ν", "", "table", f"{pixels[0]}", f"{pixels[1]}", "extrapolated"),
                tuple(rows),
            ),
            WORDS,
        ),
        (Claim("largest deviation from the table", max(off), high=0.02),),
        tuple(numbers),
    )


def coefficients(ratio: float, nu: float, pixels: int) -> np.ndarray:
    """C11, C22, C23, C33 of an ellipse of area π with ``pixels`` over its longer axis."""
    body = asp.Elastic(2.0 * (1.0 + nu), nu)  # shear modulus one
    a, b = ratio**0.5, ratio**-0.5
    spacing = 2.0 * max(a, b) / pixels
    shape = tuple(int(np.ceil(2.0 * half / spacing)) + 4 for half in (a, b))
    x, y = ((np.arange(n) - 0.5 * (n - 1)) * spacing for n in shape)
    inside = (x[:, None] / a) ** 2 + (y[None, :] / b) ** 2 < 1.0
    punch = asp.Surface(np.where(inside, 0.0, -1e3), spacing, spacing)
    problem = asp.ContactProblem(punch, body, counter_body=body, boundary=asp.Free(), friction=asp.FullStick())
    along, across, spin = (
        asp.roll(problem, asp.Force(1e-3), motion, tolerance=1e-5)
        for motion in (asp.Creepage(SMALL), asp.Creepage(0.0, SMALL), asp.Creepage(0.0, 0.0, SMALL))
    )
    return np.array([along.force_x, across.force_y, spin.force_y, spin.torque]) / SMALL


if __name__ == "__main__":
    write_page(page(), __file__)
