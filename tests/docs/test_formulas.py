"""Pages of theory draw their formulas: none is left as text or as code."""

from __future__ import annotations

import re
from pathlib import Path

import formulas
import pytest
from doc_pages import BLOCK, DOCS

THEORY = DOCS / "theory"
PAGES = sorted(path for path in THEORY.glob("*.md") if path.stem != "index")
SIGN = re.compile(r"[α-ωΑ-Ωℓ√∫∞∂∇Σ≤≥≈∝·²³⁴]")
"""What stands in formulas only; the micro of units is another character."""
SYMBOL = re.compile(r"[A-Za-z](_\w{1,2})?[*']?(/[A-Za-z](_\w{1,2})?[*']?)?")


def parts(page: Path) -> tuple[list[str], str]:
    """Code within the lines of ``page``, and its text without code and formulas."""
    text = BLOCK.sub("", page.read_text(encoding="utf-8"))
    text = re.sub(r"\$\$.*?\$\$|\$[^$]*\$", "", text, flags=re.DOTALL)
    return re.findall(r"`([^`]*)`", text), re.sub(r"`[^`]*`", "", text)


def is_formula(code: str) -> bool:
    """Whether ``code`` is no code, but a symbol or a formula in plain characters."""
    return bool(SIGN.search(code) or SYMBOL.fullmatch(code) or formulas.is_formula(code))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_formulas_are_drawn(page):
    code, prose = parts(page)
    left = [one for one in code if is_formula(one)]
    # a number of points such as 96² and an area in µm² are no formulas
    words = re.sub(r"(\d|\b[kmµn]?m|\bs)[²³⁴]|10[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+", "", prose)
    left += [word for word in words.split() if SIGN.search(word) or re.search(r"\bE\*|\b[A-Za-z]_\w", word)]
    assert left == [], f"{page.name}: write these between dollar signs"


def test_a_formula_in_code_is_found():
    assert all(map(is_formula, ("κ", "E*", "h_i", "a/π", "n = η F_0", "p = 3 x")))
    assert not any(map(is_formula, ("at_load", "friction=Coulomb(mu)", "asp.dynamics", "moments=", "[stress]")))


def test_theories_of_rough_surfaces_state_their_formulas_on_lines_of_their_own():
    for name in ("statistical-contact", "scaling-theories"):
        text = (THEORY / f"{name}.md").read_text(encoding="utf-8")
        sections = re.split(r"^## ", text, flags=re.MULTILINE)[1:]
        without = [s.splitlines()[0] for s in sections if "$$" not in s]
        assert without in ([], ["Limits of validity"]), name
