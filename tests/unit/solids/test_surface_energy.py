"""Work of adhesion of pairs: the rule, measured energies, sources, own files, and what is
refused."""

from __future__ import annotations

import math

import pytest
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.physics.adhesion.law import VanDerWaalsAdhesion
from asperity.physics.adhesion.surface_energy import solid_pairs, solid_surfaces


def test_equal_surfaces_take_twice_their_energy():
    # A/(12π D0²) is the work of van der Waals' law of the same constant
    law = VanDerWaalsAdhesion.of_hamaker(6.5e-20)
    assert asp.adhesion.work_of_adhesion("polystyrene", "PS").work == pytest.approx(law.work, rel=1e-12)


def test_pairs_are_geometric_means_in_either_order():
    one, other = (asp.adhesion.work_of_adhesion(name, name).work for name in ("polystyrene", "wax"))
    for pair in (("polystyrene", "wax"), ("Wax", "polystyrene")):
        found = asp.adhesion.work_of_adhesion(*pair)
        assert found.work == pytest.approx(math.sqrt(one * other), rel=1e-12)
        assert len(found.sources) == 2


def test_every_value_has_a_source_and_is_of_the_order_of_van_der_waals_forces():
    for record in solid_surfaces():
        assert record.sources
        assert not record.name.count("/")
        assert 0.01 < record.energy < 0.1


def test_measured_pairs_win_over_the_rule(tmp_path):
    found = asp.adhesion.work_of_adhesion("PDMS", "PS")
    assert found.work == pytest.approx(48.0e-3, rel=1e-12)
    assert found == asp.adhesion.work_of_adhesion("Polystyrene", "polydimethylsiloxane")
    (source,) = found.sources
    assert source.startswith("polystyrene/PDMS, ")
    one, other = (asp.adhesion.work_of_adhesion(name, name).work for name in ("PS", "PDMS"))
    assert found.work == pytest.approx(math.sqrt(one * other), rel=0.15)  # 54.8 mJ/m² by the rule
    # a value of one's own is taken instead
    path = tmp_path / "own.toml"
    path.write_text('[solid_surface."PDMS"]\nsurface_energy = "20 mJ/m**2"\n', encoding="utf-8")
    own = asp.adhesion.work_of_adhesion("PS", "PDMS", library=path)
    assert own.work == pytest.approx(math.sqrt(one * 0.04), rel=1e-12)


@pytest.mark.parametrize("record", solid_pairs(), ids=lambda record: record.name)
def test_every_pair_is_found_by_its_names_in_either_order(record):
    for both in (record.name, *record.aliases):
        first, second = both.split("/")
        for pair in ((first, second), (second, first)):
            assert asp.adhesion.work_of_adhesion(*pair).work == record.work_of_adhesion.value
    assert 0.01 < record.work_of_adhesion.value < 0.5
    assert not record.work_of_adhesion.assumed


def test_an_own_file_adds_surfaces(tmp_path):
    path = tmp_path / "own.toml"
    path.write_text('[solid_surface."tape"]\nsurface_energy = "30 mJ/m**2"\n[solid_surface."void"]\n', encoding="utf-8")
    assert asp.adhesion.work_of_adhesion("tape", "tape", library=path).work == pytest.approx(0.06, rel=1e-12)
    with refused(InputError, "solid surface"):
        asp.adhesion.work_of_adhesion("tape", "void", library=path)
    with refused(InputError, "solid surface"):
        asp.adhesion.work_of_adhesion("tape", "gold")
