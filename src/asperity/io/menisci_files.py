"""Menisci in result files: their numbers as JSON, the pixels under liquid in part with them; all else follows from gap, contact and film."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from ..core.arrays import RealArray
from ..core.quantity import Labelled, Quantity
from ..physics.menisci.coupling import Menisci
from ..physics.menisci.film import LiquidFilm, Wetting, wetting
from ..physics.menisci.quantities import WET_FIELDS, WET_SCALARS
from .description import describe, rebuild

NUMBERS = ("external_force", "meniscus_force", "dry_friction", "viscous_force", "feedback")
"""Numbers of the menisci that do not follow from contact and film."""

_PIXELS, _SHARES = "partly_pixels", "partly_filled"


def menisci_text(menisci: Menisci) -> str:
    """``NUMBERS`` as JSON, and which pixels, counted along the rows of the map, hold liquid on what share of them."""
    numbers = {name: describe(getattr(menisci, name)) for name in NUMBERS}
    pixels = np.flatnonzero(menisci.wetting.partly)
    if pixels.size:
        numbers |= {_PIXELS: pixels.tolist(), _SHARES: menisci.wetting.filled.flat[pixels].tolist()}
    return json.dumps(numbers)


def menisci_from(text: str, film: LiquidFilm, gap: RealArray, pressure: RealArray, wraps: tuple[bool, bool]) -> Menisci:
    """Menisci of a ``film`` from their ``text`` and the ``gap`` (m) and ``pressure`` (Pa), both (nx, ny).

    Raises
    ------
    ValueError
        If a pixel in part under liquid is none of the map, or its share not between 0 and 1.
    """
    stored = json.loads(text)
    pixels, shares = stored.pop(_PIXELS, []), stored.pop(_SHARES, [])
    stands = wetting(gap, pressure > 0.0, film, wraps=wraps)
    if pixels:
        stands = _filled(stands, pixels, np.asarray(shares, dtype=float))
    return Menisci(film, stands, **{name: rebuild(value) for name, value in stored.items()})


def _filled(stands: Wetting, pixels: Sequence[int], shares: RealArray) -> Wetting:
    if not all(isinstance(pixel, int) and 0 <= pixel < stands.filled.size for pixel in pixels):
        raise ValueError(f"{_PIXELS}: they are not all pixels of the map")
    if shares.shape != (len(pixels),) or not ((shares >= 0.0) & (shares <= 1.0)).all():
        raise ValueError(f"{_SHARES}: they are not {len(pixels)} numbers between 0 and 1")
    return stands.filled_at(pixels, shares)


def menisci_group(menisci: Menisci) -> tuple[tuple[Labelled, ...], dict[str, str]]:
    """Values and attributes of the group of the film."""
    fields = (Labelled(item, getattr(menisci.wetting, item.name)) for item in WET_FIELDS)
    scalars = (Labelled(item, getattr(menisci, item.name)) for item in WET_SCALARS)
    return (*fields, *scalars), {"menisci": menisci_text(menisci), "regime": menisci.wetting.regime}


def menisci_columns(found: Sequence[Menisci]) -> Iterator[Labelled]:
    """Scalars and text of the menisci of every step."""
    if not found:
        return
    for item in WET_SCALARS:
        named = replace(item, name=f"film_{item.name}", dims=("step",))
        yield Labelled(named, np.asarray([getattr(menisci, item.name) for menisci in found]))
    texts = Quantity("menisci", "", "numbers of the menisci, as JSON", dims=("step",))
    yield Labelled(texts, np.asarray([menisci_text(menisci) for menisci in found]))
