"""A document of a small rough contact, complete and plain."""

from __future__ import annotations

from typing import Any

PLAIN: dict[str, Any] = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [48, 32],
        "size": "2 um x 2 um",
        "seed": 5,
        "spectrum": {"kind": "gaussian", "rms_height": "4 nm", "correlation_length": "0.3 um"},
    },
    "body": {"material": "steel"},
    "control": {"mean_pressure": "40 MPa"},
}
