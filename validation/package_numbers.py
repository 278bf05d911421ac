"""Numbers of other packages and ours for the same heights, by name; lengths in m, ratios in %."""

from __future__ import annotations

import functools
import warnings
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import package_rules as rules

import asperity as asp
from asperity import roughness
from asperity.core.arrays import RealArray
from asperity.surfaces import Profile, Surface

TRACES = Path(__file__).parents[1] / "tests" / "reference" / "profiles"
SCANS = Path(__file__).parents[2] / "shared" / "data"

MICRON = 1e6
MODE, LAG, STENCIL = 5, 4, 3
"""Mode of the spectra, lag of the autocorrelation and step of the scale-dependent derivatives, in
pixels."""


@dataclass(frozen=True)
class Number:
    """One parameter: ``ours``, and ``rule``: what the rule of the other package gives on our
    heights where it differs from ours; None where the rules are one."""

    ours: float
    rule: float | None = None


Numbers = dict[str, Number]


# Inputs.


@functools.cache
def traces() -> dict[str, roughness.ProfileComponents]:
    """The four reference traces, filtered."""
    lines = (TRACES / "profile_index.csv").read_text(encoding="utf-8").splitlines()
    head = lines[0].split(",")
    rows = [dict(zip(head, line.split(","), strict=True)) for line in lines[1:] if line]
    found = {}
    with np.load(TRACES / "profiles.npz") as stored:
        for row in rows:
            raw = Profile(stored[row["profile"]] * float(row["height_unit_m"]), float(row["spacing_m"]))
            lengths = {"long": float(row["lambda_c_m"]), "short": float(row["lambda_s_m"])}
            found[row["profile"]] = roughness.components(raw, sections=int(row["sections"]), **lengths)
    return found


@functools.cache
def raw_trace(name: str) -> Profile:
    """A reference trace as it was measured."""
    with np.load(TRACES / "profiles.npz") as stored:
        counts = stored[name]
    lines = (TRACES / "profile_index.csv").read_text(encoding="utf-8").splitlines()
    head = lines[0].split(",")
    row = next(dict(zip(head, line.split(","), strict=True)) for line in lines[1:] if line.split(",")[0] == name)
    return Profile(counts * float(row["height_unit_m"]), float(row["spacing_m"]))


@functools.cache
def made_map() -> Surface:
    """A map of 120 x 90 points with pixels of unequal sides, anisotropic and skewed, without a
    plane."""
    rng = np.random.default_rng(20261130)
    qx, qy = np.fft.fftfreq(150)[:, None], np.fft.fftfreq(120)[None, :]
    weight = np.exp(-0.5 * ((8.0 * qx) ** 2 + (4.0 * qy) ** 2) * np.pi**2) + 0.002
    h = np.fft.ifft2(np.fft.fft2(rng.standard_normal((150, 120))) * weight).real[:120, :90]
    h = h / h.std()
    surface = Surface(2e-7 * (h + 0.15 * (h**2 - 1.0)), 0.5e-6, 0.4e-6)
    return asp.surfaces.levelled(surface)


POINTS = 128
"""Points a side of the part of each scan on which parameters are compared."""


def scan(path: Path) -> Surface:
    """The first ``POINTS`` x ``POINTS`` points of a measured map, without their plane, complete."""
    whole = asp.read(path)
    assert isinstance(whole, Surface)
    part = asp.surfaces.levelled(Surface(whole.heights[:POINTS, :POINTS], whole.dx, whole.dy))
    return asp.surfaces.filled(part) if part.n_missing else part


# Surfalize, profiles.


