"""The contact problem: surfaces, bodies, boundary and physics of the interface."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, Self, TypeAlias, Unpack, cast

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.grid import Grid
from ..core.late import Shown
from ..core.registry import PHYSICS, REFUSED, home
from ..core.status import Advice
from ..core.values import LEAST
from ..solids.compliance.halfspace import Compliance, contact_compliance
from ..solids.elastic import Elastic, Rigid
from ..solids.layers import Body, Layered, contact_modulus
from ..surfaces.pair import composite
from ..surfaces.profile import Profile, no_area
from ..surfaces.surface import Surface
from .boundary import Boundary, FreeLine, Periodic
from .controls import Control, FixedGrips, Pull, Step
from .known import Keywords, ProblemNames
from .law import HardWall, InterfaceLaw

if TYPE_CHECKING:
    from .couplings.protocol import Coupling
    from .edges import Kind
    from .operators import Operator
    from .state import InterfaceState

Result: TypeAlias = Any
"""A ``ContactResult``, which knows its problem: its type is named by the physics, so that the
problem needs not know it."""

Solved: TypeAlias = "Callable[[Control, InterfaceState | None], Result]"
"""Gives the contact under a control, started from a state."""


@dataclass(frozen=True)
class Preparing:
    """What is known when couplings are prepared: tolerances by name, whether surfaces stick and
    slip, number of threads."""

    tolerances: Mapping[str, float]
    sticks: bool
    threads: int | None


class Physics:
    """One physics of the interface: frozen settings, given to a ``ContactProblem`` by its
    ``keyword`` or in ``physics``."""

    keyword: ClassVar[str] = ""
    attracts: ClassVar[bool] = False
    """Whether it holds the surfaces together, without a load too."""
    bears_pull: ClassVar[bool] = False
    """Whether a ``Pull`` and ``FixedGrips`` can be prescribed with it."""
    moving: ClassVar[str] = "it is not known how it moves"
    """Why it has no steady state under a load that moves; empty where it has one."""

    supplies: ClassVar[tuple[str, ...]] = ()
    """Those of its ``works`` that are done on the bodies; the others are stored or lost."""
    pull_term: ClassVar[str] = ""
    """Name in ``EnergyBalance`` of the work that its pull does over the approach."""
    takes: ClassVar[Any] = ()
    """Type of what its keyword takes."""
    types: ClassVar[tuple[type, ...]] = ()
    """Types of what it is given, which files may name."""

    @property
    def given(self) -> Any:
        """What the keyword was given, which is the first of its fields; itself if it takes
        nothing."""
        return getattr(self, fields(cast(Any, self))[0].name) if self.takes else self

    @classmethod
    def of(cls, given: Any) -> Self:
        """The physics of what the keyword was ``given``; a TypeError if it is none."""
        if not isinstance(given, cls.takes):
            raise TypeError
        return cls(given)  # type: ignore[call-arg]

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers it rests on."""
        return tuple(getattr(self.given, "citation_keys", ())) if self.given is not self else ()

    def check(self, problem: ContactProblem) -> None:
        """Refuse with an InputError what does not go with it in ``problem``."""

    def advice(self) -> Iterator[Advice]:
        """What should be known of its settings before the solve."""
        yield from ()

    def check_relaxing(self, problem: ContactProblem) -> None:
        """The same where a body of ``problem`` is viscoelastic."""

    def couplings(self, problem: ContactProblem, operator: Operator, how: Preparing) -> Iterator[Coupling]:
        """Its couplings, prepared for the ``problem`` with its ``operator``."""
        raise NotImplementedError

    def conserves(self) -> bool:
        """Whether it takes no energy in steps without a jump."""
        return True

    @property
    def slides(self) -> bool | None:
        """Whether all points slide by it in steps without a tangential control; None where it does
        not shear the surfaces."""
        return None

    def shear(self, pressure: RealArray) -> RealArray | None:
        """Shear traction (2, nx, ny) in Pa on the body where all points slide by it under a
        ``pressure`` (nx, ny) in Pa; None for none."""
        return None

    def sticks(self, state: InterfaceState | None, *, tangential: bool) -> bool:
        """Whether surfaces stick and slip, in steps from ``state`` of which one or more are
        ``tangential``."""
        return False

    def normal_tolerance(self, *, sticks: bool) -> float | None:
        """Tolerance that normal solves need beside it, where that is less than usual; in steps
        where surfaces may stick."""
        return None

    def followed(self, problem: ContactProblem, step: Step, solved: Solved) -> Solved:
        """How results under the normal control of ``step`` are ``solved``, where the step may have
        to be divided."""
        return solved

    def edges(self, problem: ContactProblem) -> Kind | None:
        """What it makes of the edges of contacts of ``problem``; None where they stay elastic."""
        return None

    def rows(self) -> list[tuple[str, str]]:
        """Label and text of it for a problem in words."""
        return []

    def work(self, steps: Sequence[Result]) -> RealArray | None:
        """Work (J) of the force between the solids up to each of the ``steps`` of a history, where
        it is known better than by the trapezoidal rule."""
        return None

    def works(self, steps: Sequence[Result]) -> Mapping[str, RealArray]:
        """Energies (J) in each of the ``steps`` of a history that it adds to the balance, by their
        names in ``EnergyBalance``."""
        return {}

    def losses(self, steps: Sequence[Result], left: RealArray) -> Mapping[str, RealArray]:
        """Energies (J) up to each of the ``steps``, by name, that it takes of what nothing else
        takes, ``left`` (J)."""
        return {}


