"""Stick and slip in units of the cold normal solve of the same contact: ``python benchmarks/frictional.py --sizes 512 1024``.

Self-affine surface of unit rms slope (``surfaces.self_affine``), load 0.05 E*, friction 0.3. *Step*: equal bodies, one step of half the
friction limit, for the pressure found before. *History*: rigid on elastic (ν = 0.3) and on a layer four times as stiff as its base,
20 coupled steps: four of pressing, then a cycle of shift. Times are those of processors, so that other work on the machine
matters little; the least of several runs counts. FFT pairs do not depend on the machine.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from surfaces import self_affine

import asperity as asp
from asperity.contact.operators.tangential import TangentialOperator
from asperity.contact.solvers.stick_slip.newton import StickSlipNewton
from asperity.contact.solvers.stick_slip.problem import TangentialQP

FRICTION = 0.3
LOAD = 0.05
PLAIN = asp.Keep(stiffness=False)


def timed(run: Callable[[], Any], repeats: int) -> tuple[Any, float]:
    """What ``run`` gives, and its least processor time in s."""
    best, found = np.inf, None
    for _ in range(repeats):
        start = time.process_time()
        found = run()
        best = min(best, time.process_time() - start)
    return found, best


def one_step(n: int, nu: float, repeats: int) -> str:
    """Row of one partial-slip step of equal bodies."""
    body = asp.Elastic(2.0 * (1.0 - nu**2), nu)
    problem = asp.ContactProblem(self_affine(n), body, counter_body=body)
    normal, cold = timed(lambda: asp.solve(problem, asp.MeanPressure(LOAD), keep=PLAIN), repeats)
    operator = TangentialOperator(problem.grid, (body, body))
    force = np.array([0.5 * FRICTION * LOAD, 0.0])
    qp = TangentialQP(operator, FRICTION * normal.pressure, np.zeros((2, n, n)), force)
    found, seconds = timed(lambda: StickSlipNewton().solve(qp), repeats)
    assert found.status.converged
    pairs = normal.certificate.fft_pairs
    return (
        f"| step, equal bodies, ν = {nu:g} | {n} | {cold:.3f} | {pairs:.0f} | {found.iterations} | {found.pairs:.0f} | "
        f"{seconds / cold:.2f} |"
    )


def history(n: int, name: str, body: asp.Elastic | asp.Layered, repeats: int) -> str:
    """Row of a coupled history of 20 steps."""
    surface, modulus = self_affine(n), asp.contact_modulus(body, asp.Rigid())
    bare = asp.ContactProblem(surface, body)
    normal, cold = timed(lambda: asp.solve(bare, asp.MeanPressure(LOAD * modulus), keep=PLAIN), repeats)
    problem = asp.ContactProblem(surface, body, friction=asp.Coulomb(FRICTION))
    press = [asp.Step(asp.MeanPressure(LOAD * modulus * k / 4), asp.Shift()) for k in range(1, 5)]
    amplitude = asp.Shift(0.5 * FRICTION * float(normal.mean_gap))
    cycle = asp.shear_cycles(asp.MeanPressure(LOAD * modulus), amplitude, cycles=1, steps=3)
    steps = asp.History([*press, *cycle[:16]])
    found, seconds = timed(lambda: asp.solve(problem, steps), 1)
    assert found.converged
    rounds = np.mean([s.certificate.rounds for s in found.steps])
    forces = max(abs(s.stick_slip.force_x) / s.stick_slip.friction_limit for s in found.steps)
    per_step = seconds / len(found.steps)
    return (
        f"| history, {name} (Q up to {forces:.2f} μP, {rounds:.1f} rounds a step) | {n} | {cold:.3f} | "
        f"{normal.certificate.fft_pairs:.0f} | {np.mean([s.stick_slip.iterations for s in found.steps]):.1f} | "
        f"{np.mean([s.certificate.fft_pairs for s in found.steps]):.0f} + "
        f"{np.mean([s.stick_slip.fft_pairs for s in found.steps]):.0f} | {per_step / cold:.2f} |"
    )


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=[512, 1024])
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    coated = asp.Layered([asp.Layer(asp.Elastic(4.0, 0.3), 4.0)], base=asp.Elastic(1.0, 0.3))
    print(
        "| case | n | cold normal solve (s) | its pairs | Newton steps | pairs (histories: normal + joint and tangential solves) | time in cold solves |"
    )
    print("|---|---|---|---|---|---|---|")
    for n in options.sizes:
        for nu in (0.0, 0.3):
            print(one_step(n, nu, options.repeats), flush=True)
        for name, body in (("rigid on elastic", asp.Elastic(0.91, 0.3)), ("rigid on layer E 4", coated)):
            print(history(n, name, body, options.repeats), flush=True)


if __name__ == "__main__":
    main()
