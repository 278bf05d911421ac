"""Work of adhesion of pairs: the rule, measured energies, sources, own files, and what is refused."""

from __future__ import annotations

import math

import pytest
from refusals import refused

import asperity as asp
from asperity.contact.laws import VanDerWaalsAdhesion
from asperity.core.errors import InputError
from asperity.solids.surface_energy import solid_surfaces


def test_equal_surfaces_take_twice_their_energy():
    # A/(12π D0²) is the work of van der Waals' law of the same constant
    law = VanDerWaalsAdhesion.of_hamaker(6.5e-20)
    assert asp.work_of_adhesion("polystyrene", "PS").work == pytest.approx(law.work, rel=1e-12)


def test_pairs_are_geometric_means_in_either_order():
    one, other = (asp.work_of_adhesion(name, name).work for name in ("polystyrene", "wax"))
    for pair in (("polystyrene", "wax"), ("Wax", "polystyrene")):
        found = asp.work_of_adhesion(*pair)
        assert found.work == pytest.approx(math.sqrt(one * other), rel=1e-12)
        assert len(found.sources) == 2


def test_every_value_has_a_source_and_is_of_the_order_of_van_der_waals_forces():
    for record in solid_surfaces():
        assert record.sources
        assert 0.01 < record.energy < 0.1


def test_an_own_file_adds_surfaces(tmp_path):
    path = tmp_path / "own.toml"
    path.write_text('[solid_surface."tape"]\nsurface_energy = "30 mJ/m**2"\n[solid_surface."void"]\n', encoding="utf-8")
    assert asp.work_of_adhesion("tape", "tape", library=path).work == pytest.approx(0.06, rel=1e-12)
    with refused(InputError, "solid surface"):
        asp.work_of_adhesion("tape", "void", library=path)
    with refused(InputError, "solid surface"):
        asp.work_of_adhesion("tape", "gold")
