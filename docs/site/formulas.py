"""Formulas as docstrings write them, in plain characters, turned into TeX."""

from __future__ import annotations

import inspect
import re

SIGNS = {
    "≤": r"\le ", "≥": r"\ge ", "≈": r"\approx ", "∝": r"\propto ", "∞": r"\infty ", "·": r"\cdot ", "×": r"\times ",
    "±": r"\pm ", "∫": r"\int ", "Σ": r"\sum ", "∂": r"\partial ", "∇": r"\nabla ", "→": r"\to ", "ℓ": r"\ell ",
    "ħ": r"\hbar ", "α": r"\alpha ", "β": r"\beta ", "γ": r"\gamma ", "δ": r"\delta ", "ε": r"\varepsilon ",
    "ζ": r"\zeta ", "η": r"\eta ", "θ": r"\theta ", "κ": r"\kappa ", "λ": r"\lambda ", "μ": r"\mu ", "ν": r"\nu ",
    "ξ": r"\xi ", "π": r"\pi ", "ρ": r"\rho ", "σ": r"\sigma ", "τ": r"\tau ", "φ": r"\varphi ", "χ": r"\chi ",
    "ψ": r"\psi ", "ω": r"\omega ", "Γ": r"\Gamma ", "Δ": r"\Delta ", "Θ": r"\Theta ", "Λ": r"\Lambda ",
    "Π": r"\Pi ", "Φ": r"\Phi ", "Ψ": r"\Psi ", "Ω": r"\Omega ", "−": "-", "…": r"\dots ",
}  # fmt: skip
RAISED = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻ⁿ½", [*"0123456789-n", "1/2"], strict=True))
LOWERED = dict(zip("₀₁₂₃₄₅₆₇₈₉", "0123456789", strict=True))
FUNCTIONS = ("exp", "log", "ln", "sin", "cos", "tan", "sinh", "cosh", "min", "max", "arccos", "arcsin", "arctan")
NAMED = ("erfc", "erf", "artanh", "arcosh", "sgn", "Re", "Im", "Var")
TEXT = ("if", "or", "of", "in", "at", "on", "is", "to")


def tex(formula: str) -> str:
    """TeX of one formula such as ``"p = (4/3) η E* R^(1/2) σ_s^(3/2) F_(3/2)"``.

    Indices and exponents of more than one sign stand in round brackets or are one word; two spaces
    part formulas on one line; words of three and more letters are text.
    """
    made = re.sub(r"[⁰¹²³⁴⁵⁶⁷⁸⁹⁻ⁿ½]+", lambda m: "^(" + "".join(RAISED[c] for c in m[0]) + ")", formula.strip())
    made = re.sub(r"[₀-₉]+", lambda m: "_(" + "".join(LOWERED[c] for c in m[0]) + ")", made)
    made = made.replace("{", r"\{").replace("}", r"\}").replace("%", r"\%")
    made = re.sub(r"√(\(|\w+)", lambda m: "sqrt(" + ("" if m[1] == "(" else m[1] + ")"), made)
    made = re.sub(r"([A-Za-zα-ωΑ-Ωℓ])\*(?=$|[^\w(])", r"\1^(*)", made)
    made = re.sub(r"([A-Za-zα-ωΑ-Ωℓ])\*(?=[\w(])", r"\1^(*) ", made)
    made = _grouped(made)
    made = re.sub(r"\((\d+)/(\d+)\)(?!\^)", r"\\tfrac{\1}{\2}", made)
    made = re.sub(r"(.)[\u0304\u0305]", r"\\bar{\1}", made)
    made = re.sub(r"(.)\u0302", r"\\hat{\1}", made)
    made = re.sub(r"(.)\u0303", r"\\tilde{\1}", made)
    made = re.sub(r"_([A-Za-z]{3,})", r"_{\\mathrm{\1}}", made)
    made = re.sub(r"_([A-Za-z]{2})(?![A-Za-z])", r"_{\1}", made)
    made = re.sub(r"\^([A-Za-z]{2,}|\d{2,})", r"^{\1}", made)
    made = re.sub(r"  +", r" \\quad ", made)
    made = re.sub(r"(?<![\\A-Za-z{])[A-Za-z]{2,}", _word, made)
    made = re.sub(r"_\{([a-z]{3,}|eq)\}", r"_{\\mathrm{\1}}", made)
    made = re.sub(r"^\\,|(?<=/)\\,", "", made)
    return "".join(SIGNS.get(sign, sign) for sign in made)


def _word(found: re.Match[str]) -> str:
    word = found[0]
    if word in FUNCTIONS:
        return rf"\{word} "
    if word in NAMED:
        return rf"\operatorname{{{word}}}"
    if re.fullmatch(r"d[A-Za-z]", word):
        return rf"\,d{word[1]}"
    if word in TEXT or (len(word) > 2 and word.lower() == word):
        return rf"\text{{ {word} }}"
    return word


def _grouped(text: str) -> str:
    """``text`` whose indices, exponents and roots in round brackets stand in braces."""
    made, place = "", 0
    while place < len(text):
        opens = next((word for word in ("sqrt(", "^(", "_(") if text.startswith(word, place)), None)
        if opens is None:
            made, place = made + text[place], place + 1
            continue
        depth, end = 1, place + len(opens)
        while depth and end < len(text):
            depth += {"(": 1, ")": -1}.get(text[end], 0)
            end += 1
        if depth:
            raise ValueError(f"a bracket of {text!r} is not closed")
        inside = _grouped(text[place + len(opens) : end - 1])
        made, place = made + {"sqrt(": r"\sqrt", "^(": "^", "_(": "_"}[opens] + "{" + inside + "}", end
    return made


def is_formula(line: str) -> bool:
    """Whether a line of a docstring is a formula: a relation between symbols, without words and
    code."""
    words = re.findall(r"(?<![A-Za-z_])[A-Za-z]{3,}", re.sub(r"_\(?[A-Za-z]+\)?", "", line))
    symbols = all(word in (*FUNCTIONS, *NAMED, "sqrt", "rms") for word in words)
    return symbols and not re.search(r"``|>>>", line) and bool(re.search(r"\S (=|≈|∝|<|>|≤|≥) \S", line))


def paragraphs(docstring: str) -> list[tuple[str, list[str]]]:
    """A docstring before its first section: ("text" or "formula", lines) in turn.

    Python dedents the formulas of a docstring that has nothing else after its first line, so the
    indent does not count.
    """
    head = re.split(r"\n[A-Z]\w+\n-{3,}\n", inspect.cleandoc(docstring))[0]
    blocks = [block.splitlines() for block in re.split(r"\n\s*\n", head.strip())]
    return [
        ("formula" if place and all(map(is_formula, lines)) else "text", lines) for place, lines in enumerate(blocks)
    ]


def formulas(docstring: str) -> list[str]:
    """TeX of the formulas that stand on lines of their own in a docstring."""
    return [
        tex(line.strip().rstrip(".,")) for kind, lines in paragraphs(docstring) if kind == "formula" for line in lines
    ]
