"""Figures of load paths and of plastic zones show the numbers they claim to show."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

import asperity as asp
from asperity import plots


@pytest.fixture(scope="module")
def path() -> asp.HistoryResult:
    noise = np.random.default_rng(7).standard_normal((24, 16))
    heights = sum(np.roll(noise, (i, j), (0, 1)) for i in range(3) for j in range(3)) * 1e-9
    problem = asp.ContactProblem(
        asp.Surface(heights, 2e-8, 1e-8, periodic=True), asp.Elastic(1e11, 0.3), law=asp.Hardness(3e9)
    )
    return asp.solve(problem, asp.History(asp.contact.ramps(asp.MeanPressure, [4e8, 0.0, 5e8], steps=3)))


def axes():
    return Figure().add_subplot()


def lines(ax):
    return [(line.get_label(), *(np.asarray(v) for v in line.get_data())) for line in ax.lines]


def test_load_against_approach(path):
    ax = plots.plot_load_loop(path, axes())
    (first, x1, y1), (second, x2, y2), (third, x3, y3) = lines(ax)
    assert (first, second, third) == ("loading", "unloading", "loading 2")
    np.testing.assert_allclose(x1, [0.0, *(path.approach[:3] * 1e9)])
    np.testing.assert_allclose(y1, [0.0, *(path.mean_pressure[:3] / 1e6)])
    np.testing.assert_allclose(x2, path.approach[2:6] * 1e9)
    np.testing.assert_allclose(y3, path.mean_pressure[5:] / 1e6)
    assert x2[-1] == x3[0] > 0.0  # what is left
    assert y2[-1] == 0.0
    assert ax.get_xlabel() == "approach from first touch (nm)"
    assert ax.get_ylabel() == "mean pressure (MPa)"


def test_area_against_load(path):
    ax = plots.plot_area_loop(path, axes())
    _, x, y = lines(ax)[0]
    np.testing.assert_allclose(x, [0.0, *(path.mean_pressure[:3] / 1e6)])
    np.testing.assert_allclose(y, [0.0, *(100.0 * path.area_fraction_corrected[:3])])


def test_a_path_that_goes_on_starts_with_its_first_step(path):
    rest = asp.solve(
        path.steps[0].problem, asp.History([asp.MeanPressure(2e8), asp.MeanPressure(1e8)]), state=path.steps[-1].state
    )
    ((name, x, _),) = lines(plots.plot_area_loop(rest, axes()))
    assert name == "unloading"
    np.testing.assert_allclose(x, [200.0, 100.0])


def test_energies(path):
    found = {name: y for name, _, y in lines(plots.plot_energies(path, axes()))}
    balance = path.energies
    scale = found["plastic work"][-1] / balance.plastic_work[-1]
    np.testing.assert_allclose(found["external work ∫F dδ"], scale * balance.external_work)
    np.testing.assert_allclose(found["elastic energy"], scale * balance.elastic_energy)
    np.testing.assert_allclose(found["elastic + plastic"], found["elastic energy"] + found["plastic work"])


def test_plastic_zone_and_residual_surface(path):
    result = path.steps[-1]
    zone = np.ma.filled(plots.plot_indentation(result, axes()).images[0].get_array(), np.nan).T
    np.testing.assert_array_equal(np.isnan(zone), ~result.indented)
    np.testing.assert_allclose(np.nanmax(zone), result.max_permanent_indentation * 1e9, rtol=1e-9)
    left = np.asarray(plots.plot_residual(result, axes()).images[0].get_array()).T
    heights = result.residual_surface().heights
    np.testing.assert_allclose(left, (heights - heights.mean()) * 1e9, rtol=1e-9)


def test_only_indented_results_have_figures_of_it(path, elastic, tmp_path: Path, monkeypatch):
    monkeypatch.setattr("asperity.plots.picture.png", lambda *_, **__: b"")
    names = {plot.name for plot in plots.PLASTIC_PLOTS}
    plastic = {file.stem for file in asp.plots.save_plots(path.steps[-1], tmp_path / "a")}
    assert names <= plastic
    assert {file.stem for file in asp.plots.save_plots(elastic, tmp_path / "b")} == plastic - names


def test_files_of_a_path(path, tmp_path: Path):
    files = asp.plots.save_path_plots(path, tmp_path)
    assert [file.stem for file in files] == [plot.name for plot in plots.PATH_PLOTS]
    assert all(file.read_bytes().startswith(b"\x89PNG") for file in files)
