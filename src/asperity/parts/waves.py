"""Which waves of the surfaces decide their contact, and which scan would suffice."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..core.quantity import Quantity
from ..core.settings import Settings, setting
from ..core.values import Fraction
from ..theories.rough.wave_questions import QUESTIONS
from .part import Part


class WavesSettings(Settings):
    """Which wavelengths decide area, plastic flow, mean gap, compliance and leakage at this load,
    and which scan would suffice, by Persson's theory.

    Of a surface generated from many scans the spectrum is that of the scans, beyond the waves of
    the grid; of any other it is that of the heights.
    """

    tolerance: Fraction = setting(
        0.05,
        option="--waves-tolerance",
        help="Relative change of an answer that counts as none, where the waves that decide it are sought",
    )


@dataclass(frozen=True)
class WavesAsked:
    """What is asked: the relative change that counts as none (``tolerance``), and the tables of the
    spectra ``of_scans`` of the surface, whose relative paths start at ``folder``; empty where the
    heights have the spectrum."""

    tolerance: float
    of_scans: tuple[Any, ...] = ()
    folder: Path = Path()


OCTAVE = "octave"

SHARES = {
    name: Quantity(f"waves_{name}_share", "1", f"share of the octave in the {called}", (OCTAVE,))
    for name, called in QUESTIONS.items()
}
SIZES = {
    name: Quantity(f"waves_{name}_size", "m", f"size of a scan for the {called}") for name, called in QUESTIONS.items()
}
INTERVALS = {
    name: Quantity(f"waves_{name}_interval", "m", f"sampling interval of a scan for the {called}")
    for name, called in QUESTIONS.items()
}
LONGEST = Quantity("waves_longest", "m", "longest wave of the octave", (OCTAVE,))
SHORTEST = Quantity("waves_shortest", "m", "shortest wave of the octave", (OCTAVE,))
LEAK = Quantity("waves_leak", "m", "waves of the throats of a leak; not defined if open or sealed at all scales")


class DecidingWavesPart(Part):
    """Which waves decide the contact."""

    name = "deciding_waves"
    title = "Deciding waves"
    purpose = "Which wavelengths of the roughness decide the result, and what scan would suffice."
    table = "deciding_waves"
    settings = WavesSettings
    quantities = (LONGEST, SHORTEST, LEAK, *SHARES.values(), *SIZES.values(), *INTERVALS.values())
    work = "parts.waves_work:WavesWork"
    answers = False

    def asked(self, document: Any, folder: Path) -> WavesAsked:
        """Settings, and the scans of the surface if it is generated from some, lies against a
        smooth one and is used as it is."""
        surface, tolerance = document.surface, float(document.deciding_waves.tolerance)
        table = getattr(surface, "spectrum", None)
        alone = document.counter_surface is None and not surface.prepare
        if alone and getattr(table, "kind", "") == "scans":
            return WavesAsked(tolerance, (table,), folder)
        return WavesAsked(tolerance)
