"""Inventories of other libraries' names, written for Sphinx from the list kept in
``inventories.toml``."""

from __future__ import annotations

import tempfile
import tomllib
import zlib
from pathlib import Path


def written(path: Path) -> dict[str, tuple[str, str]]:
    """``intersphinx_mapping`` to the documentation of the libraries in the file at ``path``; needs
    no network."""
    folder = Path(tempfile.mkdtemp(prefix="inventories-"))
    mapping = {}
    for library, table in tomllib.loads(path.read_text(encoding="utf-8")).items():
        lines = [f"{name} py:{kind} 1 {page} -" for name, (kind, page) in table["names"].items()]
        head = (
            f"# Sphinx inventory version 2\n# Project: {library}\n# Version: \n# The remainder of this "
            "file is compressed using zlib.\n"
        )
        inventory = folder / f"{library}.inv"
        inventory.write_bytes(head.encode() + zlib.compress("\n".join([*lines, ""]).encode()))
        mapping[library] = (table["url"], str(inventory))
    return mapping
