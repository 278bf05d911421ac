"""Conditions of validity common to several theories."""

from __future__ import annotations

import math

import numpy as np

from .protocol import Limit, Prediction
from .statistics.nayak import NARROWEST, ROUNDING

SMALL_AREA = 0.1
"""Area fraction up to which contacts count as independent; a few per cent are safe, narrow spectra bear 0.2."""

BLUNT = 0.1
"""Height deviation over radius of summits up to which the Hertz contacts stay small against their radius."""

GENTLE = 0.3
"""Rms gradient beyond which the half-space theory errs by more than about a tenth (its square)."""


def area_limit(prediction: Prediction, high: float = SMALL_AREA, citation: str = "Greenwood1966") -> Limit:
    """Contacts few enough for their elastic interaction to be negligible."""
    message = "Contacts deform each other and merge; the theory lets them stand alone."
    return Limit("area fraction", prediction.area_fraction, -math.inf, high, citation, message)


def constant_limit(
    criterion: str, value: float, bounds: tuple[float, float], *, prediction: Prediction, citation: str, message: str
) -> Limit:
    """Limit of a number that is the same along the whole curve of ``prediction``."""
    return Limit(criterion, np.full(len(prediction), value), *bounds, citation, message)


def blunt_summits(prediction: Prediction, roughness_ratio: float) -> Limit:
    """Summits whose heights vary little against their radius."""
    return constant_limit(
        "height deviation over radius of summits",
        roughness_ratio,
        (0.0, BLUNT),
        prediction=prediction,
        citation="Greenwood1966",
        message="Contacts become as large as their radius of curvature; Hertz's parabola no longer describes the summits.",
    )


def gentle_slopes(prediction: Prediction, rms_gradient: float) -> Limit:
    """Slopes small enough for the theory of the half-space."""
    return constant_limit(
        "rms gradient",
        rms_gradient,
        (0.0, GENTLE),
        prediction=prediction,
        citation="Johnson1985",
        message="The theory of the half-space neglects the square of the slopes.",
    )


def isotropic_bandwidth(prediction: Prediction, alpha: float) -> Limit:
    """Nayak's parameter of an isotropic Gaussian surface."""
    return constant_limit(
        "bandwidth alpha",
        alpha,
        (NARROWEST * (1.0 - ROUNDING), math.inf),
        prediction=prediction,
        citation="Nayak1971",
        message="No isotropic Gaussian surface has such moments; the map is anisotropic, not Gaussian or not resolved.",
    )
