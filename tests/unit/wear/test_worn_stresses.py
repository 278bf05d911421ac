"""Stresses and yielding of contacts as they wear: closed form of a wave, plain solves, a coating
that goes, restarts, files, documents; and which contacts are kept where the end is not known."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from refusals import refused
from typer.testing import CliRunner

import asperity as asp
from asperity.cli.main import app
from asperity.core.arrays import RealArray
from asperity.core.errors import InputError
from asperity.physics.wear.sections import MOST, Sections
from asperity.physics.wear.stresses import WornStresses
from asperity.run.build import build
from asperity.run.document import checked, dumps
from asperity.run.execute import execute
from asperity.run.stored import load_outcome, save_outcome
from asperity.solids.strength import Strength
from asperity.stresses import Tresca, depths_through, first_yield
from asperity.wear import WearSteps, archard, worn

E_STAR, NU, WAVES, LENGTH = 100e9, 0.3, 2.0, 1e-3


def wave_stress(mean: float, amplitude: float, depth: RealArray | float, x: RealArray) -> RealArray:
    """√(3 J2) under p̄ + p₁ cos qx in a half-space without mean lateral strain: plane strain of the
    wave (Johnson 1985, eq. 13.4) beside the stress of the mean."""
    q = 2.0 * math.pi * WAVES / LENGTH
    decay, side = amplitude * np.exp(-q * depth), NU / (1.0 - NU) * mean
    zz = -mean - decay * (1.0 + q * depth) * np.cos(q * x)
    xx = -side - decay * (1.0 - q * depth) * np.cos(q * x)
    yy = -side - 2.0 * NU * decay * np.cos(q * x)
    xz = decay * q * depth * np.sin(q * x)
    return np.asarray(np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3.0 * xz**2))


def test_stresses_fall_as_a_wave_wears_off() -> None:
    """The amplitude of the pressure falls by 1/(1 + k s/c) a step, and the stress of the wave with
    it, on the mean that stays."""
    points = 32
    x = (np.arange(points)) * LENGTH / points
    q, height = 2.0 * math.pi * WAVES / LENGTH, 1e-7
    surface = asp.Surface(np.repeat((height * np.cos(q * x))[:, None], points, axis=1), LENGTH / points, periodic=True)
    steel = asp.Elastic(E_STAR * (1.0 - NU**2), NU, Strength(yield_stress=50e6))
    first = 0.5 * E_STAR * q * height
    mean, rate = 1.25 * first, 1e-15 * 0.5 * E_STAR * q
    marks = [1.0 / rate, 2.0 / rate]
    problem, steps = asp.ContactProblem(surface, steel), WearSteps(number=4)
    history = worn(problem, asp.MeanPressure(mean), marks, archard(1e-15), steps=steps).stressed()
    found = history.stresses
    assert found is not None
    depths = np.linspace(0.0, LENGTH, 400)[:, None]
    for number, amplitude in enumerate(first * 1.25 ** -np.array([0.0, 4.0, 8.0])):
        value, deep = found["von_mises"][number, 0], found["depth"][number, 0]
        # the pressure is to the root of a relative error of 1e-7 in energy
        assert value == pytest.approx(wave_stress(mean, amplitude, deep, x).max(), rel=1e-5)
        # planes below a contact are within 0.7 % of the largest √J2 (``RATIO``)
        assert value == pytest.approx(wave_stress(mean, amplitude, depths, x[None]).max(), rel=0.01)
        assert found["utilisation"][number, 0] == pytest.approx(value / 50e6, rel=1e-12)
    np.testing.assert_allclose(found.load_factor, 1.0 / found["utilisation"][:, 0])
    assert np.all(np.diff(found["von_mises"][:, 0]) < 0.0)
    assert found.layers == ("substrate",)
    assert found.coating.tolist() == [0.0, 0.0, 0.0]


def coated(points: int = 32, **given: Any) -> asp.ContactProblem:
    """A rough coated surface."""
    waves = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(2e-8), hurst=0.8, rolloff_wavelength=4e-6, shortest_wavelength=1e-6
    )
    surface = asp.generate.gaussian(asp.Grid((points, points), (2.5e-7, 2.5e-7)), waves, seed=3)
    body = asp.Layered([asp.Layer(asp.material("DLC"), 1e-7)], asp.material("bearing steel"))
    return asp.ContactProblem(surface, body, **given)


LAW, LOAD, MARKS = archard(1e-15, layers=[(1e-7, 1e-16)]), asp.MeanPressure(50e6), (0.02, 0.2, 2.0)


@pytest.fixture(scope="module")
def running_in() -> asp.wear.WearHistory:
    return worn(coated(), LOAD, MARKS, LAW).stressed(0.2)


def test_each_contact_has_the_stresses_of_a_plain_one(running_in: asp.wear.WearHistory) -> None:
    """The first are those of the plain solve, later ones those of the body that is left."""
    found = running_in.stresses
    assert found is not None
    assert found.layers == ("DLC", "bearing steel")
    plain = asp.solve(coated(), LOAD)
    for number, contact in enumerate((plain, running_in.kept[1][1], running_in.last)):
        row = -1 if contact is running_in.last else number
        assert found.coating[row] == contact.problem.body.reduced.thickness
        # on the planes in which the stresses of each layer are largest
        report = first_yield(asp.stress(contact, np.unique(found["depth"][row]), friction=0.2))
        used = [part.peak.value / part.limit.value for part in report.regions]
        np.testing.assert_allclose(found["utilisation"][row], used, rtol=1e-9)
        assert found.load_factor[row] == pytest.approx(report.load_factor, rel=1e-9)
        # other planes have at most 0.7 % more (``RATIO`` of surveys)
        more = first_yield(asp.stress(contact, depths_through(contact.problem.body, 2e-6), friction=0.2))
        assert 1.0 / more.load_factor <= 1.01 * max(used)
    assert found.coating[0] == 1e-7
    assert found.coating[-1] < 0.9e-7
    assert np.all(np.diff(found["von_mises"][:, 1]) < 0.0), "pressures fall as it runs in"


def test_a_restart_has_the_same_stresses(running_in: asp.wear.WearHistory) -> None:
    first = worn(coated(), LOAD, MARKS[:2], LAW)
    second = worn(coated(), LOAD, MARKS[2], LAW, state=first.state).stressed(0.2).stresses
    whole = running_in.stresses
    assert second is not None
    assert whole is not None
    for name in second.values:
        # the same steps, from pressures that are equal to the tolerance of the solver
        np.testing.assert_allclose(second[name], whole[name][2:], rtol=1e-6, err_msg=name)
    assert second.way.tolist() == [MARKS[1], MARKS[2]]


def test_a_file_keeps_the_stresses(running_in: asp.wear.WearHistory, tmp_path: Path) -> None:
    asp.save(running_in, tmp_path / "worn.nc")
    again, found = asp.load(tmp_path / "worn.nc"), running_in.stresses
    assert found is not None
    assert again.stresses.layers == found.layers
    assert again.stresses.criterion == found.criterion
    np.testing.assert_array_equal(again.stresses.way, found.way)
    for name in found.values:
        np.testing.assert_array_equal(again.stresses[name], found[name])
    asp.save(worn(coated(16), LOAD, 0.001, LAW), tmp_path / "plain.nc")
    assert asp.load(tmp_path / "plain.nc").stresses is None
    with refused(InputError, "contacts kept of a contact that wears"):
        again.stressed()
    with refused(InputError, "body in which stresses are asked"):
        running_in.stressed(of="counter_body")
    with refused(InputError, "friction coefficient of stresses"):
        running_in.stressed(-0.1)
    with refused(InputError, "quantity of the stresses of a contact that wears"):
        found["shear"]


def test_a_layer_that_is_gone_has_no_stress() -> None:
    """Of a coating worn off everywhere the base is left, and is numbered as before."""
    surface = asp.Surface(np.zeros((8, 8)), 1e-6, periodic=True)
    body = asp.Layered([asp.Layer(asp.Elastic(300e9, 0.2), 1e-8)], asp.Elastic(210e9, 0.3))
    history = worn(asp.ContactProblem(surface, body), asp.MeanPressure(1e6), [1.0, 3.0], archard(5e-15))
    found = history.stressed(criterion=Tresca()).stresses
    assert found is not None
    assert found.layers == ("layer 1", "substrate")
    assert found.coating == pytest.approx([1e-8, 5e-9, 0.0])
    assert np.isnan(found["von_mises"][:, 0]).tolist() == [False, False, True]
    # under uniform pressure without lateral strain σz - σx = p (1 - 2 ν)/(1 - ν)
    assert found["von_mises"][-1, 1] == pytest.approx(1e6 * 0.4 / 0.7, rel=1e-9)
    assert np.isnan(found["utilisation"]).all(), "no strength is known"
    assert np.isnan(found.load_factor).all()


@pytest.mark.parametrize(
    ("used", "begins", "ends"),
    [
        ([2.0, 1.5, 0.5, 0.2], 0.0, 1.5),
        ([0.5, 1.5, 2.0, 3.0], 0.5, math.inf),
        ([0.5, 1.5, 0.5, 0.2], 0.5, 1.5),
        ([2.0, 1.5, math.nan, math.nan], 0.0, 1.0),
        ([0.5, 0.9, 0.9, 0.5], math.nan, math.nan),
    ],
)
def test_from_where_to_where_a_layer_yields(used: list[float], begins: float, ends: float) -> None:
    """By straight lines between the contacts; of a layer that is worn away until the last in which
    it was there."""
    found = WornStresses(np.arange(4.0), np.ones(4), ("a",), {"utilisation": np.array(used)[:, None]}, "von Mises")
    assert found.yields_from(0) == pytest.approx(begins, nan_ok=True)
    assert found.yields_until(0) == pytest.approx(ends, nan_ok=True)


# In documents.

WEARING: dict[str, Any] = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [32, 32],
        "size": "8 um",
        "seed": 2,
        "spectrum": {"kind": "gaussian", "rms_height": "30 nm", "correlation_length": "1.5 um"},
    },
    "body": "DLC{kw=1e-7mm^3/Nm}:40nm/bearing steel{kw=1e-6mm^3/Nm}",
    "control": {"mean_pressure": "80 MPa"},
    "friction": {"coefficient": 0.2, "coupled": False},
    "stress": {},
    "wear": {"distance": "1 m"},
}


def words_of(outcome: Any) -> Any:
    return next(words for part, words in outcome.sections if part.name == "wear")


def test_a_document_that_asks_for_stresses_has_them_along_the_way(tmp_path: Path) -> None:
    """At the start those of the part of stresses; the base yields under the virgin summits, and no
    more once they are worn; a file says the same."""
    outcome = asp.run(WEARING)
    values, found = outcome.values, outcome.found["wear"].values
    assert values["wear_max_von_mises_first"] == pytest.approx(values["max_von_mises"], rel=1e-12)
    assert values["wear_max_tension_first"] == pytest.approx(values["max_tension"], rel=1e-12)
    assert values["wear_yield_load_factor_first"] == pytest.approx(values["yield_load_factor"], rel=1e-12)
    assert values["wear_utilisation_first"] > 1.0 > values["wear_utilisation_last"]
    assert values["wear_yield_begins"] == 0.0
    assert 0.0 < values["wear_yield_ends"] < 1.0
    assert math.isnan(values["wear_yield_ends_cycles"])
    at = np.isfinite(found["course_coating"])
    assert np.count_nonzero(at) == len(found["section_way"])
    assert np.isfinite(found["course_von_mises"][at][:, 1]).all()
    assert found["wear_layer"].tolist() == ["DLC", "bearing steel"]
    words = words_of(outcome)
    assert words.alarming
    assert "wear_stresses" in {figure.name for figure in outcome.figures["wear"]}
    save_outcome(outcome, tmp_path / "worn.nc")
    again = load_outcome(tmp_path / "worn.nc")
    second = words_of(again)
    assert (second.holds, second.tables, second.rows) == (words.holds, words.tables, words.rows)
    assert next(figure for figure in again.figures["wear"] if figure.name == "wear_stresses").picture
    python = worn(outcome.solved.problem, outcome.solved.control, 1.0, archard(1e-15, layers=[(40e-9, 1e-16)]))
    stresses = python.stressed(0.2).stresses
    assert stresses is not None
    assert stresses["von_mises"][0] == pytest.approx(found["course_von_mises"][0], rel=1e-9)


def test_stresses_are_computed_where_a_study_wants_them() -> None:
    """Not for another number; and each number as in a whole run."""
    case = build(checked(WEARING))
    plain = execute(case, wanted=["wear_volume"], lines=False)
    assert "wear_layer" not in plain.found["wear"].values
    asked = execute(case, wanted=["wear_yield_ends"], lines=False)
    whole = execute(case)
    assert asked.values["wear_yield_ends"] == whole.values["wear_yield_ends"]


def test_without_stresses_there_are_none() -> None:
    outcome = asp.run({key: value for key, value in WEARING.items() if key not in ("stress", "friction")})
    assert math.isnan(outcome.values["wear_utilisation_first"])
    assert "wear_layer" not in outcome.found["wear"].values
    assert "wear_stresses" not in {figure.name for figure in outcome.figures["wear"]}


def test_the_table_has_a_column_for_each_layer(tmp_path: Path) -> None:
    (tmp_path / "p.toml").write_text(dumps(checked(WEARING)), encoding="utf-8")
    done = CliRunner().invoke(app, ["contact", "--from", str(tmp_path / "p.toml"), "--out", str(tmp_path / "o")])
    assert done.exit_code == 0, done.output
    with (tmp_path / "o" / "wear.csv").open(encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    for layer in ("DLC", "bearing steel"):
        column = [float(row[head.index(f"course_utilisation of {layer} (1)")]) for row in rows]
        assert column[0] > column[-1] > 0.0


# Contacts that are kept where the end is not known.


def test_contacts_stay_evenly_spread_whatever_is_covered() -> None:
    """Of equal steps half to all of the largest number, each as far from the next as twice the
    smallest distance at most."""
    for count in (8, 40, 333, 5000):
        sections = Sections()
        for number in range(count):
            sections.add(float(number), number)  # type: ignore[arg-type]
        ways = [way for way, _ in sections.with_marks([(count - 1.0, count - 1)])]  # type: ignore[list-item]
        assert (MOST + 1) // 2 <= len(ways) <= MOST + 1
        assert ways[0] == 0.0
        assert ways[-1] == count - 1.0
        assert max(np.diff(ways)) <= count / (0.5 * MOST) or count == 8


@pytest.mark.parametrize("distance", ["1 m", "1000 m"])
def test_a_coating_that_goes_early_leaves_sections(distance: str) -> None:
    """However long the way that is allowed."""
    wear = {"distance": distance, "until_bare": True}
    outcome = asp.run(WEARING | {"wear": wear, "control": {"mean_pressure": "20 MPa"}})
    ways = outcome.found["wear"].values["section_way"]
    end = outcome.values["wear_distance"]
    assert outcome.values["wear_breakthrough"] <= end < 1.0
    assert 8 <= len(ways) <= MOST + 1
    assert ways[-1] == end
    assert max(np.diff(ways)) < 0.3 * end
