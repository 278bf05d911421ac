"""Branch and jumps of an adhesive loop, and the bound of its energy, as numbers, text and a figure of the part ``adhesion``."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ...core.errors import InputError, NoSolutionError
from ...core.status import Advice
from ...core.units import show
from ...parts.part import Rows, Solved, Table
from ...plots.picture import Figure, figures_by
from .bound import energy_bound
from .branch import AdhesiveBranch, Jump, adhesive_branch
from .figures import BRANCH_PLOT


def energy_values(solved: Solved) -> dict[str, float]:
    """Values of ``ENERGY``."""
    found = solved.result.require_adhesion()
    energy = found.elastic_energy + found.interface_energy
    try:
        lower = energy_bound(solved.result).lower
    except InputError:
        lower = math.nan  # a hardness, film, friction or core
    return {"adhesive_energy": energy, "adhesive_energy_bound": lower}


def branch_of(solved: Solved, farthest: float) -> tuple[AdhesiveBranch | None, tuple[Advice, ...]]:
    """Branch from the deepest contact of the path to the ``farthest`` approach (m); what stopped it."""
    assert solved.path is not None
    deepest = max(solved.path.steps, key=lambda step: step.approach)
    try:
        branch = adhesive_branch(deepest, farthest=farthest)
        return branch, _of_pixels(branch, max(solved.problem.grid.pixels))
    except (InputError, NoSolutionError) as error:
        text = f"The branch between the jumps was not followed: {error}"
        return None, (Advice("warning", "branch", text),)


def _of_pixels(branch: AdhesiveBranch, pixel: float) -> tuple[Advice, ...]:
    """That folds of the ``branch`` may be those of single points, where the ``pixel`` (m) is larger than it needs."""
    if pixel <= branch.needed_pixel:
        return ()
    text = (
        f"The branch between the jumps may have folds of single points of the grid: its pixel is {show(pixel, 'm', 3)}. Take one of at most "
        f"{show(branch.needed_pixel, 'm', 3)}, or a law that falls more gently, such as exponential."
    )
    return (Advice("warning", "branch", text),)


def branch_values(branch: AdhesiveBranch | None) -> dict[str, Any]:
    """Values of ``BRANCH``; none without one."""
    if branch is None:
        return {}
    first = branch.folds[0] if branch.folds else None
    return {
        "folds": float(len(branch.folds)),
        "fold_approach": math.nan if first is None else first.approach,
        "fold_force": math.nan if first is None else first.force,
        "branch_approach": branch.approach,
        "branch_force": branch.force,
        "branch_margin": branch.margin,
    }


def branch_rows(values: Mapping[str, Any]) -> Rows:
    """Energy with its bound, and folds."""
    rows = [("energy", show(float(values["adhesive_energy"]), "J"))]
    if math.isfinite(float(values["adhesive_energy_bound"])):
        rows.append(
            ("no contact at this approach has less energy than", show(float(values["adhesive_energy_bound"]), "J"))
        )
    if "folds" in values:
        rows.append(("folds of the branch", f"{float(values['folds']):.0f}"))
        if math.isfinite(float(values["fold_approach"])):
            at, force = show(float(values["fold_approach"]), "m"), show(float(values["fold_force"]), "N")
            rows.append(("first fold, where rigid grips jump", f"{at} under {force}"))
    return rows


def branch_figures(values: Mapping[str, Any]) -> tuple[Figure, ...]:
    """Force against approach along the branch, the parts that grips cannot hold dashed."""
    return figures_by((BRANCH_PLOT,), values) if "branch_approach" in values else ()


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
