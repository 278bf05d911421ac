"""Plastic flow in the volume: one application of its operators beside its bare transforms, and ten
steps of a rough layered contact.

``python benchmarks/plastic_flow.py [--points 256] [--steps 10] [--write]``; processor time of one
thread and the largest memory of the process. With ``--tamaas PYTHON`` a periodic sphere of
hardening material beside Tamaas, which is installed under that interpreter.
"""

from __future__ import annotations

import argparse
import resource
import subprocess
import time

import numpy as np
from tables import Table, add_option, made, show

import asperity as asp
from asperity.contact.solve import steps
from asperity.solids.eigenstrain.cells import DepthCells, depth_edges
from asperity.solids.eigenstrain.operator import EigenstrainOperator

FILM, STEEL = asp.Elastic(400e9, 0.25), asp.Elastic(200e9, 0.3)
SPACING = 25e-9
BODY = asp.Layered([asp.Layer(FILM, 8 * SPACING)], STEEL)


def application(points: int, cells: int = 40) -> Table:
    """All transforms of a volume, and the sweeps between them."""
    grid = asp.Grid((points, points), (SPACING, SPACING))
    edges = depth_edges(BODY, 40 * SPACING, 0.5 * SPACING, cells)
    operator = EigenstrainOperator.prepared(grid, DepthCells(BODY, edges), threads=1)
    strain = np.random.default_rng(1).normal(size=(operator.cells.count, 6, points, points))
    slots = [(cell, part) for cell in range(operator.cells.count) for part in range(6)]
    fields, loads, out = operator.spectra(), operator.loads(strain[0, 0]), np.empty_like(strain)
    times = []
    for _ in range(4):
        marks = [time.process_time()]
        operator.forward(strain, fields, slots)
        marks.append(time.process_time())
        operator.respond(loads, fields)
        marks.append(time.process_time())
        operator.backward(fields, out, slots)
        marks.append(time.process_time())
        times.append(np.diff(marks))
    forward, sweeps, backward = np.min(times, axis=0)
    transforms = forward + backward
    seconds = [f"{transforms:.3f}", f"{sweeps:.3f}", f"{1 + sweeps / transforms:.2f}"]
    columns = ("points", "transforms (s)", "sweeps (s)", "all over transforms")
    return made("plastic-operators", columns, [[f"{points} × {points} × {operator.cells.count}", *seconds]])


def rough(points: int, count: int) -> Table:
    """Loads of a rough layered contact up to where a tenth of it touches."""
    waves = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(3e-9 * points / 256),
        hurst=0.8,
        rolloff_wavelength=points * SPACING / 4,
        shortest_wavelength=8 * SPACING,
    )
    surface = asp.generate.gaussian(asp.Grid((points, points), (SPACING, SPACING)), waves, seed=1)
    laws = (
        asp.plasticity.J2(FILM, asp.plasticity.LinearHardening(5e9, 4e9)),
        asp.plasticity.J2(STEEL, asp.plasticity.LinearHardening(1.5e9, 4e9)),
    )
    problem = asp.ContactProblem(surface, BODY, plastic_flow=asp.PlasticFlow(laws))
    loads = [asp.MeanPressure(0.6e9 * k / count) for k in range(1, count + 1)]
    rows: list[list[str]] = []
    begin = time.process_time()
    for step in steps(problem, asp.History(loads), engine=asp.engines.CpuEngine(threads=1), on_failure="return"):
        flow = step.require_plastic_flow()
        rows.append(
            [
                f"{step.mean_pressure / 1e6:.0f}",
                f"{step.area_fraction:.4f}",
                str(flow.depths.size),
                str(flow.flowed.points.size),
                f"{max(zone.largest_strain for zone in flow.zones):.3f}",
                str(flow.iterations),
                f"{time.process_time() - begin:.1f}",
                f"{resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20:.2f}",
            ]
        )
        print(*rows[-1], step.status.outcome, flush=True)
    numbers = ("depth cells", "points that flowed", "largest strain", "iterates", "s so far", "GiB so far")
    return made("plastic-flow", ("pressure (MPa)", "area", *numbers), rows)


