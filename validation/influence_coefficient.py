"""Centre of a uniformly loaded square patch on a coated half-space against layer thickness: fig.
3.9 of Peng (2001)."""

from __future__ import annotations

from side_by_side import Comparison, Pair, write

import asperity as asp
from asperity.solids.compliance.halfspace import contact_compliance

THICKNESSES = (0.01, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 12.8, 100.0)
"""h over the side of the patch."""

INDEPENDENT = {
    0.5: (1.00866, 1.08163, 1.16275, 1.41969, 1.65957, 1.82139, 1.92753, 1.97163, 1.99637),
    2.0: (0.99374, 0.95193, 0.90508, 0.76364, 0.65053, 0.57830, 0.53169, 0.51240, 0.50159),
}
"""E1/E2 -> u_z/u_z0 for each of ``THICKNESSES``: polar Fourier quadrature of the layered response,
6 digits."""

BASE = asp.Elastic(200e9, 0.3)
SIDE = 1e-7


def compare() -> Comparison:
    """Ours: the influence coefficient of a pixel on itself."""
    rows = tuple(
        ((f"{thickness:g}",), tuple(_pair(ratio, thickness, values[k]) for ratio, values in INDEPENDENT.items()))
        for k, thickness in enumerate(THICKNESSES)
    )
    return Comparison(
        title="Influence coefficient of a square patch on a coated half-space",
        about=(
            "Displacement at the centre of a uniformly loaded square of side Δ over that on the base alone, "
            "ν₁ = ν₂ = 0.3 (Peng 2001, fig. 3.9). Independent solution of our own: polar Fourier quadrature, "
            "six digits. Ours: what the free boundary uses."
        ),
        cases=("h/Δ",),
        quantities=tuple(f"E₁/E₂ = {ratio:g}" for ratio in INDEPENDENT),
        rows=rows,
        agreement=(1e-5, 1e-5),
    )


def _pair(ratio: float, thickness: float, expected: float) -> Pair:
    pixel = asp.Grid((1, 1), (SIDE, SIDE))
    layer = asp.Layer(asp.Elastic(ratio * BASE.youngs_modulus, 0.3), thickness * SIDE)
    coated, bare = (
        contact_compliance(body, asp.Rigid()).influence(pixel)[0, 0] for body in (asp.Layered([layer], BASE), BASE)
    )
    return Pair(coated / bare, expected)


if __name__ == "__main__":
    write(compare(), __file__)
