"""Sealing asked for by a document: leak rate, throats, certificate and estimates in numbers,
figures and words."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from ...contact.controls import Control, MeanPressure, Step
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.solve import solve
from ...core.errors import InputError
from ...core.units import percent, show
from ...io.words import value_text
from ...parts.part import Found, Reached, Rows, Solved, Table, WithFacts, Words, require_step
from ...plots.picture import Figure, figures_by
from ...theories.sealing.gaps import ATMOSPHERE
from .figures import CLOSED_PLOT, FLOW_PLOT, PATH_PLOT, PRESSURE_PLOT, LeakPicture
from .flow import Way
from .fluids import FLUIDS, Fluid, IdealGas, ViscousLiquid
from .law import FluidPressure
from .leak import Leakage, leakage
from .part import SCALARS, SealingSettings
from .threshold import closing_load, passes
from .throats import closed_path

HOURS = 3600.0


class SealingWork(WithFacts):
    """What leaks through the gap of the contact: what is done for it."""

    citation_keys: ClassVar[tuple[str, ...]] = ("Reynolds1886", "Dapp2012", "PerssonYang2008")

    def check(self, ask: SealingSettings, problem: ContactProblem) -> None:
        """Refuse a flow along an axis of one point, and a gradient of what does not repeat."""
        axis = "xy".index(ask.direction)
        if problem.grid.shape[axis] < 2:
            raise InputError(
                f"direction of the leak must be along an axis with points, but there is one along {ask.direction}; "
                f"take the other ({{sealing.direction={'xy'[1 - axis]}}})."
            )
        if ask.driven == "gradient" and not problem.boundary.wraps[axis]:
            raise InputError(
                f"sealing.driven must be sides or auto where the contact does not repeat along {ask.direction}, but "
                "is gradient ({sealing.driven=sides})."
            )
        if ask.closing and not any(problem.boundary.wraps):
            raise InputError(
                f"sealing.closing must be left out for the boundary {problem.boundary.name}, whose contact has no mean "
                "pressure, but is given; choose {boundary.kind=periodic}, or a load path."
            )

    def course(self, ask: SealingSettings, controls: tuple[Step | Control, ...]) -> tuple[Step | Control, ...]:
        """The same steps; refuses one that is not among them."""
        require_step(ask.step, controls, "sealing.step", "{sealing.step=last}")
        return controls

    @staticmethod
    def joined(ask: SealingSettings) -> dict[str, Any]:
        """The pressure of the fluid that joins the solve."""
        back = 0.0 if ask.back is None else float(ask.back)
        words: Any = {"way": ask.direction, "driven": ask.driven}
        return {"fluid_pressure": FluidPressure(fluid_of(ask), float(ask.inlet), float(ask.outlet), back=back, **words)}

    def compute(self, ask: SealingSettings, solved: Solved) -> Found:
        """Rate, throats and fields at the step that is asked for; rates of all steps of a path."""
        reached: Reached = solved.at(ask.step)
        with solved.stage("leakage"):
            leak = _leak(ask, reached.result)
            values: dict[str, Any] = {"sealing_pressure": math.nan, **_numbers(leak), **_fields(leak)}
            if solved.path is not None:
                values |= _path(ask, solved, leak, reached.number)
            if ask.closing:
                values["sealing_pressure"] = _closing(ask, solved, reached.result)
        places = leak.throats.places
        values |= {
            f"throat_{name}": np.array([getattr(item, name) for item in places])
            for name in ("x", "y", "share", "pixels", "gap", "carried")
            if places
        }
        if leak.sealed and (cells := closed_path(leak.flow)).size:
            dx, dy = leak.flow.grid.spacing
            values |= {"closed_path_x": (cells[:, 0] + 0.5) * dx, "closed_path_y": (cells[:, 1] + 0.5) * dy}
        allowed = ask.allowed_throughput if _is_gas(leak) else ask.allowed_rate
        facts = {
            "fluid": ask.fluid,
            "gas": _is_gas(leak),
            "viscosity": fluid_of(ask).viscosity,
            "inlet": float(ask.inlet),
            "outlet": float(ask.outlet),
            "direction": ask.direction,
            "repeats": leak.flow.repeats,
            "sealed": leak.sealed,
            "resolved": leak.resolved,
            "two_way": leak.pressed is not None,
            "where": reached.where,
            "allowed": None if allowed is None else float(allowed),
        }
        return Found(values, facts, leak.findings, leak.citation_keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Where it flows and where it is decided, its pressure, and the rates of a path."""
        shown = LeakPicture(solved.problem, found.values, found.detail)
        if min(solved.problem.grid.shape) == 1:
            return ()
        sealed = found.detail["sealed"]
        plots = (CLOSED_PLOT,) if sealed else (FLOW_PLOT, PRESSURE_PLOT)
        rates = np.atleast_1d(np.asarray(found.values.get("path_leak_rate", [])))
        return figures_by((*plots, *((PATH_PLOT,) if np.any(rates > 0.0) and rates.size > 1 else ())), shown)

    def words(self, found: Found, solved: Solved) -> Words:
        """What leaks, how far it is known, and which throats decide."""
        values, facts = found.values, found.detail
        text = rate_text(values, facts)
        bounds = [float(values[f"leak_{side}_factor"]) for side in ("lower", "upper")]
        between = f", {bounds[0]:.3g} to {bounds[1]:.3g} times that by how the gap goes on between the pixels"
        where = f" at {facts['where']}" if facts["where"] else ""
        between_them = " to ".join(show(facts[side], "Pa", 3) for side in ("inlet", "outlet"))
        driven = f"{facts['fluid']} from {between_them} along {facts['direction']}"
        if facts["sealed"]:
            sentence = f"The contact seals{where}, leak rate {text}: a closed path of contact lies across ({driven})."
        else:
            sentence = f"The contact leaks {text}{where} ({driven}){between}."
        if not facts["resolved"]:
            sentence = sentence[:-1] + "; this is not resolved."
        closing = float(values.get("sealing_pressure", math.nan))
        if math.isfinite(closing):
            sentence += f" The gap closes at a mean contact pressure of {show(closing, 'Pa', 3)}."
        rows: Rows = [
            ("fluid", f"{facts['fluid']}, viscosity {show(facts['viscosity'], 'Pa*s', 3)}"),
            ("driven by", "a mean gradient" if facts["repeats"] else "pressures at two sides"),
        ]
        for item in SCALARS[2:]:
            value = float(values.get(item.name, math.nan))
            if math.isfinite(value):
                rows.append((item.label, value_text(item, value)))
        throats = _throat_table(values)
        tables = (("Throats that lose half of the pressure", throats),) if throats.cells else ()
        holds, alarming = _allowed_text(values, facts, text)
        place = 2 if facts["gas"] and not facts["sealed"] else 0
        short = text.partition(" (")[place].rstrip(")")
        headline = [("leak rate", short), ("equivalent gap", show(float(values["equivalent_gap"]), "m", 3))]
        remark = REMARK.format(TWO_WAY if facts.get("two_way") else ONE_WAY)
        return Words(sentence, headline, rows, tables, (remark,), alarming, holds)


