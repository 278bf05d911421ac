"""Figures of plastic flow below the surface."""

from __future__ import annotations

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from asperity.physics.plastic_flow.figures import Cut, PlasticPicture, plots_of


def test_the_mesh_of_an_indentation_has_its_lines_and_interfaces() -> None:
    """In one unit, depth downwards; an interface below what is shown is left out."""
    across, depth = np.array([0.0, 1.0, 2.5, 6.0]) * 1e-7, np.array([0.0, 0.5, 1.5, 3.0, 6.0]) * 1e-7
    cut = Cut(across, depth, np.zeros((3, 4)), (1.5e-7, 9e-7), ("film", "layer", "base"), "r")
    shown = PlasticPicture(cut)
    (plot,) = (plot for plot in plots_of(shown, "indentation") if plot.name == "indentation_mesh")
    assert all(plot.name != "flow_mesh" for plot in plots_of(shown, "flow"))
    figure = Figure()
    FigureCanvasAgg(figure)
    ax = plot.draw(shown, figure.add_subplot())
    upright, level = (np.array(lines.get_segments()) for lines in ax.collections)
    np.testing.assert_allclose(upright[:, 0, 0], [0.0, 100.0, 250.0, 600.0], atol=1e-9)
    np.testing.assert_allclose(level[:, 0, 1], [0.0, 50.0, 150.0, 300.0, 600.0], atol=1e-9)
    (interface,) = ax.lines
    np.testing.assert_allclose(interface.get_ydata(), 150.0, rtol=1e-12)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("r (nm)", "depth (nm)")
    np.testing.assert_allclose(ax.get_ylim(), (600.0, 0.0), rtol=1e-12)
