"""Branches of adhesive contacts through their folds: Maugis' unstable branch, folds of
Lennard-Jones spheres, histories of grips."""

from __future__ import annotations

import math

import numpy as np
import pytest
from adhesive_cases import APPROACH, FORCE, LENGTH, RADIUS, WORK, sphere, strength_of
from analytic.test_soft_core_contact import SPACING, beyond, work_of
from analytic.test_soft_core_contact import sphere as soft_sphere
from reference_data import reference
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError, NoSolutionError
from asperity.physics.adhesion.law import DugdaleAdhesion, ExponentialAdhesion
from asperity.theories.adhesion.spheres import maugis_at_ring


def test_unstable_branch_of_maugis():
    """Dugdale's law whose end falls over its whole range: the fold and what lies beyond, to the
    parting of the last point."""
    problem = sphere(96, 4.0, DugdaleAdhesion(WORK, WORK / strength_of(1.5), smoothing=1.0))
    start = asp.solve(problem, asp.FixedGrips(0.0))
    branch = asp.adhesion.adhesive_branch(start, points=31, step=0.15)
    assert branch.length.size == 31
    theory = maugis_at_ring(1.5, np.exp(np.linspace(-8.0, 8.0, 4000)))
    for approach, force in zip(branch.approach / APPROACH, branch.force / FORCE, strict=True):
        away = np.hypot(theory.approach - approach, theory.load - force).min()
        assert away < 0.012  # of a curve that is 1.6 high; the smoothed end alone takes 0.004
    # the areas, where the contact is ten pixels wide
    inside = (branch.contact_fraction > 0.003) & ~branch.stable
    assert inside.sum() >= 3
    for k in np.flatnonzero(inside):
        nearest = np.argmin(
            np.hypot(theory.approach - branch.approach[k] / APPROACH, theory.load - branch.force[k] / FORCE)
        )
        radius = math.sqrt(branch.contact_fraction[k] * problem.grid.area / math.pi) / LENGTH
        assert radius == pytest.approx(theory.radius[nearest], abs=1.0 * 4.0 / 96.0)
    (fold,) = branch.folds
    row = next(row for row in reference("adhesion/maugis_transition") if row["lambda"] == 1.5)
    assert fold.approach / APPROACH == pytest.approx(row["delta_fold_norm"], abs=0.01)
    assert branch.pull_off_force / FORCE == pytest.approx(row["minus_P_pulloff_norm"], rel=5e-3)
    # the sign of the smallest eigenvalue changes at the fold, and nowhere else
    assert branch.stable[: fold.index + 1].all()
    assert not branch.stable[fold.index + 1 :].any()


@pytest.mark.parametrize("points", [48, 72])
def test_a_steep_fall_of_the_attraction_does_not_stop_a_branch(points):
    """The zone of Dugdale's law loses single points of a coarse grid one after the other, which
    turns the branch back each time."""
    law = DugdaleAdhesion(WORK, WORK / strength_of(1.0), smoothing=0.2)
    problem = sphere(points, 4.5, law)
    branch = asp.adhesion.adhesive_branch(asp.solve(problem, asp.FixedGrips(0.0)), farthest=-1.2 * APPROACH)
    assert branch.approach[-1] < -APPROACH
    assert branch.force[-1] == pytest.approx(0.0, abs=1e-9 * FORCE)
    row = next(row for row in reference("adhesion/maugis_transition") if row["lambda"] == 1.0)
    assert branch.pull_off_force / FORCE == pytest.approx(row["minus_P_pulloff_norm"], rel=5e-3)
    # two folds of the sphere, and on the coarser grid further ones of the last rings of points
    first, *_, last = branch.folds
    assert first.approach / APPROACH == pytest.approx(row["delta_fold_norm"], abs=0.015)
    apex = 0.5 * problem.grid.spacing[0] * problem.grid.spacing[1] / (2.0 * RADIUS)
    # the steps around the second fold are as long as the gap between the last two equilibria, 5 %
    # of the range
    assert last.approach == pytest.approx(-1.1 * law.range - apex, abs=0.05 * law.range)
    assert problem.grid.spacing[0] < branch.needed_pixel


def test_a_branch_that_single_points_cut_names_the_pixel_it_needs():
    law = ExponentialAdhesion(WORK, WORK / strength_of(2.0))
    deep = [asp.solve(sphere(points, 4.5, law), asp.FixedGrips(0.0)) for points in (16, 40)]
    branch = asp.adhesion.adhesive_branch(deep[1], farthest=-1.2 * APPROACH)
    assert branch.approach[-1] < -APPROACH
    pixels = [found.problem.grid.spacing[0] for found in deep]
    assert pixels[1] < branch.needed_pixel < pixels[0]
    with refused(NoSolutionError, "step along the branch", f"{branch.needed_pixel:.3g} m", f"{pixels[0]:.3g} m"):
        asp.adhesion.adhesive_branch(deep[0], farthest=-1.2 * APPROACH)