def profile_numbers(profile: Profile, letter: str, sections: int) -> Numbers:
    """Ours of a filtered ``profile`` and what surfalize's rules give."""
    found, z = roughness.profile_parameters(profile, letter, sections=sections), profile.heights.astype(float)
    again, parts, curve = (
        rules.centred_again(z),
        rules.sections_about_a_new_mean(z, sections),
        rules.CurveOfClasses(z),
    )
    core, volumes = curve.core(), curve.volumes()
    numbers = {f"{letter}{name}": Number(getattr(found, name), again[name]) for name in ("a", "q", "sk", "ku")}
    numbers |= {f"{letter}{name}": Number(getattr(found, name), parts[name]) for name in ("p", "v")}
    numbers |= {
        f"{letter}z": Number(found.z),
        f"{letter}t": Number(found.t),
        f"{letter}dq": Number(found.dq, found.dq_forward),
    }
    numbers |= {f"{letter}{name}": Number(getattr(found, name), core[name]) for name in ("k", "pk", "vk")}
    numbers |= {f"{letter}mrk{k}": Number(100.0 * getattr(found, f"mrk{k}"), core[f"mr{k}"]) for k in (1, 2)}
    if letter == "R":
        level = 0.5 * found.q
        volume, void = found.curve.material_volume, found.curve.void_volume
        numbers |= {
            "Rmr(Rq/2)": Number(100.0 * found.mr(level), curve.ratio(level)),
            "Rmc(10 %)": Number(found.mc(0.1), curve.height(10.0)),
            "Rxp": Number(found.dc(0.025, 0.5), volumes["xp"]),
            "Rdc(10, 80)": Number(found.dc(0.1, 0.8), volumes["dc"]),
            "Rvmp": Number(volume(0.1), volumes["Vmp"]),
            "Rvmc": Number(volume(0.8) - volume(0.1), volumes["Vmc"]),
            "Rvvc": Number(void(0.1) - void(0.8), volumes["Vvc"]),
            "Rvvv": Number(void(0.8), volumes["Vvv"]),
        }
        older = roughness.section_parameters(profile, sections=sections)
        each = [rules.centred_again(part) for part in np.array_split(z, sections)]
        for name in ("a", "q", "sk", "ku"):
            by_rule = float(np.mean([one[name] for one in each]))
            numbers[f"R{name} (ISO 4287)"] = Number(getattr(older, f"R{name}"), by_rule)
    return numbers


def surfalize_profile(profile: Profile, letter: str, sections: int) -> dict[str, float]:
    """The same of surfalize."""
    from surfalize import Profile as Theirs

    z, step = profile.heights.astype(float) * MICRON, profile.spacing * MICRON
    one = Theirs(z, step)
    metre = 1.0 / MICRON
    found = {name: getattr(one, f"R{name}")() * metre for name in ("a", "q", "t", "k", "pk", "vk")}
    found |= {name: getattr(one, f"R{name}")() for name in ("sk", "ku", "dq", "mrk1", "mrk2")}
    found |= {name: getattr(one, f"R{name}")(n_sections=sections) * metre for name in ("p", "v", "z")}
    numbers = {f"{letter}{name}": float(value) for name, value in found.items()}
    if letter == "R":
        q = float(np.sqrt(np.mean(z**2)))
        parts = [Theirs(part, step) for part in np.array_split(z, sections)]
        numbers |= {
            "Rmr(Rq/2)": one.Rmr(0.5 * q),
            "Rmc(10 %)": one.Rmc(10.0) * metre,
            "Rxp": one.Rxp() * metre,
            "Rdc(10, 80)": one.Rdc(10, 80) * metre,
            **{f"Rv{name}": getattr(one, f"V{name}")() * metre for name in ("mp", "mc", "vc", "vv")},
        }
        for name, factor in (("a", metre), ("q", metre), ("sk", 1.0), ("ku", 1.0)):
            value = float(np.mean([getattr(part, f"R{name}")() for part in parts])) * factor
            numbers[f"R{name} (ISO 4287)"] = value
    return numbers


def filter_numbers(name: str) -> Numbers:
    """Rms of the difference of the two roughness profiles from one raw trace, over Rq, and the same
    with their rule."""
    separated = traces()[name]
    rough = separated.roughness.heights
    theirs = _by_cut_gaussian(raw_trace(name), separated)
    return {"R profile": Number(0.0, float(np.sqrt(np.mean((theirs - rough) ** 2) / np.mean(rough**2))))}


