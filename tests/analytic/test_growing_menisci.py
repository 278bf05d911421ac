"""Menisci of a map that grow in time: reference values, conserved volume, and limits."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from contact_cases import elastic, wetted
from reference_data import reference
from refusals import refused

import asperity as asp
from asperity.physics.menisci.pools import Pools
from asperity.theories.wet.meniscus import MeniscusGrowth

NM = 1e-9
POINTS = 384


@dataclass(frozen=True)
class Plain:
    """Q = 1/s - Π."""

    held: float

    @property
    def equilibrium_height(self) -> float:
        return 1.0 / self.held

    def flow(self, height: float) -> float:
        return 1.0 / height - self.held


@pytest.mark.parametrize("row", reference("missing/meniscus_growth_map"), ids=lambda row: f"{row['case']:.0f}")
def test_a_cell_of_crossed_waves(row):
    """Against elliptic integrals. The edge of the count is that of its points, about half a point
    around: 1/384 of the radius of the smallest menisci, 0.13, so 1 % of their area and volume."""
    x = 2.0 * math.pi * (np.arange(POINTS) + 0.5) / POINTS
    gap = 2.0 - np.cos(x)[:, None] - np.cos(x)
    grid = asp.Grid((POINTS, POINTS), (1.0 / POINTS, 1.0 / POINTS))
    feed = Plain(row["disjoining_pressure"])
    pools = Pools(gap, np.zeros(gap.shape, dtype=bool), grid, (True, True), feed, 1.0).begun(row["s_start"])
    time = 0.0
    while pools.height < row["s"] and math.isfinite(pools.following):
        time = pools.following
        pools.advance()
    assert len(pools.pools) == 1
    for found, column in ((pools.area, "wetted_area"), (pools.volume, "liquid_volume"), (pools.force, "force")):
        assert found == pytest.approx(row[column], rel=0.01), column
    assert time == pytest.approx(row["time"], rel=0.01)


def test_the_meniscus_of_a_sphere_grows_as_in_theory():
    """A rigid paraboloid on a film: y of dy/dτ = (1 - y)/y²."""
    grid = asp.Grid((201, 201), (2.5 * NM, 2.5 * NM))
    x = (np.arange(201) - 100) * 2.5 * NM
    gap = np.add.outer(x**2, x**2) / (2.0 * 1e-6)
    theory = MeniscusGrowth(1e-6, 0.025, 2.0 * NM, 0.1, 8e-20)
    feed = asp.menisci.FilmFeed(0.025, 2.0 * NM, 0.1, theory.disjoining_pressure)
    pools = Pools(gap, gap == 0.0, grid, (False, False), feed, 0.05).begun(2.0 * NM)
    heights, times = [], []
    while (
        math.isfinite(pools.following) and pools.height < 0.9 * theory.equilibrium_height and pools.height < 20.0 * NM
    ):
        times.append(pools.following)
        pools.advance()
        heights.append(pools.height)
    expected = np.asarray(theory.height(np.array(times)))
    later = np.array(heights) > 4.0 * NM
    # the height of a point against that of its edge, half a point around: g' dx/2 = dx sqrt(s/2R)
    np.testing.assert_allclose(np.array(heights)[later], expected[later], rtol=0.03)
    assert pools.volume == pytest.approx(math.pi * 1e-6 * pools.height**2, rel=0.03)


def test_islands_that_meet_hold_the_volume_of_both():
    """Two pits of unlike depth; volume comes in by the flow of the islands there are."""
    x = np.arange(60)
    wave = 3.0 - 2.0 * np.cos(2.0 * math.pi * (x - 15.0) / 30.0)
    gap = np.add.outer(wave + 0.6 * (x < 30), 0.05 * (x - 30.0) ** 2)
    grid = asp.Grid((60, 60), (1.0, 1.0))

    @dataclass(frozen=True)
    class Steady:
        equilibrium_height: float = math.inf

        def flow(self, height: float) -> float:
            return 1.0

    pools = Pools(gap, np.zeros(gap.shape, dtype=bool), grid, (False, False), Steady(), 1.0).begun(1.7)
    assert len(pools.pools) == 2
    begun, time, met = pools.volume, 0.0, math.nan
    while len(pools.pools) == 2:
        met = pools.following
        pools.advance()
    for _ in range(50):
        time = pools.following
        pools.advance()
    assert pools.volume == pytest.approx(begun + 2.0 * met + (time - met), rel=1e-12)


def rough() -> asp.ContactProblem:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(2.0 * NM), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=100 * NM
    )
    surface = asp.generate.gaussian(asp.Grid((64, 64), (40 * NM, 40 * NM)), spectrum, seed=5)
    film = asp.LiquidFilm(surface_tension=0.025, thickness=1.0 * NM, feedback=False)
    return asp.ContactProblem(surface, elastic(100e9), film=film)


LOAD = asp.MeanPressure(2e6)
VAPOUR = asp.menisci.VapourFeed(0.025, 1.8e-5, 0.9)


def test_long_after_contact_menisci_are_those_in_equilibrium_with_the_vapour():
    """Without feedback the islands up to its height that hold the film, point by point."""
    problem = rough()
    grown = asp.menisci.growing_menisci(problem, LOAD, VAPOUR)
    height = VAPOUR.equilibrium_height
    rest = wetted(problem, LOAD, replace(problem.film, meniscus_height=height))
    assert grown.meniscus_force[-1] == pytest.approx(rest.menisci.meniscus_force, rel=1e-9)
    np.testing.assert_array_equal(grown.held, rest.menisci.wetting.kept)
    first = wetted(problem, LOAD, problem.film).menisci
    assert grown.meniscus_force[0] == pytest.approx(first.meniscus_force, rel=0.3), "islands of a point stand higher"
    for name in ("meniscus_area_fraction", "liquid_volume", "time"):
        assert (np.diff(getattr(grown, name)) >= 0.0).all(), name
    assert (np.diff(grown.n_menisci) <= 0.0).all()
    assert 0.0 < grown.settling <= grown.time[-1]


def test_growing_menisci_press_the_surfaces_together():
    """With feedback force and contact are larger, and the contact carries both within the 2 % after
    which it is solved again."""
    problem = rough()
    fed = replace(problem, film=replace(problem.film, feedback=True))
    alone, grown = (asp.menisci.growing_menisci(each, LOAD, VAPOUR) for each in (problem, fed))
    assert grown.solves > alone.solves == 1
    assert grown.meniscus_force[-1] > alone.meniscus_force[-1]
    assert grown.area_fraction[-1] > grown.area_fraction[0]
    force = grown.last.force
    missed = abs(force - grown.external_force - grown.meniscus_force[-1])
    assert missed <= grown.imbalance * force * (1.0 + 1e-9)
    assert grown.imbalance < 0.05
    steady = wetted(fed, LOAD, replace(fed.film, meniscus_height=VAPOUR.equilibrium_height))
    assert grown.meniscus_force[-1] == pytest.approx(steady.menisci.meniscus_force, rel=0.1)


def test_what_cannot_grow_is_refused():
    problem = rough()
    with refused(asp.errors.InputError, "problem with growing menisci"):
        asp.menisci.growing_menisci(replace(problem, film=None), LOAD, VAPOUR)
    with refused(asp.errors.InputError, "times (s) of growing menisci"):
        asp.menisci.growing_menisci(problem, LOAD, VAPOUR, [1.0, 0.5])


DOCUMENT = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [48, 48],
        "size": "2 um",
        "seed": 1,
        "spectrum": {"kind": "exponential", "rms_height": "2 nm", "correlation_length": "0.5 um"},
    },
    "body": "steel",
    "control": {"mean_pressure": "20 MPa"},
    "film": {"liquid": "water", "thickness": "1 nm"},
    "meniscus_growth": {"feed": "vapour", "humidity": "80 %"},
}


def test_growth_from_a_document(tmp_path: Path):
    """Numbers, table, figure and words; also from the file."""
    outcome = asp.run(DOCUMENT)
    values = outcome.found["meniscus_growth"].values
    assert values["grown_last_force"] == values["growth_meniscus_force"][-1] > values["grown_first_force"] > 0.0
    assert [figure.name for figure in outcome.figures["meniscus_growth"]] == ["meniscus_growth"]
    assert outcome.figures["meniscus_growth"][0].picture.startswith(b"\x89PNG")
    words = next(words for part, words in outcome.sections if part.name == "meniscus_growth")
    assert "grow" in words.sentence
    film = DOCUMENT["film"] | {"viscosity": "1 mPa*s"}
    flowing = asp.run(DOCUMENT | {"film": film, "meniscus_growth": {"feed": "flooded", "until": "1 us"}})
    assert flowing.found["meniscus_growth"].values["growth_time"][-1] == pytest.approx(1e-6)


@pytest.mark.parametrize(
    ("changed", "subject"),
    [
        ({"film": None}, "meniscus_growth"),
        ({"meniscus_growth": {"feed": "vapour"}}, "meniscus_growth.humidity"),
        (
            {"film": {"surface_tension": "30 mN/m", "thickness": "1 nm"}, "meniscus_growth": {}},
            "viscosity of the liquid",
        ),
    ],
)
def test_documents_that_cannot_be_done_are_refused(changed, subject):
    document = {key: value for key, value in (DOCUMENT | changed).items() if value is not None}
    with refused(asp.errors.InputError, subject):
        asp.run(document)
