"""Plots: figures of surfaces, contacts, stresses and campaigns, on axes or as files.

Functions ``plot_…`` take data and axes and give the axes; ``save_plots``, ``save_path_plots``,
``save_surface_plot``, ``save_roughness_plots`` and ``save_tip_plots`` save the standard sets
``PLOTS``, ``PATH_PLOTS``, ``PLASTIC_PLOTS``, ``SURFACE_PLOTS`` and ``TIP_PLOTS``.
"""

from ..core.late import late_names

late_names(__name__, __file__)
