from .io.export import export_csv, export_vtk
from .io.results import load, open_tree, save
from .io.surface_files import save_endless, save_gaussian, save_surface
from .physics.stress.files import export_stress_vtk, save_stress
from .studies.comparison import export_comparison_csv, save_comparison

__all__ = [
    "export_comparison_csv",
    "export_csv",
    "export_stress_vtk",
    "export_vtk",
    "load",
    "open_tree",
    "save",
    "save_comparison",
    "save_endless",
    "save_gaussian",
    "save_stress",
    "save_surface",
]
