"""A line scan as frozen data: heights along one line, with what is known of the instrument and the
lay."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any, NoReturn

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import BoolArray, RealArray
from ..core.citations import Origin
from ..core.errors import InputError
from ..core.late import Drawn
from ..core.units import percent, show
from ..core.values import LEAST

_UNEVEN = 0.1  # of a step by which points may be off a regular grid: coordinates are written with few digits
_FEW_BACK = 0.1  # share of steps against the others up to which a trace turned back; more were never in order


@dataclass(frozen=True)
class Instrument:
    """What a line scan was measured with; NaN and the empty text stand for what is not known.

    ``kind`` such as ``stylus``, ``optical`` or ``afm``; ``tip_radius``, lateral ``resolution`` and
    rms ``noise`` of the heights in m, positive. Raises InputError if a number is not positive.
    """

    kind: str = ""
    tip_radius: float = math.nan
    resolution: float = math.nan
    noise: float = math.nan

    def __post_init__(self) -> None:
        for name in ("tip_radius", "resolution", "noise"):
            value = getattr(self, name)
            if not (isinstance(value, float) and math.isnan(value)):
                object.__setattr__(self, name, require.positive(value, f"{name} of an instrument (m)"))


@dataclass(frozen=True, eq=False, init=False, repr=False)
class Profile(Drawn):
    """Heights at equal steps along one line, positive out of the solid (the material is below).

    What needs an area refuses a line scan: a map is made from it only under an assumption that is
    named, grooves without end (``strip``) or an isotropic surface
    (``asperity.roughness.isotropic_spectrum``). Raises InputError if heights are not a real array
    of one dimension, hold an infinity or are missing everywhere, or a length is not positive.

    Parameters
    ----------
    heights
        (n,) heights in m. NaN marks a missing point.
    spacing
        Distance Δ of neighbouring points in m; the length is n Δ.
    periodic
        Whether point n equals point 0 (a closed or generated profile); a measured one is not
        periodic.
    mask
        (n,), True where the point is missing. Points with NaN height are added to it.
    lay_angle
        Angle φ in rad, between -π/2 and π/2, from the normal of a unidirectional lay to the trace;
        NaN if there is no lay or it is not known. Lengths along the trace are 1/cos φ times those
        across the lay.
    instrument
        What it was measured with.
    short_cutoff
        Wavelength in m below which waves are not resolved or have been removed; 0 if only the
        spacing limits them.
    origin
        Source, channel, instrument and history.
    """

    heights: RealArray
    spacing: float
    periodic: bool
    mask: BoolArray
    lay_angle: float
    instrument: Instrument
    short_cutoff: float
    origin: Origin = field(repr=False)

    def __init__(
        self,
        heights: ArrayLike,
        spacing: float,
        *,
        periodic: bool = False,
        mask: ArrayLike | None = None,
        lay_angle: float = math.nan,
        instrument: Instrument = Instrument(),
        short_cutoff: float = 0.0,
        origin: Origin = Origin(),
    ) -> None:
        values, missing = _checked(heights, mask)
        if not math.isnan(lay_angle):
            lay_angle = require.between(lay_angle, -0.5 * math.pi, 0.5 * math.pi, "angle of a profile to the lay (rad)")
        for name, value in (
            ("heights", values),
            ("spacing", require.magnitude(spacing, "spacing of a profile (m)")),
            ("periodic", bool(periodic)),
            ("mask", missing),
            ("lay_angle", lay_angle),
            ("instrument", require.instance(instrument, Instrument, "instrument of a profile")),
            ("short_cutoff", require.not_negative(short_cutoff, "short cut-off of a profile (m)")),
            ("origin", origin),
        ):
            object.__setattr__(self, name, value)

    @classmethod
    def from_points(cls, x: ArrayLike, heights: ArrayLike, **more: Any) -> Profile:
        """Profile through points at the coordinates ``x`` (n,) in m with ``heights`` (n,) in m;
        ``more`` as for a profile.

        Points at equal steps to a tenth of a step are taken as they are. Others are interpolated
        linearly to the *median* spacing, with the coarsest spacing as short cut-off. Descending or
        unordered points are sorted. Raises InputError if the arrays differ in length or have fewer
        than two points, a coordinate is not finite, two points have the same coordinate, or the
        trace turns back (an overhang).
        """
        place, values = np.asarray(x, dtype=np.float64), np.asarray(heights, dtype=np.float64)
        if place.ndim != 1 or place.shape != values.shape or place.size < 2:
            raise InputError(
                "points of a profile must be two arrays of the same length of at least 2, but have shapes "
                f"{place.shape} and {values.shape}."
            )
        if not np.isfinite(place).all():
            raise InputError(
                "coordinates of a profile (m) must be finite, but hold NaN or infinities. Leave those out."
            )
        steps = np.diff(place)
        back = int(min(np.count_nonzero(steps < 0.0), np.count_nonzero(steps > 0.0)))
        if 0 < back <= _FEW_BACK * steps.size:
            raise InputError(
                f"coordinates of a profile (m) must run one way, but {back} of {steps.size} steps turn back: "
                "an overhang has several heights at one place. Remove those points, or rotate the trace."
            )
        order = np.argsort(place, kind="stable")
        place, values = place[order], values[order]
        steps = np.diff(place)
        if not steps.min() > 1e-9 * (place[-1] - place[0]):
            at = int(np.argmin(steps))
            raise InputError(
                f"coordinates of a profile (m) must differ, but two points stand at {place[at]:.6g} m. Leave one out."
            )
        n = place.size
        even = (place[-1] - place[0]) / (n - 1)
        if np.abs(place - place[0] - even * np.arange(n)).max() <= _UNEVEN * even:
            return cls(values, even, **more)
        spacing, coarsest = float(np.median(steps)), float(steps.max())
        count = 1 + int((place[-1] - place[0]) / spacing * (1.0 + 1e-12))
        at = place[0] + spacing * np.arange(count)
        after = np.clip(np.searchsorted(place, at, side="right"), 1, n - 1)
        share = np.clip((at - place[after - 1]) / (place[after] - place[after - 1]), 0.0, 1.0)
        mixed = (1.0 - share) * values[after - 1] + share * values[after]
        found = cls(mixed, spacing, **{**more, "short_cutoff": max(coarsest, more.get("short_cutoff", 0.0))})
        return found.with_heights(
            found.heights,
            f"interpolated linearly from {n} uneven points to the median spacing {show(spacing, 'm')}, coarsest "
            f"{show(coarsest, 'm')}",
        )

    @property
    def n_points(self) -> int:
        """Number of points n."""
        return int(self.heights.size)

    @property
    def length(self) -> float:
        """n Δ in m."""
        return self.n_points * self.spacing

    @property
    def x(self) -> RealArray:
        """Coordinates (n,) in m of the points from the first."""
        return np.arange(self.n_points) * self.spacing

    @property
    def n_missing(self) -> int:
        """Number of missing points."""
        return int(np.count_nonzero(self.mask))

    @property
    def valid(self) -> RealArray:
        """Heights in m of the points that are not missing, in their order."""
        return self.heights[~self.mask].astype(np.float64, copy=False)

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers behind the reader or generator and the preparation."""
        return self.origin.citation_keys

    @property
    def grid(self) -> NoReturn:
        """None: a line scan has no area.

        Raises InputError with what to do instead.
        """
        raise no_area()

    @property
    def size(self) -> NoReturn:
        """None: a line scan has no area, but a ``length``.

        Raises InputError with what to do instead.
        """
        raise no_area()

    def with_heights(self, heights: ArrayLike, step: str, citation_keys: tuple[str, ...] = ()) -> Profile:
        """Profile at the same points with other ``heights`` (n,) in m; ``step`` is added to the
        history."""
        return self.changed(step, citation_keys, heights=heights)

    def changed(self, step: str, citation_keys: tuple[str, ...] = (), **fields: Any) -> Profile:
        """Profile with other ``fields``; ``step`` is added to the history. The mask follows from
        the heights."""
        known = {
            name: getattr(self, name)
            for name in ("heights", "spacing", "periodic", "lay_angle", "instrument", "short_cutoff")
        }
        return Profile(**{**known, **fields}, origin=self.origin.continued(step, citation_keys))

    def across_lay(self) -> Profile:
        """Profile as a trace across a unidirectional lay would show it: lengths times cos φ.

        Raises InputError if the angle to the lay is not known.
        """
        if math.isnan(self.lay_angle):
            raise InputError(
                "profile must have its angle to the lay (rad) to be turned across it, but has none. Give lay_angle."
            )
        if self.lay_angle == 0.0:
            return self
        shorter, lost = math.cos(self.lay_angle), f"{math.degrees(self.lay_angle):.4g}°"
        step = f"turned across the lay: lengths times {shorter:.5g}, the trace lay {lost} off its normal"
        return self.changed(
            step, spacing=self.spacing * shorter, short_cutoff=self.short_cutoff * shorter, lay_angle=0.0
        )

    def of_instrument(self, **known: Any) -> Profile:
        """Profile with other fields ``known`` of its instrument, such as ``tip_radius=2e-6``."""
        made = replace(self.instrument, **known)
        return self.changed(
            f"instrument: {', '.join(f'{key} {value}' for key, value in known.items())}", instrument=made
        )

    def in_words(self) -> tuple[str, list[tuple[str, str]]]:
        """Heading and main numbers."""
        rows = [("points", f"{self.n_points}, {show(self.spacing, 'm')} apart"), ("length", show(self.length, "m"))]
        if self.origin.source:
            rows.insert(0, ("source", self.origin.source))
        if self.n_missing:
            rows.append(("missing points", f"{self.n_missing} ({percent(self.n_missing / self.n_points)})"))
        if self.short_cutoff > 0.0:
            rows.append(("short cut-off", show(self.short_cutoff, "m")))
        if self.instrument.kind:
            rows.append(("instrument", self.instrument.kind))
        if not math.isnan(self.lay_angle):
            rows.append(("angle to the normal of the lay", f"{math.degrees(self.lay_angle):.4g}°"))
        return "Line scan", rows


