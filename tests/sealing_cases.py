"""Document of a rough face that seals, for tests of its parts and doors."""

from __future__ import annotations

from typing import Any


def seal(points: int, **tables: Any) -> dict[str, Any]:
    """The face on a square grid of ``points``, with further ``tables``."""
    surface = {
        "kind": "rough",
        "points": [points, points],
        "size": "10 um",
        "seed": 2,
        "spectrum": {"kind": "gaussian", "rms_height": "100 nm", "correlation_length": "1 um"},
    }
    pressed = {"counter_body": {"rigid": True}, "control": {"mean_pressure": "300 MPa"}}
    return {"version": 2, "surface": surface, "body": "E=100GPa,nu=0.3", **pressed, **tables}