REMARK = (
    "The film is thin and flows slowly (Reynolds); the gap is that of the contact{}. "
    "Pixels are joined at their faces only, so that spots that meet at a corner seal."
)
"""What the model is."""

ONE_WAY = " and does not yield to the fluid"
TWO_WAY = " under the pressure of the fluid on both bodies, solved with it"


def _is_gas(leak: Leakage) -> bool:
    return isinstance(leak.fluid, IdealGas)


def fluid_of(ask: SealingSettings) -> Fluid:
    """The fluid that is asked for: a known one with what is given of it, or a liquid or gas."""
    known: Fluid | None = FLUIDS.get(ask.fluid)
    given = known.viscosity if ask.viscosity is None and known is not None else ask.viscosity
    viscosity = float(given)  # type: ignore[arg-type]
    if isinstance(known, ViscousLiquid) or ask.fluid == "liquid":
        return ViscousLiquid(viscosity)
    own = known.mean_free_path if isinstance(known, IdealGas) else 0.0
    return IdealGas(viscosity, float(own if ask.mean_free_path is None else ask.mean_free_path))


def _leak(ask: SealingSettings, result: ContactResult) -> Leakage:
    words: Any = {"way": ask.direction, "driven": ask.driven}
    return leakage(result, fluid_of(ask), float(ask.inlet), float(ask.outlet), **words)


def _volume(leak: Leakage) -> float:
    """Volume per time, of a gas at one atmosphere, m³/s."""
    return leak.rate / ATMOSPHERE if _is_gas(leak) else leak.rate


def _numbers(leak: Leakage) -> dict[str, float]:
    """``SCALARS`` but the pressure at which the gap closes."""
    flow, found, beside = leak.flow, leak.throats, leak.estimates
    open_ = not leak.sealed
    return {
        "leak_rate": _volume(leak),
        "leak_throughput": leak.rate if _is_gas(leak) else math.nan,
        "leak_lower_factor": leak.bracket.lower / leak.rate if open_ else math.nan,
        "leak_upper_factor": leak.bracket.upper / leak.rate if open_ else math.nan,
        "transmissivity": flow.transmissivity,
        "equivalent_gap": flow.equivalent_gap,
        "critical_gap": float(np.cbrt(beside.critical_junction)),
        "leak_throat_pixels": found.pixels,
        "leak_throats": float(found.count),
        "leak_refinement": float(found.refinement) if open_ else math.nan,
        "leak_knudsen": leak.leak.knudsen if _is_gas(leak) else math.nan,
        "leak_slip_factor": leak.leak.slip_factor if _is_gas(leak) else math.nan,
        "leak_section_error": flow.section_error,
        "fluid_force": leak.fluid_force,
        "transmissivity_lower": beside.lower,
        "transmissivity_upper": beside.upper,
        "transmissivity_medium": beside.effective_medium,
        "transmissivity_junction": beside.critical_junction,
    }


