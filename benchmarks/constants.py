"""What the constants of the fast solver and of the search for a position are worth: FFT pairs and
time for other values.

Constants are the declared list ``SWEPT``; values and reasons are read from the source. Each is
replaced by other values, one at a time, and all problems on which it bears are solved: pairs do not
depend on the machine, processor times are over those with the value of the source, measured just
before. ``--write`` makes docs/develop/constants.md of it.

Usage: python benchmarks/constants.py [NAME ...] [--large] [--repeats 3] [--write] [--check]
"""

from __future__ import annotations

import argparse
import ast
import importlib
import statistics
import sys
import time
from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from surfaces import BODY, self_affine
from tables import machine, made, replace

import asperity as asp
from asperity.contact.solvers.active_set import spline_model
from asperity.contact.solvers.active_set.linear_system import Stopping

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "develop" / "constants.md"

_NEVER = 1e9

SWEPT: dict[str, dict[str, list[Any]]] = {
    "contact/solvers/active_set/solver.py": {
        "_SETTLED": [0.0, 0.001, 0.03],
        "_REDUCTION": [0.1, 0.5],
        "_UNSETTLED_STEPS": [2, 6],
        "_SINGLE": [0.01, 0.06, 0.3],
        "_CLOSELY": [0.0, 1.0],
        "_NEARLY_SETTLED": [Stopping(0.03, 8), Stopping(0.3, 8), Stopping(0.1, 3)],
        "_SETTLED_SET": [Stopping(1e-6, 14), Stopping(1e-2, 14), Stopping(1e-4, 8)],
        "_LAST_STEP": [0.03, 0.3],
        "_LAST_REDUCTION": [0.02, 0.05],
        "_MARGIN": [0.3, 1.0],
        "_MOST_UNSUCCESSFUL": [0, 4],
        "_MOST_REFINEMENTS": [0, 1, 4],
        "_CLOSER": [0.03, 0.3],
        "_CLOSER_DOUBLINGS": [1, 3],
        "_REFRESH": [1e-3, 1e-4, 1e-7],
    },
    "contact/solvers/active_set/bounds.py": {
        "_PRIOR": [1.0, 16.0],
        "_SCATTER_SHARE": [0.0, 1.0],
        "_SCATTER_SHARE_WIDE": [0.5, 0.0, -1.0],
        "LEAST_SHARE": [0.01, 0.3],
        "_PARTS": [1, 2, 8],
    },
    "contact/solvers/active_set/first_guess.py": {
        "COARSEST": [32, 128],
        "COARSE_ITERATIONS": [3, 100],
        "_HIDDEN_SHARE": [0.2, 2.0],
        "_HIDDEN_SHARE_CAPPED": [0.5],
        "_LOOSEST": [0.01, 0.3],
        "_LOOSEST_CAPPED": [0.01, 0.1],
        "_FINE_STIFFNESS": [0.0, 0.1, 0.3],
        "_FINE_STIFFNESS_RISING": [0.0, 0.15],
        "_RISING_FROM": [1.01, 2.0, _NEVER],
        "_NARROWED": [(1, 1, 1), (2, 2, 2)],
        "_SETTLING_FROM": [3.0, _NEVER],
        "_AREA_PER_LOAD": [1.4, 100.0],
    },
    "contact/solvers/active_set/linear_system.py": {
        "_MODEL_STEPS": [1, 4],
        "_FIRST_STEPS": [0, 2],
        "_LAST_LENGTH": [0.7, 1.0],
        "_STEP_LENGTH": [0.8, 1.2],
    },
    "contact/solvers/active_set/spline_model.py": {
        "_TRUST": [1e-4, 0.05],
        "_FALL": [0.0, 0.5],
        "_BEND": [0.0, 0.4],
        "_STIFF": [1.1, 3.0, _NEVER],
        "_STIFF_MIDDLE": [2.0, 2.8],
        "_STIFF_FALL": [-0.3, 0.1],
        "_STIFF_BEND": [0.4, 1.0],
        "_CORRECTION": [0.0, 0.5, 1.0],
        "_AHEAD": [1, 9],
        "_STEEP": [2.0, _NEVER],
    },
    "core/engine/protocol.py": {"SQUARE_SIDE": [8, 32, 64]},
    "contact/couplings/position.py": {
        "TARGET_ERROR": [1e-11, 1e-7],
        "_HEIGHT_ERROR": [0.0, 1e-7],
        "_LARGEST_SHARE": [1.0, 1e4],
        "_SOLVER_SHARE": [1e-3, 0.1],
        "_FINEST": [1e-12, 1e-8],
        "_LOOSE": [1.0, 1e5],
        "_PERSSON": [0.3, 0.6],
        "_LIGHT": [0.5, 1.0],
        "_AT_FULL": [0.4, 1.2],
        "_FARTHEST": [0.69, 3.47],
        "_INSIDE": [0.0, 0.1],
        "_CLOSED": [0.0, 1e-9],
        "_TOWARDS": [0.0, 1.0],
    },
}
"""Other values by file below ``src/asperity`` and name."""

