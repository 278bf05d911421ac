"""Partial slip of spheres, cylinders and waves: fields, loops, memory and any path of loading."""

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.core.quadrature import gauss
from asperity.theories import (
    Cone,
    HertzLine,
    HertzPoint,
    MindlinLine,
    MindlinPoint,
    MindlinWave,
    PartialSlip,
    PowerLawIndenter,
    SphericalIndenter,
)

DIGITS = 1e-12
"""Of values printed in sixteen digits: sums and differences of numbers of one size."""


@every_row(reference("friction/partial_slip_sinusoid"), label=lambda row: f"case{row['case']:g}")
def test_wave(row):
    E_star = 0.5 * row["E_each"] / (1.0 - row["nu_each"] ** 2)
    ratio = 1.0 if row["mode"] == "inplane" else 1.0 / (1.0 - row["nu_each"])
    wave = MindlinWave(E_star, row["gap_amplitude"], row["wavelength"], row["mu"], ratio)
    p, q = row["pbar"], row["qbar"]
    answer = wave.at_pressure(p, q)
    assert p == pytest.approx(row["pbar_over_pstar"] * wave.normal.full_contact_pressure, rel=DIGITS)
    assert answer.half_width == pytest.approx(row["a"], rel=DIGITS)
    assert answer.stick_half_width == pytest.approx(row["c"], rel=DIGITS)
    assert answer.displacement == pytest.approx(row["delta_t"], rel=1e-11)
    assert answer.dissipation == pytest.approx(row["W_cycle"], rel=1e-11)
    a, c = row["a"], row["c"]
    found = wave.traction([0.0, 0.5 * c, c, 0.5 * (a + c)], p, q)
    # at c the traction has a vertical tangent, where half of the digits of c count
    assert found[[0, 1, 3]] == pytest.approx([row["q_0"], row["q_c2"], row["q_mid"]], rel=1e-11)
    assert found[2] == pytest.approx(row["q_c"], rel=1e-7)


def test_wave_carries_its_mean_shear_and_slips_where_the_traction_is_at_the_limit():
    wave = MindlinWave(1.0, 0.01, 1.0, 0.4, 1.3)
    p = 0.6 * wave.normal.full_contact_pressure
    q = 0.25 * p
    answer = wave.at_pressure(p, q)
    a, c = float(answer.half_width), float(answer.stick_half_width)
    angle, weight = gauss(np.array([0.0, np.arcsin(c / a), 0.5 * np.pi]), 60)
    x = a * np.sin(angle)
    assert 2.0 * np.sum(weight * a * np.cos(angle) * wave.traction(x, p, q)) == pytest.approx(q, rel=1e-4)
    inside, outside = np.linspace(0.0, c, 9), np.linspace(c, a, 9)[1:-1]
    assert wave.slip(inside, p, q) == pytest.approx(0.0, abs=1e-15)
    assert np.all(wave.slip(outside, p, q) > 0.0)
    assert wave.traction(outside, p, q) == pytest.approx(0.4 * wave.normal.pressure(outside, p), rel=1e-12)
    assert wave.slip(0.5, p, q) < 0.4 * 1.3 * wave.normal.gap(0.5, 0.35 * p / 0.6)
    step = 1e-6 * q
    ahead, behind = (wave.at_pressure(p, q + s).displacement for s in (step, -step))
    assert 2.0 * step / (ahead - behind) == pytest.approx(float(answer.stiffness), rel=1e-8)


def test_gap_of_the_wave_is_that_of_the_profile_and_the_displacement_of_its_harmonics():
    """Pressure p_n cos 2πnx/λ moves by p_n λ/(πnE*) cos: ten thousand harmonics are summed by a
    transform."""
    wave, n = MindlinWave(1.0, 0.01, 1.0, 0.4).normal, 2**14
    x = np.arange(n) / n
    p = 0.5 * wave.full_contact_pressure
    modes = np.fft.rfft(wave.pressure(x, p))
    number = np.arange(modes.size)
    number[0] = 1
    modes[0] = 0.0
    moved = np.fft.irfft(modes / (np.pi * number), n)
    opened = 0.01 * (1.0 - np.cos(2.0 * np.pi * x)) + moved - moved[0]
    assert wave.gap(x, p) == pytest.approx(opened, abs=2e-7)  # roots at the edges: n^(-5/2) of the pressure


