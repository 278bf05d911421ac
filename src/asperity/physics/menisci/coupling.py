"""Menisci of a liquid film as a coupling: they press the surfaces together, which makes more menisci, until both balance.

The force counts pixels, so it jumps, and rounds take it as it is: from a virgin interface it rises to the smallest
balance (Tian & Bhushan 1996; Peng 2001, sec. 3.2.4). The force is remembered from one step to the next: menisci that have
formed hold the bodies until they find no balance any more, so that on unloading the force falls from above to the
largest balance instead. Both ends do not depend on the number of steps. Without external load (``Unloaded``) the menisci
alone hold the bodies; at a prescribed position the force is passive.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from ...contact.answer import Answer
from ...contact.certificate import Certificate
from ...contact.couplings.protocol import Contact, Coupling, Exchange, Memory, Posed, Share
from ...contact.problem import ContactProblem
from ...contact.result import WET_SCALARS
from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError, NoSolutionError
from ...core.grid import Grid
from ...core.late import Shown
from ...core.quantity import Quantity, given, measured, measured_as
from ...core.status import Advice
from ..friction.law import Coulomb
from .advice import findings
from .film import LiquidFilm, Wetting, wetting

_SCALARS = {item.name: item for item in WET_SCALARS}

COLLAPSED = 0.5
"""Share of the nominal area up to which an interface that ends flooded was open, and so has collapsed."""

TOLERANCE = 1e-4
"""Change of the force over the external force that does not count."""

_INSIDE = 0.1
"""Share of the bracket of the force that a step keeps from its ends."""

_ACCURACY = 1e-4
_PIXELS = 2  # that may change sides from one solve to the next by its error alone
_FULL = (
    "Liquid and contact fill nearly all of the interface. Take a thinner film, a rougher surface, stiffer bodies or a liquid of less "
    "surface tension; or prescribe the position, Approach(...) or MeanGap(...)."
)


@dataclass(frozen=True, eq=False, repr=False)
class Menisci(Answer, Shown):
    """What a film of liquid does in a contact, all values SI.

    Attributes
    ----------
    film, wetting
        The liquid, and where it stands.
    external_force, meniscus_force
        W and F_m in N; W is negative where the menisci hold the bodies against a tension (position prescribed).
    dry_friction
        True coefficient of friction μ_r, shear over normal force of the solid contact.
    viscous_force
        Shear of the liquid at the sliding speed, N.
    feedback
        1 - F_m(W)/F_m(W + F_m): share of the meniscus force that is there because menisci press the surfaces together;
        the mean growth dF_m/dL on the way. Zero where the position is prescribed, NaN where menisci of an earlier step
        were there from the start.
    """

    film: LiquidFilm = given()
    wetting: Wetting = measured("", "where the liquid stands")
    external_force: float = measured_as(_SCALARS["external_force"])
    meniscus_force: float = measured_as(_SCALARS["meniscus_force"])
    dry_friction: float = measured("1", "true coefficient of friction")
    viscous_force: float = measured_as(_SCALARS["viscous_force"])
    feedback: float = measured_as(_SCALARS["feedback"])
    quantities: ClassVar[tuple[Quantity, ...]] = WET_SCALARS

    @classmethod
    def given_by(cls, problem: ContactProblem) -> Mapping[str, Any]:
        """The film."""
        return {"film": problem.film}

    def findings(self, certificate: Certificate) -> Iterator[Advice]:
        """Menisci of few pixels or molecules."""
        return findings(self.film, self.wetting)

    def pulls(self) -> float:
        """Force of the menisci."""
        return self.meniscus_force

    def outside(self, force: float, *, alone: bool) -> float:
        """The external force, which menisci that pull alone know to the last digit."""
        return self.external_force if alone else super().outside(force, alone=alone)

    @property
    def relative_meniscus_force(self) -> float:
        """F_m/W; NaN without external force."""
        return self.meniscus_force / self.external_force if self.external_force > 0.0 else math.nan

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
        return self.wetting.share("menisci")

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
        """μ_r (W + F_m) + viscous force in N."""
        return self.dry_friction * (self.external_force + self.meniscus_force) + self.viscous_force

    @property
    def static_friction(self) -> float:
        """Friction force over external force: μ_r (1 + F_m/W) without viscous force; NaN without external force."""
        return self.friction_force / self.external_force if self.external_force > 0.0 else math.nan

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers the numbers rest on."""
        return tuple(sorted({*self.film.citation_keys, *self.wetting.citation_keys}))


@dataclass(frozen=True, eq=False)
class _Note:
    """Where the liquid stands and its force (N); the force of the first round, whether the interface was open in it and dry before.

    ``direction`` is the sign of the first change of the force, ``rounds`` counts replies, ``external`` is the external force (N).
    ``low`` and ``high`` are the forces (N) between which it changes from too much to too little, ``jump`` its last change (N).
    """

    found: Wetting | None = None
    force: float = 0.0
    first: float = 0.0
    was_open: bool = False
    was_dry: bool = True
    direction: float = 0.0
    rounds: int = 0
    external: float = 0.0
    low: float = -math.inf
    high: float = math.inf
    jump: float = 0.0

    def bracketed(self, x: float, step: float) -> _Note:
        """The same after the force ``x`` (N) was found to change by ``step`` (N)."""
        low, high = (x, self.high) if step >= 0.0 else (self.low, x)
        if low >= high:  # what else moves has moved the balance
            low, high = (x, math.inf) if step >= 0.0 else (-math.inf, x)
        return replace(self, low=low, high=high, jump=abs(step))

    @property
    def width(self) -> float:
        """Length (N) within which the balance, or the jump that takes its place, lies."""
        return self.high - self.low


