"""Stresses under a rough surface on a layer, with friction: the trends of figs 3.21 and 3.22 of
Peng (2001).

``peng_pictures.py`` draws the figures.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
from page import Claim, Page, Table, write_page
from peng import BASE, CORRELATION_LENGTH, Case, coated, contacts, grid, surfaces

import asperity as asp

RMS = 1e-9
LOAD = 4e-6
RATIOS = (2.0, 0.5)
THICKNESSES = (50e-9, 250e-9, 1e-6)
FRICTIONS = (0.0, 0.25, 0.5)
DEPTHS = (0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0, 1.5, 2.0, 4.0)
"""Depths over the pixel, besides that of the interface."""

UNIT = BASE.youngs_modulus * RMS / CORRELATION_LENGTH
"""E2σ/β*, 0.2 GPa."""

NAMES = {"sqrt_J2": "√J2", "principal_tensile": "σt", "shear_xz": "σxz"}

ABOUT = (
    "Peng (2001, figs 3.21 and 3.22; also Peng & Bhushan 2001b, 2002): σ = 1 nm, β* = 0.5 µm, pₙ/E₂ = 4·10⁻⁶, "
    "layers with E₁/E₂ = 2 and 0.5, μ = 0 and 0.5. Published are pictures for one surface, and the trends "
    "told in the text. Ours: largest values in the whole body, means over {count} surfaces, on planes from "
    "the surface to 4 pixels below it and on both sides of the interface; depths in nm. The shear traction is "
    "μp along x. σt is the larger principal stress within planes parallel to the surface (his eq. 3.34), σxz "
    "taken as a magnitude."
)


@dataclass(frozen=True)
class Largest:
    """Largest value of a stress over E2σ/β*, its depth in m, and the largest value on the
    surface."""

    value: float
    depth: float
    on_surface: float


@dataclass(frozen=True)
class Seen:
    """One contact: largest pressure and largest interface shear over E2σ/β*, and the largest of
    each stress."""

    peak: float
    interface: float
    stresses: dict[str, Largest]


Coating: TypeAlias = tuple[float, float]
"""E1/E2 and h in m."""

COATINGS = tuple((ratio, thickness) for ratio in RATIOS for thickness in THICKNESSES)
MIDDLE = tuple((ratio, THICKNESSES[1]) for ratio in RATIOS)

Contacts: TypeAlias = dict[tuple[Coating, float], list[Seen]]
"""What is seen for every layer and friction coefficient, surface by surface."""


def compare(count: int = 6) -> Page:
    """Ours on ``count`` surfaces for every layer and friction coefficient."""
    shapes = surfaces(count, grid())
    found: Contacts = {}
    changes = []
    for ratio, thickness in COATINGS:
        results = list(contacts(Case(ratio, LOAD, RMS), shapes, body=coated(ratio, thickness)))
        for friction in FRICTIONS:
            found[(ratio, thickness), friction] = [seen(result, friction, thickness) for result in results]
        changes += [_coupled(result) for result in results[:2]]
    constant = _constant_on_pixels(shapes[: max(1, count // 3)])
    tables = (_table(found, COATINGS, FRICTIONS), _table(constant, MIDDLE, (0.0, FRICTIONS[-1])))
    claims = (*_claims(found), *_of_pressure(changes), *_of_pixels(constant))
    parts = (LEAD, tables[0], TRENDS, PIXELS_LEAD, tables[1])
    return Page("Stresses under a rough surface on a layer", ABOUT.format(count=count), parts, claims)


def _constant_on_pixels(shapes: Sequence[asp.Surface]) -> Contacts:
    """The layers of middle thickness on the free boundary, where every pixel carries a constant
    traction."""
    found: Contacts = {}
    for ratio, thickness in MIDDLE:
        body = coated(ratio, thickness)
        results = list(contacts(Case(ratio, LOAD, RMS), shapes, body=body, boundary=asp.Free()))
        for friction in (0.0, FRICTIONS[-1]):
            found[(ratio, thickness), friction] = [seen(result, friction, thickness) for result in results]
    return found


def seen(result: asp.ContactResult, friction: float, thickness: float) -> Seen:
    """Largest stresses of one contact."""
    pixel = result.problem.grid.spacing[0]
    field = asp.stress(result, np.unique([*(np.array(DEPTHS) * pixel), thickness]), friction=friction)
    stresses = {}
    for name in NAMES:
        values = np.abs(getattr(field, name)) if name == "shear_xz" else getattr(field, name)
        peak = field.peak(values)
        stresses[name] = Largest(peak.value / UNIT, peak.depth, float(values[0].max()) / UNIT)
    return Seen(result.max_pressure / UNIT, float(field.interfaces[0].shear.max()) / UNIT, stresses)


def _coupled(result: asp.ContactResult) -> tuple[float, float]:
    """Relative changes of contact area and largest pressure by the displacement that the largest
    friction causes."""
    sliding = asp.solve(
        replace(result.problem, friction=asp.Coulomb(FRICTIONS[-1])),
        result.control,
        keep=asp.Keep(stiffness=False),
        rounds=asp.solvers.Rounds(tolerances={"sliding": 1e-4}),
    )
    return sliding.area_fraction / result.area_fraction - 1.0, sliding.max_pressure / result.max_pressure - 1.0


def _mean(contacts_seen: Sequence[Seen], name: str, what: str = "value") -> float:
    return float(np.mean([getattr(one.stresses[name], what) for one in contacts_seen]))


def _table(found: Contacts, coatings: Sequence[Coating], frictions: Sequence[float]) -> Table:
    rows = []
    for (ratio, thickness), friction in ((coating, friction) for coating in coatings for friction in frictions):
        contacts_seen = found[(ratio, thickness), friction]
        row = [
            f"{ratio:g}",
            f"{thickness * 1e9:.0f}",
            f"{friction:g}",
            f"{np.mean([one.peak for one in contacts_seen]):.2f}",
        ]
        for name in NAMES:
            row.append(f"{_mean(contacts_seen, name):.2f} at {_mean(contacts_seen, name, 'depth') * 1e9:.0f}")
        rows.append((*row, f"{np.mean([one.interface for one in contacts_seen]):.3f}"))
    head = ("E₁/E₂", "h (nm)", "μ", "pₘₐₓ", *(f"max {name}" for name in NAMES.values()), "interface shear")
    return Table("", head, tuple(rows))


LEAD = "Stresses over E₂σ/β*, each with its mean depth in nm:"

TRENDS = """* μ raises the largest √J2, σt and σxz, and moves the maxima of the first and the last from 0.3
  pixels and more below the surface to the surface.
