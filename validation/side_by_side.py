"""Tables of our numbers beside those of an independent solution of the same problem, as
Markdown."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Pair:
    """One number of ours and of the independent solution."""

    ours: float
    independent: float

    @property
    def deviation(self) -> float:
        """Ours over the independent one, less one."""
        return self.ours / self.independent - 1.0


@dataclass(frozen=True)
class Comparison:
    """Rows of a table: texts that say the case, then pairs of numbers; ``agreement`` is the
    relative bound on each column."""

    title: str
    about: str
    cases: tuple[str, ...]
    quantities: tuple[str, ...]
    rows: tuple[tuple[tuple[str, ...], tuple[Pair, ...]], ...]
    agreement: tuple[float, ...]
    digits: int = 5

    def worst(self, quantity: str) -> float:
        """Largest deviation in the column ``quantity``, without sign."""
        column = self.quantities.index(quantity)
        return max(abs(pairs[column].deviation) for _, pairs in self.rows)

    @property
    def agrees(self) -> bool:
        """Whether every column keeps its bound."""
        return all(self.worst(name) <= bound for name, bound in zip(self.quantities, self.agreement, strict=True))

    def markdown(self) -> str:
        """The whole page."""
        head = [*self.cases, *(f"{name}: {who}" for name in self.quantities for who in ("ours", "independent"))]
        lines = [f"# {self.title}", "", self.about, "", "| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
        for texts, pairs in self.rows:
            numbers = [f"{value:.{self.digits}f}" for pair in pairs for value in (pair.ours, pair.independent)]
            lines.append("| " + " | ".join((*texts, *numbers)) + " |")
        lines += ["", "| quantity | largest relative deviation | expected |", "|---|---|---|"]
        lines += [
            f"| {name} | {self.worst(name):.1e} | below {bound:.1e} |"
            for name, bound in zip(self.quantities, self.agreement, strict=True)
        ]
        return "\n".join(lines) + "\n"


def write(comparison: Comparison, script: str) -> None:
    """Write the page beside its ``script``; exit status 1 if it disagrees."""
    path = Path(script).with_suffix(".md")
    path.write_text(comparison.markdown(), encoding="utf-8")
    print(f"{path.name}: {'agrees' if comparison.agrees else 'DISAGREES'}")
    if not comparison.agrees:
        raise SystemExit(1)
