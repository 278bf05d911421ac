"""Layer 4: figures of surfaces and contacts; functions (data, ax) -> ax, and the standard set as files."""

from .figures import PLOTS, Plot, render, save_plots, save_surface_plot
from .histogram import plot_gap_histogram, plot_pressure_histogram
from .maps import plot_contact, plot_gap, plot_heights, plot_pressure
from .section import plot_section
from .spectrum import plot_scale_dependence, plot_spectrum
from .stress import plot_stress_map, plot_stress_profile, plot_stress_section
from .style import style
from .surface_curves import plot_autocorrelation, plot_height_distribution, plot_material_ratio
from .surface_figures import SURFACE_PLOTS, SurfacePlot, render_surface_plot, save_roughness_plots
from .surface_view import plot_summits, plot_surface_view

__all__ = [
    "PLOTS",
    "SURFACE_PLOTS",
    "Plot",
    "SurfacePlot",
    "plot_autocorrelation",
    "plot_contact",
    "plot_gap",
    "plot_gap_histogram",
    "plot_height_distribution",
    "plot_heights",
    "plot_material_ratio",
    "plot_pressure",
    "plot_pressure_histogram",
    "plot_scale_dependence",
    "plot_section",
    "plot_spectrum",
    "plot_stress_map",
    "plot_stress_profile",
    "plot_stress_section",
    "plot_summits",
    "plot_surface_view",
    "render",
    "render_surface_plot",
    "save_plots",
    "save_roughness_plots",
    "save_surface_plot",
    "style",
]
