"""The contact problem: surfaces, bodies, boundary and physics of the interface; and what may be prescribed: a load, a position, or no load."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, TypeAlias

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
from .laws import Adhesion, Coulomb, FrictionLaw, HardWall, InterfaceLaw, PlasticFlow
from .laws.plastic_flow import require_bodies
from .tangential import Tangential
from .wetting import LiquidFilm


@dataclass(frozen=True)
class MeanPressure:
    """Nominal pressure, force over nominal area of the grid, in Pa, > 0."""

    value: float
    name: ClassVar[str] = "mean pressure"
    unit: ClassVar[str] = "Pa"

    def __post_init__(self) -> None:
        require.positive(self.value, "mean pressure (Pa)", "Use Approach(...) to prescribe the position instead.")


@dataclass(frozen=True)
class Force:
    """Normal force on the grid in N, > 0."""

    value: float
    name: ClassVar[str] = "force"
    unit: ClassVar[str] = "N"

    def __post_init__(self) -> None:
        require.positive(self.value, "force (N)", "Use Approach(...) to prescribe the position instead.")


@dataclass(frozen=True)
class Approach:
    """Approach in m, > 0, measured from first touch of the undeformed surfaces.

    Free boundary: displacement of the bodies' distant parts towards each other. Periodic boundary: there that
    displacement is unbounded, so approach is the decrease of the mean gap from its value at first touch.
    """

    value: float
    name: ClassVar[str] = "approach"
    unit: ClassVar[str] = "m"

    def __post_init__(self) -> None:
        require.positive(self.value, "approach (m)", "At zero approach the surfaces only touch.")


@dataclass(frozen=True)
class MeanGap:
    """Mean gap between the deformed surfaces in m, > 0."""

    value: float
    name: ClassVar[str] = "mean gap"
    unit: ClassVar[str] = "m"

    def __post_init__(self) -> None:
        require.positive(self.value, "mean gap (m)", "A gap of zero is full contact; use MeanPressure(...) there.")


@dataclass(frozen=True)
class Pull:
    """Tensile normal force on the grid in N, > 0, that adhesion bears; only for a problem with ``adhesion``."""

    value: float
    name: ClassVar[str] = "pull"
    unit: ClassVar[str] = "N"

    def __post_init__(self) -> None:
        require.positive(self.value, "pull (N)", "Use Force(...) to press the bodies together.")


@dataclass(frozen=True)
class FixedGrips:
    """Approach of a testing machine that holds the bodies by a spring, of either sign; only for a problem with ``adhesion``.

    The bodies are at the approach δ = value - F/stiffness under the force F > 0 that presses them together.

    Parameters
    ----------
    value
        Approach in m from first touch of the undeformed surfaces (``Approach``); negative where they were apart.
    stiffness
        Stiffness of the machine in N/m, > 0; infinite by default.

    Raises
    ------
    InputError
        If the approach is not finite or the stiffness not positive.
    """

    value: float
    stiffness: float = math.inf
    name: ClassVar[str] = "approach of the grips"
    unit: ClassVar[str] = "m"

    def __post_init__(self) -> None:
        require.finite(self.value, "approach of the grips (m)")
        if not self.stiffness > 0.0:
            raise InputError(f"stiffness of the machine (N/m) must be positive, but is {self.stiffness:g}.")


@dataclass(frozen=True)
class Unloaded:
    """No load: the bodies, dented as they are, just touch with their highest point. Ends the unloading of a load path."""

    value: ClassVar[float] = 0.0
    name: ClassVar[str] = "mean pressure"
    unit: ClassVar[str] = "Pa"


def mean_pressure(control: MeanPressure | Force, grid: Grid) -> float:
    """Nominal pressure in Pa that ``control`` prescribes on ``grid``."""
    return control.value if isinstance(control, MeanPressure) else control.value / grid.area


Control: TypeAlias = MeanPressure | Force | Approach | MeanGap | Unloaded | Pull | FixedGrips
"""A prescribed quantity."""


@dataclass(frozen=True)
class Step:
    """One step of a history.

    Parameters
    ----------
    normal
        ``MeanPressure``, ``Force``, ``Approach``, ``MeanGap`` or ``Unloaded``.
    tangential
        ``Shift`` or ``TangentialForce``: surfaces stick and slip by the friction of the problem. None leaves what the step before
        prescribed, at first no shift; in a history without any, all points slide where the problem has ``Coulomb`` friction.
    duration
        Time in s, >= 0, in which the load or position goes in a straight line to ``normal`` from where the step before left it; zero for
        at once. A hold is a step to the load that is there already. It matters to ``Viscoelastic`` bodies alone.

    Raises
    ------
    InputError
        If one of them is something else, or the duration negative or infinite.
    """

    normal: Control
    tangential: Tangential | None = None
    duration: float = 0.0

    def __post_init__(self) -> None:
        if not isinstance(self.normal, Control):
            raise InputError(
                f"normal control of a step must be a MeanPressure, Force, Approach, MeanGap or Unloaded, but is {self.normal!r}. "
                "Write for example MeanPressure(50e3)."
            )
        if not isinstance(self.tangential, Tangential | None):
            raise InputError(
                f"tangential control of a step must be a Shift, a TangentialForce or None, but is {self.tangential!r}. "
                "Write for example Shift(5e-9)."
            )
        object.__setattr__(self, "duration", require.not_negative(self.duration, "duration of a step (s)"))


def as_step(step: Step | Control) -> Step:
    """``step``, or that of a control along the normal alone."""
    return step if isinstance(step, Step) else Step(step)


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
