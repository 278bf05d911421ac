"""All that a line scan tells: its parameters by both standards, moments, peaks, spectra and
curves."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TypeVar

from ..core.citations import citation_keys
from ..core.errors import InputError
from ..core.late import Drawn
from ..core.quantity import Quantity
from ..core.units import show
from .characterise.correlation import (
    DROP_1E,
    Autocovariance,
    FractalParameters,
    ScaleDependence,
    StructureFunction,
    autocovariance,
    fractal_parameters,
    scale_dependence,
    structure_function,
)
from .characterise.spectrum import ProfileSpectrum, profile_spectrum
from .characterise.summits import ProfilePeaks, profile_peaks
from .prepare.filter import filtered
from .prepare.level import filled, levelled, usual_form
from .profile import Profile
from .profile_conversion import (
    ConvertedSpectrum,
    ProfileMoments,
    SummitsOfPeaks,
    isotropic_spectrum,
    profile_moments,
    summits_of_peaks,
)
from .profile_parameters import (
    ProfileParameters,
    SectionParameters,
    profile_parameters,
    section_parameters,
    valley_suppressed,
)
from .profile_settings import SECTIONS, SETTINGS_CLASSES, ProfileComponents, components

T = TypeVar("T")


@dataclass(frozen=True, eq=False, repr=False)
class ProfileCharacterisation(Drawn):
    """What was measured on a line scan; None where something is not defined, with the reason among
    the ``remarks``.

    ``profile`` the levelled trace; ``parts`` its primary, roughness and waviness profile;
    ``parameters`` of each by letter (ISO 21920-2) and ``sections`` those of the roughness profile
    by ISO 4287; without sections there is the whole trace as P alone. ``moments``, ``peaks``,
    ``summits``, ``fractal``; ``covariance``, ``structure``, ``scale``, ``spectrum`` of the trace;
    ``converted`` the spectrum of the isotropic surface.
    """

    profile: Profile
    parts: ProfileComponents | None
    parameters: dict[str, ProfileParameters]
    sections: SectionParameters | None
    moments: ProfileMoments | None
    peaks: ProfilePeaks | None
    summits: SummitsOfPeaks | None
    fractal: FractalParameters | None
    covariance: Autocovariance
    structure: StructureFunction | None
    scale: ScaleDependence | None
    spectrum: ProfileSpectrum | None
    converted: ConvertedSpectrum | None
    remarks: tuple[str, ...]

    @property
    def letter(self) -> str:
        """R, or P where the trace has no section of a cut-off."""
        return "R" if "R" in self.parameters else "P"

    @property
    def main(self) -> ProfileParameters:
        """The parameters that people look for: those of R, or of P."""
        return self.parameters[self.letter]

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers behind the numbers."""
        found = [self.profile, *self.parameters.values(), self.sections, self.peaks, self.summits, self.fractal]
        keys = [key for item in (*found, self.converted) if item is not None for key in citation_keys(item)]
        return tuple(dict.fromkeys([*keys, "ISO21920-3", "ISO4288"] if self.parts is not None else keys))

    def more(self) -> Iterator[tuple[Quantity, float]]:
        """Moments, peaks, correlation and the isotropic surface, each with its definition."""
        m, p, s, c, f = self.moments, self.peaks, self.summits, self.converted, self.fractal
        nan = math.nan
        rows = (
            ("m0", "m0", "mean square height", "m**2", "of the levelled trace", m.m0 if m else nan),
            ("m2", "m2", "mean square slope", "1", "forward differences over the spacing", m.m2 if m else nan),
            ("m4", "m4", "mean square second derivative", "m**-2", "second differences", m.m4 if m else nan),
            ("alpha", "α", "Nayak parameter", "1", "m0 m4/m2²", m.alpha if m else nan),
            ("beta_e", "β_e", "correlation length 1/e", "m", "first lag with R/R(0) = 1/e", self.correlation_length),
            ("peaks", "N_p", "peaks per length", "m**-1", "points above both neighbours", p.density if p else nan),
            ("peak_height", "z̄_p", "mean peak height", "m", "above the mean line", p.mean_height if p else nan),
            (
                "peak_curvature",
                "κ̄_p",
                "mean peak curvature",
                "m**-1",
                "second difference",
                p.mean_curvature if p else nan,
            ),
            ("dimension", "D", "fractal dimension", "1", "line through ln S over ln τ", f.dimension if f else nan),
            ("hurst", "H", "Hurst exponent", "1", "fit to the spectrum", c.hurst if c else nan),
            ("gradient", "", "rms gradient, if isotropic", "1", "sqrt(2) rms slope", m.rms_gradient if m else nan),
            (
                "laplacian",
                "",
                "rms Laplacian, if isotropic",
                "m**-1",
                "sqrt(8/3) curvature",
                m.rms_laplacian if m else nan,
            ),
            ("summits", "D", "density of summits, if isotropic", "m**-2", "1.2092 N_p²", s.density if s else nan),
            (
                "summit_height",
                "z̄_s",
                "mean summit height, if isotropic",
                "m",
                "1.8006 z̄_p",
                s.mean_height if s else nan,
            ),
            ("summit_radius", "R", "summit radius, if isotropic", "m", "1/(1.2004 κ̄_p)", s.radius if s else nan),
        )
        for name, symbol, label, unit, text, value in rows:
            yield Quantity(name, unit, label, symbol=symbol, description=text), value

    @property
    def correlation_length(self) -> float:
        """First lag in m at which the autocorrelation of the trace falls to 1/e; NaN if it does
        not."""
        return self.covariance.correlation_length(DROP_1E)

    def in_words(self) -> tuple[str, list[tuple[str, str]]]:
        """Heading and the numbers that are shown first."""
        main = self.main
        rows = [(q.symbol, show(value, q.unit, 3)) for q, value in main.values() if q.symbol[1:] in _FIRST]
        return f"Characterisation of {self.profile.n_points} points, {show(self.profile.length, 'm')}", rows


