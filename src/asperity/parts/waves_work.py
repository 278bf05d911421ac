"""Which waves decide a contact: computation, figure and words."""

from __future__ import annotations

import math
from dataclasses import asdict, replace
from typing import Any, ClassVar

import numpy as np

from ..contact.boundary import Periodic
from ..contact.problem import ContactProblem
from ..contact.scan_ensemble import short_waves, spectrum_table
from ..core.errors import InputError
from ..core.status import Advice
from ..core.units import percent, show
from ..plots.picture import Figure, figures_by
from ..plots.scans import WAVES_PLOTS
from ..solids.layers import Layered
from ..surfaces.characterise.spectrum import power_spectrum, radial_spectrum
from ..surfaces.surface import Surface
from ..theories.rough.deciding_waves import POINTS_PER_WAVE, DecidingWaves, Need, deciding_waves
from ..theories.rough.persson import IsotropicSpectrum
from ..theories.rough.wave_questions import QUESTIONS
from .part import Found, Solved, Table, WithFacts, Words
from .waves import INTERVALS, LEAK, LONGEST, SHARES, SHORTEST, SIZES, WavesAsked


class WavesWork(WithFacts):
    """Which waves decide the contact: what is done for it."""

    citation_keys: ClassVar[tuple[str, ...]] = DecidingWaves.citation_keys

    def check(self, ask: WavesAsked, problem: ContactProblem) -> None:
        """Refuse what Persson's theory does not describe: windows, line contacts and layers."""
        if not isinstance(problem.boundary, Periodic) or min(problem.grid.shape) == 1:
            raise InputError(
                "boundary of a contact whose deciding waves are asked for must be periodic, on a map, but is "
                f"{problem.boundary!r} on {problem.grid.shape[0]} x {problem.grid.shape[1]} points. Give "
                "{boundary.kind=periodic}, or leave the deciding waves out."
            )
        if any(isinstance(body, Layered) and body.reduced.layers for body in (problem.body, problem.counter_body)):
            raise InputError(
                "bodies of a contact whose deciding waves are asked for must be half-spaces, but one is layered. Leave "
                "the deciding waves out, or give the body without its layers."
            )

    def compute(self, ask: WavesAsked, solved: Solved) -> Found:
        """Shares of the octaves and what scan each question needs."""
        problem, pressure = solved.problem, solved.result.mean_pressure
        if not pressure > 0.0:
            raise InputError(f"mean pressure must be positive for its deciding waves, but is {pressure:g} Pa.")
        keys: tuple[str, ...] = ()
        more: list[Advice] = []
        if ask.of_scans:
            (table,) = ask.of_scans
            scans = tuple(item.scan(ask.folder) for item in table.scans)
            found = table.makes(**{**table.given("kind"), "scans": scans})
            spectrum, keys = spectrum_table(found), found.citation_keys
            size, interval = max(scan.length for scan in scans), found.measured_to / POINTS_PER_WAVE
            many = f"{len(scans)} scan{'s' * (len(scans) != 1)}"
            source = f"spectrum of {many} down to {show(found.shortest_wavelength, 'm', 3)}"
            unseen = short_waves(found, problem.grid, problem.contact_modulus, pressure)
            more += unseen.findings(solved.result.area_fraction_corrected)
        else:
            heights = Surface(problem.profile(), *problem.grid.spacing, periodic=problem.surface.periodic)
            rings = radial_spectrum(power_spectrum(heights))
            known = rings.psd > 0.0
            spectrum = IsotropicSpectrum(rings.q[known], rings.psd[known])
            size, interval = min(problem.grid.size), max(problem.grid.spacing)
            source = "spectrum of the heights on the grid"
        hardness = float(np.mean(problem.law.pressure_cap()))
        waves = deciding_waves(
            spectrum, problem.contact_modulus, pressure, hardness=hardness, tolerance=float(ask.tolerance)
        )
        none = np.full(waves.longest.size, math.nan)
        values: dict[str, Any] = {LONGEST.name: waves.longest, SHORTEST.name: waves.shortest}
        values[LEAK.name] = waves.leak_wavelength
        for name in QUESTIONS:
            need = waves.needs.get(name)
            values[SHARES[name].name] = waves.shares.get(name, none)
            values[SIZES[name].name] = math.nan if need is None or not need.bounded else need.size
            values[INTERVALS[name].name] = math.nan if need is None else need.interval
        facts = {
            "source": source,
            "tolerance": waves.tolerance,
            "values": {name: float(value) for name, value in waves.values.items()},
            "needs": {name: asdict(need) for name, need in waves.needs.items()},
        }
        open_ = [item for item in waves.findings(size, interval) if item.level == "warning"]
        return Found(values, facts, (*more, *map(_concerned, open_)), (*self.citation_keys, *keys))

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Shares of the octaves."""
        return figures_by(WAVES_PLOTS, waves_of(found))

    def words(self, found: Found, solved: Solved) -> Words:
        """What scan suffices, and the shares of the octaves."""
        waves = waves_of(found)
        need = waves.needs["area"]
        longest = show(need.longest, "m", 3)
        sentence = (
            f"The real area is decided by waves of {longest} to {show(need.shortest, 'm', 3)}: a scan of "
            f"{show(need.size, 'm', 3)}, sampled at {show(need.interval, 'm', 3)}, suffices for it."
        )
        if not need.settled:
            end = show(float(waves.shortest[-1]), "m", 3)
            sentence = (
                f"The real area is decided by waves of {longest} and shorter ones down to the end of the spectrum at "
                f"{end}: it is a result of that cut-off."
            )
        elif not need.bounded:
            start = show(float(waves.longest[0]), "m", 3)
            sentence = (
                f"The real area is decided by waves of {show(need.shortest, 'm', 3)} and longer ones up to the "
                f"beginning of the spectrum at {start}, above which no roll-off is known: a result of the scan size."
            )
        rows = [
            ("spectrum", str(found.detail["source"])),
            ("change of an answer that counts as none", percent(waves.tolerance, 3)),
            ("waves of the throats of a leak", leak_text(waves)),
        ]
        return Words(sentence, rows=rows, tables=tuple(wave_tables(waves)), remarks=(REMARK,))


REMARK = (
    "By Persson's theory at the mean pressure, without attraction: shares of waves as they are added from the longest, "
    "of the area the change where an octave is left out."
)

_CONCERNS = {"real area": ("area_fraction", "contact_area"), "mean gap": ("mean_gap",)}
_CONCERNS["contact compliance"] = ("normal_stiffness",)


def _concerned(item: Advice) -> Advice:
    """``item`` with the quantities that it puts in doubt."""
    about = _CONCERNS.get(item.criterion.removeprefix("waves of the "), ())
    return replace(item, concerns=about)


def waves_of(found: Found) -> DecidingWaves:
    """What was ``found``, from its values and facts."""
    facts = found.detail
    needs = {name: Need(**need) for name, need in facts["needs"].items()}
    shares = {name: np.atleast_1d(found.values[SHARES[name].name]) for name in needs}
    longest, shortest = (np.atleast_1d(found.values[item.name]) for item in (LONGEST, SHORTEST))
    leak = float(found.values[LEAK.name])
    return DecidingWaves(longest, shortest, shares, facts["values"], needs, leak, float(facts["tolerance"]))


def leak_text(waves: DecidingWaves) -> str:
    """Which waves decide a leak, in words."""
    leak = waves.leak_wavelength
    return "none: the gap is open or sealed at every scale" if math.isnan(leak) else show(leak, "m", 3)


_SETTLED = {
    (True, True): "yes",
    (True, False): "no: the shortest wave decides",
    (False, True): "no: the longest wave decides",
    (False, False): "no: both ends decide",
}
"""Whether the waves of a spectrum settle an answer, by its long and its short end."""


_LEAST = 1e-3  # of a share that is shown


def _share_text(share: float) -> str:
    return percent(share, 2) if share >= _LEAST else f"< {percent(_LEAST)}"


def wave_tables(waves: DecidingWaves) -> list[tuple[str, Table]]:
    """What scan each question of a contact needs, and the share of every octave in its answer."""
    names = list(waves.shares)
    labels = tuple(name.replace("_", " ") for name in names)
    octaves = (
        (show(float(long), "m", 3), *(_share_text(float(waves.shares[name][number])) for name in names))
        for number, long in enumerate(waves.longest)
    )
    needs = (
        (
            label,
            show(need.size, "m", 3) if need.bounded else "no roll-off known",
            show(need.interval, "m", 3),
            _SETTLED[need.bounded, need.settled],
        )
        for label, need in zip(labels, (waves.needs[name] for name in names), strict=True)
    )
    return [
        ("Scans that suffice", Table(("question", "size", "interval", "settled"), tuple(needs))),
        ("Share of each octave", Table(("waves below", *labels), tuple(octaves))),
    ]
