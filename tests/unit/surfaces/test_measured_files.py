"""The six measured files: size, pixels, units, missing points and roughness as documented with the
data."""

from pathlib import Path

import pytest
from refusals import refused

from asperity.core.errors import FileFormatError
from asperity.surfaces.characterise.heights import kurtosis, peak_to_valley, rms_height, skewness
from asperity.surfaces.characterise.slopes import rms_slope
from asperity.surfaces.prepare.level import levelled
from asperity.surfaces.read import channels, read

# file: shape, size (m), missing, rms after mean/plane/quadratic (m), peak-valley (m), rms slope,
# skewness, kurtosis
FILES = {
    "afm_granular_film_10um_512.di": (
        (512, 512), (10e-6, 10e-6), 0, (16.85e-9, 14.32e-9, 14.29e-9), 112e-9, 0.223, 0.55, 3.39,
    ),
    "afm_nodular_film_300nm_512.di": (
        (512, 512), (300e-9, 300e-9), 0, (24.72e-9, 10.96e-9, 8.86e-9), 62e-9, 1.73, 0.10, 2.76,
    ),
    "afm_grainy_film_1um_256.007": (
        (256, 256), (1e-6, 1e-6), 0, (2.46e-9, 2.42e-9, 2.38e-9), 18.2e-9, 0.378, 0.36, 2.87,
    ),
    "afm_storage_medium_10um_128.nid": (
        (128, 128), (10e-6, 10e-6), 0, (31.85e-9, 27.10e-9, 26.99e-9), 189e-9, 0.129, -1.88, 6.69,
    ),
    "wli_126um_640x480.opd": (
        (640, 480), (125.91e-6, 94.43e-6), 116, (8.36e-9, 6.71e-9, 6.50e-9), 112e-9, 0.018, -0.37, 4.54,
    ),
    "focusvar_88um_200x296.al3d": (
        (200, 296), (87.61e-6, 129.66e-6), 0, (7688e-9, 289.8e-9, 259.2e-9), 2.09e-6, 0.090, -0.00, 3.07,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", FILES)
def test_documented_values(name, shared_data):
    shape, size, missing, rms, valley, slope, skew, kurt = FILES[name]
    surface = read(shared_data / name)
    assert surface.shape == shape
    assert surface.size == pytest.approx(size, rel=1e-4)
    assert surface.n_missing == missing
    assert not surface.periodic
    # tolerances are half a unit of the last printed digit
    for form, expected in zip(("mean", "plane", "quadratic"), rms, strict=True):
        assert rms_height(levelled(surface, form)) == pytest.approx(expected, rel=2.5e-3)
    plane = levelled(surface)
    assert peak_to_valley(plane) == pytest.approx(valley, rel=9e-3)
    assert rms_slope(plane) == pytest.approx(slope, rel=4e-3)
    assert skewness(plane) == pytest.approx(skew, abs=5.1e-3)
    assert kurtosis(plane) == pytest.approx(kurt, abs=5.1e-3)
    assert surface.origin.source == name
    assert surface.citation_keys == ("Roettger2022",)
    assert all(isinstance(value, str) for value in surface.origin.instrument.values())


def test_channels_of_a_file_with_four(shared_data):
    path = shared_data / "afm_granular_film_10um_512.di"
    listed = channels(path)
    assert [info.name for info in listed] == ["Height", "Height", "Phase", "AmplitudeError"]
    assert [info.default for info in listed] == [True, False, False, False]
    assert listed[0].size == pytest.approx((10e-6, 10e-6), rel=1e-9)
    assert listed[0].unit == "nm"
    assert rms_height(read(path, channel=0)) == rms_height(read(path, channel="Height"))
    assert rms_height(read(path, channel=1)) != rms_height(read(path, channel=0))


def test_truncated_and_misused_instrument_files(tmp_path, shared_data):
    path = shared_data / "afm_storage_medium_10um_128.nid"
    cut = tmp_path / "cut.nid"
    cut.write_bytes(path.read_bytes()[:45000])
    with refused(FileFormatError, f"file {cut}", "CorruptFile"):
        read(cut)
    with refused(FileFormatError, f"channel of file {path}", "'Phase'"):
        read(path, channel="Phase")
    with refused(FileFormatError, f"size of file {path}", "size"):
        read(path, size=(1e-6, 1e-6))
    with refused(FileFormatError, f"height unit of file {path}", "height_unit"):
        read(path, height_unit="nm")
    with refused(FileFormatError, f"z_scale of file {path}", "z_scale"):
        read(path, z_scale=1e-9)
    path = shared_data / "afm_granular_film_10um_512.di"
    for given in ({}, {"height_unit": "nm"}):  # a phase is no height, whatever unit is given
        with refused(FileFormatError, f"channel 'Phase' of file {path}", "0 = 'Height', 1 = 'Height'"):
            read(path, channel="Phase", **given)


@pytest.mark.parametrize("name", FILES)
def test_a_quarter_of_every_file_is_refused_in_one_sentence(name, tmp_path, shared_data, capfd):
    content = (shared_data / name).read_bytes()
    cut = tmp_path / f"quarter{Path(name).suffix}"
    cut.write_bytes(content[: len(content) // 4])
    with refused(FileFormatError, f"file {cut}") as caught:
        read(cut)
    assert len(str(caught.value)) < 600
    captured = capfd.readouterr()
    assert captured.out == captured.err == ""  # the readers that were tried must not write to the terminal
