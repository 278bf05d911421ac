"""Time and FFT pairs against grid size, and error against time."""

from __future__ import annotations

from pathlib import Path

from history import Clock
from measure import Row


def draw(path: Path, rows: list[Row], histories: dict[str, Clock], title: str) -> None:
    """Write the figure to ``path``."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, (times, pairs, errors) = pyplot.subplots(1, 3, figsize=(15, 4.5), layout="constrained")
    loads = sorted({row.load for row in rows})
    for index, solver in enumerate(dict.fromkeys(row.solver for row in rows)):
        for load, style in zip(loads, ("-", "--", ":", "-."), strict=False):
            mine = [row for row in rows if row.solver == solver and row.load == load and row.seconds]
            label = solver if load == loads[0] else None
            sizes, look = [row.n for row in mine], {"color": f"C{index}", "ls": style, "marker": "o", "label": label}
            times.loglog(sizes, [row.median for row in mine], **look)
            if mine and "pairs" in mine[0].counts:
                pairs.semilogx(sizes, [row.counts["pairs"] for row in mine], **look)
    for name, clock in histories.items():
        errors.loglog(clock.seconds, clock.errors, label=name)
    times.set(xlabel="points per side", ylabel="time (s)", title=f"loads {loads}: solid, dashed, dotted")
    pairs.set(xlabel="points per side", ylabel="FFT pairs of the grid", title="work of our solvers")
    errors.set(xlabel="time (s)", ylabel="the field's error", title=title)
    pairs.set_ylim(bottom=0.0)
    for axes in (times, pairs):
        axes.set_xticks(sorted({row.n for row in rows}), [str(n) for n in sorted({row.n for row in rows})])
        axes.minorticks_off()
    for axes in (times, pairs, errors):
        axes.grid(visible=True, alpha=0.3)
        axes.legend()
    figure.savefig(path, dpi=120)
    pyplot.close(figure)
