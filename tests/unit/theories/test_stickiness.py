"""Criteria of stickiness against the reference, and from a map against its closed form."""

from __future__ import annotations

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.physics.adhesion.stickiness import stickiness
from asperity.theories.adhesion.stickiness import stickiness_of


@every_row(reference("adhesion/rough_stickiness"), label=lambda row: f"case{row['case']:g}")
def test_rows_of_the_reference(row):
    found = stickiness_of(
        row["h_rms_slope"],
        row["h_rms_laplacian_per_m"],
        row["U_el_full_J_per_m2"],
        E_star=row["E_star_Pa"],
        work=row["w_J_per_m2"],
        reach=row["range_m"],
    )
    assert found.repulsive_diameter == pytest.approx(row["d_rep_m"], rel=1e-12)
    assert found.number == pytest.approx(row["pr_number"], rel=1e-12)
    assert found.share_of_limit == pytest.approx(row["pr_number_over_threshold"], rel=1e-12)
    assert found.effective_work / row["w_J_per_m2"] == pytest.approx(row["w_eff_over_w_persson_tosatti"], rel=1e-10)


def test_one_wave_in_closed_form():
    n, length, amplitude, E_star, work = 32, 1e-5, 1e-8, 1e9, 0.05
    x = np.arange(n) * length / n
    heights = amplitude * np.cos(2.0 * np.pi * x / length)[:, None] * np.ones(n)
    body = asp.Elastic(E_star * (1.0 - 0.3**2), 0.3)
    law = asp.ExponentialAdhesion(work, 1e-9)
    found = stickiness(asp.ContactProblem(asp.Surface(heights, length / n), body, adhesion=law))
    q = 2.0 * np.pi / length
    slope, laplacian = (amplitude * q**order / np.sqrt(2.0) for order in (1, 2))
    full = 0.25 * E_star * q * 0.5 * amplitude**2  # (E*/4) q <h²>
    expected = stickiness_of(slope, laplacian, full, E_star=E_star, work=work, reach=1e-9)
    assert found.number == pytest.approx(expected.number, rel=1e-12)
    assert found.effective_work == pytest.approx(expected.effective_work, rel=1e-12)

    # without range any roughness is sticky, and full contact costs the same
    short = stickiness(
        asp.ContactProblem(asp.Surface(heights, length / n), body, adhesion=asp.adhesion.JKRAdhesion(work))
    )
    assert short.number == 0.0
    assert short.effective_work == found.effective_work


def test_what_has_no_criterion_is_refused():
    body, law = asp.Elastic(1e9, 0.3), asp.ExponentialAdhesion(0.05, 1e-9)
    flat = asp.Surface(np.zeros((8, 8)), 1e-6)
    with refused(InputError, "profile of the stickiness"):
        stickiness(asp.ContactProblem(flat, body, adhesion=law))
    with refused(InputError, "problem of the stickiness"):
        stickiness(asp.ContactProblem(flat, body))
    with refused(InputError, "rms slope"):
        stickiness_of(0.0, 1.0, 1.0, E_star=1e9, work=0.05, reach=1e-9)
