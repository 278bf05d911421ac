"""Frictional heating asked for by a document: temperatures and shares in numbers, figures and
words."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from ...contact.controls import Control, Step
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...core.errors import InputError
from ...core.units import percent, show
from ...io.words import value_text
from ...parts.part import Found, Reached, Rows, Solved, Table, WithFacts, Words, require_step
from ...plots.picture import Figure, figures_by
from .answer import FrictionalHeating
from .estimates import disc_estimate
from .figures import DISTRIBUTION_PLOT, PATH_PLOT, RISE_PLOT, SECTION_PLOT, SHARE_PLOT, HeatPicture
from .heating import HeatedBodies, heat_made, require_heatable
from .law import HeatedInterface, Motion
from .part import SCALARS, WORDS, HeatingSettings

LEVELS = 101
"""Points of the distribution of the temperature over the contact."""

DEPTHS = 24
"""Planes of a section but that at the surface."""


class HeatingWork(WithFacts):
    """Flash temperature of the contact: what is done for it."""

    citation_keys: ClassVar[tuple[str, ...]] = FrictionalHeating.citation_keys

    def check(self, ask: HeatingSettings, problem: ContactProblem) -> None:
        """Refuse what cannot be heated, materials that are not known, and contacts without
        friction."""
        require_heatable(problem, interface_of(ask))
        if ask.friction is None and problem.friction is None:
            raise InputError(
                "heating.friction must be given where the contact is solved without friction, but is not. Give "
                "{heating.friction=0.2}."
            )

    def course(self, ask: HeatingSettings, controls: tuple[Step | Control, ...]) -> tuple[Step | Control, ...]:
        """The same steps; refuses one that is not among them."""
        require_step(ask.step, controls, "heating.step", "{heating.step=last}")
        return controls

    def compute(self, ask: HeatingSettings, solved: Solved) -> Found:
        """Temperatures at the step that is asked for, and those of all steps of a path."""
        reached: Reached = solved.at(ask.step)
        with solved.stage("frictional heating"):
            bodies = HeatedBodies.of(
                solved.problem, motion_of(ask), interface_of(ask), float(ask.voltage or 0.0), solved.threads
            )
            heated = _heated(ask, bodies, reached.result)
            values: dict[str, Any] = {**_numbers(heated), **_fields(heated)}
            if ask.section is not None and heated.rubs:
                depths = np.linspace(0.0, float(ask.section), DEPTHS + 1)
                first, second = heated.section(depths)
                values |= {"heat_depth": depths, "heat_section_body": first, "heat_section_counter_body": second}
            if solved.path is not None and _wanted(solved):
                steps = [
                    heated if number == reached.number else _heated(ask, bodies, step)
                    for number, step in enumerate(solved.path.steps, start=1)
                ]
                values |= {
                    "path_flash_load": np.array([step.mean_pressure for step in solved.path.steps]),
                    "path_flash_temperature": np.array([step.maximum for step in steps]),
                    "path_heat_share": np.array([step.share for step in steps]),
                }
        facts = {
            "where": reached.where,
            "speed": float(ask.speed or 0.0),
            "moving": WORDS[ask.moving],
            "periodic": all(solved.problem.boundary.wraps),
            "sinks": ask.sink_body is not None,
            "rubs": heated.rubs,
            "bulk": [float(ask.bulk_body), float(ask.bulk_counter_body)],
            "allowed": None if ask.allowed is None else float(ask.allowed),
        }
        keys = (*self.citation_keys, *(("Kohlrausch1900",) if ask.voltage else ()))
        return Found(values, facts, heated.findings, keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Maps of temperature and share, the distribution, the section and the path."""
        if not found.detail["rubs"]:
            return ()
        shown = HeatPicture(solved.problem, found.values)
        both = np.isfinite(shown.array("flash_body")).all() and np.isfinite(shown.array("flash_counter_body")).all()
        plots = [RISE_PLOT, *([SHARE_PLOT] if both else []), DISTRIBUTION_PLOT]
        plots += [SECTION_PLOT] if shown.array("heat_depth").size else []
        plots += [PATH_PLOT] if shown.array("path_flash_temperature").size > 1 else []
        return figures_by(plots, shown)

    def words(self, found: Found, solved: Solved) -> Words:
        """How hot it gets, which body takes the heat, and whether that is allowed."""
        values, facts = found.values, found.detail
        where = f" at {facts['where']}" if facts["where"] else ""
        if not facts["rubs"]:
            return Words(f"No heat is made{where}.", [], [], (), _remarks(facts))
        rise, hottest = float(values["flash_temperature"]), float(values["hottest_temperature"])
        share = float(values["heat_share"])
        sentence = (
            f"At {show(facts['speed'], 'm/s', 3)} the hottest spot is {rise:.3g} K hotter than the bulk{where}, at "
            f"{_temperature(hottest)}; {percent(share)} of the heat goes into the body."
        )
        rows: Rows = [("moves under the spots", facts["moving"])]
        for item in SCALARS:
            value = float(values.get(item.name, math.nan))
            if math.isfinite(value) and not (item.name == "flash_joule" and not value):
                rows.append((item.label, value_text(item, value)))
        headline = [("flash temperature", f"{rise:.3g} K"), ("heat into the body", percent(share))]
        holds, alarming = _allowed_text(hottest, facts)
        return Words(sentence, headline, rows, _tables(values), _remarks(facts), alarming, holds)


