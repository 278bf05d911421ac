"""The pages on joints that conduct: their claims hold on fewer or smaller surfaces, and they are
those of their scripts."""

import conductance_pictures
import conductance_stiffness
import joint_conductance
import pytest
from validation_pages import assert_claims_hold, assert_written_by_script

from asperity.theories.conductance.joints import PlasticJoint


def test_theory_of_the_page_is_that_of_the_package():
    exact, fitted = joint_conductance.theory()
    theory = PlasticJoint(1.0, 1.0, 1.0, 1.0)
    assert exact == pytest.approx(theory.at_pressure(joint_conductance.SHARES).conductance)
    assert fitted == pytest.approx([1.25 * share**0.95 for share in joint_conductance.SHARES])


@pytest.mark.slow
def test_plastic_joints_on_a_quarter_of_the_points():
    page = joint_conductance.page(points=512, surfaces=3)
    assert_claims_hold(page)
    assert_written_by_script(page, "joint_conductance")


@pytest.mark.slow
def test_stiffness_and_conductance_of_half_of_the_surfaces():
    page = conductance_stiffness.page(surfaces=2)
    assert_claims_hold(page)
    assert_written_by_script(page, "conductance_stiffness")


def test_pictures_are_those_of_the_pages():
    assert set(conductance_pictures.FIGURES) == {"joint_conductance", "conductance_stiffness"}
