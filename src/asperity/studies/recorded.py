"""Answers of studies as plain values in a file."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

from ..io.atomic import atomic_file


class Recorded:
    """Answer that gives itself as plain values."""

    def record(self) -> dict[str, Any]:
        """Everything as plain values, SI; what is not known is None."""
        raise NotImplementedError

    def save_json(self, path: str | Path, *, overwrite: bool = False) -> None:
        """Write ``record`` to the JSON file ``path``, whole or not at all.

        Raises
        ------
        OutputError
            If the file exists and ``overwrite`` is false, or cannot be written.
        """
        with atomic_file(path, overwrite=overwrite) as partial:
            text = json.dumps(self.record(), indent=2, ensure_ascii=False)
            partial.write_text(text + "\n", encoding="utf-8", newline="\n")


def plain(value: Any) -> Any:
    """``value`` with lists for tuples, and None for numbers that are not known or infinite."""
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
