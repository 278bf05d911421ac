"""Theories beside the numerical solution: exact cases, deviations, limits, what is left out,
files."""

from __future__ import annotations

import csv
import json
import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest
from contact_cases import TIGHT, elastic
from matplotlib.figure import Figure
from refusals import refused
from scipy.special import erf

import asperity as asp
from asperity import generate
from asperity.plots.comparison import LABEL_ROOM, NEAREST, OTHERS, SIZE, nearest, plot_comparison_area
from asperity.report.comparison import comparison_sentence
from asperity.theories import Limit, Prediction, Westergaard, theory
from asperity.theories.protocol import prediction

E_STAR = 100e9
STEEL = asp.Elastic(E_STAR * (1.0 - 0.3**2), 0.3, asp.Strength(hardness=5e9))


@pytest.fixture(scope="module")
def film() -> asp.Surface:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.1), hurst=0.8, rolloff_wavelength=0.4e-6, shortest_wavelength=0.12e-6
    )
    return asp.generate.gaussian(asp.Grid((64, 64), (20e-9, 20e-9)), spectrum, seed=1)


@pytest.fixture(scope="module")
def compared(film: asp.Surface) -> asp.studies.Comparison:
    """The whole catalogue at four loads."""
    return asp.compare(film, STEEL, np.array([0.08, 0.01, 0.02, 0.04]) * 0.1 * E_STAR)


def test_the_nearest_curves_are_named_at_their_ends_apart_and_never_alike(compared: asp.studies.Comparison) -> None:
    ax = Figure(figsize=SIZE).add_subplot()
    data = compared.dataset
    plot_comparison_area(data, ax)
    named = nearest(data)
    assert len(named) == NEAREST
    assert sorted(text.get_text() for text in ax.texts) == sorted(["numerical", *named])
    assert ax.get_legend() is None
    places = sorted(text.get_position()[1] for text in ax.texts)
    assert np.diff(places).min() >= LABEL_ROOM - 1e-9
    looks = [
        (line.get_color(), line.get_linestyle()) for line in ax.lines if line.get_color() not in (OTHERS, "#000000")
    ]
    assert len(looks) == len(set(looks)) == NEAREST


def test_curves_end_at_the_limits_of_their_theories(compared: asp.studies.Comparison) -> None:
    ax = Figure(figsize=SIZE).add_subplot()
    data = compared.dataset
    plot_comparison_area(data, ax)
    valid, area = data["area_fraction_valid"].values, data["area_fraction"].values
    assert not valid.all(), "some theories are beyond their limits"
    within = [np.where(holds & (values <= 1.0), values, np.nan) for values, holds in zip(area, valid, strict=True)]
    lines = [np.asarray(line.get_ydata(), dtype=float) for line in ax.lines if line.get_color() != "#000000"]
    assert len(lines) > NEAREST
    for drawn in lines:
        assert any(np.array_equal(drawn, values, equal_nan=True) for values in within)


def test_a_comparison_draws_itself(compared: asp.studies.Comparison, film: asp.Surface) -> None:
    for kind in ("", "kappa", "local_slope", "gap", "deviation"):
        ax = Figure(figsize=SIZE).add_subplot()
        assert compared.plot(kind, ax) is ax
        assert "numerical" in [text.get_text() for text in ax.texts] or kind == "deviation"
    assert repr(compared).startswith("<Comparison of ")
    assert "\n" not in repr(compared)
    assert "<img" in compared._repr_html_()
    alone = asp.compare(film, STEEL, np.array([1e8, 2e8]), theories=["persson"], numerical=False)
    with refused(asp.InputError, "figure of a comparison", "'deviation'"):  # from what was not solved
        alone.plot("deviation", Figure().add_subplot())


