"""Branch and jumps of an adhesive loop, and the bound of its energy, as numbers, text and a figure
of the part ``adhesion``."""

from __future__ import annotations

import math
from typing import Any

from ...core.errors import InputError, NoSolutionError
from ...core.status import Advice
from ...core.units import show
from ...parts.part import Solved, Table
from .branch import Jump, adhesive_branch


def branch_values(solved: Solved, farthest: float) -> tuple[dict[str, Any], tuple[Advice, ...]]:
    """Values of ``BRANCH`` from the deepest contact of the path to the ``farthest`` approach (m),
    none where there is no branch; what stopped it.

    Where the pixel is larger than the branch needs its folds may be those of single points.
    """
    assert solved.path is not None
    deepest = max(solved.path.steps, key=lambda step: step.approach)
    try:
        branch = adhesive_branch(deepest, farthest=farthest)
    except (InputError, NoSolutionError) as error:
        return {}, (Advice("warning", "branch", f"The branch between the jumps was not followed: {error}"),)
    findings: tuple[Advice, ...] = ()
    pixel = max(solved.problem.grid.pixels)
    if pixel > branch.needed_pixel:
        fact = (
            "The branch between the jumps may have folds of single points of the grid: its pixel is "
            f"{show(pixel, 'm', 3)}."
        )
        remedy = (
            f"Take one of at most {show(branch.needed_pixel, 'm', 3)} ({{resample}}), or a law that falls more gently "
            "({adhesion.law=exponential})."
        )
        numbers = {"pixel": pixel, "needed_pixel": branch.needed_pixel}
        findings = (Advice("warning", "branch", fact, remedy, numbers, ("fold", "branch_")),)
    first = branch.folds[0] if branch.folds else None
    values = {
        "folds": float(len(branch.folds)),
        "fold_approach": math.nan if first is None else first.approach,
        "fold_force": math.nan if first is None else first.force,
        "branch_approach": branch.approach,
        "branch_force": branch.force,
        "branch_margin": branch.margin,
    }
    return values, findings


def jumps_table(jumps: tuple[Jump, ...]) -> Table:
    """Where jumps begin, to which width, and what each loses."""
    cells = []
    for jump in jumps:
        forces = (show(result.external_force, "N") for result in (jump.before, jump.after))
        cells.append(
            (f"{jump.step + 1}", show(jump.grips, "m", 6), show(jump.width, "m", 2), *forces, show(jump.lost, "J"))
        )
    headings = ("Step", "Approach of the grips", "To within", "Force before", "Force after", "Energy lost")
    return Table(headings, tuple(cells))
