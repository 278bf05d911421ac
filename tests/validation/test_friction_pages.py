"""Pages on friction: smaller runs keep their claims, and the pages are the scripts'."""

import cattaneo_mindlin
import numpy as np
import pressed_with_friction
import pytest
import rolling_cylinders
import rough_fretting
from validation_pages import assert_claims_hold, assert_written_by_script


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "make"),
    [
        ("cattaneo_mindlin", lambda: cattaneo_mindlin.page((20, 28, 40, 56), 56)),
        ("rolling_cylinders", lambda: rolling_cylinders.page((16, 64, 256), 40)),
        ("rough_fretting", lambda: rough_fretting.page(128, 2, 80)),
    ],
)
def test_what_is_claimed_holds(name, make):
    page = make()
    assert_claims_hold(page)
    assert_written_by_script(page, name)
    assert all(number.kept for number in page.published)


@pytest.mark.slow
def test_indentation_with_friction(monkeypatch):
    monkeypatch.setattr(pressed_with_friction, "CASES", ((0.3, 0.15),))
    page = pressed_with_friction.page((16, 64))
    assert_claims_hold(page)
    assert_written_by_script(page, "pressed_with_friction")


def test_the_heat_of_small_cycles_is_a_cube_where_the_approach_is_smooth():
    """(4/27) s³ of the sphere and (2/3) s³ of an approach u₀ ln P."""
    s = 1e-3
    assert rough_fretting.logarithmic(s) == pytest.approx(2.0 / 3.0 * s**3, rel=2e-3)
    assert cattaneo_mindlin.printed_loop(0.01) == pytest.approx(4.0 / 27.0 * 0.01**3, rel=0.01)
    assert rough_fretting.slope(np.array(rough_fretting.AMPLITUDES) ** 3) == pytest.approx(3.0)
