"""What goes past a soft house limit or keeps a cache, each with its reason. An entry that is not in use fails."""

from __future__ import annotations

LIMITS: dict[tuple[str, str], str] = {}
"""Reason by (limit, dotted name). Limits: "file lines", "function lines", "parameters", "public methods".

Example: ("function lines", "asperity.contact.solve.solve"): "one loop; its parts share seven local arrays".
"""

CACHES: dict[str, str] = {
    "asperity.core.units._registry": "pint's registry takes a tenth of a second to build and does not change afterwards",
}
"""Reason by dotted name of the cached function."""