USED_IN = {"SQUARE_SIDE": "core/engine/cpu.py"}
"""Where a constant is read, if not in the file that declares it."""

FOR_VERY_STIFF_FILMS = (
    "_STEEP",
    "_SETTLING_FROM",
    "_MODEL_STEPS",
    "_MOST_UNSUCCESSFUL",
    "_MOST_REFINEMENTS",
    "_CLOSER",
    "_CLOSER_DOUBLINGS",
)
"""Constants that bear on films alone on which unclipped steps fail."""

Case = tuple[str, asp.ContactProblem, Any, asp.solvers.ActiveSet]
"""Kind, problem, control and solver."""


@dataclass(frozen=True)
class Constant:
    """A constant as it stands in the source; ``reason`` is the first sentence of the text below
    it."""

    file: str
    name: str
    value: str
    reason: str

    def cells(self) -> list[str]:
        """Name, value and reason as they stand on the page."""
        return [f"`{self.name}`", self.value, self.reason.replace("|", "\\|")]


def constants(file: str) -> dict[str, Constant]:
    """Constants that the module ``file`` assigns, alone or several in a line."""
    body = ast.parse((ROOT / "src" / "asperity" / file).read_text(encoding="utf-8")).body
    found = {}
    for node, after in zip(body, [*body[1:], ast.Pass()], strict=True):
        names, values = _assigned(node)
        text = ""
        if isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant):
            text = " ".join(str(after.value.value).split())
        for name, value in zip(names, values, strict=True):
            found[name] = Constant(file, name, ast.unparse(value), text)
    return found


def _assigned(node: ast.stmt) -> tuple[list[str], list[ast.expr]]:
    """Names that ``node`` gives a value, and the values."""
    if isinstance(node, ast.AnnAssign) and node.value is not None:
        return [ast.unparse(node.target)], [node.value]
    if not isinstance(node, ast.Assign):
        return [], []
    target, value = node.targets[0], node.value
    if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple):
        return [ast.unparse(one) for one in target.elts], value.elts
    return [ast.unparse(target)], [value]


def positions(*, large: bool) -> Iterator[Case]:
    """Prescribed positions: anywhere, near full contact, under a hardness, with a film of
    liquid."""
    for seed in (1, 2) if large else (1,):
        surface = self_affine(128, seed=seed)
        top, rms = float(surface.heights.max() - surface.heights.mean()), float(surface.heights.std())
        film = asp.LiquidFilm(surface_tension=0.01 * rms, thickness=0.3 * rms)
        elastic, hard = asp.ContactProblem(surface, BODY), asp.ContactProblem(surface, BODY, law=asp.Hardness(0.3))
        found = [("periodic", elastic, asp.MeanGap(top * (1.0 - share))) for share in (0.02, 0.3, 0.7, 0.97)]
        found += [("full", elastic, asp.MeanGap(1e-3 * rms)), ("full", elastic, asp.Approach(0.9999 * top))]
        for share in (0.3, 0.8):
            found.append(("cap", hard, asp.MeanGap(top * (1.0 - share))))
            found.append(("wet", asp.ContactProblem(surface, BODY, film=film), asp.Approach(top * share)))
        yield from ((*case, asp.solvers.ActiveSet()) for case in found)


