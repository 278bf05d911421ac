"""Parameters of profiles, those of ISO 21920-2 and those of ISO 4287 and 13565-2 apart.

The formulas are the same for the primary (P), the roughness (R) and the waviness profile (W).
Averages run over the valid points of the evaluation length; no new mean or line is removed after
the filter. The standards themselves were not at hand: definitions follow public summaries and the
older standards.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.late import Shown
from ..core.quantity import Quantity
from ..core.units import show
from .characterise.correlation import DROP_ISO, autocovariance
from .characterise.heights import MaterialRatioCurve, core, core_is_unique
from .characterise.spectrum import profile_spectrum
from .prepare.filter import filtered
from .prepare.level import filled
from .profile import Profile
from .profile_settings import ProfileComponents

# Elements of a profile: a hill and the dale beside it.


LEAST_HEIGHT, LEAST_WIDTH = 0.1, 0.01
"""Shares of Rz, and of the length of a section, that a portion of a profile must exceed to be
significant."""

_SEVEN = np.array([1.0, -9.0, 45.0, 0.0, -45.0, 9.0, -1.0]) / 60.0  # slope from seven points, as a convolution


@dataclass(frozen=True, eq=False)
class ProfileElements:
    """Crossings of the mean line between significant portions, in m from the first point.

    ``upward``, ``downward`` positions (n,) and ``heights`` (n - 1,) in m of the elements between
    upward crossings, from their lowest to their highest point.
    """

    upward: RealArray
    downward: RealArray
    heights: RealArray

    @property
    def count(self) -> int:
        """Number of elements between upward crossings."""
        return max(0, self.upward.size - 1)

    @property
    def mean_width(self) -> float:
        """RSm in m from upward crossings; NaN with fewer than two."""
        return _mean_step(self.upward)

    @property
    def mean_width_down(self) -> float:
        """RSm in m from downward crossings; NaN with fewer than two."""
        return _mean_step(self.downward)


def profile_elements(heights: RealArray, spacing: float, *, least_height: float, least_width: float) -> ProfileElements:
    """Elements of a complete profile of ``heights`` (n,) in m about its mean line.

    The profile is split where its sign changes, by linear interpolation, zero being positive. A
    portion is significant if its largest |z| exceeds ``least_height`` and its width ``least_width``
    (m); others join what precedes. An element reaches from one significant upward crossing to the
    next.
    """
    z = np.asarray(heights, dtype=float)
    positive = z >= 0.0
    changes = np.flatnonzero(positive[1:] != positive[:-1])
    crossings = (changes + z[changes] / (z[changes] - z[changes + 1])) * spacing
    first = np.concatenate([[0], changes + 1])
    starts = np.concatenate([[0.0], crossings])
    widths = np.diff(np.append(starts, (z.size - 1) * spacing))
    significant = (np.maximum.reduceat(np.abs(z), first) > least_height) & (widths > least_width)
    signs, starts = positive[first][significant], starts[significant]
    up = starts[1:][signs[1:] & ~signs[:-1]]
    down = starts[1:][~signs[1:] & signs[:-1]]
    bounds = np.ceil(up / spacing).astype(int)
    spans = [z[a:b] for a, b in itertools.pairwise(bounds)]
    return ProfileElements(up, down, np.array([float(span.max() - span.min()) for span in spans if span.size]))


def _mean_step(places: RealArray) -> float:
    return float(places[-1] - places[0]) / (places.size - 1) if places.size > 1 else math.nan


# ISO 21920-2.


@dataclass(frozen=True, eq=False, repr=False)
class ProfileParameters(Shown):
    """Parameters of one profile by ISO 21920-2; ``letter`` P, R or W, so that ``a`` of R is Ra.
    Lengths in m.

    ``a``, ``q``, ``sk``, ``ku`` over the evaluation length; ``p``, ``v``, ``z`` means of the
    ``sections``, ``zx`` the largest section; ``t``, ``pt``, ``vt`` over the evaluation length;
    ``dq`` rms slope by seven points and ``dq_forward`` by forward differences; ``dr`` developed
    length less 1; ``al`` lag at which the autocorrelation falls to 0.2; ``sw`` wavelength of the
    largest wave; ``sm``, ``sm_down`` mean width of the elements by upward and downward crossings,
    ``c`` their mean height, ``n`` their number; ``pc`` peaks per length (1/m); ``k``, ``pk``,
    ``vk``, ``mrk1``, ``mrk2`` of the material ratio curve. NaN where one is not defined.
    ``core_window_not_unique``: another disjoint window of the curve is as flat to 1 %, so that the
    core is not determined.
    """

    letter: str
    sections: int
    section_length: float
    a: float
    q: float
    sk: float
    ku: float
    p: float
    v: float
    z: float
    zx: float
    t: float
    pt: float
    vt: float
    dq: float
    dq_forward: float
    dr: float
    al: float
    sw: float
    sm: float
    sm_down: float
    c: float
    n: int
    k: float
    pk: float
    vk: float
    mrk1: float
    mrk2: float
    core_window_not_unique: bool
    curve: MaterialRatioCurve = field(repr=False)
    citation_keys: ClassVar[tuple[str, ...]] = ("ISO21920-2",)

    @property
    def pc(self) -> float:
        """Peaks per length in 1/m, 1/RSm; the standard gives them for 10 mm."""
        return 1.0 / self.sm if self.sm > 0.0 else math.nan

    def mr(self, height: float) -> float:
        """Share of the points at or above ``height`` in m above the mean line, 0 to 1 (Rmr)."""
        return float(self.curve.ratio(height))

    def mc(self, ratio: float) -> float:
        """Height in m above the mean line at the material ``ratio`` 0 to 1 (Rmc)."""
        return float(self.curve.height(ratio))

    def dc(self, upper: float, lower: float) -> float:
        """Difference in m of the heights at two material ratios (Rdc)."""
        return self.curve.height_difference(upper, lower)

    def values(self) -> Iterator[tuple[Quantity, float]]:
        """Every parameter with its definition, in the order of a report."""
        for name, tail, label, unit, description in _ISO_21920:
            symbol = f"{self.letter}{tail}"
            quantity = Quantity(symbol, unit, label, symbol=symbol, description=description, source="ISO 21920-2")
            yield quantity, float(getattr(self, name))

    def in_words(self) -> tuple[str, list[tuple[str, str]]]:
        """Heading and the parameters."""
        shown = [(q.symbol, show(value, q.unit)) for q, value in self.values() if not math.isnan(value)]
        return f"Parameters of the {NAMES[self.letter]} (ISO 21920-2)", shown


NAMES = {"P": "primary profile", "R": "roughness profile", "W": "waviness profile"}
"""What the letter of a parameter stands for."""

_ISO_21920 = (
    ("q", "q", "rms height", "m", "sqrt(<z²>) over the evaluation length, from the mean line"),
    ("a", "a", "mean absolute height", "m", "<|z|> over the evaluation length"),
    ("z", "z", "mean height of the sections", "m", "mean over the sections of highest less lowest point"),
    ("p", "p", "mean peak height", "m", "mean over the sections of the highest point"),
    ("v", "v", "mean valley depth", "m", "mean over the sections of the deepest point"),
    ("zx", "zx", "largest height of a section", "m", "largest section, highest less lowest point"),
    ("t", "t", "total height", "m", "highest less lowest point of the evaluation length"),
    ("pt", "pt", "highest point", "m", "of the evaluation length"),
    ("vt", "vt", "deepest point", "m", "of the evaluation length"),
    ("sk", "sk", "skewness", "1", "<z³>/q³ over the evaluation length, 0 for Gaussian heights"),
    ("ku", "ku", "kurtosis", "1", "<z⁴>/q⁴ over the evaluation length, 3 for Gaussian heights"),
    ("dq", "dq", "rms slope", "1", "seven-point formula, transfer 1 - θ⁶/140 with θ = q Δ"),
    ("dq_forward", "dq (forward)", "rms slope by forward differences", "1", "transfer sin(θ/2)/(θ/2)"),
    ("dr", "dr", "developed length less 1", "1", "length of the polygon over that of the line, less 1"),
    ("al", "al", "autocorrelation length", "m", "lag at which the autocorrelation falls to 0.2"),
    ("sw", "sw", "dominant wavelength", "m", "wavelength of the largest wave of the spectrum"),
    (
        "sm",
        "Sm",
        "mean width of the elements",
        "m",
        ("upward crossings between portions above 10 % of z and 1 % of a section"),
    ),
    ("sm_down", "Sm (down)", "mean width by downward crossings", "m", "the same by downward crossings"),
    ("n", "n", "number of elements", "1", "between upward crossings"),
    ("c", "c", "mean height of the elements", "m", "highest less lowest point of each element"),
    ("pc", "pc", "peaks per length", "m**-1", "1/Sm"),
    ("k", "k", "core height", "m", "line through the 40 % of the material ratio curve with the least slope"),
    ("pk", "pk", "reduced peak height", "m", "height of the triangle of the area above the core"),
    ("vk", "vk", "reduced valley depth", "m", "height of the triangle of the area below the core"),
    ("mrk1", "mrk1", "material ratio of the peaks", "1", "ratio at which the curve leaves the core upwards"),
    ("mrk2", "mrk2", "material ratio of the core and peaks", "1", "ratio at which the curve leaves the core downwards"),
)


def profile_parameters(profile: Profile, letter: str = "R", *, sections: int = 5) -> ProfileParameters:
    """Parameters of a ``profile`` as it stands: filtered, and of the evaluation length (see
    ``components``).

    ``letter`` P, R or W names them. The sections are ``sections`` equal parts; of P and W usually
    one. Missing points are left out, and bridged linearly for elements, autocorrelation and
    spectrum. Raises InputError if the letter is unknown or there are more sections than points.
    """
    require.one_of(letter, NAMES, "letter of a profile")
    count = require.integer(sections, 1, "number of sections")
    if count > profile.n_points:
        raise InputError(f"number of sections must be at most that of the points, {profile.n_points}, but is {count}.")
    z = profile.valid
    high, low = _extremes(profile, count)
    q = float(np.sqrt(np.mean(np.square(z))))
    curve = MaterialRatioCurve(np.sort(z)[::-1])
    whole = filled(profile)
    length = profile.length / count
    height = float(np.mean(high - low))
    found = profile_elements(
        whole.heights.astype(float),
        profile.spacing,
        least_height=LEAST_HEIGHT * height,
        least_width=LEAST_WIDTH * length,
    )
    forward = np.diff(profile.heights.astype(float)) / profile.spacing
    return ProfileParameters(
        letter=letter,
        sections=count,
        section_length=length,
        a=float(np.mean(np.abs(z))),
        q=q,
        sk=float(np.mean(z**3)) / q**3 if q**3 > 0.0 else math.nan,
        ku=float(np.mean(z**4)) / q**4 if q**4 > 0.0 else math.nan,
        p=float(np.mean(high)),
        v=float(np.mean(-low)),
        z=height,
        zx=float(np.max(high - low)),
        t=float(z.max() - z.min()),
        pt=float(z.max()),
        vt=float(-z.min()),
        dq=_rms(seven_point_slope(profile)),
        dq_forward=_rms(forward),
        dr=_mean(np.square(forward) / (1.0 + np.sqrt(1.0 + np.square(forward)))),  # sqrt(1 + s²) - 1, all its digits
        al=autocovariance(whole).correlation_length(DROP_ISO) if profile.n_points > 1 else math.nan,
        sw=_largest_wave(whole),
        sm=found.mean_width,
        sm_down=found.mean_width_down,
        c=_mean(found.heights),
        n=found.count,
        **_core(curve),
        curve=curve,
    )


def seven_point_slope(profile: Profile) -> RealArray:
    """Slopes (n - 6,) of the inner points, all (n,) of a closed profile; NaN beside missing points.

    z'_i = (z_(i+3) - 9 z_(i+2) + 45 z_(i+1) - 45 z_(i-1) + 9 z_(i-2) - z_(i-3))/(60 Δ); empty with
    fewer than seven points.
    """
    h = profile.heights.astype(float)
    if h.size < _SEVEN.size:
        return np.empty(0)
    if profile.periodic:
        h = np.concatenate([h[-3:], h, h[:3]])
    return np.convolve(h, _SEVEN, mode="valid") / profile.spacing


def _extremes(profile: Profile, sections: int) -> tuple[RealArray, RealArray]:
    """Highest and lowest point of each of the ``sections`` that has any, in m."""
    parts = [part[~np.isnan(part)] for part in np.array_split(profile.heights.astype(float), sections)]
    known = [part for part in parts if part.size]
    return np.array([part.max() for part in known]), np.array([part.min() for part in known])


def _largest_wave(whole: Profile) -> float:
    if whole.n_points < 2:
        return math.nan
    spectrum = profile_spectrum(whole)
    at = int(np.argmax(spectrum.psd))
    return float(2.0 * np.pi / spectrum.q[at]) if spectrum.psd[at] > 0.0 else math.nan


def _core(curve: MaterialRatioCurve) -> dict[str, Any]:
    try:
        found = core(curve)
    except InputError:  # flat, or too few points
        return dict.fromkeys(("k", "pk", "vk", "mrk1", "mrk2"), math.nan) | {"core_window_not_unique": False}
    return {
        "k": found.top - found.bottom,
        "pk": found.reduced_peak,
        "vk": found.reduced_valley,
        "mrk1": found.ratio_1,
        "mrk2": found.ratio_2,
        "core_window_not_unique": not core_is_unique(curve),
    }


def _mean(values: RealArray) -> float:
    known = values[~np.isnan(values)]
    return float(known.mean()) if known.size else math.nan


def _rms(values: RealArray) -> float:
    return math.sqrt(_mean(np.square(values)))


# ISO 4287 and 4288, with the core of ISO 13565-2.


@dataclass(frozen=True, eq=False, repr=False)
class SectionParameters(Shown):
    """Parameters of the roughness profile by ISO 4287: each over one sampling length, then the mean
    of all. Lengths in m.

    ``Ra``, ``Rq``, ``Rsk``, ``Rku``, ``Rp``, ``Rv``, ``Rz``, ``Rc``, ``RSm``, ``Rdq`` as means of
    the ``sections``; ``Rmax`` the largest section and ``Rt`` of the evaluation length; ``RPc``
    1/RSm and ``Pc`` (ASME B46.1) upward crossings of a band ± ``band`` per length, each counted
    after a fall below the band (1/m). ``Rk``, ``Rpk``, ``Rvk``, ``Mr1``, ``Mr2`` are those of ISO
    13565-2 on the profile about the mean line of ISO 13565-1, which suppresses valleys. NaN where
    one is not defined; elements cut by the ends of a sampling length are left out of RSm and Rc.
    """

    sections: int
    Ra: float
    Rq: float
    Rsk: float
    Rku: float
    Rp: float
    Rv: float
    Rz: float
    Rmax: float
    Rt: float
    Rdq: float
    RSm: float
    Rc: float
    RPc: float
    Pc: float
    band: float
    Rk: float
    Rpk: float
    Rvk: float
    Mr1: float
    Mr2: float
    citation_keys: ClassVar[tuple[str, ...]] = ("ISO4287", "ISO4288", "ISO13565-1", "ISO13565-2")

    def values(self) -> Iterator[tuple[Quantity, float]]:
        """Every parameter with its definition."""
        for name, label, unit, description, source in _ISO_4287:
            yield Quantity(name, unit, label, symbol=name, description=description, source=source), getattr(self, name)

    def in_words(self) -> tuple[str, list[tuple[str, str]]]:
        """Heading and the parameters."""
        shown = [(q.symbol, show(value, q.unit)) for q, value in self.values() if not math.isnan(value)]
        return "Parameters of the roughness profile (ISO 4287)", shown


_EACH = "of each sampling length, then the mean"
_ISO_4287 = (
    ("Ra", "mean absolute height", "m", f"<|z|> {_EACH}", "ISO 4287"),
    ("Rq", "rms height", "m", f"sqrt(<z²>) {_EACH}; never above that of ISO 21920-2", "ISO 4287"),
    ("Rsk", "skewness", "1", f"<z³>/Rq³ {_EACH}", "ISO 4287"),
    ("Rku", "kurtosis", "1", f"<z⁴>/Rq⁴ {_EACH}", "ISO 4287"),
    ("Rp", "peak height", "m", f"highest point {_EACH}", "ISO 4287"),
    ("Rv", "valley depth", "m", f"deepest point {_EACH}", "ISO 4287"),
    ("Rz", "height", "m", f"Rp + Rv {_EACH}; not the ten-point height of 1984", "ISO 4287"),
    ("Rmax", "largest height", "m", "largest sampling length, highest less lowest point", "ASME B46.1"),
    ("Rt", "total height", "m", "highest less lowest point of the evaluation length", "ISO 4287"),
    ("Rdq", "rms slope", "1", f"seven-point formula {_EACH}", "ISO 4287"),
    ("RSm", "mean width of the elements", "m", f"{_EACH}; elements cut by its ends are left out", "ISO 4287"),
    ("Rc", "mean height of the elements", "m", f"{_EACH}; elements cut by its ends are left out", "ISO 4287"),
    ("RPc", "peaks per length", "m**-1", "1/RSm; the standard gives them for 1 cm", "ISO 4287"),
    (
        "Pc",
        "peaks per length by a band",
        "m**-1",
        ("upward crossings of a band, each after a fall below it"),
        "ASME B46.1",
    ),
    ("Rk", "core height", "m", "with the filter of ISO 13565-1", "ISO 13565-2"),
    ("Rpk", "reduced peak height", "m", "with the filter of ISO 13565-1", "ISO 13565-2"),
    ("Rvk", "reduced valley depth", "m", "with the filter of ISO 13565-1", "ISO 13565-2"),
    ("Mr1", "material ratio of the peaks", "1", "with the filter of ISO 13565-1", "ISO 13565-2"),
    ("Mr2", "material ratio of the core and peaks", "1", "with the filter of ISO 13565-1", "ISO 13565-2"),
)


def section_parameters(
    roughness: Profile, *, sections: int = 5, stratified: Profile | None = None, band: float | None = None
) -> SectionParameters:
    """Parameters by ISO 4287 of a ``roughness`` profile over ``sections`` sampling lengths.

    ``stratified``: the profile of ISO 13565-1 (see :func:`valley_suppressed`), without which Rk and
    its kin are NaN. ``band`` in m of Pc, 10 % of Rz if omitted. Raises InputError if the number of
    sections or the band is out of range.
    """
    whole = profile_parameters(roughness, "R", sections=sections)
    parts = [profile_parameters(part, "R", sections=1) for part in _cut(roughness, sections)]
    ratios = {"k": math.nan, "pk": math.nan, "vk": math.nan, "mrk1": math.nan, "mrk2": math.nan}
    if stratified is not None:
        ratios |= _core(MaterialRatioCurve(np.sort(stratified.valid)[::-1]))
    half = 0.1 * whole.z if band is None else require.positive(band, "band of the peak count (m)")
    mean = {
        name: _mean(np.array([getattr(part, name) for part in parts]))
        for name in ("a", "q", "sk", "ku", "dq", "sm", "c")
    }
    return SectionParameters(
        sections=whole.sections,
        Ra=mean["a"],
        Rq=mean["q"],
        Rsk=mean["sk"],
        Rku=mean["ku"],
        Rp=whole.p,
        Rv=whole.v,
        Rz=whole.z,
        Rmax=whole.zx,
        Rt=whole.t,
        Rdq=mean["dq"],
        RSm=mean["sm"],
        Rc=mean["c"],
        RPc=1.0 / mean["sm"] if mean["sm"] > 0.0 else math.nan,
        Pc=band_crossings(roughness, half) / roughness.length,
        band=half,
        Rk=ratios["k"],
        Rpk=ratios["pk"],
        Rvk=ratios["vk"],
        Mr1=ratios["mrk1"],
        Mr2=ratios["mrk2"],
    )


def band_crossings(profile: Profile, band: float) -> int:
    """Upward crossings of ``band`` (m) above the mean line, each counted after a fall below
    -``band`` (ASME B46.1)."""
    z = profile.valid
    states = np.where(z > band, 1, np.where(z < -band, -1, 0))
    states = states[states != 0]
    return int(np.count_nonzero((states[1:] == 1) & (states[:-1] == -1)))


def _cut(profile: Profile, sections: int) -> list[Profile]:
    """The sections that have a valid point."""
    bounds = np.linspace(0, profile.n_points, sections + 1).round().astype(int)
    parts = [profile.heights[a:b] for a, b in itertools.pairwise(bounds)]
    return [Profile(part, profile.spacing) for part in parts if not np.isnan(part).all()]


def valley_suppressed(primary: Profile, found: ProfileComponents) -> Profile:
    """Roughness profile of ISO 13565-1 over the evaluation length of the components ``found``.

    ``primary`` is the whole trace, levelled and filtered by λs. Below the mean line of λc its
    valleys are cut, a second mean line follows from what is left, and the profile is the trace less
    that. For stratified surfaces the standard takes λc = 0.8 mm; newer standards filter robustly
    instead.
    """
    first = primary.heights - filtered(primary, long=found.long).heights
    cut = primary.with_heights(np.fmax(primary.heights, first), "valleys cut at the mean line")
    second = cut.heights - filtered(cut, long=found.long).heights
    start = (primary.n_points - found.roughness.n_points) // 2
    part = slice(start, start + found.roughness.n_points)
    step = "filtered: valley-suppressing mean line of ISO 13565-1"
    return found.roughness.with_heights((primary.heights - second)[part], step, ("ISO13565-1",))
