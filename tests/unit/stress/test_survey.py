"""The survey of the stresses of a contact: planes that show it, true maxima, sections through them,
a stream of planes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from contact_cases import TIGHT, elastic, rough, square_grid
from reference_data import reference
from refusals import refused

import asperity as asp
from asperity.core.tensor import STRESSES, StressTensor
from asperity.physics.stress import boundaries
from asperity.physics.stress import survey as survey_module
from asperity.physics.stress.compute import StressPlanes
from asperity.physics.stress.criteria import Criterion, Limit, MaxPrincipal, Tresca, VonMises, sqrt_J2
from asperity.physics.stress.regions import DepthProfile, Plane, Section, Where, selection
from asperity.physics.stress.survey import (
    RATIO,
    StressRequest,
    WantedProfile,
    WantedSection,
    line_depths,
    survey,
    survey_depths,
)

FILM = asp.Elastic(3.0, 0.25, asp.Strength(yield_stress=0.5), name="film")
SOFT = asp.Elastic(0.5, 0.4, name="soft")
BASE = asp.Elastic(1.0, 0.3, asp.Strength(hardness=0.28), name="base")
COATED = asp.Layered([asp.Layer(FILM, 1.5), asp.Layer(SOFT, 1.0)], BASE)


def contact(
    body: asp.Layered | asp.Elastic = COATED, boundary: object = asp.Periodic(), **keys: object
) -> asp.ContactResult:
    surface = rough((24, 18), 3, spacing=(1.0, 1.5), power=2.0)
    problem = asp.ContactProblem(surface, body, boundary=boundary, **keys)  # type: ignore[arg-type]
    return asp.solve(problem, asp.MeanPressure(0.02), solver=TIGHT)


@pytest.fixture(scope="module")
def coated() -> asp.ContactResult:
    return contact()


SLIDING = StressRequest(friction=0.3, direction=0.5)


class Heard:
    """Progress that keeps the number of every plane and the share that was left."""

    def __init__(self) -> None:
        self.planes: list[tuple[int, float]] = []

    def update(self, iteration: int, error: float, tolerance: float) -> None:
        self.planes.append((iteration, error))


@pytest.mark.parametrize(
    "boundary",
    [asp.Periodic(), pytest.param(asp.Free(), marks=pytest.mark.slow)],  # its kernels take ten seconds
    ids=["periodic", "free"],
)
@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_maxima_are_those_of_the_whole_field(boundary: object, dtype: str) -> None:
    """Against all principal stresses of all points on the same planes; the pruned search must not
    miss one."""
    result = contact(boundary=boundary)
    found = survey(replace(SLIDING, dtype=dtype), result)
    field = asp.stress(result, found.depths, friction=0.3, direction=0.5, dtype=dtype)
    assert [part.region.name for part in found.maxima] == ["film", "soft", "base"]
    for part in found.maxima:
        within = field.within(part.region.index)
        for peak, values in (
            (part.von_mises, within.von_mises),
            (part.tension, within.max_principal),
            (part.shear, within.max_shear),
        ):
            expected = within.peak(values)
            rounding = 64.0 * float(np.finfo(dtype).eps) * float(within.von_mises.max())
            assert peak.value == pytest.approx(expected.value, abs=rounding)
            at = within.planes.index(next(p for p in within.planes if (p.depth, p.side) == (peak.depth, peak.side)))
            point = round(peak.x / field.spacing[0]), round(peak.y / field.spacing[1])
            assert values[at][point] == pytest.approx(expected.value, abs=rounding)
    assert [(item.above, item.below) for item in found.interfaces] == [("film", "soft"), ("soft", "base")]
    for item, expected in zip(found.interfaces, field.interfaces, strict=True):
        assert item.shear.value == pytest.approx(expected.shear.max(), rel=1e-6)
        assert item.peel.value == pytest.approx(expected.peel.max(), rel=1e-6)
        assert item.shear.depth == expected.depth
    again = asp.first_yield(field)
    assert [part.load_factor for part in found.yielding.regions] == pytest.approx(
        [part.load_factor for part in again.regions], nan_ok=True
    )
    assert found.yielding.first is not None
    assert found.yielding.first.region.name in ("film", "base"), "the strength of the soft layer is not known"


def test_a_sphere_yields_where_hertz_says() -> None:
    """τ_max of the table; 0.7 % of planes, and 2 % of pixels of a/16 (found: 0.5 % in all)."""
    row = next(r for r in reference("hertz_yield_onset") if r["nu"] == 0.33)
    grid, radius, modulus = square_grid(64, 4.0), 100.0, 1.0
    x, y = grid.centred_coordinates()
    surface = asp.Surface(-(x**2 + y**2) / (2.0 * radius), *grid.spacing)
    body = asp.Elastic(modulus * (1.0 - 0.33**2), 0.33, asp.Strength(yield_stress=1.0))
    force = 4.0 * modulus / (3.0 * radius)  # contact radius 1
    result = asp.solve(asp.ContactProblem(surface, body, boundary=asp.Free()), asp.Force(force), solver=TIGHT)
    p0 = 2.0 * modulus / (math.pi * radius)
    found = survey(StressRequest(), result)
    (part,) = found.maxima
    assert part.von_mises.value / p0 == pytest.approx(1.0 / float(row["p0_over_Y"]), rel=0.027)
    assert part.shear.value / p0 == pytest.approx(float(row["tau_max_over_p0"]), rel=0.027)
    assert part.von_mises.depth == pytest.approx(float(row["z_over_a"]), rel=RATIO - 1.0)
    assert found.depths[-1] == pytest.approx(3.0, rel=0.1)


def test_depths_show_contact_and_layers(coated: asp.ContactResult) -> None:
    request = StressRequest(depths=(0.7, 1.5 * (1.0 + 1e-12)))
    depths = survey_depths(request, coated)
    assert depths[0] == 0.0
    assert np.all(np.diff(depths) > 1e-6)
    for needed in (0.7, 1.5, 2.5):
        assert np.abs(depths - needed).min() < 1e-9
    inside = [np.count_nonzero((depths > low) & (depths < high)) for low, high in ((0.0, 1.5), (1.5, 2.5))]
    assert min(inside) >= 3
    resolved = depths[depths >= 0.75]  # half a pixel
    assert (resolved[1:] / resolved[:-1]).max() <= RATIO * 1.12
    below = survey_depths(replace(request, deepest=1.0), coated)
    assert below[below > 1.0] == pytest.approx([1.5, 2.5]), "interfaces, and what is asked for"
    assert line_depths(replace(request, deepest=1.0), coated)[-1] == 1.0


def test_interfaces_far_below_the_contact_count_but_are_not_drawn() -> None:
    """A thick coating: its interface carries little, but its maxima and those of the base are
    known."""
    body = asp.Layered([asp.Layer(FILM, 300.0)], BASE)
    found = survey(SLIDING, contact(body))
    assert found.depths[-1] == 300.0
    assert [part.region.name for part in found.maxima] == ["film", "base"]
    assert found.maxima[1].von_mises.depth == 300.0
    assert len(found.interfaces) == 1
    assert all(section.field.depth[-1] < 100.0 for section in found.sections)
    assert {plane.region.name for plane in found.sections[0].field.planes} == {"film"}


def test_sections_that_end_at_an_interface_stay_above_it(coated: asp.ContactResult) -> None:
    found = survey(replace(SLIDING, deepest=1.5), coated)
    last = found.sections[0].field.planes[-1]
    assert (last.depth, last.side) == (1.5, "above")
    assert survey(replace(SLIDING, deepest=1.6), coated).sections[0].field.planes[-1].region.name == "soft"


def test_planes_alone_need_no_others(coated: asp.ContactResult) -> None:
    request = StressRequest(depths=(0.7, 0.0, 0.7), sections=())
    assert survey_depths(request, coated).tolist() == [0.0, 0.7]
    found = survey(request, coated)
    assert (found.sections, found.profiles) == ((), ())
    assert [part.region.name for part in found.maxima] == ["film"]


def test_graded_coating_does_not_multiply_the_planes() -> None:
    body = asp.Layered(asp.solids.graded(FILM, BASE, 2.0, sublayers=40), BASE)
    found = survey(StressRequest(), contact(body))
    assert len(found.depths) < 90
    assert len(found.maxima) == 41


def test_sections_through_the_maximum_of_each_stress(coated: asp.ContactResult) -> None:
    """Each stress is shown on the plane through its own maximum (Peng 2001, figs. 3.15 - 3.22)."""
    found = survey(SLIDING, coated)
    shown = {quantity: section.field for section in found.sections for quantity in section.quantities}
    assert set(shown) == {"von_mises", "principal_tensile", "shear_xz"}
    field = asp.stress(coated, found.depths, friction=0.3, direction=0.5)
    for quantity, section in shown.items():
        values, cut = getattr(field, quantity), getattr(section, quantity)
        assert section.dims == ("plane", "x")
        if quantity == "shear_xz":
            values, cut = np.abs(values), np.abs(cut)
        assert cut.max() == pytest.approx(values.max(), rel=1e-12)
        row = int(np.unravel_index(values.argmax(), values.shape)[2])
        np.testing.assert_allclose(cut, values[:, :, row], rtol=1e-12, atol=1e-14)
    along_y = survey(replace(SLIDING, sections=(WantedSection("x", "max"),)), coated)
    assert {q for s in along_y.sections for q in s.quantities} == {"von_mises", "principal_tensile", "shear_yz"}
    assert all(section.field.dims == ("plane", "y") for section in along_y.sections)


def test_sections_at_a_position_and_at_the_highest_pressure(coated: asp.ContactResult) -> None:
    """A position is that of figures: 4.0 lies in the pixel from 3.0 to 4.5, whose node is at
    3.0."""
    sections = (WantedSection("y", 4.0), WantedSection("y", "pressure"))
    at, under = survey(replace(SLIDING, sections=sections), coated).sections
    assert float(at.field.y) == 3.0
    assert at.quantities == ("von_mises", "principal_tensile", "shear_xz")
    direct = asp.stress(
        coated,
        at.field.depth[np.diff(at.field.depth, prepend=-1.0) > 0.0],
        on=asp.stresses.Section(y=3.0),
        friction=0.3,
        direction=0.5,
    )
    for name in STRESSES:
        np.testing.assert_allclose(getattr(at.field.tensor, name), getattr(direct.tensor, name), atol=1e-12)
    row = int(np.unravel_index(coated.pressure.argmax(), coated.pressure.shape)[1])
    assert float(under.field.y) == pytest.approx(row * 1.5)
    ends = survey(replace(SLIDING, sections=(WantedSection("y", 0.0), WantedSection("y", 27.0))), coated).sections
    assert [float(section.field.y) for section in ends] == [0.0, 25.5]


def test_profiles(coated: asp.ContactResult) -> None:
    profiles = (WantedProfile("max", "max"), WantedProfile("pressure", "pressure"), WantedProfile(2.2, "max"))
    found = survey(replace(SLIDING, sections=(), profiles=profiles), coated)
    deepest, under, at = found.profiles
    assert all(field.dims == ("plane",) for field in found.profiles)
    assert deepest.von_mises.max() == pytest.approx(max(part.von_mises.value for part in found.maxima))
    i, j = np.unravel_index(coated.pressure.argmax(), coated.pressure.shape)
    assert (float(under.x), float(under.y)) == (pytest.approx(i), pytest.approx(1.5 * j))
    assert under.normal_zz[0] == pytest.approx(-coated.pressure.max(), rel=1e-9)
    assert float(at.x) == 2.0
    assert float(at.y) == float(deepest.y)


def test_maxima_alone(coated: asp.ContactResult) -> None:
    whole, alone = survey(SLIDING, coated), survey(SLIDING, coated, lines=False)
    assert alone.sections == ()
    np.testing.assert_array_equal(alone.depths, whole.depths)
    assert [p.von_mises for p in alone.maxima] == [p.von_mises for p in whole.maxima]


def test_planes_are_computed_anew(coated: asp.ContactResult) -> None:
    found = survey(SLIDING, coated)
    planes = list(found.planes([0.0, 1.5]))
    assert [plane.planes[0].side for plane in planes] == ["surface", "above", "below"]
    assert max(float(sqrt_J2(plane.tensor).max()) for plane in planes) <= max(
        part.von_mises.value for part in found.maxima
    ) / math.sqrt(3.0) * (1.0 + 1e-12)


def test_counter_body_carries_the_opposite_shear() -> None:
    """Of a body against itself both sides carry the same stresses but for the sign of the shear."""
    result = contact(BASE, counter_body=BASE)
    one, other = (survey(replace(SLIDING, of=of), result) for of in ("body", "counter_body"))  # type: ignore[arg-type]
    assert other.maxima[0].von_mises.value == pytest.approx(one.maxima[0].von_mises.value, rel=0.5)
    mirrored = survey(replace(SLIDING, direction=0.5 + math.pi), result)
    assert other.maxima[0].von_mises.value == pytest.approx(mirrored.maxima[0].von_mises.value, rel=1e-12)


def test_no_contact_has_no_stress(coated: asp.ContactResult) -> None:
    bare = replace(coated, pressure=np.zeros_like(coated.pressure))
    found = survey(SLIDING, bare)
    assert all(part.von_mises.value == 0.0 for part in found.maxima)
    assert found.yielding.load_factor == math.inf


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.FreeLine()], ids=lambda b: b.name)
def test_line_contacts(boundary: object) -> None:
    """Rigid cylinder of plane strain (Johnson 1985, sect. 4.2c): τ_max 0.30 p0 at 0.78 of the
    half-width, on these planes."""
    x = (np.arange(256) - 127.5) / 32.0
    surface = asp.Surface(-(x[:, None] ** 2) / 200.0, 1.0 / 32.0, 1.0)
    body = elastic(1.0)
    problem = asp.ContactProblem(surface, body, boundary=boundary)  # type: ignore[arg-type]
    result = asp.solve(problem, asp.Force(math.pi / 400.0), solver=TIGHT)  # half-width 1: P = π E* a²/(4R)
    found = survey(StressRequest(profiles=(WantedProfile("max", "max"),)), result)
    (part,) = found.maxima
    p0 = 1.0 / 200.0
    if isinstance(boundary, asp.FreeLine):
        assert part.shear.value / p0 == pytest.approx(0.30, rel=0.02)
        assert part.shear.depth == pytest.approx(0.78, rel=RATIO - 1.0)
    assert all(section.field.dims == ("plane", "x") for section in found.sections)
    assert found.depths[-1] == pytest.approx(3.0, rel=0.1)


@pytest.mark.parametrize("late", [False, True])
def test_sections_are_those_of_whole_planes_however_late_their_place_is_known(
    coated: asp.ContactResult, monkeypatch: pytest.MonkeyPatch, late: bool
) -> None:
    """Cut out of planes as they are read, or if ``late`` computed by themselves on all planes."""
    request = StressRequest(
        friction=0.3,
        depths=(0.3,),
        sections=(WantedSection("y", "max"), WantedSection("x", "max")),
        profiles=(WantedProfile("max", "max"),),
    )
    computed: list[Plane] = []
    along = StressPlanes.along

    def counted(self: StressPlanes, lines: Sequence[Where], plane: Plane) -> list[asp.stresses.StressField]:
        computed.append(plane)
        return along(self, lines, plane)

    monkeypatch.setattr(StressPlanes, "along", counted)
    if late:
        monkeypatch.setattr(survey_module._Passed, "cutting", lambda self, lines: self._job.read)
    found = survey(request, coated)
    whole = asp.stress(coated, found.depths, friction=0.3)
    assert (len(computed) == len(whole.planes)) == late
    for section in (*(section.field for section in found.sections), *found.profiles):
        place = selection(_where(section), coated.problem.grid, coated.pressure).index
        scale = float(np.abs(whole.normal_zz).max())
        for name in STRESSES:
            expected = getattr(whole.tensor, name)[: len(section.planes)][(slice(None), *place)]
            np.testing.assert_allclose(getattr(section.tensor, name), expected, atol=1e-13 * scale)


def _where(field: asp.stresses.StressField) -> Where:
    """Points of ``field``."""
    if "x" in field.dims:
        return Section(y=float(field.y))
    return Section(x=float(field.x)) if "y" in field.dims else DepthProfile(float(field.x), float(field.y))


class Sum:
    """A criterion of a user: σxx + σzz against a strength."""

    name = "sum"
    citation_keys = ()

    def equivalent(self, stress: StressTensor) -> np.ndarray:
        return stress.xx + stress.zz

    def limit(self, material: asp.Elastic) -> Limit:
        return Limit(0.01)


@pytest.mark.parametrize("criterion", [VonMises(), Tresca(), MaxPrincipal(0.004), Sum()], ids=lambda c: c.name)
def test_yield_is_that_of_whole_planes(coated: asp.ContactResult, criterion: Criterion) -> None:
    """Largest equivalent stresses, and what is beyond the limit, by criteria that are bounded and
    by one that is not."""
    found = survey(replace(SLIDING, criterion=criterion), coated)
    expected = asp.first_yield(asp.stress(coated, found.depths, friction=0.3, direction=0.5), criterion)
    for one, other in zip(found.yielding.regions, expected.regions, strict=True):
        assert one.region == other.region
        assert one.peak.value == pytest.approx(other.peak.value, rel=1e-12)
        assert (one.peak.x, one.peak.y, one.peak.depth) == (other.peak.x, other.peak.y, other.peak.depth)
        assert one.yielded_volume == pytest.approx(other.yielded_volume, nan_ok=True)
    if criterion.name != "Tresca":
        assert max(part.yielded_volume for part in found.yielding.regions) > 0.0


@pytest.mark.parametrize("threads", [1, 2])
def test_maxima_do_not_depend_on_threads_or_blocks(
    coated: asp.ContactResult, monkeypatch: pytest.MonkeyPatch, threads: int
) -> None:
    whole = survey(SLIDING, coated, threads=1)
    monkeypatch.setattr(boundaries, "_POINTS", 50)
    monkeypatch.setattr(boundaries, "LONG_SERIAL_BELOW", 0)
    parts = survey(SLIDING, coated, threads=threads)
    for one, other in zip(parts.maxima, whole.maxima, strict=True):
        for name in ("von_mises", "tension", "shear"):
            a, b = getattr(one, name), getattr(other, name)
            assert a.value == pytest.approx(b.value, rel=1e-13)
            assert (a.x, a.y, a.depth, a.side) == (b.x, b.y, b.depth, b.side)
    for one, other in zip(parts.interfaces, whole.interfaces, strict=True):
        assert (one.shear.value, one.peel.value) == pytest.approx((other.shear.value, other.peel.value), rel=1e-13)


def test_progress_counts_down(coated: asp.ContactResult) -> None:
    heard = Heard()
    survey(SLIDING, coated, progress=heard)
    assert [number for number, _ in heard.planes] == list(range(1, len(heard.planes) + 1))
    assert heard.planes[-1][1] == 0.0
    assert np.all(np.diff([left for _, left in heard.planes]) < 0.0)


@pytest.mark.parametrize(
    ("request_", "body", "subject", "shown"),
    [
        (StressRequest(of="counter_body"), COATED, "body in which stresses are asked", "counter body"),
        (
            StressRequest(depths=(9.0,)),
            asp.Layered([asp.Layer(FILM, 2.0)], asp.RigidBase()),
            "depth (m)",
            "2, but is 9",
        ),
        (
            StressRequest(friction=0.1),
            asp.Layered([asp.Layer(FILM, 2.0, asp.Frictionless())], BASE),
            "mean shear traction",
            "frictionless",
        ),
        (
            StressRequest(sections=(WantedSection("x", 25.0),)),
            COATED,
            "x of a stress section",
            "24 m",
        ),
        (
            StressRequest(profiles=(WantedProfile("max", 28.0),)),
            COATED,
            "y of a stress profile",
            "27 m",
        ),
    ],
)
def test_what_there_is_no_stress_of_is_refused(request_: StressRequest, body: object, subject: str, shown: str) -> None:
    problem = asp.ContactProblem(rough((24, 18), spacing=(1.0, 1.5)), body)  # type: ignore[arg-type]
    with refused(asp.InputError, subject, shown):
        request_.check(problem)
    StressRequest(sections=(WantedSection("x", 24.0),)).check(problem)


def test_section_of_one_point_is_refused() -> None:
    problem = asp.ContactProblem(rough((24, 1)), BASE)
    with refused(asp.InputError, "stress section"):
        StressRequest(sections=(WantedSection("x", "max"),)).check(problem)
    StressRequest().check(problem)
