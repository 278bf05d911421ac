"""Layer 4: figures of surfaces and contacts; functions (data, ax) -> ax, and the standard set as files."""

from .campaign import (
    plot_convergence,
    plot_curves,
    plot_running_mean,
    plot_samples,
    plot_sensitivities,
    plot_transitions,
)
from .figures import PLASTIC_PLOTS, PLOTS, Plot, render, save_plots, save_surface_plot
from .histogram import plot_gap_histogram, plot_pressure_histogram
from .maps import plot_contact, plot_gap, plot_heights, plot_indentation, plot_pressure, plot_residual
from .path_curves import plot_area_loop, plot_energies, plot_load_loop
from .path_figures import PATH_PLOTS, PathPlot, render_path_plot, save_path_plots
from .section import plot_section
from .spectrum import plot_scale_dependence, plot_spectrum
from .stress import plot_stress_map, plot_stress_profile, plot_stress_section
from .style import style
from .surface_curves import plot_autocorrelation, plot_height_distribution, plot_material_ratio
from .surface_figures import SURFACE_PLOTS, SurfacePlot, render_surface_plot, save_roughness_plots
from .surface_view import plot_summits, plot_surface_view

__all__ = [
    "PATH_PLOTS",
    "PLASTIC_PLOTS",
    "PLOTS",
    "SURFACE_PLOTS",
    "PathPlot",
    "Plot",
    "SurfacePlot",
    "plot_area_loop",
    "plot_autocorrelation",
    "plot_contact",
    "plot_convergence",
    "plot_curves",
    "plot_energies",
    "plot_gap",
    "plot_gap_histogram",
    "plot_height_distribution",
    "plot_heights",
    "plot_indentation",
    "plot_load_loop",
    "plot_material_ratio",
    "plot_pressure",
    "plot_pressure_histogram",
    "plot_residual",
    "plot_running_mean",
    "plot_samples",
    "plot_scale_dependence",
    "plot_section",
    "plot_sensitivities",
    "plot_spectrum",
    "plot_stress_map",
    "plot_stress_profile",
    "plot_stress_section",
    "plot_summits",
    "plot_surface_view",
    "plot_transitions",
    "render",
    "render_path_plot",
    "render_surface_plot",
    "save_path_plots",
    "save_plots",
    "save_roughness_plots",
    "save_surface_plot",
    "style",
]
