"""Integrals of the theories, over decades of their parameters: with other panels, and against
integrals of many digits."""

from __future__ import annotations

import sys
import warnings
from itertools import pairwise

import mpmath
import numpy as np
import pytest
from theory_cases import EXAMPLES, GIVEN, RANGES

import asperity as asp
from asperity.core import quadrature
from asperity.core.quadrature import running
from asperity.theories import THEORIES, evaluate, theory
from asperity.theories.ask import ways_of

THIN = {"few": (), "one more, very near": (1e-9,), "ever nearer": tuple(np.geomspace(1e-12, 1.0, 25))}
"""Further points of a table of the same spectrum, by their distance in ln q from the first."""


def test_running_integrals_are_exact_for_polynomials() -> None:
    x, sums = running(9)
    for power in range(9):
        exact = (x ** (power + 1) - (-1.0) ** (power + 1)) / (power + 1)
        assert sums @ x**power == pytest.approx(exact, abs=1e-14)


def table(more: tuple[float, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Self-affine spectrum of three decades, wavenumbers and values."""
    q = np.array([2e3, *(2e3 * np.exp(np.array(more))), 2e6])
    return q, 4e-17 * (q / 2e3) ** -3.6


def by_mpmath(pressure: float, speed: float, reduction: float) -> tuple[float, float]:
    """Friction and area over one relaxation, 3 MPa + 3 GPa and 10 µs: integrals over the angle are
    closed, those over ln q nested."""
    E0, E1, tau = mpmath.mpf(3e6), mpmath.mpf(3e9), mpmath.mpf(1e-5)
    q0, C0 = mpmath.mpf(2e3), mpmath.mpf(4e-17) / (2 * mpmath.pi) ** 2
    end = mpmath.log(1000)

    def losses(t):
        q = q0 * mpmath.exp(t)
        a = tau * speed * q
        relaxing = 1 - 1 / mpmath.sqrt(1 + a * a)
        density = q**4 * C0 * mpmath.exp(-mpmath.mpf(18) / 5 * t)
        square = 2 * mpmath.pi * (E0**2 + (2 * E0 * E1 + E1**2) * relaxing)
        return density * square / 8 / pressure**2, density * E1 * 2 * mpmath.pi / a * relaxing / 2 / pressure

    G = mu = mpmath.mpf(0)
    P = mpmath.mpf(1)
    edges = [mpmath.mpf(0), *(mpmath.mpf(10) ** k for k in range(-28, 0)), mpmath.mpf(1), mpmath.mpf(3), end]
    for low, high in pairwise(edges):

        def contact(t, low=low, G=G):
            return mpmath.erf(1 / (2 * mpmath.sqrt(G + mpmath.quad(lambda s: losses(s)[0], [low, t], maxdegree=3))))

        def steepness(t, contact=contact):
            P = contact(t)
            return losses(t)[1] * (reduction + (1 - reduction) * P**2) * P

        mu += mpmath.quad(steepness, [low, mpmath.sqrt(low * high) if low else high / 10, high], maxdegree=4)
        P = contact(high)
        G += mpmath.quad(lambda s: losses(s)[0], [low, high], maxdegree=5)
    return float(mu), float(P)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("pressure", "speed", "reduction"),
    [(1e4, 10.0, 0.3), (1e-3, 1e3, 1.0)],
)
def test_friction_of_rubber_over_decades(pressure: float, speed: float, reduction: float) -> None:
    """The pressure at which contact is lost lies within a share of 1e-20 to 1 of the first
    decade."""
    friction, area = by_mpmath(pressure, speed, reduction)
    theory = asp.theories.PerssonFriction(3e6, [3e9], [1e-5], *table(()), reduction)
    found = theory.at_speed([speed], pressure)
    assert found.friction[0] == pytest.approx(friction, rel=1e-8)
    assert found.area_fraction[0] == pytest.approx(area, rel=1e-8)


@pytest.mark.parametrize("more", THIN.values(), ids=THIN)
def test_friction_of_one_spectrum_in_several_tables(more: tuple[float, ...]) -> None:
    """0.0312790 of 10 m/s and 10 kPa, whatever the table."""
    q = np.array([2e3, *(2e3 * np.exp(np.array(more))), 2e6])
    psd = 1e-18 * (2.0 * np.pi) ** 2 * (q / 2e3) ** -3.6
    theory = asp.theories.PerssonFriction(3e6, [3e9], [1e-5], q, psd)
    assert theory.at_speed([10.0], 1e4).friction[0] == pytest.approx(0.0312790, abs=5e-8)
    for pressure, speed in ((1.0, 1e3), (1e7, 1e-3)):
        few = asp.theories.PerssonFriction(3e6, [3e9], [1e-5], q[[0, -1]], psd[[0, -1]]).at_speed([speed], pressure)
        found = theory.at_speed([speed], pressure)
        assert found.friction[0] == pytest.approx(few.friction[0], rel=1e-8)
        assert found.area_fraction[0] == pytest.approx(few.area_fraction[0], rel=1e-8)


def gap_by_mpmath(load: float, gamma: float) -> float:
    """Mean gap (m) at p/E*, from d ln q integrals of the theory as it is published (Yang & Persson
    2008), inner one closed by its parts."""
    q0, C0, power = mpmath.mpf(2e3), mpmath.mpf(4e-17), mpmath.mpf(2) / 5  # q³ C dq = q⁴ C d ln q grows as q^0.4

    def inner(x):
        tail = mpmath.quad(lambda t: mpmath.erf(t) ** 2 * mpmath.exp(-t * t) / t, [x, x + 1, x + 6]) if x < 6 else 0
        return gamma * mpmath.e1(x * x) / 2 + 3 * (1 - gamma) * tail

    def of(s):  # s = ln t: the integrand is smooth in it
        t = mpmath.exp(s)
        w = mpmath.sqrt(4 * mpmath.pi / (q0**4 * C0 * mpmath.expm1(power * t) / power))
        q = q0 * mpmath.exp(t)
        level = C0 * mpmath.exp(-mpmath.mpf(18) / 5 * t) / (2 * mpmath.pi) ** 2
        return mpmath.sqrt(mpmath.pi) * q**3 * level * w * inner(w * load) * t

    last = mpmath.log(mpmath.log(1000))
    return float(mpmath.quad(of, mpmath.linspace(last - 60, last, 16), maxdegree=5))


@pytest.mark.slow
@pytest.mark.parametrize("load", [1e-5, 0.3])
def test_mean_gap_over_decades_of_load(load: float) -> None:
    with mpmath.workdps(15):
        expected = gap_by_mpmath(load, 0.45)
    for more in THIN.values():
        spectrum = asp.theories.IsotropicSpectrum(*table(more))
        found = asp.theories.Persson(1e9, spectrum.rms_slope, *table(more), 0.45).at_pressure([load * 1e9])
        assert found.mean_gap[0] == pytest.approx(expected, rel=1e-8)


# All theories of the catalogue: panels that resolve what lies within 1e-9 of their ends change
# nothing.

PARTS = np.array(
    [0.0, *(10.0 ** -np.arange(9.0, 0.0, -2.0)), 0.3, 0.5, 0.7, *(1.0 - 10.0 ** -np.arange(1.0, 10.0, 2.0)), 1.0]
)
WHOLE = quadrature.gauss


def finer(breaks: np.ndarray, nodes: int) -> tuple[np.ndarray, np.ndarray]:
    """The rule on panels that are divided, ever finer towards both ends; tables of many panels are
    left as they are."""
    if np.shape(breaks)[-1] > 1000:
        return WHOLE(breaks, nodes)
    low, high = np.asarray(breaks)[..., :-1, None], np.asarray(breaks)[..., 1:, None]
    inner = (low + (high - low) * PARTS[:-1]).reshape(*np.shape(breaks)[:-1], -1)
    return WHOLE(np.concatenate([inner, np.asarray(breaks)[..., -1:]], axis=-1), nodes)


LEFT_OUT = {
    "blok-flash",
    "bush-gibson-keogh",
    "bush-gibson-thomas",
    "frictional-indenter",
    "frictional-punch",
    "greenwood-elliptic",
    "interacting-crests",
    "interacting-summits",
    "merging-summits",
    "jaeger-band",
    "jkr-coated-sphere",
    "moving-source",
    "onions-archard",
    "statistical-meniscus",
}
"""Theories whose scan takes a minute or more each, those that sum over summits, and one that
answers the place of a flat maximum, which has half of the digits."""
SCANNED = sorted(set(THEORIES) - LEFT_OUT)
SOUGHT = {"roughness-window"}
"""Theories that seek each answer by a hundred balances, each with the same integrals."""


ROUNDINGS = 8.0 * np.finfo(float).eps
"""Relative error of a separation to which Newton's method comes."""


def rounded(columns: dict[str, np.ndarray]) -> float:
    """Relative error of the pressure by the rounding of the separation that was found for it: the
    stiffness times that."""
    if not {"stiffness", "separation", "pressure"} <= columns.keys():
        return 0.0
    with np.errstate(all="ignore"):
        found = ROUNDINGS * np.abs(columns["stiffness"] * columns["separation"] / columns["pressure"])
    return float(np.nanmax(found[np.isfinite(found)], initial=0.0))


@pytest.mark.slow
@pytest.mark.parametrize("name", SCANNED)
def test_no_integral_misses_a_layer(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every parameter over twelve decades, what is asked over eight: finer panels give the same, or
    all is refused.

    1e-6 is a tenth of what the least exact of them, the adhesive summits of Fuller and Tabor,
    states of itself. Where a separation was found for a pressure, its rounding is more where the
    contact is stiff.
    """
    users = [
        module
        for key, module in sys.modules.items()
        if key.startswith("asperity.theories.") and hasattr(module, "gauss")
    ]
    given = EXAMPLES[name]
    changes = [{}] + [
        {key: np.asarray(value) * factor}
        for key, value in given.items()
        if not isinstance(value, str)
        for factor in (1e-6, 1e-3, 1e3, 1e6)
    ]
    compared = 0
    for change in changes:
        for way in ways_of(theory(name)) or (None,):
            for factor in (1.0, 1e-4, 1e4) if way else (1.0,):
                count = 2 if name in SOUGHT else 5
                asked = {} if way is None else {way.axis.name: factor * np.linspace(*RANGES[way.axis.name], count)}
                if way is not None:
                    asked |= {item.name: GIVEN[item.name] for item in way.given if item.required}
                found = []
                for rule in (WHOLE, finer):
                    for module in users:
                        monkeypatch.setattr(module, "gauss", rule)
                    try:
                        with warnings.catch_warnings(), np.errstate(all="ignore"):
                            warnings.simplefilter("ignore")
                            answer = evaluate(theory(name)(**given | change), **asked)
                    except (asp.InputError, asp.errors.NoSolutionError, asp.ConvergenceError):
                        break
                    found.append([np.atleast_1d(values).copy() for _, values in (*answer.numbers, *answer.columns)])
                else:
                    rounding = rounded({item.name: values for item, values in answer.columns})
                    for usual, fine in zip(*found, strict=True):
                        for values in (usual, fine):  # stiffness where no gap is left
                            values[np.abs(values) > 1e100] = np.inf
                        finite = np.abs(fine[np.isfinite(fine)])
                        least = 1e-12 * float(
                            finite.max(initial=0.0)
                        )  # Persson's gap next to full contact: a spline within 1e-13
                        close = pytest.approx(fine, rel=max(1e-6, rounding), abs=least, nan_ok=True)
                        assert usual == close, (change, asked)
                    compared += 1
    assert compared > 0