@dataclass(frozen=True)
class Proportional:
    """A theory made for the test: area of ``factor`` times p/E* to the power ``exponent``, up to
    ``most`` Pa."""

    factor: float
    exponent: float = 1.0
    most: float = math.inf
    name: ClassVar[str] = "proportional"
    title: ClassVar[str] = "Area by a power of the load"
    citation_keys: ClassVar[tuple[str, ...]] = ()
    inputs: ClassVar[tuple] = ()

    def at_pressure(self, pressure) -> Prediction:
        p = np.atleast_1d(np.asarray(pressure, dtype=float))
        if p.max() > self.most:
            raise asp.InputError(f"pressure must be at most {self.most:g} Pa.")
        return prediction(p, area_fraction=self.factor * (p / E_STAR) ** self.exponent)

    def validity(self, found: Prediction) -> tuple[Limit, ...]:
        return (Limit("area fraction", found.area_fraction, -math.inf, 0.05, "Greenwood1966", "Too much."),)


def test_the_numerical_solution_is_westergaards_where_that_is_exact():
    """Ends of the contact are known to a pixel, 2/n of the period; the gap to the order 3/2 of the
    pixel in the half-width."""
    n, amplitude, wavelength = 256, 1e-9, 1e-6
    surface = generate.sinusoid(
        asp.Grid((n, 4), (wavelength / n, wavelength / n)), amplitude=amplitude, wavelength=wavelength
    )
    wave = Westergaard(E_STAR, amplitude, wavelength)
    loads = np.array([0.1, 0.3, 0.6]) * wave.full_contact_pressure
    found = asp.compare(surface, elastic(E_STAR), loads, theories=[wave, "greenwood-williamson"], solver=TIGHT)
    curve = found.curve("westergaard")
    assert curve.valid.all()
    assert curve.comparable_gap
    share = curve.prediction.area_fraction
    # pixels are counted; a straight contact has no corners, so that the correction takes too much
    # off it, two edges a row
    np.testing.assert_allclose(found.numerical.area_fraction, share, atol=2.0 / n)
    assert np.abs(found.deviation("westergaard")).max() <= (2.0 / n + 0.25 / n) / share.min()
    rms = amplitude / math.sqrt(2.0)
    assert np.abs(found.deviation("westergaard", "gap")).max() <= 2.0 * (2.0 / n) ** 1.5 * amplitude / rms
    assert found.kappa(share) == pytest.approx(share * E_STAR * found.roughness.rms_gradient / loads)
    (left,) = found.left_out
    assert left.name == "greenwood-williamson"
    assert "summits" in left.reason


def test_curves_are_those_of_the_theories_and_of_a_load_path(film, compared):
    assert np.all(np.diff(compared.pressures) > 0.0)
    roughness = asp.roughness_of(film)
    for name in ("bush-gibson-thomas", "discrete-summits", "persson", "interacting-crests"):
        alone = theory(name).from_roughness(roughness, E_STAR).at_pressure(compared.pressures)
        np.testing.assert_array_equal(compared.curve(name).prediction.area_fraction, alone.area_fraction)
    path = asp.solve(asp.ContactProblem(film, STEEL), asp.History([asp.MeanPressure(p) for p in compared.pressures]))
    np.testing.assert_allclose(compared.numerical.area_fraction_corrected, path.area_fraction_corrected, rtol=1e-12)
    np.testing.assert_allclose(compared.numerical.mean_gap, path.mean_gap, rtol=1e-12)
    spots = [result.n_spots / math.prod(film.size) for result in path.steps]
    np.testing.assert_allclose(compared.numerical.contact_density, spots)


def test_deviations_are_relative_to_the_corrected_area_and_gaps_in_rms_heights(film, compared):
    exact = compared.numerical
    share = erf(math.sqrt(2.0) * compared.pressures / (E_STAR * compared.roughness.rms_gradient))
    np.testing.assert_allclose(compared.deviation("persson"), share / exact.area_fraction_corrected - 1.0)
    gap = compared.curve("persson").prediction.mean_gap
    rms = math.sqrt(np.mean((film.heights - film.heights.mean()) ** 2))
    np.testing.assert_allclose(compared.deviation("persson", "gap"), (gap - exact.mean_gap) / rms, rtol=1e-9)
    # elasticity lies above Persson and close to the asperity theories at these areas (statistical
    # theories, sec. 16)
    assert np.all(compared.deviation("persson") < 0.0)
    assert np.all(np.abs(compared.deviation("bush-gibson-thomas")[:2]) < 0.2)


