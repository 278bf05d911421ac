"""An elastic block in plane strain on an interface of normal compliance, with friction in a given
direction."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy import sparse

from ..core import require
from ..core.arrays import BoolArray, RealArray
from ..core.errors import ConvergenceError, InputError
from ..core.quantity import measured
from ..solids.compliant_interface import CompliantInterface
from ..solids.elastic import Elastic
from .linear import factorised, without
from .mesh import IntArray
from .quadratic import POINTS, WEIGHTS, cornered_line, quadratic_mesh, quadratic_plane_strain, shape_functions
from .solid import Solid

TOLERANCE = 1e-11
"""Largest unbalanced force over the normal force at which the block has settled; rounding leaves
1e-13 to 1e-12."""

MOST_ITERATIONS = 60
"""Newton iterations; 3 to 12 are usual."""

SOFTER = ((1.0,), (1e-4, 1e-3, 1e-2, 1e-1, 1.0), tuple(10.0 ** np.arange(-8.0, 0.5, 0.5)))
"""Stiffnesses over that of the interface, one after the other, that lead to the balance where
Newton's method fails with the law itself."""

_FINEST = 1e-2
"""Side of the elements in the corners over that of the others: with 1e-4 forces change by 5e-7."""


@dataclass(frozen=True, eq=False)
class CompliantBlock:
    """A block that has been pushed onto its interface; forces are per metre of depth.

    Attributes
    ----------
    x
        Places of the points of the interface from its middle, three in each element.
    pressure, overlap
        At these places.
    along
        Displacement of the block along the interface there.
    normal_force, shear_force
        Sums of the pressure, and of the friction that acts on the block toward +x.
    moment
        Sum of x p: negative where the pressure is larger at the side from which friction comes.
    critical_friction
        Coefficient from which on the tangent may be singular, so that the block may jump: the
        least at which it is, with the pressures as they are; ``inf`` where there is none.
    residuals
        Unbalanced force over the normal force, for each iteration.
    """

    x: RealArray = measured("m", "place along the interface", "point")
    pressure: RealArray = measured("Pa", "pressure of the interface", "point")
    overlap: RealArray = measured("m", "compression of the interface", "point")
    along: RealArray = measured("m", "displacement along the interface", "point")
    normal_force: float = measured("N/m", "normal force")
    shear_force: float = measured("N/m", "force of friction")
    moment: float = measured("N", "moment of the pressure about the middle")
    critical_friction: float = measured("1", "least friction with a singular tangent")
    residuals: tuple[float, ...] = measured("1", "unbalanced force over the normal force", "iteration")


def compliant_block(
    solid: Elastic,
    size: tuple[float, float],
    push: float,
    interface: CompliantInterface,
    *,
    friction: float = 0.0,
    gap: Callable[[RealArray], RealArray] | None = None,
    endless: bool = False,
    parts: int = 8,
) -> CompliantBlock:
    """Push a block, bonded to a ram, onto a fixed interface that slides everywhere toward +x
    (Rabier, Martins, Oden and Campos 1986): p = c w^m and τ = μ p at each point, with the
    compression w of the interface.

    Newton's method; the tangent, k N_a N_b for the pressures and μ k N_a N_b for the friction that
    they cause, is not symmetric. Solutions exist and are unique for small data, among them small
    friction; ``critical_friction`` says how small. Forces are within 5e-5, with pressures at the
    corners less exact.

    Parameters
    ----------
    solid
        Of the block, ν < 0.5.
    size
        Width and height in m.
    push
        How far the ram moves toward the interface in m, > 0; small strains: far less than the
        height.
    interface
        Its law.
    friction
        Coefficient μ >= 0.
    gap
        Gap in m at the places x (m, from the middle) before the push; none by default.
    endless
        Whether the block repeats along x, so that a flat one is a column under uniform strain.
    parts
        Elements over the shorter side, >= 2, beside those in the corners.

    Raises
    ------
    InputError
        If a number is out of its range.
    ConvergenceError
        If no balance is found: friction that is too large, or an interface so hard that it is
        compressed by less than a thousandth of the push.

    Examples
    --------
    >>> law = CompliantInterface(1e3, 2.0)
    >>> found = compliant_block(Elastic(1.0, 0.3), (2.0, 1.0), 0.01, law, friction=0.3)
    >>> f"{found.normal_force:.5f} {found.moment:.6f} {found.critical_friction:.2f}"
    '0.01676 -0.002122 2.09'
    """
    require.instance(solid, Elastic, "solid of the block")
    width, height = (
        require.magnitude(side, "side of the block (m)") for side in require.two(size, "size of the block")
    )
    require.positive(push, "push of the ram (m)")
    require.not_negative(friction, "friction of the interface")
    require.integer(parts, 2, "elements over the shorter side")
    unit = min(width, height)
    ends = (not endless, not endless)
    x = cornered_line(width, int(np.ceil(parts * width / unit)), _FINEST, ends)
    z = cornered_line(height, int(np.ceil(parts * height / unit)), _FINEST, (True, True))
    return _Block(solid, x - 0.5 * width, z, endless).pushed(push, interface, friction, gap)


