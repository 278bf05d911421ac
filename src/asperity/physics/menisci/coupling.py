"""Menisci of a liquid film as a coupling: they press the surfaces together, which makes more
menisci, until both balance.

The force counts pixels, so it jumps, and rounds take it as it is: from a virgin interface it rises
to the smallest balance (Tian & Bhushan 1996; Peng 2001, sec. 3.2.4). Where contact takes the place
of liquid it falls, and the balance is enclosed between two forces; if it lies in the fall itself,
pixels are under liquid in part (``bracket``). The force is remembered from one step to the next:
menisci that have formed hold the bodies until they find no balance any more, so that on unloading
the force falls from above to the largest balance instead. Both ends do not depend on the number of
steps. Without external load (``Unloaded``) the menisci alone hold the bodies; at a prescribed
position the force is passive. So it is of a film without ``feedback``, whose force is that in the
gap of the external load.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from ...contact.answer import Answer
from ...contact.certificate import Certificate
from ...contact.couplings.protocol import Contact, Coupling, Exchange, Memory, Posed, Share
from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError, NoSolutionError
from ...core.grid import Grid
from ...core.late import Shown
from ...core.quantity import Quantity, given, measured, measured_as
from ...core.status import Advice
from ...core.units import show, times
from ..friction.law import Coulomb, TrescaFriction
from .advice import findings
from .bracket import SMALL, Bracket, End, astray
from .film import LiquidFilm, Wetting, wetting
from .quantities import WET_SCALARS

_SCALARS = {item.name: item for item in WET_SCALARS}

COLLAPSED = 0.5
"""Share of the nominal area up to which an interface that ends flooded was open, and so has
collapsed."""

TOLERANCE = 1e-4
"""Force by which external force, menisci and contact may miss their balance, over that of the
contact."""

_MORE = 1.0 + 1e-9
"""Residual over tolerance of a bracket that has closed before it was looked at whether it may."""

_LOOKED_AT = 5
"""Rounds for which each end of a bracket is kept where pixels change sides that may not be wet in
part. Displacement by shear, hardness and creep settle by a factor of five to ten a round, and the
bracket is a ten thousandth of the force wide."""

_NARROWEST = 1e-7
"""Width of the bracket, over the force of the contact, at which what still changes sides elsewhere
jumps; about the error of a normal solve."""

_GROWTH = 2.0
"""Largest ratio of the loads of two rounds, so that a balance is not stepped over where contact
takes the place of liquid in between. Without a limit 800 random contacts take a tenth less rounds,
and one more is refused, which has a balance on the way."""

_CLOSE = 1e-2
"""Distance over the force of the contact from the largest force that a hardness is known to bear to
one that it does not, at which no balance is expected between them."""

_ACCURACY = 1e-4
_FULL = (
    "Liquid and contact fill nearly all of the interface. Take a thinner film, a rougher surface, stiffer "
    "bodies or a liquid of less surface tension; prescribe the position, {approach} or {mean_gap}; or take the "
    "force in the gap of the load alone, {film.feedback=false}."
)


@dataclass(frozen=True, eq=False, repr=False)
class Menisci(Answer, Shown):
    """What a film of liquid does in a contact, all values SI.

    Attributes
    ----------
    film, wetting
        The liquid, and where it stands.
    external_force, meniscus_force
        W and F_m in N; W is negative where the menisci hold the bodies against a tension (position
        prescribed).
    dry_friction
        True coefficient of friction μ_r, shear over normal force of the solid contact; with a shear
        strength τ of the interface τ A_r/(W + F_m).
    viscous_force
        Shear of the liquid at the sliding speed, N.
    feedback
        1 - F_m(W)/F_m(W + F_m): share of the meniscus force that is there because menisci press the
        surfaces together; the mean growth dF_m/dL on the way. Zero where the position is
        prescribed or the film has no feedback, NaN where menisci of an earlier step were there from
        the start.
    """

    film: LiquidFilm = given("film")
    wetting: Wetting = measured("", "where the liquid stands")
    external_force: float = measured_as(_SCALARS["external_force"])
    meniscus_force: float = measured_as(_SCALARS["meniscus_force"])
    dry_friction: float = measured("1", "true coefficient of friction")
    viscous_force: float = measured_as(_SCALARS["viscous_force"])
    feedback: float = measured_as(_SCALARS["feedback"])
    quantities: ClassVar[tuple[Quantity, ...]] = WET_SCALARS

    def line(self) -> str:
        """Number and force of the menisci."""
        pull, share = show(self.meniscus_force, "N"), f"{self.relative_meniscus_force:.3g}"
        return f"Menisci: {self.n_menisci}, meniscus force {pull}, {share} of the external force"

    def require_sound(self) -> None:
        """Shares of points under liquid are between 0 and 1."""
        filled = self.wetting.filled
        if not ((filled >= 0.0) & (filled <= 1.0)).all():  # false for NaN as well
            raise ValueError("wetting_filled: it is not between 0 and 1 everywhere")

    def findings(self, certificate: Certificate) -> Iterator[Advice]:
        """Menisci of few pixels or molecules, and a force that is not fed back."""
        return findings(self.film, self.wetting, self.meniscus_force, self.external_force)

    def friction_under_load(self) -> float | None:
        """That of solids and liquid, where there is friction."""
        return self.static_friction if self.friction_force > 0.0 else None

    def pulls(self) -> float:
        """Force of the menisci, where it presses the bodies together."""
        return self.meniscus_force if self.film.feedback else 0.0

    def outside(self, force: float, *, alone: bool) -> float:
        """The external force, which menisci that pull alone know to the last digit."""
        return self.external_force if alone else super().outside(force, alone=alone)

    @property
    def relative_meniscus_force(self) -> float:
        """F_m/W; NaN without external force."""
        return self.meniscus_force / self.external_force if self.external_force > 0.0 else math.nan

    @property
    def unfed_meniscus_force(self) -> float:
        """F_m(W) in N: that in the gap of the external force alone; NaN where ``feedback`` is."""
        return self.meniscus_force * (1.0 - self.feedback)

    @property
    def suction(self) -> float:
        """Pressure deficit in the menisci in Pa."""
        return self.film.suction

    @property
    def film_thickness(self) -> float:
        """h_f in m."""
        return self.film.thickness

    @property
    def meniscus_height(self) -> float:
        """h_m in m."""
        return self.film.meniscus_height

    @property
    def meniscus_area_fraction(self) -> float:
        """Area that the suction acts on over nominal area."""
        return self.wetting.share("filled")

    @property
    def wetted_area_fraction(self) -> float:
        """Pixels with a gap up to the film thickness over all."""
        return self.wetting.share("wetted")

    @property
    def cut_area_fraction(self) -> float:
        """Pixels with a gap up to the meniscus height over all."""
        return self.wetting.share("cut")

    @property
    def n_menisci(self) -> int:
        """Number of islands that hold liquid."""
        return self.wetting.n_menisci

    @property
    def friction_force(self) -> float:
        """μ_r (W + F_m) + viscous force in N; τ A_r + viscous force with the shear strength τ of
        ``TrescaFriction`` on the area A_r in contact, counted in pixels."""
        return self.dry_friction * (self.external_force + self.meniscus_force) + self.viscous_force

    @property
    def static_friction(self) -> float:
        """Friction force over external force: μ_r (1 + F_m/W) without viscous force; NaN without
        external force."""
        return self.friction_force / self.external_force if self.external_force > 0.0 else math.nan

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers the numbers rest on."""
        return tuple(sorted({*self.film.citation_keys, *self.wetting.citation_keys}))


