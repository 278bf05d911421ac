"""Series of retardations fitted to complex compliances: non-negative, and of tractions in all
directions positive semi-definite.

c(omega) = c_0 + sum c_k/(1 + i omega lambda_k), with 1/(i omega) in the place of the last for a
fluid. Each term of a passive body stores energy and turns it into heat, whatever the direction of
the traction: its strengths along the wavevector and along the normal, with that between them, are a
positive semi-definite matrix. Such a matrix is a sum of squares of directions (c, s) in the plane
with non-negative factors. The fit begins with the two axes, and takes in the direction of each term
in which its error falls fastest, until none helps.
"""

from __future__ import annotations

import math

import numpy as np

from ...core.arrays import ComplexArray, RealArray
from ...core.errors import InputError
from .layered import PlaneCompliance

_ROUNDS = 40
"""Rounds of a fit in the plane at most; two to five are taken."""

_GAIN = 1e-4
"""Relative change of the residual from one round to the next below which no more directions are
taken."""

_STEEP = 1e-9
"""Slope of the error with a direction, relative to that of a term on its own, that does not
count."""


def responses(times: RealArray, omega: RealArray) -> ComplexArray:
    """1/(1 + i omega lambda_k) for each of ``omega`` (m,) in rad/s and ``times`` (terms,) in s,
    1/(i omega) of an infinite time."""
    finite = np.isfinite(times)
    columns = np.empty((omega.size, times.size), dtype=complex)
    columns[:, finite] = 1.0 / (1.0 + 1j * omega[:, None] * times[finite])
    columns[:, ~finite] = 1.0 / (1j * omega[:, None])
    return columns


def fitted(times: RealArray, omega: RealArray, exact: ComplexArray) -> tuple[RealArray, float]:
    """Non-negative strengths (terms, n) for the columns of ``exact`` (m + 1, n), and the largest
    relative error.

    The last row is the value at infinite frequency, which is subtracted. InputError if a value is
    no number.
    """
    columns = responses(times, omega)
    strengths, worst = np.empty((times.size, exact.shape[1])), 0.0
    for number, values in enumerate(exact.T):
        wanted, size = values[:-1] - values[-1], np.abs(values[:-1])
        found, _ = _least(_real(columns, size[:, None]), _real(wanted, size))
        strengths[:, number] = found
        worst = max(worst, float((np.abs(columns @ found - wanted) / size).max()))
    return strengths, _number(worst)


def fitted_planes(times: RealArray, omega: RealArray, exact: PlaneCompliance) -> tuple[PlaneCompliance, float]:
    """The same of all components of ``exact``, complex arrays (m + 1, n): positive semi-definite
    strengths (terms, n) of each.

    The error of Lz is relative to the root of LL times zz.
    """
    columns, worst = responses(times, omega), 0.0
    across, error = fitted(times, omega, np.asarray(exact.T, dtype=complex))
    strengths = np.empty((3, times.size, exact.LL.shape[1]))
    directions: RealArray = np.empty((2, 0))
    for number in range(exact.LL.shape[1]):
        values = np.stack([component[:, number] for component in (exact.LL, exact.zz, exact.Lz)]).astype(complex)
        size = np.abs(values[:2, :-1])
        whole = np.stack([*size, np.sqrt(size[0] * size[1])])
        wanted = values[:, :-1] - values[:, -1:]
        strengths[:, :, number], directions = _fitted_wave(columns, wanted, whole, directions)
        left = np.abs(strengths[:, :, number] @ columns.T - wanted)
        worst = max(worst, float((left / whole).max()))
    LL, zz, Lz = strengths
    return PlaneCompliance(LL=LL, zz=zz, Lz=Lz, T=across), max(error, _number(worst))


def _fitted_wave(
    columns: ComplexArray, wanted: ComplexArray, size: RealArray, directions: RealArray
) -> tuple[RealArray, RealArray]:
    """Strengths LL, zz, Lz (3, terms) at one wavenumber, begun from the axes and ``directions``,
    and those taken: term and angle of each, (2, number).

    ``wanted`` (3, m), with errors relative to ``size`` (3, m), is fitted by the ``columns`` (m,
    terms).
    """
    along, normal = size[:2].max(axis=1)
    scale = np.array([[along], [normal], [math.sqrt(along * normal)]])  # units in which the two directions weigh alike
    weighted = (_TWICE * scale / size)[:, :, None] * columns  # (3, m, terms)
    terms = np.arange(columns.shape[1])
    steep = _STEEP * np.sqrt((np.abs(weighted) ** 2).sum(axis=(0, 1)))
    axes = [np.stack([terms, np.full(terms.size, angle)]) for angle in (0.0, 0.5 * np.pi)]
    taken, last = np.hstack([*axes, directions]), math.inf
    relative = (_TWICE * wanted / size).ravel()
    for _ in range(_ROUNDS):
        of_terms = weighted[:, :, taken[0].astype(int)] * _components(taken[1])[:, None, :]
        matrix = np.asarray(of_terms.reshape(-1, taken.shape[1]))
        factors, residual = _least(_real(matrix), _real(relative))
        on = factors > 0.0
        taken, factors = taken[:, on], factors[on]
        rest = (relative - matrix[:, on] @ factors).reshape(size.shape)
        slopes = np.einsum("imk,im->ik", weighted, rest.conj()).real
        half, off = 0.5 * (slopes[0] - slopes[1]), 0.5 * slopes[2]
        helps = 0.5 * (slopes[0] + slopes[1]) + np.hypot(half, off) > steep
        if not helps.any() or residual > last * (1.0 - _GAIN):
            break
        more, last = np.stack([terms, 0.5 * np.arctan2(off, half)])[:, helps], residual
        taken, factors = np.hstack([taken, more]), np.append(factors, np.zeros(more.shape[1]))
    found = np.zeros((terms.size, 3))
    np.add.at(found, taken[0].astype(int), (factors * _components(taken[1])).T)
    return found.T * scale, taken[:, factors > 0.0]


_TWICE = np.sqrt([[1.0], [1.0], [2.0]])
"""Weights of LL, zz and Lz: the last stands in the matrix twice."""


def _components(angles: RealArray) -> RealArray:
    """Components c², s² and c s (3, number) of the squares of directions."""
    c, s = np.cos(angles), np.sin(angles)
    return np.stack([c * c, s * s, c * s])


def _real(values: ComplexArray, size: RealArray | float = 1.0) -> RealArray:
    """Real parts of ``values`` over ``size``, and after them the imaginary ones."""
    return np.concatenate([values.real / size, values.imag / size])


def _least(columns: RealArray, wanted: RealArray) -> tuple[RealArray, float]:
    """Non-negative factors (number,) of the ``columns`` (m, number) nearest ``wanted`` (m,), and
    the norm of what is left."""
    from scipy.optimize import nnls

    factors, residual = nnls(columns, wanted, maxiter=100 * columns.shape[1])
    return factors, float(residual)


def _number(error: float) -> float:
    if not math.isfinite(error):
        raise InputError(
            "moduli and thicknesses of viscoelastic layers must be within the range of numbers, but are not."
        )
    return error
