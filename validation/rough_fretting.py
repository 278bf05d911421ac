"""Heat of fretting cycles against their amplitude: the cube of a sphere against rough, self-affine
surfaces, by the numerical solution and by the reduced theorem."""

from __future__ import annotations

import numpy as np
from cattaneo_mindlin import FRICTION, FULL_SHIFT, LOAD, printed_loop, spheres
from page import Claim, Page, Published, Table, write_page

import asperity as asp

BODY = asp.Elastic(2.0, 0.0)
PRESSURE = 0.02
"""Mean pressure over E* rms slope, at which some 4 % of the area touch."""

AMPLITUDES = (0.08, 0.12, 0.18, 0.27, 0.4, 0.8)
"""Q₀ over μP."""

HURST = (0.3, 0.8)

SHORTEST = 16.0
"""Shortest wavelength in pixels."""

FITTED = 4
"""Amplitudes from the smallest on through which a line is laid."""

ABOUT = (
    "Equal bodies of ν = 0 are pressed and moved to and fro between ±Q₀ at constant load, a sphere and "
    "self-affine surfaces on a periodic square, with the Hurst exponents {hurst}, {seeds} surfaces each on "
    "{points} × {points} points. Theirs: a sphere dissipates (4/27)(Q₀/μP)³ μPδ for small Q₀ (Mindlin & "
    "Deresiewicz 1953). That the exponent of rough, fractal surfaces should be lower, down to one, is "
    "sometimes supposed; this page says what is found. Independent solution: the reduced theorem (Ciavarella "
    "1998; Jäger 1998), by which the heat follows from the approach under load alone. No parameter is chosen."
)

WORDS = """* **What is found**: the heat of small cycles on rough surfaces goes with the cube of the
  amplitude, too, within the scatter, and not linearly. By the reduced theorem slip needs the second
  derivative of the approach by the load: where that exists, W = (2/3)(κ/μ)|δ_z''(P)| Q₀³ for any shape. Of
  surfaces whose pressure grows exponentially with the approach, δ_z = u₀ ln P + const., it is W/μPκμu₀ =
  (2/3)(Q₀/μP)³.
* At amplitudes that are not small the exponent is larger than three, not smaller, for sphere and rough
  surfaces alike: the loop opens as sliding comes near. Exponents below three ask for what is not in Coulomb's
  law under constant load, such as a bound that does not fall to zero at the rims of contact spots.
* The cube needs amplitudes at which many pixels slip; below, the heat of a grid is zero as soon as no pixel slips."""


def page(points: int = 256, seeds: int = 5, sphere_points: int = 120) -> Page:
    """The page, on surfaces of ``points``² and as many ``seeds`` for each Hurst exponent."""
    ball = np.array([loop(spheres(sphere_points), asp.Force(LOAD), FRICTION * LOAD, s) for s in AMPLITUDES])
    ball = ball / (FRICTION * LOAD * FULL_SHIFT)
    rows, exponents, ratios = [], {}, []
    columns = {"sphere": (ball, np.zeros_like(ball))}
    for hurst in HURST:
        heats = np.array([heat_of(hurst, seed, points) for seed in range(1, seeds + 1)])
        columns[f"H = {hurst:g}"] = (heats.mean(axis=0), heats.std(axis=0, ddof=1))
        slopes = [slope(each) for each in heats]
        exponents[hurst] = (float(np.mean(slopes)), float(np.std(slopes, ddof=1)))
        ratios.append(reduced(hurst, 1, points) / heats[0][FITTED - 1])
    for k, s in enumerate(AMPLITUDES):
        cells = [f"{mean[k]:.3e}" + (f" ± {spread[k]:.1e}" if spread[k] else "") for mean, spread in columns.values()]
        rows.append((f"{s:g}", f"{printed_loop(s):.3e}", *cells))
    sphere, printed, expected = (
        slope(np.array(each))
        for each in (ball, [printed_loop(s) for s in AMPLITUDES], [logarithmic(s) for s in AMPLITUDES])
    )
    fits = (
        ("sphere, printed formula", f"{printed:.2f}"),
        ("sphere", f"{sphere:.2f}"),
        ("approach u₀ ln P, reduced theorem", f"{expected:.2f}"),
        *((f"H = {hurst:g}", f"{mean:.2f} ± {spread:.2f}") for hurst, (mean, spread) in exponents.items()),
    )
    what = f"exponent of the heat of a sphere from {AMPLITUDES[0]:g} to {AMPLITUDES[FITTED - 1]:g} μP"
    numbers = (Published("Mindlin & Deresiewicz 1953", what, f"{printed:.2f}", sphere, 0.05),)
    worst = max(abs(mean - expected) for mean, _ in exponents.values())
    return Page(
        "Heat of fretting cycles on rough surfaces",
        ABOUT.format(hurst=" and ".join(map(str, HURST)), seeds=seeds, points=points),
        (
            Table(
                "Heat of a cycle over μPδ, δ the shift at the onset of sliding of the sphere and that of all "
                "of the rough surface, mean and standard deviation of the surfaces:",
                ("Q₀/μP", "sphere, printed", *columns),
                tuple(rows),
            ),
            Table(
                f"Exponent of the heat over the amplitude, a line through {AMPLITUDES[0]:g} to "
                f"{AMPLITUDES[FITTED - 1]:g} μP in logarithms:",
                ("", "exponent"),
                fits,
            ),
            WORDS,
        ),
        (
            Claim("exponent of the sphere", sphere, 2.9, 3.3),
            Claim(
                "largest difference of the exponent of rough surfaces from that of an approach u₀ ln P",
                worst,
                high=0.25,
            ),
            Claim("heat by the reduced theorem over that of the cycle, smallest", min(ratios), 0.97, 1.03),
            Claim("heat by the reduced theorem over that of the cycle, largest", max(ratios), 0.97, 1.03),
        ),
        numbers,
    )


