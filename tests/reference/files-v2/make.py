"""Result files of format 2 and what they tell, written with the last asperity that wrote that
format (see README.md)."""

from __future__ import annotations

import json
import sys
from pathlib import Path

from stored_cases import CASES, told

import asperity as asp

folder = Path(sys.argv[1])
facts = {}
for name, made in CASES.items():
    result = made()
    asp.save(result, folder / f"{name}.nc", document="# a document", overwrite=True)
    facts[name] = told(asp.load(folder / f"{name}.nc"))
(folder / "facts.json").write_text(json.dumps(facts, indent=0, sort_keys=True) + "\n", encoding="utf-8")
