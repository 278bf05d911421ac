"""Maps over two axes of a study: what their cells say where a page reads them out, and where they
lie on the picture."""

from __future__ import annotations

import numpy as np

from asperity.core.quantity import Labelled, Limit, Quantity
from asperity.plots.picture import curve_figure
from asperity.plots.sweeps import plot_planes
from asperity.report.scene import curves_of

LOADS = Labelled(Quantity("load", "Pa", "load"), np.array([3e6, 1e6, 2e6]))
LAYERS = Labelled(Quantity("thickness", "m", "thickness"), np.array([1e-6, 2e-6]))


def found(titles: list[str], limit: Limit | None) -> list[dict[str, object]]:
    pressures = 1e3 * LOADS.values[:, None] * np.ones(2) + 1e8 * np.arange(2)
    pressures[0, 1] = np.nan
    stack = Labelled(Quantity("max_pressure", "Pa", "largest pressure"), np.stack([pressures] * len(titles)))
    figure = curve_figure("map", "Map", "", lambda ax: plot_planes(LOADS, LAYERS, stack, titles, limit, ax))
    return curves_of(figure.drawing.curves)


def test_every_cell_says_its_place_and_value() -> None:
    """Rows from the top, in the order of the axes, whatever the order of the values."""
    (axes,) = found([""], Limit(2.05e9, least=False))
    assert axes["cells"] is True
    assert [row["texts"] for row in axes["curves"]] == [
        [
            "load 1 MPa, thickness 2 µm: largest pressure 1.1 GPa, limit (at most 2.05 GPa) met",
            "load 2 MPa, thickness 2 µm: largest pressure 2.1 GPa, limit (at most 2.05 GPa) missed",
            "load 3 MPa, thickness 2 µm: largest pressure not known",
        ],
        [
            "load 1 MPa, thickness 1 µm: largest pressure 1 GPa, limit (at most 2.05 GPa) met",
            "load 2 MPa, thickness 1 µm: largest pressure 2 GPa, limit (at most 2.05 GPa) met",
            "load 3 MPa, thickness 1 µm: largest pressure 3 GPa, limit (at most 2.05 GPa) missed",
        ],
    ]
    limits = axes["x"]["limits"]  # type: ignore[index]
    assert limits == [-0.5, 2.5]


def test_every_panel_has_cells_of_its_own() -> None:
    panels = found(["DLC", "gold"], None)
    assert [axes["curves"][0]["texts"][0] for axes in panels] == [  # type: ignore[index]
        f"{name}, load 1 MPa, thickness 2 µm: largest pressure 1.1 GPa" for name in ("DLC", "gold")
    ]
    assert panels[0]["box"][2] < panels[1]["box"][0]  # type: ignore[index]


def test_curves_without_words_of_their_own_are_as_they_were() -> None:
    figure = curve_figure("line", "Line", "", lambda ax: ax.plot([1.0, 2.0], [3.0, 4.0], label="a")[0].axes)
    (axes,) = curves_of(figure.drawing.curves)
    assert "cells" not in axes
    assert axes["curves"][0].keys() == {"name", "x", "y"}
