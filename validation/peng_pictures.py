"""Pictures after figs 3.1 to 3.22 of Peng (2001), drawn from the cases of the other pages;
``pictures.py`` writes them.

The numbers and trends are on the pages peng_scaling, peng_stress, rough_cylinder and rough_sphere.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
import peng
import peng_scaling
import peng_stress
import rough_cylinder
import rough_sphere

import asperity as asp
from asperity.plots import plot_heights, plot_stress_section
from asperity.plots.picture import BLACK, BLUE, VERMILLION

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

REACH = 4.0
"""Half of the width in µm that pictures of the rough surface show."""

DECADES = 3.0
"""Powers of ten of the stress below the largest that are shown."""

LOADS = (2e-5, 5e-5, *peng_scaling.VALUES)
"""X of the curves."""

SURFACES = 12
"""Of which the curves are means."""

POINTS = 384
"""Along a side of the rough sphere."""

PER_REGION = 16
"""Depths of the stresses in each layer and in the base."""

COLOURS = {0.5: BLUE, 1.0: BLACK, 2.0: VERMILLION}
"""By E1/E2."""


def cylinder(figure: Figure) -> None:
    """Profile of the rough cylinder, pressures on the base, and on the layers with and without
    friction (figs 3.1, 3.2)."""
    axes = figure.subplots(3, 2, sharex=True)
    roughness = rough_cylinder.profile(0)
    cases = [(rough_cylinder.LAYERS[0], (0.0,)), *((layer, (0.0, 0.5)) for layer in rough_cylinder.LAYERS[1:])]
    for ax, (layer, frictions) in zip(axes.ravel()[1:], cases, strict=True):
        for friction, colour in zip(frictions, (BLUE, VERMILLION), strict=False):
            result = rough_cylinder.contact(layer, friction, roughness)
            x = result.problem.grid.centred_coordinates()[0][:, 0] / rough_cylinder.HALF_WIDTH
            ax.plot(
                x, result.pressure[:, 0] / rough_cylinder.HERTZ, color=colour, label=f"μ = {friction:g}", linewidth=0.9
            )
        ax.set_title(f"E₁/E₂ = {layer[0]:.2f}, h = {layer[1]:g} a₀" if layer[1] else "base alone")
        ax.set(ylabel="p/p₀")
    axes[0, 1].plot(x, np.sqrt(np.maximum(1.0 - x**2, 0.0)), color=BLACK, linestyle="--", linewidth=0.9)
    heights = asp.generate.cylinder(result.problem.grid, radius=rough_cylinder.RADIUS).heights[:, 0]
    axes[0, 0].plot(x, 1e6 * (heights + roughness), color=BLUE, linewidth=0.8)
    axes[0, 0].plot(x, 1e6 * heights, color=BLACK, linewidth=0.8)
    axes[0, 0].set(title="profile", ylabel="height (µm)", xlim=(-2.2, 2.2), ylim=(-1.3, 0.3))
    for ax in axes[-1]:
        ax.set_xlabel("x/a₀")
    axes[2, 0].legend(loc="upper left")
    figure.subplots_adjust(hspace=0.3)


def sphere(figure: Figure) -> None:
    """Profile, pressure and displacement of the rough sphere, and √J2 below it without and with the
    layer (figs 3.3, 3.4)."""
    left, right = np.asarray(figure.subfigures(1, 2), dtype=object)
    roughness = rough_sphere.ALIKE * rough_sphere.unit_roughness(0, POINTS)
    results = {name: rough_sphere.contact(name, roughness) for name in rough_sphere.BODIES}
    smooth = rough_sphere.contact("layered", np.zeros_like(roughness))
    result = results["layered"]
    row = roughness.shape[1] // 2
    x = result.problem.grid.centred_coordinates()[0][:, 0] / rough_sphere.CONTACT_RADIUS
    axes = left.subplots(3, 1, sharex=True)
    for one, colour in ((result, BLUE), (smooth, BLACK)):
        axes[0].plot(x, 1e6 * one.problem.surface.heights[:, row], color=colour, linewidth=0.8)
        axes[1].plot(x, one.pressure[:, row] / rough_sphere.HERTZ, color=colour, linewidth=0.8)
        axes[2].plot(x, 1e6 * one.displacement[:, row], color=colour, linewidth=0.8)
    for ax, label in zip(axes, ("height (µm)", "p/p₀", "u_z (µm)"), strict=True):
        ax.set_ylabel(label)
    axes[2].invert_yaxis()
    axes[2].set_xlabel("x/a₀ (blue: rough, black: smooth)")
    depths = asp.stresses.depths_through(
        rough_sphere.BODIES["layered"], rough_sphere.CONTACT_RADIUS, per_region=PER_REGION
    )
    for ax, (name, one) in zip(right.subplots(2, 1), results.items(), strict=True):
        field = asp.stress(one, depths, on=asp.stresses.Section(y=float(one.problem.grid.coordinates()[1][0, row])))
        plot_stress_section(field, ax, log=True)
        ax.set_title({"base": "base alone", "layered": "with the layer"}[name])
    right.subplots_adjust(left=0.14, right=0.8, hspace=0.35)
    left.subplots_adjust(left=0.2)


def scaling(figure: Figure) -> None:
    """Area and largest pressure against X, published rows among ours (fig. 3.18)."""
    axes = figure.subplots(1, 2)
    for ratio in peng_scaling.RATIOS:
        ours, theirs = peng_scaling.curve(ratio, SURFACES, 1, LOADS), peng_scaling.published(ratio, fewest=1)
        for ax, name in zip(axes, ("area", "peak"), strict=True):
            values = np.log(getattr(ours, name))
            middle, spread = values.mean(axis=0), 2.0 * values.std(axis=0, ddof=1)
            ax.fill_between(
                ours.x, np.exp(middle - spread), np.exp(middle + spread), color=COLOURS[ratio], alpha=0.2, lw=0
            )
            ax.plot(ours.x, np.exp(middle), color=COLOURS[ratio], label=f"E₁/E₂ = {ratio:g}")
            ax.plot(theirs.x, getattr(theirs, name)[0], "o", color=COLOURS[ratio], markersize=3.5)
    for ax, label, exponent, start in zip(axes, ("Aᵣ/Aₙ", "pₘₐₓβ*/E₂σ"), (1.0, 1.0 / 3.0), (2e-4, 6.0), strict=True):
        x = np.array([4e-4, 4e-3])
        ax.plot(x, start * (x / x[0]) ** exponent, color="0.5", linestyle=":")
        ax.set(xscale="log", yscale="log", xlabel="X = pₙβ*/E₂σ", ylabel=label)
    axes[0].legend()
    axes[0].set_title("line and band: ours, mean ± 2 sd; dots: table 3.1", loc="left")
    axes[1].set_title("dotted: the laws X and X^(1/3)", loc="left")
    figure.subplots_adjust(wspace=0.3)


def layers(figure: Figure) -> None:
    """Heights of a rough surface and the pressure on several layers (fig. 3.19)."""
    shape = peng.surfaces(1, peng.grid())[0]
    cases = [(1.0, 1e-6), *((ratio, thickness) for ratio in (2.0, 0.5) for thickness in (50e-9, 1e-6))]
    results = [_contact(shape, *case) for case in cases]
    x, y = (1e6 * at for at in _middle(results[0]))
    window = {"xlim": (x - REACH, x + REACH), "ylim": (y - REACH, y + REACH)}
    top = 1e-9 * max(result.max_pressure for result in results)
    for ax, result, (ratio, thickness) in zip(figure.subplots(2, 3).ravel()[1:], results, cases, strict=True):
        i, j = np.nonzero(result.contact)
        dx, dy = (1e6 * step for step in result.problem.grid.spacing)
        pressure = 1e-9 * result.pressure[i, j]
        dots = ax.scatter((i + 0.5) * dx, (j + 0.5) * dy, s=90.0 * pressure / top, c=pressure, vmin=0.0, vmax=top)
        ax.set(
            title=f"E₁/E₂ = {ratio:g}, h = {1e9 * thickness:.0f} nm" if ratio != 1.0 else "E₁ = E₂",
            aspect="equal",
            **window,
        )
        figure.colorbar(dots, ax=ax, label="pressure (GPa)", shrink=0.8)
    plot_heights(results[0].problem.surface, figure.axes[0])
    figure.axes[0].set(title="heights", **window)
    figure.subplots_adjust(wspace=0.6, hspace=0.3)


def stresses(figure: Figure, ratio: float) -> None:
    """√J2 on the surface, and √J2, σt and σxz on the plane through the largest pressure,
    logarithmic (figs 3.21, 3.22)."""
    cases = [(thickness, friction) for friction in (0.0, 0.5) for thickness in (250e-9, 1e-6)]
    shape = peng.surfaces(1, peng.grid())[0]
    results = {thickness: _contact(shape, ratio, thickness) for thickness, _ in cases}
    for row, (thickness, friction) in zip(figure.subplots(len(cases), 4), cases, strict=True):
        result = results[thickness]
        top = asp.stress(result, [0.0], friction=friction)
        depths = asp.stresses.depths_through(result.problem.body, 1.5e-6, per_region=PER_REGION)
        field = asp.stress(result, depths, on=asp.stresses.Section(y="max"), friction=friction)
        x, y = (1e6 * at for at in _middle(result))
        _stress(row[0], 1e6 * top.x, 1e6 * top.y, top.sqrt_J2[0].T)
        row[0].set(
            title=f"h = {1e9 * thickness:.0f} nm, μ = {friction:g}: √J2, z = 0",
            ylabel="y (µm)",
            ylim=(y - REACH, y + REACH),
        )
        for ax, name in zip(row[1:], peng_stress.NAMES, strict=True):
            _stress(ax, 1e6 * field.x, 1e6 * field.depth, getattr(field, name))
            ax.axhline(1e6 * thickness, color="0.3", linewidth=0.7)
            ax.set(
                title=f"{peng_stress.NAMES[name]}, y = {1e6 * float(field.y):.2f} µm",
                ylabel="depth (µm)",
                ylim=(1.5, 0.0),
            )
        for ax in row:
            ax.set(xlim=(x - REACH, x + REACH), xlabel="x (µm)")
    figure.subplots_adjust(wspace=0.45, hspace=0.6)


def _stress(ax: Axes, across: np.ndarray, down: np.ndarray, values: np.ndarray) -> None:
    """Map of ``values`` (Pa) in MPa on a logarithmic scale, of either sign where they have both."""
    from matplotlib.colors import LogNorm, SymLogNorm

    largest = 1e-6 * float(np.abs(values).max())
    least = largest * 10.0**-DECADES
    signed = bool(values.min() < 0.0)
    norm = SymLogNorm(least, vmin=-largest, vmax=largest) if signed else LogNorm(least, largest, clip=True)
    colours = "RdBu_r" if signed else "viridis"
    drawn = ax.pcolormesh(across, down, 1e-6 * values, shading="nearest", norm=norm, cmap=colours)
    decades = 10.0 ** np.arange(np.ceil(np.log10(least)), np.log10(largest))
    ticks = [*-decades[::-1], 0.0, *decades] if signed else decades
    bar = ax.figure.colorbar(drawn, ax=ax, label="MPa", ticks=ticks, format="%g")
    bar.ax.minorticks_off()


def _contact(shape: asp.Surface, ratio: float, thickness: float) -> asp.ContactResult:
    case = peng.Case(ratio, peng_stress.LOAD, peng_stress.RMS)
    return next(peng.contacts(case, [shape], body=peng.coated(ratio, thickness), boundary=asp.Free()))


def _middle(result: asp.ContactResult) -> tuple[float, float]:
    """Middle (m) of the pixel of the largest pressure, moved so that the window of ``REACH`` lies
    inside the cell."""
    i, j = np.unravel_index(int(np.argmax(result.pressure)), result.pressure.shape)
    dx, dy = result.problem.grid.spacing
    low, high = 1e-6 * REACH, peng.SIDE - 1e-6 * REACH
    return min(max((i + 0.5) * dx, low), high), min(max((j + 0.5) * dy, low), high)


FIGURES: dict[str, tuple[Callable[[Figure], None], tuple[float, float]]] = {
    "peng_cylinder": (cylinder, (8.0, 7.0)),
    "peng_sphere": (sphere, (11.0, 6.0)),
    "peng_scaling": (scaling, (8.0, 3.6)),
    "peng_layers": (layers, (11.0, 6.0)),
    "peng_stresses_stiff": (lambda figure: stresses(figure, 2.0), (16.0, 10.0)),
    "peng_stresses_compliant": (lambda figure: stresses(figure, 0.5), (16.0, 10.0)),
}
"""Name of the file -> how to draw it, width and height in inches."""
