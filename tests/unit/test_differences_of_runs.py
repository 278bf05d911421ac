"""Numbers of two runs and what differs between them, as the page Explore shows them."""

from __future__ import annotations

import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

from asperity.web.differences import rows_of_differences


def test_numbers_of_both_and_their_difference() -> None:
    first = {"mean_pressure": 60e6, "n_spots": 7.0, "area_fraction_corrected": 0.04, "approach": None}
    second = {"mean_pressure": 40e6, "n_spots": 9.0, "area_fraction_corrected": 0.03, "approach": 1e-9}
    rows = {label: texts for label, *texts in rows_of_differences(first, second)}
    assert rows["mean pressure"] == ["60 MPa", "40 MPa", "20 MPa"]
    assert rows["contact spots"] == ["7", "9", "-2"]
    assert [float(text.removesuffix(" %")) for text in rows["real contact area"]] == pytest.approx([4.0, 3.0, 1.0])
    assert "approach" not in rows, "what one of them does not know has no difference"
