"""Stresses and yielding of a contact as it wears: the largest of each layer and of the base, at the
contacts that were kept."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np

from ...contact.result import ContactResult
from ...core import require
from ...core.arrays import RealArray
from ...core.quantity import Quantity, measured
from ...core.status import NoProgress, Progress
from ..stress.regions import regions
from ..stress.survey import StressRequest, StressSurvey, survey
from ..stress.yielding import RegionYield
from .geometry import thickness

OF_LAYERS = (
    Quantity("von_mises", "Pa", "largest von Mises stress √(3 J2) in the layer"),
    Quantity("von_mises_error", "Pa", "error of the largest von Mises stress in the layer by the pixels"),
    Quantity("tension", "Pa", "largest tension (σ₁) in the layer"),
    Quantity("utilisation", "1", "largest equivalent stress / yield stress of the layer"),
    Quantity("x", "m", "x of the largest equivalent stress in the layer"),
    Quantity("y", "m", "y of the largest equivalent stress in the layer"),
    Quantity("depth", "m", "depth of the largest equivalent stress in the layer"),
    Quantity("yielded_volume", "m**3", "volume of the layer beyond its yield stress"),
)
"""What is known of each layer and of the base."""


@dataclass(frozen=True, eq=False)
class WornStresses:
    """Largest stresses of one body of a contact that wears, by layer from the surface down.

    Attributes
    ----------
    way
        (n,): distances in m, of fretting cycles, of the contacts.
    coating
        (n,) in m: thickness of all layers with which the stresses are computed: the mean of what is
        left of them under the pressure, as of the compliance.
    layers
        Names of the m layers of the virgin body, the last its base unless that is rigid.
    values
        Arrays (n, m) by the names in ``OF_LAYERS``; NaN in a layer that is gone, and of the
        utilisation where no strength is known. Positions are in the middle of a pixel, depths from
        the worn surface.
    criterion
        Name of the criterion of yield.
    """

    way: RealArray = measured("", "distance (m) or cycles of the contacts", "kept")
    coating: RealArray = measured("m", "thickness of all layers with which stresses are computed", "kept")
    layers: tuple[str, ...] = measured("", "layer, from the surface down", "worn_layer")
    values: Mapping[str, RealArray] = measured("", "stresses by layer", "kept", "worn_layer", columns=OF_LAYERS)
    criterion: str = measured("", "criterion of yield")

    def __getitem__(self, name: str) -> RealArray:
        """(n, m): values of the quantity ``name`` by contact and layer."""
        return self.values[require.one_of(name, self.values, "quantity of the stresses of a contact that wears")]

    @property
    def load_factor(self) -> RealArray:
        """(n,): factor on the stresses at which the first layer begins to yield; NaN where no
        strength is known."""
        known = np.fmax.reduce(self.values["utilisation"], axis=1)
        return np.asarray(np.divide(1.0, known, out=np.full(known.shape, math.inf), where=known != 0.0))

    @property
    def yields(self) -> RealArray:
        """(n, m): whether the layer yields."""
        return np.asarray(self.values["utilisation"] >= 1.0)

    def yields_from(self, layer: int) -> float:
        """Way after which the ``layer`` first yields, by interpolation; NaN where it does not."""
        return _crossed(self.way, self.values["utilisation"][:, layer])

    def yields_until(self, layer: int) -> float:
        """Way after which the ``layer`` yields no more; infinite where it still does at the end,
        NaN where it never has."""
        used, way = self.values["utilisation"][:, layer], self.way
        over = np.flatnonzero(used >= 1.0)
        if not over.size:
            return math.nan
        left = np.flatnonzero(np.isfinite(used))
        if over[-1] == left[-1]:  # at the end, or until it is worn away
            return math.inf if left[-1] == len(way) - 1 else float(way[left[-1]])
        return _crossed(way[::-1], used[::-1])


def stresses_of(
    kept: Sequence[tuple[float, ContactResult]],
    layers: tuple[str, ...],
    request: StressRequest,
    threads: int | None = None,
    progress: Progress = NoProgress(),
) -> WornStresses:
    """Stresses of the ``request`` in the ``kept`` contacts of a body of these ``layers``."""
    rows: dict[str, list[RealArray]] = {item.name: [] for item in OF_LAYERS}
    coating = []
    for number, (_, contact) in enumerate(kept, start=1):
        body = getattr(contact.problem, request.of)
        coating.append(thickness(body))
        found = _of_contact(survey(request, contact, lines=False, threads=threads), contact)
        gone = len(layers) - len(found["x"])  # uppermost layers, which are worn away
        for name, row in found.items():
            rows[name].append(np.concatenate([np.full(gone, math.nan), row]))
        progress.update(number, 1.0 - number / len(kept), 0.0)
    return WornStresses(
        np.array([way for way, _ in kept], float),
        np.array(coating),
        layers,
        {name: np.array(row) for name, row in rows.items()},
        request.criterion.name,
    )


def layer_names(body: object) -> tuple[str, ...]:
    """Names of the layers of a ``body`` and of its base; neighbours of one name, as of a graded
    coating, are one."""
    return tuple(name for name, _ in groupby(region.name for region in regions(body)))


def _of_contact(found: StressSurvey, contact: ContactResult) -> dict[str, RealArray]:
    """``OF_LAYERS`` of one contact, (m,) each, of the layers that are left."""
    spacing = contact.problem.grid.spacing
    rows = []
    for _, run in groupby(zip(found.maxima, found.yielding.regions, strict=True), key=lambda pair: pair[0].region.name):
        parts, yielding = zip(*run, strict=True)
        highest = max((part.von_mises for part in parts), key=lambda peak: peak.value)
        used = [part.peak.value / part.limit.value for part in yielding]
        worst = yielding[int(np.nanargmax(used))] if np.isfinite(used).any() else max(yielding, key=_stressed)
        rows.append(
            (
                highest.value,
                highest.error,
                max(part.tension.value for part in parts),
                worst.peak.value / worst.limit.value,
                worst.peak.x + 0.5 * spacing[0],
                worst.peak.y + 0.5 * spacing[1],
                worst.peak.depth,
                sum(part.yielded_volume for part in yielding),
            )
        )
    return {item.name: np.array(column) for item, column in zip(OF_LAYERS, zip(*rows, strict=True), strict=True)}


def _stressed(part: RegionYield) -> float:
    return part.peak.value


def _crossed(way: RealArray, used: RealArray) -> float:
    """Where ``used`` first reaches one along the ``way``, by interpolation between contacts; NaN
    where it does not."""
    over = np.flatnonzero(used >= 1.0)
    if not over.size:
        return math.nan
    first = int(over[0])
    if first == 0 or not math.isfinite(used[first - 1]):
        return float(way[first])
    share = (1.0 - used[first - 1]) / (used[first] - used[first - 1])
    return float(way[first - 1] + share * (way[first] - way[first - 1]))