@dataclass(frozen=True)
class MeniscusCoupling(Coupling):
    """Force of the menisci of ``film``, on a map that ``wraps``; the unknown is that force in N. ``friction`` for its forces."""

    film: LiquidFilm
    wraps: tuple[bool, bool]
    friction: Coulomb
    tolerance: float = TOLERANCE
    name: ClassVar[str] = "menisci"
    feedback: ClassVar[bool] = True
    remedy: ClassVar[str] = "Allow more rounds, or take a thinner film, a rougher surface or a larger load."

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """The force remembered; none on a virgin interface."""
        x = np.asarray(memory.get("force", 0.0))
        return Exchange(x, x, np.inf, self.tolerance, smooth=False, accuracy=_ACCURACY, note=_Note(was_dry=not x > 0.0))

    def share(self, exchange: Exchange) -> Share:
        """The force as a load."""
        return Share(load=float(exchange.x))

    def reply(self, exchange: Exchange, contact: Contact) -> Exchange:
        """The force of the menisci of ``contact``.

        Raises
        ------
        NoSolutionError
            If an interface with liquid on less than half of its area has collapsed until liquid or contact nearly fills it.
        """
        note, external = exchange.note, contact.posed.external_force
        found = wetting(contact.gap, contact.touching, self.film, wraps=self.wraps)
        pixel = self.film.suction * contact.posed.operator.grid.pixel_area
        latest, x = pixel * int(np.count_nonzero(found.menisci)), float(exchange.x)
        note = replace(note, found=found, force=latest, rounds=note.rounds + 1, external=external or 0.0)
        if note.rounds == 1:
            note = replace(note, first=latest, was_open=found.share("kept") < COLLAPSED)
        if external is None:
            return replace(exchange, x=np.asarray(latest), target=np.asarray(latest), residual=0.0, note=note)
        if found.regime == "flooded" and note.was_open:
            raise NoSolutionError(f"{self._runaway(external, note)} {_FULL}", subject="meniscus force")
        reference = external or max(latest, x) or 1.0
        step = latest - x
        note = replace(note, direction=note.direction or math.copysign(1.0, step) if step else note.direction)
        # where contact takes the place of menisci the force falls with the load, and plain repetition would swing
        target = latest if step * note.direction >= 0.0 else x + 0.5 * step
        note = note.bracketed(x, step)
        if math.isfinite(note.width) and not _INSIDE < (target - note.low) / (note.width or 1.0) < 1.0 - _INSIDE:
            target = 0.5 * (note.low + note.high)  # an island that comes and goes: the force lies in its jump
        return replace(
            exchange,
            target=np.asarray(target),
            residual=min(abs(step), note.width) / reference,
            tolerance=self.tolerance + _PIXELS * pixel / reference,
            note=note,
        )

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
        if note.width >= note.jump:
            return steady
        return f"{steady} in a jump of {note.jump:.3g} N, by which an island of liquid comes or goes there,"

    def unsettled(self, exchange: Exchange) -> str:
        """The change of the force."""
        return f"The meniscus force still changes by {exchange.residual:.1e} of the external force"

    def end(self, exchange: Exchange, contact: Contact) -> tuple[Memory, Menisci]:
        """Force to go on from, and the menisci."""
        note, external = exchange.note, contact.posed.external_force
        assert note.found is not None
        feedback = 0.0
        if external is not None and note.force > 0.0:
            feedback = 1.0 - note.first / note.force if note.was_dry else math.nan
        grid = contact.posed.operator.grid
        found = Menisci(
            film=self.film,
            wetting=note.found,
            external_force=contact.force - note.force if external is None else external,
            meniscus_force=note.force,
            dry_friction=self.friction.largest,
            viscous_force=viscous_force(contact.gap, grid, note.found, self.film, self.friction.speed),
            feedback=feedback,
        )
        return {"force": exchange.x}, found

    def _runaway(self, external: float, note: _Note) -> str:
        """Beginning of the message on a force that runs away under the ``external`` one (N)."""
        times = f", {note.force / external:.3g} times the external force" if external > 0.0 else ""
        return (
            f"meniscus force runs away: under the external force of {external:.4g} N the menisci pull with {note.first:.4g} N, "
            f"which closes the surfaces, and so on to {note.force:.4g} N{times}, after {note.rounds} solves."
        )


def viscous_force(gap: RealArray, grid: Grid, found: Wetting, film: LiquidFilm, speed: float) -> float:
    """Force in N on the menisci at the sliding ``speed`` in m/s, >= 0: μ A U <1/g>, at most strength times area.

    A is the area of the menisci without contact and <1/g> the mean of the inverse ``gap`` (nx, ny) in m over it.

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
    area = np.count_nonzero(found.menisci) * grid.pixel_area
    with np.errstate(divide="ignore"):
        shear = film.viscosity * speed * float(np.mean(1.0 / gap[found.menisci]))
    return area * min(shear, film.shear_strength)
