"""Error bars asked for by a document, in numbers, figures and words."""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np

from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...core.engine import CpuEngine
from ...core.status import Advice
from ...core.units import percent, show
from ...parts.part import Found, Rows, Solved, Table, WithFacts, Words
from ...plots.picture import Figure, figures_by
from ..conductance.conductance import FLOWS, require_conducting
from .figures import Contributing, share_plots
from .one_load import require_pressure_alone
from .outputs import Output, PressureNorm
from .parameters import HARDNESS, HEIGHTS, LOAD, parameters
from .part_uncertainty import ASKED, UncertaintySettings
from .uncertainty import NOISE, HeightNoise, Uncertainty, uncertainty
from .work import CONDUCTANCES, in_words, layer_in_words, require_strength, yielding_norms
from .yielding import STRENGTH, FirstYield

EXPONENT = 16.0
"""Of the norm for a peak pressure."""

NEAR = 0.5
"""Share of stress over strength in the layer that yields first from which a layer is near to it."""

LINEAR = 0.2
"""Relative standard deviation above which linear error bars are in doubt."""

_KEYS = {"youngs_modulus": "moduli", "poisson_ratio": "poisson_ratios", "thickness": "thicknesses"}


class UncertaintyWork(WithFacts):
    """Error bars of numbers of the contact: what is done for them."""

    citation_keys: ClassVar[tuple[str, ...]] = ("Giles2000", "Squire1998")

    def check(self, ask: UncertaintySettings, problem: ContactProblem) -> None:
        """Refuse contacts that have no derivatives, and what is not known of the materials."""
        require_pressure_alone(problem)
        for name in ask.of:
            if name in CONDUCTANCES:
                require_conducting(problem, FLOWS[name.removesuffix("_conductance")])
            if name == "yield":
                require_strength(problem)

    def compute(self, ask: UncertaintySettings, solved: Solved) -> Found:
        """Error bar of each number, and the share of each source."""
        reached = solved.at(ask.step)
        engine = None if solved.threads is None else CpuEngine(solved.threads)
        scatter = scatter_of(ask, solved.problem)
        noise = HeightNoise(float(ask.noise), float(ask.noise_length)) if ask.noise else None
        names, values, findings = [*scatter, *([NOISE] if noise else [])], dict[str, Any](), list[Advice]()
        parts = dict[str, dict[str, float]]()
        how: dict[str, Any] = {"noise": noise, "samples": ask.samples, "seed": ask.seed, "engine": engine}
        for name in ask.of:
            with solved.stage(f"uncertainty of the {ASKED[name][1]}"):
                if name == "yield":
                    found, layers = _of_yield(reached.result, scatter, how)
                    values |= layers
                else:
                    of: str | Output = PressureNorm(EXPONENT) if name == "peak_pressure" else name
                    own = {key: deviation for key, deviation in scatter.items() if key != STRENGTH}
                    found = uncertainty(reached.result, of, own, **how)
            values |= _values(name, found, names)
            parts[name] = dict(found.parts)
            findings += _findings(name, found)
        values["uncertainty_source"] = np.array(names, object)
        words = {key: "noise of the heights" if key == NOISE else _named(key, solved.problem) for key in names}
        facts = {
            "of": list(ask.of),
            "words": words,
            "scatter": scatter,
            "noise": float(ask.noise),
            "parts": parts,
            "samples": int(ask.samples),
            "where": reached.where,
        }
        return Found(values, facts, tuple(findings), self.citation_keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Bars of the contributions to each error bar."""
        facts = found.detail
        names = [str(name) for name in found.values["uncertainty_source"]]
        shown = Contributing(
            tuple(facts["words"][name] for name in names),
            {
                ASKED[of][1]: np.array([100.0 * facts["parts"][of].get(name, 0.0) for name in names])
                for of in facts["of"]
            },
        )
        return figures_by(share_plots(shown), shown)

    def words(self, found: Found, solved: Solved) -> Words:
        """Each error bar, and where it comes from."""
        facts, values = found.detail, found.values
        names = [str(name) for name in values["uncertainty_source"]]
        said, headline, rows, tables = list[str](), list[tuple[str, str]](), Rows(), list[tuple[str, Table]]()
        for of in facts["of"]:
            unit, label = ASKED[of]
            low, high, middle = (float(values[f"uncertainty_{end}_{of}"]) for end in ("low", "high", "median"))
            relative = float(values[f"uncertainty_{of}"])
            shares = np.asarray(values[f"uncertainty_share_{of}"], dtype=float)
            order = np.argsort(-shares, kind="stable")
            amount = f"{show(middle, unit, 4)} ± {percent(relative, 2)}"
            said.append(
                f"The {label} is {amount}, in 95 % of cases from {show(low, unit, 3)} to {show(high, unit, 3)}; "
                f"largest source: {facts['words'][names[order[0]]]}, {percent(float(shares[order[0]]), 2)} of the "
                "variance."
            )
            headline.append((label, amount))
            rows.append((f"{label}, 95 %", f"{show(low, unit, 4)} to {show(high, unit, 4)}"))
            if facts["samples"]:
                bias, error = (float(values[f"uncertainty_{end}_{of}"]) for end in ("bias", "bias_error"))
                rows.append(
                    (
                        f"bias of the mean {label} in {facts['samples']} samples",
                        f"{percent(bias, 2)} ± {percent(error, 2)}",
                    )
                )
                rows.append(
                    (f"deviation of the {label} in samples", percent(float(values[f"uncertainty_sampled_{of}"]), 2))
                )
            cells = tuple(
                (
                    facts["words"][names[k]],
                    show(facts["noise"], "m", 3) if names[k] == NOISE else percent(facts["scatter"][names[k]], 2),
                    percent(facts["parts"][of][names[k]], 2),
                    percent(float(shares[k]), 2),
                )
                for k in order
                if names[k] in facts["parts"][of]
            )
            headings = ("Source", "Its deviation", f"Deviation of the {label}", "Share of the variance")
            tables.append((f"Where the uncertainty of the {label} comes from", Table(headings, cells)))
        if "uncertainty_yield_layer" in values:
            columns = (values[f"uncertainty_yield_{key}"] for key in ("layer", "factor", "deviation"))
            layers = tuple(
                (str(name), f"{factor:.4g}", percent(float(deviation), 2))
                for name, factor, deviation in zip(*columns, strict=True)
            )
            tables.append(("First yield by layer", Table(("Layer", "Load factor", "Its deviation"), layers)))
        if facts["where"]:
            rows.insert(0, ("at", facts["where"]))
        return Words(" ".join(said), headline, rows, tuple(tables), _REMARKS)


_REMARKS = (
    "Sources are independent; each modulus, Poisson's ratio and thickness has an error of its own. The load is held.",
)


def scatter_of(ask: UncertaintySettings, problem: ContactProblem) -> dict[str, float]:
    """Standard deviation of the logarithm of each parameter, by its name."""
    found = {each.name: float(getattr(ask, _KEYS[each.constant.kind])) for each in parameters(problem)}
    if np.all(np.isfinite(problem.law.pressure_cap())):
        found[HARDNESS] = float(ask.hardness)
    found |= {LOAD: float(ask.load), HEIGHTS: float(ask.height_scale), STRENGTH: float(ask.strengths)}
    return {name: deviation for name, deviation in found.items() if deviation}


def _of_yield(
    result: ContactResult, scatter: dict[str, float], how: dict[str, Any]
) -> tuple[Uncertainty, dict[str, Any]]:
    """Error bar of the load factor of the layer that yields first, and values of all layers that
    are near to it."""
    norms = yielding_norms(result)
    near = [norm for share, norm in norms if share >= NEAR * max(share for share, _ in norms)]
    alone = {key: value for key, value in how.items() if key not in ("samples", "seed")}
    bars = [(norm, uncertainty(result, FirstYield(norm), scatter, **alone)) for norm in near]
    bars.sort(key=lambda item: item[1].value)
    first = uncertainty(result, FirstYield(bars[0][0]), scatter, **how) if how["samples"] else bars[0][1]
    return first, {
        "uncertainty_yield_layer": np.array([layer_in_words(norm, result.problem) for norm, _ in bars], object),
        "uncertainty_yield_factor": np.array([bar.value for _, bar in bars]),
        "uncertainty_yield_deviation": np.array([bar.relative for _, bar in bars]),
    }


def _named(key: str, problem: ContactProblem) -> str:
    return "scale of the heights" if key == HEIGHTS else in_words(key, problem)


def _values(name: str, found: Uncertainty, sources: list[str]) -> dict[str, Any]:
    """Values of one number by name."""
    low, high = found.interval
    values: dict[str, Any] = {
        f"uncertainty_median_{name}": found.value,
        f"uncertainty_{name}": found.relative,
        f"uncertainty_low_{name}": low,
        f"uncertainty_high_{name}": high,
        f"uncertainty_share_{name}": np.array([found.shares.get(source, 0.0) for source in sources]),
    }
    if found.sampled is not None:
        values |= {
            f"uncertainty_bias_{name}": found.bias,
            f"uncertainty_bias_error_{name}": found.sampled.mean_error / abs(found.value),
            f"uncertainty_sampled_{name}": found.sampled.deviation / abs(found.value),
        }
    return values


def _findings(name: str, found: Uncertainty) -> list[Advice]:
    """What should be known before the error bar of one number is used."""
    label, wide = ASKED[name][1], found.relative > LINEAR
    if found.sampled is None and (wide or found.parts.get(NOISE, 0.0) > 0.5 * LINEAR):
        fact = (
            f"The relative uncertainty of the {label}, {percent(found.relative, 2)}, is so large that the linear "
            "estimate misses what follows from the square."
        )
        numbers = {"uncertainty": found.relative, "largest": LINEAR}
        remedy = "Ask for samples ({uncertainty.samples=50})."
        return [Advice("warning", "linear uncertainty", fact, remedy, numbers, (f"uncertainty_{name}",))]
    if found.sampled is not None and math.isfinite(found.bias):
        error = found.sampled.mean_error / abs(found.value)
        if abs(found.bias) > max(3.0 * error, 0.5 * found.relative):
            fact = (
                f"The mean of the {label} in samples differs from that of the contact by {percent(found.bias, 2)}, "
                f"as much as its uncertainty, {percent(found.relative, 2)}."
            )
            numbers = {"bias": found.bias, "uncertainty": found.relative}
            return [Advice("warning", "bias by uncertain inputs", fact, "", numbers, (f"uncertainty_median_{name}",))]
    return []
