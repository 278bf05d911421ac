"""Flow through a gap in units of one factorisation by SciPy of the same matrix, and of one set-up
of smoothed aggregation by pyamg where that is installed:
``python benchmarks/sealing.py --sizes 256 512 1024``.

A self-affine surface cut at the height that leaves the share *open* of the area: a gap like that of
a contact. *Flow* is everything from the gap to the rate: clusters, faces, matrix, solution, and the
certificate with both bounds is *certificate*. Times are those of the processor, the least of
several runs.
"""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np
from clock import timed
from scipy.sparse.linalg import splu
from surfaces import self_affine
from tables import add_option, made, show

from asperity.physics.sealing import solver
from asperity.physics.sealing.flow import GapFlow, flow_through
from asperity.physics.sealing.network import network

OPEN = (1.0, 0.7)
"""Shares of the area that are open."""


def fresh(flow: GapFlow) -> tuple[float, float]:
    """Bounds of ``flow``, found anew."""
    again = GapFlow(flow.gap, flow.grid, flow.way, flow.repeats, flow.wraps, flow.net, flow.pressure)
    return again.bounds.lower, again.bounds.upper


def row(n: int, share: float, repeats: int) -> list[str]:
    """Row of one size and open share."""
    surface = self_affine(n)
    heights = surface.heights - np.quantile(surface.heights, 1.0 - share)
    gap = np.maximum(heights, 0.0) + (1e-3 * np.std(heights) if share == 1.0 else 0.0)
    flow, seconds = timed(lambda: flow_through(gap, surface.grid, wraps=(False, True)), repeats)
    bounds, certified = timed(lambda: fresh(flow), 1)
    system = solver.System(network(gap, surface.grid.spacing, (False, True), axis=0))
    scale = 1.0 / np.sqrt(system.matrix.diagonal())
    scaled = system.matrix.multiply(scale[:, None]).multiply(scale[None]).tocsc()
    options: dict[str, Any] = {"permc_spec": "MMD_AT_PLUS_A", "diag_pivot_thresh": 0.0}
    _, factorised = timed(lambda: splu(scaled, options={"SymmetricMode": True}, **options), 1)
    set_up = np.nan
    if solver.pyamg is not None:
        smooth = 1.0 / scale[:, None]
        pyamg = solver.pyamg
        _, set_up = timed(lambda: pyamg.smoothed_aggregation_solver(scaled.tocsr(), B=smooth, max_coarse=500), 1)
    numbers = [f"{seconds:.2f}", f"{certified:.2f}", f"{factorised:.2f}", f"{seconds / factorised:.2f}"]
    beside = ["", ""] if np.isnan(set_up) else [f"{set_up:.2f}", f"{seconds / set_up:.2f}"]
    apart = f"{bounds[1] / bounds[0] - 1.0:.0e}"
    return [str(n), f"{share:g}", flow.method, *numbers, *beside, f"{flow.section_error:.0e}", apart]


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=[256, 512, 1024])
    parser.add_argument("--repeats", type=int, default=1)
    add_option(parser)
    arguments = parser.parse_args()
    columns = (
        "n",
        "open",
        "method",
        "flow (s)",
        "certificate (s)",
        "factorisation (s)",
        "flow / factorisation",
        "multigrid set-up (s)",
        "flow / set-up",
        "sections apart",
        "bounds apart",
    )
    rows = [row(n, share, arguments.repeats) for n in arguments.sizes for share in OPEN]
    show(made("sealing", columns, rows), write=arguments.write)


if __name__ == "__main__":
    main()
