"""Bush, Gibson & Thomas (1975): all summits of an isotropic Gaussian surface, each an elliptical Hertz contact."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Self

from numpy.typing import ArrayLike

from ..core import require
from .limits import area_limit, gentle_slopes, isotropic_bandwidth
from .mccool import MOMENTS
from .protocol import E_STAR, Input, Limit, Prediction, curve
from .roughness import Roughness
from .summit_contacts import SummitContacts, circular_shapes, elliptic_shapes

ASYMPTOTE = math.sqrt(2.0 * math.pi)
"""A_r/A_a E* h'_rms/p at vanishing load, for every bandwidth; h'_rms = sqrt(2 m2)."""


@dataclass(frozen=True)
class _OnSummits:
    """What theories have in common that differ by the shape of the contact on a summit only: their ``_contacts`` do it."""

    E_star: float
    m0: float
    m2: float
    m4: float

    def __post_init__(self) -> None:
        require.positive(self.E_star, "contact modulus E_star (Pa)")
        self._contacts()

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float) -> Self:
        """Theory for the moments of ``roughness``."""
        return cls(E_star, roughness.m0, roughness.m2, roughness.m4)

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m from the mean plane of the surface."""
        return self._contacts().at_separation(curve(separation, "separations (m)"))

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa, see ``SummitContacts.at_pressure``."""
        return self._contacts().at_pressure(curve(pressure, "pressures (Pa)", positive=True))

    def validity(self, prediction: Prediction) -> tuple[Limit, ...]:
        """Few contacts, gentle slopes, moments of an isotropic surface."""
        return _validity(self._contacts(), prediction)

    def _contacts(self) -> SummitContacts:
        raise NotImplementedError


@dataclass(frozen=True)
class BushGibsonThomas(_OnSummits):
    """Elliptical contacts on all summits of an isotropic Gaussian surface.

    The area tends to sqrt(2π) p/(E* h'_rms) at vanishing load, very slowly for wide spectra (Carbone & Bottiglione
    2008). ``SummitContacts`` holds the integrals.

    Parameters
    ----------
    E_star
        Contact modulus in Pa.
    m0, m2, m4
        Moments of an isotropic Gaussian surface, see ``NayakSummits``.

    Raises
    ------
    InputError
        If a parameter is not positive or m0 m4/m2² < 1.5.
    """

    E_star: float
    m0: float
    m2: float
    m4: float
    name: ClassVar[str] = "bush-gibson-thomas"
    title: ClassVar[str] = "Bush-Gibson-Thomas"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bush1975", "Carbone2008", "Nayak1971")
    inputs: ClassVar[tuple[Input, ...]] = (E_STAR, *MOMENTS)

    def _contacts(self) -> SummitContacts:
        return SummitContacts(self.E_star, self.m0, self.m2, self.m4, elliptic_shapes())


@dataclass(frozen=True)
class GreenwoodElliptic(_OnSummits):
    """Greenwood's simplified elliptic model: on every summit a circle of the geometric mean curvature sqrt(κ1 κ2).

    Area and load are within 2 % and 3 % of ``BushGibsonThomas`` at the same separation, and the limit at vanishing load
    is the same.

    Parameters
    ----------
    E_star, m0, m2, m4
        As for ``BushGibsonThomas``.

    Raises
    ------
    InputError
        If a parameter is not positive or m0 m4/m2² < 1.5.
    """

    E_star: float
    m0: float
    m2: float
    m4: float
    name: ClassVar[str] = "greenwood-elliptic"
    title: ClassVar[str] = "Greenwood's simplified elliptic model"
    citation_keys: ClassVar[tuple[str, ...]] = ("Greenwood2006", "Nayak1971")
    inputs: ClassVar[tuple[Input, ...]] = (E_STAR, *MOMENTS)

    def _contacts(self) -> SummitContacts:
        return SummitContacts(self.E_star, self.m0, self.m2, self.m4, circular_shapes())


def _validity(contacts: SummitContacts, prediction: Prediction) -> tuple[Limit, ...]:
    return (
        area_limit(prediction, citation="Carbone2008"),
        gentle_slopes(prediction, math.sqrt(2.0 * contacts.m2)),
        isotropic_bandwidth(prediction, contacts.alpha),
    )
