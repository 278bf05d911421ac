"""Stick and slip: what is prescribed along the surfaces, and what it comes to in forces, areas,
slip and heat."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

from pydantic import model_validator

from ...core import units
from ...core.errors import InputError, UnitError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Angle, Count, Number, SignedLength, Whole
from ...parts.part import Part
from .part import sticks

if TYPE_CHECKING:
    from ...contact.controls import Control
    from ...contact.tangential import Tangential

SignedForce: TypeAlias = Annotated[float, Number("force")]

KEYS = ("shift", "force", "twist")
"""What can be prescribed along the surfaces, one of them."""

LINEAR = (
    Quantity("tangential_stiffness", "N/m", "change of the tangential force / change of the shift along it"),
    Quantity("contraction_factor", "1", "reduction of what pressure and shear are off by a round between them"),
)
"""Numbers of the last step, linearised."""

USUAL_STEPS = 8
"""Steps from zero to the largest value where it turns, if not said otherwise; one where it does
not."""


class ShearStep(Settings):
    """One step: the load or position, that before if it is left out, and a shift or tangential
    force.

    One value is along the direction of the friction, two are along x and y. As text
    ``"50 MPa, 5 nm"``.
    """

    mean_pressure: Annotated[float, Number("pressure", above=0.0)] | None = None
    load: Annotated[float, Number("force", above=0.0)] | None = None
    approach: Annotated[float, Number("length", above=0.0)] | None = None
    shift: tuple[SignedLength, ...] | None = None
    force: tuple[SignedForce, ...] | None = None
    twist: Angle | None = None

    @model_validator(mode="before")
    @classmethod
    def _from_line(cls, value: Any) -> Any:
        """Table of the step in text such as ``"50 MPa, 5 nm"`` or ``"1 mN, 5 nm, 2 nm"``: load or
        approach, then shift or force.

        The message lacks the name of the option or key at its beginning.
        """
        if not isinstance(value, str):
            return value
        first, *rest = (part.strip() for part in value.split(","))
        normal = _key_of(first, {"mean_pressure": "pressure", "load": "force", "approach": "length"})
        along = _key_of(rest[0], {"shift": "length", "force": "force", "twist": "angle"}) if rest else None
        if normal is None or (rest and along is None) or len(rest) > 2:
            raise InputError(
                f' must be a load and a shift or force, such as "50MPa,5nm" or "1mN,5nm,0nm", but is {value!r}.'
            )
        return {normal: first, **({} if along is None else {along: rest[0] if along == "twist" else rest})}

    @model_validator(mode="after")
    def _at_most_one(self) -> ShearStep:
        _require_at_most_one(self, ("mean_pressure", "load", "approach"))
        _require_at_most_one(self, KEYS)
        for key in KEYS[:2]:
            if getattr(self, key) is not None and len(getattr(self, key)) not in (1, 2):
                raise InputError(f".{key} must be one value along the friction, or two along x and y.")
        return self

    def normal(self, before: Control) -> Control:
        """Load or position of this step."""
        from ...contact.controls import Approach, Force, MeanPressure

        kinds: dict[str, Any] = {"mean_pressure": MeanPressure, "load": Force, "approach": Approach}
        chosen: Control = next(
            (kinds[key](value) for key in kinds if (value := getattr(self, key)) is not None), before
        )
        return chosen

    def tangential(self, direction: float) -> Tangential | None:
        """Shift or force of this step; None for that before."""
        for key in KEYS:
            value = getattr(self, key)
            if value is not None:
                return _control(key, value if isinstance(value, tuple) else (value,), direction)
        return None


def _key_of(text: str, kinds: dict[str, str]) -> str | None:
    """Key whose kind of quantity the unit in ``text`` is of."""
    for key, kind in kinds.items():
        try:
            units.parse(text, kind, "")
        except UnitError:
            continue
        return key
    return None


class ShearSettings(Settings):
    """What is prescribed along the surfaces after they are pressed: turning points of a shift,
    tangential force or twist.

    They are along the direction of the table [friction]. ``cycles`` run to the opposite of the last
    one and back. A list of ``history`` steps with load and shift of each takes the place of all
    that. With nothing the surfaces are pressed only.
    """

    shift: tuple[SignedLength, ...] | None = setting(
        None, option="--shift", help="Of the counter body along the friction, stick and slip: 5nm; 5nm,-5nm,5nm"
    )
    force: tuple[SignedForce, ...] | None = setting(
        None, option="--tangential-force", help="On the body along the friction, instead of a shift: 1mN"
    )
    twist: tuple[Angle, ...] | None = setting(
        None, option="--twist", help="Of the counter body about the normal, instead of a shift, for the free boundary"
    )
    cycles: Annotated[int, Whole(0)] = setting(0, option="--cycles", help="Closed cycles to the opposite and back")
    steps: Count | None = setting(
        None, option="--cycle-steps", help="Steps from zero to the largest shift; 8 where it turns, else 1"
    )
    history: tuple[ShearStep, ...] = setting(
        (), option="--step", help="Step of a history, load and shift: 50MPa,5nm. May be repeated"
    )

    @model_validator(mode="after")
    def _one(self) -> ShearSettings:
        given = _require_at_most_one(self, KEYS)
        if given and not getattr(self, given):
            raise InputError(f'.{given} must hold at least one turning point, such as "5 nm", but is empty.')
        if self.history and (given or self.cycles or self.steps):
            raise InputError(".history must be given alone, without shift, force, twist, cycles and steps.")
        if not given and (self.cycles or self.steps):
            raise InputError(
                " must give a shift, force or twist ({shear.shift}, {shear.force}, {shear.twist}) with its "
                "cycles and steps ({shear.cycles}, {shear.steps}), but gives none."
            )
        return self

    def controls(self, direction: float) -> tuple[Tangential, ...]:
        """What is prescribed in the steps after pressing."""
        key = next((key for key in KEYS if getattr(self, key) is not None), None)
        if key is None:
            return ()
        points = [0.0, *map(float, getattr(self, key))]
        points += [sign * points[-1] for _ in range(self.cycles) for sign in (-1.0, 1.0)]
        largest = max(map(abs, points))
        steps = self.steps or (USUAL_STEPS if len(points) > 2 else 1)
        found: list[Tangential] = []
        for start, end in itertools.pairwise(points):
            count = max(1, round(steps * abs(end - start) / largest)) if largest > 0.0 else 1
            shares = [number / count for number in range(1, count + 1)]
            found += [_control(key, (start * (1.0 - s) + end * s,), direction) for s in shares]
        return tuple(found)


def _require_at_most_one(table: Settings, keys: Sequence[str]) -> str | None:
    given = [key for key in keys if getattr(table, key) is not None]
    if len(given) > 1:
        raise InputError(f" must give at most one of {', '.join(keys)}, but gives {' and '.join(given)}.")
    return given[0] if given else None


def _control(key: str, values: Sequence[float], direction: float) -> Tangential:
    """The shift, force or twist with these ``values``: one along ``direction`` (rad), or along x
    and y."""
    from ...contact.tangential import Shift, TangentialForce

    if key == "twist":
        return Shift(twist=values[0])
    along = (values[0] * math.cos(direction), values[0] * math.sin(direction)) if len(values) == 1 else values
    x, y = (0.0 if abs(value) < 1e-15 * max(map(abs, along)) else float(value) for value in along)
    return (Shift if key == "shift" else TangentialForce)(x, y)


@dataclass(frozen=True)
class Sheared:
    """What is asked for along the surfaces, and the direction (rad) of the friction."""

    settings: ShearSettings
    direction: float


class StickSlip(Part):
    """Shear tractions within the bound of friction: where the surfaces stick, where they slip, and
    the heat."""

    name = "stick_slip"
    title = "Stick and slip"
    purpose = "Where the contact sticks and where it slips under a shift, a tangential force or a twist."
    table = "shear"
    implied = staticmethod(sticks)
    settings = ShearSettings
    basic = ("shift",)
    whole_path = True
    of_result = "stick_slip"
    work = "physics.friction.work_stick_slip:StickSlipWork"
    takes_friction = True

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars of a step, and the heat of the last cycle."""
        from .fretting import SHEAR_SCALARS

        return (
            *SHEAR_SCALARS,
            Quantity("cycle_dissipation", "J", "energy dissipated by slip in the last closed cycle"),
            *LINEAR,
        )

    def asked(self, document: Any, folder: Path) -> Sheared:
        """The table [shear] with the direction of the friction."""
        settings = self.settings_in(document) or ShearSettings()
        friction = document.friction
        if friction.law == "coulomb" and not friction.coefficient:
            raise InputError(
                "friction must be given together with a shift, tangential force or twist, but its coefficient "
                "is 0. Give {friction.coefficient=0.3} or {friction.law=full stick}.",
                subject="friction",
            )
        return Sheared(settings, friction.direction)
