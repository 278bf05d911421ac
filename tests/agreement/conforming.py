"""More rows of the agreement matrix: cylinders between flats, conforming contacts, and their
solutions."""

from __future__ import annotations

from agreement.matrix import ROUNDING, Agreement, apart, make

E, R = 1e11, 1e-3
"""Contact modulus (Pa) and radius (m) of the rows."""


def one_of_two_contacts(_: float) -> float:
    """Half-width and peak under 1 kN/m."""
    one, other = (make(name, E, R).at_load(1e3) for name in ("compressed-cylinder", "hertz-line"))
    return max(apart(one.radius, other.radius), apart(one.max_pressure, other.max_pressure))


CONFORMING = (
    Agreement(
        "compressed-cylinder",
        "hertz-line",
        "each of the two contacts",
        one_of_two_contacts,
        (),
        ROUNDING,
        "half-width and peak are Hertz's",
    ),
)
