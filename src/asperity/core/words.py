"""Words that people read: what can be done, as it is named in Python, on the command line or in the
form of the application; printable text, words alike.

Findings and errors say ``{periodise}``; a reader in Python is told ``periodised(surface)``, one of
the command line ``--periodise``, one of the form the page and the field.
``{friction.law=full stick}`` is the value of a key of documents, which is called by its key, its
option or its field.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Literal, NamedTuple, TypeAlias

Door: TypeAlias = Literal["python", "command", "form", "kept"]
"""Where a person stands; ``"kept"`` for text that is kept, to be said at a door later."""


class Action(NamedTuple):
    """One thing to do, as it is named at each door."""

    python: str
    command: str
    form: str


ACTIONS = MappingProxyType(
    {
        # what a file with heights does not state
        "give_size": Action("size=(20e-6, 20e-6) in m", '--size "20 um x 20 um"', "Surface: Size"),
        "give_height_unit": Action('height_unit="nm"', "--height-unit nm", "Surface: Height unit"),
        "give_z_scale": Action("z_scale=100e-9 in m", '--z-scale "100 nm"', "Surface: Z scale"),
        "give_lateral_unit": Action('lateral_unit="um"', "--lateral-unit um", "Surface: Lateral unit"),
        "size": Action("size", "--size", "Surface: Size"),
        "height_unit": Action("height_unit", "--height-unit", "Surface: Height unit"),
        "z_scale": Action("z_scale", "--z-scale", "Surface: Z scale"),
        "lateral_unit": Action("lateral_unit", "--lateral-unit", "Surface: Lateral unit"),
        "channel": Action("channel=...", "--channel", "Surface: Channel"),
        "missing": Action("missing=(...)", "--missing", "Surface: Missing"),
        "delimiter": Action("delimiter=...", "--delimiter", "Surface: Delimiter"),
        "decimal": Action("decimal=...", "--decimal", "Surface: Decimal"),
        "header_lines": Action("header_lines=...", "--header-lines", "Surface: Header lines"),
        "axes": Action("axes=...", "--axes", "Surface: Axes"),
        "encoding": Action("encoding=...", "--encoding", "Surface: Encoding"),
        # files and folders
        "overwrite": Action("overwrite it with overwrite=True", "overwrite it with --force", "remove it"),
        "folder": Action("another folder", "another folder (--out)", "another folder"),
        "solve": Action("solve(ContactProblem(surface, body), ...)", "asperity contact FILE", "the page Run"),
        "run": Action("run(document)", "asperity contact --from DOCUMENT", "the page Run"),
        # preparation
        "fill": Action("filled(surface)", "--fill harmonic", "Prepare: fill"),
        "periodise": Action("periodised(surface)", "--periodise", "Prepare: periodise"),
        "taper": Action("surfaces.tapered(surface, ...)", "--taper", "Prepare: taper"),
        "crop": Action("surfaces.cropped(surface, ...)", "--crop", "Prepare: crop"),
        "despike": Action("surfaces.despiked(surface)", "--despike 6", "Prepare: despike"),
        "resample": Action("surfaces.resampled(surface, ...)", "--resample", "Prepare: resample"),
        "smooth": Action("surfaces.filtered(surface, short=...)", "--short-cutoff", "Prepare: filter"),
        "slice": Action('surfaces.sliced(surface, y="middle")', "--line y=middle", "Prepare: slice"),
        "isotropic": Action(
            "generate.surface_of_profile(profile, grid, ...)",
            "asperity generate from-line-scan",
            "Surface: from_line_scan",
        ),
        # the problem
        "load": Action("MeanPressure(...) or Force(...)", "--pressure or --load", "Control: Mean pressure"),
        "force": Action("Force(...)", "--load", "Control: Force"),
        "mean_pressure": Action("MeanPressure(...)", "--pressure", "Control: Mean pressure"),
        "approach": Action("Approach(...)", "--approach", "Control: Approach"),
        "mean_gap": Action("MeanGap(...)", "--mean-gap", "Control: Mean gap"),
        "grips": Action("FixedGrips(...)", "--approach and --retract", "Adhesion: Retract"),
        "gentle_law": Action("ExponentialAdhesion(...)", "--adhesion-law exponential", "Adhesion: Law = exponential"),
        "shift_of_time": Action(
            "shift=viscoelasticity.WilliamsLandelFerry(reference, c1, c2)",
            "WLF=298K;8.86;101.6K or Arrhenius=298K;80000J/mol in the text of --body",
            "Relaxation: Shift",
        ),
        "relaxation": Action("Viscoelastic(...)", '"E=3MPa+10MPa@10ms,nu=0.5" for --body', "Bodies: Relaxation"),
        "iterations": Action("max_iterations=... of the solver", "--max-iterations", "Solver: Max iterations"),
        "free": Action("boundary=Free()", "--boundary free", "Boundary: free"),
        "periodic": Action("boundary=Periodic()", "--boundary periodic", "Boundary: periodic"),
        "soft_counter": Action(
            "ContactProblem(rough, Rigid(), counter_body=rubber)",
            '--body rigid --counter "E=3MPa+10MPa@10ms,nu=0.5"',
            "Bodies: Counter body",
        ),
        "hardness": Action("law=Hardness(...)", "--hardness body", "Law: hardness"),
        "effective_hardness": Action(
            "law=plasticity.LayeredHardness(body)", "--hardness effective", "Law: hardness = effective"
        ),
        "yield_stress": Action("Strength(yield_stress=...)", '"steel{Y=400MPa}" in --body', "Bodies: Yield stress"),
        "wear_coefficient": Action(
            "Strength(wear_coefficient=1e-15)", '"DLC{kw=1e-6mm^3/Nm}" in --body', "Bodies: Wear coefficient"
        ),
        "electrical_resistivity": Action(
            "conduction=solids.Conduction(electrical_resistivity=17e-9)",
            '{rho=17nohm*m} behind its name, as in --body "copper{rho=17nohm*m}"',
            "Bodies: Electrical resistivity",
        ),
        "thermal_conductivity": Action(
            "conduction=solids.Conduction(thermal_conductivity=50.0)",
            '{k=50W/m/K} behind its name, as in --body "steel{k=50W/m/K}"',
            "Bodies: Thermal conductivity",
        ),
        "volumetric_heat_capacity": Action(
            "conduction=solids.Conduction(50.0, volumetric_heat_capacity=3.7e6)",
            '"steel{C=3.7MJ/m^3/K}" in --body',
            "Bodies: Volumetric heat capacity",
        ),
        "solver": Action("solver=...", "--solver", "Solver: Method"),
        "tolerance": Action("tolerance=... of the solver", "--tolerance", "Solver: Tolerance"),
        "shift": Action("Shift(...)", "--shift", "Shear: Shift"),
        "time_tolerance": Action("time_steps=TimeSteps(tolerance=...)", "--time-tolerance", "Viscoelastic: Tolerance"),
        "time_steps": Action("time_steps=TimeSteps(number=...)", "--time-steps", "Viscoelastic: Steps"),
        "plastic_depth": Action("PlasticFlow(depth=...)", "--plastic-depth", "Plastic flow: Depth"),
        "range": Action("load=numpy.geomspace(1.0, 100.0)", "--load 1N..100N", "a range"),
        "stresses": Action("stress(result, depths)", "--depths", "Stress: Depths"),
    }
)
"""What findings and errors advise, by name."""

Options: TypeAlias = Callable[[], Mapping[str, str]]
"""Gives the options of the command line by the dotted keys of documents."""


@dataclass(frozen=True)
class _Speaking:
    """The door that speaks, and what gives its options."""

    door: Door
    given: Options

    @cached_property
    def options(self) -> Mapping[str, str]:
        """Options by the keys of documents, which take a while to collect."""
        return self.given()


_DOOR: ContextVar[_Speaking] = ContextVar("door", default=_Speaking("python", dict))  # noqa: B039  (nothing changes it)

_NAMED = re.compile(r"\{(\w+(?:\.\w+)*)(?:=([^{}]*))?\}")


@contextmanager
def speaking(door: Door, options: Options = dict) -> Iterator[None]:
    """Context in which findings and errors name what can be done at this ``door``; a command line
    has ``options`` by the keys of documents."""
    before = _DOOR.set(_Speaking(door, options))
    try:
        yield
    finally:
        _DOOR.reset(before)


def in_words(text: str, door: Door | None = None) -> str:
    """``text`` with every ``{action}`` in the words of ``door``, by default the one that is
    speaking; other braces stay."""
    here = _DOOR.get()
    return _NAMED.sub(lambda found: _said(found, door or here.door, here), text)


def _said(found: re.Match[str], door: Door, here: _Speaking) -> str:
    name, value = found.groups()
    if door == "kept":
        return found[0]
    if name in ACTIONS and value is None:
        words: str = getattr(ACTIONS[name], door)
        return words
    if "." not in name:
        return found[0]
    if door == "form":
        field = field_of(name)
        return field if value is None else f"{field} = {value}"
    if door == "command" and f"{name}={value}" in here.options:
        return here.options[f"{name}={value}"]
    option = here.options.get(name) if door == "command" else None
    if option is not None:
        return option if value is None else f'{option} "{value}"' if " " in value else f"{option} {value}"
    plain = value is None or value in ("true", "false") or re.fullmatch(r"-?[\d.]+(e-?\d+)?", value)
    return name if value is None else f"{name} = {value}" if plain else f'{name} = "{value}"'


def key_in_words(key: str) -> str:
    """What the dotted ``key`` of a document is called: a form shows fields, the other doors take
    documents as they are written."""
    return field_of(key) if _DOOR.get().door == "form" else key


def field_of(key: str) -> str:
    """What a form calls the field of a dotted ``key`` of documents: its tables and its label."""
    *tables, last = map(label_of, re.sub(r"\[(\d+)\]", r" \1", key.removesuffix(".kind")).split("."))
    return f"{', '.join(tables)}: {last}" if tables else last


def first_paragraph(item: object) -> str:
    """What the docstring of ``item`` says first, as one line; empty without one."""
    return " ".join((item.__doc__ or "").strip().partition("\n\n")[0].split())


def label_of(name: str) -> str:
    """What the key ``name`` of a table is called in a form."""
    text = name.replace("_", " ").replace("youngs ", "Young's ").replace("poisson ", "Poisson's ")
    return text[:1].upper() + text[1:]


# How text is shown and compared.

_HIDDEN = ("Cc", "Cf", "Cn", "Co", "Cs", "Zl", "Zp")
"""Categories of characters that move the cursor, hide or turn text, have no agreed shape, or cannot
be written."""


def alike(word: str) -> str:
    """``word`` in the form in which capitals, spaces, hyphens and underscores make no
    difference."""
    return re.sub(r"[\s_-]+", "_", word.strip().lower())


def printable(text: str, *, keep: str = "") -> str:
    """``text`` with control and format characters, but those to ``keep``, as escapes such as
    ``\\x1b``."""
    if text.isprintable():
        return text
    return "".join(
        repr(letter)[1:-1] if letter not in keep and unicodedata.category(letter) in _HIDDEN else letter
        for letter in text
    )
