"""Contact mechanics of layered rough surfaces.

A module is imported on first use of one of its names. The stub beside this file lists the same names for type checkers.
"""

import sys
from types import MappingProxyType, ModuleType
from typing import Any

from .core.late import LateNames, Shown

__version__ = "0.1.0"

_NAMES = MappingProxyType(
    {
        "": ("theories",),
        "contact": ("solvers",),
        "contact.advice": ("advise", "review"),
        "contact.boundary": ("Free", "FreeLine", "Periodic"),
        "contact.couplings.driver": ("CouplingCheck", "Rounds"),
        "contact.couplings.menisci": ("Menisci",),
        "contact.couplings.sliding": ("GrossSliding",),
        "contact.history": ("EnergyBalance", "History", "HistoryResult", "Step", "ramps"),
        "contact.laws": ("Coulomb", "Hardness", "HardWall", "LayeredHardness"),
        "contact.operators": ("prepare_operator",),
        "contact.plastic_load": ("plastic_load", "PlasticLoad"),
        "contact.problem": ("Approach", "ContactProblem", "Flat", "Force", "MeanGap", "MeanPressure", "Unloaded"),
        "contact.result": ("ContactResult",),
        "contact.roughness": ("roughness_of",),
        "contact.solve": ("Keep", "solve"),
        "contact.state": ("InterfaceState",),
        "contact.wet_theory": ("wet_theory", "WetTheory"),
        "contact.wetting": ("LiquidFilm",),
        "core.citations": ("cite",),
        "core.engine": ("ArrayEngine", "CpuEngine"),
        "core.errors": (
            "AsperityError",
            "ConvergenceError",
            "FileFormatError",
            "InputError",
            "NoSolutionError",
            "OutputError",
            "UnitError",
        ),
        "core.grid": ("Grid",),
        "core.status": ("Advice",),
        "io.export": ("export_csv", "export_stress_vtk", "export_vtk"),
        "io.results": ("load", "open_tree", "save"),
        "io.stress_files": ("save_stress",),
        "io.surface_files": ("save_endless", "save_gaussian", "save_surface"),
        "plots.contact": ("save_path_plots", "save_plots", "save_surface_plot"),
        "plots.surface": ("save_roughness_plots",),
        "report.comparison": ("write_comparison_report",),
        "report.roughness": ("write_roughness_report",),
        "report.write": ("write_report",),
        "run.execute": ("Outcome", "run"),
        "solids.elastic": ("Elastic", "Rigid", "Strength"),
        "solids.grading": ("ExponentialGrading", "graded", "LinearGrading", "PowerGrading"),
        "solids.layers": ("Bonded", "contact_modulus", "Frictionless", "Layer", "Layered", "RigidBase"),
        "solids.library": ("Liquid", "liquid", "liquids", "material", "materials"),
        "stress.compute": ("stress", "stress_planes"),
        "stress.criteria": ("MaxPrincipal", "Tresca", "VonMises"),
        "stress.field": ("StressField",),
        "stress.tractions": ("ShearTraction", "Sliding"),
        "stress.regions": ("depths_through", "DepthProfile", "Everywhere", "Section"),
        "stress.yielding": ("first_yield", "fracture_indicators", "load_at_yield", "LoadAtYield", "YieldReport"),
        "studies.campaign": ("Campaign", "CampaignState", "open_study", "run_study"),
        "studies.compare": ("compare",),
        "studies.comparison": ("Comparison",),
        "studies.comparison_files": ("export_comparison_csv", "save_comparison"),
        "surfaces": ("generate", "roughness"),
        "surfaces.characterise.heights": ("mean_absolute_height", "peak_to_valley", "rms_height"),
        "surfaces.characterise.slopes": ("rms_slope",),
        "surfaces.characterise.summary": ("Characterisation", "characterise"),
        "surfaces.common_grid": ("on_common_grid", "SurfacePair"),
        "surfaces.pair": ("composite", "turned_over"),
        "surfaces.prepare.extent": ("cropped", "periodised", "resampled", "sliced", "tapered"),
        "surfaces.prepare.fill": ("filled",),
        "surfaces.prepare.filter": ("filtered", "reliability_cutoff", "tip_limited"),
        "surfaces.prepare.level": ("despiked", "levelled", "line_corrected"),
        "surfaces.read": ("channels", "read"),
        "surfaces.surface": ("Surface",),
        "theories.statistics.roughness": ("Roughness",),
    }
)
"""Public names by module; ``stress`` is a function, and besides a package that the function is in."""

_VIEWS = MappingProxyType({"io.results": ("to_xarray",), "io.words": ("text",), "plots.notebook": ("card", "plot")})
"""Functions behind ``repr`` and notebooks, by module."""

_find = LateNames(__name__, _NAMES)
Shown.supply(LateNames(__name__, _VIEWS))
_HOME = _find.home

__all__ = sorted([*_HOME, "__version__"])


class _Package(ModuleType):
    """This package, whose names stay what they are when a package of the same name is imported."""

    def __setattr__(self, name: str, value: object) -> None:
        if not (isinstance(value, ModuleType) and _HOME.get(name, "").startswith(f"{name}.")):
            super().__setattr__(name, value)


def __getattr__(name: str) -> Any:
    value = globals()[name] = _find(name)
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


sys.modules[__name__].__class__ = _Package