def test_the_slope_of_a_power_law_is_its_exponent_times_kappa(film):
    loads = np.geomspace(1e7, 1e9, 5)
    found = asp.compare(film, STEEL, loads, theories=[Proportional(3.0, 0.9), Proportional(2.0)], numerical=False)
    area = found.curve("proportional").prediction.area_fraction
    np.testing.assert_allclose(found.slope(area), 0.9 * found.kappa(area), rtol=1e-12)
    straight = found.curve("proportional 2").prediction.area_fraction
    np.testing.assert_allclose(found.kappa(straight), 2.0 * found.roughness.rms_gradient, rtol=1e-12)
    assert np.isnan(found.deviation("proportional")).all()
    assert np.isnan(asp.compare(film, STEEL, 1e7, theories=["persson"], numerical=False).slope(area[:1])).all()


def test_a_theory_ends_where_it_cannot_carry_the_load(film):
    loads = np.array([1.0, 2.0, 3.0, 4.0, 5.0]) * 1e8
    short = Proportional(20.0, most=3.5e8)
    found = asp.compare(film, STEEL, loads, theories=[short, Proportional(1.0, most=1.0)], numerical=False)
    curve = found.curve("proportional")
    np.testing.assert_allclose(curve.prediction.area_fraction, [0.02, 0.04, 0.06, np.nan, np.nan])
    np.testing.assert_array_equal(curve.valid, [True, True, False, False, False])
    assert curve.notes == (
        "Computed at 3 of 5 loads: pressure must be at most 3.5e+08 Pa.",
        "area fraction 0.06, not at most 0.05, from 300 MPa on: Too much. [Greenwood1966]",
    )
    (left,) = found.left_out
    assert left.reason == "pressure must be at most 1 Pa."


def test_every_theory_of_a_surface_has_a_curve_or_a_reason(compared):
    from asperity.studies.comparison_theories import surface_theories

    names = [curve.name for curve in compared.curves]
    assert sorted([*names, *(item.name for item in compared.left_out)]) == sorted(surface_theories())
    reasons = {item.name: item.reason for item in compared.left_out}
    assert "work of adhesion w (work, J/m^2)" in reasons["fuller-tabor"]
    assert "yield stress" in reasons["jackson-green"]
    assert {"kogut-etsion", "interacting-crests", "persson"} <= set(names)
    assert compared.curve("kogut-etsion").family == "elastic-plastic"
    assert any("kogut-etsion" in remark and "summits flow" in remark for remark in compared.remarks)
    assert not compared.curve("interacting-crests").comparable_gap
    assert np.isnan(compared.curve("interacting-crests").gap).all()


def test_what_bodies_do_not_state_is_given(film):
    theories = ["fuller-tabor", "jackson-green", "chang-etsion-bogy"]
    inputs = {"work": 0.05, "yield_stress": 2e9}
    found = asp.compare(film, STEEL, 1e8, theories=theories, inputs=inputs, numerical=False)
    assert [curve.family for curve in found.curves] == ["adhesive", "elastic-plastic", "elastic-plastic"]
    expected = theory("chang-etsion-bogy").from_roughness(found.roughness, E_STAR, hardness=5e9, nu=0.3)
    assert found.curves[2].prediction.area_fraction == expected.at_pressure(1e8).area_fraction
    law = asp.ContactProblem(film, STEEL, law=asp.Hardness(2e9))
    softer = asp.compare(law, pressures=1e8, theories=theories[2:], numerical=False).curves[0]
    assert softer.prediction.area_fraction > found.curves[2].prediction.area_fraction
    field = asp.ContactProblem(film, STEEL, law=asp.Hardness(np.full(film.shape, 2e9)))
    (left,) = asp.compare(field, pressures=1e8, theories=theories[2:], numerical=False).left_out
    assert "not known as one number" in left.reason