* The stiff layer has the higher stresses throughout, the compliant one the lower ones.
* A thin layer (50 nm, less than a pixel) carries a high shear stress at its interface.
* Peng states that the largest σt and σxz are always at the surface. For σxz this is impossible without
  friction, since it vanishes there (its maximum is 0.4 to 0.7 pixels below). For σt it holds except for the
  thin stiff layer at μ = 0, which bends under the contacts: its largest tension is at its lower side.
* Pressures do not depend on friction unless the displacement that the shear traction causes is included. Even
  then, with a rigid counter body and ν = 0.3, where it is large, area and largest pressure change by less
  than 1 % (`asperity.Coulomb`; see the claims)."""

PIXELS_LEAD = """The contacts are about one pixel wide, so the values depend on the assumed interpolation
between the points: above, the trigonometric interpolation of the pressure, as in his influence coefficients.
With constant tractions on the pixels (free boundary, fewer surfaces) √J2 is about a tenth higher without
friction, and the tension at the edges about half as high with it. The trends are the same:"""


def _claims(found: Contacts) -> tuple[Claim, ...]:
    coatings = COATINGS
    most = FRICTIONS[-1]

    def rise(name: str) -> float:
        return min(_mean(found[one, most], name) / _mean(found[one, 0.0], name) for one in coatings)

    def depths(name: str, friction: float) -> list[float]:
        return [one.stresses[name].depth for coating in coatings for one in found[coating, friction]]

    def stiff_over_compliant(name: str) -> float:
        pairs = [(h, friction) for h in THICKNESSES for friction in FRICTIONS]
        return min(_mean(found[(2.0, h), mu], name) / _mean(found[(0.5, h), mu], name) for h, mu in pairs)

    traction = [one.stresses["shear_xz"].value / one.peak for coating in coatings for one in found[coating, most]]
    thick = [
        one.stresses["principal_tensile"] for (_, h), mu in found if h > THICKNESSES[0] for one in found[(_, h), mu]
    ]
    interface = [
        np.mean([one.interface for one in found[(ratio, THICKNESSES[0]), mu]])
        / np.mean([one.interface for one in found[(ratio, THICKNESSES[-1]), mu]])
        for ratio in RATIOS
        for mu in FRICTIONS
    ]
    return (
        *(Claim(f"max {NAMES[name]} at μ = {most:g} over that at μ = 0, smallest", rise(name), 1.2) for name in NAMES),
        Claim("least depth of max √J2 at μ = 0 (nm)", 1e9 * min(depths("sqrt_J2", 0.0)), 10.0),
        Claim(f"greatest depth of max √J2 at μ = {most:g} (nm)", 1e9 * max(depths("sqrt_J2", most)), 0.0, 0.0),
        Claim("least depth of max σxz at μ = 0 (nm)", 1e9 * min(depths("shear_xz", 0.0)), 10.0),
        Claim(f"greatest depth of max σxz at μ = {most:g} (nm)", 1e9 * max(depths("shear_xz", most)), 0.0, 0.0),
        Claim(f"max σxz at μ = {most:g} over pₘₐₓ, least", min(traction), most - 1e-6, most + 1e-6),
        Claim(
            "greatest depth of max σt for h of 250 nm and more (nm)", 1e9 * max(one.depth for one in thick), 0.0, 0.0
        ),
        *(Claim(f"max {NAMES[name]}, E₁/E₂ = 2 over 0.5, smallest", stiff_over_compliant(name), 1.5) for name in NAMES),
        Claim("interface shear, h = 50 nm over 1 µm, smallest", float(min(interface)), 5.0),
    )


def _of_pressure(changes: Sequence[tuple[float, float]]) -> tuple[Claim, ...]:
    area, peak = (float(np.abs([one[k] for one in changes]).mean()) for k in (0, 1))
    return (
        Claim(f"mean relative change of the area by the coupling at μ = {FRICTIONS[-1]:g}", area, 0.0, 0.02),
        Claim("the same of pₘₐₓ", peak, 0.0, 0.02),
    )


def _of_pixels(found: Contacts) -> tuple[Claim, ...]:
    most = FRICTIONS[-1]
    rise = min(_mean(found[one, most], "sqrt_J2") / _mean(found[one, 0.0], "sqrt_J2") for one in MIDDLE)
    depths = [[one.stresses["sqrt_J2"].depth for coating in MIDDLE for one in found[coating, mu]] for mu in (0.0, most)]
    return (
        Claim(f"constant tractions on pixels: max √J2 at μ = {most:g} over that at μ = 0, smallest", rise, 1.2),
        Claim("constant tractions on pixels: least depth of max √J2 at μ = 0 (nm)", 1e9 * min(depths[0]), 10.0),
        Claim(
            f"constant tractions on pixels: greatest depth of max √J2 at μ = {most:g} (nm)",
            1e9 * max(depths[1]),
            0.0,
            0.0,
        ),
    )


if __name__ == "__main__":
    write_page(compare(), __file__)
