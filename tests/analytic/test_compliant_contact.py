"""Half-spaces on an interface of normal compliance: a sphere against reference values, a small wave
in closed form, the hard limit."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference_data import Row, every_row, reference
from refusals import refused

import asperity as asp
from asperity.contact import CompliantContact, compliant_contact
from asperity.fem import CompliantInterface

BODY = asp.Elastic(0.91, 0.3)  # E* = 1


def sphere(pixels: int, stiffness: float, exponent: float) -> CompliantContact:
    """Radius 1 at an approach of its hundredth; the highest pixels lie beside the apex."""
    approach, side = 0.01, 0.32
    x = (np.arange(pixels) - 0.5 * (pixels - 1)) * side / pixels
    heights = -0.5 * (x[:, None] ** 2 + x**2)
    surface = asp.Surface(heights, side / pixels, side / pixels, periodic=False)
    problem = asp.ContactProblem(surface, BODY, boundary=asp.Free())
    return compliant_contact(problem, CompliantInterface(stiffness, exponent), approach + float(heights.max()))


@every_row(reference("missing/normal_compliance_sphere"))
def test_spheres_of_reference(row: Row) -> None:
    """Rings, extrapolated. Loads fall to theirs with the square of the pixel, areas are counted."""
    exponent = row["m_n"]
    stiffness = row["stiffness_number"] / (0.01**exponent * 10.0)
    coarse, fine = (sphere(pixels, stiffness, exponent) for pixels in (64, 128))
    hertz = 4.0 / 3.0 * 0.01**1.5
    assert fine.force / hertz == pytest.approx(row["P_over_P_hertz"], rel=5e-5)
    assert (4.0 * fine.force - coarse.force) / 3.0 / hertz == pytest.approx(row["P_over_P_hertz"], rel=4e-5)
    assert fine.pressure.max() * math.pi / 0.2 == pytest.approx(row["p0_over_p0_hertz"], rel=1e-3)
    assert math.sqrt(fine.area / math.pi) / 0.1 == pytest.approx(row["a_over_a_hertz"], rel=2e-3)
    assert fine.residuals[-1] < 1e-10


def test_a_small_wave_on_a_compressed_interface() -> None:
    """p̂ = ĥ/(ĉ + 1/k) with k = c m w^(m-1) of the mean compression."""
    grid = asp.Grid((32, 4), (1.0 / 32, 0.25))
    law, mean, amplitude = CompliantInterface(40.0, 2.0), 0.1, 1e-6
    wave = asp.generate.sinusoid(grid, amplitude=amplitude, wavelength=1.0)
    problem = asp.ContactProblem(wave, BODY)
    found = compliant_contact(problem, law, mean + float(problem.profile().max()))
    swing = 0.5 * np.ptp(found.pressure[:, 0])
    spring = 40.0 * 2.0 * mean
    assert swing == pytest.approx(0.5 * np.ptp(problem.profile()) / (1.0 / math.pi + 1.0 / spring), rel=1e-4)


def test_a_hard_interface_leads_to_the_contact_without_one() -> None:
    """What is missing falls as the root of the compliance."""
    grid = asp.Grid((32, 32), (1.0 / 32, 1.0 / 32))
    surface = asp.generate.sinusoid(grid, amplitude=0.01, wavelength=1.0)
    problem = asp.ContactProblem(surface, BODY, boundary=asp.Free())
    wanted = asp.solve(problem, asp.Approach(0.005)).force
    missing = [
        wanted - compliant_contact(problem, CompliantInterface(stiffness, 2.0), 0.005).force for stiffness in (1e6, 1e8)
    ]
    assert missing[1] > 0.0
    assert missing[0] / missing[1] == pytest.approx(10.0, rel=0.2)


def test_what_the_interface_does_not_know_is_refused() -> None:
    surface = asp.Surface(np.zeros((4, 4)), 1.0, 1.0, periodic=True)
    for more in ({"friction": asp.Coulomb(0.3)}, {"law": asp.Hardness(0.5)}):
        with refused(asp.InputError, "problem of a compliant interface"):
            compliant_contact(asp.ContactProblem(surface, BODY, **more), CompliantInterface(1.0, 2.0), 0.1)


def test_without_an_approach_there_is_nothing_to_press() -> None:
    problem = asp.ContactProblem(asp.Surface(np.zeros((4, 4)), 1.0, 1.0, periodic=True), BODY)
    with refused(asp.InputError, "approach of the interface (m)"):
        compliant_contact(problem, CompliantInterface(1.0, 2.0), 0.0)
