"""The contact problem: surfaces, bodies, boundary and physics of the interface."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.citations import citation_keys
from ..core.errors import InputError
from ..core.grid import Grid
from ..core.late import Shown
from ..core.values import LEAST
from ..solids.compliance.halfspace import Compliance, contact_compliance
from ..solids.elastic import Elastic, Rigid
from ..solids.layers import Body, Layered, contact_modulus
from ..surfaces.pair import composite
from ..surfaces.surface import Surface
from .boundary import Boundary, FreeLine, Periodic
from .controls import Control, FixedGrips, Pull
from .laws import Adhesion, Coulomb, FrictionLaw, HardWall, InterfaceLaw, PlasticFlow
from .laws.plastic_flow import require_bodies
from .wetting import LiquidFilm


@dataclass(frozen=True)
class Flat:
    """A perfectly flat counter surface."""


CounterSurface: TypeAlias = Surface | Flat
"""Surface of the counter body."""


@dataclass(frozen=True, repr=False)
class ContactProblem(Shown):
    """Two bodies with their surfaces, pressed together.

    Parameters
    ----------
    surface
        Surface of ``body``, heights positive out of it. Missing points must have been filled.
    body
        The body under the surface: ``Elastic``, ``Layered`` or ``Rigid``.
    counter_surface
        Surface of the counter body on the same grid, heights positive out of *that* body and already laid in the
        lateral frame of ``surface`` (see ``composite`` for the mirror a measured map needs). Flat by default.
    counter_body
        The counter body; rigid by default. Only one of the two may be rigid.
    boundary
        ``Periodic()``, ``Free()``, or ``FreeLine()`` for a free line contact.
    law
        ``HardWall()`` (elastic), ``Hardness(H)`` or ``LayeredHardness(body)``.
    film
        Film of liquid whose menisci pull the surfaces together; None for a dry contact.
    friction
        ``Coulomb(mu)``, ``TrescaFriction(strength)`` or ``FullStick()``; None for none. Under Coulomb friction all points slide unless a
        step prescribes a ``Shift`` or ``TangentialForce``; under the others the counter body does not shift until then.
    adhesion
        Attraction of the surfaces, such as ``ExponentialAdhesion(0.05, 1e-9)``; None for none.
    plastic_flow
        Plastic flow in the volume of ``body``, or where that is rigid of the counter body: ``PlasticFlow(J2(...))``; None for none.

    Notes
    -----
    Only the sum of the two surfaces and the sum of the two compliances enter (Peng 2001, eq. 3.32 and app. D).

    Raises
    ------
    InputError
        If a surface has missing points, grids differ, both bodies are rigid, a hardness array has another shape,
        the grid does not suit the boundary, or a length or modulus is out of the range 1e-41 to 1e40.
    """

    surface: Surface
    body: Body
    counter_surface: CounterSurface = Flat()
    counter_body: Body = Rigid()
    boundary: Boundary = Periodic()
    law: InterfaceLaw = HardWall()
    film: LiquidFilm | None = None
    friction: FrictionLaw | None = None
    adhesion: Adhesion | None = None
    plastic_flow: PlasticFlow | None = None

    def __post_init__(self) -> None:
        _require(self.surface, Surface, "surface", "a Surface (see asperity.read and asperity.generate)")
        _require(self.counter_surface, Surface | Flat, "counter_surface", "a Surface or Flat()")
        _require(self.boundary, Boundary, "boundary", "Periodic(), Free() or FreeLine()")
        for body, what in ((self.body, "body"), (self.counter_body, "counter_body")):
            _require(body, Body, what, "Elastic(...), a named material, Layered(...) or Rigid()")
        _require(self.law, InterfaceLaw, "law", "HardWall() or Hardness(...)")
        _require(self.film, LiquidFilm | None, "film", "LiquidFilm.of(liquid, thickness) or None")
        _require(
            self.friction,
            FrictionLaw | None,
            "friction",
            "Coulomb(coefficient), TrescaFriction(strength), FullStick() or None",
        )
        self._check_adhesion()
        self._check_materials()
        self._check_plastic_flow()
        for spacing in self.grid.spacing:
            require.magnitude(spacing, "pixel size (m)")
        if isinstance(self.boundary, FreeLine):
            self.boundary.require_line(self.grid)
        for surface, what in ((self.surface, "surface"), (self.counter_surface, "counter_surface")):
            if isinstance(surface, Surface) and surface.n_missing:
                raise InputError(
                    f"{what} must have no missing points, but {surface.n_missing} are missing. "
                    "Fill them first: filled(surface), or --fill harmonic."
                )
            if isinstance(surface, Surface) and (extent := float(np.ptp(surface.heights))) > LEAST:
                require.magnitude(extent, "range of the heights (m)")  # a smaller one is rounding of a flat surface
        if isinstance(self.counter_surface, Surface):
            composite(self.surface, self.counter_surface)
        self._check_friction()
        cap = self.law.pressure_cap()
        if isinstance(cap, np.ndarray) and cap.shape != self.surface.shape:
            raise InputError(
                f"hardness array must have the shape {self.surface.shape} of the surface, but has {cap.shape}."
            )

    def _check_adhesion(self) -> None:
        _require(self.adhesion, Adhesion | None, "adhesion", "a law such as ExponentialAdhesion(work, range) or None")
        if self.adhesion is not None and self.adhesion.spacing > 0.0 and not isinstance(self.law, HardWall):
            raise InputError(
                f"law of a contact with the adhesion {self.adhesion.name} must be HardWall(), but is {self.law!r}: its core has no wall whose "
                "pressure a hardness could limit. Use ExponentialAdhesion(...) of the same work and strength."
            )

    def _check_plastic_flow(self) -> None:
        flow = self.plastic_flow
        _require(flow, PlasticFlow | None, "plastic_flow", "PlasticFlow(J2(...)) or None")
        if flow is None:
            return
        friction = None if isinstance(self.friction, Coulomb | None) else self.friction
        for found, what, remedy in (
            (
                self.law if not isinstance(self.law, HardWall) else None,
                "law",
                "A hardness is a model of the same flow.",
            ),
            (self.film, "film", "Solve the dry contact."),
            (self.adhesion, "adhesion", "Solve it without adhesion."),
            (friction, "friction", "Use Coulomb(coefficient), under which all points slide."),
            (self.boundary if isinstance(self.boundary, FreeLine) else None, "boundary", "Use Periodic() or Free()."),
        ):
            if found is not None:
                raise InputError(
                    f"{what} of a contact with plastic flow must be another or none, but is {found!r}. {remedy}"
                )
        require_bodies(flow, self.body, self.counter_body)

    def _check_materials(self) -> None:
        for body in (self.body, self.counter_body):
            layers = [layer.material for layer in body.layers] if isinstance(body, Layered) else []
            for solid in (*layers, body.base if isinstance(body, Layered) else body):
                if isinstance(solid, Elastic):
                    require.magnitude(solid.youngs_modulus, "Young's modulus (Pa)")
        contact_modulus(self.body, self.counter_body)

    def _check_friction(self) -> None:
        values = {"coefficient": "friction coefficient", "strength": "shear strength of the interface"}
        for name, what in values.items():
            found = getattr(self.friction, name, 0.0)
            if isinstance(found, np.ndarray) and found.shape != self.surface.shape:
                raise InputError(
                    f"{what} must have the shape {self.surface.shape} of the surface, but has {found.shape}."
                )
            if isinstance(found, np.ndarray) and self.film is not None:
                raise InputError(f"{what} beside a film of liquid must be one number, but is an array.")
        if self.film is not None and not isinstance(self.friction, Coulomb | None):
            raise InputError(
                f"friction beside a film of liquid must be Coulomb(coefficient) or None, but is {self.friction!r}."
            )

    @property
    def grid(self) -> Grid:
        """Grid of the contact."""
        return self.surface.grid

    @property
    def contact_modulus(self) -> float:
        """E* in Pa of the materials at the two surfaces, see ``contact_modulus``."""
        return contact_modulus(self.body, self.counter_body)

    @cached_property
    def compliance(self) -> Compliance:
        """Sum of the normal compliances of both bodies."""
        return contact_compliance(self.body, self.counter_body)

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers the problem rests on."""
        pair = ("Peng2001",) if isinstance(self.counter_surface, Surface) else ()
        physics = [
            part for part in (self.law, self.film, self.friction, self.adhesion, self.plastic_flow) if part is not None
        ]
        parts = citation_keys(self.surface, self.counter_surface, self.compliance, self.boundary, *physics)
        return (*parts, *pair, "Kalker1977", "Yastrebov2017")

    def profile(self) -> RealArray:
        """Heights (nx, ny) in m of the composite surface, float64, positive towards the counter body."""
        if isinstance(self.counter_surface, Surface):
            return np.asarray(composite(self.surface, self.counter_surface).heights, dtype=np.float64)
        return np.asarray(self.surface.heights, dtype=np.float64)


def _require(value: object, kind: object, what: str, must_be: str) -> None:
    if not isinstance(value, kind):  # type: ignore[arg-type]
        raise InputError(f"{what} of a ContactProblem must be {must_be}, but is {type(value).__name__}.")


def require_adhesion(problem: ContactProblem, control: Control) -> None:
    """Refuse with an InputError what only adhesion bears, in a ``problem`` without."""
    if problem.adhesion is None and isinstance(control, Pull | FixedGrips):
        raise InputError(
            f"control of a problem without adhesion must be one that presses, but is {control!r}. Give "
            "ContactProblem(..., adhesion=ExponentialAdhesion(work, range)), or prescribe Force(...) or Approach(...)."
        )
