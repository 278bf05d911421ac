"""Working set of the array-API engine: a mask; vectors are arrays that are zero outside it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .library import Library, bound
from .protocol import NEAR_CAP, Load, Products


@dataclass(frozen=True, eq=False)
class ArrayFace:
    """Working set ``inside``; ``start`` is its residual."""

    library: Library
    inside: Any
    start: Any
    size: int
    entering: int

    def residual(self, *, centred: bool) -> Any:
        """Residual vector."""
        if not (centred and self.size):
            return self.start
        mean = self.library.numbers([self._sum(self.start)])[0] / self.size
        return self.library.select(self.inside, self.start - mean)

    def copied(self, vector: Any) -> Any:
        """``vector``, which nothing changes in place."""
        return vector

    def zeros(self) -> Any:
        """Vector of zeros."""
        return self.library.xp.zeros_like(self.start)

    def lay(self, values: Any, field: Any, added: float | None = None) -> None:
        """Lay ``values`` out in the field, or add to it."""
        field[...] = values if added is None else field + float(added) * values

    def press(self, p: Any, factor: float, scale: float) -> Any:
        """p = factor max(p, 0) and the change over scale."""
        value = self.library.select(self.inside & (p > 0.0), float(factor) * p)
        change = self.library.select(self.inside, value - p) / float(scale)
        self._put(value, p)
        return self.library.xp.astype(change, self.start.dtype)

    def lay_change(self, old: Any, values: Any, r: Any, field: Any) -> tuple[Any, float]:
        """Lay ``values`` - ``old`` out in the field."""
        change = self.library.xp.astype(self.library.select(self.inside, values - old), field.dtype)
        field[...] = change
        return change, self.library.numbers([self._sum(change * r)])[0]

    def gather(self, field: Any, a: Any, b: Any, out: Any) -> Products:
        """Vector of ``field``."""
        return self.products(self.library.select(self.inside, field), a, b)

    def products(self, vector: Any, a: Any, b: Any) -> Products:
        """``vector`` with its sum and its products with a and b."""
        sums = [self._sum(vector), self._sum(vector * a), self._sum(vector * b)]
        return Products(vector, *self.library.numbers(sums))

    def direct(self, z: Any, mean: float, ratio: float, t: Any, r: Any, field: Any) -> tuple[Any, float]:
        """(z - mean) + ratio t, laid out in the field."""
        t = self.library.select(self.inside, (z - float(mean)) + float(ratio) * t)
        field[...] = t
        return t, self.library.numbers([self._sum(t * r)])[0]

    def advance(self, length: float, t: Any, kt: Any, mean: float, d: Any, r: Any) -> tuple[Any, Any]:
        """d + length t and r - length (kt - mean)."""
        r = self.library.select(self.inside, r - float(length) * (kt - float(mean)))
        return d + float(length) * t, r

    def pick(self, values: Any) -> tuple[Any, float]:
        """``values`` on the face and their sum."""
        picked = self.library.select(self.inside, values)
        return picked, self.library.numbers([self._sum(picked)])[0]

    def blend(self, old: Any, share: float, values: Any) -> None:
        """values = old + share (values - old)."""
        self._put(old + float(share) * (values - old), values)

    def shift(self, p: Any, d: Any, scale: float) -> tuple[int, float]:
        """p += scale d."""
        library = self.library
        self._put(p + float(scale) * library.xp.astype(d, p.dtype), p)
        lacking = library.select(self.inside & (p < 0.0), -p)
        below, lack = library.numbers([library.count(lacking > 0.0), self._sum(lacking)])
        return int(below), lack

    def move(self, p: Any, d: Any, scale: float, cap: Any) -> tuple[Load, int]:
        """p += scale d, clipped."""
        library = self.library
        moved = p + float(scale) * library.xp.astype(d, p.dtype)
        value = library.select(moved > 0.0, moved)
        if cap is not None:
            value = library.xp.minimum(value, bound(library, cap, p))
        clipped = self.inside & (value != moved)
        self._put(value, p)
        return self._load(p, cap), int(library.numbers([library.count(clipped)])[0])

    def scale(self, p: Any, factor: float, shift: float, cap: Any) -> Load:
        """p = factor p + shift below the cap, clipped."""
        moved = float(factor) * p + float(shift)
        if cap is not None:
            most = bound(self.library, cap, p)
            moved = self.library.xp.where(moved < NEAR_CAP * most, moved, most)
            moved = self.library.xp.where(p < most, moved, p)
        self._put(moved, p)
        return self._load(p, cap)

    def _put(self, vector: Any, values: Any) -> None:
        values[...] = self.library.xp.where(self.inside, vector, values)

    def _load(self, p: Any, cap: Any) -> Load:
        below = self.inside if cap is None else self.inside & (p < bound(self.library, cap, p))
        sums = [self._sum(self.library.select(self.inside, p)), self._sum(self.library.select(below, p))]
        pressure, movable, number = self.library.numbers([*sums, self.library.count(below)])
        return Load(pressure, movable, int(number))

    def _sum(self, values: Any) -> Any:
        """Sum in double precision."""
        return self.library.xp.sum(values, dtype=self.library.xp.float64)
