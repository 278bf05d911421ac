"""Surfaces generated like the measured files: rms height, slopes and curvatures of the scan, and
its heights where asked for."""

import pytest

import asperity as asp
from asperity import roughness as r

FILES = (
    "afm_granular_film_10um_512.di",
    "afm_nodular_film_300nm_512.di",
    "afm_grainy_film_1um_256.007",
    "afm_storage_medium_10um_128.nid",
    "wli_126um_640x480.opd",
    "focusvar_88um_200x296.al3d",
)


def scan(shared_data, name):
    return asp.levelled(asp.filled(asp.read(shared_data / name)), "quadratic")


@pytest.mark.parametrize("name", FILES)
def test_moments_of_a_scan_are_those_of_what_is_generated_from_it(name, shared_data):
    """With all directions kept. The window weighs the middle of the scan, so heights agree as well
    as the scan is homogeneous."""
    seen = scan(shared_data, name)
    made = asp.generate.gaussian(seen.grid, asp.generate.spectrum_of(seen, isotropic=False), seed=1, variant="fixed")
    before, after = r.difference_moments(seen), r.difference_moments(made)
    assert after.m0 == pytest.approx(before.m0, rel=0.35)
    for moment in ("m2_x", "m2_y", "m4_x", "m4_y"):
        assert getattr(after, moment) == pytest.approx(getattr(before, moment), rel=0.3), moment
    assert f"spectrum of {name}" in made.origin.history[0]


def test_heights_and_spectrum_of_a_scan_at_once(shared_data):
    """The pits of a storage medium: skewness -1.9, which no Gaussian surface has."""
    seen = scan(shared_data, "afm_storage_medium_10um_128.nid")
    made = asp.generate.rank_ordered(
        seen.grid, asp.generate.spectrum_of(seen, isotropic=False), asp.generate.HeightsOf(seen), seed=1
    )
    before, after = r.height_parameters(seen), r.height_parameters(made)
    assert before.Ssk < -1.5
    assert after.Ssk == pytest.approx(before.Ssk, rel=1e-9)
    assert after.Sku == pytest.approx(before.Sku, rel=1e-9)
    assert after.Sq == pytest.approx(before.Sq, rel=0.1)


def test_isotropic_average_lies_between_both_directions(shared_data):
    seen = scan(shared_data, "afm_granular_film_10um_512.di")
    made = asp.generate.gaussian(asp.Grid((600, 600), (seen.dx, seen.dx)), asp.generate.spectrum_of(seen), seed=2)
    before, after = r.difference_moments(seen), r.difference_moments(made)
    assert before.m2_x < after.m2 < before.m2_y  # slow and fast scan direction
    assert after.m0 == pytest.approx(before.m0, rel=0.2)
