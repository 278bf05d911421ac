"""Table of the largest stresses for other programs."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest
from contact_cases import TIGHT, rough

import asperity as asp
from asperity.io.export import export_csv
from asperity.physics.stress.survey import Strengths, StressRequest, survey

FILM = asp.Elastic(3.0, 0.25, asp.Strength(yield_stress=0.5), name="film")
SOFT = asp.Elastic(0.5, 0.4, name="soft")
COATED = asp.Layered([asp.Layer(FILM, 1.5), asp.Layer(SOFT, 1.0)], asp.Elastic(1.0, 0.3, name="base"))


def test_table_of_maxima(tmp_path: Path) -> None:
    contact = asp.solve(asp.ContactProblem(rough((16, 12), 3, power=2.0), COATED), asp.MeanPressure(0.02), solver=TIGHT)
    found = survey(StressRequest(friction=0.3, strengths=Strengths(tensile=1.0)), contact)
    export_csv(found, tmp_path / "s.csv")
    with (tmp_path / "s.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == [
        "part",
        "name",
        "top",
        "bottom",
        "quantity",
        "value",
        "unit",
        "x",
        "y",
        "depth",
        "side",
        "error",
        "doubt",
    ]
    (dx, dy), peak = contact.problem.grid.spacing, found.maxima[0].von_mises
    assert (float(rows[0]["x"]), float(rows[0]["y"])) == (peak.x + 0.5 * dx, peak.y + 0.5 * dy), "as in reports"
    values = {(row["name"], row["quantity"]): row for row in rows}
    for part in found.maxima:
        assert float(values[part.region.name, "max_von_mises"]["value"]) == part.von_mises.value
        assert float(values[part.region.name, "max_sqrt_J2"]["value"]) == pytest.approx(part.von_mises.value / 3.0**0.5)
        assert float(values[part.region.name, "max_principal"]["depth"]) == part.tension.depth
    for name, peak in found.whole.items():
        row = values["", f"max_{name}"]
        assert (float(row["value"]), float(row["x"]), float(row["depth"])) == (
            peak.value,
            peak.x + 0.5 * dx,
            peak.depth,
        )
    assert list(found.whole) == ["principal_tensile", "shear_xz", "shear_yz"]
    assert float(values["film/soft", "max_shear"]["value"]) == found.interfaces[0].shear.value
    assert values["base", "max_shear"]["bottom"] == "inf"
    assert values["soft", "load_factor_to_yield"]["value"] == "nan"
    assert values["film", "yielded_volume"]["unit"] == "m**3"
    with pytest.raises(asp.errors.OutputError):
        export_csv(found, tmp_path / "s.csv")
