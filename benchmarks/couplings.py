"""Normal solves and FFT pairs of every coupling alone and together, against loops around loops:
``python benchmarks/couplings.py``.

Self-affine map of 96 x 96 pixels of 25 nm, 2 nm rms, E* about 100 GPa. *Nested* settles the menisci
in an outer loop around solves of everything else (each of which is settled), and searches for a
position, by secants, around solves at given loads.
"""

from __future__ import annotations

import argparse
import itertools
import math
from dataclasses import replace

import numpy as np
from tables import add_option, made, show

import asperity as asp
from asperity.contact.solve import Keep
from asperity.physics.menisci.film import wetting

NM = 1e-9
LOAD = 20e6
FILM = asp.LiquidFilm(surface_tension=0.025, thickness=2 * NM, contact_angles=(math.radians(10.0), 0.0))
FRICTION = asp.Coulomb(0.5, 0.4)


class Count:
    """Normal solves and FFT pairs so far."""

    def __init__(self) -> None:
        self.solves, self.pairs = 0, 0.0

    def solve(
        self, problem: asp.ContactProblem, control: asp.contact.Control, state: asp.solvers.InterfaceState | None = None
    ):
        found = asp.solve(problem, control, state=state, keep=Keep(stiffness=False))
        self.solves += found.certificate.rounds
        self.pairs += found.certificate.fft_pairs
        return found

    def settled(self, problem: asp.ContactProblem, load: float) -> asp.ContactResult:
        """Contact under ``load`` (Pa) with menisci in a loop of their own."""
        film, pull, area = problem.film, 0.0, problem.grid.area
        if film is None:
            return self.solve(problem, asp.MeanPressure(load))
        pixel = film.suction * problem.grid.pixel_area
        for _ in range(100):
            found = self.solve(replace(problem, film=None), asp.MeanPressure(load + pull / area))
            stands = wetting(found.gap, found.contact, film, wraps=(True, True))
            latest = pixel * np.count_nonzero(stands.menisci)
            if abs(latest - pull) <= 1e-4 * (load * area + pull):
                break
            pull = latest
        return found

    def searched(self, problem: asp.ContactProblem, gap: float) -> None:
        """Load at a mean ``gap`` (m), by secants of its logarithm."""
        loads, misses = [math.log(LOAD)], [self.settled(problem, LOAD).mean_gap - gap]
        loads.append(loads[0] + misses[0] / (0.45 * 2.0 * NM))
        for _ in range(20):
            misses.append(self.settled(problem, math.exp(loads[-1])).mean_gap - gap)
            if abs(misses[-1]) <= 1e-7 * gap:
                break
            slope = (misses[-1] - misses[-2]) / (loads[-1] - loads[-2])
            loads.append(loads[-1] - misses[-1] / slope)


def coated(film: float, base: float) -> asp.Layered:
    upper, lower = (asp.Elastic(100e9, 0.15, asp.Strength(hardness=h)) for h in (film, base))
    return asp.Layered([asp.Layer(upper, 2 * NM)], lower)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=int, default=96, help="pixels per side")
    add_option(parser)
    given = parser.parse_args()
    size, rows = given.size, []
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(2.0 * NM), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=100 * NM
    )
    surface = asp.generate.gaussian(asp.Grid((size, size), (25 * NM, 25 * NM)), spectrum, seed=5)
    plain = asp.Elastic(100e9, 0.15)
    bodies = {"": plain, "soft film": coated(0.7e9, 2e9), "hard film": coated(2e9, 1e9)}
    for (name, body), film, friction in itertools.product(bodies.items(), (None, FILM), (None, FRICTION)):
        law = asp.plasticity.LayeredHardness(body) if isinstance(body, asp.Layered) else asp.plasticity.HardWall()
        problem = asp.ContactProblem(surface, body, law=law, film=film, friction=friction)
        row = []
        flat, nested = Count(), Count()
        gap = flat.solve(problem, asp.MeanPressure(LOAD)).mean_gap * 0.95
        nested.settled(problem, LOAD)
        row += [flat.solves, flat.pairs, nested.solves, nested.pairs]
        flat, nested = Count(), Count()
        flat.solve(problem, asp.MeanGap(gap))
        nested.searched(replace(problem, film=None), gap)  # menisci are passive there
        row += [flat.solves, flat.pairs, nested.solves, nested.pairs]
        physics = [text for text in (name, "menisci" if film else "", "sliding" if friction else "") if text]
        rows.append([", ".join(physics) or "elastic", *(f"{value:.0f}" for value in row)])
        print(*rows[-1], flush=True)
    work = ("solves", "pairs", "nested solves", "nested pairs")
    columns = ("physics", *work, *(f"{name}, mean gap" for name in work))
    show(made("couplings", columns, rows), write=given.write)


if __name__ == "__main__":
    main()