_FIRST = ("q", "a", "z", "dq", "Sm")


def characterise_profile(
    profile: Profile,
    *,
    long: float | None = None,
    short: float | None = None,
    sections: int = SECTIONS,
    kind: str = "gaussian",
    form: str | int | None = None,
) -> ProfileCharacterisation:
    """Measure all that a line scan tells.

    Without ``long`` the class of settings is the first whose range of Ra holds the measured one, as
    by ISO 4288 for profiles without period; a trace too short for it takes the longest class that
    it holds, and a remark says so. Raises InputError if a length is out of range.

    Parameters
    ----------
    profile
        Trace as read.
    long, short
        Cut-offs λc and λs in m; by default those of the class, λs only where the spacing resolves
        it.
    sections, kind, form
        As in ``components``: sections of λc, filter, and the form removed first.
    """
    attempt = _Attempts()
    flat = levelled(profile, form)
    found = _separated(flat, long, short, sections, kind, attempt)
    parameters = {"P": profile_parameters(flat, "P", sections=1)}
    by_sections = None
    if found is not None:
        attempt.remarks += found.remarks
        for letter, part, count in (
            ("R", found.roughness, found.sections),
            ("W", found.waviness, 1),
            ("P", found.primary, 1),
        ):
            parameters[letter] = profile_parameters(part, letter, sections=count)
        primary = filtered(flat, short=found.short) if found.short > flat.short_cutoff else flat
        stratified = attempt("filter of ISO 13565-1", lambda: valley_suppressed(primary, found))
        by_sections = section_parameters(found.roughness, sections=found.sections, stratified=stratified)
    if parameters.get("R", parameters["P"]).core_window_not_unique:
        attempt.remarks.append(
            "The core of the material ratio curve is not determined: another window is as flat to 1 %, as for sines."
        )
    whole = filled(flat)
    moments = attempt("moments", lambda: profile_moments(flat))
    peaks = attempt("peaks", lambda: profile_peaks(flat))
    return ProfileCharacterisation(
        profile=flat,
        parts=found,
        parameters={letter: parameters[letter] for letter in "RPW" if letter in parameters},
        sections=by_sections,
        moments=moments,
        peaks=peaks,
        summits=attempt("summits", lambda: summits_of_peaks(peaks, moments.m0)) if peaks and moments else None,
        fractal=attempt("fractal parameters", lambda: fractal_parameters(flat)),
        covariance=autocovariance(flat),
        structure=attempt("structure function", lambda: structure_function(flat)),
        scale=attempt("scale dependence", lambda: scale_dependence(flat)),
        spectrum=attempt("spectrum", lambda: profile_spectrum(whole)),
        converted=attempt("isotropic surface", lambda: isotropic_spectrum(flat)),
        remarks=tuple(dict.fromkeys(attempt.remarks)),
    )


class _Attempts:
    """Evaluates quantities; one that is undefined gives None and adds a sentence to ``remarks``."""

    def __init__(self) -> None:
        self.remarks: list[str] = []

    def __call__(self, what: str, measure: Callable[[], T]) -> T | None:
        try:
            return measure()
        except InputError as error:
            self.remarks.append(f"No {what}: {error}")
            return None


def _separated(
    flat: Profile, long: float | None, short: float | None, sections: int, kind: str, attempt: _Attempts
) -> ProfileComponents | None:
    """Components by the given cut-offs, or by the class that the measured Ra asks for; None if the
    trace is too short."""
    form = usual_form(flat)
    if long is not None:
        return components(flat, long=long, short=short, sections=sections, form=form, kind=kind)
    best: ProfileComponents | None = None
    for row in SETTINGS_CLASSES:
        if flat.spacing * 10.0 > row.long:  # the section has too few points
            continue
        try:
            found = components(flat, long=row.long, short=short or row.short, sections=sections, form=form, kind=kind)
        except InputError:
            break
        best = found
        Ra = profile_parameters(found.roughness, "R", sections=found.sections).a
        if row.Ra >= Ra:
            return found
    if best is None:
        attempt.remarks.append(
            f"The trace of {show(flat.length, 'm')} has no section of a standard cut-off: parameters are those of the "
            "primary profile. State λc for others."
        )
    else:
        attempt.remarks.append(
            f"Ra asks for a longer cut-off than {show(best.long, 'm')}, which the trace of "
            f"{show(flat.length, 'm')} does not hold."
        )
    return best