def loads(*, large: bool) -> Iterator[Case]:
    """Loads over E* on half-spaces, films, free boundaries, under a hardness, to 1e-10, and with
    monotone steps."""
    loose, tight = asp.solvers.ActiveSet(tolerance=1e-6), asp.solvers.ActiveSet(tolerance=1e-10)
    monotone = asp.solvers.ActiveSet(tolerance=1e-6, monotone=True)
    for seed in (1, 2) if large else (1,):
        wide, small = self_affine(512 if large else 256, seed=seed), self_affine(256 if large else 128, seed=seed)
        for load in (0.01, 0.05, 0.2):
            yield "elastic", asp.ContactProblem(wide, BODY), asp.MeanPressure(load), loose
        for thickness, load in ((4.0, 0.2), (20.0, 0.4)):
            film = asp.Layered([asp.Layer(asp.Elastic(10.0, 0.3), thickness)], base=asp.Elastic(1.0, 0.3))
            yield "film", asp.ContactProblem(wide, film), asp.MeanPressure(load), loose
        for load in (0.02, 0.1):
            yield "free", asp.ContactProblem(small, BODY, boundary=asp.Free()), asp.MeanPressure(load), loose
            yield "cap", asp.ContactProblem(small, BODY, law=asp.Hardness(0.3)), asp.MeanPressure(load), loose
            yield "tight", asp.ContactProblem(small, BODY), asp.MeanPressure(load), tight
            yield "monotone", asp.ContactProblem(small, BODY), asp.MeanPressure(load), monotone


def very_stiff_films(*, large: bool) -> Iterator[Case]:
    """Films of E 300 and 1000, one and two pixels thick."""
    for seed in (1, 2) if large else (1,):
        for n in (128, 256) if large else (128,):
            for ratio, thickness in ((300.0, 1.0), (1000.0, 1.0), (1000.0, 2.0)):
                film = asp.Layered([asp.Layer(asp.Elastic(ratio, 0.3), thickness)], base=asp.Elastic(1.0, 0.3))
                problem = asp.ContactProblem(self_affine(n, seed=seed), film)
                for load in (0.3, 0.75):
                    yield "stiff", problem, asp.MeanPressure(load), asp.solvers.ActiveSet(tolerance=1e-6)


@dataclass
class Cost:
    """FFT pairs by kind of problem, kinds of those without a solution, and processor time in s."""

    pairs: dict[str, list[float]] = field(default_factory=lambda: defaultdict(list))
    failed: list[str] = field(default_factory=list)
    seconds: float = 0.0

    def means(self) -> dict[str, float]:
        """Mean pairs of each kind, those without a solution left out."""
        return {kind: statistics.fmean(values) for kind, values in self.pairs.items()}


def cost(cases: Iterator[Case]) -> Cost:
    """Solve all ``cases`` on one thread."""
    for models in (spline_model._fit, spline_model._levels):  # fitted with other constants
        models.cache_clear()
    found = Cost()
    for kind, problem, control, method in cases:
        started = time.process_time()
        try:
            result = asp.solve(
                problem,
                control,
                solver=method,
                keep=asp.Keep(stiffness=False),
                engine=asp.engines.CpuEngine(1),
            )
        except asp.ConvergenceError:
            found.failed.append(kind)
            continue
        finally:
            found.seconds += time.process_time() - started
        found.pairs[kind].append(result.certificate.fft_pairs)
    return found


def least(costs: list[Cost]) -> Cost:
    """The one of ``costs`` of equal work that took the least time."""
    return min(costs, key=lambda cost: cost.seconds)


def told(usual: Cost, other: Cost) -> str:
    """What ``other`` changes, in a few words: kinds whose pairs differ by 0.1 and more, and the
    time."""
    before = usual.means()
    parts = [
        f"{kind} {mean:.1f} for {before[kind]:.1f}"
        for kind, mean in other.means().items()
        if kind in before and abs(mean - before[kind]) >= 0.05
    ]
    parts += [f"{other.failed.count(kind)} {kind} without a solution" for kind in dict.fromkeys(other.failed)]
    return f"{', '.join(parts) or 'the same pairs'}, time × {other.seconds / usual.seconds:.2f}"


def shown(value: object) -> str:
    """``value`` as in the source, shortly."""
    if isinstance(value, Stopping):
        return f"reduction {value.reduction:g}, {value.max_steps} steps"
    return "never" if value == _NEVER else f"{value:g}" if isinstance(value, float) else str(value)


def asked(name: str, *, large: bool) -> Callable[[], Iterator[Case]]:
    """The problems on which the constant ``name`` bears."""
    kind = loads
    if name in FOR_VERY_STIFF_FILMS:
        kind = very_stiff_films
    elif name in SWEPT["contact/couplings/position.py"]:
        kind = positions
    return lambda: kind(large=large)