def test_the_hardness_of_the_numerical_solution_ends_its_curve(film):
    problem = asp.ContactProblem(film, STEEL, law=asp.Hardness(1e9))
    found = asp.compare(problem, pressures=[5e8, 2e9], theories=["persson"])
    assert np.isfinite(found.numerical.mean_gap[0])
    assert np.isnan(found.numerical.area_fraction[1])
    assert np.isnan(found.deviation("persson")[1])
    assert len(found.numerical.notes) == 1
    assert any("law hardness" in remark for remark in found.remarks)


def test_an_anisotropic_surface_is_noted_with_its_ratio(film):
    stretched = asp.Surface(film.heights, film.dx, 3.0 * film.dy, periodic=True)
    found = asp.compare(stretched, STEEL, 1e7, theories=["persson", "mccool", "discrete-summits"], numerical=False)
    steep, gentle = found.roughness.moments.principal_slopes
    for name in ("persson", "mccool"):
        assert f"principal mean square slopes {steep / gentle:.3g}, not from 1 to 2" in " ".join(
            found.curve(name).notes
        )
        assert not found.curve(name).valid.any()
    assert "principal" not in " ".join(found.curve("discrete-summits").notes)
    alike = asp.compare(film, STEEL, 1e7, theories=["mccool"], numerical=False).curves[0]
    assert "principal" not in " ".join(alike.notes)


def test_limits_belong_to_quantities(compared):
    """Persson's range of loads is that of the gap, and theories that are far off in the area do not
    hold for it."""
    persson = compared.curve("persson")
    relative = compared.pressures / (compared.E_star * compared.roughness.rms_gradient)
    np.testing.assert_array_equal(persson.valid_for["gap"], (relative >= 0.01) & (relative <= 0.2))
    assert persson.valid.all()
    assert any("for mean gap and stiffness only" in note for note in persson.notes)
    data = compared.dataset
    np.testing.assert_array_equal(data["gap_valid"].sel(theory="persson"), persson.valid_for["gap"])
    np.testing.assert_array_equal(data["area_fraction_valid"].sel(theory="persson"), persson.valid)
    crowded = compared.curve("bush-gibson-thomas")
    np.testing.assert_array_equal(crowded.valid_for["gap"], crowded.prediction.area_fraction <= 0.1)
    onions = compared.curve("onions-archard")  # its ordinates leave out most of the slope
    assert not onions.valid.any()
    assert np.abs(compared.deviation("onions-archard")).min() > 1.0


def test_the_nearest_theory_is_chosen_where_it_holds(film):
    loads = np.array([1.0, 2.0, 3.0, 4.0]) * 1e8
    crowded = Proportional(300.0)  # beyond its limit of 5 % but for the lowest load or none
    found = asp.compare(film, STEEL, loads, theories=[crowded, "persson"])
    text = comparison_sentence(found)
    assert "persson comes nearest where it holds (everywhere)" in text
    alone = asp.compare(film, STEEL, loads, theories=[crowded])
    assert "No theory holds at half of the loads." in comparison_sentence(alone)


def test_interacting_crests_stop_at_the_number_of_contacts(film):
    loads = [1e6, 1e8, 1e9]
    few = asp.compare(film, STEEL, loads, theories=["interacting-crests"], numerical=False, most_contacts=3).curves[0]
    all_ = asp.compare(film, STEEL, loads, theories=["interacting-crests"], numerical=False).curves[0]
    known = np.isfinite(few.prediction.area_fraction)
    assert known[0]
    assert not known[-1]
    np.testing.assert_allclose(few.prediction.area_fraction[known], all_.prediction.area_fraction[known], rtol=1e-9)
    assert "most_contacts (3)" in few.notes[0]
    none = asp.compare(film, STEEL, 1e9, theories=["interacting-crests"], numerical=False, most_contacts=1)
    assert "Computed at 0 of 1 loads" in none.left_out[0].reason


def test_layers_and_free_boundaries_are_remarked(film):
    coated = asp.Layered([asp.Layer(asp.Elastic(200e9, 0.25), 5e-9)], STEEL)
    problem = asp.ContactProblem(film, coated, boundary=asp.Free())
    found = asp.compare(problem, pressures=1e7, theories=["persson"])
    text = " ".join(found.remarks)
    assert "A body is layered" in text
    assert "top layer of 5 nm (at the highest load their mean radius" in text
    assert "boundary is free" in text
    assert found.E_star == pytest.approx(200e9 / (1.0 - 0.25**2))