def test_pressed_flat_nothing_slips_until_the_gap_would_open():
    wave = MindlinWave(1.0, 0.01, 1.0, 0.5)
    full = wave.normal.full_contact_pressure
    answer = wave.at_pressure(1.5 * full, np.array([0.1, 0.25, 0.6]) * full)
    assert answer.displacement[:2] == pytest.approx(0.0, abs=1e-17)
    assert answer.dissipation[:2] == pytest.approx(0.0, abs=1e-17)
    assert np.isinf(answer.stiffness[0])
    assert answer.dissipation[2] > 0.0
    # just at p* both formulas of the loop hold
    at, above = (wave.at_pressure(s * full, 0.3 * full).dissipation for s in (1.0, 1.0 + 1e-12))
    assert above == pytest.approx(float(at), rel=1e-9)


@every_row(reference("friction/partial_slip_sphere_nu0"), label=lambda row: f"case{row['case']:g} {row['r_over_a']:g}")
def test_sphere_without_poissons_ratio(row):
    E_star = 0.5 * row["E_each"]
    ball = MindlinPoint(E_star, row["R"], E_star, row["mu"])
    P, Q, r = row["P"], row["Q"], row["r_over_a"] * row["a"]
    answer = ball.at_load(P, Q)
    assert answer.stick_radius == pytest.approx(row["c"], rel=DIGITS)
    assert answer.displacement == pytest.approx(row["delta_x"], rel=1e-11)
    assert ball.cycle_dissipation(P, Q) == pytest.approx(row["W_cycle"], rel=1e-11)
    assert ball.displacement(r, P, Q) == pytest.approx(2.0 * row["u_x_one_body"], rel=1e-11)
    if row["q"] != "":
        assert ball.traction(r, P, Q) == pytest.approx(row["q"], rel=1e-11, abs=1e-13 * row["P"] / row["a"] ** 2)
    if row["slip"] != "":
        assert ball.slip(r, P, Q) == pytest.approx(row["slip"], rel=1e-9, abs=1e-14 * row["delta_x"])


def test_springs_on_paths_of_approach_and_shift():
    """The table was made with 4e5 springs, exact in time, to 1e-9."""
    paths = {}
    for row in reference("friction/sphere_histories_nu0"):
        paths.setdefault(row["case"], []).append(row)
    for rows in paths.values():
        first, last = rows[0], rows[-1]
        contact = PartialSlip(HertzPoint(0.5 * first["E_each"], first["R"]), first["mu"])
        path = contact.under_shifts([row["approach"] for row in rows], [row["shift"] for row in rows])
        largest = max(row["P"] for row in rows)
        expected = {name: np.array([row[name] for row in rows]) for name in ("P", "Q", "W_total", "a")}
        assert path.load == pytest.approx(expected["P"], abs=1e-9 * largest)
        assert path.tangential == pytest.approx(expected["Q"], abs=1e-9 * first["mu"] * largest)
        assert path.dissipated == pytest.approx(expected["W_total"], abs=1e-9 * last["W_total"])
        assert contact.normal.at_load(path.load).radius == pytest.approx(expected["a"], rel=1e-8)


BALL = PartialSlip(HertzPoint(1.0, 1.0), 0.3, 1.2)
CONTACTS = {
    "ball": BALL,
    "cone": PartialSlip(Cone(1.0, 0.1), 0.5),
    "power": PartialSlip(PowerLawIndenter(1.0, 0.2, 1.5), 0.2, 1.4),
    "sphere": PartialSlip(SphericalIndenter(1.0, 1.0), 0.4),
}


@pytest.mark.parametrize("name", CONTACTS)
def test_a_step_is_exact_however_it_is_divided(name):
    """Seven random legs in one step each, and in steps divided at random."""
    contact, rng = CONTACTS[name], np.random.default_rng(3)
    P = 0.01 * (0.1 + rng.random(7))
    Q = contact.friction * P * rng.uniform(-1.0, 1.0, 7)
    corners = np.concatenate([[0], P]), np.concatenate([[0], Q])
    t = np.unique(np.concatenate([np.arange(8.0), rng.uniform(0.0, 7.0, 30)]))
    fine = contact.under_forces(*(np.interp(t, np.arange(8.0), values) for values in corners))
    at = np.searchsorted(t, np.arange(8.0))
    coarse = contact.under_forces(*corners)
    for quantity in ("load", "tangential", "approach", "shift", "stick_load", "dissipated"):
        whole, divided = getattr(coarse, quantity), getattr(fine, quantity)[at]
        assert whole == pytest.approx(divided, abs=1e-10 * np.abs(divided).max()), quantity
    assert np.all(np.diff(fine.dissipated) >= 0.0)


