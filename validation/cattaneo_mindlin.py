"""Spheres pressed and pulled: tractions, shift and loops of Cattaneo, Mindlin and Johnson by the
numerical solution, with its order of convergence."""

from __future__ import annotations

import numpy as np
from page import Claim, Page, Published, Table, write_page

import asperity as asp

FRICTION, RADIUS, A, E = 0.4, 1.0, 0.1, 2.0
BODY = asp.Elastic(E, 0.0)
LOAD = 4.0 / 3.0 * (0.5 * E) * A**3 / RADIUS
FULL_SHIFT = FRICTION * A**2 / RADIUS
"""Shift at the onset of sliding, m."""

SHARES = (0.2, 0.5, 0.8)
AMPLITUDES = (0.25, 0.5, 0.75, 0.95)
GRIDS = (20, 28, 40, 56, 80, 112)

ABOUT = (
    "Two equal spheres of ν = 0, for which the theory is exact, are pressed by P and pulled by Q (Cattaneo "
    "1938; Mindlin 1949), then to and fro between ±Q₀ (Mindlin & Deresiewicz 1953, measured by Johnson 1955, "
    "whose loops stand in figures). Theirs: the printed formulas. Ours: `asp.solve` on grids of constant "
    "tractions on pixels. No parameter is chosen."
)

WORDS = """* Tractions converge with the first power of the pixel in the L2 norm, against means of the formula
  over pixels; single grids scatter by how their pixels lie to the rims.
* A leg from turning point to turning point is one step: tractions keep to one direction."""


def page(grids: tuple[int, ...] = GRIDS, points: int = 80) -> Page:
    """The page, with tractions on ``grids``, shift and loops on ``points`` pixels along the
    side."""
    errors = [traction_error(n) for n in grids]
    order = -float(np.polyfit(np.log(grids), np.log(errors), 1)[0])
    shifts = {s: shift(s, points) for s in SHARES}
    loops = {s: cycle(s, points) for s in AMPLITUDES}
    numbers = [
        Published(
            "Mindlin 1949", f"shift over that of sliding at Q = {s:g} μP", f"{printed_shift(s):.4f}", shifts[s], 0.01
        )
        for s in SHARES
    ]
    numbers += [
        Published(
            "Mindlin & Deresiewicz 1953",
            f"loop W/μPδ at Q₀ = {s:g} μP",
            f"{printed_loop(s):.4f}",
            loops[s],
            0.03,
            shared=f"loop at {s:g} μP",
        )
        for s in AMPLITUDES
    ]
    off = max(abs(number.deviation) for number in numbers[: len(SHARES)])
    off_loops = max(abs(number.deviation) for number in numbers[len(SHARES) :])
    return Page(
        "Sphere under tangential force, and its loops",
        ABOUT,
        (
            Table(
                "Error of the tractions at Q = μP/2, L2 norm over that of the formula:",
                ("pixels along the side", "error"),
                tuple((f"{n}", f"{error:.4f}") for n, error in zip(grids, errors, strict=True)),
            ),
            WORDS,
        ),
        (
            Claim("order of convergence of the tractions", order, 0.9, 1.3),
            Claim("largest deviation of a shift", off, high=0.01),
            Claim("largest deviation of a loop", off_loops, high=0.03),
        ),
        tuple(numbers),
    )


def printed_shift(s: float) -> float:
    """Shift over that at the onset of sliding."""
    return float(1.0 - (1.0 - s) ** (2.0 / 3.0))


def printed_loop(s: float) -> float:
    """W/μPδ as printed."""
    left = 1.0 - s
    return 24.0 / 5.0 * (1.0 - left ** (5.0 / 3.0) - 5.0 * s / 6.0 * (1.0 + left ** (2.0 / 3.0)))


def spheres(points: int) -> asp.ContactProblem:
    """The pair on ``points`` x ``points`` pixels of 1.2 contact radii to every side."""
    spacing, x = axis(points)
    heights = -(x[:, None] ** 2 + x[None, :] ** 2) / (2.0 * RADIUS)
    law = asp.Coulomb(FRICTION)
    return asp.ContactProblem(
        asp.Surface(heights, spacing, spacing), BODY, counter_body=BODY, boundary=asp.Free(), friction=law
    )


def axis(points: int) -> tuple[float, np.ndarray]:
    """Pixel and coordinates from the centre."""
    spacing = 2.4 * A / points
    return spacing, (np.arange(points) - 0.5 * (points - 1)) * spacing


def traction_error(points: int) -> float:
    """Difference of the tractions at Q = μP/2 from pixel means of the formula over the latter."""
    step = asp.Step(asp.Force(LOAD), asp.TangentialForce(0.5 * FRICTION * LOAD))
    found = asp.solve(spheres(points), step).require_stick_slip()
    parts = 16
    fine = axis(parts * points)[1]
    r, c = np.hypot(fine[:, None], fine[None, :]), A * 0.5 ** (1.0 / 3.0)
    peak = FRICTION * 1.5 * LOAD / (np.pi * A**2)
    exact = sum(
        sign * radius / A * np.sqrt(np.maximum(1.0 - (r / radius) ** 2, 0.0)) for sign, radius in ((1, A), (-1, c))
    )
    means = peak * np.asarray(exact).reshape(points, parts, points, parts).mean(axis=(1, 3))
    return float(np.linalg.norm(found.traction[0] - means) / np.linalg.norm(means))


def shift(s: float, points: int) -> float:
    """Shift at Q = s μP over that at the onset of sliding."""
    step = asp.Step(asp.Force(LOAD), asp.TangentialForce(s * FRICTION * LOAD))
    return asp.solve(spheres(points), step).require_stick_slip().shift_x / FULL_SHIFT


def cycle(s: float, points: int) -> float:
    """Heat of the closed cycle of amplitude s μP over μPδ."""
    peak, load = asp.TangentialForce(s * FRICTION * LOAD), asp.Force(LOAD)
    turns = [asp.Step(load, asp.TangentialForce(part * peak.x)) for part in (1.0, -1.0, 1.0)]
    steps = asp.solve(spheres(points), asp.History(turns)).steps
    return sum(step.require_stick_slip().dissipated for step in steps[1:]) / (FRICTION * LOAD * FULL_SHIFT)


if __name__ == "__main__":
    write_page(page(), __file__)
