"""Every page of validation on rough contacts, on fewer surfaces and points: all its claims hold,
and it is the script's."""

import contextlib
from functools import cache

import block_pictures
import layered_sliding_runs
import numpy as np
import peng
import peng_layer_effect
import peng_pictures
import peng_scaling
import peng_stress
import peng_table_3_1
import pictures
import pytest
import rough_cylinder
import rough_sphere
import sealing_pictures
import sliding_pictures
from page import Claim, Page, write_page
from validation_pages import assert_claims_hold, assert_written_by_script, written_rows

RUNS = {
    "peng_table_3_1": lambda: peng_table_3_1.compare(20, peng_table_3_1.PUBLISHED[::7], variants=False),
    "peng_layer_effect": lambda: peng_layer_effect.compare(8, (0.001, 0.1, 2.0, 100.0)),
    "rough_cylinder": lambda: rough_cylinder.compare(count=2, points=8192),
    "rough_sphere": lambda: rough_sphere.compare(count=1, points=192, roughness=(0.0, 8e-9, 32e-9)),
    "peng_stress": lambda: peng_stress.compare(count=1),
    "peng_scaling": lambda: peng_scaling.compare(count=8, stressed=2),
}


QUICK = ("peng_cylinder", "peng_layers", "peng_scaling", "peng_sphere")
"""Pictures that take two or three seconds."""

EACH = [pytest.param(name, marks=[pytest.mark.slow] * (name != "peng_layer_effect")) for name in RUNS]


@cache
def page_of(name):
    return RUNS[name]()


@pytest.mark.parametrize("name", EACH)
def test_every_claim_holds(name):
    assert_claims_hold(page_of(name))


@pytest.mark.parametrize("name", EACH)
def test_page_belongs_to_the_script(name):
    assert_written_by_script(page_of(name), name)


@cache
def slid_lightly():
    """A fifth of the load of the figure, pressed and lifted at once, on its mesh with longer
    elements, in few steps."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(layered_sliding_runs, "PUSHED", (0.3, 1.0))
        patch.setattr(layered_sliding_runs, "LIFTED", (0.3,))
        return layered_sliding_runs.run(
            layered_sliding_runs.Case(2.0, 0.1, load=20.0, radius=10.0, across=4, passes=1, step=12.0)
        )


GRID = peng.grid


@pytest.fixture
def cheap_cases(monkeypatch):
    """The pictures are those of few points, steps and surfaces: how they are drawn is the same, and
    what they show is on the pages."""
    monkeypatch.setattr(sliding_pictures, "sliding", slid_lightly)
    monkeypatch.setattr(peng, "grid", lambda: GRID(96))
    for name, value in {"SURFACES": 3, "POINTS": 192, "PER_REGION": 4}.items():
        monkeypatch.setattr(peng_pictures, name, value)
    for name, value in {"POINTS": 64, "LOADS": 3}.items():
        monkeypatch.setattr(sealing_pictures, name, value)
    few = {"SPEEDS": np.geomspace(3e-4, 3e-2, 3), "FRICTIONS": np.linspace(0.24, 0.5, 4)}
    short = {"SLIDES": 0.05, "WINDOW": 0.02, "GROWS": 0.03}
    for name, value in (few | short).items():
        monkeypatch.setattr(block_pictures, name, value)


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=[pytest.mark.slow] * (name not in QUICK)) for name in pictures.FIGURES],
)
def test_picture_is_drawn(name, tmp_path, cheap_cases):
    written = pictures.draw(name, tmp_path)
    assert written.read_bytes().startswith(b"\x89PNG")
    assert written.stat().st_size > 20_000


@pytest.mark.parametrize(
    ("claim", "holds"),
    [
        (Claim("a", 1.0, 0.9, 1.1), True),
        (Claim("a", 1.2, 0.9, 1.1), False),
        (Claim("a", 0.8, low=0.9), False),
        (Claim("a", 0.95, high=0.9), False),
        (Claim("a", float("nan"), 0.9, 1.1), False),
    ],
)
def test_a_claim_that_fails_is_told(claim, holds):
    page = Page("title", "about", (), (claim,))
    assert page.agrees is holds
    assert ("| NO |" in page.markdown()) is not holds


@pytest.mark.parametrize(("found", "status"), [(1.0, None), (2.0, 1)])
def test_writing_a_page_that_disagrees_is_an_error(found, status, tmp_path):
    page = Page("title", "about", (), (Claim("a", found, 0.9, 1.1),))
    with contextlib.nullcontext() if status is None else pytest.raises(SystemExit) as raised:
        write_page(page, str(tmp_path / "some.py"))
    assert status is None or raised.value.code == status
    assert (tmp_path / "some.md").read_text(encoding="utf-8") == page.markdown()


def test_every_published_area_is_a_whole_number_of_pixels():
    """Within one unit of the last printed digit (0.0001 %), which is a fifteenth of a pixel."""
    for row in peng_table_3_1.PUBLISHED:
        pixels = row[3] / 100.0 * peng_table_3_1.PIXELS**2
        assert abs(pixels - round(pixels)) <= 1.01e-6 * peng_table_3_1.PIXELS**2


def test_written_table_has_every_published_row():
    lines = [row for row in written_rows("peng_table_3_1") if len(row) == 10][1:]
    found = [(row[0], row[1], row[2], row[4], row[7]) for row in lines]
    expected = [(f"{r:g}", f"{p:g}", f"{s:g}", f"{a:.4f}", f"{m:.4f}") for r, p, s, a, m in peng_table_3_1.PUBLISHED]
    assert found == expected
