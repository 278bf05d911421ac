"""Where a liquid film stands between deformed surfaces, and the force of its menisci (Tian &
Bhushan 1996; Peng 2001)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from ...contact.measure import Labels, labelled, spans
from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError
from ...core.quantity import measured
from ...solids.library import Liquid
from ...theories.wet.meniscus import adsorbed_water_film, kelvin_radius, laplace_pressure, wetting_factor

FLOODED = 0.95
"""Share of the nominal area under liquid or in contact from which an interface counts as
flooded."""


@dataclass(frozen=True, kw_only=True)
class LiquidFilm:
    """A film of liquid on one of two surfaces before they meet.

    Parameters
    ----------
    surface_tension
        γ in N/m, > 0.
    thickness
        h_f in m, > 0: volume of liquid per nominal area. Where the gap is not larger, there is
        liquid.
    meniscus_height
        h_m in m, >= h_f: gap at the rim of a meniscus. The thickness by default.
    contact_angles
        (θ1, θ2) in rad on the two surfaces; 0 on the one that carries the film.
    viscosity
        In Pa s, NaN where not known; for the viscous part of friction only.
    shear_strength
        Shear stress in Pa that the liquid bears at most; infinite by default.
    feedback
        Whether the menisci press the surfaces together. If not, their force is that in the gap of
        the load alone, and no part of what the contact carries.

    Raises
    ------
    InputError
        If a number is out of its range, or the liquid does not wet.
    """

    surface_tension: float
    thickness: float
    meniscus_height: float = math.nan
    contact_angles: tuple[float, float] = (0.0, 0.0)
    viscosity: float = math.nan
    shear_strength: float = math.inf
    feedback: bool = True
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhushan1998", "Peng2001", "TianBhushan1996")

    def __post_init__(self) -> None:
        require.positive(self.surface_tension, "surface tension of a film (N/m)")
        require.positive(self.thickness, "thickness of a film (m)", "For a dry contact leave the film out.")
        if math.isnan(self.meniscus_height):
            object.__setattr__(self, "meniscus_height", self.thickness)
        if not require.finite(self.meniscus_height, "meniscus height (m)") >= self.thickness:
            raise InputError(
                f"meniscus height (m) must be at least the thickness {self.thickness:g} of the film, but is "
                f"{self.meniscus_height:g}."
            )
        wetting_factor(*require.two(self.contact_angles, "contact angles (rad)"))
        for value, what in ((self.viscosity, "viscosity (Pa s)"), (self.shear_strength, "shear strength (Pa)")):
            if not (math.isnan(value) or value > 0.0):
                raise InputError(f"{what} of a film must be greater than zero, but is {value:g}.")

    @classmethod
    def of(
        cls,
        liquid: Liquid,
        thickness: float,
        *,
        meniscus_height: float = math.nan,
        contact_angles: tuple[float, float] = (0.0, 0.0),
        feedback: bool = True,
    ) -> Self:
        """Film of ``liquid`` with a given thickness and meniscus height in m."""
        return cls(
            surface_tension=liquid.surface_tension,
            thickness=thickness,
            meniscus_height=meniscus_height,
            contact_angles=contact_angles,
            viscosity=liquid.viscosity,
            feedback=feedback,
        )

    @classmethod
    def at_humidity(
        cls,
        liquid: Liquid,
        humidity: float,
        *,
        thickness: float = math.nan,
        contact_angles: tuple[float, float] = (0.0, 0.0),
    ) -> Self:
        """Film of ``liquid`` in equilibrium with its vapour of the relative ``humidity``, a
        fraction of one.

        h_m = r_K (cos θ1 + cos θ2), at least the thickness. Without ``thickness`` in m that of
        water adsorbed on carbon is taken (see ``adsorbed_water_film``).

        Raises
        ------
        InputError
            If the molar volume of the liquid is not known, or the thickness of a liquid other than
            water not given.
        """
        volume = liquid.require_molar_volume()
        if math.isnan(thickness):
            if not liquid.adsorbs_as_water:
                raise InputError(
                    f"thickness of the film must be given for {liquid.name or 'this liquid'}: only that of "
                    "water follows from the humidity."
                )
            thickness = adsorbed_water_film(humidity)
        height = kelvin_radius(humidity, liquid.surface_tension, volume, liquid.temperature)
        height *= wetting_factor(*contact_angles)
        return cls.of(liquid, thickness, meniscus_height=max(height, thickness), contact_angles=contact_angles)

    @property
    def suction(self) -> float:
        """Pressure deficit Δp = γ(cos θ1 + cos θ2)/h_m in Pa in the menisci."""
        return laplace_pressure(self.surface_tension, self.meniscus_height, wetting_factor(*self.contact_angles))


@dataclass(frozen=True, eq=False)
class Wetting:
    """Where liquid stands, counted in pixels; fields are (nx, ny).

    Attributes
    ----------
    wetted
        Gap not larger than the film; contact included.
    cut
        Gap not larger than the meniscus height (the cross-cut area); contact included.
    kept
        Islands of ``cut`` that hold at least one wetted pixel: the others touch no liquid.
    menisci
        ``kept`` without contact: where liquid bridges the gap.
    filled
        Share of each pixel that the suction acts on: 1 in ``menisci`` and 0 elsewhere, but for the
        pixels at the jump in which forces balance (see ``between``).
    labels
        Number of the island of each pixel of ``kept``, zero elsewhere.
    n_islands, n_menisci
        Number of islands of ``cut``, and of those kept.
    regime
        ``dry``: no meniscus; ``toe-dipping``: menisci around single summits; ``pillbox``: one of
        them reaches across the map; ``flooded``: liquid or contact on more than 95 % of the area
        (Matthewson & Mamin 1988, in terms of islands).
    """

    wetted: BoolArray = measured("1", "whether the gap is in the film", "x", "y")
    cut: BoolArray = measured("1", "whether the gap is not larger than the meniscus height", "x", "y")
    kept: BoolArray = measured("1", "whether a point is in an island that holds liquid", "x", "y")
    menisci: BoolArray = measured("1", "whether a meniscus bridges the gap", "x", "y")
    filled: RealArray = measured("1", "share of the point that the suction acts on", "x", "y")
    labels: Labels = measured("1", "number of the island that holds liquid", "x", "y")
    n_islands: int = measured("1", "number of islands up to the meniscus height")
    n_menisci: int = measured("1", "number of menisci")
    regime: str = measured("", "how the liquid stands")
    citation_keys: ClassVar[tuple[str, ...]] = ("Matthewson1988", "TianBhushan1996")

    def share(self, name: str) -> float:
        """Share of the nominal area of the field ``name``."""
        return float(np.mean(getattr(self, name)))

    @property
    def partly(self) -> BoolArray:
        """(nx, ny), True where a pixel is under liquid in part: at the jump of the meniscus force
        in which forces balance."""
        return np.not_equal(self.filled, self.menisci)

    @property
    def full(self) -> bool:
        """Whether liquid or contact fills nearly all of the interface."""
        return float(self.kept.mean()) >= FLOODED

    def filled_at(self, pixels: Sequence[int] | Labels, shares: Sequence[float] | RealArray) -> Wetting:
        """The same with these ``shares``, 0 to 1, of the ``pixels`` under liquid, which are counted
        along the rows of the map."""
        filled = np.array(self.filled)
        filled.flat[np.asarray(pixels, dtype=np.intp)] = shares
        dry = self.regime == "dry" and bool(filled.any())
        regime = ("flooded" if self.full else "toe-dipping") if dry else self.regime
        return replace(self, filled=filled, regime=regime)


def wetting(
    gap: RealArray, contact: BoolArray, film: LiquidFilm, *, wraps: tuple[bool, bool], diagonal: bool = False
) -> Wetting:
    """Find the menisci in a ``gap`` (nx, ny) in m with the pixels in ``contact``.

    The film is not redistributed: there is liquid where the gap is not larger than its thickness,
    and a meniscus on every island of gaps up to the meniscus height that holds such a pixel.

    Parameters
    ----------
    gap, contact
        Gap of the deformed surfaces in m, and where they touch.
    film
        Liquid, thickness, meniscus height.
    wraps
        Whether the map goes on across its border along x and along y.
    diagonal
        Whether pixels that share a corner only belong to one island; no by default; the sources
        leave it open.
    """
    wetted = (gap <= film.thickness) | contact
    cut = (gap <= film.meniscus_height) | contact
    labels, count = labelled(cut, wraps=wraps, diagonal=diagonal)
    holds = np.zeros(count + 1, dtype=bool)
    holds[labels[wetted]] = True
    kept = holds[labels]
    # liquid that bridges the gap: a contact with no other pixel around it holds no meniscus
    menisci = kept & ~contact
    numbers = np.where(kept, np.cumsum(holds)[labels], 0)
    regime = "pillbox" if spans(numbers, wraps=wraps).any() else "toe-dipping"
    if not menisci.any():
        regime = "dry"
    elif kept.mean() >= FLOODED:
        regime = "flooded"
    return Wetting(wetted, cut, kept, menisci, menisci.astype(float), numbers, count, int(holds.sum()), regime)


def between(here: Wetting, there: Wetting, share: float) -> Wetting:
    """``here`` with this ``share``, 0 to 1, of the way to ``there``: pixels under liquid in one of
    them alone hold it in part.

    The forces of a contact may balance between the two, where pixels at the edge of contact or at
    the height of the menisci change sides.
    """
    pixels = np.flatnonzero(here.menisci != there.menisci)
    wet = here.menisci.flat[pixels]
    return here.filled_at(pixels, np.where(wet, 1.0 - share, share))
