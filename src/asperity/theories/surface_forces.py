"""Forces on the surface of a half-space as theories of their own: at a point, on a line, on a strip (Johnson 1985, ch. 2 and 3)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.tensor import ElasticFields
from .fields import ALONG_X, ALONG_Y, DEPTH, FIELDS, FieldAnswer
from .line_loads import flamant_normal, flamant_tangential, strip_pressure, strip_shear
from .point_loads import boussinesq, cerruti
from .protocol import Input
from .single_contact import checked, poissons_ratio
from .ways import Way

SHEAR = Input("shear", "Pa", "shear modulus", of="bodies")
NU = Input("nu", "", "Poisson's ratio", of="bodies", default=0.3)
SPACE: tuple[Way, ...] = (Way(DEPTH, "at_depth", FIELDS, (ALONG_X, ALONG_Y)),)
PLANE: tuple[Way, ...] = (Way(DEPTH, "at_depth", FIELDS, (ALONG_X,)),)


@dataclass(frozen=True)
class Boussinesq:
    """A normal force at the origin of the surface, pushing into the body (Boussinesq 1885; Johnson 1985, sec. 3.2).

    Parameters
    ----------
    load
        Force in N.
    shear, nu
        Shear modulus in Pa, > 0, and Poisson's ratio, 0 to 0.5.
    """

    load: float
    shear: float
    nu: float = 0.3
    name: ClassVar[str] = "boussinesq"
    title: ClassVar[str] = "Boussinesq, normal force at a point"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985",)
    inputs: ClassVar[tuple[Input, ...]] = (Input("load", "N", "normal force", of="bodies"), SHEAR, NU)
    ways: ClassVar[tuple[Way, ...]] = SPACE

    def __post_init__(self) -> None:
        _check(self.load, self.shear, self.nu)

    def at_depth(self, depth: ArrayLike, x: float = 0.0, y: float = 0.0) -> FieldAnswer:
        """Displacement and stress at ``depth`` (n,) in m below the point ``x``, ``y`` in m of the surface."""
        z = _away(depth, x, y)
        return _fields(boussinesq(x + 0.0 * z, y + 0.0 * z, z, shear=self.shear, nu=self.nu) * self.load)


@dataclass(frozen=True)
class Cerruti:
    """A tangential force along +x at the origin of the surface (Cerruti 1882; Johnson 1985, sec. 3.6).

    Parameters
    ----------
    tangential
        Force in N.
    shear, nu
        Shear modulus in Pa, > 0, and Poisson's ratio, 0 to 0.5.
    """

    tangential: float
    shear: float
    nu: float = 0.3
    name: ClassVar[str] = "cerruti"
    title: ClassVar[str] = "Cerruti, tangential force at a point"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985",)
    inputs: ClassVar[tuple[Input, ...]] = (Input("tangential", "N", "tangential force", of="bodies"), SHEAR, NU)
    ways: ClassVar[tuple[Way, ...]] = SPACE

    def __post_init__(self) -> None:
        _check(self.tangential, self.shear, self.nu)

    def at_depth(self, depth: ArrayLike, x: float = 0.0, y: float = 0.0) -> FieldAnswer:
        """Displacement and stress at ``depth`` (n,) in m below the point ``x``, ``y`` in m of the surface."""
        z = _away(depth, x, y)
        return _fields(cerruti(x + 0.0 * z, y + 0.0 * z, z, shear=self.shear, nu=self.nu) * self.tangential)


@dataclass(frozen=True)
class Flamant:
    """Forces on the line x = 0 of the surface in plane strain (Flamant 1892; Johnson 1985, secs. 2.2, 2.3).

    Displacements are those up to a constant, see ``flamant_normal``.

    Parameters
    ----------
    normal, tangential
        Forces per length in N/m, along +z and +x.
    shear, nu
        Shear modulus in Pa, > 0, and Poisson's ratio, 0 to 0.5.
    """

    normal: float
    shear: float
    nu: float = 0.3
    tangential: float = 0.0
    name: ClassVar[str] = "flamant"
    title: ClassVar[str] = "Flamant, force on a line"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985",)
    inputs: ClassVar[tuple[Input, ...]] = (
        Input("normal", "N/m", "normal force per length", of="bodies"),
        SHEAR,
        NU,
        Input("tangential", "N/m", "tangential force per length along x", of="bodies", default=0.0),
    )
    ways: ClassVar[tuple[Way, ...]] = PLANE

    def __post_init__(self) -> None:
        _check(self.normal, self.shear, self.nu)
        require.finite(self.tangential, "tangential force per length (N/m)")

    def at_depth(self, depth: ArrayLike, x: float = 0.0) -> FieldAnswer:
        """Displacement and stress at ``depth`` (n,) in m below the place ``x`` in m of the surface."""
        z = _away(depth, x, 0.0)
        pressed = flamant_normal(x + 0.0 * z, z, shear=self.shear, nu=self.nu) * self.normal
        return _fields(pressed + flamant_tangential(x + 0.0 * z, z, shear=self.shear, nu=self.nu) * self.tangential)


@dataclass(frozen=True)
class Strip:
    """Uniform pressure and shear traction on |x| < b of the surface in plane strain (Johnson 1985, sec. 2.5).

    Parameters
    ----------
    half_width
        b in m, > 0.
    pressure, traction
        In Pa, along +z and +x.
    shear, nu
        Shear modulus in Pa, > 0, and Poisson's ratio, 0 to 0.5.
    """

    half_width: float
    pressure: float
    shear: float
    nu: float = 0.3
    traction: float = 0.0
    name: ClassVar[str] = "strip"
    title: ClassVar[str] = "Uniform traction on a strip"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985",)
    inputs: ClassVar[tuple[Input, ...]] = (
        Input("half_width", "m", "half the width of the strip", of="bodies"),
        Input("pressure", "Pa", "pressure", of="bodies"),
        SHEAR,
        NU,
        Input("traction", "Pa", "shear traction along x", of="bodies", default=0.0),
    )
    ways: ClassVar[tuple[Way, ...]] = PLANE

    def __post_init__(self) -> None:
        require.positive(self.half_width, "half-width of the strip (m)")
        _check(self.pressure, self.shear, self.nu)
        require.finite(self.traction, "shear traction (Pa)")

    def at_depth(self, depth: ArrayLike, x: float = 0.0) -> FieldAnswer:
        """Displacement and stress at ``depth`` (n,) in m below the place ``x`` in m of the surface."""
        z = checked(depth, "depth (m)")
        places = (x + 0.0 * z, z, self.half_width)
        pressed = strip_pressure(*places, shear=self.shear, nu=self.nu) * self.pressure
        return _fields(pressed + strip_shear(*places, shear=self.shear, nu=self.nu) * self.traction)


def _check(force: float, shear: float, nu: float) -> None:
    require.finite(force, "force or pressure")
    require.positive(shear, "shear modulus (Pa)")
    poissons_ratio(nu)


def _away(depth: ArrayLike, x: float, y: float) -> RealArray:
    """``depth`` as an array of places off the force itself."""
    z = checked(depth, "depth (m)")
    if np.any(np.hypot(np.hypot(x, y), z) == 0.0):
        raise InputError(
            "depth (m) must be greater than zero below the force, but is 0: fields are infinite at a force."
        )
    return z


def _fields(found: ElasticFields) -> FieldAnswer:
    return FieldAnswer(found.stress, found.displacement)
