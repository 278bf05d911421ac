"""Kalker's linear coefficients of rolling, found by rolling without slip at small creepages on five
grids each."""

from __future__ import annotations

import numpy as np
from page import Claim, Page, Published, Table, write_page

import asperity as asp
from asperity.theories.friction.kalker import COMPUTED, RATIOS

PUBLISHED = {
    (0.2, 0.0): (2.59, 2.59, 0.483, 3.46),
    (0.5, 0.0): (2.88, 2.88, 0.827, 1.74),
    (1.0, 0.0): (3.40, 3.40, 1.33, 1.21),
    (2.0, 0.0): (4.37, 4.37, 2.35, 0.958),
    (10.0, 0.0): (10.7, 10.7, 12.2, 0.795),
    (0.3, 0.25): (3.44, 2.75, 0.715, 2.96),
    (0.6, 0.25): (3.72, 3.14, 1.03, 1.68),
    (1.0, 0.25): (4.12, 3.67, 1.47, 1.19),
    (1.25, 0.25): (4.36, 3.99, 1.75, 1.04),
    (2.0, 0.25): (5.10, 4.90, 2.62, 0.819),
    (2.5, 0.25): (5.57, 5.48, 3.24, 0.747),
    (0.1, 0.5): (4.85, 2.53, 0.731, 11.7),
    (0.3, 0.5): (4.80, 2.81, 0.889, 3.72),
    (0.5, 0.5): (4.83, 3.14, 1.07, 2.22),
    (0.8, 0.5): (5.05, 3.65, 1.40, 1.42),
    (2.5, 0.5): (6.57, 6.31, 3.70, 0.549),
    (5.0, 0.5): (8.82, 9.79, 7.89, 0.341),
}
"""C11, C22, C23 and C33 by half-axis along the rolling direction over that across, and Poisson's
ratio (Kalker 1967, 1990)."""

NAMES = ("C11", "C22", "C23", "C33")
SMALL = 1e-6
GRIDS = (40, 56, 80, 112, 160)

ABOUT = (
    "Two equal bodies touch on an ellipse of half-axes a along and b across the rolling direction, and roll "
    "with a creepage so small that nothing slips. Forces on the other body are -abG C11 ξx, -abG C22 ξy - "
    "(ab)^(3/2) G C23 φ, the torque (ab)^(3/2) G C23 ξy - (ab)² G C33 φ. Theirs: the table of Kalker (1967; "
    "1990), three digits. Ours: `asp.roll` with `FullStick` on a flat punch of that shape, which has the same "
    "coefficients, with as many pixels along as across, and a parabola in the pixel taken to zero. No "
    "parameter is chosen."
)

WORDS = """* Both the series of Kalker and our pixels are approximations. The parabola through five grids and
  the line through the last three differ by 0.2 % at most in the rows above (by 1.5 % in C33 at a/b = 10).
* Over all 34 rows of Kalker's that were at hand (a/b from 0.1 to 10) C11, C22 and C23 differ from his by
  0.2 % on the average and by 1 % at most, at a/b = 10; C33 by 0.4 % and 0.9 %.
* One number differs from its neighbours in his table: C11 at a/b = ν = 0.5 is printed as 4.83, and is 4.87 here.
* The 23 other rows of `asp.theories.kalker_coefficients` are ours, by this script (`python
  validation/kalker_table.py computed`); they are no published numbers."""


def page(grids: tuple[int, ...] = GRIDS) -> Page:
    """The page, with so many pixels over either axis of the ellipse on the ``grids``, at least
    three."""
    rows, numbers, off, fits = [], [], [], []
    for (ratio, nu), theirs in PUBLISHED.items():
        ours, line, found = extrapolated(ratio, nu, grids)
        for name, printed, first, last, taken, other in zip(
            NAMES, theirs, found[0], found[-1], ours, line, strict=True
        ):
            rows.append((f"{ratio:g}", f"{nu:g}", name, f"{printed:g}", f"{first:.3f}", f"{last:.3f}", f"{taken:.3f}"))
            where = f"at a/b = {ratio:g}, ν = {nu:g}"
            twice = f"C11 = C22 {where}" if nu == 0.0 and name in NAMES[:2] else ""
            what = f"{name} {where}"
            numbers.append(Published("Kalker 1967", what, f"{printed:g}", float(taken), 0.01, shared=twice))
            off.append(abs(taken / printed - 1.0))
            fits.append(abs(other / taken - 1.0))
    return Page(
        "Kalker's linear coefficients of rolling",
        ABOUT,
        (
            Table(
                f"Coefficients on the coarsest and the finest of grids with {', '.join(map(str, grids))} "
                "pixels over either axis, and extrapolated:",
                ("a/b", "ν", "", "table", f"{grids[0]}", f"{grids[-1]}", "extrapolated"),
                tuple(rows),
            ),
            WORDS,
        ),
        (
            Claim("largest deviation from the table", max(off), high=0.01),
            Claim("largest difference of two ways to extrapolate", max(fits), high=0.01),
        ),
        tuple(numbers),
    )


def extrapolated(ratio: float, nu: float, grids: tuple[int, ...] = GRIDS) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """C11, C22, C23, C33 at no pixel size by a parabola, by a line through the last three, and on
    each of the ``grids``."""
    found = np.array([coefficients(ratio, nu, n) for n in grids])
    size = 1.0 / np.array(grids, dtype=float)
    parabola, line = np.polyfit(size, found, 2)[-1], np.polyfit(size[-3:], found[-3:], 1)[-1]
    return parabola, line, found


def coefficients(ratio: float, nu: float, pixels: int) -> np.ndarray:
    """C11, C22, C23, C33 of an ellipse of area π with ``pixels`` over either axis."""
    body = asp.Elastic(2.0 * (1.0 + nu), nu)  # shear modulus one
    a, b = ratio**0.5, ratio**-0.5
    x, y = (half * (2.0 * (np.arange(pixels + 2) + 0.5) / pixels - 1.0 - 2.0 / pixels) for half in (a, b))
    inside = (x[:, None] / a) ** 2 + (y[None, :] / b) ** 2 < 1.0
    punch = asp.Surface(np.where(inside, 0.0, -1e3), 2.0 * a / pixels, 2.0 * b / pixels)
    problem = asp.ContactProblem(punch, body, counter_body=body, boundary=asp.Free(), friction=asp.friction.FullStick())
    motions = asp.rolling.Creepage(SMALL), asp.rolling.Creepage(0.0, SMALL), asp.rolling.Creepage(0.0, 0.0, SMALL)
    along, across, spin = (asp.roll(problem, asp.Force(1e-3), motion) for motion in motions)
    size = np.sqrt(inside.sum() * punch.grid.pixel_area / np.pi)  # of the pixels, whose rim is a staircase
    return np.array([along.force_x, across.force_y, spin.force_y, spin.torque]) / SMALL / size ** np.array([2, 2, 3, 4])


def computed() -> None:
    """Print the rows of the theory that are no published ones."""
    for nu, places in COMPUTED.items():
        for place in places:
            ours, line, _ = extrapolated(RATIOS[place], nu)
            print(
                f"a/b = {RATIOS[place]:.4g}, ν = {nu:g}:",
                ", ".join(f"{o:.3f} ± {abs(o - other):.3f}" for o, other in zip(ours, line, strict=True)),
            )


if __name__ == "__main__":
    import sys

    computed() if sys.argv[1:] == ["computed"] else write_page(page(), __file__)
