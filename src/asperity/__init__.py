"""Contact mechanics of layered rough surfaces.

What most work needs stands here, such as ``solve``, ``ContactProblem`` and ``read``.
Everything of a subject stands in its module. Numbers are in SI units, arrays are ``[x, y]``.

    adhesion        laws of attraction, branches and jumps, loops of approach and separation
    conductance     current and heat through a solved contact
    contact         problems, loads, boundaries, the solve, its results and advice about them
    dynamics        normal compliance, vibration, stick-slip and sliding blocks
    engines         libraries of arrays and transforms, for the processor or a GPU
    errors          everything that is raised, with its base
    fem             plastic flow beneath indenters and rolling passes on layered solids
    files           results, surfaces and stress fields saved, loaded and exported
    friction        laws, stick and slip under a tangential load, tangential stiffness
    generate        deterministic shapes and textures, Gaussian and other random roughness
    heating         flash temperature of sliding contacts, share of the heat between bodies
    menisci         liquid films and bridges between surfaces, liquids, wet summits
    plasticity      hardness of the interface, plastic flow of the bodies, hardening
    plots           figures of surfaces, contacts, stresses and campaigns, on axes or as files
    report          self-contained pages of results, surfaces and comparisons, and animations
    rolling         creepage, creep forces and their curve, of smooth and of rough bodies
    roughness       every quantity of a surface, one function or record each
    sealing         flow through the gap, leak rates, throats, flow factors
    sensitivities   derivatives of answers to heights, load, moduli and thicknesses
    solids          elastic, layered and graded bodies, the library of materials
    solvers         methods of the normal contact, prepared operators, rounds of couplings
    stresses        fields below the surface, loads, criteria, first yield, shakedown
    studies         documents run, campaigns of many cases, theories compared with the solution
    surfaces        maps of heights, read, prepared and paired
    theories        closed forms of contact, which take and return numbers
    viscoelasticity materials that relax, oscillating and sliding contacts, hysteretic friction
    wear            running-in, fretting, break-through of coatings

Go on with ``help(asperity.solve)`` or ``help(asperity.contact)``.
"""

import sys
from collections.abc import Sequence
from pathlib import Path
from types import MappingProxyType, ModuleType
from typing import Any

from .core.late import LateModule, LateNames, Shown, late_names, names_of_stub

__version__ = "1.0.0"

_VIEWS = MappingProxyType(
    {
        "parts.advice": ("findings",),
        "run.verdict": ("verdict",),
        "io.listing": ("lines", "table"),
        "io.results": ("to_xarray",),
        "io.words": ("text",),
        "plots.notebook": ("card", "plot"),
    }
)
"""Functions behind ``repr``, notebooks and what results say of themselves, by module."""


class _Package(LateModule):
    """This package: a name that has moved to a public module is an error that says where it is."""

    def __getattr__(self, name: str) -> Any:
        if now := _moved(name):
            raise AttributeError(now, obj=self)  # without the name, or Python would guess at another one
        return super().__getattr__(name)


class _Moved:
    """Finder of modules behind all others: for ``from asperity import NAME`` Python drops the
    message of the attribute, and looks for a module last."""

    @staticmethod
    def find_spec(fullname: str, path: Sequence[str] | None = None, target: ModuleType | None = None) -> None:
        """Raise ImportError for a name that has moved; find nothing otherwise."""
        package, _, name = fullname.rpartition(".")
        if package == __name__ and (now := _moved(name)):
            raise ImportError(now, name=fullname)


def _moved(name: str) -> str:
    """Where a ``name`` that is not here is, by the stubs of the public modules; empty if it is here
    or nowhere."""
    if name.startswith("_") or name in _HOME:
        return ""
    here = Path(__file__).parent
    files = {
        one: [path for path in (here / f"{one}.pyi", here / one / "__init__.pyi") if path.exists()] for one in __all__
    }
    places = [
        one for one, stubs in files.items() for stub in stubs for names in names_of_stub(stub).values() if name in names
    ]
    return f"asperity.{name} is {' or '.join(f'asperity.{one}.{name}' for one in places)} now" if places else ""


_HOME = late_names(__name__, __file__)
__all__ = sorted(name for name, home in _HOME.items() if not home)
sys.modules[__name__].__class__ = _Package
sys.meta_path.append(_Moved)
Shown.supply(LateNames(__name__, _VIEWS))
