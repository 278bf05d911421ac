"""From a trace to the primary, the roughness and the waviness profile: filters, lengths and the
classes of the standards."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from types import MappingProxyType

from ..core import require
from ..core.errors import InputError
from ..core.units import show
from .prepare.extent import cropped
from .prepare.filter import FINEST, filtered
from .prepare.level import levelled
from .profile import Profile

STANDARDS = ("ISO 21920-3", "ISO 4288")
"""Rules by which a class of settings is chosen: from the upper tolerance limit, or from the
measured value."""

SECTIONS = 5
"""Usual number of sections of the evaluation length."""

FILTERS = ("gaussian", "robust", "spline")
"""Filters that separate roughness and waviness."""


@dataclass(frozen=True)
class SettingsClass:
    """Lengths in m for a range of roughness: a class Sc of ISO 21920-3, a row of the tables of ISO
    3274 and 4288.

    ``long`` λc, which is the length of a section, and ``short`` λs; largest ``tip_radius`` and
    ``spacing``; ``evaluation_length``. ``Ra``, ``Rz`` by either standard and ``RSm`` (m) up to
    which the class is chosen.
    """

    name: str
    long: float
    short: float
    tip_radius: float
    spacing: float
    Ra: float
    Rz_21920: float
    Rz_4288: float
    RSm: float

    @property
    def evaluation_length(self) -> float:
        """Five sections in m."""
        return SECTIONS * self.long


SETTINGS_CLASSES = (
    SettingsClass("Sc1", 0.08e-3, 2.5e-6, 2e-6, 0.5e-6, 0.02e-6, 0.16e-6, 0.1e-6, 0.04e-3),
    SettingsClass("Sc2", 0.25e-3, 2.5e-6, 2e-6, 0.5e-6, 0.1e-6, 0.8e-6, 0.5e-6, 0.13e-3),
    SettingsClass("Sc3", 0.8e-3, 2.5e-6, 2e-6, 0.5e-6, 2e-6, 16e-6, 10e-6, 0.4e-3),
    SettingsClass("Sc4", 2.5e-3, 8e-6, 5e-6, 1.5e-6, 10e-6, 80e-6, 50e-6, 1.3e-3),
    SettingsClass("Sc5", 8e-3, 25e-6, 10e-6, 5e-6, math.inf, math.inf, 200e-6, 4e-3),
)
"""Classes in ascending order; from public summaries of the standards, whose texts were not at
hand."""

_BLUNT_TIP, _ROUGH = 5e-6, 3e-6  # of class Sc3, where Rz is above the second
_LIMIT = MappingProxyType(
    {"Ra": {"*": "Ra"}, "Rz": {"ISO 21920-3": "Rz_21920", "ISO 4288": "Rz_4288"}, "RSm": {"ISO 4288": "RSm"}}
)


def settings_class(
    *, Ra: float | None = None, Rz: float | None = None, RSm: float | None = None, standard: str = "ISO 21920-3"
) -> SettingsClass:
    """Class of settings for exactly one value in m.

    By ISO 21920-3 the value is the upper *tolerance limit* of Ra or Rz. By ISO 4288 it is the
    *measured* Ra or Rz of a profile without period; one with a period goes by its RSm. Raises
    InputError if the standard is unknown, not exactly one value is given, the standard does not
    choose by it, or no class is wide enough.
    """
    require.one_of(standard, STANDARDS, "standard of the settings")
    given = {name: value for name, value in (("Ra", Ra), ("Rz", Rz), ("RSm", RSm)) if value is not None}
    if len(given) != 1:
        raise InputError(
            "settings of a profile must be chosen by exactly one of Ra, Rz and RSm, but are by "
            f"{sorted(given) or 'none'}."
        )
    ((name, value),) = given.items()
    length = require.positive(value, f"{name} of the settings (m)")
    column = _LIMIT[name].get(standard) or _LIMIT[name].get("*")
    if column is None:
        raise InputError(f"settings by RSm must be those of ISO 4288, but are of {standard}. Give Ra or Rz.")
    for row in SETTINGS_CLASSES:
        if length <= getattr(row, column) * (1.0 + 1e-12):
            blunt = row.name == "Sc3" and name == "Rz" and length > _ROUGH
            return replace(row, tip_radius=_BLUNT_TIP) if blunt else row
    raise InputError(
        f"{name} of the settings must be at most {show(getattr(SETTINGS_CLASSES[-1], column), 'm')} for "
        f"{standard}, but is {show(length, 'm')}. State the cut-offs yourself."
    )


@dataclass(frozen=True, eq=False)
class ProfileComponents:
    """The profiles of one trace over its evaluation length.

    ``primary`` P, less its least-squares line; ``roughness`` R, about the mean line of the filter,
    with no new mean removed; ``waviness`` W, that mean line less its mean. ``short`` λs and
    ``long`` λc in m, ``short`` 0 if it was not applied; ``sections`` of the length λc;
    ``discarded`` at each end in m; ``kind`` of the filter; ``remarks``.
    """

    primary: Profile
    roughness: Profile
    waviness: Profile
    short: float
    long: float
    sections: int
    discarded: float
    kind: str
    remarks: tuple[str, ...] = ()

    @property
    def evaluation_length(self) -> float:
        """``sections`` times λc in m."""
        return self.roughness.length


def components(
    profile: Profile,
    *,
    long: float,
    short: float | None = None,
    sections: int = SECTIONS,
    form: str | int | None = None,
    kind: str = "gaussian",
) -> ProfileComponents:
    """Primary, roughness and waviness profile of a trace.

    Form removed, λs low-pass, λc high-pass, then λc/2 discarded at each end, where the filter has
    not all of its weights (not for closed profiles or the spline). Sections that the trace is too
    short for are left out; the cut-off is never shortened. Raises InputError if a length is out of
    range or out of order, or the trace is shorter than one section and its ends.

    Parameters
    ----------
    profile
        Trace; it should be longer by λc than ``sections`` times λc.
    long
        Cut-off λc in m, which is the length of a section.
    short
        Cut-off λs in m; None, or less than four points, for none.
    sections
        Number of sections, usually 5.
    form
        What is removed first, as in ``levelled``; by default the line, of a closed profile the
        mean.
    kind
        ``gaussian`` (ISO 16610-21), ``robust`` (ISO 16610-31) or ``spline`` (ISO 16610-22) for λc;
        λs is Gaussian.
    """
    require.one_of(kind, FILTERS, "filter of a profile")
    wanted = require.integer(sections, 1, "number of sections")
    length = require.positive(long, "cut-off λc of a profile (m)")
    remarks, applied = [], 0.0
    whole = levelled(profile, form)
    if short is not None:
        applied = require.positive(short, "cut-off λs of a profile (m)")
        if applied >= length:
            raise InputError(
                f"cut-off λs of a profile must be below λc, {show(length, 'm')}, but is {show(applied, 'm')}."
            )
        if applied < FINEST * profile.spacing * (1.0 - 1e-9):
            remarks.append(
                f"λs {show(applied, 'm')} was not applied: it is less than {FINEST:g} spacings of "
                f"{show(profile.spacing, 'm')}."
            )
            applied = 0.0
        else:
            whole = filtered(whole, short=applied)
    elif profile.short_cutoff > 0.0:
        applied = profile.short_cutoff
    rough = filtered(whole, long=length, kind=kind)
    ends = 0.0 if profile.periodic or kind == "spline" else 0.5 * length
    half, per_section = round(ends / profile.spacing), round(length / profile.spacing)
    fits = (profile.n_points - 2 * half) // per_section
    if fits < 1:
        least = per_section + 2 * half
        raise InputError(
            f"trace must be at least {show(least * profile.spacing, 'm')} long for one section of λc "
            f"{show(length, 'm')} and its ends, but is {show(profile.length, 'm')}. Take a shorter cut-off, or "
            "a longer trace."
        )
    count = min(wanted, fits)
    if count < wanted:
        remarks.append(f"The trace is long enough for {count} of {wanted} sections of λc {show(length, 'm')}.")
    first = half + (profile.n_points - 2 * half - count * per_section) // 2
    window = (first * profile.spacing, (first + count * per_section) * profile.spacing)
    waves = whole.with_heights(whole.heights - rough.heights, "waviness: trace less roughness")
    return ProfileComponents(
        primary=levelled(cropped(whole, x=window), "line"),
        roughness=cropped(rough, x=window),
        waviness=levelled(cropped(waves, x=window), "mean"),
        short=applied,
        long=length,
        sections=count,
        discarded=half * profile.spacing,
        kind=kind,
        remarks=tuple(remarks),
    )
