"""Draws ``choose.png``, which theory holds when: of a rough surface by the real area, of an
adhesive sphere by Tabor's parameter.

``python docs/start/choose.py`` takes half a minute. Where a theory holds is asked of the theory
itself, on one generated surface.
"""

from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import asperity as asp
from asperity.theories import theory

E_STAR, HARDNESS = 1e11, 8e9
ROWS = (
    ("bush-gibson-thomas", "moments of the spectrum", "tab:blue"),
    ("greenwood-elliptic", "moments of the spectrum", "tab:blue"),
    ("mccool", "moments of the spectrum", "tab:blue"),
    ("greenwood-williamson", "summits of the map", "tab:blue"),
    ("discrete-summits", "every summit of the map", "tab:blue"),
    ("interacting-crests", "every summit of the map", "tab:blue"),
    ("persson", "slope; spectrum for the gap", "tab:blue"),
    ("kogut-etsion", "summits, hardness", "tab:orange"),
    ("jackson-green", "summits, yield stress", "tab:orange"),
)
"""Theories of rough surfaces, what they need, and the colour of what they are about."""

KINDS = {"tab:blue": "elastic", "tab:orange": "elastic-plastic"}
SPHERES = (("dmt", "stiff bodies, small radii"), ("maugis-dugdale", "any"), ("jkr", "soft bodies, large radii"))


def spans(name: str, roughness: asp.roughness.Roughness) -> tuple[np.ndarray, np.ndarray]:
    """Area fractions that the theory gives, and whether all its limits hold there that concern the
    area."""
    kind = theory(name)
    known = {"E_star": E_STAR, "hardness": HARDNESS, "yield_stress": HARDNESS / 2.8}
    bodies = {item.name: known[item.name] for item in kind.inputs if item.of == "bodies" and item.required}
    made = kind.from_roughness(roughness, **bodies)
    pressures = E_STAR * roughness.rms_gradient * np.geomspace(1e-5, 1.0, 41)
    found = []
    for pressure in pressures:
        try:
            answer = made.at_pressure([pressure])
            limits = made.validity(answer, roughness)
        except asp.errors.AsperityError:
            continue
        area = float(answer.area_fraction[0])
        if 0.0 < area <= 1.0:
            found.append((area, all(limit.holds.all() for limit in limits if limit.concerns("area_fraction"))))
    return tuple(np.array(column) for column in zip(*found, strict=True))


def draw(path: Path) -> None:
    """Ask the theories and write the picture to ``path``."""
    waves = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.05), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=1.6e-7
    )
    roughness = asp.roughness_of(asp.generate.gaussian(asp.Grid((192, 192), (2e-8, 2e-8)), waves, seed=1))
    figure, (rough, sphere) = plt.subplots(2, 1, figsize=(9.0, 5.8), height_ratios=(9, 3.4), layout="constrained")
    for row, (name, needs, colour) in enumerate(ROWS):
        area, holds = spans(name, roughness)
        rough.plot(area, np.full(area.size, row), color="0.85", linewidth=7.0, solid_capstyle="butt")
        rough.plot(area, np.where(holds, row, np.nan), color=colour, linewidth=7.0, solid_capstyle="butt")
        rough.text(1.25e-4, row - 0.36, f"needs {needs}", fontsize=7.5, va="center", color="0.35")
    for colour, kind in KINDS.items():
        rough.plot([], [], color=colour, linewidth=7.0, label=kind)
    rough.plot([], [], color="0.85", linewidth=7.0, label="beyond its limits")
    rough.set(
        xscale="log",
        xlim=(1e-4, 1.0),
        ylim=(len(ROWS) - 0.4, -0.8),
        xlabel="real area / nominal area",
        title="A rough surface",
    )
    rough.set_yticks(range(len(ROWS)), [name for name, *_ in ROWS])
    rough.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
    low, high = 1e-3, 1e3
    for row, (name, when) in enumerate(SPHERES):
        bounds = [bound for bound in theory(name).limits if bound.criterion == "Tabor's parameter"]
        ends = (max(low, bounds[0].low), min(high, bounds[0].high)) if bounds else (low, high)
        sphere.plot(ends, (row, row), color="tab:green", linewidth=7.0, solid_capstyle="butt")
        sphere.text(1.3e-3, row - 0.42, when, fontsize=7.5, va="center", color="0.35")
    sphere.set(
        xscale="log",
        xlim=(low, high),
        ylim=(2.5, -0.9),
        xlabel="Tabor's parameter (R w²/E*² z₀³)^⅓",
        title="One adhesive sphere",
    )
    sphere.set_yticks(range(3), [name for name, _ in SPHERES])
    for axes in (rough, sphere):
        axes.grid(axis="x", color="0.92")
        axes.set_axisbelow(True)
    figure.savefig(path, dpi=110)
    plt.close(figure)


if __name__ == "__main__":
    draw(Path(__file__).with_suffix(".png"))
