"""Each advice appears on its case, with numbers, and stays away from a sound one."""

from dataclasses import replace

import numpy as np
from contact_cases import elastic, rough, square_grid

import asperity as asp
from asperity.core.words import in_words

SMOOTH = asp.generate.gaussian(
    square_grid(64, 64e-6),
    asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.05), hurst=0.8, rolloff_wavelength=32e-6, shortest_wavelength=12e-6
    ),
    seed=1,
)


def criteria(advice):
    return {a.criterion for a in advice}


def before(surface, control=None, **more):
    problem = asp.ContactProblem(surface, elastic(1e9), **more)
    return asp.contact.advise(problem, control or asp.MeanPressure(1e6))


def after(surface, pressure, **more):
    body = more.pop("body", replace(elastic(1.0), strength=asp.Strength(hardness=1e3)))
    return asp.contact.review(asp.solve(asp.ContactProblem(surface, body, **more), asp.MeanPressure(pressure)))


def test_a_sound_case_gets_no_warning():
    assert before(SMOOTH) == ()
    problem = asp.ContactProblem(SMOOTH, replace(elastic(1e9), strength=asp.Strength(hardness=1e9)))
    assert asp.contact.review(asp.solve(problem, asp.MeanPressure(1e7))) == ()


def test_steep():
    steep = asp.Surface(20.0 * SMOOTH.heights, 1e-6, periodic=True)
    assert criteria(before(steep)) == {"slope"}
    slope = asp.roughness.rms_slope(steep)
    assert f"rms slope is {slope:.2g}" in before(steep)[0].message


def test_rough_down_to_the_pixel():
    spiky = asp.Surface(1e-3 * np.random.default_rng(0).standard_normal((32, 32)), 1.0, periodic=True)
    assert "resolution" in criteria(before(spiky))


def test_asperity_radius_below_the_pixel():
    """Heights given in the wrong unit: the shape is resolved, but the asperities are needles."""
    needles = asp.Surface(1e3 * SMOOTH.heights, 1e-6, periodic=True)
    assert criteria(before(needles)) == {"slope", "asperity radius"}
    m4 = ((np.diff(SMOOTH.heights, 2, axis=0) ** 2).mean() + (np.diff(SMOOTH.heights, 2, axis=1) ** 2).mean()) / 2e-24
    radius = 3 / 8 * np.sqrt(np.pi / m4) / 1e3
    found = next(a for a in before(needles) if a.criterion == "asperity radius")
    assert f"is {radius / 1e-6:.2g} pixels" in found.message


def test_resolution_of_a_sine_is_its_wavelength_in_pixels():
    for pixels, expected in ((4, True), (16, False)):
        grid = asp.Grid((64, 64), (1.0, 1.0))
        wave = asp.generate.sinusoid(grid, amplitude=1e-3, wavelength=float(pixels))
        assert ("resolution" in criteria(before(wave))) == expected


def test_a_wavelength_just_too_short_is_not_shown_as_long_enough():
    x = np.arange(199.0)  # 35 waves, whose second differences are those of 5.98 pixels
    wave = asp.Surface(1e-3 * np.sin(2 * np.pi * 35 / 199 * x)[:, None] * np.ones(4), 1.0, periodic=True)
    found = next(a for a in before(wave) if a.criterion == "resolution")
    assert "5.9 pixels" in found.message


def test_edges_of_a_tilted_map():
    x, _ = SMOOTH.grid.coordinates()
    tilted = asp.Surface(SMOOTH.heights + 0.05 * x, 1e-6)
    found = [a for a in before(tilted) if a.criterion == "periodic edges"]
    assert len(found) == 1
    assert "along x" in found[0].message
    assert "periodic edges" not in criteria(before(tilted, boundary=asp.Free()))


