"""Stresses below Hertz's contacts, pressed and sliding, as theories of their own: point, line and ellipse."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from .fields import ALONG_X, ALONG_Y, DEPTH, STRESS, StressAnswer
from .hertz import HertzPoint
from .hertz_ellipse import HertzEllipse
from .hertz_ellipse_stress import hertz_ellipse_normal
from .hertz_fields import hertz_normal, hertz_shear
from .hertz_line import HertzLine
from .hertz_line_fields import hertz_line_normal, hertz_line_shear
from .protocol import E_STAR, Input
from .single_contact import checked, poissons_ratio
from .ways import Way, asked

NU = Input("nu", "", "Poisson's ratio of the body", of="bodies", default=0.3)
FRICTION = Input("friction", "", "friction coefficient; the counter-body moves toward +x", of="bodies", default=0.0)
LOAD = asked("load", "N", "normal force")
SOME_SHEAR = 1.0
"""Shear modulus in Pa of the fields; stresses under a given traction do not depend on it."""


@dataclass(frozen=True)
class HertzStress:
    """Stresses below a sphere that is pressed, and slides with the traction μp (Hamilton 1983; Johnson 1985, secs. 3.4, 7.1).

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    radius
        Relative radius of curvature R in m, > 0.
    nu
        Poisson's ratio, 0 to 0.5.
    friction
        Friction coefficient μ, >= 0.
    """

    E_star: float
    radius: float
    nu: float = 0.3
    friction: float = 0.0
    name: ClassVar[str] = "hertz-stress"
    title: ClassVar[str] = "Hertz, stresses below a sphere"
    citation_keys: ClassVar[tuple[str, ...]] = ("Hamilton1983", "Hertz1882", "Johnson1985")
    inputs: ClassVar[tuple[Input, ...]] = (*HertzPoint.inputs, NU, FRICTION)
    ways: ClassVar[tuple[Way, ...]] = (Way(DEPTH, "at_depth", STRESS, (LOAD, ALONG_X, ALONG_Y)),)

    def __post_init__(self) -> None:
        HertzPoint(self.E_star, self.radius)
        _check(self.nu, self.friction)

    def at_depth(self, depth: ArrayLike, load: float, x: float = 0.0, y: float = 0.0) -> StressAnswer:
        """Stress at ``depth`` (n,) in m below the point ``x``, ``y`` in m of the surface under ``load`` in N, > 0."""
        z = checked(depth, "depth (m)")
        contact = HertzPoint(self.E_star, self.radius).at_load(require.positive(load, "load (N)"))
        a, peak = float(contact.radius), float(contact.max_pressure)
        places = (x + 0.0 * z, y + 0.0 * z, z, a)
        pressed = hertz_normal(*places, shear=SOME_SHEAR, nu=self.nu).stress
        dragged = hertz_shear(*places, shear=SOME_SHEAR, nu=self.nu).stress
        return StressAnswer((pressed + dragged * self.friction) * peak)


@dataclass(frozen=True)
class HertzLineStress:
    """Stresses below a cylinder in plane strain that is pressed and slides (McEwen 1949; Johnson 1985, secs. 4.2c, 7.1).

    Parameters as for ``HertzStress``.
    """

    E_star: float
    radius: float
    nu: float = 0.3
    friction: float = 0.0
    name: ClassVar[str] = "hertz-line-stress"
    title: ClassVar[str] = "Hertz, stresses below a cylinder"
    citation_keys: ClassVar[tuple[str, ...]] = ("Hertz1882", "Johnson1985", "McEwen1949")
    inputs: ClassVar[tuple[Input, ...]] = (*HertzLine.inputs, NU, FRICTION)
    ways: ClassVar[tuple[Way, ...]] = (
        Way(DEPTH, "at_depth", STRESS, (asked("load", "N/m", "normal force per length"), ALONG_X)),
    )

    def __post_init__(self) -> None:
        HertzLine(self.E_star, self.radius)
        _check(self.nu, self.friction)

    def at_depth(self, depth: ArrayLike, load: float, x: float = 0.0) -> StressAnswer:
        """Stress at ``depth`` (n,) in m below the place ``x`` in m of the surface under ``load`` in N/m, > 0."""
        z = checked(depth, "depth (m)")
        contact = HertzLine(self.E_star, self.radius).at_load(require.positive(load, "load per length (N/m)"))
        places = (x + 0.0 * z, z, float(contact.radius))
        pressed = hertz_line_normal(*places, shear=SOME_SHEAR, nu=self.nu).stress
        dragged = hertz_line_shear(*places, shear=SOME_SHEAR, nu=self.nu).stress
        return StressAnswer((pressed + dragged * self.friction) * float(contact.max_pressure))


@dataclass(frozen=True)
class HertzEllipseStress:
    """Stresses below an elliptical contact (Johnson 1985, sec. 3.5).

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    radius_x, radius_y
        Relative radii of curvature in m, > 0.
    nu
        Poisson's ratio, 0 to 0.5.
    """

    E_star: float
    radius_x: float
    radius_y: float
    nu: float = 0.3
    name: ClassVar[str] = "hertz-ellipse-stress"
    title: ClassVar[str] = "Hertz, stresses below an ellipse"
    citation_keys: ClassVar[tuple[str, ...]] = ("Hertz1882", "Johnson1985")
    inputs: ClassVar[tuple[Input, ...]] = (E_STAR, *HertzEllipse.inputs[1:3], NU)
    ways: ClassVar[tuple[Way, ...]] = (Way(DEPTH, "at_depth", STRESS, (LOAD, ALONG_X, ALONG_Y)),)

    def __post_init__(self) -> None:
        HertzEllipse(self.E_star, self.radius_x, self.radius_y)
        _check(self.nu, 0.0)

    def at_depth(self, depth: ArrayLike, load: float, x: float = 0.0, y: float = 0.0) -> StressAnswer:
        """Stress at ``depth`` (n,) in m below the point ``x``, ``y`` in m of the surface under ``load`` in N, > 0."""
        z = checked(depth, "depth (m)")
        contact = HertzEllipse(self.E_star, self.radius_x, self.radius_y)
        first, second = (float(np.squeeze(axis)) for axis in contact.semi_axes(require.positive(load, "load (N)")))
        peak = float(contact.at_load(load).max_pressure)
        found = hertz_ellipse_normal(x + 0.0 * z, y + 0.0 * z, z, (first, second), nu=self.nu)
        return StressAnswer(found * peak)


def _check(nu: float, friction: float) -> None:
    poissons_ratio(nu)
    require.not_negative(friction, "friction coefficient")
