"""von Mises stress under a uniformly loaded patch on a layered body, with friction: fig. 3.10 of
Peng (2001)."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from page import Claim, Page, Table, write_page

import asperity as asp

RATIOS = (0.5, 1.0, 2.0)
FRICTIONS = (0.0, 0.25, 0.5)
SIDE = 0.078
"""Side of the patch; lengths are in units of the thickness of the layer, forces in units of the
load."""

POINTS = 41
PLACES = (-16, -8, -4, -2, 0, 2, 4, 8, 16)
"""Pixels from the middle of the patch along the surface, in the direction of the shear traction."""

BESIDE = 4
"""Pixels to the vertical line of the figure, x = 0.3."""

DEPTHS = (0.0, 0.1, 0.2, 0.4, 0.6, 1.0, 1.5, 2.0)

ABOUT = (
    "Peng (2001, fig. 3.10; also Peng & Bhushan 2002): a unit force on a square patch of the side 0.078 on a "
    "layer of unit thickness with E₁/E₂ = 0.5, 1 and 2, shear traction μp along x; profiles of √J2 on the "
    "surface (y = z = 0) and down from x = 0.3, y = 0. Published are the curves, of which the text at hand "
    "has only the axes (10⁻² to 10³ on the surface, 0 to 2 below), and what the text says of them. Ours: "
    "`asperity.stress` under prescribed tractions (`LoadedBody` with a `PatchLoad`), free boundary, ν = 0.3 "
    "chosen freely."
)

WORDS = """* As published: at μ = 0 the profiles are symmetric and the largest value on the surface lies under
  the patch; friction makes them asymmetric and larger, most of all below the patch near the surface. Along z
  the layer hardly changes the shape of the profile but for a jump at the interface, where the materials
  differ.
* For E₁ = E₂ the stress is that of Love's closed form for the homogeneous half-space.
* All values lie within the printed axes."""


def compare(points: int = POINTS) -> Page:
    """Ours on ``points`` x ``points`` patches."""
    found = {(ratio, friction): profiles(ratio, friction, points) for ratio in RATIOS for friction in FRICTIONS}
    middle = points // 2
    surface = [
        (f"{ratio:g}", f"{friction:g}", *(f"{along[middle + k]:.3g}" for k in PLACES))
        for (ratio, friction), (along, _) in found.items()
    ]
    below = [
        (f"{ratio:g}", f"{friction:g}", *(f"{value:.3g}" for value in down))
        for (ratio, friction), (_, down) in found.items()
    ]
    places = [f"{k * SIDE:.2f}".replace("-", "−") for k in PLACES]
    depths = [f"{z:g}" + side for z in DEPTHS for side in (("⁻", "⁺") if z == 1.0 else ("",))]
    tables = (
        Table("√J2 on the surface, at x:", ("E₁/E₂", "μ", *places), tuple(surface)),
        Table("√J2 below x = 0.3, at z (both sides of the interface):", ("E₁/E₂", "μ", *depths), tuple(below)),
    )
    return Page("Stresses under a patch on a layered body", ABOUT, (*tables, WORDS), tuple(_claims(found, middle)))


def profiles(ratio: float, friction: float, points: int) -> tuple[np.ndarray, np.ndarray]:
    """√J2 along x on the surface (points,), and below x = 0.3 at ``DEPTHS``, both sides of the
    interface."""
    grid = asp.Grid((points, points), (SIDE, SIDE))
    middle = points // 2 * SIDE
    ends = (middle - 0.5 * SIDE, middle + 0.5 * SIDE)
    patch = asp.stresses.PatchLoad(x=ends, y=ends, pressure=SIDE**-2, shear=(friction * SIDE**-2, 0.0))
    base = asp.Elastic(1.0, 0.3)
    body = asp.Layered([asp.Layer(asp.Elastic(ratio, 0.3), 1.0)], base)
    loaded = asp.stresses.LoadedBody(body, asp.stresses.Tractions.of(grid, patch, boundary="free"))
    surface = asp.stress(loaded, [0.0], on=asp.stresses.Section(y=middle)).sqrt_J2[0]
    line = asp.stress(loaded, DEPTHS, on=asp.stresses.DepthProfile(middle + BESIDE * SIDE, middle)).sqrt_J2
    return surface, line


def _claims(found: dict[tuple[float, float], tuple[np.ndarray, np.ndarray]], middle: int) -> list[Claim]:
    even = max(float(np.abs(found[ratio, 0.0][0] / found[ratio, 0.0][0][::-1] - 1.0).max()) for ratio in RATIOS)
    top = [int(np.argmax(found[ratio, friction][0])) - middle for ratio in RATIOS for friction in FRICTIONS]
    growth = min(
        float(found[ratio, more][0].max() / found[ratio, less][0].max())
        for ratio in RATIOS
        for less, more in pairwise(FRICTIONS)
    )
    interface = DEPTHS.index(1.0)
    jumps = {
        ratio: abs(found[ratio, 0.0][1][interface + 1] / found[ratio, 0.0][1][interface] - 1.0) for ratio in RATIOS
    }
    values = np.concatenate([found[key][0] for key in found])
    return [
        Claim("μ = 0: largest asymmetry of the profile on the surface", even, high=1e-6),
        Claim(
            "largest distance of the maximum on the surface from the patch, pixels", float(np.abs(top).max()), 0.0, 1.0
        ),
        Claim("smallest growth of the maximum on the surface from one μ to the next", growth, 1.0),
        Claim("jump of √J2 at the interface, E₁ = E₂", jumps[1.0], high=1e-6),
        Claim("smallest jump of √J2 at the interface, E₁/E₂ = 0.5 and 2", min(jumps[0.5], jumps[2.0]), low=0.15),
        Claim(
            "E₁ = E₂, μ = 0: √J2 in the middle of the patch over Love's closed form",
            found[1.0, 0.0][0][middle] / love(),
            0.9999,
            1.0001,
        ),
        Claim("largest √J2 on the surface, on the printed axis", float(values.max()), 1e-2, 1e3),
        Claim("smallest √J2 within x = ±1.5, on the printed axis", float(values.min()), 1e-3, 1e3),
    ]


def love(poisson: float = 0.3) -> float:
    """√J2 on the surface in the middle of a square under unit force: σxx = σyy = -(1/2 + ν) p,
    σzz = -p, for which √J2 = |1/2 - ν| p/√3."""
    return abs(0.5 - poisson) / math.sqrt(3.0) / SIDE**2


if __name__ == "__main__":
    write_page(compare(), __file__)