def test_highest_pressure_at_the_seam():
    x, _ = SMOOTH.grid.coordinates()
    tilted = SMOOTH.heights + 0.05 * x
    (found,) = [a for a in after(asp.Surface(tilted, 1e-6), 1e-3) if a.criterion == "pressure at the seam"]
    result = asp.solve(asp.ContactProblem(asp.Surface(tilted, 1e-6), elastic(1.0)), asp.MeanPressure(1e-3))
    assert f"{1e3 * result.max_pressure:.4g} mPa" in found.message
    assert "6.2 % of the area" in found.message  # 2 * 64 + 2 * 62 of 64² pixels
    assert found.numbers["seam"] == result.max_pressure > found.numbers["elsewhere"]
    assert found.remedy != in_words(found.remedy) in found.message
    for heights, more in ((tilted, {"periodic": True}), (np.roll(SMOOTH.heights, (9, 9), (0, 1)), {})):
        assert "pressure at the seam" not in criteria(after(asp.Surface(heights, 1e-6, **more), 1e-3))


def test_load_out_of_range():
    assert "load" in criteria(before(SMOOTH, asp.MeanPressure(2e8)))
    assert "load" in criteria(before(SMOOTH, asp.Force(2e8 * SMOOTH.grid.area)))
    assert "load" not in criteria(before(SMOOTH, asp.Approach(1e-9)))


def test_memory(monkeypatch):
    monkeypatch.setattr("asperity.parts.advice.free_memory", lambda: 1e4)
    assert "memory" in criteria(before(SMOOTH))


def test_few_pixels_and_small_spots():
    assert "contact pixels" in criteria(after(rough((32, 32), power=1.0), 1e-4))
    assert "contact pixels" in criteria(after(rough((64, 64), power=0.5), 0.2))


def test_near_full_contact():
    assert "near-full contact" in criteria(after(rough((32, 32), power=3.0), 10.0))


def test_yield_everywhere():
    assert "yield everywhere" in criteria(after(rough((32, 32)), 0.0999, law=asp.Hardness(0.1)))
    assert "yield everywhere" not in criteria(after(rough((32, 32)), 0.05, law=asp.Hardness(0.1)))


def test_border_of_a_free_map():
    flat = asp.generate.flat(asp.Grid((16, 16), (1.0, 1.0)))
    assert criteria(after(flat, 0.1, boundary=asp.Free())) == {"contact at the border", "near-full contact"}


def test_sphere_in_a_small_period():
    sphere = asp.generate.sphere(square_grid(64, 1.0), radius=1.0)
    assert "patch against period" in criteria(after(sphere, 0.1))
    assert "patch against period" not in criteria(after(sphere, 0.1, boundary=asp.Free()))


def test_pressure_above_the_known_hardness():
    soft = asp.Elastic(1.0, 0.3, asp.Strength(hardness=0.01), name="butter")
    found = [a for a in after(rough((32, 32)), 0.05, body=soft) if a.criterion == "hardness"]
    assert len(found) == 1
    assert "butter" in found[0].message
    top = replace(asp.solve(asp.ContactProblem(rough((32, 32)), soft), asp.MeanPressure(0.005)), max_pressure=0.01003)
    (slightly,) = [item for item in asp.contact.review(top) if item.criterion == "hardness"]
    assert "0.3 % above" in slightly.message
    assert "hardness" not in criteria(after(rough((32, 32)), 0.005, body=soft, law=asp.Hardness(0.01)))
    assert "hardness" in criteria(after(rough((32, 32)), 0.005, body=soft, law=asp.Hardness(0.02)))


def yielding(result: asp.ContactResult) -> dict[str, str]:
    return {a.criterion: a.message for a in asp.contact.review(result) if a.criterion in ("hardness", "yielding")}