@pytest.mark.parametrize("name", ["ball", "cone", "power"])
def test_energy_of_a_path(name):
    """Work of the tangential force is that of friction and the elastic energy κ Σ ∫ m Q dδ of the
    memory."""
    contact, rng = CONTACTS[name], np.random.default_rng(5)
    depth = 0.02 * (0.2 + rng.random(5))
    bound = contact.friction * contact.ratio
    corners = np.concatenate([[0], depth]), np.concatenate([[0], bound * depth * rng.uniform(-1.5, 1.5, 5)])
    t = np.linspace(0.0, 5.0, 401)
    path = contact.under_shifts(*(np.interp(t, np.arange(6.0), values) for values in corners))
    work = np.concatenate([[0.0], np.cumsum(0.5 * (path.tangential[1:] + path.tangential[:-1]) * np.diff(path.shift))])

    def stored(memory):
        total, Q = 0.0, 0.0
        for i, m in enumerate(memory.slopes):
            delta, w = gauss(memory.approach[i : i + 2], 40)
            force = Q + m * (contact.normal.at_approach(delta).load - memory.load[i])
            total += contact.ratio * m * float(np.sum(w * force))
            Q += m * (memory.load[i + 1] - memory.load[i])
        return total

    energy = np.array([stored(memory) for memory in path.memories[::40]])
    scale = work.max()
    assert energy + path.dissipated[::40] == pytest.approx(work[::40], abs=1e-4 * scale)  # of the trapezoidal work


def test_paths_of_forces_and_of_shifts_are_one():
    forces = BALL.under_forces([1e-3] * 5, 0.3e-3 * np.array([0.0, 0.8, -0.5, 0.3, -0.2]))
    shifts = BALL.under_shifts(forces.approach, forces.shift)
    for quantity in ("tangential", "stick_load", "dissipated"):
        expected = getattr(forces, quantity)
        assert getattr(shifts, quantity) == pytest.approx(expected, abs=1e-11 * np.abs(expected).max())


def test_loop_at_constant_load_is_that_of_mindlin_and_deresiewicz():
    P, Q = 2e-3, 0.7 * 0.3 * 2e-3
    ball = MindlinPoint(1.0, 1.0, 1.0 / 1.2, 0.3)
    assert BALL.cycle_dissipation(P, Q) == pytest.approx(float(ball.cycle_dissipation(P, Q)), rel=1e-10)
    turns = np.linspace(-1.0, 1.0, 9)
    path = BALL.under_forces([P] * 21, Q * np.concatenate([[0.0, 0.5, 1.0], turns[::-1], turns]))
    first = [float(ball.at_load(P, 0.5 * Q * (1.0 - turn)).displacement) for turn in turns[::-1]]
    # Masing: the branches of the loop are the first loading, twice as large
    assert path.shift[2] - path.shift[3:12] == pytest.approx(2.0 * np.array(first), abs=1e-13)
    assert path.shift[12:] - path.shift[12] == pytest.approx(2.0 * np.array(first), abs=1e-13)
    r = np.linspace(0.0, 0.999, 40) * float(ball.normal.at_load(P).radius)
    assert BALL.traction(r, path.memories[2]) == pytest.approx(ball.traction(r, P, Q), rel=1e-12)
    # a closed cycle restores the traction
    assert BALL.traction(r, path.memories[-1]) == pytest.approx(ball.traction(r, P, Q), rel=1e-9)


def test_small_amplitudes_dissipate_as_their_cube():
    ball, P = MindlinPoint(1.0, 1.0, 0.8, 0.3), 1e-3
    s = np.array([1e-4, 1e-3])
    full = 0.3 * 1.25 * float(ball.normal.at_load(P).approach)
    expected = 4.0 / 27.0 * s**3 * 0.3 * P * full
    assert ball.cycle_dissipation(P, s * 0.3 * P) == pytest.approx(expected, rel=1e-3)
    for s, w in ((0.3, None), (1.0, 0.8)):
        y = (1.0 - s) ** (2.0 / 3.0)
        direct = 8.0 * (0.6 - y + 0.4 * y**2.5 - 0.5 * s * (1.0 - y))
        found = float(ball.cycle_dissipation(P, s * 0.3 * P)) / (0.3 * P * full)
        assert found == pytest.approx(direct, rel=1e-12)
        assert w is None or found == pytest.approx(w, rel=1e-12)


def test_any_path_of_a_wave():
    wave = MindlinWave(1.0, 0.01, 1.0, 0.4, 1.2)
    contact = PartialSlip(wave.contact, 0.4, 1.2)
    p = 0.6 * wave.normal.full_contact_pressure
    answer = wave.at_pressure(p, 0.2 * p)
    assert contact.cycle_dissipation(p, 0.2 * p) == pytest.approx(float(answer.dissipation), rel=1e-9)
    path = contact.under_forces([p, p, 0.5 * p, p], [0.0, 0.2 * p, 0.1 * p, 0.2 * p])
    assert path.shift[1] == pytest.approx(float(answer.displacement), rel=1e-12)
    same = contact.under_shifts(path.approach[:2], path.shift[:2])
    assert same.tangential[1] == pytest.approx(0.2 * p, rel=1e-9)
    x = np.linspace(0.0, 0.49, 9)
    assert contact.traction(x, path.memories[1]) == pytest.approx(wave.traction(x, p, 0.2 * p), rel=1e-12)
    with refused(InputError, "approach (m)"):
        contact.under_shifts([0.02], [0.0])


