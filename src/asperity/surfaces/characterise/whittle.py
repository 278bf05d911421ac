"""Greatest Whittle likelihood of one shape of spectrum: starting values, optimisation, standard errors."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...core.arrays import RealArray
from .spectral_model import SpectralModel
from .spectrum import RadialSpectrum

_STARTS = 3  # best of the grid of starting values that are optimised
_BREAKS = 9  # starting values of a break along the range
_STEEPEST = 12.0  # bound of an exponent
_NEAREST = 0.1  # least ln(q_c/q_r) of two power laws


@dataclass(frozen=True)
class Shape:
    """Form of a spectrum: whether it has a ``plateau``, the number of power laws ``slopes``, whether it has a ``floor``."""

    plateau: bool
    slopes: int
    floor: bool

    @property
    def parameters(self) -> int:
        """Number of free parameters."""
        return 1 + self.slopes + (self.slopes - 1) + int(self.plateau) + int(self.floor)

    @property
    def name(self) -> str:
        """Words for the shape."""
        laws = "power law" if self.slopes == 1 else "two power laws"
        return ("plateau + " if self.plateau else "") + laws + (" + floor" if self.floor else "")


@dataclass(frozen=True, eq=False)
class Solution:
    """Best parameters of a ``shape``: logarithms of level, breaks and floor and plain exponents, relative to ``unit``.

    ``values`` in the order ln C0, [ln q_r], [ln q_c/q_r or ln q_c], a1, [a2], [ln C_n]; ``unit`` (q in rad/m, C in m⁴)
    of the logarithms; ``deviance`` Σ N_b [I/C + ln C] with C in that unit.
    """

    shape: Shape
    values: RealArray
    unit: tuple[float, float]
    deviance: float

    def model(self, longest: float) -> SpectralModel:
        """The spectrum with these parameters; without a plateau it begins at the ``longest`` wave (m)."""
        log_level, log_r, log_c, exponents, log_floor = _split(self.shape, self.values)
        unit_q, unit_c = self.unit
        if not self.shape.plateau:  # the level is stated at q = unit
            log_r = math.log(2.0 * math.pi / (longest * unit_q))
            log_level -= exponents[0] * log_r
        rolloff = 2.0 * math.pi / (unit_q * math.exp(log_r))
        return SpectralModel(
            level=unit_c * math.exp(log_level),
            rolloff_wavelength=rolloff,
            exponents=exponents,
            crossover_wavelength=2.0 * math.pi / (unit_q * math.exp(log_c)),
            floor=unit_c * math.exp(log_floor),
            longest_wavelength=math.inf if self.shape.plateau else rolloff,
        )

    def errors(self, rings: RadialSpectrum, lost: float) -> dict[str, float]:
        """Standard errors from the Fisher information of N_b/(2 ``lost``) independent modes a ring; NaN if singular."""
        _, gradient = _log_psd(self.shape, self.values, np.log(rings.q / self.unit[0]))
        information = (gradient * (0.5 * rings.modes / lost)) @ gradient.T
        try:
            covariance = np.linalg.inv(information)
        except np.linalg.LinAlgError:
            covariance = np.full_like(information, np.nan)
        names = _names(self.shape)
        if self.shape.plateau and self.shape.slopes == 2:  # ln q_c = ln q_r + the fitted distance
            into = np.eye(len(names))
            into[names.index("crossover_wavelength"), names.index("rolloff_wavelength")] = 1.0
            covariance = into @ covariance @ into.T
        with np.errstate(invalid="ignore"):
            return dict(zip(names, (float(e) for e in np.sqrt(np.diag(covariance))), strict=True))


def fitted_shape(rings: RadialSpectrum, shape: Shape) -> Solution:
    """Parameters of ``shape`` with the greatest likelihood, from the best of several starts."""
    from scipy.optimize import minimize

    unit = (float(np.exp(np.mean(np.log(rings.q)))), float(np.exp(np.mean(np.log(rings.psd)))))
    log_q, measured = np.log(rings.q / unit[0]), rings.psd / unit[1]

    def deviance(values: RealArray) -> tuple[float, RealArray]:
        log_c, gradient = _log_psd(shape, values, log_q)
        ratio = measured * np.exp(-log_c)
        return float(rings.modes @ (ratio + log_c)) / scale, gradient @ (rings.modes * (1.0 - ratio)) / scale

    scale = float(rings.modes.sum())
    starts = sorted(_starts(shape, log_q, measured, rings.modes), key=lambda values: deviance(values)[0])[:_STARTS]
    bounds = _bounds(shape, log_q, measured)
    options: Any = {"maxfun": 2000, "ftol": 1e-13, "gtol": 1e-8}
    found = [minimize(deviance, start, jac=True, bounds=bounds, method="TNC", options=options) for start in starts]
    best = min(found, key=lambda item: float(item.fun))
    return Solution(shape, np.asarray(best.x), unit, float(best.fun) * scale)


def _names(shape: Shape) -> list[str]:
    names = ["level"]
    names += ["rolloff_wavelength"] if shape.plateau else []
    names += ["crossover_wavelength"] if shape.slopes == 2 else []
    return names + ["exponent_1", "exponent_2"][: shape.slopes] + (["floor"] if shape.floor else [])


def _split(shape: Shape, values: RealArray) -> tuple[float, float, float, tuple[float, ...], float]:
    """ln C0, ln q_r, ln q_c, exponents and ln C_n; the level of a spectrum without plateau is stated at ln q = 0."""
    rest = [float(v) for v in values]
    log_level = rest.pop(0)
    log_r = rest.pop(0) if shape.plateau else 0.0
    log_c = log_r + rest.pop(0) if shape.slopes == 2 else math.nan
    exponents = tuple(rest.pop(0) for _ in range(shape.slopes))
    return log_level, log_r, log_c, exponents, rest.pop(0) if shape.floor else -math.inf


def _log_psd(shape: Shape, values: RealArray, log_q: RealArray) -> tuple[RealArray, RealArray]:
    """ln C at ``log_q`` and its derivatives by the parameters, shape (parameters, rings)."""
    rest = [float(v) for v in values]
    log_c = np.full(log_q.shape, rest.pop(0))
    rows: list[RealArray] = [np.ones(log_q.shape)]
    log_r = rest.pop(0) if shape.plateau else 0.0
    distance = rest.pop(0) if shape.slopes == 2 else math.inf
    exponents = [rest.pop(0) for _ in range(shape.slopes)]
    first = np.maximum(log_q - log_r, 0.0) if shape.plateau else log_q
    log_c = log_c - exponents[0] * first
    beyond = (log_q > log_r).astype(float)
    slope_rows = [-first]
    if shape.plateau:
        rows.append(exponents[0] * beyond)
    if shape.slopes == 2:
        step = exponents[1] - exponents[0]
        second = np.maximum(log_q - log_r - distance, 0.0)
        past = (second > 0.0).astype(float)
        log_c = log_c - step * second
        rows += [step * past]
        if shape.plateau:
            rows[1] = rows[1] + step * past
        slope_rows = [second - first, -second]
    rows += slope_rows
    if shape.floor:
        total = np.logaddexp(log_c, rest[0])
        share = np.exp(log_c - total)
        return total, np.array([row * share for row in rows] + [1.0 - share])
    return log_c, np.array(rows)


def _starts(shape: Shape, log_q: RealArray, measured: RealArray, modes: RealArray) -> list[RealArray]:
    """Weighted least squares of ln I for every combination of breaks on a grid along the range."""
    breaks = np.linspace(log_q[0], log_q[-1], _BREAKS + 2)[1:-1]
    log_i, weight = np.log(measured), np.sqrt(np.minimum(modes, 1e4))
    floors = [float(log_i.min()) - 0.7] if shape.floor else [-math.inf]
    if shape.plateau and shape.slopes == 2:
        pairs = [(a, b) for a, b in itertools.combinations(breaks, 2) if b - a >= _NEAREST]
    elif shape.plateau or shape.slopes == 2:
        pairs = [(b, b) for b in breaks]
    else:
        pairs = [(0.0, 0.0)]
    starts = []
    for (log_r, log_c), floor in itertools.product(pairs, floors):
        first = np.maximum(log_q - log_r, 0.0) if shape.plateau else log_q
        columns = [np.ones(log_q.shape), -first]
        if shape.slopes == 2:
            second = np.maximum(log_q - log_c, 0.0)
            columns = [np.ones(log_q.shape), second - first, -second]
        matrix = np.array(columns).T * weight[:, None]
        solved = np.linalg.lstsq(matrix, log_i * weight, rcond=None)[0]
        values = [solved[0]]
        values += [log_r] if shape.plateau else []
        values += [log_c - (log_r if shape.plateau else 0.0)] if shape.slopes == 2 else []
        values += list(np.clip(solved[1:], -_STEEPEST, _STEEPEST)) + ([floor] if shape.floor else [])
        starts.append(np.array(values))
    return starts


def _bounds(shape: Shape, log_q: RealArray, measured: RealArray) -> list[tuple[float, float]]:
    low, high = float(log_q[0]), float(log_q[-1])
    log_i = np.log(measured)
    wide = 5.0 + float(log_i.max() - log_i.min())
    bounds = [(float(log_i.min()) - wide, float(log_i.max()) + wide)]
    bounds += [(low, high)] if shape.plateau else []
    bounds += [(_NEAREST, high - low) if shape.plateau else (low, high)] if shape.slopes == 2 else []
    bounds += [(-_STEEPEST, _STEEPEST)] * shape.slopes
    return bounds + ([(float(log_i.min()) - 12.0, float(log_i.max()))] if shape.floor else [])