def test_pressure_above_the_yield_stress_where_no_hardness_is_known():
    """2.8 Y stands for the hardness (Tabor)."""
    soft = asp.Elastic(1.0, 0.3, asp.Strength(yield_stress=0.01 / 2.8), name="butter")
    found = yielding(asp.solve(asp.ContactProblem(rough((32, 32)), soft), asp.MeanPressure(0.05)))
    assert set(found) == {"hardness"}
    assert "2.8 times the yield stress of butter" in found["hardness"]
    at_limit = asp.solve(asp.ContactProblem(rough((32, 32)), soft, law=asp.Hardness(0.01)), asp.MeanPressure(0.005))
    assert yielding(at_limit) == {}


def test_an_unknown_strength_is_said():
    def told(body, counter=None, law=None):
        problem = asp.ContactProblem(
            rough((32, 32)), body, counter_body=counter or asp.Rigid(), law=law or asp.plasticity.HardWall()
        )
        return yielding(asp.solve(problem, asp.MeanPressure(0.005)))

    unknown = asp.Elastic(1.0, 0.3, name="alloy")
    hard = asp.Elastic(1.0, 0.3, asp.Strength(hardness=100.0), name="glass")
    assert set(told(unknown)) == {"yielding"}
    assert "alloy" in told(hard, unknown)["yielding"]
    assert told(hard) == {}
    assert told(asp.Elastic(1.0, 0.499)) == {}, "elastomers do not yield"
    assert told(unknown, law=asp.Hardness(10.0)) == {}, "a limit that is given is the strength"
    assert set(told(hard, unknown, asp.Hardness(100.0))) == {"yielding"}, (
        "a limit that is the strength of the other body is not"
    )


def test_a_soft_coating_pressed_through_is_not_above_its_hardness():
    """With the hardness that follows the indentation the film bears more than its own hardness, as
    it should."""
    film, base = (asp.Elastic(1.0, 0.3, asp.Strength(hardness=h)) for h in (0.02, 0.5))
    coated = asp.Layered([asp.Layer(film, 0.5)], base)
    result = asp.solve(
        asp.ContactProblem(rough((32, 32)), coated, law=asp.plasticity.LayeredHardness(coated)), asp.MeanPressure(0.01)
    )
    assert result.max_pressure > 0.021
    assert "hardness" not in criteria(asp.contact.review(result))
    assert "softer layers below" not in criteria(asp.contact.advise(result.problem, result.control))


def test_strengths_above_the_modulus():
    """As where MPa were written for kPa; a strength below it is none."""
    for name, criterion in (("yield_stress", "yield stress"), ("hardness", "hardness")):
        weak, strong = (asp.Elastic(2e9, 0.3, asp.Strength(**{name: value}), "film") for value in (1e9, 4e9))
        for body, found in ((weak, set()), (strong, {criterion})):
            for solid in (body, asp.Layered([asp.Layer(body, thickness=5e-6)], base=elastic(1e9))):
                made = asp.contact.advise(asp.ContactProblem(SMOOTH, solid), asp.MeanPressure(1e6))
                assert {item.criterion for item in made if item.level == "warning"} == found
                assert all(
                    "4 GPa" in item.message and "2 GPa" in item.message for item in made if item.criterion == criterion
                )


def test_friction_in_per_cent():
    uneven = np.full(SMOOTH.shape, 0.3)
    uneven[0, 0] = 2.5
    assert before(SMOOTH, friction=asp.Coulomb(1.9)) == ()
    for law in (asp.Coulomb(30.0), asp.Coulomb(uneven)):
        (found,) = before(SMOOTH, friction=law)
        assert (found.level, found.criterion) == ("warning", "friction coefficient")
        assert f"{law.largest:g}" in found.message


def test_heights_that_no_surface_has():
    """A unit too large or too small; at any lateral scale."""
    for factor, counter in ((1e-6, False), (1e6, False), (1e6, True)):
        odd = asp.Surface(factor * SMOOTH.heights, factor * 1e-6, periodic=True)
        flat = replace(odd, heights=0.0 * odd.heights)
        found = before(flat, counter_surface=odd) if counter else before(odd)
        assert criteria(found) == {"height of the counter surface" if counter else "height of the surface"}
    assert before(SMOOTH) == ()
