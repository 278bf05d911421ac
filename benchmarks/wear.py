"""A step of wear in units of one cold solve of the same worn contact: ``python benchmarks/wear.py
--sizes 256 512 1024``.

A self-affine surface as on the page of benchmarks, bare, coated, with a limit of the pressure, and
with a coating that wears through, wears until about a half of its area touches. *Step* is the time
of a whole history over its steps: the implicit contact, the check of the worn surfaces without
wear, the error, and the numbers. *Cold* is a solve of those of its contacts that are kept, each
from nothing. The aim is at most one.
"""

from __future__ import annotations

import argparse
import time
from dataclasses import replace

import numpy as np
from surfaces import self_affine
from tables import add_option, made, show

import asperity as asp
from asperity.engines import CpuEngine
from asperity.wear import WearLaw, WearSteps, archard, worn

PRESSURE = 0.003
"""Mean pressure over the contact modulus."""

MARKS = np.array([0.1, 0.3, 1.0])
"""Shares of the distance at which contacts are kept."""


def problem(n: int, kind: str) -> asp.ContactProblem:
    """The surface between bodies of unit contact modulus."""
    surface = self_affine(n)
    body = asp.Elastic(1.0, 0.0)
    spacing = surface.grid.spacing[0]
    coated = asp.Layered([asp.Layer(asp.Elastic(2.0, 0.0), 8.0 * spacing)], body)
    found = asp.ContactProblem(surface, coated if kind in ("coated", "worn through") else body)
    return replace(found, law=asp.Hardness(0.1)) if kind == "limited" else found


def row(n: int, kind: str, threads: int, repeats: int) -> list[str]:
    """Row of one size and kind of contact."""
    asked, control, engine = problem(n, kind), asp.MeanPressure(PRESSURE), CpuEngine(threads)
    height = float(asked.profile().std())
    law: WearLaw = archard(1.0)
    if kind == "worn through":
        law = archard(3.0, layers=[(height, 1.0)])
    distance = 1.0 * height / PRESSURE
    marks = (distance * MARKS).tolist()
    times, colds = list[float](), list[float]()
    for _ in range(repeats):
        start = time.perf_counter()
        history = worn(asked, control, marks, law, steps=WearSteps(tolerance=0.05), engine=engine)
        times.append(time.perf_counter() - start)
        contacts = [result.problem for _, result in history.kept]
        start = time.perf_counter()
        for each in contacts:
            asp.solve(each, control, engine=engine)
        colds.append((time.perf_counter() - start) / len(contacts))
    steps = len(history.course) - 1
    step, cold = min(times) / steps, min(colds)
    area = f"{history['area_fraction'][0]:.3f} – {history['area_fraction'][-1]:.3f}"
    return [
        str(n),
        kind,
        area,
        str(steps),
        f"{history.contacts / steps:.1f}",
        f"{history.fft_pairs / steps:.1f}",
        f"{step:.3f}",
        f"{cold:.3f}",
        f"{step / cold:.2f}",
        f"{history.error:.3f}",
    ]


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=[256, 512, 1024])
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--repeats", type=int, default=3)
    add_option(parser)
    given = parser.parse_args()
    columns = (
        "n",
        "bodies",
        "real area",
        "steps",
        "contacts a step",
        "FFT pairs a step",
        "step / s",
        "cold / s",
        "step / cold",
        "error stated",
    )
    kinds = ("bare", "coated", "limited", "worn through")
    rows = [row(n, kind, given.threads, given.repeats) for n in given.sizes for kind in kinds]
    show(made("wear", columns, rows), write=given.write)


if __name__ == "__main__":
    main()