def _fields(leak: Leakage) -> dict[str, Any]:
    """``FIELDS``: flow in the middle of cells over the mean, from that through their faces."""
    flow = leak.flow
    values: dict[str, Any] = {"fluid_pressure": leak.fluid_pressure, "leak_gap": flow.gap}
    mean = flow.rate / flow.grid.size[1 - flow.axis]
    for axis, name in enumerate("xy"):
        after = flow.flux[axis].copy()
        before = np.roll(after, 1, axis)
        if axis == flow.axis and not flow.repeats:  # through the sides
            before += flow.inflow[0]
            after -= flow.inflow[1]
        width = flow.grid.spacing[1 - axis] * mean
        values[f"leak_flux_{name}"] = 0.5 * (after + before) / width if mean > 0.0 else 0.0 * after
    spent = flow.dissipated
    values["leak_dissipation"] = spent / spent.mean() if spent.any() else spent
    return values


def _path(ask: SealingSettings, solved: Solved, leak: Leakage, number: int) -> dict[str, Any]:
    """Rates at every step, and the mean pressure at which the gap closes on the way to the largest
    load: in the middle between the last step that leaks and the first that seals."""
    rates, cubes = [], []
    steps = solved.path.steps if solved.path is not None else ()
    for at, step in enumerate(steps, start=1):
        one = leak if at == number else _leak(ask, step)
        rates.append(_volume(one))
        cubes.append(one.flow.transmissivity)
    loads = np.array([step.mean_pressure for step in steps])
    closing, peak = math.nan, int(np.argmax(loads))
    sealed = np.flatnonzero(np.array(cubes[: peak + 1]) == 0.0)
    if sealed.size and sealed[0] > 0:
        closing = float(0.5 * (loads[sealed[0] - 1] + loads[sealed[0]]))
    return {
        "path_leak_load": loads,
        "path_leak_rate": np.array(rates),
        "path_transmissivity": np.array(cubes),
        "sealing_pressure": closing,
    }


FURTHEST, FINENESS = 12, 6
"""Doublings of the load at most until the gap has closed or opened, and halvings then: a closing
load is known to 0.5 % of itself."""


def _closing(ask: SealingSettings, solved: Solved, result: ContactResult) -> float:
    """Mean pressure in Pa at which the gap closes on first loading, the middle of the interval in
    which it is known to lie; NaN where it is beyond a thousandfold of the load."""
    way: Way = "y" if ask.direction == "y" else "x"
    load = result.mean_pressure
    opens = passes(result, way)
    factor = 2.0 if opens else 0.5
    for _ in range(FURTHEST):
        load *= factor
        if passes(solve(solved.problem, MeanPressure(load)), way) is not opens:
            between = min(load, load / factor), max(load, load / factor)
            found = closing_load(solved.problem, between, way=way, rounds=FINENESS)
            return math.sqrt(found.lower * found.upper)
    return math.nan


# In words and tables.


def rate_text(values: Mapping[str, Any], facts: Mapping[str, Any]) -> str:
    """Leak rate in the units of its trade: mm³/s of a liquid; Pa m³/s and mbar l/s of a gas."""
    if not facts["gas"]:
        rate = float(values["leak_rate"])
        return f"{rate * 1e9:.3g} mm³/s ({rate * 1e6 * HOURS:.3g} ml/h)" if rate else "0 mm³/s"
    rate = float(values["leak_throughput"])
    return f"{rate:.3g} Pa·m³/s ({10.0 * rate:.3g} mbar·l/s)" if rate else "0 Pa·m³/s"


def _allowed_text(values: Mapping[str, Any], facts: Mapping[str, Any], text: str) -> tuple[str, bool]:
    """Whether the leak is below what is allowed, also at its upper bound, and whether it is not."""
    allowed = facts["allowed"]
    if allowed is None:
        return "", False
    rate = float(values["leak_throughput" if facts["gas"] else "leak_rate"])
    limit = rate_text({"leak_throughput": allowed, "leak_rate": allowed}, facts)
    if rate == 0.0:
        return f"Tight: nothing leaks, and {limit} is allowed.", False
    if rate > allowed:
        return f"Not tight: {text} leaks, {rate / allowed:.3g} times what is allowed.", True
    if rate * float(values["leak_upper_factor"]) > allowed:
        return (
            f"Tight within the pixels only: {text} leaks, {percent(rate / allowed)} of what is allowed, but its upper "
            "bound is above that.",
            True,
        )
    return f"Tight: {text} leaks, {percent(rate / allowed)} of what is allowed.", False


def _throat_table(values: Mapping[str, Any]) -> Table:
    """Throats, those of the largest shares first."""
    names = ("share", "carried", "pixels", "gap", "x", "y")
    columns = [np.atleast_1d(np.asarray(values.get(f"throat_{name}", []))) for name in names]
    cells = []
    for number, (share, carried, pixels, *rest) in enumerate(zip(*columns, strict=True), start=1):
        lengths = (show(float(at), "m", 3) for at in rest)
        cells.append((str(number), percent(float(share)), percent(float(carried)), f"{pixels:.3g}", *lengths))
    return Table(("Throat", "Share of the pressure", "Of the flow", "Pixels across", "Gap", "x", "y"), tuple(cells))