@dataclass(frozen=True, eq=False)
class _Note:
    """Where the liquid stands and its force (N); the force of the first round, whether the
    interface was open in it and dry before.

    ``direction`` is the sign of the first change of the force, ``before`` the force (N) posed in
    the round before the latest, ``borne`` that of the latest, ``rounds`` counts replies,
    ``external`` is the external force (N). ``bracket`` is where the balance lies, found by solves
    to the full tolerance, ``closed`` whether it has closed on a jump of ``jump`` (N), ``astray``
    how many pixels change sides there that may not be wet in part, ``width`` that of the bracket
    then over the force of the contact, and ``looked`` the rounds in which its ends have been looked
    at.
    """

    found: Wetting | None = None
    force: float = 0.0
    first: float = 0.0
    was_open: bool = False
    was_dry: bool = True
    direction: float = 0.0
    before: float = math.nan
    borne: float = 0.0
    rounds: int = 0
    external: float = 0.0
    bracket: Bracket = Bracket()
    closed: bool = False
    astray: int = 0
    width: float = 0.0
    looked: int = 0
    jump: float = 0.0


@dataclass(frozen=True)
class MeniscusCoupling(Coupling):
    """Force of the menisci of ``film``, on a map that ``wraps``; the unknown is that force in N.
    ``friction`` for its forces."""

    film: LiquidFilm
    wraps: tuple[bool, bool]
    friction: Coulomb | TrescaFriction
    tolerance: float = TOLERANCE
    name: ClassVar[str] = "menisci"
    feedback: ClassVar[bool] = True
    remedy: ClassVar[str] = (
        "Take a thinner film, a rougher surface or a larger load; prescribe the position; or allow more rounds."
    )

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """The force remembered; none on a virgin interface, or without feedback."""
        x = np.asarray(memory.get("force", 0.0) if self.film.feedback else 0.0)
        return Exchange(x, x, np.inf, self.tolerance, smooth=False, accuracy=_ACCURACY, note=_Note(was_dry=not x > 0.0))

    def share(self, exchange: Exchange) -> Share:
        """The force as a load."""
        return Share(load=float(exchange.x))

    def reply(self, exchange: Exchange, contact: Contact) -> Exchange:
        """The force of the menisci of ``contact``.

        Raises
        ------
        NoSolutionError
            If an interface with liquid on less than half of its area has collapsed until liquid or
            contact nearly fills it.
        """
        note, external = exchange.note, contact.posed.external_force
        found = wetting(contact.gap, contact.touching, self.film, wraps=self.wraps)
        latest, x = self.film.suction * found.share("filled") * contact.posed.operator.grid.area, float(exchange.x)
        note = replace(note, found=found, force=latest, borne=x, rounds=note.rounds + 1, external=external or 0.0)
        if note.rounds == 1:
            note = replace(note, first=latest, was_open=found.share("kept") < COLLAPSED)
        if not self.film.feedback:
            return replace(exchange, residual=0.0, note=note)
        if external is None:
            return replace(exchange, x=np.asarray(latest), target=np.asarray(latest), residual=0.0, note=note)
        step = latest - x
        note = replace(note, direction=note.direction or math.copysign(1.0, step) if step else note.direction)
        if exchange.exact:
            replied = self._enclosed(replace(exchange, note=note), contact, step)
        else:  # while the force goes on in one direction solves need not be exact: what is pulled is posed next
            residual = abs(step) / _whole(external, x, latest)
            # contact takes the place of liquid, or the error of a solve has led too far
            turned = step * note.direction < 0.0
            exact, load, target = turned or residual <= self.tolerance, external + x, latest
            if load > 0.0:
                target = min(max(target, load / _GROWTH - external), _GROWTH * load - external)
            note, target = note if turned else replace(note, before=x), x if exact else target
            replied = replace(exchange, target=np.asarray(target), residual=residual, exact=exact, note=note)
        if found.full and note.was_open and (step >= 0.0 or replied.settled):
            raise NoSolutionError(f"{self._runaway(external, note)} {_FULL}", subject="meniscus force")
        return replied

    def _enclosed(self, exchange: Exchange, contact: Contact, step: float) -> Exchange:
        """Reply by solves to the full tolerance: the balance is enclosed, until the force that is
        posed is pulled or the balance lies in a jump."""
        note, x = exchange.note, float(exchange.x)
        end = End(x, note.force, note.found, contact.gap, contact.pressure)
        bracket = note.bracket.with_end(end)
        whole, across = _whole(note.external, x, note.force), bracket.other(end)
        residual, closed, target = abs(step) / whole, False, x
        note = replace(note, bracket=bracket, before=math.nan, closed=False, astray=0)
        if residual > self.tolerance and across is None and step * (exchange.note.before - x) > 0.0:
            target = exchange.note.before  # the round before is likely to be the other end
        elif residual > self.tolerance:
            closed = across is not None and bracket.width <= self.tolerance * whole
            target = bracket.further(end, note.external)
        if not closed or across is None:
            note = replace(note, looked=0) if bracket.width > self.tolerance * whole else note
            residual = min(residual, max(bracket.width / whole, _MORE * self.tolerance))
            return replace(exchange, target=np.asarray(target), residual=residual, stuck=False, note=note)
        # the balance lies in the jump of the force from this end to the one across: pixels are wet
        # in part
        exchange, grid = replace(exchange, stuck=False), contact.posed.operator.grid
        stands = bracket.balanced(end)
        force = self.film.suction * stands.share("filled") * grid.area
        count, pixel = astray(end, across, self.film.meniscus_height), self.film.suction * grid.pixel_area
        note = replace(note, found=stands, force=force, closed=True, jump=abs(end.pulls - across.pulls))
        if count * pixel > SMALL * whole:
            # pixels change sides that may not be wet in part: both ends are kept for some rounds,
            # so that what else moves comes to rest; then the bracket is closed further and its ends
            # are looked at once more; what still jumps does
            note = replace(note, found=end.stands, force=end.pulls, astray=count, width=bracket.width / whole)
            target, looked = end.posed, note.looked + 1
            if looked >= 2 * _LOOKED_AT and note.width > _NARROWEST:
                target, looked = bracket.further(end, note.external), 2 * _LOOKED_AT
            elif looked in (_LOOKED_AT, 3 * _LOOKED_AT):
                target = across.posed
            elif looked >= 4 * _LOOKED_AT:
                return replace(exchange, residual=abs(end.step) / whole, stuck=True, note=note)
            residual, note = _MORE * self.tolerance, replace(note, looked=looked)
            return replace(exchange, target=np.asarray(target), residual=residual, note=note)
        return replace(exchange, target=exchange.x, residual=abs(force - end.posed) / whole, note=note)

    def rescued(self, exchange: Exchange, mean: float) -> Exchange | None:
        """Half the way back to the last force that was borne; None where that is not far: then no
        balance is left in between."""
        note, x = exchange.note, float(exchange.x)
        if note.rounds == 0 or x - note.borne <= _CLOSE * (note.external + x):
            return None
        return replace(exchange, x=np.asarray(0.5 * (note.borne + x)))

    def unbearable(self, exchange: Exchange, error: NoSolutionError) -> NoSolutionError | None:
        """The force that runs away, if there is one."""
        note = exchange.note
        if note.rounds == 0 or not float(exchange.x) > 0.0:
            return None
        force = replace(note, force=float(exchange.x))
        words = f"{self._runaway(note.external, force)} The contact bears no more: {error}"
        return NoSolutionError(words, subject=f"{error.subject} with the menisci")

    def settled(self, exchange: Exchange) -> str:
        """That the force is steady, and how the liquid stands."""
        note: _Note = exchange.note
        steady = f"The meniscus force is steady ({note.found.regime if note.found else 'dry'})"
        if not note.closed or note.found is None:
            return steady
        pixels = int(np.count_nonzero(note.found.partly))
        return f"{steady} in a jump of {note.jump:.3g} N, {_pixels(pixels)} being under liquid in part there,"

    def unsettled(self, exchange: Exchange) -> str:
        """The change of the force."""
        note: _Note = exchange.note
        if note.astray:
            return (
                f"The meniscus force jumps past its balance: by {note.jump:.3g} N from the contact force of "
                f"{note.external + float(exchange.x):.6g} N to one that is the same within {note.width:.0e}, "
                f"as {_pixels(note.astray)} away from the edge of the liquid fill or dry at once. This was "
                "found"
            )
        return f"The meniscus force still changes by {exchange.residual:.1e} of the contact force"

    def apart(self, exchange: Exchange, contact: Contact) -> Exchange:
        """Liquid stands in the open gap, too."""
        return self.reply(exchange, contact)

    def end(self, exchange: Exchange, contact: Contact) -> tuple[Memory, Menisci]:
        """Force to go on from, and the menisci."""
        note, external = exchange.note, contact.posed.external_force
        assert note.found is not None
        feedback, fed = 0.0, note.force if self.film.feedback else 0.0
        if external is not None and fed > 0.0:
            feedback = 1.0 - note.first / note.force if note.was_dry else math.nan
        if external is None:
            external = contact.force - fed
        grid = contact.posed.operator.grid
        if isinstance(self.friction, Coulomb):
            coefficient = self.friction.largest
        else:  # adhesional: what the contact bears, whatever presses it
            borne, carried = float(self.friction.bound(contact.pressure).sum()), external + note.force
            coefficient = borne * grid.pixel_area / carried if carried > 0.0 else 0.0
        found = Menisci(
            film=self.film,
            wetting=note.found,
            external_force=external,
            meniscus_force=note.force,
            dry_friction=coefficient,
            viscous_force=viscous_force(contact.gap, grid, note.found, self.film, self.friction.speed),
            feedback=feedback,
        )
        return {"force": exchange.x}, found

    def _runaway(self, external: float, note: _Note) -> str:
        """Beginning of the message on a force that runs away under the ``external`` one (N)."""
        share = f", {times(note.force / external, 3)} times the external force" if external > 0.0 else ""
        return (
            f"meniscus force runs away: under the external force of {external:.4g} N the menisci pull with "
            f"{note.first:.4g} N, which closes the surfaces, and so on to {note.force:.4g} N{share}, after "
            f"{note.rounds} solves."
        )


