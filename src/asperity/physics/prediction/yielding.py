"""Largest √J₂ in the parts of the bodies, and the load at which each first yields."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from ...core.scipy_parts import optimize
from ...core.status import Advice
from ...solids.elastic import Elastic
from ...solids.layers import Body, Layered
from ...solids.strength import flow_stress
from ...theories.rough.predictor import Expected, Groups
from ...theories.rough.predictor_stress import THINNEST, UNKNOWN, in_half_space, stresses
from .one_layer import OneLayer

Pressed: TypeAlias = tuple[Groups, Expected]
"""Groups of a contact and its largest pressure."""


@dataclass(frozen=True)
class Onset(Expected):
    """Factor on the load at which something begins, with the ends of its ``band``: zero and
    infinity where one surface of twenty may lie outside of the table."""

    low: float = 0.0
    high: float = math.inf

    @property
    def band(self) -> tuple[float, float]:
        """Where the factor of one surface lies in 19 of 20 cases."""
        return self.low, self.high


@dataclass(frozen=True)
class Part:
    """A part of the bodies that may yield.

    Attributes
    ----------
    name
        ``"layer"`` or ``"base"`` of a coated body, and ``"body"`` for a half-space.
    yield_stress
        Y in Pa, by the hardness if that alone is known; NaN if neither is.
    largest
        Largest √J₂ in Pa of a contact.
    """

    name: str
    yield_stress: float
    largest: Callable[[Groups, Expected], Expected]

    def factor(self, largest: Expected) -> Expected:
        """Factor on the stress ``largest`` at which it yields."""
        factor = self.yield_stress / math.sqrt(3.0) / largest.value
        if not math.isfinite(factor):
            return UNKNOWN
        return Expected(factor, factor * largest.error / largest.value, factor * largest.scatter / largest.value)


def parts_of(body: Body, counter_body: Body, one: OneLayer) -> tuple[Part, ...]:
    """The layer and the base that ``one`` layer makes, or the half-spaces without one; nothing of
    several layers, of which no table knows what each bears."""
    if one.error:
        return ()
    solids = [solid for solid in (body, counter_body) if isinstance(solid, Elastic | Layered)]
    coated = next((solid for solid in solids if isinstance(solid, Layered) and solid.reduced.layers), None)
    if coated is None:
        bases = [solid.reduced.base if isinstance(solid, Layered) else solid for solid in solids]
        return tuple(_half_space(base) for base in bases if isinstance(base, Elastic))
    layer, base = coated.reduced.layers[0].material, coated.reduced.base
    assert isinstance(layer, Elastic)
    assert isinstance(base, Elastic)
    nu = layer.poisson_ratio, base.poisson_ratio
    return (
        Part("layer", flow_stress(layer.strength).value, lambda groups, peak: stresses().in_layer(groups, nu, peak)),
        Part("base", flow_stress(base.strength).value, lambda groups, peak: stresses().in_base(groups, nu, peak)),
    )


def _half_space(solid: Elastic) -> Part:
    return Part("body", flow_stress(solid.strength).value, lambda _, peak: in_half_space(solid.poisson_ratio, peak))


@dataclass(frozen=True)
class Numbers:
    """A number of the ``layer`` and of the ``base``, and ``first``, that of whichever decides."""

    first: Expected = UNKNOWN
    layer: Expected = UNKNOWN
    base: Expected = UNKNOWN


def largest_stresses(parts: Sequence[Part], pressed: Pressed) -> Numbers:
    """Largest √J₂ of a contact in the ``parts``, and in all of them: that of the layer where it is
    so thick that the base is not known."""
    found = {part.name: part.largest(*pressed) for part in parts}
    known = [one for one in found.values() if math.isfinite(one.value)]
    first = max(known, key=_value, default=UNKNOWN)
    if not math.isfinite(found.get("layer", first).value):
        first = UNKNOWN
    return Numbers(first, found.get("layer", UNKNOWN), found.get("base", UNKNOWN))


def yield_factor(parts: Sequence[Part], pressed: Pressed) -> Expected:
    """Factor on the stresses at which the first of the ``parts`` yields; NaN where that of one is
    not known."""
    found = [part.factor(part.largest(*pressed)) for part in parts if _bears(part, pressed)]
    return min(found, key=_value) if found and all(math.isfinite(one.value) for one in found) else UNKNOWN


def yield_loads(
    parts: Sequence[Part], pressed: Callable[[float], Pressed], ends: tuple[float, float]
) -> tuple[Numbers, list[Advice]]:
    """Factors on the load at which the ``parts`` first yield, where ``pressed`` is the contact
    under a factor between ``ends``, and what is to be said of those that do not yield there."""
    found, said, sure = dict[str, Onset](), list[Advice](), True
    for part in parts:
        if not _bears(part, pressed(1.0)):
            continue
        if not math.isfinite(part.yield_stress + part.largest(*pressed(1.0)).value):
            sure = False
            continue
        one = onset(part, pressed, ends)
        if one is not None:
            found[part.name] = min(one, found.get(part.name, one), key=_value)
            continue
        early = part.largest(*pressed(ends[0])).value * math.sqrt(3.0) >= part.yield_stress
        sure = sure and not early
        said.append(_beyond(part.name, ends, early))
    first = min(found.values(), key=_value) if found and sure else UNKNOWN
    return Numbers(first, found.get("layer", UNKNOWN), found.get("base", UNKNOWN)), said


def _value(one: Expected) -> float:
    return one.value


def _bears(part: Part, pressed: Pressed) -> bool:
    """Whether a ``part`` may be the first to yield: a base below a layer thicker than the table has
    bears less than a hundredth of it."""
    return part.name != "base" or pressed[0].spots <= stresses().thickest


def onset(part: Part, pressed: Callable[[float], Pressed], ends: tuple[float, float]) -> Onset | None:
    """Factor on the load at which ``part`` first yields, where ``pressed`` is the contact under a
    factor between ``ends``; None where the mean does not cross the yield stress between them."""
    limit, lowest, highest = part.yield_stress / math.sqrt(3.0), *map(math.log, ends)

    def over(log: float, reach: float) -> float:
        found = part.largest(*pressed(math.exp(log)))
        return found.value + reach * math.hypot(found.error, found.scatter) - limit

    def crossing(reach: float) -> float:
        if over(lowest, reach) >= 0.0:
            return -math.inf
        if over(highest, reach) <= 0.0:
            return math.inf
        return float(optimize.brentq(over, lowest, highest, args=(reach,), xtol=1e-6))

    middle = crossing(0.0)
    if not math.isfinite(middle):
        return None
    at = part.largest(*pressed(math.exp(middle)))
    step = 0.05 if middle + 0.05 < highest else -0.05
    power = math.log(part.largest(*pressed(math.exp(middle + step))).value / at.value) / step
    value = math.exp(middle)
    each = value / (power * at.value)
    return Onset(value, at.error * each, at.scatter * each, math.exp(crossing(2.0)), math.exp(crossing(-2.0)))


def _beyond(name: str, ends: tuple[float, float], early: bool) -> Advice:
    """What is to be said of a part that does not begin to yield between the ``ends`` of the
    loads."""
    if early:
        fact = f"The {name} yields below {ends[0]:.2g} of the load, which is the least in the table."
        return Advice("note", "prediction yield", fact, "Solve it: {solve}.", {"factor": ends[0]})
    fact = f"The {name} does not yield up to {ends[1]:.3g} times the load, which is the largest in the table."
    return Advice("note", "prediction yield", fact, numbers={"factor": ends[1]})


def unknown_parts(one: OneLayer, groups: Groups, alike: bool) -> Iterator[Advice]:
    """Why √J₂ of some part of a coated body is not given."""
    if math.isinf(groups.thickness):
        return
    low, high = THINNEST, stresses().thickest
    if one.error:
        fact = "√J₂ is not predicted of several layers: the table has one."
    elif not alike:
        fact = "√J₂ is not predicted of coated bodies under waves that are not of an exponential autocorrelation."
    elif groups.spots < low:
        fact = (
            f"The thickness is {groups.spots:.2g} times the width λ of the smallest contacts, of which the table has "
            f"{low:.2g} or more: √J₂ is predicted in the base alone."
        )
    elif groups.spots > high:
        fact = (
            f"The thickness is {groups.spots:.3g} times the width λ of the smallest contacts, of which the table has "
            f"up to {high:.3g}: √J₂ is predicted in the layer alone."
        )
    else:
        return
    yield Advice("note", "prediction stress", fact, "Solve it for the rest: {solve}.", {"spots": groups.spots})
