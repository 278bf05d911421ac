"""Options of the core of a problem document, and the document that they fill; messages name the
option that was given."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ..core import require, units
from ..core.errors import InputError, UnitError
from ..core.parameters import Parameter, parameters
from ..core.settings import COMMAND_LINE, validated
from ..core.values import Flag, Text, Values
from ..io.schemas.bodies import SYMBOLS, BodyTable, body_from_text
from ..io.schemas.problem import (
    EFFECTIVE,
    FROM_BODY,
    NONE,
    SURFACE,
    BoundaryTable,
    ControlTable,
    HardnessTable,
    PathTable,
    ProblemDocument,
    SolverTable,
)
from ..io.schemas.surfaces import STEPS, AnySurface, FileSurface, Place
from ..surfaces.prepare.level import levelled, usual_form
from ..surfaces.profile import Profile
from ..surfaces.read import read
from ..surfaces.surface import Heights, Surface
from .declared import FILE, Given, Option, declarations, options_of, part_options

READING, PREPARATION, BODIES = "Reading the file", "Preparation, in this order", "Bodies and interface"
COUNTER, LOAD, SOLVER, OUTPUT = "Counter surface", "Load: one of", "Solver", "Output"

BASIC = (
    *("--from", "--size", "--height-unit", "--level", "--periodise", "--body", "--counter", "--hardness", "--boundary"),
    *("--pressure", "--load", "--approach", "--mean-gap", "--path", "--threads"),
)
"""Options of `contact` that its page shows first, beside those of parts."""


def reading_options() -> tuple[Option, ...]:
    """Options of what a file with heights does not state itself."""
    return options_of(FileSurface, ("surface",), READING, leave=("kind", "path", *AnySurface.model_fields))


def own_option(
    name: str, path: tuple[str, ...], text: str, panel: str | None, metavar: str = "", values: Values | None = None
) -> Option:
    """Option of the command line alone, for what takes several keys in the document."""
    return Option(name, path, Parameter(path[-1], str, values or Text(), None, text), panel, metavar=metavar or None)


def _step_option(name: str, step: str, key: str, what: str) -> Option:
    """Option for the parameter ``key`` of a preparation step; without a value of its own there is
    no such step."""
    item = next(item for item in parameters(STEPS[step]) if item.name == key)
    usual = f", such as {item.default:g}" if isinstance(item.default, float) else ""
    words = "" if not item.words or isinstance(item.values, Flag) else f"; {', '.join(item.words)}"
    text = f"{what}: {item.help}{words}{usual}" if what else item.help
    default = None if not isinstance(item.default, bool) else item.default
    plain = replace(item, help=text, default=default, values=item.values if not item.words else Text())
    return Option(name, ("prepare", step, key), plain, PREPARATION, metavar="WORD" if item.words else None)


def preparation_options() -> tuple[Option, ...]:
    """Options of the steps between the file and the contact, in their order; they apply to a
    counter surface too."""
    make, step = own_option, _step_option
    return (
        make("--crop", ("prepare", "crop", "range"), 'part to keep: "0um:5um,0um:4um"', PREPARATION, "X0:X1,Y0:Y1"),
        make(
            "--mask",
            ("prepare", "mask", "regions"),
            'points to leave out: "rectangle 0um:2um,1um:3um; ellipse 5um,5um,2um,1um,30deg; polygon 0um,0um,4um,0um,'
            '2um,3um", corners, middle and semi-axes from the corner of the map',
            PREPARATION,
            "REGION;...",
        ),
        step("--mask-invert", "mask", "invert", ""),
        step("--despike", "despike", "threshold", "mask spikes"),
        step("--line-correct", "line_correct", "axis", "remove offsets between scan lines"),
        step("--remove-tip", "tip", "radius", "reconstruct the surface behind the scan of a tip"),
        step("--tip-opening", "tip", "opening", "of the tip to remove"),
        step("--estimate-tip", "tip", "pixels", "the same with an unknown tip"),
        step("--tip-noise", "tip", "noise", "of the tip to estimate"),
        step("--mask-uncertain", "tip", "mask_uncertain", ""),
        make(
            "--level",
            ("prepare", "level", "form"),
            "remove mean, plane, quadratic or a polynomial of the degree given; or none; by default the mean "
            "of a periodic surface, the plane of any other",
            PREPARATION,
            "WORD",
        ),
        step("--robust-level", "level", "robust", "level without outliers"),
        step("--fill", "fill", "method", "fill missing points (harmonic by default) or none"),
        step("--tip-radius", "tip_limit", "radius", "remove waves that a tip may have shaped"),
        step("--short-cutoff", "filter", "short", "filter, such as 0.8um"),
        step("--long-cutoff", "filter", "long", "filter, such as 80um"),
        step("--filter", "filter", "kind", "filter for the cut-offs, the sharp one after --periodise"),
        step("--resample", "resample", "points", "resample"),
        step("--taper", "taper", "width", "taper"),
        make(
            "--periodise",
            ("prepare", "periodise", "on"),
            "remove the jumps between opposite borders",
            PREPARATION,
            "",
            Flag(),
        ),
        make(
            "--line",
            ("prepare", "slice", "at"),
            "one line of the map, for --boundary line: y=middle; x=3um. Loads per metre",
            PREPARATION,
            "AXIS=PLACE",
        ),
    )


def body_options() -> tuple[Option, ...]:
    """Options of bodies, counter surface, boundary and law."""
    both = {item.name: item for item in declarations(ProblemDocument)}
    counter = ("counter_surface",)
    return (
        Option("--body", ("body",), replace(both["body"], default=None), BODIES, metavar="BODY"),
        Option(
            "--counter",
            ("counter_body",),
            replace(both["counter_body"], default=None),
            BODIES,
            others=("--counter-body",),
            metavar="BODY",
        ),
        *(replace(o, required=False) for o in options_of(HardnessTable, ("law",), BODIES, leave=("kind",))),
        *options_of(BoundaryTable, ("boundary",), BODIES),
        *(
            replace(option, metavar=FILE)
            for option in options_of(BodyTable, ("bodies",), BODIES, only=("materials_file",))
        ),
        own_option(
            "--counter-surface",
            (*counter, "path"),
            "file with the surface of the counter body; flat by default",
            COUNTER,
            FILE,
        ),
        *options_of(AnySurface, counter, COUNTER, only=("mirror",)),
        *options_of(Place, (*counter, "place"), COUNTER, leave=("pixel",)),
        own_option(
            "--common-grid",
            (*counter, "common"),
            "bring both surfaces on one grid; so do --counter-shift and --rotate",
            COUNTER,
            "",
            Flag(),
        ),
    )


def load_options() -> tuple[Option, ...]:
    """Options of the load, of which one is given."""
    return (
        *(
            replace(option, metavar="VALUE,…") if option.name == "--path" else option
            for option in options_of(ControlTable, ("control",), LOAD)
        ),
        *options_of(PathTable, ("path",), LOAD, only=("steps",)),
    )


def solver_options() -> tuple[Option, ...]:
    """Options of the method."""
    return options_of(SolverTable, ("solver",), SOLVER)


def document_options() -> tuple[Option, ...]:
    """Options of everything in the core of a document."""
    return (*load_options(), *body_options(), *reading_options(), *preparation_options(), *solver_options())


def heights_in(file: Path, given: Given) -> Surface | Profile:
    """Surface or line scan in ``file`` as the reading options that are ``given`` ask."""
    return read(file, **reading_table(file, given).reading())


def reading_table(file: Path, given: Given) -> FileSurface:
    """Table of the surface in ``file`` as the reading options that are ``given`` ask."""
    table = {"kind": "file", "path": str(file), **given.under("surface").table()}
    names = {option.path[-1]: option.name for option in reading_options()}
    return validated(FileSurface, table, COMMAND_LINE, names)


def levelled_as(surface: Heights, level: str) -> tuple[Heights, str]:
    """``surface`` after levelling and what was removed: left to itself (auto) the mean of a
    periodic one, else the plane."""
    found = level if level != "auto" else usual_form(surface)
    return levelled(surface, int(found) if found.isdecimal() and len(found) < 10 else found), found


def option_words() -> dict[str, str]:
    """Option of every key of documents that has one, by the dotted key; of flags also what stands
    for ``key=true`` and ``key=false``."""
    named, flags = {"control.path.steps": "--path-steps"}, dict[str, str]()
    for option in (*document_options(), *part_options()):
        key = ".".join(option.path)
        named.setdefault(key, option.name)
        if isinstance(option.parameter.values, Flag):
            off = f"--no-{option.name[2:]}" if option.parameter.default is True else f"no {option.name}"
            flags |= {f"{key}=true": option.name, f"{key}=false": off}
    return named | flags


CORE = ("surface", "counter_surface", "prepare")
"""Tables that say which surfaces there are; a document that is given has its own."""

WORDS_OF_HARDNESS = MappingProxyType({"body": FROM_BODY, FROM_BODY: FROM_BODY, SURFACE: SURFACE, EFFECTIVE: EFFECTIVE})
"""Words for a hardness on the command line, and in the document."""


def composed(file: Path, given: Given) -> dict[str, Any]:
    """Document without load and solver for the surface in ``file``."""
    if given.get("body") is None:
        raise InputError("--body must be given, such as --body DLC; the command `asperity materials` lists the names.")
    chosen = given.table()
    surface = {"kind": "file", **chosen.get("surface", {}), "prepare": steps(given)}
    table: dict[str, Any] = {"version": 2, "surface": {**surface, "path": str(file)}}
    counter = chosen.get("counter_surface", {})
    if "path" in counter:
        other = {**surface, "path": counter["path"], "mirror": counter.get("mirror", "x")}
        if "place" in counter or "common" in counter:
            place = other["place"] = dict(counter.get("place", {}))
            if "shift" in place:
                place["shift"] = [part.strip() for part in place["shift"].split(",")]
                if len(place["shift"]) != 2:
                    raise InputError(
                        f'--counter-shift must be two lengths, such as "1um,0um", but is {counter["place"]["shift"]!r}.'
                    )
        table["counter_surface"] = other
    elif counter:
        option = next(
            option.name
            for option in given.options
            if option.path in given.values and option.path[0] == "counter_surface"
        )
        raise InputError(f"{option} must be given together with --counter-surface only, but is given without.")
    return table


def overlaid(table: Mapping[str, Any], given: Given, base: Path = Path()) -> dict[str, Any]:
    """``table`` with the bodies, boundary, law, load and solver settings that are given; materials
    files start at ``base``.

    The unit of the first value other than zero of a load path decides what it prescribes.
    """
    chosen, result = given.table(), dict(table)
    file = given.get("bodies", "materials_file")
    for key, option in (("body", "--body"), ("counter_body", "--counter")):
        if key in chosen:
            try:
                body = body_from_text(chosen[key])
            except InputError as error:
                raise InputError(f"{option}{error}") from None
            # named materials are looked up in the file
            if file is not None and {"layers", "material"} & body.keys():
                body["materials_file"] = str(base / file)
            result[key] = _from(base, body)
    if "boundary" in chosen:
        result["boundary"] = chosen["boundary"]
    if "law" in chosen:
        hardness = chosen["law"]["hardness"]
        result["law"] = {"kind": "hardness", "hardness": WORDS_OF_HARDNESS.get(hardness.strip().casefold(), hardness)}
    before = table.get("solver", {})
    if "solver" in chosen and isinstance(before, dict):
        result["solver"] = {**before, **chosen["solver"]}
    loads, path_steps = given.under("control").table(), given.get("path", "steps")
    if len(loads) > 1 or (not loads and "control" not in table):
        options = {option.path[1]: option.name for option in load_options() if option.path[0] == "control"}
        raise InputError(
            f"load must be given by exactly one of {', '.join(options.values())}, "
            f"but is given by {' and '.join(options[key] for key in loads) or 'none'}."
        )
    if "path" in loads:
        points = [part.strip() for part in loads["path"].split(",")]
        first = next((point for point in points if point != NONE), "")
        for key, kind in PATH_KINDS:
            with suppress(UnitError):
                units.parse(first, kind, "")
                loads["path"] = {key: points}
                break
        else:
            raise InputError(
                '--path must be pressures, forces or lengths with units, separated by commas, such as "50MPa,0,80MPa", '
                f"but is {loads['path']!r}."
            )
    control = result["control"] = loads or table["control"]
    if path_steps is not None:
        if not isinstance(control, dict) or not isinstance(control.get("path"), dict):
            raise InputError(
                "--path-steps must be given together with a load path (--path) only, but is given without."
            )
        result["control"] = {**control, "path": {**control["path"], "steps": path_steps}}
    return result


PATH_KINDS = (("mean_pressure", "pressure"), ("force", "force"), ("force", "surface tension"), ("approach", "length"))
"""What the points of a load path may be, and the kind of their unit; forces per length are those of
line contacts."""


def _from(base: Path, table: Any) -> Any:
    """``table`` of a body whose files of moduli start at ``base``."""
    if isinstance(table, list):
        return [_from(base, item) for item in table]
    if not isinstance(table, dict):
        return table
    return {key: str(base / value) if key == "moduli_file" else _from(base, value) for key, value in table.items()}


def names_in(table: Mapping[str, Any], given: Given) -> dict[str, str]:
    """What the user calls the keys of the document ``table`` that was composed of what is
    ``given``."""
    names = {**given.names, "control.path.steps": "--path-steps", "counter_surface.path": "--counter-surface"}
    names |= {f"counter_surface.{option.path[-1]}": option.name for option in reading_options()}
    words = (*SYMBOLS.items(), ("material", "material"), ("thickness", "thickness"), ("relaxation", "relaxation"))
    for key, option in (("body", "--body"), ("counter_body", "--counter")):
        body = table.get(key)
        layers = body.get("layers", ()) if isinstance(body, dict) else ()
        parts = {key: option, f"{key}.base": f"the base of {option}"}
        parts |= {f"{key}.layers[{n}]": f"layer {n} of {option}" for n in range(1, len(layers) + 1)}
        for part, name in parts.items():
            names[part] = name
            names |= {f"{part}.{k}": f"{symbol} of {name}" for symbol, k in words}
    for key, points in table["control"].get("path", {}).items():
        names |= {} if key == "steps" else {f"control.path.{key}": "--path"}
        for number in range(1, len(points) + 1) if isinstance(points, list) else ():
            names[f"control.path.{key}[{number}]"] = f"turning point {number} of --path"
    return names | step_names(table["surface"]["prepare"])


def steps(given: Given) -> list[dict[str, Any]]:
    """Preparation steps in the order of the options; a sharp filter needs a periodic surface, so
    that it comes after that.

    Every surface is levelled and filled unless that is turned off. An empty part of the range of
    ``--crop`` keeps the full side.
    """
    chosen: dict[str, Any] = {"level": {}, "fill": {}, **given.under("prepare").table()}
    sieve = chosen.get("filter", {})
    if sieve and not {"short", "long"} & sieve.keys():
        raise InputError(
            f"--filter {sieve['kind']} must be given together with --short-cutoff or --long-cutoff, but is alone."
        )
    _require_tip(chosen.get("tip", {}))
    order = list(dict.fromkeys(option.path[1] for option in preparation_options()))
    if sieve.get("kind") == "sharp":
        order.remove("filter")
        order.insert(order.index("periodise") + 1, "filter")
    made: dict[str, dict[str, Any] | None] = dict(chosen)
    form = chosen["level"].get("form")
    robust = {"robust": True} if chosen["level"].get("robust") else {}
    if form is None:
        made["level"] = robust
    elif form.isdecimal() and len(form) < 10:
        made["level"] = {"degree": int(form), **robust}
    else:
        require.one_of(form, (*_words("level", "form"), "none", "a degree"), "--level")
        made["level"] = None if form == "none" else {"form": form, **robust}
    if "crop" in chosen:
        text = chosen["crop"]["range"]
        parts = [part.strip() for part in text.split(",")]
        ends = [[end.strip() for end in part.split(":")] for part in parts]
        halved = all(len(pair) == 2 for part, pair in zip(parts, ends, strict=True) if part)
        if len(parts) != 2 or not any(parts) or not halved:
            raise InputError(f'--crop must be two ranges of lengths, such as "0um:5um,0um:4um", but is {text!r}.')
        made["crop"] = {axis: pair for axis, part, pair in zip("xy", parts, ends, strict=True) if part}
    if "mask" in chosen:
        made["mask"] = _mask(chosen["mask"])
    if "periodise" in chosen:
        made["periodise"] = {}
    if "slice" in chosen:
        text = chosen["slice"]["at"]
        axis, equals, position = (part.strip() for part in text.partition("="))
        if axis not in ("x", "y") or not equals or not position:
            raise InputError(f'--line must be a position such as "y=middle" or "x=3um", but is {text!r}.')
        made["slice"] = {axis: position}
    fill = {"method": "harmonic", **chosen["fill"]}
    require.one_of(str(fill["method"]), (*_words("fill", "method"), "none"), "--fill")
    made["fill"] = None if fill == {"method": "none"} else fill
    if sieve:
        made["filter"] = kept = {"kind": "gaussian", **sieve}
        require.one_of(str(kept["kind"]), _words("filter", "kind"), "--filter")
    return [{"step": step, **values} for step in order if (values := made.get(step)) is not None]


def _mask(given: Mapping[str, Any]) -> dict[str, Any]:
    """The step of ``--mask`` with the tables of its regions."""
    if "regions" not in given:
        raise InputError("--mask-invert must be given together with --mask, but is alone.")
    return {**given, "regions": [_region(part.strip()) for part in str(given["regions"]).split(";") if part.strip()]}


def _region(text: str) -> dict[str, Any]:
    """Table of a region such as ``"ellipse 5um,5um,2um,1um,30deg"``."""
    kind, _, rest = text.partition(" ")
    values = [value.strip() for value in rest.split(",")]
    if kind == "rectangle" and len(values) in (1, 2) and any(values):
        return {"kind": kind, **{axis: part for axis, part in zip("xy", values, strict=False) if part}}
    if kind == "ellipse" and len(values) in (4, 5):
        angle = {"angle": values[4]} if len(values) == 5 else {}
        return {"kind": kind, "centre": values[:2], "radii": values[2:4], **angle}
    if kind == "polygon" and len(values) >= 6 and len(values) % 2 == 0:
        return {"kind": kind, "x": values[::2], "y": values[1::2]}
    raise InputError(
        '--mask must be regions such as "rectangle 0um:2um,1um:3um", "ellipse 5um,5um,2um,1um" with its middle and '
        f'semi-axes, or "polygon 0um,0um,4um,0um,2um,3um" with its corners, and semicolons between, but holds {text!r}.'
    )


def _require_tip(given: Mapping[str, Any]) -> None:
    """Refuse options of a tip that do not go together."""
    if {"radius", "pixels"} <= given.keys():
        raise InputError("--estimate-tip must be left out with --remove-tip: the tip is known, or estimated.")
    for key, needed in (("opening", ("radius",)), ("noise", ("pixels",)), ("mask_uncertain", ("radius", "pixels"))):
        if key in given and not {*needed} & given.keys():
            named = {option.path[-1]: option.name for option in preparation_options() if option.path[1] == "tip"}
            wanted = " or ".join(named[name] for name in needed)
            raise InputError(f"{named[key]} must be given together with {wanted}, but is alone.")


def _words(step: str, key: str) -> Iterable[str]:
    """Words that a parameter of a step may be."""
    return next(item.words for item in parameters(STEPS[step]) if item.name == key)


_OPTIONS_OF_STEPS = MappingProxyType(
    {
        ("tip", "step"): "--remove-tip",
        ("tip_limit", "step"): "--tip-radius",
        ("mask", "step"): "--mask",
        ("level", "degree"): "--level",
        ("level", "step"): "--level",
    }
)


def step_names(steps: Iterable[Mapping[str, Any]]) -> dict[str, str]:
    """What the user calls the keys of the preparation ``steps``: the option that made the step."""
    options = {option.path[1:]: option.name for option in preparation_options()} | dict(_OPTIONS_OF_STEPS)
    whole = {step: name for (step, _), name in options.items()} | {"crop": "--crop"}
    return {
        f"{table}.prepare[{number}].{key}": f"{key} of --crop"
        if step["step"] == "crop"
        else options.get((str(step["step"]), key), whole[str(step["step"])])
        for table in ("surface", "counter_surface")
        for number, step in enumerate(steps, start=1)
        for key in step
    }