def test_line_and_light_wave_are_one():
    """Crests of a lightly pressed wave are cylinders, also in the slip and the loop."""
    line = MindlinLine(1.0, 1.0 / (4.0 * np.pi**2 * 0.01), 0.4, 1.2)
    wave = MindlinWave(1.0, 0.01, 1.0, 0.4, 1.2)
    p = 1e-6 * wave.normal.full_contact_pressure
    Q = np.array([0.1, 0.7, 1.0]) * 0.4 * p
    answer = wave.at_pressure(p, Q)
    assert answer.stick_half_width == pytest.approx(line.at_load(p, Q).stick_radius, rel=1e-6)
    assert answer.dissipation == pytest.approx(line.cycle_dissipation(p, Q), rel=1e-6)
    x = np.linspace(0.0, 0.999, 7) * float(answer.half_width[0])
    assert wave.slip(x, p, Q[1]) == pytest.approx(line.slip(x, p, Q[1]), rel=1e-4, abs=1e-15)
    tiny = np.array([1e-5, 1e-4]) * 0.4 * p
    cubes = line.cycle_dissipation(p, tiny) / tiny**3
    assert cubes[0] == pytest.approx(cubes[1], rel=1e-3)


def test_line_histories_need_no_approach():
    contact, line = PartialSlip(HertzLine(1.0, 1.0), 0.3), MindlinLine(1.0, 1.0, 0.3)
    path = contact.under_forces([1e-3, 1e-3], [0.0, 1e-4])
    assert path.stick_load[-1] == pytest.approx(1e-3 - 1e-4 / 0.3, rel=1e-14)
    x = np.linspace(0.0, 0.03, 11)
    assert contact.traction(x, path.memories[-1]) == pytest.approx(line.traction(x, 1e-3, 1e-4), rel=1e-12)
    with refused(InputError, "normal contact"):
        contact.under_shifts([1e-3], [1e-4])


def test_oblique_loading_sticks_below_the_angle_of_friction():
    path = BALL.under_forces([0.0, 1e-3, 2e-3], [0.0, 0.25e-3, 0.25e-3 - 0.2e-3])
    assert path.dissipated[-1] == 0.0
    assert path.stick_load == pytest.approx(path.load)
    steep = BALL.under_forces([1e-3, 2e-3], [0.0, 0.4e-3])
    assert 0.0 < steep.stick_load[-1] < 1e-3
    assert steep.dissipated[-1] > 0.0


def test_contact_lost_and_made_again_has_no_memory():
    path = BALL.under_shifts([1e-3, 1e-3, -1e-3, 1e-3, 1e-3], [0.0, 2e-4, 5e-4, 5e-4, 7e-4])
    assert path.tangential[2] == path.load[2] == 0.0
    assert path.tangential[3] == pytest.approx(0.0, abs=1e-18)
    assert path.tangential[4] == pytest.approx(path.tangential[1], rel=1e-12)
    # the way down in pieces
    t = np.linspace(0.0, 1.0, 6)
    pieces = BALL.under_shifts(1e-3 - 2e-3 * t, 2e-4 + 3e-4 * t, start=path.memories[1])
    assert pieces.dissipated[-1] == pytest.approx(path.dissipated[2] - path.dissipated[1], rel=1e-9)


def test_gross_sliding_dissipates_force_times_way():
    path = BALL.under_shifts([1e-3, 1e-3, 1e-3], [0.0, 1.0, 2.0])
    assert path.tangential[-1] == pytest.approx(0.3 * path.load[-1], rel=1e-14)
    assert path.dissipated[-1] - path.dissipated[-2] == pytest.approx(path.tangential[-1], rel=1e-12)


def test_refusals():
    with refused(InputError, "tangential force"):
        BALL.under_forces([1e-3], [1e-3])
    with refused(InputError, "path"):
        BALL.under_forces([1e-3, 2e-3], [0.0, 0.0, 0.0])
    with refused(InputError, "friction coefficient"):
        PartialSlip(HertzPoint(1.0, 1.0), 0.0)
    with refused(InputError, "tangential force"):
        MindlinPoint(1.0, 1.0, 1.0, 0.3).slip(0.0, 1.0, 0.3)
