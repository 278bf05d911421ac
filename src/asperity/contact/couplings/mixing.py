"""Extrapolation of the smooth unknowns of a fixed-point iteration (Anderson 1965)."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...core.arrays import RealArray

REMEMBERED = 3
"""Rounds before the last that an extrapolation uses. Three take as few rounds as six (sliding, layered hardness)."""

_RCOND = 1e-8


@dataclass
class Mixing:
    """The last unknowns and steps, each of them a tuple with one array for every coupling."""

    places: list[tuple[RealArray, ...]] = field(default_factory=list)
    moves: list[tuple[RealArray, ...]] = field(default_factory=list)

    def ahead(
        self, place: tuple[RealArray, ...], move: tuple[RealArray, ...], scales: tuple[float, ...]
    ) -> tuple[RealArray, ...]:
        """Where the iteration that steps from ``place`` by ``move`` would come to rest if it were linear.

        ``scales`` are the sizes of a step of each unknown by which steps are compared.
        """
        self.places = [*self.places[-REMEMBERED:], place]
        self.moves = [*self.moves[-REMEMBERED:], move]
        used = min(len(self.places) - 1, sum(part.size for part in place))
        if used == 0:
            return tuple(at + by for at, by in zip(place, move, strict=True))

        def scaled(parts: tuple[RealArray, ...]) -> RealArray:
            return np.concatenate([np.ravel(part) / scale for part, scale in zip(parts, scales, strict=True)])

        latest = scaled(move)
        changes = np.stack([latest - scaled(earlier) for earlier in self.moves[-1 - used : -1]], axis=1)
        weights, *_ = np.linalg.lstsq(changes, latest, rcond=_RCOND)
        found = []
        for number, (at, by) in enumerate(zip(place, move, strict=True)):
            total = at + by
            for weight, x, f in zip(weights, self.places[-1 - used : -1], self.moves[-1 - used : -1], strict=True):
                total = total - weight * (at + by - x[number] - f[number])
            found.append(total)
        return tuple(found)

    def forget(self) -> None:
        """Begin anew: what was remembered no longer tells where the iteration leads."""
        self.places.clear()
        self.moves.clear()
