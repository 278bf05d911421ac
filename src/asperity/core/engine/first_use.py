"""The first use in an environment: a second process compiles the passes of a first solve, those
needed last first.

Compiling takes Python, one thread of it, for longer than anything else in that solve. The solve
compiles in the order of its needs and finds in the cache on disk what the other process has
compiled from the end, until they meet; whichever is late, nothing waits and the results are the
same.
"""

from __future__ import annotations

import gc
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from .cpu import CpuEngine
from .protocol import SplineModel


def passes() -> list[Callable[[], Any]]:
    """Calls, on arrays of a few points, that compile the later half of the passes of a first solve
    of an elastic contact, in the order of its needs."""
    shape, single = (16, 16), "float32"
    engine = CpuEngine(threads=1)
    p, index = np.zeros(shape), np.arange(8)
    free, field = engine.points(shape, index, single), engine.field(shape, single)
    vector = free.zeros()
    model = SplineModel(
        merges=((True, True),) * 3,
        averages=((True, True),) * 3,
        wraps=(True, True),
        weights=(1.0,) * 3,
        own=(1.0,) * 4,
        inverse_weights=(1.0,) * 3,
        stiffness=1.0,
        fall=(0.0, 0.0),
        bend=(0.0, 0.0),
    )
    convolution = engine.convolution(np.ones((16, 9)), shape, single)
    return [
        *engine.splines(shape, model, single).late_sweeps(free),
        partial(free.update_direction, vector, 0.0, 0.0, vector.copy(), vector, field),
        partial(convolution.apply, field, engine.field(shape, single)),
        partial(free.gather_products, field, vector, vector, free.empty()),
        partial(engine.add, field, 1.0, p),
        partial(free.update_solution, 0.0, vector, vector, 0.0, vector.copy(), vector.copy()),
        partial(free.add_unclipped, p, vector, 1.0),
        partial(free.scatter, vector, field),
        partial(free.clear_tension, p, 1.0, 1.0),
        partial(free.products, vector, vector, vector),
        partial(free.scatter_add, vector, 1.0, field),
        partial(engine.prolonged, np.zeros((8, 8)), np.zeros((8, 8)), p, 1.0),
        partial(engine.violation, p, p, p, None, 0.0),
    ]


if __name__ == "__main__":
    gc.disable()  # a compiler makes many objects, of which a short process need not be freed
    for compile_pass in reversed(passes()):
        compile_pass()
