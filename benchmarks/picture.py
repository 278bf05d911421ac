"""Speed in one picture, from the stored tables: ``python benchmarks/picture.py`` writes
docs/start/speed.png."""

from __future__ import annotations

from pathlib import Path

from tables import stored

PICTURE = Path(__file__).parents[1] / "docs" / "start" / "speed.png"
LOAD = "0.05"
COLOURS = {
    "asperity": "#0072b2",
    "ASPHER": "#e69f00",
    "Tamaas": "#009e73",
    "ContactMechanics": "#cc79a7",
}
"""Of packages, told apart by readers who see few colours too."""
MARKS = {"asperity": "o", "ASPHER": "s", "Tamaas": "^", "ContactMechanics": "v"}


def main() -> None:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    pyplot.rcParams.update({"font.size": 10, "axes.spines.top": False, "axes.spines.right": False})
    figure, (times, pairs, bodies) = pyplot.subplots(1, 3, figsize=(13, 4.2), layout="constrained")
    others, solves, layers = stored("packages-one-thread"), stored("solves"), stored("layers")

    for name, colour in COLOURS.items():
        sizes = others.column("n", solver=name, load=LOAD)
        seconds = others.column("median (s)", solver=name, load=LOAD)
        times.loglog(sizes, seconds, marker=MARKS[name], color=colour, label=name)
    ticks = sorted(set(others.column("n", load=LOAD)))
    times.set_xticks(ticks, [f"{n:.0f}²" for n in ticks])
    times.minorticks_off()
    times.set_ylim(bottom=0.01)  # room for the names
    times.set(xlabel="points", ylabel="time of a solve (s)", title=f"One thread, mean pressure {LOAD} E*")
    times.legend(frameon=False, loc="lower right")

    for load, mark in zip(dict.fromkeys(row[1] for row in solves.rows), "osv", strict=False):
        sizes = solves.column("n", load=load, solver="asperity")
        pairs.semilogx(sizes, solves.column("pairs", load=load, solver="asperity"), marker=mark, label=f"{load} E*")
    ticks = sorted(set(solves.column("n")))
    pairs.set_xticks(ticks, [f"{n:.0f}²" for n in ticks])
    pairs.minorticks_off()
    pairs.set_ylim(bottom=0.0)
    pairs.set(xlabel="points", ylabel="FFT pairs", title="Work of asperity")
    pairs.legend(title="mean pressure", frameon=False, loc="lower right")

    n = layers.rows[-1][0]
    names = [row[1] for row in layers.rows if row[0] == n]
    ratios = layers.column("× homogeneous", n=n)
    bodies.barh(names[::-1], ratios[::-1], color=COLOURS["asperity"])
    bodies.axvline(1.0, color="black", linewidth=0.8)
    bodies.set(
        xlabel="time over homogeneous (E over base, h in pixels)",
        title=f"Layered bodies, {n}²",
    )
    bodies.tick_params(axis="y", labelsize=8)

    for axes in (times, pairs):
        axes.grid(visible=True, alpha=0.3)
    figure.savefig(PICTURE, dpi=110)
    print(f"written: {PICTURE.relative_to(Path(__file__).parents[1])}")


if __name__ == "__main__":
    main()
