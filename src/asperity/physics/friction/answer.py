"""Shear and slip that a step with stick and slip leaves."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

import numpy as np

from ...contact.answer import Answer
from ...contact.certificate import Certificate
from ...contact.couplings.protocol import Memory
from ...contact.tangential import Shift, Tangential, TangentialForce
from ...core.arrays import BoolArray, RealArray
from ...core.quantity import Labelled, Quantity, given, measured, stored_quantities
from ...core.status import Advice, Status
from ...core.units import show
from .law import FrictionLaw

GROSS = 1.0 - 1e-9
"""Share of the largest friction force from which on a prescribed force slides everything."""


@dataclass(frozen=True, eq=False)
class StickSlip(Answer):
    """Shear and slip at the end of one step. Fields are (nx, ny) arrays or (2, nx, ny) arrays of x
    and y components, all values SI.

    Attributes
    ----------
    law
        Law of friction.
    tangential
        What was prescribed in this step.
    traction
        Shear traction (2, nx, ny) on the body in Pa.
    slip_increment, slip
        Slip (2, nx, ny) of the counter body over the body in this step, and since the start of the
        history, in m. Under a force that is all that friction bears it is the least that slides
        every point.
    tangential_displacement
        Displacement (2, nx, ny) of the body relative to the counter body along the surface,
        elastic, in m.
    shear_displacement
        Normal displacement (nx, ny) in m by the shear traction.
    shift_x, shift_y, twist
        Rigid displacement (m) and rotation (rad) of the counter body since the start; the
        displacement is NaN once a tangential force was all that friction bears, since it is not
        determined then.
    force_x, force_y, torque
        Tangential force (N) and torque about the centre of the grid (N·m) on the body.
    friction_limit
        Largest tangential force in N that the contact bears: sum of the bounds.
    dissipation_density
        Energy turned into heat in this step, (nx, ny) in J/m², >= 0.
    dissipated, total_dissipated
        Its integral in J, and the sum over all steps.
    tangential_energy
        Half of shear traction times tangential displacement, J.
    duality_gap
        Bound on the relative error of the tangential energy for the pressure found.
    complementarity
        De Saxcé's residual Σ [p (g + μ|s|) - q·s] over Σ p |shift of the step|, which vanishes at
        solutions of the coupled problem; over the work of the slip where nothing was shifted.
    iterations, fft_pairs
        Newton steps, and FFT pairs of the grid, of all tangential and joint solves.
    status
        How it ended.
    """

    law: FrictionLaw = given("friction")
    tangential: Tangential = measured("", "prescribed shift or tangential force, as JSON")
    traction: RealArray = measured("Pa", "shear traction on the body", "component", "x", "y")
    slip_increment: RealArray = measured("m", "slip in the step", "component", "x", "y")
    slip: RealArray = measured("m", "slip since the start", "component", "x", "y")
    tangential_displacement: RealArray = measured("m", "elastic displacement along the surface", "component", "x", "y")
    shear_displacement: RealArray = measured("m", "normal displacement by shear", "x", "y")
    shift_x: float = measured("m", "shift along x")
    shift_y: float = measured("m", "shift along y")
    twist: float = measured("rad", "twist")
    force_x: float = measured("N", "tangential force along x")
    force_y: float = measured("N", "tangential force along y")
    torque: float = measured("N*m", "torque of the shear traction about the centre")
    friction_limit: float = measured("N", "largest tangential force that friction bears")
    dissipation_density: RealArray = measured("J/m**2", "energy dissipated by slip in the step per area", "x", "y")
    dissipated: float = measured("J", "energy dissipated by slip in the last step")
    total_dissipated: float = measured("J", "energy dissipated by slip in all steps")
    tangential_energy: float = measured("J", "half of shear traction times tangential displacement")
    duality_gap: float = measured("1", "bound on the relative error of the tangential energy")
    complementarity: float = measured("1", "residual of gap and slip together")
    iterations: int = measured("1", "Newton steps of all tangential solves")
    fft_pairs: float = measured("1", "FFT pairs of all tangential solves")
    status: Status = measured("", "how it ended")
    citation_keys: ClassVar[tuple[str, ...]] = ("Alart1991", "DeSaxce1998", "Kalker1990", "Panagiotopoulos1975")
    """Papers of law and method."""

    def remembered(self, approach: float) -> Memory:
        """All of it."""
        return self.memory

    def lifted(self) -> RealArray:
        """Displacement by shear."""
        return self.shear_displacement

    def stores(self, *, relaxing: bool) -> float:
        """The tangential energy, which is part of that of the springs of ``relaxing`` bodies."""
        return 0.0 if relaxing else self.tangential_energy

    def slipped(self) -> float:
        """What slip dissipates."""
        return self.dissipated

    def summed(self, earlier: Sequence[Self]) -> Self:
        """With slip, heat and work of the solver of all parts."""
        parts = [*earlier, self]
        return replace(
            self,
            slip_increment=np.sum([part.slip_increment for part in parts], axis=0),
            dissipation_density=np.sum([part.dissipation_density for part in parts], axis=0),
            dissipated=sum(part.dissipated for part in parts),
            iterations=sum(part.iterations for part in parts),
            fft_pairs=sum(part.fft_pairs for part in parts),
        )

    def ended(self) -> Status:
        """How it ended."""
        return self.status

    def certified(self, certificate: Certificate) -> Certificate:
        """The ``certificate`` with De Saxcé's residual."""
        return replace(certificate, complementarity=self.complementarity)

    def findings(self, certificate: Certificate) -> Iterator[Advice]:
        """Whether how far the counter body slid is not determined."""
        if not math.isnan(self.shift_x):
            return
        if slides_freely(self.tangential, self.friction_limit):
            limit = show(self.friction_limit, "N")
            why = (
                f"The tangential force is all that friction bears, {limit}: every point slides, and the "
                "shift is not determined"
            )
        else:
            why = (
                "In an earlier step the tangential force was all that friction bears: the shift is not determined since"
            )
        yield Advice(
            "warning",
            "shift not determined",
            f"{why}. Slip and heat stated are those of the least shift that slides every point.",
            "Prescribe a shift ({shift}), or a smaller force.",
            {"tangential_force": math.hypot(self.force_x, self.force_y), "friction_limit": self.friction_limit},
            ("shift_", "dissipated", "total_dissipated", "max_slip"),
        )

    @property
    def traction_magnitude(self) -> RealArray:
        """Magnitude of the shear traction, (nx, ny) in Pa."""
        return np.asarray(np.hypot(*self.traction))

    @property
    def slipping(self) -> BoolArray:
        """(nx, ny), True where the surfaces slipped in this step."""
        return np.asarray(np.any(self.slip_increment != 0.0, axis=0))

    def tabled(self, result: Any) -> Iterator[Labelled]:
        """``NUMBERS`` and ``MEASURES``; NaN where there is nothing to divide by."""
        yield from (Labelled(item, float(getattr(self, item.name))) for item in NUMBERS)
        touching = int(np.count_nonzero(result.contact))
        slipping = int(np.count_nonzero(self.slipping & result.contact))
        along = self.force_x * self.shift_x + self.force_y * self.shift_y
        squared = self.shift_x**2 + self.shift_y**2
        finite = 0.0 < self.friction_limit < math.inf
        measures = (
            math.hypot(self.force_x, self.force_y) / self.friction_limit if finite else math.nan,
            1.0 - slipping / touching if touching else math.nan,
            slipping / touching if touching else math.nan,
            float(np.hypot(*self.slip).max()),
            float(self.traction_magnitude.max()),
            along / squared if squared > 0.0 else math.nan,
        )
        yield from (Labelled(item, value) for item, value in zip(MEASURES, measures, strict=True))

    def work_by(self, moved: RealArray, displaced: RealArray, pixel: float) -> float:
        """Work (J) of tangential force and torque while the counter body ``moved`` (3,), on points
        of ``pixel`` m².

        ``displaced`` (2, nx, ny) in m is what the step added to the displacement along the surface.
        Where the shift is not determined it is that of the slip stated.
        """
        if np.isnan(moved).any():
            return pixel * float(np.einsum("kij,kij->", self.traction, self.slip_increment + displaced))
        return float(np.array([self.force_x, self.force_y, self.torque]) @ moved)

    @property
    def memory(self) -> Memory:
        """What the next step starts from; the force is NaN where a shift was prescribed."""
        control = self.tangential
        force = (np.nan, np.nan) if isinstance(control, Shift) else (control.x, control.y)
        return {
            "traction_x": self.traction[0],
            "traction_y": self.traction[1],
            "slip_x": self.slip[0],
            "slip_y": self.slip[1],
            "shift": np.array([self.shift_x, self.shift_y, self.twist]),
            "force": np.array(force),
            "dissipated": np.asarray(self.total_dissipated),
        }


_STORED = {item.name: item for item in stored_quantities(StickSlip)}

NUMBERS = tuple(
    _STORED[name]
    for name in (
        "force_x",
        "force_y",
        "torque",
        "shift_x",
        "shift_y",
        "twist",
        "friction_limit",
        "dissipated",
        "total_dissipated",
        "tangential_energy",
    )
)
"""Numbers that a ``StickSlip`` holds."""

MEASURES = (
    Quantity("friction_share", "1", "tangential force / largest that friction bears"),
    Quantity("stick_area_fraction", "1", "sticking area / real contact area (pixels)"),
    Quantity("slip_area_fraction", "1", "area that slips in the last step / real contact area (pixels)"),
    Quantity("max_slip", "m", "largest slip since the start"),
    Quantity("max_shear_traction", "Pa", "largest shear traction"),
    Quantity("secant_stiffness", "N/m", "tangential force along the shift / shift"),
)
"""Numbers that follow from its fields."""


def slides_freely(control: Tangential, limit: float) -> bool:
    """Whether ``control`` is a force that is all of the ``limit`` (N) that friction bears: how far
    the body then slides is not determined."""
    return isinstance(control, TangentialForce) and control.magnitude >= GROSS * limit
