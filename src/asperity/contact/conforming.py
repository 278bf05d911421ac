"""Conforming contact: a cylinder in a bore and a sphere in a socket of nearly the same radius,
elastic or rigid, by the modes of the circle and the sphere."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ..core import require
from ..core.arrays import BoolArray, RealArray
from ..core.errors import ConvergenceError, InputError
from ..core.quadrature import rule
from ..core.quantity import measured
from ..solids.elastic import Elastic, Rigid

Solid: TypeAlias = Elastic | Rigid

MOST_POINTS = 4096
"""Largest number of points: the matrix is dense, 128 MiB."""

MOST_SETS = 200
"""How often the set of touching points may change; 4 to 15 are usual."""


@dataclass(frozen=True, eq=False)
class ConformingContact:
    """A body pressed into a hole of nearly its radius.

    Attributes
    ----------
    angle
        Places of the points from the direction of the load, -π to π around a bore and 0 to π in a
        socket.
    pressure, gap
        At these places.
    load
        Force; per length in a bore.
    shift
        How far the centre moved, less what the displacement as cos θ adds, which depends on how
        the bodies are held.
    half_angle
        Half of the angle of contact, from the pressure near its edges, whose square is linear; π
        where all touches. With ``heights`` that of the outermost points that touch.
    """

    angle: RealArray = measured("rad", "angle from the direction of the load", "point")
    pressure: RealArray = measured("Pa", "contact pressure", "point")
    gap: RealArray = measured("m", "gap", "point")
    load: float = measured("N", "force, per length in a bore")
    shift: float = measured("m", "motion of the centre without what depends on the support")
    half_angle: float = measured("rad", "half of the angle of contact")

    @property
    def max_pressure(self) -> float:
        """Largest pressure in Pa at a point."""
        return float(self.pressure.max())


def cylinder_in_bore(
    cylinder: Solid,
    plate: Solid,
    radius: float,
    clearance: float,
    load: float,
    *,
    points: int = 1024,
    heights: RealArray | None = None,
) -> ConformingContact:
    """Press a cylinder into the bore of an infinite plate, in plane strain and without friction.

    The displacement along the radius under p cos nθ is that of Michell's functions, with
    κ = 3 - 4ν: R/4G (1/(n-1) + κ/(n+1)) for the cylinder and R/4G (κ/(n-1) + 1/(n+1)) for the
    plate; for n = 0 R (κ-1)/4G and R/2G; n = 1 moves the centre only. Short waves find half-planes.
    For equal materials it is Persson's (1964) solution, ``PinInHole``.

    Parameters
    ----------
    cylinder, plate
        ``Elastic`` or one of them ``Rigid()``.
    radius
        Of the bore in m, far larger than the clearance.
    clearance
        Difference of the radii in m, of either sign; < 0 is an interference.
    load
        In N/m, > 0, at the centre of the cylinder and far away in the plate.
    points
        Around the bore, even, 16 to 4096: the pressure at 1024 is within 3e-5 of that at 512 for
        contacts of more than 25° to each side.
    heights
        Roughness (points,) in m of both surfaces together, at -π + 2π i/points.

    Raises
    ------
    InputError
        If both bodies are rigid, or a number is out of its range.
    ConvergenceError
        If the set of touching points is not found.

    Examples
    --------
    >>> steel = Elastic(210e9, 0.3)
    >>> found = cylinder_in_bore(steel, steel, radius=5e-3, clearance=10e-6, load=1e6)
    >>> f"{np.degrees(found.half_angle):.1f}°, {found.max_pressure / 1e6:.0f} MPa"
    '48.2°, 167 MPa'
    """
    _check(cylinder, plate, radius, clearance, load)
    require.integer(points, 16, "points around the bore")
    if points % 2 or points > MOST_POINTS:
        raise InputError(f"points around the bore must be even and at most {MOST_POINTS}, but is {points}.")
    angle = 2.0 * np.pi / points * (np.arange(points) - points // 2)
    open_by = np.full(points, clearance)
    if heights is not None:
        if np.shape(heights) != (points,) or not np.all(np.isfinite(heights)):
            raise InputError(
                f"heights of the bore must be {points} finite numbers, but is an array of shape {np.shape(heights)}."
            )
        open_by = open_by - heights
    n = np.arange(points // 2 + 1.0)
    mode = bore_compliance(n, plate) + cylinder_compliance(n, cylinder)
    share = np.full(len(n), 2.0 / points)
    share[[0, -1]] = 1.0 / points
    row = (radius * mode * share) @ np.cos(n[:, None] * (angle - angle[0]))
    step = np.arange(points)
    matrix = row[(step[:, None] - step) % points]
    along = np.stack([np.cos(angle), np.sin(angle)])
    width = np.full(points, 2.0 * np.pi * radius / points)
    pressure, gap, moved = _touching(matrix, open_by, along, width, np.array([load, 0.0]))
    touching = np.abs(angle[pressure > 0.0])
    half_angle = float(touching.max()) if heights is not None else _edge(angle, pressure)
    return ConformingContact(angle, pressure, gap, load, float(moved[0]), half_angle)


def sphere_in_socket(
    sphere: Solid, socket: Solid, radius: float, clearance: float, load: float, *, points: int = 512
) -> ConformingContact:
    """Press a sphere into a spherical cavity of an infinite body, without friction.

    The displacement along the radius under p P_n(cos θ) follows from the solutions of the sphere
    by spherical harmonics (Lur'e 1964):

        R/4G (4 (1 - ν) n² + 2 ν n + 4 ν - 2)/((n - 1)(n² + n + 1 + (2 n + 1) ν))

    for the sphere, and minus the same with -n-1 in place of n for the cavity; n = 1 moves the
    centre only. Short waves find half-spaces, and ever smaller contacts are those of Hertz.

    Parameters
    ----------
    sphere, socket
        ``Elastic`` or one of them ``Rigid()``.
    radius, clearance
        Of the cavity, and the difference of the radii, in m, as for ``cylinder_in_bore``.
    load
        In N, > 0, at the centre of the sphere and far away in the body.
    points
        From pole to pole, 16 to 4096.

    Raises
    ------
    InputError
        If both bodies are rigid, or a number is out of its range.
    ConvergenceError
        If the set of touching points is not found.

    Examples
    --------
    >>> head, cup = Elastic(210e9, 0.3), Elastic(1e9, 0.4)
    >>> found = sphere_in_socket(head, cup, radius=14e-3, clearance=100e-6, load=2500.0)
    >>> f"{np.degrees(found.half_angle):.1f}°, {found.max_pressure / 1e6:.2f} MPa"
    '50.7°, 10.18 MPa'
    """
    _check(sphere, socket, radius, clearance, load)
    require.integer(points, 16, "points of the socket")
    if points > MOST_POINTS:
        raise InputError(f"points of the socket must be at most {MOST_POINTS}, but is {points}.")
    cosine, weight = rule(points)
    cosine, weight = cosine[::-1], weight[::-1]
    legendre = np.polynomial.legendre.legvander(cosine, points - 1)
    n = np.arange(points * 1.0)
    mode = socket_compliance(n, socket) + sphere_compliance(n, sphere)
    matrix = (legendre * (radius * mode * (n + 0.5))) @ (legendre.T * weight)
    area = 2.0 * np.pi * radius**2 * weight
    pressure, gap, moved = _touching(matrix, np.full(points, clearance), cosine[None], area, np.array([load]))
    angle = np.arccos(cosine)
    return ConformingContact(angle, pressure, gap, load, float(moved[0]), _edge(angle, pressure))


# Displacement along the radius R that opens the gap, over p R, under a pressure of the mode n.


def cylinder_compliance(n: RealArray, solid: Solid) -> RealArray:
    """Of a cylinder under p cos nθ, in 1/Pa for each ``n`` >= 0; 0 for n = 1."""
    if isinstance(solid, Rigid):
        return np.zeros_like(n)
    G, kappa = solid.shear_modulus, 3.0 - 4.0 * solid.poisson_ratio
    return np.where(n == 0.0, kappa - 1.0, _without_one(n, 1.0, kappa)) / (4.0 * G)


def bore_compliance(n: RealArray, solid: Solid) -> RealArray:
    """Of the bore of a plate, likewise."""
    if isinstance(solid, Rigid):
        return np.zeros_like(n)
    G, kappa = solid.shear_modulus, 3.0 - 4.0 * solid.poisson_ratio
    return np.where(n == 0.0, 2.0, _without_one(n, kappa, 1.0)) / (4.0 * G)


def _without_one(n: RealArray, below: float, above: float) -> RealArray:
    """``below``/(n-1) + ``above``/(n+1), 0 where n < 2."""
    return np.where(n < 2.0, 0.0, below / np.maximum(n - 1.0, 1.0) + above / (n + 1.0))


def sphere_compliance(n: RealArray, solid: Solid) -> RealArray:
    """Of a sphere under p P_n(cos θ), in 1/Pa for each ``n`` >= 0; 0 for n = 1."""
    return np.where(n == 1.0, 0.0, _harmonic(np.where(n == 1.0, 2.0, n), solid))


def socket_compliance(n: RealArray, solid: Solid) -> RealArray:
    """Of a spherical cavity, likewise."""
    return np.where(n == 1.0, 0.0, -_harmonic(-n - 1.0, solid))


def _harmonic(n: RealArray, solid: Solid) -> RealArray:
    """Displacement inwards of r = 1 under a pressure along r of degree ``n``, which is negative for
    fields that decay outwards."""
    if isinstance(solid, Rigid):
        return np.zeros_like(n)
    G, nu = solid.shear_modulus, solid.poisson_ratio
    above = 4.0 * (1.0 - nu) * n**2 + 2.0 * nu * n + 4.0 * nu - 2.0
    found: RealArray = above / (4.0 * G * (n - 1.0) * (n**2 + n + 1.0 + (2.0 * n + 1.0) * nu))
    return found


# The contact.


def _check(inner: Solid, outer: Solid, radius: float, clearance: float, load: float) -> None:
    """Refuse what is no conforming contact."""
    for body, what in ((inner, "body in the hole"), (outer, "body with the hole")):
        if not isinstance(body, Elastic | Rigid):
            raise InputError(f"{what} must be Elastic(...) or Rigid(), but is {body!r}.")
    if isinstance(inner, Rigid) and isinstance(outer, Rigid):
        raise InputError("body in the hole must be Elastic(...) where that with the hole is rigid, but is Rigid().")
    require.magnitude(radius, "radius of the hole (m)")
    if abs(require.finite(clearance, "clearance (m)")) >= 0.1 * radius:
        raise InputError(
            f"clearance (m) must be less than a tenth of the radius, {radius:g} m, but is {clearance:g} m."
        )
    require.positive(load, "load of the conforming contact")


def _touching(
    matrix: RealArray, open_by: RealArray, along: RealArray, weight: RealArray, load: RealArray
) -> tuple[RealArray, RealArray, RealArray]:
    """Pressure >= 0 and gap >= 0, one of which is zero at each point, and the motion of the centre:
    gap = ``open_by`` - motion · ``along`` + ``matrix`` p, with the force Σ along weight p = load.

    Primal-dual active set (Hintermüller, Ito and Kunisch 2002); where a set comes again, points
    change one at a time.
    """
    touching: BoolArray = along[0] > 0.5
    seen: set[bytes] = set()
    for _ in range(MOST_SETS):
        pressure, moved = _on_set(matrix, open_by, along, weight, load, touching)
        gap = open_by - moved @ along + matrix @ pressure
        gap[touching] = 0.0
        small_p, small_g = 1e-12 * np.abs(pressure).max(), 1e-12 * max(np.abs(moved).max(), np.abs(open_by).max())
        leaves, joins = touching & (pressure < -small_p), ~touching & (gap < -small_g)
        if not (leaves.any() or joins.any()):
            return np.maximum(pressure, 0.0), np.maximum(gap, 0.0), moved
        if touching.tobytes() in seen:
            worst = np.where(leaves, -pressure / np.abs(pressure).max(), 0.0)
            worst += np.where(joins, -gap / np.abs(gap).max(), 0.0)
            leaves, joins = (side & (worst == worst.max()) for side in (leaves, joins))
        seen.add(touching.tobytes())
        touching = (touching & ~leaves) | joins
    raise ConvergenceError(
        "The touching points of the conforming contact are not found. Take other numbers of points, or smooth heights."
    )


def _on_set(
    matrix: RealArray, open_by: RealArray, along: RealArray, weight: RealArray, load: RealArray, touching: BoolArray
) -> tuple[RealArray, RealArray]:
    """Pressure that closes the gap of the ``touching`` points, and the motion of the centre."""
    count, held = int(touching.sum()), len(load)
    whole = np.zeros((count + held, count + held))
    scale = np.abs(np.diagonal(matrix)).mean()
    whole[:count, :count] = matrix[np.ix_(touching, touching)] / scale
    whole[:count, count:] = -along[:, touching].T
    whole[count:, :count] = (along * weight)[:, touching] / weight.mean()
    right = np.concatenate([-open_by[touching], load * scale / weight.mean()])
    try:
        found = np.linalg.solve(whole, right)
    except np.linalg.LinAlgError as error:
        raise ConvergenceError("The conforming contact has too few touching points: give more points.") from error
    pressure = np.zeros(len(open_by))
    pressure[touching] = found[:count] / scale
    return pressure, found[count:]


def _edge(angle: RealArray, pressure: RealArray) -> float:
    """Where the square of the pressure comes to zero on the side of positive angles."""
    if np.all(pressure > 0.0):
        return float(np.pi)
    side = angle >= 0.0
    at, square = angle[side], pressure[side] ** 2
    last = int(np.argmin(square > 0.0)) - 1
    if last < 2:
        return float(at[max(last, 0)])
    slope = (square[last - 2] - square[last - 1]) / (at[last - 1] - at[last - 2])
    beyond = square[last - 1] / slope if slope > 0.0 else 0.0
    return float(np.clip(at[last - 1] + beyond, at[last], at[last + 1]))
