"""What adhesion does in a contact."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from ...contact.answer import Answer
from ...contact.couplings.protocol import Memory
from ...core.arrays import RealArray
from ...core.late import Shown
from ...core.quantity import Quantity, given, measured, measured_as
from ...core.status import Status
from ...core.units import show
from .jkr import JKRAdhesion
from .law import Adhesion
from .solver.front import MovingFront
from .solver.soft_core import SoftCoreNewton
from .solver.solver import MajoriseMinimise

RESOLVED, RESOLVED_ZONE = 5.0, 6.0
"""Least pixels in the cohesive length, and in the radius of a contact spot with its zone, for a
pull-off to 1e-2 of a law that falls over its range."""

FALL = 2.0
"""Pixels over the share of the range in which a law falls that both must have for that: below it
the front of the zone advances pixel by pixel."""

STEP, STEP_RADIUS = 75.0, 50.0
"""Pixels from which on even a step holds 1e-2: its error is 0.7 pixels over the cohesive length,
half a pixel over the radius of the zone."""

RESOLVED_RADIUS = 20.0
"""Pixels in the radius of a contact spot from which on the pull-off without a range is right to
8 %; its error is of first order."""

PINNED = 1.0
"""Pixels in the cohesive length below which single pixels snap (1.122 Δx max|σ'| > E*), and the
hysteresis is one of the grid."""


TABLE = (
    Quantity("external_force", "N", "external force"),
    Quantity("attractive_force", "N", "force of the attraction"),
    Quantity("grips", "m", "approach of the grips"),
    Quantity("margin", "1", "1 less the largest eigenvalue of the response to the attraction: positive if stable"),
    Quantity("jumps", "1", "jumps since the first contact"),
)
"""Numbers of every step in tables."""

_EXTERNAL, _ATTRACTIVE, _GRIPS, _MARGIN, _JUMPS = TABLE


@dataclass(frozen=True, eq=False, repr=False)
class AdhesiveContact(Answer, Shown):
    """What adhesion does in a contact; fields are (nx, ny) arrays, all values SI.

    Attributes
    ----------
    law
        The attraction.
    attraction
        σ in Pa, >= 0, also where the surfaces touch; the net traction is the pressure less this.
    attractive_force
        Σσ dA in N.
    external_force
        Force between the solids less the attraction, in N: negative where the contact is pulled.
    grips
        Approach in m of the machine that holds the bodies; that of the bodies where it is rigid.
    adhesive_area_fraction
        Area without touch and a gap below the range ϱ over nominal area.
    interface_energy
        Σφ(g) dA in J, <= 0.
    elastic_energy
        Half of net traction times displacement in J.
    margin
        1 - ρ, ρ being the largest eigenvalue of |σ'|^½ (K/C) |σ'|^½ on the free points: its sign is
        that of the smallest eigenvalue of the Hessian of the energy there. Positive: the contact is
        a minimum at what is prescribed. Of an attraction without range 1 less the energy that the
        most strained point would release over w.
    cohesive_length
        ℓ = E* w/σ0² in m.
    pixel
        Larger spacing of the grid in m.
    dissipated
        Energy in J that was lost in this step, the work of the force between the solids less the
        change of the energy. Elastic bodies lose none without a jump, for on a branch the work is
        that change; where they jump, or something else takes energy, the work is by the trapezoidal
        rule.
    jumped
        Whether that is the loss of a jump.
    jumps
        Number of jumps since the first contact.
    total_dissipated
        Energy in J lost since then.
    residual
        Largest difference of attraction and σ(gap) over σ0.
    energies
        Energy in J after every step of the solver; none is larger than the one before, but without
        range.
    steps, newton_steps, fft_pairs
        Work of the adhesive solver in this step.
    status
        How it ended.
    spot_radius
        Radius in m of a disc as large as the mean contact spot, of a line half the mean width; zero
        without contact.
    dissipated_error
        Bound of the error of ``dissipated`` in J: of the rule half of |ΔF Δδ|, that of a force
        anywhere between those before and after; without a jump what the rule misses, in which a
        smaller jump may hide.
    zone_radius
        The same as ``spot_radius`` of spots with the zone that attracts around them, each weighted
        by its area.
    """

    law: Adhesion = given("adhesion")
    attraction: RealArray = measured("Pa", "attraction of the surfaces", "x", "y")
    attractive_force: float = measured_as(_ATTRACTIVE)
    external_force: float = measured_as(_EXTERNAL)
    grips: float = measured_as(_GRIPS)
    adhesive_area_fraction: float = measured(
        "1", "area that attracts without touching, within the range / nominal area"
    )
    interface_energy: float = measured("J", "energy of the adhesion")
    elastic_energy: float = measured("J", "elastic energy with adhesion")
    margin: float = measured_as(_MARGIN)
    cohesive_length: float = measured("m", "cohesive length")
    pixel: float = measured("m", "larger spacing of the grid")
    dissipated: float = measured("J", "energy lost in this step")
    jumped: bool = measured("1", "whether the contact jumped in this step")
    jumps: int = measured_as(_JUMPS)
    total_dissipated: float = measured("J", "energy lost since the first contact")
    residual: float = measured("1", "largest error of the attraction / strength")
    energies: tuple[float, ...] = measured("J", "energy after every step of the solver", "energy")
    steps: int = measured("1", "steps of the adhesive solver")
    newton_steps: int = measured("1", "Newton steps of the adhesive solver")
    fft_pairs: float = measured("1", "FFT pairs of the adhesive solver")
    status: Status = measured("", "how it ended")
    spot_radius: float = measured("m", "radius of the mean contact spot", default=math.nan)
    dissipated_error: float = measured("J", "bound of the error of the energy lost in this step", default=math.nan)
    zone_radius: float = measured("m", "radius of spots with the zone around them", default=math.nan)
    quantities: ClassVar[tuple[Quantity, ...]] = TABLE

    @property
    def short_range(self) -> bool:
        """Whether the attraction has no range at all, JKR's limit."""
        return math.isinf(self.law.strength)

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers of law and method."""
        return (*self.law.citation_keys, *method_of(self.law).citation_keys)

    def line(self) -> str:
        """Law, forces and stability."""
        pull = f"attractive force {show(self.attractive_force, 'N')}, external force {show(self.external_force, 'N')}"
        return f"AdhesiveContact: {self.law.name}, {pull}, margin of stability {self.margin:.3g}"

    def traction_beside(self) -> RealArray:
        """The attraction."""
        return self.attraction

    def pulls(self) -> float:
        """Its force."""
        return self.attractive_force

    def outside(self, force: float, *, alone: bool) -> float:
        """The external force, which is known to the last digit; ``force`` is that of the
        contact."""
        return self.external_force

    def held_at(self) -> float:
        """The approach of the grips."""
        return self.grips

    def stores(self, *, relaxing: bool) -> float:
        """The energy of the interface."""
        return self.interface_energy

    def has_jumped(self) -> bool:
        """Whether it jumped."""
        return self.jumped

    def summed(self, earlier: Sequence[Self]) -> Self:
        """With the losses and jumps of all parts."""
        parts = [*earlier, self]
        return replace(
            self,
            dissipated=sum(part.dissipated for part in parts),
            dissipated_error=sum(part.dissipated_error for part in parts),
            jumped=any(part.jumped for part in parts),
        )

    def ended(self) -> Status:
        """How the adhesive solver ended."""
        return self.status

    def memory(self, gap: RealArray, approach: float) -> Memory:
        """What the next step starts from, with the ``gap`` (nx, ny) in m and the ``approach`` in m
        of this one."""
        return {"gap": gap, **self.remembered(approach)}

    def remembered(self, approach: float) -> Memory:
        """All of that but the gap."""
        numbers = {
            "energy": self.elastic_energy + self.interface_energy,
            "force": self.external_force,
            "approach": approach,
            "jumps": self.jumps,
            "dissipated": self.total_dissipated,
        }
        return {"attraction": self.attraction} | {key: np.asarray(value) for key, value in numbers.items()}

    @property
    def resolving_length(self) -> float:
        """Length in m that the grid must resolve: ℓ, or of an attraction without range the radius
        of a contact spot."""
        return self.spot_radius if self.short_range else self.cohesive_length

    @property
    def pixels_needed(self) -> float:
        """Pixels that ``resolving_length`` must span: for a pull-off to 1e-2, without a range to
        8 %."""
        return RESOLVED_RADIUS if self.short_range else pixels_in_length(self.law)

    @property
    def radius_needed(self) -> float:
        """Pixels that the radius of spots with their zone must span for the same; zero without a
        range."""
        return 0.0 if self.short_range else pixels_in_length(self.law, RESOLVED_ZONE, STEP_RADIUS)

    @property
    def pixels_per_length(self) -> float:
        """``resolving_length`` over the pixel."""
        return self.resolving_length / self.pixel

    @property
    def pixels_per_radius(self) -> float:
        """Radius of spots with their zone over the pixel; infinite where there are none."""
        return self.zone_radius / self.pixel if self.zone_radius > 0.0 else math.inf

    @property
    def resolved(self) -> bool:
        """Whether the grid resolves both; also where nothing touches without a range, or nothing
        attracts with one."""
        if self.short_range and self.spot_radius == 0.0:
            return True
        return self.pixels_per_length >= self.pixels_needed and self.pixels_per_radius >= self.radius_needed

    @property
    def needed_pixel(self) -> float:
        """Largest pixel in m that resolves it; NaN where there is nothing to resolve."""
        length = self.resolving_length / self.pixels_needed if self.resolving_length > 0.0 else math.nan
        if self.short_range or not self.zone_radius > 0.0:
            return length
        return min(length, self.zone_radius / self.radius_needed)

    @property
    def stable(self) -> bool:
        """Whether the energy is at a minimum."""
        return self.margin > 0.0


def pixels_in_length(law: Adhesion, least: float = RESOLVED, most: float = STEP) -> float:
    """Pixels that the cohesive length of a ``law`` with a range must span, of those of a gentle
    fall and of a step: ``FALL`` over the share of the range in which it falls."""
    return min(max(least, FALL * law.steepest * law.range / law.strength), most)


def method_of(law: Adhesion) -> type[MajoriseMinimise] | type[MovingFront] | type[SoftCoreNewton]:
    """Method that solves contacts with this ``law``."""
    if isinstance(law, JKRAdhesion):
        return MovingFront
    return SoftCoreNewton if law.spacing > 0.0 else MajoriseMinimise
