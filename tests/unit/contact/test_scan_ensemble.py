"""Contact of surfaces that many scans describe, with an error bar, and the waves that decide it."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference_data import FOLDER, reference
from refusals import refused

import asperity as asp
from asperity.contact.scan_ensemble import (
    deciding_waves_of,
    ensemble_contact,
    spectrum_table,
)
from asperity.core.errors import InputError
from asperity.surfaces import Scan, Scans
from asperity.surfaces.characterise.scans_spectrum import ScansSpectrum

BODY = asp.Elastic(1e11, 0.3)


@pytest.fixture(scope="module")
def spectrum() -> ScansSpectrum:
    heights = np.load(FOLDER / "profiles/scans.npz")
    rows = reference("profiles/scans_truth")
    scans = [Scan(heights[f"A_{row['scan']}"], float(row["spacing_m"]), name=str(row["scan"])) for row in rows]
    return Scans(scans).spectrum(corner="rounded")


def problem(surface: asp.Surface) -> asp.ContactProblem:
    return asp.ContactProblem(surface, BODY)


def test_table_holds_the_spectrum_of_the_scans(spectrum: ScansSpectrum) -> None:
    one, two = spectrum_table(spectrum), spectrum_table((spectrum, spectrum))
    assert one.profile_moments == pytest.approx(spectrum.moments(), rel=5e-3)  # power laws between 30 points a decade
    assert two.profile_moments == pytest.approx(2.0 * np.array(one.profile_moments), rel=1e-12)
    with refused(InputError, "spectra of the surfaces"):
        spectrum_table(())


def test_question_of_scan_size_and_interval_is_answered(spectrum: ScansSpectrum) -> None:
    found = deciding_waves_of(spectrum, BODY.plane_strain_modulus, 1e7, hardness=5e9)
    named = {item.criterion for item in found.findings(1e-3, 4e-8)}
    assert "waves of the mean gap" in named  # the longest scan holds three roll-off lengths
    assert "waves of the real area" not in named  # plastic flow settles it before the shortest wave
    assert found.needs["area"].shortest > spectrum.shortest_wavelength


def test_error_bar_holds_scatter_and_spectrum(spectrum: ScansSpectrum) -> None:
    grid = asp.Grid((32, 32), (16e-6, 16e-6))
    found = ensemble_contact(spectrum, problem, 2e7, grid=grid, realisations=4, seed=1)
    for answer in found.answers.values():
        assert answer.mean > 0.0
        assert answer.spectrum_error > 0.0
        assert answer.error == pytest.approx(math.hypot(answer.scatter / 2.0, answer.spectrum_error), rel=1e-12)
    # the theory is within a third of elasticity for the area (see Persson)
    m2 = spectrum.moments(32e-6)[1]
    theory = math.erf(2e7 / (BODY.plane_strain_modulus * math.sqrt(m2)))
    assert found.answers["area_fraction"].mean == pytest.approx(theory, rel=0.5)
    assert found.area_with_short_waves < found.answers["area_fraction"].mean
    assert {item.criterion for item in found.findings} >= {"short waves", "long waves"}
    assert found.slope_shown == pytest.approx(m2 / spectrum.moments()[1], rel=1e-9)


def test_equal_seeds_give_equal_answers(spectrum: ScansSpectrum) -> None:
    grid = asp.Grid((16, 16), (32e-6, 32e-6))
    one, two, other = (
        ensemble_contact(spectrum, problem, 2e7, grid=grid, realisations=2, seed=seed).answers for seed in (1, 1, 2)
    )
    assert one == two
    assert one != other
    with refused(InputError, "number of realisations", "1"):
        ensemble_contact(spectrum, problem, 2e7, grid=grid, realisations=1, seed=1)
