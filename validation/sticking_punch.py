"""Flat punch without slip, named in the lectures of Yastrebov (2016): the gain of Mossakovskii and
Spence from kernels of displacement alone."""

from __future__ import annotations

import math

import numpy as np
from page import Claim, Page, Published, Table, write_page

import asperity as asp
from asperity.theories import StickingPunch

POISSON = (0.0, 0.3, 0.4)

ABOUT = (
    "The lectures (Yastrebov 2016) name frictional indentation, circular punches with full stick among it, "
    "after Mossakovskii (1954) and Spence (1968, 1975), without numbers. Theirs: their closed form P = 4Gaδ "
    "ln(3 − 4ν)/(1 − 2ν) over that without friction, 4Gaδ/(1 − ν). Ours: the three tractions on the pixels of "
    "a circle, {points} along its diameter, that displace all of them by δ downwards and not sideways, found "
    "with nothing but displacements of `asperity.stress` under prescribed tractions, over the same with "
    "pressure alone. No parameter is chosen. Finite friction (Spence 1975) is the theory `frictional-punch`."
)

WORDS = """* The gain of the closed form, which is that of the theory `sticking-punch`, is found within the
  error of the pixels at the edge, where tractions are singular; it falls with their size.
* On an incompressible body (ν = 0.5) shear and pressure do not act upon each other, and there is no gain: the
  note of the lectures on (1 − 2ν)/G."""


def compare(points: int = 96) -> Page:
    """Ours with ``points`` pixels along the diameter."""
    source = "Spence 1968, named in the lectures"
    theirs = {nu: StickingPunch(1.0, 1.0, beta(nu)).gain for nu in POISSON}
    ours = {nu: gain(nu, points) for nu in POISSON}
    coarse = gain(POISSON[0], points // 2)
    rows = tuple((f"{nu:g}", f"{theirs[nu]:.4f}", f"{ours[nu]:.4f}") for nu in POISSON)
    table = Table(
        "Load over that without friction at the same approach:", ("ν", "closed form", "from displacements"), rows
    )
    off = [1.0 - ours[nu] / theirs[nu] for nu in POISSON]
    claims = (
        Claim("largest deviation from the closed form", max(map(abs, off)), high=0.1 / points),
        Claim(
            "ν = 0: deviation over that with pixels of twice the size", off[0] / (1.0 - coarse / theirs[0.0]), 0.3, 0.7
        ),
        Claim("ν = 0.5: gain less one", gain(0.5, points // 4) - 1.0, -1e-6, 1e-6),
    )
    numbers = tuple(
        Published(source, f"gain of a punch that sticks, ν = {nu:g}", f"{theirs[nu]:.4f}", ours[nu])
        for nu in POISSON[:2]
    )
    return Page("Flat punch that sticks", ABOUT.format(points=points), (table, WORDS), claims, numbers)


def beta(nu: float) -> float:
    """Dundurs' second parameter of a rigid punch on a body of Poisson's ratio ``nu``."""
    return (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu))


def gain(nu: float, points: int) -> float:
    """Load of the punch that sticks over that of the one that slides freely, ``points`` pixels
    along the diameter."""
    width = 2.04 / points
    grid = asp.Grid((points, points), (width, width))
    under = np.hypot(*grid.centred_coordinates()) < 1.0
    body = asp.Elastic(1.0, nu)
    return _load(body, grid, under, sticks=True) / _load(body, grid, under, sticks=False)


def _load(body: asp.Elastic, grid: asp.Grid, under: np.ndarray, *, sticks: bool) -> float:
    """Sum of the pressures that displace the pixels ``under`` the punch by one, sideways by nothing
    if it ``sticks``."""
    from scipy.sparse.linalg import LinearOperator, gmres

    count, parts = int(under.sum()), 3 if sticks else 1

    def displaced(unknowns: np.ndarray) -> np.ndarray:
        fields = np.zeros((3, *grid.shape))
        fields[:parts, under] = unknowns.reshape(parts, count)
        tractions = asp.stresses.Tractions(grid, fields[0], asp.stresses.ShearTraction(fields[1], fields[2]), "free")
        moved = asp.stress(asp.stresses.LoadedBody(body, tractions), [0.0], displacement=True).displacement
        assert moved is not None
        return np.concatenate([part[0][under] for part in (moved.z, moved.x, moved.y)[:parts]])

    wanted = np.concatenate([np.ones(count), np.zeros((parts - 1) * count)])
    operator = LinearOperator((parts * count, parts * count), matvec=displaced)
    solution, left = gmres(operator, wanted, rtol=1e-7, restart=200)
    if left:
        raise ArithmeticError("the tractions under the punch do not converge")
    return math.fsum(solution[:count])


if __name__ == "__main__":
    write_page(compare(), __file__)
