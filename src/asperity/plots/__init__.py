"""Layer 4: figures of surfaces and contacts; functions (data, ax) -> ax, and the standard set as files."""

from .figures import PLOTS, Plot, render, save_plots, save_surface_plot
from .histogram import plot_gap_histogram, plot_pressure_histogram
from .maps import plot_contact, plot_gap, plot_heights, plot_pressure
from .section import plot_section
from .style import style

__all__ = [
    "PLOTS",
    "Plot",
    "plot_contact",
    "plot_gap",
    "plot_gap_histogram",
    "plot_heights",
    "plot_pressure",
    "plot_pressure_histogram",
    "plot_section",
    "render",
    "save_plots",
    "save_surface_plot",
    "style",
]
