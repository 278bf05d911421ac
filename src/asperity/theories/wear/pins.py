"""Pins and balls on disks: caps that are worn flat, and tracks that they wear."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import Length
from ..ask import Way, asked
from ..protocol import Bound, Theory, bisected, checked
from .laws import DISTANCE, AnyWearCoefficient, Load

CapRadius: TypeAlias = Annotated[Length, "radius R of the spherical end of the pin, or of the ball"]


_HALVINGS = 80
"""To 1e-24 of a radius or an angle, for thin caps and narrow tracks."""


def cap_depth(volume: RealArray, radius: float) -> RealArray:
    """Height in m of a cap of the ``volume`` in m³, at most half of the sphere of ``radius``.

    InputError if there is more volume.
    """
    half = 2.0 / 3.0 * math.pi * radius**3
    if (volume > half).any():
        raise InputError(
            f"worn volume of the pin (m³) must be at most that of half of a sphere, {half:g}, but is {volume.max():g}. "
            "Take a shorter sliding distance."
        )
    share = volume / half
    found = bisected(lambda u: 0.5 * u**2 * (3.0 - u) - share, np.zeros_like(share), np.ones_like(share), _HALVINGS)
    return np.asarray(np.where(volume > 0.0, radius * found, 0.0))


@dataclass(frozen=True, eq=False, repr=False)
class CapAnswer(Tabled):
    """Balls with some scar radii (m), arrays of one shape: ``depth`` of the cap in m and its
    ``volume`` in m³, ``approximate`` by π a⁴/4R."""

    scar_radius: RealArray
    depth: RealArray
    volume: RealArray
    approximate: RealArray


@dataclass(frozen=True, eq=False, repr=False)
class CoefficientAnswer(Tabled):
    """Wear coefficients in m²/N by the worn ``volume`` in m³ at some scar radii (m)."""

    scar_radius: RealArray
    volume: RealArray
    coefficient: RealArray


_SCAR = asked("scar_radius", "m", "radius a of the flat scar")


@dataclass(frozen=True)
class WornCap(Theory):
    """A ball, or a pin with a spherical end, with a flat scar of radius a:

        h = R - sqrt(R² - a²),  V = π h (3 a² + h²)/6 ≈ π a⁴/(4 R).

    The approximation is that of standards with the diameter of the scar, π d⁴/(64 R). It is low by
    a²/3R² of itself. The wear coefficient follows from the load and the sliding distance, k = V/(P
    s).

    Examples
    --------
    >>> ball = WornCap(3e-3)
    >>> answer = ball.at_scar(0.3e-3)
    >>> f"{answer.volume.item() * 1e9:.5f} mm³, {answer.approximate.item() * 1e9:.5f} mm³"
    '0.00213 mm³, 0.00212 mm³'
    >>> f"{ball.of_test(0.3e-3, load=10.0, distance=1000.0).coefficient.item():.2e} m²/N"
    '2.13e-16 m²/N'
    """

    radius: CapRadius
    name: ClassVar[str] = "worn-cap"
    title: ClassVar[str] = "Ball worn flat"
    citation_keys: ClassVar[tuple[str, ...]] = ("AstmG99", "Kauzlarich2001", "Archard1953")
    limits: ClassVar[tuple[Bound, ...]] = ()
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            _SCAR,
            "at_scar",
            (
                Quantity("depth", "m", "height of the worn cap"),
                Quantity("volume", "m^3", "worn volume"),
                Quantity("approximate", "m^3", "worn volume by π a⁴/4R"),
            ),
        ),
        Way(
            _SCAR,
            "of_test",
            (Quantity("volume", "m^3", "worn volume"), Quantity("coefficient", "m^2/N", "wear coefficient")),
            (asked("load", "N", "normal force"), asked("distance", "m", "sliding distance")),
        ),
    )

    def at_scar(self, scar_radius: ArrayLike) -> CapAnswer:
        """The cap with the ``scar_radius`` in m, from 0 to R, of any shape."""
        a = checked(scar_radius, "radius of the scar (m)")
        if (a > self.radius).any():
            raise InputError(
                f"radius of the scar (m) must be at most that of the ball, {self.radius:g}, but is {a.max():g}."
            )
        depth = a**2 / (self.radius + np.sqrt((self.radius - a) * (self.radius + a)))
        volume = math.pi * depth * (3.0 * a**2 + depth**2) / 6.0
        return CapAnswer(a, np.asarray(depth), np.asarray(volume), np.asarray(math.pi * a**4 / (4.0 * self.radius)))

    def of_test(self, scar_radius: ArrayLike, load: float, distance: float) -> CoefficientAnswer:
        """Wear coefficient by the ``scar_radius`` in m after the ``distance`` in m under the
        ``load`` in N, both > 0."""
        cap = self.at_scar(scar_radius)
        work = require.positive(load, "load (N)") * require.positive(distance, "sliding distance (m)")
        return CoefficientAnswer(cap.scar_radius, cap.volume, cap.volume / work)


def track_section(width: ArrayLike, radius: float) -> RealArray:
    """R² asin(w/2R) - (w/4) sqrt(4R² - w²) in m²: cross-section of a track of ``width`` w in m (any
    shape) that a sphere of ``radius`` R in m has worn."""
    w = checked(width, "width of the track (m)")
    if (w > 2.0 * radius).any():
        raise InputError(f"width of the track (m) must be at most {2.0 * radius:g}, but is {w.max():g}.")
    return _segment(np.arcsin(0.5 * w / radius), radius)


def _segment(angle: RealArray, radius: float) -> RealArray:
    """Section of a circle between a chord and its arc of twice the ``angle``: R² (φ - sin φ cos
    φ)."""
    double = 2.0 * angle
    small = double**3 * (1.0 - double**2 / 20.0 * (1.0 - double**2 / 42.0)) / 6.0
    return np.asarray(0.5 * radius**2 * np.where(double < 0.02, small, double - np.sin(double)))


def _angle(section: RealArray, radius: float) -> RealArray:
    """Half of the angle of the arc of a track of the ``section`` in m², at most half of a circle;
    InputError beyond."""
    half = 0.5 * math.pi * radius**2
    if (section > half).any():
        raise InputError(
            f"cross-section of the track (m²) must be at most half of a circle, {half:g}, but is {section.max():g}. "
            "Take a shorter sliding distance."
        )
    low, high = np.zeros_like(section), np.full_like(section, 0.5 * math.pi)
    found = bisected(lambda angle: _segment(angle, radius) - section, low, high, _HALVINGS)
    return np.asarray(np.where(section > 0.0, found, 0.0))


@dataclass(frozen=True, eq=False, repr=False)
class PinOnDiskAnswer(Tabled):
    """Pin and disk at some sliding distances (m), arrays of one shape: volumes in m³, lengths in
    m, shapes as beside a body that does not wear."""

    distance: RealArray
    pin_volume: RealArray
    pin_depth: RealArray
    scar_radius: RealArray
    disk_volume: RealArray
    track_depth: RealArray
    track_width: RealArray

    def other(self, depth: RealArray, beside: RealArray) -> RealArray:
        """``beside`` over ``depth``, (n,); zero where that is zero."""
        return np.divide(beside, depth, out=np.zeros_like(depth), where=depth > 0.0)


_FLAT_SCAR = Bound(
    "depth of the track over that of the scar",
    lambda theory, answer: answer.other(answer.pin_depth, answer.track_depth),
    0.0,
    0.1,
    "AstmG99",
    "The pin wears into a track that it has cut, and its scar is not flat.",
    ("pin_depth", "scar_radius"),
)
_ROUND_TRACK = Bound(
    "depth of the scar over that of the track",
    lambda theory, answer: answer.other(answer.track_depth, answer.pin_depth),
    0.0,
    0.1,
    "AstmG99",
    "The end of the pin is worn flat, and its track is wider and shallower.",
    ("track_depth", "track_width"),
)


@dataclass(frozen=True)
class PinOnDisk(Theory):
    """A pin with a spherical end on a disk: the pin is always in contact, a point of the track once
    a turn.

        V_p = k_p P s,  V_d = k_d P s

    With these volumes the end of the pin loses a cap, V_p = π h² (3R - h)/3, and the track of
    radius r_t gets the section of the pin, with its width w,

        V_d = 2 π r_t [R² arcsin(w/2R) - (w/4) sqrt(4R² - w²)] ≈ π r_t w³/(6 R).

    Each shape is that beside a body that does not wear.

    Examples
    --------
    >>> test = PinOnDisk(3e-3, 5.0, 10e-3, pin_coefficient=0.0, disk_coefficient=1e-15)
    >>> track = test.at_distance(1000.0)
    >>> f"{track.track_width.item() * 1e6:.0f} µm wide, {track.track_depth.item() * 1e6:.2f} µm"
    '142 µm wide, 0.84 µm'
    """

    radius: CapRadius
    load: Load
    track_radius: Annotated[Length, "radius r_t of the track on the disk"]
    pin_coefficient: Annotated[AnyWearCoefficient, Help("wear coefficient k_p of the pin", of="bodies")]
    disk_coefficient: Annotated[AnyWearCoefficient, Help("wear coefficient k_d of the disk", of="bodies")]
    name: ClassVar[str] = "pin-on-disk"
    title: ClassVar[str] = "Pin on disk"
    citation_keys: ClassVar[tuple[str, ...]] = ("AstmG99", "Archard1953")
    limits: ClassVar[tuple[Bound, ...]] = (_FLAT_SCAR, _ROUND_TRACK)
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            DISTANCE,
            "at_distance",
            (
                Quantity("pin_volume", "m^3", "worn volume of the pin"),
                Quantity("pin_depth", "m", "height of the worn cap of the pin"),
                Quantity("scar_radius", "m", "radius of the scar of the pin"),
                Quantity("disk_volume", "m^3", "worn volume of the disk"),
                Quantity("track_depth", "m", "depth of the track"),
                Quantity("track_width", "m", "width of the track"),
            ),
        ),
    )

    def at_distance(self, distance: ArrayLike) -> PinOnDiskAnswer:
        """Pin and disk after the sliding ``distance`` in m, >= 0, of any shape.

        InputError if more than half of a sphere or of a circle is worn.
        """
        s = checked(distance, "sliding distance (m)")
        pin, disk = self.pin_coefficient * self.load * s, self.disk_coefficient * self.load * s
        depth = cap_depth(pin, self.radius)
        angle = _angle(disk / (2.0 * math.pi * self.track_radius), self.radius)
        return PinOnDiskAnswer(
            s,
            pin,
            depth,
            np.sqrt(depth * (2.0 * self.radius - depth)),
            disk,
            2.0 * self.radius * np.sin(0.5 * angle) ** 2,
            2.0 * self.radius * np.sin(angle),
        )