def swept(file: str, name: str, *, large: bool, repeats: int, usual_times: dict[Any, list[float]]) -> list[str]:
    """Row of the constant ``name``: what other values change. Times of the usual value are added to
    ``usual_times``."""
    module = importlib.import_module("asperity." + USED_IN.get(name, file).removesuffix(".py").replace("/", "."))
    constant, cases, kept = constants(file)[name], asked(name, large=large), getattr(module, name)
    usual, others = [], [[] for _ in SWEPT[file][name]]
    try:
        for _ in range(repeats):
            setattr(module, name, kept)
            usual.append(cost(cases()))
            for value, costs in zip(SWEPT[file][name], others, strict=True):
                setattr(module, name, value)
                costs.append(cost(cases()))
    finally:
        setattr(module, name, kept)
    before = least(usual)
    usual_times[tuple(before.means())].append(before.seconds)
    texts = [
        f"{shown(value)}: {told(before, least(costs))}" for value, costs in zip(SWEPT[file][name], others, strict=True)
    ]
    print(f"{name} {constant.value}: {'; '.join(texts)}", flush=True)
    return [*constant.cells(), "; ".join(texts)]


HEAD = """---
hide-toc: true
---

# Constants of the solver

Made by `python benchmarks/constants.py --write`: what the numbers in the source of the solver are for,
and what other values change. One constant is changed at a time; given are mean FFT pairs of the kinds
of problems whose pairs differ, *with the other value* for *with that of the source*, and the processor
time over that with the value of the source. Where no value changes any pairs, the constant is not delicate.

"""

ABOUT = """Problems, on self-affine surfaces of unit rms slope ({seeds}): *elastic*, half-space at 0.01, 0.05 and
0.2 E\\* on {wide}² points; *film*, E 10 on 4 and 20 pixels; *free* boundary, *cap* of 0.3 E\\*, *tight*
tolerance of 1e-10, *monotone* steps, each at 0.02 and 0.1 E\\* on {small}²; *stiff*, films of E 300 and
1000 of one and two pixels; and prescribed positions on 128² points: *periodic*, near *full* contact,
under a *cap*, and *wet* ones.
"""


def page(tables: dict[str, list[list[str]]], times: dict[Any, list[float]], *, large: bool) -> str:
    """Text of the page."""
    about = made("constants", ["constant", "value", "for", "other values"], [])
    seeds, wide, small = ("seeds 1 and 2", 512, 256) if large else ("seed 1", 256, 128)
    scatter = max(statistics.stdev(some) / statistics.fmean(some) for some in times.values() if len(some) > 2)
    text = (
        f"{HEAD}*{about.date}; {machine()}*  \n`{about.command} --write`\n\nTimes of equal work scatter by "
        f"{100 * scatter:.0f} %.\n\n"
    )
    text += ABOUT.format(seeds=seeds, wide=wide, small=small)
    for file, rows in tables.items():
        text += f"\n## `src/asperity/{file}`\n\n| {' | '.join(about.columns)} |\n|---|---|---|---|\n"
        text += "".join(f"| {' | '.join(row)} |\n" for row in rows)
    return text


def outdated() -> list[str]:
    """Constants of the list that the source lacks, or that the page shows with another value or
    reason."""
    text, found = PAGE.read_text(encoding="utf-8"), []
    for file, names in SWEPT.items():
        known = constants(file)
        for name in names:
            if name not in known:
                found.append(f"src/asperity/{file} assigns no {name}")
            elif f"| {' | '.join(known[name].cells())} |" not in text:
                found.append(f"{name} of src/asperity/{file} is now {known[name].value}: {known[name].reason}")
    return found


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("names", nargs="*", help="constants; all by default")
    parser.add_argument("--large", action="store_true", help="two surfaces and twice the points along each side")
    parser.add_argument("--repeats", type=int, default=3, help="rounds, of which the least time counts")
    parser.add_argument("--write", action="store_true", help="make docs/develop/constants.md; of all constants only")
    parser.add_argument("--check", action="store_true", help="only compare the page with the source")
    given = parser.parse_args()
    if given.check:
        found = outdated()
        print("\n".join(found), file=sys.stderr)
        return 1 if found else 0
    if given.write and given.names:
        parser.error("--write takes all constants: leave out the names.")
    times: dict[Any, list[float]] = defaultdict(list)
    tables = {}
    for kind in (loads, positions, very_stiff_films):
        cost(kind(large=given.large))  # compiles
    for file, names in SWEPT.items():
        rows = [
            swept(file, name, large=given.large, repeats=given.repeats, usual_times=times)
            for name in names
            if not given.names or name in given.names
        ]
        if rows:
            tables[file] = rows
    if given.write:
        replace(PAGE, page(tables, times, large=given.large))
    return 0


if __name__ == "__main__":
    sys.exit(main())