def _by_cut_gaussian(raw: Profile, separated: roughness.ProfileComponents) -> RealArray:
    z = asp.surfaces.levelled(raw).heights.astype(float)
    fine = rules.cut_gaussian(z, raw.spacing, separated.short)
    rough = fine - rules.cut_gaussian(fine, raw.spacing, separated.long)
    return rough[_evaluated(raw, separated)]


def _evaluated(raw: Profile, separated: roughness.ProfileComponents) -> slice:
    n = separated.roughness.n_points
    first = (raw.n_points - n) // 2
    return slice(first, first + n)


def surfalize_filter(name: str) -> dict[str, float]:
    """The same with surfalize's filter."""
    from surfalize import Profile as Theirs

    raw, separated = raw_trace(name), traces()[name]
    levelled = Theirs(raw.heights.astype(float) * MICRON, raw.spacing * MICRON).level()
    fine = levelled.filter("lowpass", separated.short * MICRON)
    theirs = fine.filter("highpass", separated.long * MICRON).data[_evaluated(raw, separated)] / MICRON
    rough = separated.roughness.heights
    return {"R profile": float(np.sqrt(np.mean((theirs - rough) ** 2) / np.mean(rough**2)))}


# Surfalize, maps.


def map_numbers(surface: Surface) -> Numbers:
    """Ours of a map and what surfalize's rules give."""
    heights = roughness.height_parameters(surface)
    curve = roughness.material_ratio_curve(surface)
    functional = roughness.functional_parameters(curve)
    theirs = rules.CurveOfClasses(np.asarray(curve.heights))
    core, volumes = theirs.core(), theirs.volumes()
    lengths, texture = (
        roughness.texture_lengths(roughness.autocovariance(surface)),
        rules.texture_by_pixels(surface),
    )
    return {
        **{name: Number(getattr(heights, name)) for name in ("Sa", "Sq", "Sp", "Sv", "Sz", "Ssk", "Sku")},
        "Sdq": Number(roughness.rms_slope(surface)),
        "Sdr": Number(100.0 * roughness.developed_area_ratio(surface)),
        "Sal": Number(lengths.Sal, texture["Sal"]),
        "Str": Number(lengths.Str, texture["Str"]),
        "Sk": Number(functional.Sk, core["k"]),
        "Spk": Number(functional.Spk, core["pk"]),
        "Svk": Number(functional.Svk, core["vk"]),
        "Smr1": Number(100.0 * functional.Smr1, core["mr1"]),
        "Smr2": Number(100.0 * functional.Smr2, core["mr2"]),
        **{name: Number(getattr(functional, name), volumes[name]) for name in ("Vmp", "Vmc", "Vvc", "Vvv")},
        "Sxp": Number(functional.Sxp, volumes["xp"]),
        "Sdc(10, 80)": Number(functional.Sdc, volumes["dc"]),
    }


def surfalize_map(surface: Surface) -> dict[str, float]:
    """The same of surfalize."""
    from surfalize import Surface as Theirs

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # pixels of unequal sides; Str that is not defined
        rows = np.ascontiguousarray(surface.heights[:, ::-1].T.astype(float)) * MICRON
        one = Theirs(rows, surface.dx * MICRON, surface.dy * MICRON)
        lengths = ("Sa", "Sq", "Sp", "Sv", "Sz", "Sal", "Sk", "Spk", "Svk", "Vmp", "Vmc", "Vvc", "Vvv", "Sxp")
        numbers = {name: float(getattr(one, name)()) / MICRON for name in lengths}
        plain = ("Ssk", "Sku", "Sdq", "Sdr", "Str", "Smr1", "Smr2")
        numbers |= {name: float(getattr(one, name)()) for name in plain}
        return numbers | {"Sdc(10, 80)": float(one.Sdc(10, 80)) / MICRON}


# SurfaceTopography, maps and lines.


