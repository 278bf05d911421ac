"""Friction as a physics of a problem: what it refuses, its coupling, and its share of the energies
of a history."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ...contact.problem import ContactProblem, Physics, Preparing
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.status import Advice
from .law import Coulomb, FrictionLaw, FullStick, TrescaFriction

if TYPE_CHECKING:
    from ...contact.couplings.protocol import Coupling
    from ...contact.operators import Operator
    from ...contact.result import ContactResult
    from ...contact.state import InterfaceState


UNUSUAL = 2.0
"""Coefficient above which friction is a finding: clean metals in vacuum and soft rubber reach
it."""


@dataclass(frozen=True)
class Rubbing(Physics):
    """Shear of the interface by a ``law`` of friction."""

    law: FrictionLaw
    keyword: ClassVar[str] = "friction"
    takes: ClassVar[Any] = FrictionLaw
    types: ClassVar[tuple[type, ...]] = (Coulomb, FullStick, TrescaFriction)
    moving: ClassVar[str] = ""
    supplies: ClassVar[tuple[str, ...]] = ("tangential_work",)

    def check(self, problem: ContactProblem) -> None:
        """Maps of the law have the shape of the surface."""
        for name, what in {
            "coefficient": "friction coefficient",
            "strength": "shear strength of the interface",
        }.items():
            found = getattr(self.law, name, 0.0)
            if isinstance(found, np.ndarray) and found.shape != problem.surface.shape:
                raise InputError(
                    f"{what} must have the shape {problem.surface.shape} of the surface, but has {found.shape}."
                )

    def advice(self) -> Iterator[Advice]:
        """Whether a coefficient may have been meant in per cent."""
        if isinstance(self.law, Coulomb) and self.law.largest > UNUSUAL:
            yield Advice(
                "warning",
                "friction coefficient",
                f"The friction coefficient is {self.law.largest:.4g} (more than {UNUSUAL:g}), the shear "
                "traction over the pressure: 0.3 for 30 %. Check whether it was meant in per cent; for full "
                "stick it is as it should be.",
            )

    def conserves(self) -> bool:
        """Where shear leaves the pressure as it is: then it is not solved."""
        return isinstance(self.law, Coulomb) and not self.law.couples

    @property
    def slides(self) -> bool:
        """Under plain Coulomb friction."""
        return isinstance(self.law, Coulomb)

    def shear(self, pressure: RealArray) -> RealArray | None:
        """The coefficient times the pressure, along the direction."""
        if not isinstance(self.law, Coulomb) or not np.any(self.law.coefficient):
            return None
        size = self.law.coefficient * pressure
        return np.stack([math.cos(self.law.direction) * size, math.sin(self.law.direction) * size])

    def couplings(self, problem: ContactProblem, operator: Operator, how: Preparing) -> Iterator[Coupling]:
        """Shear of stick and slip, or of gross sliding where that changes the pressure."""
        if how.sticks:
            from .stick_slip import TOLERANCE, StickSlipCoupling

            yield StickSlipCoupling.prepared(problem, how.tolerances.get("stick_slip", TOLERANCE), how.threads)
        elif isinstance(self.law, Coulomb) and self.law.couples:
            from .sliding import TOLERANCE as SLIDING
            from .sliding import SlidingCoupling

            tolerance = how.tolerances.get("sliding", SLIDING)
            yield SlidingCoupling.prepared(problem, self.law, operator.largest, tolerance, how.threads)

    def sticks(self, state: InterfaceState | None, *, tangential: bool) -> bool:
        """Where a step prescribes it, the interface remembers it, or the law knows no gross
        sliding."""
        gross = isinstance(self.law, Coulomb) and self.law.limit == np.inf
        return tangential or not gross or (state is not None and "stick_slip" in state.memory)

    def normal_tolerance(self, *, sticks: bool) -> float | None:
        """1e-12 where shear changes the pressure, so that the error of the normal solve (which goes
        with its root) does not hide that the displacement by shear has settled to 1e-6; 1e-8 with
        stick and slip, which settle to 1e-5."""
        if sticks:
            return 1e-8
        return 1e-12 if isinstance(self.law, Coulomb) and self.law.couples else None

    def works(self, steps: Sequence[ContactResult]) -> Mapping[str, RealArray]:
        """Work of the displacement by the shear of gross sliding; of surfaces that stick and slip
        that of the tangential force, what slip dissipates, and what the length of implicit steps
        takes."""
        pixel = steps[0].problem.grid.pixel_area
        none: RealArray = np.zeros(steps[0].pressure.shape)
        pressure, lift, before = none, none, None
        names = ("shear_work", "tangential_work", "slip_work", "step_work")
        works: dict[str, RealArray] = {name: np.zeros(len(steps)) for name in names}
        for number, result in enumerate(steps):
            creep, now = result.creep, result.stick_slip
            if creep is not None:  # through its steps of time
                works["shear_work"][number] = creep.shear_work
            else:
                # Σ p du by the mean of the pressures before and after
                lifted = none if result.sliding is None else result.sliding.shear_displacement
                mean = 0.5 * float(((result.pressure + pressure) * (lifted - lift)).sum())
                works["shear_work"][number] = mean * pixel
                pressure, lift = result.pressure, lifted
            if now is None:
                continue
            # Q·Δδ, energy dissipated by slip and ½ Σ Δq·Δu
            moved = np.array([now.shift_x, now.shift_y, now.twist])
            traction, displacement = now.traction, now.tangential_displacement
            if before is not None:
                moved = moved - [before.shift_x, before.shift_y, before.twist]
                traction, displacement = traction - before.traction, displacement - before.tangential_displacement
            works["slip_work"][number] = now.dissipated
            if creep is None:
                works["tangential_work"][number] = now.work_by(moved, displacement, pixel)
                works["step_work"][number] = 0.5 * float(np.einsum("kij,kij->", traction, displacement)) * pixel
            else:
                works["tangential_work"][number], works["step_work"][number] = creep.tangential_work, creep.step_work
            before = now
        return works