@pytest.mark.slow
@pytest.mark.parametrize("tabor", [1.0, 2.0])
def test_folds_of_lennard_jones_spheres(tabor):
    """Jump-off and jump-in of the reference, from one branch, which leads from the contact to
    surfaces that lie apart."""
    row = next(row for row in reference("adhesion/lennard_jones_pulloff") if row["tabor_mu"] == tabor)
    law = asp.adhesion.LennardJonesAdhesion(work_of(tabor), SPACING)
    points, half = {1.0: (64, 5.0), 2.0: (144, 4.8)}[tabor]
    problem = soft_sphere(law, points, half)
    branch = asp.adhesion.adhesive_branch(asp.solve(problem, asp.FixedGrips(0.0)), farthest=-6.0 * SPACING)
    off, on = branch.folds
    apex = 0.25 * problem.grid.spacing[0] ** 2  # the highest points lie that much below the apex
    for fold, event in ((off, "delta_jump_off_over_z0"), (on, "delta_jump_in_over_z0")):
        # the box lacks the far field, and ℓ is five pixels where Tabor's parameter is 2
        assert (fold.approach + apex) / SPACING == pytest.approx(row[event], abs=0.01 * tabor**2)
    unit = math.pi * law.work
    least = int(np.argmin(branch.force))
    pull_off = branch.pull_off_force / unit - beyond(law, half, float(branch.approach[least]))
    assert pull_off == pytest.approx(row["minus_P_pulloff_norm"], rel=3e-3)
    assert (branch.stable == (branch.turn > 0.0)).all()


@pytest.mark.slow
def test_stable_parts_are_what_grips_hold_and_jumps_are_at_folds():
    problem = sphere(64, 4.0, ExponentialAdhesion(WORK, WORK / strength_of(2.0)))
    deep = asp.solve(problem, asp.FixedGrips(0.0))
    branch = asp.adhesion.adhesive_branch(deep, farthest=-3.0 * APPROACH, step=0.2)
    for k in (3, 8, int(np.flatnonzero(branch.stable)[-3])):
        held = asp.solve(problem, asp.FixedGrips(float(branch.approach[k])), state=deep.state)
        if branch.force[k] < -0.7 * FORCE:
            assert held.external_force == pytest.approx(branch.force[k], rel=1e-3)
            assert held.adhesion.margin == pytest.approx(branch.margin[k], abs=0.01)
    # around the first, where single points leave the wall one after the other, the branch goes to
    # and fro by less than the steps of the search for a jump
    off, *between, on = branch.folds
    assert all(abs(fold.approach - off.approach) < 0.004 * APPROACH for fold in between)
    way = np.linspace(0.0, -1.2, 25) * APPROACH
    history = asp.solve(problem, asp.History([asp.FixedGrips(float(d)) for d in [*way, *way[-2::-1]]]))
    tolerance = 1e-3 * APPROACH
    jumps = asp.adhesion.adhesive_jumps(history, tolerance)
    assert len(jumps) == 2
    for jump, fold in zip(jumps, (off, on), strict=True):
        assert jump.width <= tolerance
        assert jump.grips == pytest.approx(fold.approach, abs=0.004 * APPROACH)
        assert jump.before.external_force == pytest.approx(fold.force, abs=0.08 * FORCE)
        assert jump.lost > 0.0
    # over the cycle the jumps lose what the loop encloses; its long steps know where the jumps were
    # to a step
    loop = asp.adhesion.adhesion_loop(history.steps)
    closed = loop.closed_in(jumps)
    lost = sum(jump.lost for jump in jumps)
    assert lost == pytest.approx(loop.hysteresis, abs=loop.hysteresis_error)
    assert closed.hysteresis == pytest.approx(lost, rel=1e-9)
    assert lost == pytest.approx(np.trapezoid(loop.force, loop.approach), abs=loop.hysteresis_error)
    assert sum(jump.lost_error for jump in jumps) < 0.05 * lost
    for jump, between in zip(jumps, loop.jump_intervals, strict=True):
        assert min(between) <= jump.grips <= max(between)
    # from the other side the branch leads back
    back = asp.adhesion.adhesive_branch(history.steps[24], towards="approaching", deepest=0.0, step=0.2)
    assert [fold.approach for fold in back.folds] == pytest.approx([on.approach, off.approach], abs=2e-3 * APPROACH)
    assert (
        np.abs(np.diff(branch.energy) + np.diff(-branch.approach) * 0.5 * (branch.force[1:] + branch.force[:-1]))
        < 2e-3 * WORK * LENGTH**2
    ).all()


def test_what_cannot_be_followed_is_refused():
    jkr = asp.solve(sphere(16, 5.0, asp.adhesion.JKRAdhesion(WORK)), asp.FixedGrips(0.1 * APPROACH))
    with refused(InputError, "adhesion"):
        asp.adhesion.adhesive_branch(jkr)
    law = ExponentialAdhesion(WORK, WORK / strength_of(0.5))
    found = asp.solve(sphere(16, 5.0, law), asp.FixedGrips(0.1 * APPROACH))
    with refused(InputError, "direction of a branch"):
        asp.adhesion.adhesive_branch(found, towards="up")
    with refused(InputError, "number of points of a branch"):
        asp.adhesion.adhesive_branch(found, points=1)
    with refused(InputError, "approach of the contact"):
        asp.adhesion.adhesive_branch(found, farthest=APPROACH)
    slides = asp.solve(sphere(16, 5.0, law, friction=asp.Coulomb(0.3)), asp.FixedGrips(0.1 * APPROACH))
    with refused(InputError, "problem of a branch"):
        asp.adhesion.adhesive_branch(slides)
    with refused(InputError, "tolerance of the jumps (m)"):
        asp.adhesion.adhesive_jumps(asp.solve(found.problem, asp.History([asp.FixedGrips(RADIUS * 1e-4)])), 0.0)
    with refused(InputError, "control of a history whose jumps are sought"):
        asp.adhesion.adhesive_jumps(asp.solve(found.problem, asp.History([asp.Force(FORCE)])), 1e-9)
