"""Files: results, surfaces and stress fields saved, loaded and exported.

``save`` and ``load`` are for results and outcomes, ``open_tree`` gives a file as labelled groups.
``save_surface``, ``save_gaussian``, ``save_endless``, ``save_stress`` and ``save_comparison`` write
what their names say, ``export_csv``, ``export_comparison_csv``, ``export_vtk`` and
``export_stress_vtk`` files for other programs.
"""

from .core.late import late_names

late_names(__name__, __file__)
