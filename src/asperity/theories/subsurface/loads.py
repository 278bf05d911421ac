"""Stresses below forces at a point, along a line and over a strip."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.parameters import Help
from ...core.tensor import Displacement, ElasticFields, StressTensor
from ...core.values import Length, Number, Pressure
from ..ask import ALONG_X, ALONG_Y, DEPTH, FIELDS, FieldAnswer, Way, places
from ..protocol import PoissonOfSolid, Theory

# Point forces on the surface of a half-space (Boussinesq 1885; Cerruti 1882; Johnson 1985, ch. 3).


def boussinesq(x: RealArray, y: RealArray, z: RealArray | float, *, shear: float, nu: float) -> ElasticFields:
    """Displacement (m/N) and stress (Pa/N) of a unit normal force at the origin, pushing along +z
    into the body.

    ``x``, ``y``, ``z``: field points in m, broadcast against each other, z >= 0; singular at the
    origin; ``shear``, ``nu``: shear modulus G in Pa and Poisson's ratio, up to 0.5.
    """
    x, y, z = np.broadcast_arrays(x, y, z)
    r = np.sqrt(x**2 + y**2 + z**2)
    k, s = 1.0 - 2.0 * nu, r + z
    radial = z / r**3 - k / (r * s)
    displacement = Displacement(x * radial, y * radial, z**2 / r**3 + 2.0 * (1.0 - nu) / r)
    bend = k * (2.0 * r + z) / (r**3 * s**2) - 3.0 * z / r**5
    common = k * (z / r**3 - 1.0 / (r * s))
    stress = StressTensor(
        xx=x**2 * bend + common,
        yy=y**2 * bend + common,
        zz=-3.0 * z**3 / r**5,
        xy=x * y * bend,
        xz=-3.0 * x * z**2 / r**5,
        yz=-3.0 * y * z**2 / r**5,
    )
    return ElasticFields(displacement * (0.25 / (np.pi * shear)), stress * (0.5 / np.pi))


def cerruti(x: RealArray, y: RealArray, z: RealArray | float, *, shear: float, nu: float) -> ElasticFields:
    """Displacement (m/N) and stress (Pa/N) of a unit tangential force at the origin along +x.

    Parameters and units as for ``boussinesq``; the force along +y follows by ``exchanged``
    coordinates and fields.
    """
    x, y, z = np.broadcast_arrays(x, y, z)
    r = np.sqrt(x**2 + y**2 + z**2)
    k, s = 1.0 - 2.0 * nu, r + z
    displacement = Displacement(
        1.0 / r + x**2 / r**3 + k * (1.0 / s - x**2 / (r * s**2)),
        x * y / r**3 - k * x * y / (r * s**2),
        x * z / r**3 + k * x / (r * s),
    )
    bend = k * (3.0 * r + z) / (r**3 * s**3) - 3.0 / r**5
    turn = k / (r * s**2)
    stress = StressTensor(
        xx=x**3 * bend + k * x / r**3 - 3.0 * x * turn,
        yy=x * y**2 * bend + k * x / r**3 - x * turn,
        zz=-3.0 * x * z**2 / r**5,
        xy=x**2 * y * bend - y * turn,
        xz=-3.0 * x**2 * z / r**5,
        yz=-3.0 * x * y * z / r**5,
    )
    return ElasticFields(displacement * (0.25 / (np.pi * shear)), stress * (0.5 / np.pi))


# Line forces and uniform strips on a half-space in plane strain (Flamant 1892; Johnson 1985, ch.
# 2).
#
# Displacements are defined up to a constant; here surface displacements along the force are
# multiples of ln r.


def flamant_normal(x: RealArray, z: RealArray | float, *, shear: float, nu: float) -> ElasticFields:
    """Displacement and stress per unit normal force per length (N/m) along +z on the line x =
    z = 0.

    ``x``, ``z``: field points in m, broadcast against each other, z >= 0; singular at the origin;
    ``shear``, ``nu``: Shear modulus G in Pa and Poisson's ratio, up to 0.5.
    """
    x, z = np.broadcast_arrays(x, z)
    r2 = x**2 + z**2
    theta = np.arctan2(x, z)
    u = Displacement(-(1.0 - 2.0 * nu) * theta + x * z / r2, 0.0 * x, -(1.0 - nu) * np.log(r2) + z**2 / r2)
    k = -2.0 / (np.pi * r2**2)
    return ElasticFields(u * (0.5 / (np.pi * shear)), _plane_strain(k * x**2 * z, k * z**3, k * x * z**2, nu))


def flamant_tangential(x: RealArray, z: RealArray | float, *, shear: float, nu: float) -> ElasticFields:
    """Displacement and stress per unit tangential force per length (N/m) along +x on the line x =
    z = 0.

    Parameters and units as for ``flamant_normal``.
    """
    x, z = np.broadcast_arrays(x, z)
    r2 = x**2 + z**2
    theta = np.arctan2(x, z)
    u = Displacement(-(1.0 - nu) * np.log(r2) - z**2 / r2, 0.0 * x, (1.0 - 2.0 * nu) * theta + x * z / r2)
    k = -2.0 / (np.pi * r2**2)
    return ElasticFields(u * (0.5 / (np.pi * shear)), _plane_strain(k * x**3, k * x * z**2, k * x**2 * z, nu))


def flamant_out_of_plane(x: RealArray, z: RealArray | float, *, shear: float, nu: float) -> ElasticFields:
    """Displacement and stress per unit force per length (N/m) along +y on the line x = z = 0
    (antiplane strain).

    u_y = -ln(r)/πG, whatever Poisson's ratio ``nu``. Parameters and units as for
    ``flamant_normal``.
    """
    x, z = np.broadcast_arrays(x, z)
    r2, zero = x**2 + z**2, 0.0 * x * nu
    stress = StressTensor(zero, zero, zero, xy=-x / (np.pi * r2), xz=zero, yz=-z / (np.pi * r2))
    return ElasticFields(Displacement(zero, -0.5 * np.log(r2) / (np.pi * shear), zero), stress)


def strip_pressure(x: RealArray, z: RealArray | float, half_width: float, *, shear: float, nu: float) -> ElasticFields:
    """Displacement (m/Pa) and stress under unit pressure on |x| < half_width (m); elsewhere as
    ``flamant_normal``.

    At z = 0 the edges get the mean of both sides.
    """
    ends = [_end(x, z, half_width), _end(x, z, -half_width)]
    fields = []
    for X, z_, angle, log, r2 in ends:
        u = Displacement(
            -(1.0 - 2.0 * nu) * (X * angle - 0.5 * z_ * log) + 0.5 * z_ * log,
            0.0 * X,
            -(1.0 - nu) * (X * log - 2.0 * X + 2.0 * z_ * angle) + z_ * angle,
        )
        twist = z_ * X / r2
        s = _plane_strain((twist - angle) / np.pi, -(twist + angle) / np.pi, z_**2 / r2 / np.pi, nu)
        fields.append(ElasticFields(u * (0.5 / (np.pi * shear)), s))
    return fields[0] + fields[1] * -1.0


def strip_shear(x: RealArray, z: RealArray | float, half_width: float, *, shear: float, nu: float) -> ElasticFields:
    """Displacement (m/Pa) and stress under unit shear traction along +x on |x| < half_width (m).

    As ``strip_pressure``; the stress xx is logarithmically infinite at the edges of the surface.
    """
    ends = [_end(x, z, half_width), _end(x, z, -half_width)]
    fields = []
    for X, z_, angle, log, r2 in ends:
        u = Displacement(
            -(1.0 - nu) * (X * log - 2.0 * X + 2.0 * z_ * angle) - z_ * angle,
            0.0 * X,
            (1.0 - 2.0 * nu) * (X * angle - 0.5 * z_ * log) + 0.5 * z_ * log,
        )
        dip = z_**2 / r2
        s = _plane_strain(-(log + dip) / np.pi, dip / np.pi, (z_ * X / r2 - angle) / np.pi, nu)
        fields.append(ElasticFields(u * (0.5 / (np.pi * shear)), s))
    return fields[0] + fields[1] * -1.0


def strip_out_of_plane(
    x: RealArray, z: RealArray | float, half_width: float, *, shear: float, nu: float
) -> ElasticFields:
    """Displacement (m/Pa) and stress under unit shear traction along +y on |x| < half_width (m);
    see ``strip_pressure``.
    """
    fields = []
    for X, z_, angle, log, _ in (_end(x, z, half_width), _end(x, z, -half_width)):
        zero = 0.0 * X * nu
        u = Displacement(zero, (X - 0.5 * X * log - z_ * angle) / (np.pi * shear), zero)
        s = StressTensor(zero, zero, zero, xy=-0.5 * log / np.pi, xz=zero, yz=-angle / np.pi)
        fields.append(ElasticFields(u, s))
    return fields[0] + fields[1] * -1.0


def _end(x: RealArray, z: RealArray | float, shift: float) -> tuple[RealArray, ...]:
    """X = x + shift, z, arctan(X/z), ln(X² + z²) and X² + z², kept finite at the end of the
    strip."""
    X, z = np.broadcast_arrays(x + shift, z)
    r2 = np.maximum(X**2 + z**2, 1e-290)
    return X, z, np.arctan2(X, z), np.log(r2), r2


def _plane_strain(xx: RealArray, zz: RealArray, xz: RealArray, nu: float) -> StressTensor:
    return StressTensor(xx=xx, yy=nu * (xx + zz), zz=zz, xy=0.0 * xx, xz=xz, yz=0.0 * xx)


# Theories of the catalogue: point and line forces and strips (Johnson 1985, ch. 2 and 3).


ShearModulus: TypeAlias = Annotated[Pressure, Help("shear modulus", of="bodies")]
PoissonsRatio: TypeAlias = Annotated[PoissonOfSolid, Help("Poisson's ratio", of="bodies")]

SPACE: tuple[Way, ...] = (Way(DEPTH, "at_depth", FIELDS, (ALONG_X, ALONG_Y)),)
PLANE: tuple[Way, ...] = (Way(DEPTH, "at_depth", FIELDS, (ALONG_X,)),)


@dataclass(frozen=True)
class Boussinesq(Theory):
    """A normal force at the origin of the surface, pushing into the body (Boussinesq 1885; Johnson
    1985, sec. 3.2).

    σ_z = -3 P z³/(2 π ρ⁵),  τ_(xz) = -3 P x z²/(2 π ρ⁵),
    u_z = (P/(4 π G)) [z²/ρ³ + 2 (1 - ν)/ρ],  ρ² = x² + y² + z².
    """

    load: Annotated[float, Number("force"), Help("force", of="bodies")]
    shear: ShearModulus
    nu: PoissonsRatio = 0.3
    name: ClassVar[str] = "boussinesq"
    title: ClassVar[str] = "Boussinesq, normal force at a point"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985",)
    ways: ClassVar[tuple[Way, ...]] = SPACE

    def at_depth(self, depth: ArrayLike, x: float = 0.0, y: float = 0.0) -> FieldAnswer:
        """Displacement and stress at ``depth`` (n,) in m below the point ``x``, ``y`` in m of the
        surface."""
        X, Y, Z = _away(depth, x, y)
        return _fields(boussinesq(X, Y, Z, shear=self.shear, nu=self.nu) * self.load)


@dataclass(frozen=True)
class Cerruti(Theory):
    """A tangential force along +x at the origin of the surface (Cerruti 1882; Johnson 1985, sec.
    3.6).

    σ_z = -3 Q x z²/(2 π ρ⁵),  τ_(xz) = -3 Q x² z/(2 π ρ⁵),
    u_z = (Q/(4 π G)) [x z/ρ³ + (1 - 2 ν) x/(ρ (ρ + z))],  ρ² = x² + y² + z².
    """

    tangential: Annotated[float, Number("force"), Help("force", of="bodies")]
    shear: ShearModulus
    nu: PoissonsRatio = 0.3
    name: ClassVar[str] = "cerruti"
    title: ClassVar[str] = "Cerruti, tangential force at a point"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985",)
    ways: ClassVar[tuple[Way, ...]] = SPACE

    def at_depth(self, depth: ArrayLike, x: float = 0.0, y: float = 0.0) -> FieldAnswer:
        """Displacement and stress at ``depth`` (n,) in m below the point ``x``, ``y`` in m of the
        surface."""
        X, Y, Z = _away(depth, x, y)
        return _fields(cerruti(X, Y, Z, shear=self.shear, nu=self.nu) * self.tangential)


@dataclass(frozen=True)
class Flamant(Theory):
    """Forces on the line x = 0 of the surface in plane strain (Flamant 1892; Johnson 1985, secs.
    2.2, 2.3).

    With the forces P along z and Q along x per length, and r² = x² + z²,

        σ_x = x² s,  σ_z = z² s,  τ_(xz) = x z s,  s = -2 (P z + Q x)/(π r⁴).

    Displacements are those up to a constant, see ``flamant_normal``.
    """

    normal: Annotated[float, Number("N/m"), Help("normal force per length", of="bodies")]
    shear: ShearModulus
    nu: PoissonsRatio = 0.3
    tangential: Annotated[float, Number("N/m"), Help("tangential force per length along x", of="bodies")] = 0.0
    name: ClassVar[str] = "flamant"
    title: ClassVar[str] = "Flamant, force on a line"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985",)
    ways: ClassVar[tuple[Way, ...]] = PLANE

    def at_depth(self, depth: ArrayLike, x: float = 0.0) -> FieldAnswer:
        """Displacement and stress at ``depth`` (n,) in m below the place ``x`` in m of the
        surface."""
        X, Z = _away(depth, x)
        pressed = flamant_normal(X, Z, shear=self.shear, nu=self.nu) * self.normal
        return _fields(pressed + flamant_tangential(X, Z, shear=self.shear, nu=self.nu) * self.tangential)


@dataclass(frozen=True)
class Strip(Theory):
    """Uniform pressure and shear traction on |x| < b of the surface in plane strain (Johnson 1985,
    sec. 2.5).

    With θ_1 and θ_2 = arctan((x ± b)/z) and r_1, r_2 the distances from the ends -b and b, under
    the pressure p and the shear traction q,

        σ_z = -(p/(2 π)) [2 (θ_1 - θ_2) + sin 2θ_1 - sin 2θ_2] + (q/π) (z²/r_1² - z²/r_2²),
        σ_x = -(p/(2 π)) [2 (θ_1 - θ_2) - sin 2θ_1 + sin 2θ_2] - (q/π) Λ,
        Λ = 2 ln(r_1/r_2) + z²/r_1² - z²/r_2².
    """

    half_width: Annotated[Length, Help("half the width of the strip b", of="bodies")]
    pressure: Annotated[float, Number("pressure"), Help("pressure", of="bodies")]
    shear: ShearModulus
    nu: PoissonsRatio = 0.3
    traction: Annotated[float, Number("pressure"), Help("shear traction along x", of="bodies")] = 0.0
    name: ClassVar[str] = "strip"
    title: ClassVar[str] = "Uniform traction on a strip"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985",)
    ways: ClassVar[tuple[Way, ...]] = PLANE

    def at_depth(self, depth: ArrayLike, x: float = 0.0) -> FieldAnswer:
        """Displacement and stress at ``depth`` (n,) in m below the place ``x`` in m of the
        surface."""
        X, Z = places(depth, x)
        pressed = strip_pressure(X, Z, self.half_width, shear=self.shear, nu=self.nu) * self.pressure
        return _fields(pressed + strip_shear(X, Z, self.half_width, shear=self.shear, nu=self.nu) * self.traction)


def _away(depth: ArrayLike, *beside: float) -> tuple[RealArray, ...]:
    """Places off the force itself."""
    found = places(depth, *beside)
    if np.any(np.sum(np.square(found), axis=0) == 0.0):
        raise InputError(
            "depth (m) must be greater than zero below the force, but is 0: fields are infinite at a force."
        )
    return found


def _fields(found: ElasticFields) -> FieldAnswer:
    return FieldAnswer(found.stress, found.displacement)