class WithPhysics:
    """Attributes of a problem by keyword: what was given for it, None for nothing."""

    physics: tuple[Physics, ...]

    def __getattr__(self, name: str) -> Any:
        if name not in PHYSICS:
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
        return next((item.given for item in vars(self).get("physics", ()) if item.keyword == name), None)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *PHYSICS]


@dataclass(frozen=True)
class Flat:
    """A perfectly flat counter surface."""


CounterSurface: TypeAlias = Surface | Flat
"""Surface of the counter body."""


@dataclass(frozen=True, repr=False, init=False)
class ContactProblem(ProblemNames, WithPhysics, Shown):
    """Two bodies with their surfaces, pressed together.

    Parameters
    ----------
    surface
        Surface of ``body``, heights positive out of it. Missing points must have been filled.
    body
        The body under the surface: ``Elastic``, ``Layered`` or ``Rigid``.
    counter_surface
        Surface of the counter body on the same grid, heights positive out of *that* body and
        already laid in the lateral frame of ``surface`` (see ``composite`` for the mirror a
        measured map needs). Flat by default.
    counter_body
        The counter body; rigid by default. Only one of the two may be rigid.
    boundary
        ``Periodic()``, ``Free()``, or ``FreeLine()`` for a free line contact.
    law
        ``HardWall()`` (elastic), ``Hardness(H)`` or ``LayeredHardness(body)``.
    film
        Film of liquid whose menisci pull the surfaces together; None for a dry contact.
    friction
        ``Coulomb(mu)``, ``TrescaFriction(strength)`` or ``FullStick()``; None for none. Under
        Coulomb friction all points slide unless a step prescribes a ``Shift`` or
        ``TangentialForce``; under the others the counter body does not shift until then.
    adhesion
        Attraction of the surfaces, such as ``ExponentialAdhesion(0.05, 1e-9)``; None for none.
    plastic_flow
        Plastic flow in the volume of ``body``, or where that is rigid of the counter body:
        ``PlasticFlow(J2(...))``; None for none.
    fluid_pressure
        Fluid that flows through the gap and whose pressure acts on both bodies, such as
        ``FluidPressure(ViscousLiquid(1e-3), 2e5, 1e5)``; None for none.
    physics
        Further ``Physics`` of the interface, also of one's own. Those given by keyword are among
        them afterwards.

    Notes
    -----
    Only the sum of the two surfaces and the sum of the two compliances enter (Peng 2001, eq. 3.32
    and app. D).

    Raises
    ------
    InputError
        If a surface has missing points, grids differ, both bodies are rigid, a hardness array has
        another shape, the grid does not suit the boundary, or a length or modulus is out of the
        range 1e-41 to 1e40.
    """

    surface: Surface
    body: Body
    counter_surface: CounterSurface = Flat()
    counter_body: Body = Rigid()
    boundary: Boundary = Periodic()
    law: InterfaceLaw = HardWall()
    physics: tuple[Physics, ...] = ()

    def __init__(
        self,
        surface: Surface,
        body: Body,
        counter_surface: CounterSurface = Flat(),
        counter_body: Body = Rigid(),
        boundary: Boundary = Periodic(),
        law: InterfaceLaw = HardWall(),
        *,
        physics: Iterable[Physics] = (),
        **given: Unpack[Keywords],
    ) -> None:
        # in the order of the registry, those of one's own last; what is given by keyword takes the
        # place of others
        found: dict[str, Physics] = {}
        for item in physics:
            if not isinstance(item, Physics):
                raise InputError(f"physics of a ContactProblem must be Physics, but is {type(item).__name__}.")
            own = item.keyword or type(item).__qualname__
            if own in found:
                raise InputError(f"physics of a ContactProblem must be given once, but {own} is given twice.")
            found[own] = item
        for keyword, each in given.items():
            if keyword not in PHYSICS:
                raise TypeError(f"ContactProblem() got an unexpected keyword argument {keyword!r}")
            found.pop(keyword, None)
            if each is None:
                continue
            try:
                found[keyword] = home(PHYSICS[keyword].home).of(each)
            except TypeError:
                must_be = f"{PHYSICS[keyword].must_be} or None"
                raise InputError(
                    f"{keyword} of a ContactProblem must be {must_be}, but is {type(each).__name__}."
                ) from None
        order = list(PHYSICS)
        joined = sorted(found.values(), key=lambda p: order.index(p.keyword) if p.keyword in order else len(order))
        values = (surface, body, counter_surface, counter_body, boundary, law, tuple(joined))
        for name, value in zip(self.__dataclass_fields__, values, strict=True):
            object.__setattr__(self, name, value)
        self._check()

    def with_physics(self, **given: Unpack[Keywords]) -> ContactProblem:
        """The same problem with what is ``given`` by keyword, None to leave it out, in place of
        what it has."""
        return replace(self, **given)  # type: ignore[misc]

    def _check(self) -> None:
        if isinstance(self.surface, Profile):
            raise no_area()
        _require(self.surface, Surface, "surface", "a Surface (see asperity.read and asperity.generate)")
        _require(self.counter_surface, Surface | Flat, "counter_surface", "a Surface or Flat()")
        _require(self.boundary, Boundary, "boundary", "Periodic(), Free() or FreeLine()")
        for body, what in ((self.body, "body"), (self.counter_body, "counter_body")):
            _require(body, Body, what, "Elastic(...), a named material, Layered(...) or Rigid()")
        _require(self.law, InterfaceLaw, "law", "HardWall() or Hardness(...)")
        for body in (self.body, self.counter_body):
            layers = [layer.material for layer in body.layers] if isinstance(body, Layered) else []
            for solid in (*layers, body.base if isinstance(body, Layered) else body):
                if isinstance(solid, Elastic):
                    require.magnitude(solid.youngs_modulus, "Young's modulus (Pa)")
        contact_modulus(self.body, self.counter_body)
        for spacing in self.grid.spacing:
            require.magnitude(spacing, "pixel size (m)")
        if isinstance(self.boundary, FreeLine):
            self.boundary.require_line(self.grid)
        for surface, what in ((self.surface, "surface"), (self.counter_surface, "counter_surface")):
            if isinstance(surface, Surface) and surface.n_missing:
                raise InputError(
                    f"{what} must have no missing points, but {surface.n_missing} are missing. "
                    "Fill them first ({fill})."
                )
            if isinstance(surface, Surface) and (extent := float(np.ptp(surface.heights))) > LEAST:
                require.magnitude(extent, "range of the heights (m)")  # a smaller one is rounding of a flat surface
        if isinstance(self.counter_surface, Surface):
            composite(self.surface, self.counter_surface)
        given = {physics.keyword: physics.given for physics in self.physics}
        for (one, other), why in REFUSED.items():
            if given.keys() >= {one, other}:
                name = one.replace("_", " ")
                raise InputError(f"{other} of a contact with {name} must be None, but is {given[other]!r}: {why}.")
        for physics in self.physics:
            physics.check(self)
        cap = self.law.pressure_cap()
        if isinstance(cap, np.ndarray) and cap.shape != self.surface.shape:
            raise InputError(
                f"hardness array must have the shape {self.surface.shape} of the surface, but has {cap.shape}."
            )

    @property
    def attracts(self) -> bool:
        """Whether a physics holds the surfaces together."""
        return any(physics.attracts for physics in self.physics)

    @property
    def bears_pull(self) -> bool:
        """Whether the bodies can be pulled."""
        return any(physics.bears_pull for physics in self.physics)

    def shear(self, pressure: RealArray) -> RealArray | None:
        """Shear traction (2, nx, ny) in Pa on the body under a ``pressure`` (nx, ny) in Pa, where
        all points slide; None for none."""
        return next((found for item in self.physics if (found := item.shear(pressure)) is not None), None)

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
        whole = self.surface, self.counter_surface, self.compliance, self.boundary, self.law
        parts = {key for item in (*whole, *self.physics) for key in getattr(item, "citation_keys", ())}
        return (*sorted(parts), *pair, "Kalker1977", "Yastrebov2017")

    def profile(self) -> RealArray:
        """Heights (nx, ny) in m of the composite surface, float64, positive towards the counter
        body."""
        if isinstance(self.counter_surface, Surface):
            return np.asarray(composite(self.surface, self.counter_surface).heights, dtype=np.float64)
        return np.asarray(self.surface.heights, dtype=np.float64)


def _require(value: object, kind: object, what: str, must_be: str) -> None:
    if not isinstance(value, kind):  # type: ignore[arg-type]
        raise InputError(f"{what} of a ContactProblem must be {must_be}, but is {type(value).__name__}.")


def require_borne(problem: ContactProblem, control: Control) -> None:
    """Refuse with an InputError what no physics of the ``problem`` bears."""
    if isinstance(control, Pull | FixedGrips) and not problem.bears_pull:
        raise InputError(
            f"control of a problem without adhesion must be one that presses, but is {control!r}. Give "
            "an adhesion, such as {gentle_law}, or prescribe {force} or {approach}."
        )
