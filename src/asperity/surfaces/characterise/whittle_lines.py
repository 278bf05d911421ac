"""Expectation and likelihood of the periodograms of line scans of any length and spacing.

A periodogram of few points is no estimate of C1D: the window mixes modes, points alias, levelling
takes the longest waves. Its expectation under a model follows exactly from the autocovariance R at
the points, so that model and data carry the same errors (debiased Whittle likelihood, Sykulski et
al. 2019). Periodograms I_k = (Δ/N) |Σ w_j h_j exp(-2πi jk/N)|² in m³, <w²> = 1, of the convention
of Jacobs, Junge & Pastewka (2017).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.spectral import complex_lines, line_transform, linear_autocorrelation
from ..profile_spectra import independent_line_factor
from .scans_corners import CORNERS, Corner
from .spectrum import LOST_MODES

# Expectation.


def window_correlation(weights: RealArray) -> RealArray:
    """c_w(l) = (1/N) Σ_j w_j w_(j+l) of the ``weights`` (N,) of a window, at the lags 0 … N - 1."""
    n = weights.size
    return linear_autocorrelation(weights) / n


def expected_periodogram(autocovariance: RealArray, correlation: RealArray, spacing: float) -> RealArray:
    """Expectation in m³ of a periodogram at the modes 0 … N // 2 of points a ``spacing`` Δ (m)
    apart.

    Δ Σ_(|l| < N) c_w(l) R(lΔ) cos(2πkl/N), with aliasing and the leakage of the window; the mean or
    line that is removed before is not in it, which matters below the third mode.
    ``autocovariance`` R in m² at the lags 0 … N - 1; ``correlation`` c_w of the window there.
    """
    summed = correlation * autocovariance
    summed[1:] += summed[:0:-1].copy()  # lags l and N - l have the same cosine
    return np.asarray(spacing * line_transform(summed, 0).real)


FORMS = ("none", "mean", "line", "quadratic", "ends")
"""What is removed from a line before its periodogram: ``ends`` is the line through the first and
the last point, ``line`` that of least squares."""


def levelled_expectation(
    autocovariance: RealArray, weights: RealArray, spacing: float, modes: Sequence[int], form: str
) -> RealArray:
    """Expectation in m³ of a periodogram at some ``modes`` with all that levelling takes from it.

    (Δ/N) g* R g with g = P' (w exp(2πi jk/N)) and the projection P by which the ``form`` is
    removed; two Fourier transforms of 2N points a mode. ``autocovariance`` R in m² at the lags
    0 … N - 1; ``weights`` (N,) of the window; ``spacing`` in m.
    Raises InputError if the form is unknown.
    """
    n = weights.size
    require.one_of(form, FORMS, "form removed from a line")
    at = np.linspace(-1.0, 1.0, n)
    circle = complex_lines(np.concatenate([autocovariance, [0.0], autocovariance[:0:-1]]).astype(complex), 0).real
    basis = None
    if form in ("mean", "line", "quadratic"):
        degree = ("mean", "line", "quadratic").index(form)
        basis = np.linalg.qr(np.vander(at, degree + 1))[0]
    found = np.empty(len(modes))
    for number, mode in enumerate(modes):
        g = weights * np.exp(2j * np.pi * mode * np.arange(n) / n)
        if basis is not None:
            g = g - basis @ (basis.T @ g)
        elif form == "ends":
            first, last = 0.5 * (1.0 - at) @ g, 0.5 * (1.0 + at) @ g
            g[0] -= first
            g[-1] -= last
        padded = np.concatenate([g, np.zeros(n)])
        through = complex_lines(circle * complex_lines(padded, 0), 0, backward=True)[:n]
        found[number] = spacing / n * float(np.vdot(g, through).real)
    return found


# Data and likelihood.


@dataclass(frozen=True, eq=False)
class LineModes:
    """Periodograms of the lines of one scan in its reliable band.

    ``periodograms`` (lines, modes) in m³; ``modes`` (modes,) whole numbers; ``points`` N along a
    line; ``spacing`` Δ in m; ``correlation`` (N,) of the window, ``window`` its kind; ``transfer``
    (modes,) factor of the power by the instrument; ``floor`` noise Δσ_n² in m³; ``distance`` in m
    of neighbouring lines of a map, NaN if the lines are independent; ``periodic`` lines are closed:
    their expectation is C1D itself.
    """

    periodograms: RealArray
    modes: RealArray
    points: int
    spacing: float
    correlation: RealArray
    window: str
    transfer: RealArray
    floor: float = 0.0
    distance: float = math.nan
    periodic: bool = False

    @property
    def q(self) -> RealArray:
        """Wavenumbers in rad/m, (modes,)."""
        return np.asarray(2.0 * np.pi / (self.points * self.spacing) * self.modes)

    @property
    def lines(self) -> int:
        """Number of lines."""
        return int(self.periodograms.shape[0])

    @property
    def is_map(self) -> bool:
        """Whether the lines lie side by side, so that they are not independent."""
        return math.isfinite(self.distance)

    @property
    def lost(self) -> float:
        """Factor by which the window reduces the number of independent modes."""
        return LOST_MODES[self.window]

    def independent(self, hurst: float, corner: float) -> RealArray:
        """Number ν of independent lines at each mode, exactly of a rounded spectrum, (modes,);
        ``corner`` q0 in rad/m."""
        if not self.is_map:
            return np.full(self.modes.size, float(self.lines))
        across = self.lines * self.distance * np.sqrt(self.q**2 + corner**2)
        return np.asarray(np.clip(across / independent_line_factor(hurst), 1.0, float(self.lines)))

    def expectation(self, model: Corner) -> RealArray:
        """Expected periodogram in m³ at the modes, (modes,)."""
        if self.periodic:
            found = model.profile_psd(self.q)
        else:
            R = model.autocovariance(self.spacing * np.arange(self.points))
            found = expected_periodogram(R, self.correlation, self.spacing)[self.modes.astype(int)]
        # rounding of a spectrum that falls by sixteen decades must not become a negative power
        return np.asarray(self.transfer * np.maximum(found, 1e-300) + self.floor)


PARAMETERS = ("ln m0", "ln q0", "H")
"""Parameters of a fit in their order."""

_STEP = 1e-4  # of derivatives by parameters of order one
_ROUNDS = 200  # of damped scoring at most; ten are usual
_SETTLED = 1e-9  # gain of the likelihood, relative to the number of modes, at which it ends
_NARROW = 1e-8  # of a parameter's last step
_LEAST_HURST = 0.02
_HALVINGS = 6  # of a factor 1.65 in q0, to 1 %
_BEYOND = 30.0  # longest line over the roll-off wavelength 2π/q0 and back, within which q0 is sought


@dataclass(frozen=True, eq=False)
class LineFit:
    """Spectrum with the largest likelihood of all scans together.

    ``model`` with its corner; ``fisher`` covariance (3, 3) of (ln m0, ln q0, H) if the model holds
    for every line; ``sandwich`` the same from the scatter of the lines (of the maps, where lines
    are not independent), NaN with three or fewer; ``objective`` F = Σ ν [I/C + ln C]; ``deviance``
    -2 ln L with the modes that windows cost; ``clusters`` number of independent lines and maps;
    ``weights`` ν of every scan; ``at_bound`` names of parameters that stopped at the end of their
    range.
    """

    model: Corner
    fisher: RealArray
    sandwich: RealArray
    objective: float
    deviance: float
    clusters: int
    weights: tuple[RealArray, ...] = ()
    at_bound: tuple[str, ...] = ()

    def error(self, name: str, *, by: str = "fisher") -> float:
        """Standard error of a parameter, ``ln m0``, ``ln q0`` or ``H``, ``by`` fisher or
        sandwich."""
        number = PARAMETERS.index(require.one_of(name, PARAMETERS, "parameter of a spectrum"))
        matrix = self.fisher if by == "fisher" else self.sandwich
        return (
            math.sqrt(max(float(matrix[number, number]), 0.0))
            if matrix[number, number] == matrix[number, number]
            else math.nan
        )


def fit_lines(
    scans: Sequence[LineModes],
    *,
    corner: str = "rounded",
    fixed: dict[str, float] | None = None,
    start: Corner | None = None,
    weights: Sequence[RealArray] | None = None,
) -> LineFit:
    """Spectrum with a rounded or sharp ``corner`` of the largest Whittle likelihood of all
    ``scans`` together.

    Minimises F = Σ_s Σ_k ν_s [I_s/C_s + ln C_s], C_s the expectation of the scan's periodogram, by
    damped scoring from the best of a grid of starts, or from ``start``. ``fixed`` holds parameters,
    by name, at a value. The numbers ν of independent lines of a map follow the fit and are renewed
    once, unless ``weights`` holds them (modes,) for each scan: only then likelihoods compare.
    """
    kind = CORNERS[require.one_of(corner, CORNERS, "corner of a spectrum")]
    longest = max(scan.points * scan.spacing for scan in scans)
    bounds = np.array([[-math.inf, math.inf], [0.0, 0.0], [_LEAST_HURST, kind.largest_hurst]])
    bounds[1] = math.log(2.0 * math.pi / longest) + math.log(_BEYOND) * np.array([-1.0, 1.0])
    held = {PARAMETERS.index(name): value for name, value in (fixed or {}).items()}
    for number, value in held.items():
        bounds[number] = value
    if start is None:
        values = _best_start(kind, scans, bounds, held)
    else:
        values = np.array([math.log(start.variance), math.log(start.corner), start.hurst])
        values[list(held)] = list(held.values())
    if weights is not None:
        values = _scored(kind, scans, weights, values, bounds, held)
        return _judged(kind, scans, weights, values, bounds, held)
    for _ in range(2 if any(scan.is_map for scan in scans) else 1):
        model = kind.of(values)
        used = [scan.independent(model.hurst, model.corner) for scan in scans]
        values = _scored(kind, scans, used, values, bounds, held)
    return _judged(kind, scans, used, values, bounds, held)


def _objective(
    kind: type[Corner], scans: Sequence[LineModes], weights: Sequence[RealArray], values: RealArray
) -> float:
    model = kind.of(values)
    total = 0.0
    for scan, nu in zip(scans, weights, strict=True):
        expected = scan.expectation(model)
        total += float(nu @ (scan.periodograms.mean(axis=0) / expected + np.log(expected)))
    return total


def _gradients(kind: type[Corner], scan: LineModes, values: RealArray) -> tuple[RealArray, RealArray]:
    """ln C (modes,) and its derivatives (3, modes) by the parameters."""
    middle = np.log(scan.expectation(kind.of(values)))
    rows = []
    for number in range(3):
        step = np.zeros(3)
        step[number] = _STEP
        high, low = (scan.expectation(kind.of(values + sign * step)) for sign in (1.0, -1.0))
        rows.append((np.log(high) - np.log(low)) / (2.0 * _STEP))
    return middle, np.array(rows)


def _best_start(kind: type[Corner], scans: Sequence[LineModes], bounds: RealArray, held: dict[int, float]) -> RealArray:
    best, least = np.zeros(3), math.inf
    for log_q0 in np.unique(np.linspace(bounds[1, 0], bounds[1, 1], 9)):
        for hurst in np.unique(np.clip((0.2, 0.5, 0.8, 1.2), *bounds[2])):
            values = np.array([held.get(0, 0.0), log_q0, hurst])
            weights = [scan.independent(float(hurst), math.exp(log_q0)) for scan in scans]
            if 0 not in held:  # the amplitude of the largest likelihood, as if there were no floors
                ratio = [
                    nu @ (scan.periodograms.mean(axis=0) / scan.expectation(kind.of(values)))
                    for scan, nu in zip(scans, weights, strict=True)
                ]
                values[0] = math.log(sum(ratio) / sum(nu.sum() for nu in weights))
            reached = _objective(kind, scans, weights, values)
            if reached < least:
                best, least = values, reached
    return best


def _scored(
    kind: type[Corner],
    scans: Sequence[LineModes],
    weights: Sequence[RealArray],
    values: RealArray,
    bounds: RealArray,
    held: dict[int, float],
) -> RealArray:
    """Parameters at the minimum of F: Gauss-Newton steps of the information with a damping that
    follows their success."""
    free = [number for number in range(3) if number not in held]
    scale, damping = float(sum(nu.sum() for nu in weights)), 1e-3
    least = _objective(kind, scans, weights, values)
    for _ in range(_ROUNDS):
        slope, information = np.zeros(3), np.zeros((3, 3))
        for scan, nu in zip(scans, weights, strict=True):
            log_c, rows = _gradients(kind, scan, values)
            slope += rows @ (nu * (scan.periodograms.mean(axis=0) * np.exp(-log_c) - 1.0))
            information += (rows * nu) @ rows.T
        part = np.ix_(free, free)
        gain = 0.0
        while damping < 1e12:
            damped = information[part] + damping * np.diag(np.diag(information[part]) + 1e-12 * scale)
            trial = values.copy()
            trial[free] = np.clip(values[free] + np.linalg.solve(damped, slope[free]), *bounds[free].T)
            reached = _objective(kind, scans, weights, trial)
            if reached <= least:
                gain, moved = least - reached, float(np.abs(trial - values).max())
                values, least, damping = trial, reached, max(0.1 * damping, 1e-9)
                break
            damping *= 10.0
        else:
            break
        if (gain <= _SETTLED * scale and moved < 1e-4) or moved < _NARROW:
            break
    return values


def _judged(
    kind: type[Corner],
    scans: Sequence[LineModes],
    weights: Sequence[RealArray],
    values: RealArray,
    bounds: RealArray,
    held: dict[int, float],
) -> LineFit:
    """Errors of the parameters and numbers of the fit."""
    information, noise, spread = np.zeros((3, 3)), np.zeros((3, 3)), np.zeros((3, 3))
    clusters, deviance = 0, 0.0
    for scan, nu in zip(scans, weights, strict=True):
        log_c, rows = _gradients(kind, scan, values)
        information += (rows * nu) @ rows.T
        noise += scan.lost * (rows * nu) @ rows.T
        relative = scan.periodograms * np.exp(-log_c)
        deviance += 2.0 / scan.lost * float(nu @ (relative.mean(axis=0) + log_c))
        cluster = relative.mean(axis=0)[None, :] if scan.is_map else relative
        scores = (cluster - 1.0) * (nu / cluster.shape[0]) @ rows.T
        spread += scores.T @ scores
        clusters += cluster.shape[0]
    free = [number for number in range(3) if number not in held]
    part = np.ix_(free, free)
    fisher, sandwich = np.zeros((3, 3)), np.full((3, 3), np.nan)
    inverse = np.linalg.pinv(information[part], hermitian=True)
    fisher[part] = inverse @ noise[part] @ inverse
    if clusters > len(free):
        sandwich = np.zeros((3, 3))
        sandwich[part] = inverse @ spread[part] @ inverse * (clusters / (clusters - len(free)))
    ends = [
        name
        for number, name in enumerate(PARAMETERS)
        if number in free and min(abs(values[number] - bounds[number])) < 1e-6
    ]
    objective = _objective(kind, scans, weights, values)
    return LineFit(kind.of(values), fisher, sandwich, objective, deviance, clusters, tuple(weights), tuple(ends))


def corner_bound(scans: Sequence[LineModes], fit: LineFit, *, gain: float = 2.71) -> float:
    """Largest q0 in rad/m that the scans allow: -2 ln L is ``gain`` (2.71: 95 %, one-sided) above
    its least there."""

    def excess(log_q0: float) -> float:
        held = fit_lines(scans, corner=fit.model.name, fixed={"ln q0": log_q0}, start=fit.model, weights=fit.weights)
        return held.deviance - fit.deviance - gain

    high = math.log(fit.model.corner)
    for _ in range(12):
        low, high = high, high + 0.5
        if excess(high) > 0.0:
            for _ in range(_HALVINGS):
                middle = 0.5 * (low + high)
                low, high = (low, middle) if excess(middle) > 0.0 else (middle, high)
            return math.exp(high)
    return math.inf