def logarithmic(s: float) -> float:
    """Heat over μPκμu₀ where the approach is u₀ ln P + const."""
    left = np.log1p(-s)
    return float(8.0 * (-0.5 * s * left - ((1.0 - s) * left + s)))


def slope(heats: np.ndarray) -> float:
    """Exponent over the first amplitudes."""
    return float(np.polyfit(np.log(AMPLITUDES[:FITTED]), np.log(heats[:FITTED]), 1)[0])


def rough(hurst: float, seed: int, points: int) -> tuple[asp.ContactProblem, asp.MeanPressure]:
    """Pair with a surface of rms slope 0.1, roll-off at half the period, shortest waves of
    ``SHORTEST`` pixels, and its load."""
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.1), hurst=hurst, rolloff_wavelength=points / 2.0, shortest_wavelength=SHORTEST
    )
    surface = asp.generate.gaussian(asp.Grid((points, points), (1.0, 1.0)), spectrum, seed=seed)
    problem = asp.ContactProblem(surface, BODY, counter_body=BODY, friction=asp.Coulomb(FRICTION))
    return problem, asp.MeanPressure(PRESSURE * 0.1 * problem.contact_modulus)


def heat_of(hurst: float, seed: int, points: int) -> np.ndarray:
    """Heat of the cycles over μPδ, δ the shift at the onset of sliding."""
    problem, load = rough(hurst, seed, points)
    force = load.value * problem.grid.area
    scale = FRICTION * force * FRICTION * full_approach(problem, load)
    return np.array([loop(problem, load, FRICTION * force, s) for s in AMPLITUDES]) / scale


def full_approach(problem: asp.ContactProblem, load: asp.MeanPressure) -> float:
    """Approach from first touch: κ = 1 and P* = 0 of the reduced theorem."""
    return float(asp.solve(bare(problem), load).approach)


def bare(problem: asp.ContactProblem) -> asp.ContactProblem:
    """The same without friction."""
    return asp.ContactProblem(
        problem.surface, problem.body, counter_body=problem.counter_body, boundary=problem.boundary
    )


def loop(problem: asp.ContactProblem, load: asp.MeanPressure | asp.Force, limit: float, s: float) -> float:
    """Heat in J of the closed cycle of amplitude ``s`` times the friction ``limit``."""
    turns = [asp.Step(load, asp.TangentialForce(part * s * limit)) for part in (1.0, -1.0, 1.0)]
    steps = asp.solve(problem, asp.History(turns)).steps
    return float(sum(step.require_stick_slip().dissipated for step in steps[1:]))


def reduced(hurst: float, seed: int, points: int, s: float = AMPLITUDES[FITTED - 1]) -> float:
    """Heat over μPδ of the cycle of amplitude ``s``, from approaches under loads between P - Q₀/μ
    and P alone."""
    problem, load = rough(hurst, seed, points)
    node, weight = np.polynomial.legendre.leggauss(8)
    share = 0.5 * s * (node + 1.0)
    alone, area = bare(problem), problem.grid.area

    def approach(part: float) -> float:
        return float(asp.solve(alone, asp.MeanPressure((1.0 - part) * load.value)).approach)

    top, force = approach(0.0), load.value * area
    shifts = np.array([top - approach(part) for part in share])
    area_below = 0.5 * s * float(weight @ shifts)
    heat = 8.0 * (0.5 * s * (top - approach(s)) - area_below) * FRICTION**2 * force
    return heat / (FRICTION * force * FRICTION * top)


if __name__ == "__main__":
    write_page(page(), __file__)
