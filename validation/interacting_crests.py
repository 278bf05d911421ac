"""The published system of interacting sinusoidal crests, which counts the displacement by a crest's
own load twice."""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np
from page import Claim, Page, Table, write_page

import asperity as asp
from asperity.theories.rough.interacting_crests import CrestSystem, InteractingCrests

PIXEL, POINTS = 8e-9, 160
RADIUS, MODULUS, APPROACH = 1e-6, 1e11, 8e-9
PLACES = np.array([[40, 40], [96, 44], [48, 104], [112, 112]])
HEIGHTS = np.array([0.0, -1e-9, -2e-9, -5e-10])
AREA = (POINTS * PIXEL) ** 2

ABOUT = (
    "Greenwood and Williamson's contact with sinusoidal crests that press each other down is published as a "
    "system in which the approach of every crest is its Hertzian approach ω_i plus the displacements F_j/(π "
    "E* r_ij) by the loads on all crests, its own with the contact radius as distance. The Hertzian approach "
    "is the displacement of the centre of the contact by its own load already. Here both systems, and "
    "boundary elements, for four smooth bumps five contact radii apart, all of radius 1 µm on a body of E* = "
    "100 GPa, at an approach of 8 nm."
)


class PublishedSystem(CrestSystem):
    """The equations with F_i/(π E* a_i) added to ω_i."""

    def own_approach(self, w: np.ndarray) -> np.ndarray:
        """ω_i + F_i/(π E* a_i) in m."""
        return super().own_approach(w) + (8.0 / 3.0 * self.A1 + 64.0 / 15.0 * self.A2 * w) * w / math.pi

    def own_slope(self, w: np.ndarray) -> np.ndarray:
        """Its derivative to w_i in 1/m."""
        return super().own_slope(w) + (8.0 / 3.0 * self.A1 + 128.0 / 15.0 * self.A2 * w) / math.pi


class PublishedCrests(InteractingCrests):
    """``InteractingCrests`` with the published equations."""

    equations: ClassVar[type[CrestSystem]] = PublishedSystem


def crests(kind: type[InteractingCrests], shape: str, wavelength: float, interaction: str) -> InteractingCrests:
    """The four bumps."""
    x, y = PIXEL * PLACES.T.astype(float)
    depth = np.full(4, wavelength**2 / (2.0 * np.pi**2 * RADIUS))
    return kind(MODULUS, x, y, HEIGHTS, depth, np.full(4, wavelength), AREA, interaction=interaction, shape=shape)


def solved(shape: str, wavelength: float) -> asp.ContactResult:
    """The same bumps by boundary elements with a free boundary."""
    x = PIXEL * np.arange(POINTS)
    r2 = [(x[:, None] - PIXEL * i) ** 2 + (x[None, :] - PIXEL * j) ** 2 for i, j in PLACES]
    depth = wavelength**2 / (2.0 * np.pi**2 * RADIUS)
    if shape == "paraboloid":
        drops = [d / (2.0 * RADIUS) for d in r2]
    else:
        drops = [0.5 * depth * (1.0 - np.cos(np.minimum(2.0 * np.pi * np.sqrt(d) / wavelength, np.pi))) for d in r2]
    heights = np.max([z - drop for z, drop in zip(HEIGHTS, drops, strict=True)], axis=0)
    body = asp.Elastic(MODULUS, 0.0)
    return asp.solve(asp.ContactProblem(asp.Surface(heights, PIXEL), body, boundary=asp.Free()), asp.Approach(APPROACH))


CASES = {
    "far field": (InteractingCrests, "far field", (0.99, 1.01)),
    "without interaction": (InteractingCrests, "off", (1.2, 1.35)),
    "as published": (PublishedCrests, "far field", (0.6, 0.7)),
}
"""Equations, interaction and bounds of the load over that of the boundary elements."""


def page() -> Page:
    """The page."""
    rows, claims = [], []
    for shape, wavelength in (("paraboloid", 1e-6), ("sine", 8e-7)):
        result = solved(shape, wavelength)
        for name, (kind, interaction, (low, high)) in CASES.items():
            theory = crests(kind, shape, wavelength, interaction)
            found = theory.at_separation(theory.highest - APPROACH)
            load = float(found.pressure[0]) * AREA / result.force
            area = float(found.area_fraction[0]) * AREA / result.contact_area
            rows.append((shape, name, f"{load:.4f}", f"{area:.3f}"))
            claims.append(Claim(f"load of {shape} crests, {name}, over boundary elements", load, low, high))
    head = ("shape", "equations", "load / boundary elements", "area / boundary elements")
    reading = (
        "**Reading.** Point forces between crests reproduce the boundary elements; the term of the own load "
        "makes each crest more compliant than it is, and the load a third too small. The package offers the "
        "first two."
    )
    return Page(
        title="Interacting crests: the published system against boundary elements",
        about=ABOUT,
        parts=(Table("", head, tuple(rows)), reading),
        claims=tuple(claims),
    )


if __name__ == "__main__":
    write_page(page(), __file__)