def test_default_loads_follow_the_gradient(film):
    found = asp.compare(film, STEEL, theories=["persson"], numerical=False)
    relative = found.pressures / (found.E_star * found.roughness.rms_gradient)
    np.testing.assert_allclose(relative[[0, -1]], [0.004, 0.25])


def test_two_rough_bodies_are_compared_by_their_sum(film):
    other = film.with_heights(np.roll(film.heights, 20, axis=0), "rolled")
    pair = asp.ContactProblem(film, STEEL, other, STEEL)
    found = asp.compare(pair, pressures=1e8, theories=["persson"])
    both = asp.compare(asp.surfaces.composite(film, other), (STEEL, STEEL), 1e8, theories=["persson"])
    assert found.roughness.m2 == pytest.approx(both.roughness.m2)
    assert found.numerical.mean_gap == pytest.approx(both.numerical.mean_gap)
    assert "Peng2001" in found.citation_keys


def test_the_dataset_is_labelled_and_saved(compared, tmp_path):
    data, n = compared.dataset, len(compared.curves)
    assert dict(data.sizes) == {"theory": n, "pressure": 4}
    for name, variable in data.variables.items():
        if name not in ("theory", "title", "family"):
            assert variable.attrs["units"], name
            assert variable.attrs["long_name"], name
    np.testing.assert_array_equal(data["area_fraction_deviation"].sel(theory="persson"), compared.deviation("persson"))
    np.testing.assert_array_equal(data["numerical_kappa"], compared.kappa(compared.numerical.area_fraction_corrected))
    assert set(json.loads(data.attrs["left_out"])) == {item.name for item in compared.left_out}
    assert len(json.loads(data.attrs["provenance"])["surface"]["digest"]) == 64
    asp.files.save_comparison(compared, tmp_path / "c.nc")
    read = asp.files.open_tree(tmp_path / "c.nc").to_dataset()
    for name in data.data_vars:
        np.testing.assert_array_equal(read[name], data[name])
    assert list(read["theory"].values) == [curve.name for curve in compared.curves]
    with refused(asp.errors.OutputError, "output file"):
        asp.files.save_comparison(compared, tmp_path / "c.nc")


def test_the_table_has_a_row_for_every_curve_and_load(compared, tmp_path):
    asp.files.export_comparison_csv(compared, tmp_path / "c.csv")
    with (tmp_path / "c.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 4 * (len(compared.curves) + 1)
    persson = [row for row in rows if row["curve"] == "persson"]
    assert [float(row["area_fraction_deviation"]) for row in persson] == list(compared.deviation("persson"))
    assert persson[0]["area_fraction_pixels"] == ""
    assert rows[0]["curve"] == "numerical"
    assert float(rows[0]["area_fraction_pixels"]) > float(rows[0]["area_fraction"])


@pytest.mark.parametrize(
    ("arguments", "choices", "subject", "shown"),
    [
        ((STEEL, 1e7), {"theories": ["gw"]}, "name of a theory to compare", "'gw'"),
        ((STEEL, 1e7), {"theories": ["hertz"]}, "name of a theory to compare", "'hertz'"),
        ((STEEL, 1e7), {"theories": "persson"}, "theories of a comparison", "['persson']"),
        ((STEEL, 1e7), {"theories": [3]}, "theories of a comparison", "3"),
        ((STEEL, [1e7, 0.0]), {}, "pressure (Pa) of a comparison", "0.0"),
        ((STEEL, []), {}, "pressures (Pa) of a comparison", "empty"),
        ((None, 1e7), {}, "bodies", "DLC"),
    ],
)
def test_what_cannot_be_compared_is_refused(film, arguments, choices, subject, shown):
    with refused(asp.InputError, subject, shown):
        asp.compare(film, *arguments, **choices)


def test_a_problem_has_its_own_bodies(film):
    with refused(asp.InputError, "bodies"):
        asp.compare(asp.ContactProblem(film, STEEL), STEEL, 1e7)