def no_area() -> InputError:
    """What is raised where an area is needed of a line scan."""
    return InputError(
        "surface must be a map for what needs an area, but is a line scan. For its own numbers call "
        "asperity.roughness.characterise_profile(profile), for grooves without end give "
        "asperity.surfaces.strip(profile), and for an isotropic surface make "
        "asperity.generate.surface_of_profile(profile, grid, seed=1).",
        subject="surface",
    )


def _checked(heights: ArrayLike, mask: ArrayLike | None) -> tuple[RealArray, BoolArray]:
    """Heights and mask of a profile, which cannot be written to."""
    given = np.asarray(heights)
    if given.ndim != 1:
        raise InputError(
            f"profile heights (m) must be an array of one dimension, but have the shape {given.shape}. "
            "A map is a Surface; take a row or column of it."
        )
    values: RealArray = np.array(require.field(given[:, None], "profile heights (m)"))[:, 0]
    missing, highest = missing_points(values, mask, "profile")
    if highest > LEAST:
        require.magnitude(highest, "largest height of a profile (m)")
    values.flags.writeable = False
    missing.flags.writeable = False
    return values, missing


def missing_points(values: RealArray, mask: ArrayLike | None, kind: str) -> tuple[BoolArray, float]:
    """Where the heights ``values`` of a ``kind`` of surface are missing, by themselves or by the
    ``mask``, which are set to NaN there; and the highest of the others (m).

    InputError if the mask has another shape, a height is infinite, or all are missing.
    """
    missing = np.isnan(values)
    if mask is not None:
        given = np.asarray(mask, dtype=bool)
        if given.shape != values.shape:
            raise InputError(f"{kind} mask must have the shape of the heights {values.shape}, but has {given.shape}.")
        missing |= given
    if np.isinf(values).any():
        raise InputError(f"{kind} heights must be finite or NaN (missing), but hold infinities. Mask those points.")
    if missing.all():
        raise InputError(f"{kind} heights must hold at least one valid point, but every point is missing.")
    values[missing] = np.nan
    return missing, float(np.nanmax(np.abs(values)))