def statistics_numbers(surface: Surface) -> Numbers:
    """Ours of what SurfaceTopography computes, and what its rules give where they differ."""
    h, spacing = surface.heights.astype(float), surface.grid.spacing
    closed = Surface(h, surface.dx, surface.dy, periodic=True)
    rows = [roughness.rms_height(surface.row(j)) for j in range(surface.shape[1])]
    scale = roughness.scale_dependence(surface, steps=(STENCIL,))
    line = surface.row(0)
    level = 0.5 * roughness.rms_height(line)
    points = roughness.material_ratio_curve(line)
    z = line.heights.astype(float) - float(line.heights.mean())
    laplacian = roughness.rms_laplacian(surface)
    return {
        "Sq": Number(roughness.rms_height(surface)),
        "Rq of the lines": Number(float(np.sqrt(np.mean(np.square(rows))))),
        "Rdq of the lines": Number(roughness.rms_profile_slope(surface), rules.derivative_of_lines(h, surface.dx, 1)),
        "Rddq of the lines": Number(
            roughness.rms_profile_curvature(surface), rules.derivative_of_lines(h, surface.dx, 2)
        ),
        "rms gradient": Number(roughness.rms_slope(surface), rules.gradient_on_common_nodes(h, spacing)),
        "rms Laplacian": Number(laplacian),
        "rms curvature": Number(0.5 * laplacian),
        "C1D, no window": Number(float(roughness.profile_spectrum(closed, window="none").psd[MODE - 1])),
        "C1D, Hann window": Number(float(roughness.profile_spectrum(surface, window="hann").psd[MODE - 1])),
        "C2D, no window": Number(float(roughness.power_spectrum(closed, "none").psd[MODE, 2])),
        "height difference A(r)": Number(0.5 * float(roughness.structure_function(surface, lags=[LAG]).value[0])),
        "slope at a distance": Number(float(scale.slope[0]), rules.derivative_of_lines(h, surface.dx, 1, STENCIL)),
        "curvature at a distance": Number(
            float(scale.curvature[0]), rules.derivative_of_lines(h, surface.dx, 2, STENCIL)
        ),
        "bearing length": Number(100.0 * float(points.ratio(level)), 100.0 * rules.share_of_line_above(z, level)),
    }


def surface_topography(surface: Surface) -> dict[str, float]:
    """The same of SurfaceTopography."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # on a parallel library that is not there
        from SurfaceTopography import Topography, UniformLineScan

        h = surface.heights.astype(float)
        open_, closed = (Topography(h, surface.size, unit="m", periodic=periodic) for periodic in (False, True))
        line = surface.row(0)
        z = line.heights.astype(float) - float(line.heights.mean())
        trace = UniformLineScan(z, line.length, unit="m")
        whole = {"resampling_method": None, "reliable": False}
        spectrum = closed.power_spectrum_from_profile(**whole)[1]
        windowed = open_.power_spectrum_from_profile(window="hann", **whole)[1]
        area = closed.power_spectrum_from_area(reliable=False, return_map=True)[2]

        slope, curvature = (
            float(np.sqrt(np.mean(np.asarray(open_.derivative(n, scale_factor=STENCIL)[0]) ** 2))) for n in (1, 2)
        )
        return {
            "Sq": float(open_.Sq()),
            "Rq of the lines": float(open_.Rq()),
            "Rdq of the lines": float(open_.Rdq()),
            "Rddq of the lines": float(open_.Rddq()),
            "rms gradient": float(open_.rms_gradient()),
            "rms Laplacian": float(open_.rms_laplacian()),
            "rms curvature": float(open_.rms_laplacian()) / 2.0,
            "C1D, no window": float(spectrum[MODE]),
            "C1D, Hann window": float(windowed[MODE]),
            "C2D, no window": float(area[MODE, 2]),
            "height difference A(r)": float(open_.autocorrelation_from_profile(**whole)[1][LAG]),
            "slope at a distance": slope,
            "curvature at a distance": curvature,
            "bearing length": 100.0 * float(trace.bearing_area(0.5 * roughness.rms_height(line))),
        }
