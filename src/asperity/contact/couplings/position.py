"""A prescribed position as a coupling: the load that reaches it is one more unknown.

At prescribed load the discrete problem is well conditioned up to and beyond full contact; at
prescribed position on a periodic half-space it is not (a uniform pressure moves nothing). Approach
and mean gap are monotone in the load, so the logarithm of the load takes steps towards the position
together with all other unknowns, instead of a search over loads around them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import NoSolutionError
from ...core.status import Progress
from ..controls import Approach, MeanGap
from ..solvers.active_set.level import LevelSearch
from ..solvers.active_set.solver import ActiveSet
from ..solvers.protocol import ContactQP, Solver
from .protocol import Ahead, Contact, Coupling, Exchange, Memory, Posed, Share

# What other values of the constants change: docs/develop/constants.md.

TARGET_ERROR = 1e-9
"""Relative error of a position that is reached, beside ``_HEIGHT_ERROR`` of the rms height: the
last step lands far within, so that a smaller one costs little."""

_HEIGHT_ERROR = 1e-9
"""Error of a position over the rms height: the gap is a difference of heights."""

_LARGEST_SHARE = 1e2
"""Positions over which ``_HEIGHT_ERROR`` of the rms height counts at most: near full contact, where
the mean gap is far below the rms height, it is still reached to 1e-7."""

_SOLVER_SHARE = 1e-2
"""Error of a normal solve over the position, where that is less than the rms height: a hundredth,
so that the noise leads no step astray."""

_FINEST = 1e-10
"""Accuracy over the rms height that is asked of a normal solve at the finest, about the rounding of
its gap."""

_REACHED = 0.5
"""Share of the miss that counts as none to which the load is found along with the pressure."""

_LOOSE = 1e3
"""Errors within which a position counts as reached when the step left for the load is below what
the normal solve resolves."""

_PERSSON = 0.45
"""Mean gap in rms heights by which the logarithm of the load changes by one (Persson's law of
self-affine surfaces): the step before there are two points for a secant."""

_LIGHT = 0.8
"""Power of the load with which the closeness grows where few points touch, between Hertz's 2/3 and
proportionality."""

_AT_FULL = 0.8
"""Logarithm of the load at full contact over rms height times stiffness, for the first guess."""

_BEYOND = 10.0
"""Logarithm of the load beyond full contact of the first guess at most: of flat bodies, whose rms
height is rounding, it would be any number."""

_FARTHEST = float(np.log(8.0))
"""Largest step of the logarithm of the load: a guard against one extrapolation."""

_INSIDE = 1e-3
"""Share of the bracket that a step keeps from its ends, so that it shrinks in every round."""

_CLOSED = 1e-12
"""Width of the bracket of the logarithm of the load that counts as closed, its rounding for loads
between 1e-4 and 1e4 Pa per Pa of modulus."""

_ROUNDING = 8.0 * float(np.finfo(float).eps)
"""Rounding of a gap over the largest height of the profile: of nearly flat surfaces far from the
zero of their heights it is more than the errors above."""

_ROUNDED = 1e-14
"""Height of the highest point above the mean over the largest height, below which it is rounding
and the surface flat."""

_TOWARDS = 0.5
"""Share of its own step that a search alone takes at least: where the position hardly depends on
the load, as beyond full contact of a free body, the extrapolation of earlier rounds may lead
back."""


@dataclass(frozen=True)
class _Note:
    """Mean gap at first touch, closeness wanted from there and what its error is relative to (m);
    bracket of the logarithm of the load, and the last misses (m).

    ``last``: logarithm of the load and closeness (m) of the last solve, ``slope`` of the former
    with the latter between the last two.
    """

    touch: float
    wanted: float
    size: float
    low: float = -np.inf
    high: float = np.inf
    misses: tuple[float, ...] = ()
    last: tuple[float, float] | None = None
    slope: float | None = None


@dataclass(frozen=True)
class Position(Coupling):
    """Load that brings the bodies to the approach or mean gap prescribed; the unknown is the
    logarithm of the mean pressure.

    ``alone``: no other coupling has feedback; then every load tried lies on one side of the one
    looked for, and the bracket holds. ``elastic`` that none limits the pressure: beyond full
    contact a periodic half-space would carry any pressure, for its mean gap cannot be negative.
    ``tolerance`` is that of the normal solves. ``nested``: all others wait until the position is
    reached.
    """

    alone: bool
    elastic: bool
    tolerance: float
    nested: bool = False
    name: ClassVar[str] = "position"
    settled_text: ClassVar[str] = "The prescribed position is reached"
    feedback: ClassVar[bool] = True
    remedy: ClassVar[str] = "Prescribe a load, or a position of less overlap."

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """The load of the start, or a guess, which is within a factor of three on self-affine
        surfaces.

        Raises
        ------
        NoSolutionError
            If the dented surfaces do not touch at this position, or it lies beyond full contact.
        """
        control = posed.control
        touch, wanted = closeness_wanted(posed, elastic=self.elastic)
        known = 0.0 if posed.start is None else float(posed.start.mean())
        if known > 0.0:
            x = np.asarray(np.log(known))
        # Persson's law from the stiffness of the surface as a whole, in proportion to the load
        # where few points touch
        else:
            response = posed.operator.apply(posed.dented)
            stiffness = float(posed.dented.std()) / float(response.std() or 1.0)
            full = float(np.log(posed.height_scale * stiffness or 1.0)) + _AT_FULL
            unit = _PERSSON * posed.height_scale
            light = unit / _LIGHT
            if wanted >= light:
                guess = full + min((wanted - touch) / unit, _BEYOND)
            else:
                guess = full - max(touch - light, 0.0) / unit + float(np.log(wanted / light)) / _LIGHT
            x = np.asarray(guess)
        size = min(wanted, control.value) if isinstance(control, MeanGap) else wanted
        accuracy = max(_SOLVER_SHARE * min(size / posed.height_scale, 1.0), _FINEST)
        return Exchange(x, x, np.inf, accuracy=accuracy, note=_Note(touch, wanted, size))

    def ahead(
        self, exchange: Exchange, qp: ContactQP, start: RealArray | None, solver: Solver, progress: Progress
    ) -> Ahead:
        """The load is found along with the pressure where contacts can be moved."""
        if not (isinstance(solver, ActiveSet) and LevelSearch.serves(solver, qp)):
            return Ahead()
        note, scale = exchange.note, qp.height_scale
        level = note.wanted - note.touch - float(qp.profile.mean())

        def towards(reached: float) -> float:
            return float(np.clip(_step(note.wanted + reached - level, note.wanted, scale), -_FARTHEST, _FARTHEST))

        search = LevelSearch(solver, qp, level, _REACHED * _allowed(note.size, scale, qp.profile), towards, progress)
        found = search.found(start)
        if found.at is None:
            return Ahead(found.pairs, found.iterations)
        x = np.asarray(np.log(float(found.at.pressure.mean())))
        known = replace(exchange, x=x, target=x, pressure=found.at.pressure)
        return Ahead(found.pairs, found.iterations, known, found.at.deflection)

    def share(self, exchange: Exchange) -> Share:
        """None: the driver poses the mean pressure exp(x)."""
        return Share()

    def reply(self, exchange: Exchange, contact: Contact) -> Exchange:
        """Step of the logarithm of the load, from how far the bodies are from the position."""
        note, x, posed = exchange.note, float(exchange.x), contact.posed
        if isinstance(posed.control, Approach):  # since the dented surfaces touched
            closeness = contact.level + float(posed.dented.max())
        else:
            closeness = note.touch - float(contact.gap.mean())
        miss = closeness - note.wanted
        noise = contact.solution.state.error * posed.height_scale
        low = x if miss < -noise else note.low
        high = x if miss > noise else note.high
        note = replace(note, low=low, high=high, misses=(*note.misses[-2:], abs(miss)))
        allowed = _allowed(note.size, posed.height_scale, posed.profile)
        if note.last is not None and note.last[1] != closeness:
            note = replace(note, slope=(x - note.last[0]) / (closeness - note.last[1]))
        note = replace(note, last=(x, closeness))
        step = _step(closeness, note.wanted, posed.height_scale)
        if self.nested and note.slope is not None and note.slope > 0.0:
            step = note.slope * (note.wanted - closeness)
        if abs(step) <= max(_CLOSED, 0.1 * self.tolerance) and abs(miss) <= _LOOSE * allowed:
            miss = 0.0  # a load that far away is not resolved by the normal solve
        lowest, highest = x - _FARTHEST, x + _FARTHEST
        if self.alone and x == high:
            highest = x + _TOWARDS * step
        elif self.alone and x == low:
            lowest = x + _TOWARDS * step
        if self.alone and np.isfinite(high - low):
            slow = len(note.misses) > 2 and note.misses[-1] > 0.5 * note.misses[0]
            inside = (0.5 if slow else _INSIDE) * (high - low)
            lowest, highest = low + inside, high - inside
        return replace(
            exchange,
            target=np.asarray(x + step),
            residual=abs(miss) / note.size,
            tolerance=allowed / note.size,
            lowest=lowest,
            highest=highest,
            stuck=self.alone and high - low < max(_CLOSED, 0.1 * self.tolerance),
            note=note,
        )

    def rescued(self, exchange: Exchange, mean: float) -> Exchange | None:
        """Half the way back to the largest load known to be too small."""
        x, note = float(exchange.x), exchange.note
        low = note.low if x - _FARTHEST < note.low < x - _CLOSED else x - _FARTHEST
        note = replace(note, low=min(low, note.low), high=min(note.high, x))
        return replace(exchange, x=np.asarray(0.5 * (low + note.high)), note=note)

    def unsettled(self, exchange: Exchange) -> str:
        """That no load reaches it, or how far it is."""
        if exchange.stuck:
            return (
                "No load reaches the prescribed position: where nearly every point yields, the position jumps "
                "with the load, and at a mean pressure equal to the hardness it is undetermined. This was "
                "found"
            )
        return f"The prescribed position is still missed by {exchange.residual:.1e}"


def _step(closeness: float, wanted: float, scale: float) -> float:
    """Step of the logarithm of the load from a ``closeness`` to that ``wanted`` (m), heights having
    the rms ``scale`` (m): by Persson's law, mean gap = -0.45 rms ln p + ..., or by proportionality
    at light loads."""
    if closeness <= 0.0:
        return _FARTHEST
    if max(closeness, wanted) < _PERSSON * scale / _LIGHT:
        return float(np.log(wanted / closeness)) / _LIGHT
    return (wanted - closeness) / (_PERSSON * scale)


def _allowed(size: float, scale: float, profile: RealArray) -> float:
    """Miss (m) of a position of this ``size`` that counts as none; ``scale``: rms height (m)."""
    allowed = TARGET_ERROR * size + _HEIGHT_ERROR * min(scale, _LARGEST_SHARE * size)
    return allowed + _ROUNDING * float(np.abs(profile).max())


def without_bracket(exchange: Exchange) -> Exchange:
    """``exchange`` of a position without the bracket, found with other couplings as they were."""
    return replace(exchange, note=replace(exchange.note, low=-np.inf, high=np.inf, misses=(), last=None))


def closeness_wanted(posed: Posed, *, elastic: bool) -> tuple[float, float]:
    """Mean gap (m) at first touch of the dented surfaces, and how much closer (m) than there the
    bodies are to come; ``elastic`` as of ``Position``.

    Raises
    ------
    NoSolutionError
        If they do not touch at this position, or it lies beyond full contact.
    """
    control, h = posed.control, posed.dented
    highest, touch = float(h.max()), float(h.max() - h.mean())
    flat = touch <= _ROUNDED * float(np.abs(h).max())
    if flat and (elastic or isinstance(control, MeanGap)):
        raise NoSolutionError(
            f"{control.name} of flat bodies must be zero in contact, which is full as soon as they touch, "
            f"whatever the load, but is {control.value:.6g} m. Prescribe {{mean_pressure}} instead."
        )
    if isinstance(control, Approach):
        if elastic and control.value >= posed.top - float(h.mean()):
            raise NoSolutionError(
                f"approach must be less than {posed.top - float(h.mean()):.6g} m, where a periodic elastic "
                f"contact is full and its mean gap zero, but is {control.value:.6g} m. Prescribe "
                f"{{mean_pressure}} to go beyond full contact."
            )
        wanted = control.value - (posed.top - highest)
        if wanted <= 0.0:
            raise NoSolutionError(
                f"approach must be more than {posed.top - highest:.6g} m, where the bodies touch after their permanent "
                f"indentation, but is {control.value:.6g} m. Use Unloaded() for no load."
            )
        return touch, wanted
    assert isinstance(control, MeanGap)
    wanted = touch - control.value
    if wanted <= 0.0:
        raise NoSolutionError(
            f"mean gap must be less than {touch:.6g} m, the mean gap at first touch, but is {control.value:.6g} m."
        )
    return touch, wanted