class _Block:
    """Mesh and stiffness, with z from the interface up into the block."""

    def __init__(self, solid: Elastic, x: RealArray, z: RealArray, endless: bool) -> None:
        mesh = quadratic_mesh(x, z)
        elements = quadratic_plane_strain(mesh)
        number = np.arange(len(mesh.points))
        if endless:  # what is on the right, which comes last, is what is on the left
            number[mesh.side()] = mesh.side(-1)
            unknowns = 2 * number[elements.unknowns // 2] + elements.unknowns % 2
            elements = replace(elements, unknowns=unknowns, size=2 * (len(number) - len(mesh.side())))
        body = Solid(elements, (solid,))
        self.stiffness = elements.pattern.matrix(body.entries)
        ram = 2 * number[mesh.lower]
        self.prescribed: BoolArray = np.zeros(elements.size, dtype=bool)
        self.prescribed[[*ram, *(ram + 1)]] = True
        top = mesh.surface
        edges = top[2 * np.arange(len(x) - 1)[:, None] + np.arange(3)]
        self.values = shape_functions(POINTS)[0]
        self.weights = 0.5 * np.diff(x)[:, None] * WEIGHTS
        self.x = mesh.points[edges, 0] @ self.values.T
        self.tangential: IntArray = 2 * number[edges]
        self.normal: IntArray = self.tangential + 1

    def pushed(
        self, push: float, law: CompliantInterface, friction: float, gap: Callable[[RealArray], RealArray] | None
    ) -> CompliantBlock:
        """Balance at the ``push`` of the ram, from the block that is moved as a whole; where that
        fails from interfaces that are ever softer."""
        opened = np.zeros_like(self.x) if gap is None else np.broadcast_to(gap(self.x), self.x.shape)
        if not np.all(np.isfinite(opened)):
            raise InputError("gap of the interface must be finite numbers, but is not at all points.")
        pushed_by: RealArray = push - opened
        u: RealArray = np.zeros(len(self.prescribed))  # against the ram, so that nothing cancels
        for softer in SOFTER:
            try:
                for share in softer:
                    found = self._balanced(u, replace(law, stiffness=share * law.stiffness), friction, pushed_by)
                    u = found[0]
                return self._answer(*found[:2], law, friction, found[2])
            except ConvergenceError:
                u = np.zeros(len(self.prescribed))
                if softer is SOFTER[-1]:
                    raise
        raise AssertionError

    def _balanced(
        self, u: RealArray, law: CompliantInterface, friction: float, pushed_by: RealArray
    ) -> tuple[RealArray, RealArray, list[float]]:
        """Displacement, compression and residuals by Newton's method from ``u``."""
        residuals: list[float] = []
        left, overlap = self._unbalanced(u, law, friction, pushed_by)
        for _ in range(MOST_ITERATIONS):
            total = max(float((law.pressure(overlap) * self.weights).sum()), float(np.abs(left).max()), 1e-300)
            residuals.append(float(np.abs(left).max()) / total)
            if residuals[-1] <= TOLERANCE:
                return u, overlap, residuals
            slope = law.slope(overlap)
            move = factorised(without(self._tangent(slope, friction), self.prescribed), symmetric=False)(-left)
            part = 1.0
            while True:  # the residual must fall
                tried, tried_overlap = self._unbalanced(u + part * move, law, friction, pushed_by)
                if np.linalg.norm(tried) < (1.0 - 1e-4 * part) * np.linalg.norm(left) or part < 1e-3:
                    break
                part *= 0.5
            u, left, overlap = u + part * move, tried, tried_overlap
        raise ConvergenceError(
            f"The block on its interface leaves an unbalanced force of {residuals[-1]:.1e} of the load. Push it less, "
            "or take less friction."
        )

    def _unbalanced(
        self, u: RealArray, law: CompliantInterface, friction: float, pushed_by: RealArray
    ) -> tuple[RealArray, RealArray]:
        """Unbalanced forces, and the compression of the interface at its points."""
        overlap = pushed_by - u[self.normal] @ self.values.T
        force = (law.pressure(overlap) * self.weights) @ self.values
        left: RealArray = np.asarray(self.stiffness @ u)
        np.subtract.at(left, self.normal, force)
        np.subtract.at(left, self.tangential, friction * force)
        left[self.prescribed] = 0.0
        return left, overlap

    def _edges(self, slope: RealArray) -> RealArray:
        """Matrices (edges, 3, 3) of k N_a N_b."""
        return np.asarray(np.einsum("ep,pa,pb->eab", slope * self.weights, self.values, self.values))

    def _tangent(self, slope: RealArray, friction: float) -> sparse.csc_array:
        """Derivative of the unbalanced forces."""
        own = self._edges(slope)
        column = np.broadcast_to(self.normal[:, None, :], own.shape)
        rows = [np.broadcast_to(side[:, :, None], own.shape).ravel() for side in (self.normal, self.tangential)]
        entries = np.concatenate([own.ravel(), friction * own.ravel()])
        places = (np.concatenate(rows), np.concatenate([column.ravel(), column.ravel()]))
        more = sparse.coo_array((entries, places), shape=self.stiffness.shape)
        found = sparse.csc_array(self.stiffness + more)
        found.sort_indices()
        return found

    def _critical(self, slope: RealArray) -> float:
        """Least friction at which the tangent is singular: u_n = -μ C_nt k u_n, with the compliance
        C of the block on its springs without friction."""
        nodes = np.unique(self.normal)
        place = np.searchsorted(nodes, self.normal)
        springs = np.zeros((len(nodes), len(nodes)))
        own = self._edges(slope)
        np.add.at(springs, (place[:, :, None], place[:, None, :]), own)
        loads = np.zeros((len(self.prescribed), len(nodes)))
        loads[nodes - 1] = springs
        loads[self.prescribed] = 0.0
        tangent = without(self._tangent(slope, 0.0), self.prescribed)
        values = np.linalg.eigvals(factorised(tangent)(loads)[nodes])
        real = values.real[np.abs(values.imag) <= 1e-9 * np.abs(values).max(initial=0.0)]
        negative = real[real < -1e-9 * np.abs(values).max(initial=0.0)]
        return float(-1.0 / negative.min()) if len(negative) else float("inf")

    def _answer(
        self, u: RealArray, overlap: RealArray, law: CompliantInterface, friction: float, residuals: list[float]
    ) -> CompliantBlock:
        pressure = law.pressure(overlap)
        normal = float((pressure * self.weights).sum())
        return CompliantBlock(
            x=self.x.ravel(),
            pressure=pressure.ravel(),
            overlap=overlap.ravel(),
            along=(u[self.tangential] @ self.values.T).ravel(),
            normal_force=normal,
            shear_force=friction * normal,
            moment=float((self.x * pressure * self.weights).sum()),
            critical_friction=self._critical(law.slope(overlap)),
            residuals=tuple(residuals),
        )