def interface_of(ask: HeatingSettings) -> HeatedInterface:
    """Films, bulk temperatures and sinks that are asked for."""
    return HeatedInterface(
        (float(ask.resistance_body), float(ask.resistance_counter_body)),
        (float(ask.bulk_body), float(ask.bulk_counter_body)),
        (float(ask.sink_body or math.inf), float(ask.sink_counter_body or math.inf)),
    )


def motion_of(ask: HeatingSettings) -> Motion:
    """The motion that is asked for."""
    direction = float(ask.direction or 0.0)
    rolling = float(ask.rolling or 0.0)
    return Motion.of(float(ask.speed or 0.0), ask.moving, direction=direction, rolling=rolling)  # type: ignore[arg-type]


def _heated(ask: HeatingSettings, bodies: HeatedBodies, result: ContactResult) -> FrictionalHeating:
    friction = None if ask.friction is None else float(ask.friction)
    return bodies.under(result, heat_made(result, bodies.motion, friction))


def _wanted(solved: Solved) -> bool:
    return solved.wanted is None or any(name.startswith(("path_flash", "path_heat")) for name in solved.wanted)


def _numbers(heated: FrictionalHeating) -> dict[str, float]:
    """``SCALARS``."""
    x, y = heated.place
    alone = [value if math.isfinite(value) else math.nan for value in heated.alone]
    return {
        "flash_temperature": heated.maximum,
        "hottest_temperature": heated.hottest_temperature,
        "flash_heat_mean": heated.flux_mean,
        "flash_mean": heated.mean,
        "heat_share": heated.share,
        "frictional_power": heated.power,
        "flash_x": x if heated.rubs else math.nan,
        "flash_y": y if heated.rubs else math.nan,
        "flash_blok": heated.blok,
        "flash_disc": disc_estimate(heated),
        "flash_all_body": alone[0],
        "flash_all_counter_body": alone[1],
        "flash_joule": heated.joule,
        "flash_peclet": heated.spot_peclet,
        "flash_pixel_peclet": heated.pixel_peclet,
        "flash_pixels": heated.pixels_across,
        "flash_spot_radius": heated.spot_radius,
        "flash_mismatch": heated.mismatch,
        "critical_wavelength": heated.critical_wavelength,
    }


def _fields(heated: FrictionalHeating) -> dict[str, Any]:
    """``FIELDS`` and the distribution."""
    part = np.linspace(0.0, 1.0, LEVELS)
    on = heated.temperature[heated.contact]
    return {
        "flash_rise": heated.temperature,
        "flash_body": heated.surface_1,
        "flash_counter_body": heated.surface_2,
        "friction_heat": heated.heat,
        "friction_heat_body": heated.heat_1,
        "flash_part": part,
        "flash_level": np.quantile(on, 1.0 - part) if on.size else np.full(LEVELS, math.nan),
    }


# In words and tables.


def _remarks(facts: Mapping[str, Any]) -> tuple[str, ...]:
    """What the temperatures are."""
    if facts["periodic"] and not facts["sinks"]:
        return (
            "Rises are those over the mean planes of the bodies: what the nominal contact warms as a whole comes on "
            "top. Properties do not change with temperature.",
        )
    return ("Rises are those over the bodies far away. Properties do not change with temperature.",)


def _temperature(value: float) -> str:
    return f"{value:.0f} K ({value - 273.15:.0f} °C)"


def _allowed_text(hottest: float, facts: Mapping[str, Any]) -> tuple[str, bool]:
    """Whether the hottest point is below what is allowed, and whether it is not."""
    allowed = facts["allowed"]
    if allowed is None:
        return "", False
    if hottest > allowed:
        over = f"{hottest - allowed:.3g} K above the {_temperature(allowed)} that are allowed"
        return f"Too hot: the hottest point has {_temperature(hottest)}, {over}.", True
    left = f"{allowed - hottest:.3g} K below the {_temperature(allowed)} that are allowed"
    return f"Cool enough: the hottest point has {_temperature(hottest)}, {left}.", False


def _tables(values: Mapping[str, Any]) -> tuple[tuple[str, Table], ...]:
    """Temperatures that shares of the contact exceed."""
    level, part = (np.asarray(values[name], float) for name in ("flash_level", "flash_part"))
    cells = []
    for share in (0.01, 0.1, 0.5, 0.9):
        cells.append((percent(share), show(float(np.interp(share, part, level)), "K", 3)))
    return (
        ("Temperature over the contact", Table(("Of the contact", "Hotter than the bulk by more than"), tuple(cells))),
    )
