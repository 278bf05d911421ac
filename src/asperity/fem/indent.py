"""Indentation of a layered elastic-plastic solid by a rigid or elastic indenter of any profile,
through loading, unloading and reloading."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
from scipy import sparse

from ..core import require
from ..core.arrays import BoolArray, RealArray
from ..core.errors import InputError
from ..core.quadrature import rule
from ..solids.elastic import Elastic, Rigid
from ..solids.flow import OF_STRENGTH, Plasticity, flow_of, regions_of
from ..solids.layers import Layered, RigidBase
from ..solids.plasticity import J2, WEIGHTS
from .contact import ContactSurface, Equilibrium, Pressed, Target
from .elements import Elements, axisymmetric
from .far_field import exterior
from .history import (
    IndentationHistory,
    IndentationState,
    IndentationStep,
    PlasticZone,
    SolidFields,
    ring_areas,
)
from .indenters import LARGEST_SLOPE, Indenter, ball_radius, radius_at
from .linear import factorised, without
from .mesh import IntArray, Mesh, Resolution, layered_mesh
from .solid import Solid


@dataclass(frozen=True)
class Depth:
    """Step to an approach. ``approach``: in m, of the indenter from its first touch of the
    undeformed surface."""

    approach: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "approach", require.finite(self.approach, "approach of a step (m)"))


@dataclass(frozen=True)
class Load:
    """Step to a load. ``force``: in N, >= 0; after a step to 0 the approach is that at which the
    indenter just touches."""

    force: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "force", require.not_negative(self.force, "force of a step (N)"))


IndentationTarget: TypeAlias = float | Depth | Load
"""Where a step of indentation leads; a number is an approach in m."""


def indentation(
    body: Elastic | Layered,
    indenter: Indenter,
    steps: Sequence[IndentationTarget],
    *,
    counter_body: Elastic | Layered | Rigid = Rigid(),
    plasticity: Plasticity = OF_STRENGTH,
    friction: float = 0.0,
    resolution: Resolution = Resolution(),
    start: IndentationState | None = None,
    keep: Collection[int] = (-1,),
) -> IndentationHistory:
    """Axisymmetric indentation of ``body`` along ``steps``, by finite elements with small strains.

    Parameters
    ----------
    body
        Half-space, coated or not, with bonded layers.
    indenter
        ``Paraboloid``, ``Sphere``, ``Cone``, ``FlatPunch``, or any function of r (m) that gives its
        height (m).
    steps
        Approaches in m, or ``Depth`` and ``Load``; smaller steps follow plastic flow more closely.
    counter_body
        What the indenter is made of: rigid, or a body that stays elastic, meshed as a half-space as
        in Hertz' theory.
    plasticity
        How the regions flow, from the surface down, then the base; by default at the yield stresses
        of the materials.
    friction
        Coefficient of Coulomb's friction, >= 0; ``inf`` for full stick.
    resolution
        Of the mesh.
    start
        ``state`` of an earlier history of the same body, indenter and mesh, from which to go on;
        for the same mesh give ``resolution.radius``.
    keep
        Numbers of the steps whose fields are kept; negative ones count from the end.

    Raises
    ------
    InputError
        If an input cannot be used, or a ball is pressed in by more than 0.08 of its radius: strains
        are not small then.
    ConvergenceError
        If a step is not found even in small parts.

    Examples
    --------
    >>> from asperity import Elastic, fem
    >>> from asperity.solids.plasticity import LinearHardening
    >>> steel = Elastic(200e9, 0.3)
    >>> found = fem.indentation(
    ...     steel,
    ...     fem.Paraboloid(1e-3),
    ...     [1e-7, 2e-7],
    ...     plasticity=LinearHardening(1e9),
    ...     resolution=fem.Resolution(across=12),
    ... )
    >>> bool(found.load[1] > found.load[0])
    True
    """
    prepared = Indentation.of(
        body,
        indenter,
        steps,
        counter_body=counter_body,
        plasticity=plasticity,
        friction=friction,
        resolution=resolution,
    )
    return prepared.run(steps, start=start, keep=keep)


@dataclass(frozen=True, eq=False)
class Indentation:
    """A meshed body and indenter, prepared for any number of histories.

    Attributes
    ----------
    mesh
        Of the body alone.
    pressed
        The body with its surface, and an elastic indenter with it.
    nodes
        Points of the mesh that may touch.
    heights
        (nodes,) of the indenter in m.
    ball
        Radius of the indenter in m where it is a ball or paraboloid, else infinite.
    """

    mesh: Mesh
    pressed: Pressed
    nodes: IntArray
    heights: RealArray
    ball: float = math.inf

    @classmethod
    def of(
        cls,
        body: Elastic | Layered,
        indenter: Indenter,
        steps: Sequence[IndentationTarget],
        *,
        counter_body: Elastic | Layered | Rigid = Rigid(),
        plasticity: Plasticity = OF_STRENGTH,
        friction: float = 0.0,
        resolution: Resolution = Resolution(),
    ) -> Indentation:
        """Mesh fine enough for all ``steps``; arguments are those of ``indentation``."""
        layered = body if isinstance(body, Layered) else Layered([], body)
        if not regions_of(body):
            raise InputError("body must have a layer or an elastic base, but is a rigid base alone.")
        if friction != math.inf:
            require.not_negative(friction, "friction")
        laws = flow_of(body, plasticity)
        radius = resolution.radius or _largest_radius(indenter, steps, laws)
        mesh = layered_mesh(layered, radius, resolution)
        low, relative = axisymmetric(mesh), None
        support, held = _lower_side(mesh, layered)
        if isinstance(counter_body, Rigid):
            solid = Solid(low, laws, support)
        else:
            other = counter_body if isinstance(counter_body, Layered) else Layered([], counter_body)
            upper = layered_mesh(other, radius, resolution)
            high = axisymmetric(upper)  # in its own coordinates with z into it
            more, held_above = _lower_side(upper, other)
            joined = Elements(
                np.concatenate([low.strain_of, high.strain_of]),
                np.concatenate([low.weights, high.weights]),
                np.concatenate([low.unknowns, high.unknowns + low.size]),
                np.concatenate([low.places, high.places]),
                np.concatenate([low.region, high.region + len(laws)]),
                low.size + high.size,
                low.components,
            )
            held = np.concatenate([held, held_above])
            support = sparse.csc_array(sparse.block_diag([support, more]))
            solid = Solid(joined, (*laws, *regions_of(other)), support)
            # The approach of the surfaces is stored in place of the displacement of the lower one.
            below, above = 2 * mesh.surface, low.size + 2 * upper.surface
            pairs = np.concatenate([below, below + 1]), np.concatenate([above, above + 1])
            signs = np.repeat([1.0, -1.0], len(below))
            moved = sparse.coo_array((signs, pairs), shape=(joined.size, joined.size))
            relative = sparse.csc_array(sparse.eye_array(joined.size, format="csc") + moved)
        nodes = mesh.surface[mesh.points[mesh.surface, 0] < 2.0 * radius]
        heights = indenter(mesh.points[nodes, 0])
        along = 2 * nodes[:, None] if friction else np.zeros((len(nodes), 0), dtype=np.intp)
        surface = ContactSurface(2 * nodes + 1, held, along[:, :1], friction, relative)
        return cls(mesh, Pressed(solid, surface), nodes, heights, ball_radius(indenter))

    @property
    def r(self) -> RealArray:
        """(nodes,) distance from the axis in m of the points that may touch."""
        found: RealArray = self.mesh.points[self.nodes, 0]
        return found

    def run(
        self,
        steps: Sequence[IndentationTarget],
        *,
        start: IndentationState | None = None,
        keep: Collection[int] = (-1,),
    ) -> IndentationHistory:
        """Follow ``steps`` from ``start``, by default from the virgin body.

        Raises
        ------
        InputError
            If there is no step, or the state is of another mesh.
        ConvergenceError
            If a step is not found even in small parts.
        """
        if len(steps) == 0:
            raise InputError("steps must be at least one, but is none.")
        if start is None:
            zones = tuple(PlasticZone(number, 0.0) for number in range(int(self.mesh.region.max()) + 1))
            start = IndentationState(self.pressed.undeformed(), zones=zones)
        state = start
        if state.equilibrium.displacement.shape != (self.pressed.solid.elements.size,):
            raise InputError(
                f"start must be a state of the same mesh with {self.pressed.solid.elements.size} unknowns, but "
                f"is one of {len(state.equilibrium.displacement)}. Use the same Indentation, or the same "
                "resolution with its radius."
            )
        kept = {number % len(steps) for number in keep}
        taken, fields = [], {}
        for number, aim in enumerate(steps):
            state, step = self._step(state, aim)
            taken.append(step)
            if number in kept:
                fields[number] = self.fields(state.equilibrium)
        return IndentationHistory(tuple(taken), self.r, state, fields, self.ball)

    def fields(self, now: Equilibrium) -> SolidFields:
        """Stresses and strains of the body."""
        own = len(self.mesh.cells)
        elements = self.pressed.solid.elements
        moved = self.pressed.elements_move(now.displacement)[: 2 * len(self.mesh.points)]
        return SolidFields(
            self.mesh,
            elements if len(elements.weights) == own else axisymmetric(self.mesh),
            moved.reshape(-1, 2),
            now.stress[:own],
            now.state.plastic_strain[:own],
            now.state.accumulated[:own],
        )

    def _step(self, before: IndentationState, aim: IndentationTarget) -> tuple[IndentationState, IndentationStep]:
        last = before.equilibrium
        now = self.pressed.advance(last, lambda part: self._target(last, aim, part))
        if isinstance(aim, Load) and aim.force == 0.0:  # the indenter just touches
            free = now.displacement[self.pressed.surface.normal]
            now = replace(now, approach=float((self.heights + free).min()))
        flowed = now.state.plastic_strain - last.state.plastic_strain
        power = (0.5 * (now.stress + last.stress) * flowed) @ WEIGHTS
        work = before.work + 0.5 * (now.force + last.force) * (now.approach - last.approach)
        plastic_work = before.plastic_work + float((power * self.pressed.solid.elements.weights).sum())
        zones = tuple(self._zone(zone, now) for zone in before.zones)
        state = IndentationState(now, work, plastic_work, zones)
        return state, self._report(state)

    def _target(self, last: Equilibrium, aim: IndentationTarget, part: float) -> Target:
        if isinstance(aim, Load):
            force = last.force + part * (aim.force - last.force)
            if force <= 1e-12 * last.force:  # just out of touch
                free = self.pressed.surface.normal
                return Target(self.heights, float((self.heights + last.displacement[free]).min()) - abs(last.approach))
            return Target(self.heights, None, force)
        approach = aim.approach if isinstance(aim, Depth) else require.finite(aim, "approach of a step (m)")
        return Target(self.heights, last.approach + part * (approach - last.approach))

    def _report(self, state: IndentationState) -> IndentationStep:
        """Numbers of a step; energy held by the back stress is 3/(4 H_k) α : α, ∫ Y dq is by Gauss'
        rule of 8 points."""
        now, solid = state.equilibrium, self.pressed.solid
        moved = self.pressed.elements_move(now.displacement)
        elastic = float(solid.elastic_energy(now.stress).sum())
        if solid.support is not None:
            elastic += 0.5 * float(moved @ (solid.support @ moved))
        stored = hardening = 0.0
        places, shares = rule(8)
        for number, law in enumerate(solid.laws):
            if not isinstance(law, J2):
                continue
            inside = solid.elements.region == number
            q, weights = now.state.accumulated[inside], solid.elements.weights[inside]
            if law.kinematic != 0.0:
                held = 0.75 / law.kinematic * (now.state.back_stress[inside] ** 2 @ WEIGHTS)
                stored += float((held * weights).sum())
            hardened = 0.5 * q * (law.hardening.yield_stress(0.5 * q[..., None] * (1.0 + places)) @ shares)
            hardening += float((hardened * weights).sum())
        return IndentationStep(
            approach=now.approach,
            load=now.force,
            contact_radius=self._contact_radius(now),
            contact_stiffness=self._stiffness(now),
            work=state.work,
            elastic_energy=elastic,
            plastic_work=state.plastic_work,
            stored_energy=stored,
            hardening_work=hardening,
            zones=state.zones,
            pressure=now.normal_force / ring_areas(np.append(self.r, 2.0 * self.r[-1] - self.r[-2]))[:-1],
            surface=moved[self.pressed.surface.normal],
            touching=now.touching,
            iterations=len(now.residuals),
            cuts=now.cuts,
        )

    # Numbers of a step.

    def _contact_radius(self, now: Equilibrium) -> float:
        """Where the gap, which grows as the power 3/2 of the distance from the edge of a smooth
        contact, would be zero."""
        if not now.touching.any():
            return 0.0
        last = int(np.flatnonzero(now.touching)[-1])
        if last + 2 >= len(self.r):
            return float(self.r[last])
        gap = (now.displacement[self.pressed.surface.normal] + self.heights - now.approach)[last + 1 : last + 3]
        if not np.isfinite(gap).all():  # edge of a punch
            return float(self.r[last])
        ratio = (gap[1] / gap[0]) ** (2.0 / 3.0) if gap[0] > 0.0 else math.inf
        near, far = self.r[last + 1 : last + 3]
        edge = near if not math.isfinite(ratio) or ratio <= 1.0 else (ratio * near - far) / (ratio - 1.0)
        return float(np.clip(edge, self.r[last], near))

    def _stiffness(self, now: Equilibrium) -> float:
        """dP/dδ of the elastic bodies with the points that touch as they are."""
        surface, solid = self.pressed.surface, self.pressed.solid
        normal = surface.normal[now.touching]
        if not len(normal):
            return 0.0
        zero = np.zeros(solid.elements.size)
        _, _, stiffness = self.pressed.respond(zero, solid.virgin())
        moved = zero.copy()
        moved[normal] = 1.0
        prescribed = surface.fixed.copy()
        prescribed[normal] = True
        prescribed[surface.tangential[now.touching].ravel()] = True
        right = np.where(prescribed, 0.0, -(stiffness @ moved))
        found = factorised(without(stiffness, prescribed))(right) + moved
        return float((stiffness @ found)[normal].sum())

    def _zone(self, before: PlasticZone, now: Equilibrium) -> PlasticZone:
        own = len(self.mesh.cells)
        elements, q = self.pressed.solid.elements, now.state.accumulated[:own]
        inside = (elements.region[:own] == before.region)[:, None] & (q > 0.0)
        if not inside.any():
            return before
        r, z = elements.places[:own][inside].T
        largest = int(q[inside].argmax())
        place = (float(r[largest]), float(z[largest]))
        zone = PlasticZone(
            before.region,
            float(elements.weights[:own][inside].sum()),
            float(z.min()),
            float(z.max()),
            float(r.max()),
            float(q[inside][largest]),
            place,
            before.first_place,
            before.first_approach,
        )
        if before.volume == 0.0:
            zone = replace(zone, first_place=place, first_approach=now.approach)
        return zone


# The mesh and what holds it.


def _largest_radius(indenter: Indenter, steps: Sequence[IndentationTarget], laws: tuple[Elastic | J2, ...]) -> float:
    """Radius in m at which the indenter cuts the undeformed surface at its deepest step.

    The approach under a load is that on the softest region, elastic or fully plastic, by halving;
    it need only be near.
    """
    depths = [aim.approach if isinstance(aim, Depth) else aim for aim in steps if not isinstance(aim, Load)]
    deepest = max((require.finite(depth, "approach of a step (m)") for depth in depths), default=0.0)
    ball = ball_radius(indenter)
    if deepest > 0.5 * LARGEST_SLOPE**2 * ball:
        raise InputError(
            f"depth of indentation (m) must be at most {0.5 * LARGEST_SLOPE**2 * ball:.3g}, 0.08 of the radius "
            f"of the indenter, but is {deepest:.3g}. Beyond that strains are not small.",
            subject="depth of indentation (m)",
        )
    force = max((aim.force for aim in steps if isinstance(aim, Load)), default=0.0)
    if force > 0.0:
        modulus = min((law.elastic if isinstance(law, J2) else law).plane_strain_modulus for law in laws)
        yields = [float(law.hardening.yield_stress(np.zeros(()))) for law in laws if isinstance(law, J2)]
        low, high = -60.0, 5.0
        for _ in range(50):
            middle = 0.5 * (low + high)
            depth = math.exp(middle)
            radius = radius_at(indenter, depth)
            elastic = 4.0 / 3.0 * modulus * radius / math.sqrt(2.0) * depth
            borne = min(elastic, 2.0 * math.pi * radius**2 * min(yields, default=math.inf))
            low, high = (middle, high) if borne < force else (low, middle)
        deepest = max(deepest, math.exp(high))
    if deepest <= 0.0:
        raise InputError(
            "steps must be a load or approach greater than zero somewhere, but is none. Give "
            "resolution.radius to start from a state."
        )
    return radius_at(indenter, deepest)


def _lower_side(mesh: Mesh, body: Layered) -> tuple[sparse.csc_array, BoolArray]:
    """Stiffness of what lies beyond the mesh, and unknowns that are zero: u_r on the axis, and all
    on a rigid base and the far side of a body that has one."""
    fixed, base = np.zeros((len(mesh.points), 2), dtype=bool), body.reduced.base
    fixed[mesh.side(-1), 0] = True
    if not isinstance(base, RigidBase):
        return exterior(mesh, base), fixed.ravel()
    fixed[mesh.lower] = fixed[mesh.side()] = True
    return sparse.csc_array((fixed.size, fixed.size)), fixed.ravel()