SPHERE = {
    "modulus": 1.0,
    "nu": 0.3,
    "yield_stress": 0.005,
    "hardening": 0.01,
    "radius": 12.0,
    "depth": 0.5,
    "loads": (2e-4, 5e-4, 1e-3),
}
"""In units of the modulus and the length of the cell."""

THEIRS = """
import sys, time
import numpy as np
import tamaas as tm
from tamaas.nonlinear_solvers import DFSANECXXSolver
case, n, nz = eval(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
tm.set_log_level(tm.LogLevel.error)
tm.initialize(1)
x = (np.arange(n) - n // 2) / n
heights = -(x[:, None] ** 2 + x**2) / (2 * case["radius"])
model = tm.ModelFactory.createModel(tm.model_type.volume_2d, [case["depth"], 1.0, 1.0], [nz, n, n])
model.E, model.nu = case["modulus"], case["nu"]
material = tm.materials.IsotropicHardening(model, sigma_y=case["yield_stress"], hardening=case["hardening"])
solver = DFSANECXXSolver(tm.Residual(model, material))
solver.tolerance = 1e-5
epic = tm.EPICSolver(tm.PolonskyKeerRey(model, heights, 1e-10), solver, 1e-5)
begin = time.process_time()
for load in case["loads"]:
    epic.acceleratedSolve(load)
    p, q = model.traction[..., 2], model["cumulated_plastic_strain"]
    print(load, (p > 0).mean(), p.max(), q.max(), time.process_time() - begin, flush=True)
"""


def beside_tamaas(python: str, points: int) -> Table:
    """The same three loads with both."""
    unit, case = 1e9, SPHERE
    x = (np.arange(points) - points // 2) / points
    surface = asp.Surface(-(x[:, None] ** 2 + x**2) / (2.0 * case["radius"]), 1.0 / points, 1.0 / points)
    solid = asp.Elastic(case["modulus"] * unit, case["nu"])
    law = asp.plasticity.J2(
        solid, asp.plasticity.LinearHardening(case["yield_stress"] * unit, case["hardening"] * unit)
    )
    problem = asp.ContactProblem(surface, solid, plastic_flow=asp.PlasticFlow(law))
    history = asp.History([asp.MeanPressure(load * unit) for load in case["loads"]])
    rows = []
    begin = time.process_time()
    for step in steps(problem, history, engine=asp.engines.CpuEngine(threads=1)):
        (zone,) = step.require_plastic_flow().zones
        numbers = (step.area_fraction, step.max_pressure / unit, zone.largest_strain)
        rows.append(_row(points, "asperity", step.mean_pressure / unit, *numbers, time.process_time() - begin))
    command = [python, "-c", THEIRS, repr(case), str(points), str(3 * points // 4)]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    rows += [_row(points, "Tamaas", *map(float, line.split())) for line in done.stdout.splitlines()]
    columns = ("points", "package", "load", "area", "largest pressure", "largest plastic strain", "s so far")
    return made("plastic-flow-tamaas", columns, rows)


def _row(points: int, package: str, load: float, area: float, pressure: float, strain: float, took: float) -> list[str]:
    """Row of a load; pressures over the modulus."""
    numbers = [f"{load:g}", f"{area:.5f}", f"{pressure:.6f}", f"{strain:.6f}", f"{took:.2f}"]
    return [f"{points}²", package, *numbers]


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--points", type=int, default=256, help="along a side")
    parser.add_argument("--steps", type=int, default=10, help="of the rough contact")
    parser.add_argument("--tamaas", metavar="PYTHON", help="interpreter with Tamaas: only the sphere, with both")
    add_option(parser)
    given = parser.parse_args()
    if given.tamaas:
        show(beside_tamaas(given.tamaas, min(given.points, 32)), write=given.write)
    else:
        show(application(given.points), rough(given.points, given.steps), write=given.write)


if __name__ == "__main__":
    main()
