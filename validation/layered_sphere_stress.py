"""Largest √J2 under a sphere that slides on a coated half-space: the nine numbers of fig. 2.5 of
Peng (2001)."""

from __future__ import annotations

import numpy as np
from page import Claim, Page, Published, Table, write_page
from sphere_on_layer import BASE, INDEPENDENT, RADIUS, THICKNESS

import asperity as asp
from asperity.theories import SphereYield

PRINTED = {
    0.5: ("0.27", "0.28", "0.38"),
    1.0: ("0.36", "0.37", "0.55"),
    2.0: ("0.50", "0.53", "0.80"),
}
"""E1/E2 -> largest √J2/p0 at μ = 0, 0.25 and 0.5, as printed beside the contours of fig. 2.5 of
Peng (2001)."""

FRICTIONS = (0.0, 0.25, 0.5)
WITHIN = 0.05
"""What counts as agreement: his values are read off his own grid and rounded to two digits, 2 % of
the smallest."""

DEPTHS = (0.0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.8, 0.9, 1.0, 1.1)
"""Over a0, which is the thickness of the layer."""

WIDTH = 2.4

ABOUT = (
    "Peng (2001, fig. 2.5; also O'Sullivan & King 1988, and Bhushan 1998, fig. 7): rigid sphere, R = 10 h, on "
    "a layer of h = a₀, ν = 0.3, with the shear traction μp; contours of √J2/p₀ in the plane y = 0 with the "
    "largest value printed beside each. Theirs: these nine published numbers. Ours: `asperity.solve` and "
    "`asperity.stress` with the free boundary on {pixels} × {pixels} pixels over {width:g} contact radii, "
    "{planes} planes from the surface to 1.1 a₀, both sides of the interface, pressure unaltered by friction "
    "as in the original."
)

WORDS = """* All nine agree within 5 %, eight within 2.5 %. The stiff layer raises the largest √J2, friction
  raises it and brings it to the surface, as printed.
* At μ = 0.5 the largest value lies at the edge of the contact on the surface, between the pixels, whose own
  values, 0.530 and 0.785 for E₁/E₂ = 1 and 2, are low by 4 and 5 %. On the edge it is 0.551 (closed form
  0.5523) and 0.826: the printed 0.80 of the stiff layer is 3 % low, as values at the points of a grid are."""


def compare(pixels: int = 129) -> Page:
    """Ours on ``pixels`` x ``pixels`` for every layer and friction coefficient of the figure."""
    rows, numbers = [], []
    for ratio, texts in PRINTED.items():
        result, p0 = _contact(ratio, pixels)
        cells = [f"{ratio:g}"]
        for friction, text in zip(FRICTIONS, texts, strict=True):
            value, depth = _largest(result, friction)
            cells += [text, f"{value / p0:.3f}", f"{depth / THICKNESS:.2f}"]
            what = f"largest √J2/p₀, E₁/E₂ = {ratio:g}, μ = {friction:g}"
            numbers.append(Published("Peng 2001, fig. 2.5", what, text, value / p0, within=WITHIN))
        rows.append(tuple(cells))
    onset = float(SphereYield(0.3).at_friction([0.0]).peak_over_k[0])
    head = ("E₁/E₂", *(text for f in FRICTIONS for text in (f"μ = {f:g}: theirs", "ours", "at z/a₀")))
    about = ABOUT.format(pixels=pixels, width=WIDTH, planes=len(DEPTHS))
    claims = (
        Claim("E₁/E₂ = 1, μ = 0: √J2/p₀ over the closed form of Hertz", numbers[3].ours * onset, 0.99, 1.01),
        Claim("numbers of fig. 2.5 that agree", sum(one.kept for one in numbers), 9, 9),
    )
    return Page(
        "Stresses under a sphere that slides on a coated half-space",
        about,
        (Table("Largest √J2/p₀:", head, tuple(rows)), WORDS),
        claims,
        tuple(numbers),
    )


def _contact(ratio: float, pixels: int) -> tuple[asp.ContactResult, float]:
    """The contact under the load at which Hertz's radius on the base is the thickness, and Hertz's
    pressure."""
    modulus = BASE.plane_strain_modulus
    pixel = WIDTH * INDEPENDENT[ratio][0] * THICKNESS / pixels
    surface = asp.generate.sphere(asp.Grid((pixels, pixels), (pixel, pixel)), radius=RADIUS)
    body = asp.Layered([asp.Layer(asp.Elastic(ratio * BASE.youngs_modulus, 0.3), THICKNESS)], BASE)
    problem = asp.ContactProblem(surface, body, boundary=asp.Free())
    load = asp.Force(4.0 / 3.0 * modulus * THICKNESS**3 / RADIUS)
    result = asp.solve(problem, load, keep=asp.Keep(stiffness=False))
    return result, 2.0 * THICKNESS * modulus / (np.pi * RADIUS)


def _largest(result: asp.ContactResult, friction: float) -> tuple[float, float]:
    """Largest √J2 in Pa, which lies in the plane y = 0, and its depth in m."""
    peak = asp.stress(result, np.array(DEPTHS) * THICKNESS, friction=friction).largest_sqrt_J2
    return peak.value, peak.depth


if __name__ == "__main__":
    write_page(compare(), __file__)
