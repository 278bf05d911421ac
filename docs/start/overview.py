"""Draws ``overview.png``, the picture of README and front page: a surface, its contact, the stress
below the coating.

``python docs/start/overview.py`` takes some ten seconds.
"""

from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

POINTS, SIZE = 384, 4e-6
COATING = 100e-9
LOAD = 200e6
FRICTION = 0.3


def draw(path: Path) -> None:
    """Solve the problem and write the picture to ``path``."""
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(5e-9), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=150e-9
    )
    grid = asp.Grid((POINTS, POINTS), (SIZE / POINTS, SIZE / POINTS))
    surface = asp.generate.gaussian(grid, spectrum, seed=12)
    disk = asp.Layered([asp.Layer(asp.material("DLC"), COATING)], base=asp.material("bearing steel"))
    result = asp.solve(asp.ContactProblem(surface, disk), asp.MeanPressure(LOAD))
    depths = np.concatenate([np.linspace(0.0, COATING, 24), np.linspace(1.05 * COATING, 4.0 * COATING, 40)])
    section = asp.stress(result, depths, on=asp.stresses.Section(y="max"), friction=FRICTION)

    figure = plt.figure(figsize=(12.0, 3.7), layout="constrained")
    axes = figure.subplots(1, 3, width_ratios=(1.0, 1.0, 1.25))
    edge = SIZE * 1e6
    heights = axes[0].imshow(surface.heights.T * 1e9, origin="lower", extent=(0, edge, 0, edge), cmap="cividis")
    figure.colorbar(heights, ax=axes[0], label="height (nm)", shrink=0.82)
    axes[0].set(title="surface", xlabel="x (µm)", ylabel="y (µm)")
    pressure = np.ma.masked_equal(result.pressure.T * 1e-9, 0.0)
    axes[1].imshow(surface.heights.T, origin="lower", extent=(0, edge, 0, edge), cmap="Greys_r", alpha=0.45)
    shown = axes[1].imshow(pressure, origin="lower", extent=(0, edge, 0, edge), cmap="inferno")
    figure.colorbar(shown, ax=axes[1], label="pressure (GPa)", shrink=0.82)
    share = 100.0 * result.area_fraction_corrected
    axes[1].set(title=f"contact at {LOAD * 1e-6:.0f} MPa: {share:.1f} % of the area", xlabel="x (µm)")
    mises = section.von_mises.reshape(len(section.planes), -1) * 1e-9
    planes = np.array([plane.depth for plane in section.planes])
    middle = int(np.argmax(mises.max(axis=0)))
    pixels = np.arange(POINTS)
    near = np.clip(middle - POINTS // 6, 0, POINTS - POINTS // 3) + pixels[: POINTS // 3]
    x = near * SIZE / POINTS * 1e6
    levels = np.linspace(0.0, np.ceil(mises[:, near].max()), 21)
    filled = axes[2].contourf(x, planes * 1e9, mises[:, near], levels=levels, cmap="magma")
    axes[2].axhline(COATING * 1e9, color="white", linewidth=1.2)
    axes[2].text(x[2], 0.93 * COATING * 1e9, "coating", color="white", va="bottom", ha="left", fontsize=9)
    axes[2].text(x[2], 1.10 * COATING * 1e9, "steel", color="white", va="top", ha="left", fontsize=9)
    axes[2].invert_yaxis()
    axes[2].set(title=f"von Mises stress, sliding, friction {FRICTION}", xlabel="x (µm)", ylabel="depth (nm)")
    figure.colorbar(
        filled, ax=axes[2], label="GPa", shrink=0.82, ticks=np.arange(0.0, levels[-1] + 1.0, max(1.0, levels[-1] // 5))
    )
    figure.savefig(path, dpi=110)
    plt.close(figure)


if __name__ == "__main__":
    draw(Path(__file__).with_suffix(".png"))
