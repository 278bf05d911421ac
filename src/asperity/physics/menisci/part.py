"""A liquid film between the bodies: its menisci, and the theory of summits beside them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.units import percent, show
from ...core.values import Angle, Humidity, Length, NonEmpty, Pressure, SurfaceTension, Viscosity
from ...parts.part import Found, Part, Rows, Solved, Table, Words
from ..friction.part import friction_law, sticks
from .quantities import WET_SCALARS

if TYPE_CHECKING:
    from ...contact.result import ContactResult
    from ...plots.picture import Figure
    from ..friction.law import FrictionLaw
    from .coupling import Menisci as SolvedMenisci
    from .film import LiquidFilm
    from .summits import WetTheory as SolvedTheory


class FilmSettings(Settings):
    """A liquid film.

    The liquid is a named one or given by its ``surface_tension``, which else replaces that of the named one. Either the
    ``humidity`` fixes the height of the menisci, and for water the thickness of the film, or ``thickness`` and
    ``meniscus_height`` are given, the second being the first by default. One ``contact_angle`` is that on the surface
    opposite the film. Friction is that of the table [friction].
    """

    liquid: NonEmpty | None = setting(None, option="--liquid", help="Name: water, PFPE; `asperity liquids` lists all")
    liquids_file: NonEmpty | None = setting(None, option="--liquids-file", help="Your own liquids, a TOML file")
    surface_tension: SurfaceTension | None = setting(
        None, option="--surface-tension", help="Instead of that of the liquid: 25mN/m"
    )
    humidity: Humidity | None = setting(
        None, option="--humidity", help="Relative humidity, for the height of the menisci: 80%"
    )
    thickness: Length | None = setting(None, option="--film", help="Thickness; from the humidity by default, for water")
    meniscus_height: Length | None = setting(
        None, option="--meniscus-height", help="Gap at the rim of a meniscus; --film by default"
    )
    contact_angle: tuple[Angle, ...] = setting(
        ("0 deg",), option="--contact-angle", help="Opposite the film, or on both surfaces: 10deg; 60deg,60deg"
    )
    viscosity: Viscosity | None = setting(None, option="--viscosity", help="For the viscous part of friction: 10mPa*s")
    shear_strength: Pressure | None = setting(
        None, option="--shear-strength", help="Of the liquid, at which its viscous stress ends: 10MPa"
    )

    @model_validator(mode="after")
    def _whole(self) -> FilmSettings:
        if len(self.contact_angle) not in (1, 2):
            raise InputError(
                f'.contact_angle must be one or two angles, such as "10 deg" or ["60 deg", "60 deg"], but is {len(self.contact_angle)}.'
            )
        if self.liquid is None and self.surface_tension is None:
            raise InputError(
                ' must give a liquid, such as "water" (--liquid), or its surface_tension (--surface-tension), but gives neither.'
            )
        if self.liquid is None and self.humidity is not None:
            raise InputError(
                " must name its liquid (--liquid) beside a humidity, which needs the molar volume, but does not."
            )
        if self.humidity is None and self.thickness is None:
            raise InputError(
                ' must give the thickness of the film, such as "2 nm" (--film), or a humidity (--humidity), but gives neither.'
            )
        if self.humidity is not None and self.meniscus_height is not None:
            raise InputError(" must not give both a humidity and a meniscus_height: the second follows from the first.")
        return self


@dataclass(frozen=True)
class Wetted:
    """The film that is asked for, and its friction."""

    film: LiquidFilm
    friction: FrictionLaw


class Menisci(Part):
    """Menisci that press the surfaces together."""

    name = "film"
    title = "Liquid film and menisci"
    table = "film"
    settings = FilmSettings
    of_result = "menisci"

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars of a wet contact."""
        return WET_SCALARS

    def asked(self, document: Any, folder: Path) -> Wetted:
        """The film of the table [film], whose liquids file starts at ``folder``, with the friction of the table [friction].

        Raises
        ------
        InputError
            If the liquid is unknown, does not wet, or lacks a value that is needed.
        """
        from ...solids.library import Liquid, liquid
        from .film import LiquidFilm

        table: FilmSettings = document.film
        tension = math.nan if table.surface_tension is None else table.surface_tension
        if table.liquid is None:
            substance = Liquid(tension)
        else:
            own = None if table.liquids_file is None else folder / table.liquids_file
            substance = liquid(table.liquid, library=own)
            substance = substance if math.isnan(tension) else replace(substance, surface_tension=tension)
        angles = table.contact_angle
        sides = (angles[0], angles[1] if len(angles) == 2 else 0.0)
        if table.humidity is not None:
            thickness = math.nan if table.thickness is None else table.thickness
            film = LiquidFilm.at_humidity(substance, table.humidity, thickness=thickness, contact_angles=sides)
        else:
            height = math.nan if table.meniscus_height is None else table.meniscus_height
            film = LiquidFilm.of(substance, float(table.thickness or 0.0), meniscus_height=height, contact_angles=sides)
        known = {key: value for key in ("viscosity", "shear_strength") if (value := getattr(table, key)) is not None}
        return Wetted(replace(film, **known), friction_law(document.friction, sheared=sticks(document)))

    def coupling(self, ask: Wetted) -> Mapping[str, Any]:
        """The film joins the solve."""
        return {"film": ask.film, "friction": ask.friction}

    def compute(self, ask: Wetted, solved: Solved) -> Found:
        """Scalars of the menisci."""
        menisci = solved.result.require_menisci()
        values = {q.name: getattr(menisci, q.name) for q in WET_SCALARS}
        return Found(values, menisci, (), menisci.citation_keys)

    def made_from(self, result: ContactResult) -> Found | None:
        """The menisci."""
        menisci = result.menisci
        return None if menisci is None else Found({}, menisci, citation_keys=menisci.citation_keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Map of the menisci."""
        from ...plots.picture import figures_by
        from .figures import PLOTS

        return figures_by(PLOTS, solved.result)

    def words(self, found: Found, solved: Solved) -> Words:
        """Liquid, menisci and friction."""
        from ...io.words import value_text

        result: SolvedMenisci = found.detail
        control, film, regime = solved.control, result.film, result.wetting.regime
        rows = [
            (f"prescribed {control.name}", show(control.value, control.unit)),
            ("surface tension", show(film.surface_tension, "N/m")),
            ("contact angles", " and ".join(f"{math.degrees(angle):.4g}°" for angle in film.contact_angles)),
        ]
        if result.viscous_force > 0.0:
            rows.append(("viscosity", show(film.viscosity, "Pa*s")))
        rows.append(("dry friction coefficient", f"{result.dry_friction:g}"))
        cells = [("regime", f"{regime}: {REGIMES[regime]}")]
        silent = {"friction_force", "viscous_force", "static_friction"} if result.friction_force == 0.0 else set()
        for quantity in WET_SCALARS:
            if quantity.name not in silent:
                cells.append((quantity.label, value_text(quantity, getattr(result, quantity.name))))
        share, pull = percent(result.meniscus_area_fraction), show(result.meniscus_force, "N")
        more = f"{result.relative_meniscus_force:.3g} times the external force"
        if math.isnan(result.relative_meniscus_force):
            more = "more than the contact force"
        sentence = f"Menisci on {share} of the nominal area pull with {pull}, {more}."
        if regime == "dry":
            sentence = "No liquid bridges the gap: the contact is dry."
        tables = (("", Table(("Quantity", "Value"), tuple(cells))),)
        return Words(sentence, rows=rows, tables=tables, remarks=(REMARK,))


class WetTheory(Part):
    """The theory of summits beside the menisci of the map."""

    name = "wet_theory"
    title = "Statistical theory beside it"
    table = "film"
    quantities = (Quantity("statistical_meniscus_force", "N", "meniscus force of the theory of summits", costly=True),)

    def compute(self, ask: Any, solved: Solved) -> Found:
        """Meniscus force of the theory; NaN with the reason as detail where it has none."""
        from .summits import wet_theory

        try:
            theory = wet_theory(solved.result)
        except InputError as error:
            return Found({"statistical_meniscus_force": math.nan}, str(error))
        return Found({"statistical_meniscus_force": theory.meniscus_force}, theory, (), theory.citation_keys)

    def words(self, found: Found, solved: Solved) -> Words:
        """Summits, forces and growth, or why there is no theory."""
        rows = theory_rows(found.detail, solved.found["film"].detail)
        return Words(rows=rows, remarks=() if isinstance(found.detail, str) else (THEORY_REMARK,))


REGIMES = {
    "dry": "no liquid bridges the gap",
    "toe-dipping": "menisci stand around single summits",
    "pillbox": "a meniscus reaches across the surface",
    "flooded": "liquid and contact fill nearly the whole area",
}
"""What each regime means."""

REMARK = (
    "The film lies as it was before contact and is not redistributed; the suction acts on the area of the menisci without "
    "the solid contact, and presses the surfaces together as an additional load."
)
"""What the model assumes."""


THEORY_REMARK = (
    "Statistical theory of the summits of this surface: independent Hertz contacts, their heights by skewness and kurtosis (Kotwal "
    "and Bhushan), each summit in the film pulled by the full force of a touching sphere (Gao, Tian and Bhushan). The map above counts the "
    "area at the meniscus height instead, leaves out the contact, and lets the summits push each other: an estimate beside it."
)
"""What the theory of summits is, and why it differs."""


def theory_rows(found: SolvedTheory | str, result: SolvedMenisci) -> Rows:
    """Statistical and kinetic menisci beside the ``result`` on the map."""
    from .summits import HAMAKER

    if isinstance(found, str):
        return [("no statistical theory", found)] if found else []
    contact, load, mapped = found.statistical.contact, result.external_force, result.meniscus_force
    rows = [
        ("summits", f"{found.summits} of radius {show(contact.radius, 'm', 3)}"),
        ("standard deviation of their heights", show(contact.height_deviation, "m", 3)),
        ("meniscus force", show(found.meniscus_force, "N")),
        ("meniscus force / external force", f"{found.meniscus_force / load:.4g}"),
        ("meniscus force / that of the map", f"{found.meniscus_force / mapped:.3g}" if mapped > 0.0 else "–"),
        ("growth of the force with the load, dF/dL", f"{found.feedback:.3g}"),
    ]
    if result.dry_friction > 0.0:
        friction = result.dry_friction * (1.0 + found.meniscus_force / load)
        rows.append(("static friction coefficient, without viscous part", f"{friction:.4g}"))
    if found.growth is None:
        why = (
            "not known without a viscosity"
            if math.isnan(result.film.viscosity)
            else "none: the film holds its liquid back"
        )
        return [*rows, ("growth of the menisci with time", why)]
    grown = show(found.growth.time_to(0.99), "s", 3)
    return [
        *rows,
        ("meniscus force just after contact", show(found.first_force, "N")),
        ("menisci grow to 99 % within", f"{grown} (Hamaker constant {HAMAKER:g} J, assumed)"),
    ]