def _whole(external: float, posed: float, pulls: float) -> float:
    """Force (N) relative to which that of the menisci is balanced: of the ``external`` force and
    the menisci ``posed``; without both what these would pull."""
    whole = external + posed if external >= 0.0 else max(-external, posed)
    return whole or pulls or 1.0


def _pixels(count: int) -> str:
    return f"{count} pixel{'' if count == 1 else 's'}"


def viscous_force(gap: RealArray, grid: Grid, found: Wetting, film: LiquidFilm, speed: float) -> float:
    """Force in N on the menisci at the sliding ``speed`` in m/s, >= 0: μ A U <1/g>, at most
    strength times area.

    A is the area of the menisci without contact and <1/g> the mean of the inverse ``gap`` (nx, ny)
    in m over it.

    Raises
    ------
    InputError
        If the speed is negative, or the viscosity of the liquid is not known and it moves.
    """
    if require.not_negative(speed, "sliding speed (m/s)") == 0.0 or not found.menisci.any():
        return 0.0
    if math.isnan(film.viscosity):
        raise InputError(
            "viscosity of the liquid must be known for viscous friction, but is not; give it, or a speed of 0."
        )
    area = found.share("filled") * grid.area
    with np.errstate(divide="ignore"):
        shear = film.viscosity * speed * float(np.mean(1.0 / gap[found.menisci]))
    return area * min(shear, film.shear_strength)
