"""How a contact has worn: numbers along the sliding distance, worn depths, and where to go on
from."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from ...contact.result import ContactResult
from ...contact.state import InterfaceState
from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quantity import Quantity, given, measured
from ...core.status import Advice, Status
from ..stress.criteria import Criterion, VonMises
from ..stress.survey import StressRequest
from .geometry import UNEVEN, Thinned
from .losses import Doses
from .stresses import WornStresses, layer_names, stresses_of

LARGEST_ERROR = 0.2
"""Share of the worn volume that steps may have misplaced, above which numbers are doubtful."""

LEAST_PIXELS = 50
"""Pixels of a contact below which its worn shape is coarse."""

QUANTITIES = (
    Quantity("distance", "m", "sliding distance", ("course",)),
    Quantity("cycles", "1", "cycles", ("course",)),
    Quantity("worn_volume", "m**3", "worn volume of both bodies", ("course",)),
    Quantity("body_volume", "m**3", "worn volume of the body", ("course",)),
    Quantity("counter_volume", "m**3", "worn volume of the counter body", ("course",)),
    Quantity("max_depth", "m", "largest worn depth", ("course",)),
    Quantity("force", "N", "force", ("course",)),
    Quantity("area_fraction", "1", "real contact area / nominal area (pixels)", ("course",)),
    Quantity("max_pressure", "Pa", "maximum pressure", ("course",)),
    Quantity("approach", "m", "approach from first touch of the virgin surfaces", ("course",)),
    Quantity("rms_height", "m", "rms height of the worn composite surface", ("course",)),
    Quantity("bare_fraction", "1", "area without coating / real contact area (pixels)", ("course",)),
    Quantity("plastic_area_fraction", "1", "plastic area / real contact area", ("course",)),
    Quantity("misplaced", "1", "worn volume at the wrong place by the length of steps / worn volume", ("course",)),
)
"""What is known after every step of the sliding distance; ``cycles`` is NaN under gross sliding,
the ``distance`` of fretting the sum of what the mean point slides."""

ROLLING = (
    Quantity("tangential_force", "N", "force along the surface as it rolls", ("course",)),
    Quantity("slip_area_fraction", "1", "area that slips as it rolls / real contact area (pixels)", ("course",)),
    Quantity("rolling_heat", "J/m", "heat per distance rolled", ("course",)),
)
"""What is known besides where it rolls."""


@dataclass(frozen=True, eq=False)
class WearState:
    """Where a contact that wears has come to, from which it goes on as without a break.

    Attributes
    ----------
    distance, cycles
        Sliding distance (m) and number of cycles so far.
    doses
        Dose (Pa m) of both bodies, arrays (nx, ny), of a track (ny,); None for one that does not
        wear.
    interface
        Pressure and memory of the other physics.
    taken
        Depth that the compliance takes off the layers.
    length
        Next step, m or cycles; NaN where it is not known.
    misplaced
        Volume (m³) that steps may have put at the wrong place.
    carried
        Integral of the force over the sliding distance, N m.
    breakthrough
        Distance (m) or number of cycles after which the first point was without its layers;
        infinite before.
    last
        Length of the last step, in which pressures are extrapolated; NaN where there is none.
    contact
        The contact there; solved again where it is None.
    """

    distance: float
    cycles: float
    doses: Doses
    interface: InterfaceState
    taken: Thinned = Thinned()
    length: float = math.nan
    misplaced: float = 0.0
    carried: float = 0.0
    breakthrough: float = math.inf
    last: float = math.nan
    contact: ContactResult | None = field(default=None, repr=False)


@dataclass(frozen=True, eq=False)
class WearHistory:
    """Contact that wears, along the sliding distance or over cycles.

    Attributes
    ----------
    last
        Contact at the end; its problem has the worn surfaces.
    values
        Arrays (n,) by the names in ``QUANTITIES``, and in ``ROLLING`` where it rolls, the first at
        the start.
    body_depth, counter_depth
        Worn depths (nx, ny) in m since the virgin surfaces.
    breakthrough
        Distance (m), of fretting cycles, after which the first point was without its layers; NaN
        where none is, or there are no layers.
    dose_balance
        Sum of the doses less force times distance, relative: rounding, where nothing is lost. NaN
        with a pressure below which nothing wears, and in fretting.
    error
        Share of the worn volume that the length of the steps may have put at the wrong place; the
        sum over the steps, so an upper estimate.
    unevenness, compliance_error
        Standard deviation of the thickness that is left of the layers in the contact over its mean,
        and the relative error of the compliance of one thickness by it; zero without layers.
    contacts
        Number of normal contacts solved.
    fft_pairs
        FFT pairs of the grid that they took.
    status
        How it ended.
    kept
        Contacts at the distances (or cycles) that were asked for, with these, and more where the
        end was not known; the problem of each has its worn surfaces.
    state
        To go on from.
    stresses
        Stresses in the contacts ``kept``, see ``stressed``; None before.
    """

    last: ContactResult = given()
    values: Mapping[str, RealArray] = measured("", "wear along the course", "course", columns=(*QUANTITIES, *ROLLING))
    body_depth: RealArray = measured("m", "worn depth of the body", "x", "y")
    counter_depth: RealArray = measured("m", "worn depth of the counter body", "x", "y")
    breakthrough: float = measured("", "distance (m) or cycles to the first point without layers")
    dose_balance: float = measured("1", "sum of the doses less force times distance, relative")
    error: float = measured("1", "share of the worn volume that steps may have misplaced")
    unevenness: float = measured("1", "variation of the thickness that is left of the layers")
    compliance_error: float = measured("1", "error of the compliance by this variation")
    contacts: int = measured("1", "normal contacts solved")
    fft_pairs: float = measured("1", "FFT pairs of all contacts")
    status: Status = measured("", "how it ended")
    kept: tuple[tuple[float, ContactResult], ...] = given(default=())
    state: WearState | None = given(default=None, repr=False)
    stresses: WornStresses | None = measured("", "stresses as it wears", default=None, repr=False)

    def __getitem__(self, name: str) -> RealArray:
        """Values of the quantity ``name`` along the course.

        Raises
        ------
        InputError
            If there is no such quantity.
        """
        if name not in self.values:
            raise InputError(f"contact that wears has the quantities {', '.join(self.values)}, not {name!r}.")
        return self.values[name]

    @property
    def converged(self) -> bool:
        """Whether every contact reached its tolerance and every step its own."""
        return self.status.converged

    @property
    def fretting(self) -> bool:
        """Whether it is counted in cycles."""
        return not bool(np.isnan(self.values["cycles"]).any())

    @property
    def course(self) -> RealArray:
        """(n,): sliding distance in m, of fretting the cycles."""
        return self.values["cycles" if self.fretting else "distance"]

    @property
    def depth(self) -> RealArray:
        """(nx, ny) in m: worn depth of both bodies together."""
        return np.asarray(self.body_depth + self.counter_depth)

    @property
    def worn_volume(self) -> float:
        """Worn volume of both bodies at the end, m³."""
        return float(self.values["worn_volume"][-1])

    @property
    def wear_rate(self) -> RealArray:
        """(n - 1,): worn volume per distance, m²; of fretting per cycle, m³."""
        return np.asarray(np.diff(self.values["worn_volume"]) / np.diff(self.course))

    def life(self, allowed_depth: float) -> float:
        """Distance (m) or cycles after which the largest worn depth is ``allowed_depth`` (m), by
        interpolation between steps; infinite where it is not reached."""
        depth = self.values["max_depth"]
        if allowed_depth > depth[-1]:
            return math.inf
        return float(np.interp(allowed_depth, depth, self.course))

    def stressed(
        self,
        friction: float = 0.0,
        direction: float = 0.0,
        *,
        of: Literal["body", "counter_body"] = "body",
        criterion: Criterion = VonMises(),
    ) -> WearHistory:
        """The same history with the stresses in the contacts ``kept``, on planes that are dense
        against the contact spots.

        Parameters
        ----------
        friction
            Friction coefficient whose shear traction loads the body, >= 0; that of fretting is
            found with its stick and slip.
        direction
            Angle in rad from x of that traction on the body.
        of
            The body whose stresses are computed, worn as it is then.
        criterion
            What decides on yield: ``VonMises()``, ``Tresca()`` or alike.

        Raises
        ------
        InputError
            If a value is out of range, the body is rigid, or no contact was kept, as in a history
            from a file.
        """
        friction = require.not_negative(friction, "friction coefficient of stresses")
        require.one_of(of, ("body", "counter_body"), "body in which stresses are asked")
        if not self.kept:
            raise InputError(
                "contacts kept of a contact that wears must be at hand for stresses, but there are none: a file holds "
                "the last alone. Ask for the stresses before it is saved."
            )
        request = StressRequest(friction, require.finite(direction, "direction of the friction"), of=of)
        request = replace(request, criterion=criterion)
        request.check(self.kept[0][1].problem)
        body = getattr(self.kept[0][1].problem, of)
        return replace(self, stresses=stresses_of(self.kept, layer_names(body), request))

    def findings(self) -> Iterator[Advice]:
        """What should be known before the numbers are used."""
        if self.unevenness > UNEVEN:
            yield Advice(
                "warning",
                "unevenly worn coating",
                f"What is left of the coating varies in the contact by {self.unevenness:.0%} of its mean thickness. "
                f"The compliance is that of one thickness, and off by about {self.compliance_error:.0%}.",
                "Where the coating is much stiffer or softer than its base, take pressures and stresses as estimates.",
                {"variation": self.unevenness, "error": self.compliance_error},
                ("wear_max_", "wear_area_fraction", "wear_utilisation", "wear_yield"),
            )
        if self.error > LARGEST_ERROR:
            yield Advice(
                "warning",
                "steps of wear",
                f"The length of the steps may have put {self.error:.1%} of the worn volume at the wrong place.",
                "Use a smaller tolerance of the steps ({wear.tolerance}).",
                {"error": self.error},
                ("wear_",),
            )
        pixels = int(np.count_nonzero(self.last.contact))
        if 0 < pixels < LEAST_PIXELS:
            yield Advice(
                "warning",
                "few pixels wear",
                f"The contact that wears has {pixels} pixels.",
                "Use more points, or a smaller area.",
                {"pixels": float(pixels)},
                ("wear_",),
            )
