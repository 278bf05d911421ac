"""Wear coefficients of materials: units, at the doors, in files, of graded layers."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from refusals import refused

import asperity as asp
from asperity.core import units
from asperity.core.errors import InputError
from asperity.io.description import describe, rebuild
from asperity.io.schemas.bodies import BodyTable
from asperity.io.words import body_rows
from asperity.run.build import build_material
from asperity.solids.layers import LinearGrading, graded
from asperity.solids.library import materials


@pytest.mark.parametrize(
    "text",
    ["1e-6 mm^3/Nm", "1e-6mm³/(N·m)", "1e-6 mm^3/(N m)", "1e-6 mm**3/(N*m)", "1e-6mm3/N/m", "1e-15 m^2/N", "1e-6/GPa"],
)
def test_units(text: str) -> None:
    """A cubic millimetre per newton and metre is 1e-9 m²/N."""
    assert units.parse(text, "wear coefficient", "k") == pytest.approx(1e-15, rel=1e-12)


def test_shown_as_it_is_read() -> None:
    text = units.show(3.2e-16, "m**2/N")
    assert text.endswith("mm³/(N·m)")
    assert units.parse(text, "wear coefficient", "k") == pytest.approx(3.2e-16, rel=1e-12)


def test_the_library_knows_none() -> None:
    assert not [record.name for record in materials() if "wear_coefficient" in record.values]
    assert math.isnan(asp.material("steel").strength.wear_coefficient)


def test_text_of_a_body(tmp_path: Path) -> None:
    table = BodyTable.model_validate("DLC{kw=1e-7mm^3/Nm}:2um/steel{kw=1e-5mm^3/Nm,H=7GPa}")
    top = build_material(table.layers[0], None, tmp_path)  # type: ignore[arg-type]
    assert table.base is not None
    base = build_material(table.base, None, tmp_path)
    assert top.strength.wear_coefficient == pytest.approx(1e-16)
    assert base.strength.wear_coefficient == pytest.approx(1e-14)
    assert top.strength.hardness == asp.material("DLC").strength.hardness, "what is known stays"
    assert rebuild(describe(top)).strength.wear_coefficient == top.strength.wear_coefficient
    assert ("wear coefficient k_w", units.show(1e-16, "m**2/N")) in body_rows(top)


def test_own_materials(tmp_path: Path) -> None:
    path = tmp_path / "my.toml"
    value = '{ value = "2e-6 mm^3/Nm", source = "pin on disk" }'
    constants = 'youngs_modulus = "200 GPa"\npoisson_ratio = 0.3'
    path.write_text(f"[material.mine]\n{constants}\nwear_coefficient = {value}\n", encoding="utf-8")
    body = asp.material("mine", library=path)
    assert body.strength.wear_coefficient == pytest.approx(2e-15)
    assert "wear_coefficient: pin on disk" in body.sources


def test_of_graded_layers() -> None:
    ends = [asp.Elastic(1e9, 0.3, asp.Strength(wear_coefficient=k)) for k in (1e-15, 3e-15)]
    layers = graded(*ends, 1e-6, grading=LinearGrading(), sublayers=2)
    found = [layer.material.strength.wear_coefficient for layer in layers]
    assert found == pytest.approx([1.5e-15, 2.5e-15])


def test_refused() -> None:
    with refused(InputError, "wear coefficient (m²/N)", "-1"):
        asp.Strength(wear_coefficient=-1.0)
