"""Stick and slip in units of the cold normal solve of the same contact:
``python benchmarks/frictional.py --sizes 512 1024``.

Self-affine surface of unit rms slope (``surfaces.self_affine``), load 0.05 E*, friction 0.3.
*Step*: equal bodies, one step of half the friction limit, for the pressure found before. *History*:
rigid on elastic (ν = 0.3) and on a layer four times as stiff as its base, 20 coupled steps: four of
pressing, then a cycle of shift. Times are those of processors, so that other work on the machine
matters little; the least of several runs counts. FFT pairs do not depend on the machine. *Tamaas*,
where installed: contact and one step of half the friction limit on an incompressible body, by both
packages in the same process.
"""

from __future__ import annotations

import argparse

import numpy as np
from clock import timed
from surfaces import self_affine
from tables import add_option, made, show

import asperity as asp
from asperity.core.arrays import RealArray
from asperity.physics.friction.operator import TangentialOperator
from asperity.physics.friction.solver.newton import StickSlipNewton
from asperity.physics.friction.solver.problem import Deviation, Points, TangentialQP, best_shift

FRICTION = 0.3
LOAD = 0.05
MOST_OF_TAMAAS = 5000
"""Iterations of Tamaas at most, five times its own limit."""
PLAIN = asp.Keep(stiffness=False)


def one_step(n: int, nu: float, repeats: int) -> list[str]:
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
    numbers = [f"{cold:.3f}", f"{pairs:.0f}", str(found.iterations), f"{found.pairs:.0f}", f"{seconds / cold:.2f}"]
    return [f"step, equal bodies, ν = {nu:g}", str(n), *numbers]


def history(n: int, name: str, body: asp.Elastic | asp.Layered, repeats: int) -> list[str]:
    """Row of a coupled history of 20 steps."""
    surface, modulus = self_affine(n), asp.solids.contact_modulus(body, asp.Rigid())
    bare = asp.ContactProblem(surface, body)
    normal, cold = timed(lambda: asp.solve(bare, asp.MeanPressure(LOAD * modulus), keep=PLAIN), repeats)
    problem = asp.ContactProblem(surface, body, friction=asp.Coulomb(FRICTION))
    press = [asp.Step(asp.MeanPressure(LOAD * modulus * k / 4), asp.Shift()) for k in range(1, 5)]
    amplitude = asp.Shift(0.5 * FRICTION * float(normal.mean_gap))
    cycle = asp.friction.shear_cycles(asp.MeanPressure(LOAD * modulus), amplitude, cycles=1, steps=3)
    steps = asp.History([*press, *cycle[:16]])
    found, seconds = timed(lambda: asp.solve(problem, steps), 1)
    assert found.converged
    rounds = np.mean([s.certificate.rounds for s in found.steps])
    forces = max(abs(s.stick_slip.force_x) / s.stick_slip.friction_limit for s in found.steps)
    per_step = seconds / len(found.steps)
    newton = np.mean([s.stick_slip.iterations for s in found.steps])
    pairs = [np.mean([part(s) for s in found.steps]) for part in (_normal_pairs, _shear_pairs)]
    return [
        f"history, {name} (Q up to {forces:.2f} μP, {rounds:.1f} rounds a step)",
        str(n),
        f"{cold:.3f}",
        f"{normal.certificate.fft_pairs:.0f}",
        f"{newton:.1f}",
        f"{pairs[0]:.0f} + {pairs[1]:.0f}",
        f"{per_step / cold:.2f}",
    ]


def _normal_pairs(step: asp.ContactResult) -> float:
    return step.certificate.fft_pairs


def _shear_pairs(step: asp.ContactResult) -> float:
    return step.stick_slip.fft_pairs


def beside_tamaas(n: int, repeats: int) -> list[str] | None:
    """Row of the contact and one step of half the friction limit, rigid on an incompressible body,
    by asperity and by Tamaas; None without it.

    There the bodies do not couple, and ``PolonskyKeerTan`` of Tamaas, which alternates as well,
    means the same contact. Both start from heights; errors are duality gaps of the tangential
    problem for the pressure of each, by the same code.
    """
    try:
        import tamaas
    except ImportError:
        return None
    tamaas.set_log_level(tamaas.LogLevel.error)
    tamaas.initialize(1)
    surface, body = self_affine(n), asp.Elastic(0.75, 0.5)
    problem = asp.ContactProblem(surface, body, friction=asp.Coulomb(FRICTION))
    mean = 0.5 * FRICTION * LOAD
    step = asp.Step(asp.MeanPressure(LOAD), asp.TangentialForce(mean * problem.grid.area))
    ours, seconds = timed(lambda: asp.solve(problem, step, keep=PLAIN), repeats)
    heights = np.ascontiguousarray(surface.heights) / n
    model = tamaas.Model(tamaas.model_type.surface_2d, [1.0, 1.0], [n, n])
    model.E, model.nu = 0.75, 0.5
    solver = tamaas.PolonskyKeerTan(model, heights, 1e-6, FRICTION)
    solver.max_iter = MOST_OF_TAMAAS
    _, theirs = timed(lambda: solver.solve([mean, 0.0, LOAD]), 1)
    found = np.array(model.traction)
    operator = TangentialOperator(problem.grid, (body, asp.Rigid()))

    def gap(pressure: RealArray, traction: RealArray) -> float:
        points = Points.of(TangentialQP(operator, FRICTION * pressure, np.zeros((2, n, n))))
        q, u = points.gathered(traction), points.gathered(operator.displacement(traction))
        return Deviation.of(points, q, u, best_shift(points, q, -u)[:, None] - u).gap

    errors = gap(ours.pressure, ours.stick_slip.traction), gap(found[..., 2], np.moveaxis(found[..., :2], -1, 0))
    apart = np.linalg.norm(found[..., 0] - ours.stick_slip.traction[0]) / np.linalg.norm(found[..., 0])
    times = [f"{seconds:.2f}", f"{theirs:.1f}", f"{theirs / seconds:.0f}"]
    return [str(n), *times, *(f"{value:.0e}" for value in (*errors, apart))]


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=[512, 1024])
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument(
        "--peer-sizes", type=int, nargs="*", default=[64, 128], help="grids to run Tamaas on, if installed"
    )
    add_option(parser)
    options = parser.parse_args()
    coated = asp.Layered([asp.Layer(asp.Elastic(4.0, 0.3), 4.0)], base=asp.Elastic(1.0, 0.3))
    rows = []
    for n in options.sizes:
        rows += [one_step(n, nu, options.repeats) for nu in (0.0, 0.3)]
        for name, body in (("rigid on elastic", asp.Elastic(0.91, 0.3)), ("rigid on layer E 4", coated)):
            rows.append(history(n, name, body, options.repeats))
    columns = ("case", "n", "cold normal solve (s)", "its pairs", "Newton steps", "pairs", "time in cold solves")
    tables = [made("stick-slip", columns, rows)]
    beside = [row for n in options.peer_sizes if (row := beside_tamaas(n, options.repeats))]
    columns = ("n", "asperity (s)", "Tamaas (s)", "ratio", "gap, asperity", "gap, Tamaas", "tractions apart")
    if beside:
        tables.append(made("stick-slip-tamaas", columns, beside))
    else:
        print("Tamaas: not installed (pip install 'asperity[bench]')")
    show(*tables, write=options.write)


if __name__ == "__main__":
    main()
