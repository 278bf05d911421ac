"""Where a surface comes from, a file or a declared function of ``asperity.generate``, and the steps
that prepare it."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Optional, TypeAlias, Union

from pydantic import Field, create_model, model_validator

from ...core import units
from ...core.errors import FileFormatError, InputError
from ...core.parameters import checked, parameters
from ...core.registry import home
from ...core.settings import Settings, setting, table_of
from ...core.values import (
    Angle,
    Axis,
    Length,
    NonEmpty,
    NonNegativeLength,
    Points,
    Psd,
    SignedLength,
    Size,
    Values,
    Whole,
)
from ...core.words import speaking
from ...surfaces.generate import autocorrelation, bimodal, digital_filter, gaussian, non_gaussian, power_laws, spectra
from ...surfaces.generate import deterministic as shapes
from ...surfaces.generate.gaussian import Spectrum
from ...surfaces.generate.non_gaussian import Marginal
from ...surfaces.generate.power_laws import Amplitude
from ...surfaces.prepare.extent import cropped, periodised, resampled, sliced, tapered
from ...surfaces.prepare.filter import filtered, tip_limited
from ...surfaces.prepare.level import HIGHEST_DEGREE, despiked, filled, levelled, line_corrected
from ...surfaces.prepare.regions import Ellipse, Polygon, Rectangle, Region, masked
from ...surfaces.prepare.tip import ConicalTip, Opening, SphericalTip, Tip, estimated_tip, reconstructed
from ...surfaces.profile import Profile
from ...surfaces.profile_conversion import surface_of_profile
from ...surfaces.read import read
from ...surfaces.surface import Surface

# Steps of preparation: the table of a step has the parameters of its function, which ``prepared``
# calls.


@checked
def level(
    surface: Surface,
    *,
    form: Annotated[
        Literal["mean", "plane", "quadratic"] | None,
        "form to remove; by default the mean of a periodic surface, the plane of any other",
    ] = None,
    degree: Annotated[int | None, Whole(0, HIGHEST_DEGREE), "total degree of a polynomial to remove instead"] = None,
    robust: Annotated[bool, "leave out outliers, such as peaks and pits"] = False,
) -> Surface:
    """Remove a ``form`` or a polynomial of total ``degree``; ``robust`` leaves out outliers."""
    return levelled(surface, form if degree is None else degree, robust=robust)


@checked
def filter_waves(
    surface: Surface,
    *,
    short: Annotated[Length | None, "shorter waves are removed"] = None,
    short_y: Annotated[Length | None, "the same along y, if it differs"] = None,
    long: Annotated[Length | None, "longer waves are removed"] = None,
    long_y: Annotated[Length | None, "the same along y, if it differs"] = None,
    kind: Annotated[Literal["gaussian", "robust", "sharp"], "kind of filter"] = "gaussian",
    order: Annotated[Literal[0, 1, 2], "of the polynomial fitted around each node"] = 0,
) -> Surface:
    """Remove the waves shorter than ``short`` and longer than ``long``; ``short_y``, ``long_y``
    where y differs from x."""
    cutoffs = {"short": (short, short_y), "long": (long, long_y)}
    pairs = {name: (x, x if y is None else y) for name, (x, y) in cutoffs.items() if x is not None}
    return filtered(surface, short=pairs.get("short"), long=pairs.get("long"), kind=kind, order=order)


@checked
def remove_tip(
    surface: Surface,
    *,
    radius: Annotated[Length | None, "radius of the tip"] = None,
    opening: Annotated[Opening | None, "full opening angle of its cone; a sphere if left out"] = None,
    pixels: Annotated[Points | None, "odd numbers of pixels of a tip that is estimated from the scan itself"] = None,
    noise: Annotated[NonNegativeLength, "height by which noise may change differences of the scan"] = 0.0,
    mask_uncertain: Annotated[bool, "leave out the points that the tip did not touch for certain"] = False,
) -> Surface:
    """Reconstruct the surface behind a scan with a tip of ``radius`` and ``opening`` angle, or with
    one estimated on ``pixels``; before levelling."""
    tip: Tip
    if pixels is not None:
        tip = estimated_tip(surface, pixels, noise=noise)
    elif radius is not None:
        tip = SphericalTip(radius) if opening is None else ConicalTip(radius, opening)
    else:
        raise InputError("tip to remove must be given by its radius or by pixels to estimate it on, but is not.")
    return reconstructed(surface, tip, mask_uncertain=mask_uncertain)


STEPS: Mapping[str, Callable[..., Surface]] = MappingProxyType(
    {
        "level": level,
        "crop": cropped,
        "mask": masked,
        "resample": resampled,
        "fill": filled,
        "despike": despiked,
        "line_correct": line_corrected,
        "filter": filter_waves,
        "tip": remove_tip,
        "tip_limit": tip_limited,
        "taper": tapered,
        "periodise": periodised,
        "slice": sliced,
    }
)
"""What carries out each step."""

_AT_LEAST_ONE = {
    "crop": (("x", "y"), 'x = ["0 um", "5 um"]'),
    "filter": (("short", "long"), 'short = "1 um"'),
}
_EXACTLY_ONE = {
    "slice": (("x", "y"), 'y = "middle"'),
    "tip": (("radius", "pixels"), 'radius = "10 nm"'),
}
_TOGETHER = {
    "filter": (("short", "short_y"), ("long", "long_y")),
    "tip": (("radius", "opening"), ("pixels", "noise")),
}


class AnyStep(Settings):
    """What all steps have: rules on which of their keys go together."""

    @model_validator(mode="after")
    def _keys_go_together(self) -> AnyStep:
        step, given = getattr(self, "step", ""), self.given()
        if step in _AT_LEAST_ONE:
            keys, example = _AT_LEAST_ONE[step]
            if not any(key in given for key in keys):
                raise InputError(f" must give {' or '.join(keys)} or both, such as {example}, but gives neither.")
        if step == "level" and "form" in given and "degree" in given:
            raise InputError(" must give form or degree, but gives both.")
        if step in _EXACTLY_ONE:
            (first, second), example = _EXACTLY_ONE[step]
            if (first in given) == (second in given):
                both = "both" if first in given else "none"
                raise InputError(
                    f" must give exactly one of {first} and {second}, such as {example}, but gives {both}."
                )
        for key, other in _TOGETHER.get(step, ()):
            if other in given and key not in given:
                raise InputError(f" must give {key} together with {other}, but gives only {other}.")
        return self


def prepared(surface: Surface, step: Any) -> Surface:
    """``surface`` after one preparation ``step``."""
    made: Surface = step.makes(surface, **arguments_of(step))
    return made


def arguments_of(step: Any) -> dict[str, Any]:
    """Arguments of the function of a ``step``: its values, and the regions of a mask for their
    tables."""
    return {
        key: tuple(part.makes(**part.given("kind")) if isinstance(part, Settings) else part for part in value)
        if isinstance(value, tuple)
        else value
        for key, value in step.given("step").items()
    }


REGIONS = MappingProxyType({"rectangle": Rectangle, "ellipse": Ellipse, "polygon": Polygon})
"""What makes each kind of region of a mask."""


class AnyRegion(Settings):
    """What all regions of a mask have: a rule on which of their keys go together."""

    @model_validator(mode="after")
    def _keys_go_together(self) -> AnyRegion:
        given = self.given()
        if given.get("kind") == "rectangle" and not {"x", "y"} & given.keys():
            raise InputError(' must give x or y or both, such as x = ["0 um", "5 um"], but gives neither.')
        if given.get("kind") == "polygon" and not len(given["x"]) == len(given["y"]) >= 3:
            raise InputError(
                f" must give at least three corners, each with x and y, but gives {len(given['x'])} x and "
                f"{len(given['y'])} y."
            )
        return self


REGION_TABLES = MappingProxyType({kind: table_of(made, AnyRegion, f"kind={kind}") for kind, made in REGIONS.items()})
"""The table of each kind of region."""

if TYPE_CHECKING:
    RegionTable: TypeAlias = Any
    Step: TypeAlias = Any
else:
    RegionTable = Annotated[Union[tuple(REGION_TABLES.values())], Field(discriminator="kind")]  # noqa: UP007
    _OBJECTS = {tuple[Region, ...]: tuple[RegionTable, ...]}
    _STEP_TABLES = tuple(
        table_of(function, AnyStep, f"step={name}", tables=_OBJECTS) for name, function in STEPS.items()
    )
    Step = Annotated[Union[_STEP_TABLES], Field(discriminator="step")]  # noqa: UP007  (made from a tuple)


# Where a surface comes from.


class _Channel(Values):
    """Name of a data channel, or its number, 0 or more."""

    metavar = "NAME"
    json_schema: ClassVar[Mapping[str, Any]] = MappingProxyType(
        {"anyOf": [{"type": "string"}, {"type": "integer", "minimum": 0}]}
    )

    def read(self, value: Any, what: str) -> str | int:
        """The name or number."""
        if (isinstance(value, str) and value.strip()) or (type(value) is int and value >= 0):
            found: str | int = value
            return found
        raise InputError(f"{what} must be the name of a channel or its number, 0 or more, but is {value!r}.")


class _LengthUnit(Values):
    """Name of a unit of length."""

    metavar = "UNIT"
    json_schema: ClassVar[Mapping[str, Any]] = MappingProxyType({"type": "string", "examples": ["nm"]})

    def read(self, value: Any, what: str) -> str:
        """The name."""
        units.unit_factor(str(value), "length", what)
        return str(value)


class _Codes(Values):
    """Numbers and texts that stand for missing points: ``[-9999, "void"]``, ``"-9999,void"``."""

    metavar = "VALUE,..."

    def read(self, value: Any, what: str) -> tuple[float | str, ...]:
        """Numbers where they are some, else texts."""
        items = value.split(",") if isinstance(value, str) else value
        if not isinstance(items, list | tuple) or not items:
            items = [value]
        found: list[float | str] = []
        for item in items:
            if isinstance(item, bool) or not isinstance(item, int | float | str) or not str(item).strip():
                raise InputError(f"{what} must be numbers or texts that stand for missing points, but is {value!r}.")
            try:
                found.append(float(item))
            except ValueError:
                found.append(str(item).strip())
        return tuple(found)

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        """A list of numbers and texts."""
        items = {"anyOf": [{"type": "number"}, {"type": "string"}]}
        return {"type": "array", "items": items, "examples": [[-9999.0]]}


Channel: TypeAlias = Annotated[str | int, _Channel()]
Codes: TypeAlias = Annotated[tuple[float | str, ...], _Codes()]
HeightUnit: TypeAlias = Annotated[str, _LengthUnit()]


class Place(Settings):
    """Where a counter surface lies: ``shift`` of its middle from that of the surface, ``angle``
    from +x towards +y.

    Both surfaces are resampled on one grid that covers their overlap, with the finer pixel or the
    given one.
    """

    shift: tuple[SignedLength, SignedLength] | None = setting(
        None,
        option="--counter-shift",
        help="place of the counter surface's middle from that of the surface: 1um,0um",
    )
    angle: Angle | None = setting(
        None, option="--rotate", help="angle of the counter surface from +x towards +y: 30deg"
    )
    pixel: tuple[Length, Length] | None = None


class AnySurface(Settings):
    """What all surfaces have: preparation steps, and for a counter surface how it is turned over
    and where it lies.

    ``mirror`` is ``"x"`` or ``"y"`` for a map measured facing its own body, and ``"none"`` for one
    that is already in the lateral frame of the other surface. With ``place`` the two need not have
    the same grid.
    """

    prepare: tuple[Step, ...] = ()
    mirror: Literal["x", "y", "none"] | None = setting(
        None, help="how the counter surface is turned over; x for a file named on the command line"
    )
    place: Place | None = None


class FileReading(Settings):
    """A file with heights, and what it does not state itself."""

    path: NonEmpty = setting(help="file with the measured heights; levelled and filled")
    channel: Channel | None = setting(None, help="name or number of the channel")
    size: Size | None = setting(None, help='physical size, such as "20 um x 10 um", if the file does not state it')
    height_unit: HeightUnit | None = setting(None, help="unit of the heights, if the file does not state it: nm, um, …")
    z_scale: Length | None = setting(None, help="height of the full grey scale of a picture")
    lateral_unit: HeightUnit | None = setting(
        None, help="unit of the coordinates of points x y z, a line scan x z or a matrix"
    )
    missing: Codes | None = setting(None, help="numbers or texts that stand for missing points: -9999")
    delimiter: Literal["comma", "semicolon", "tab", "blank"] | None = setting(
        None, help="what stands between the columns of a text, if it is not found"
    )
    decimal: Literal["point", "comma"] | None = setting(
        None, help="what stands before the decimals of a text, if it is not found"
    )
    header_lines: Annotated[int, Whole(0)] | None = setting(
        None, help="lines to leave out at the beginning of a text, if they are not found"
    )
    axes: Literal["none", "row", "column", "both"] | None = setting(
        None, help="which of the first row and column of a text hold coordinates, if that is not found"
    )
    encoding: NonEmpty | None = setting(None, help="encoding of a text, if it is not found: utf-16, cp1252, …")

    def reading(self) -> dict[str, Any]:
        """Arguments of ``surfaces.read`` beside the path."""
        asked = FileReading.model_fields.keys() - {"path"}
        return self.given(*(key for key in type(self).model_fields if key not in asked))


class FileSurface(FileReading, AnySurface):
    """Heights from a file; a relative ``path`` starts at the folder of the document."""

    kind: Literal["file"]


class ScanFile(FileReading):
    """A scan of a surface of which there are many, a map or a line, from a file; a relative
    ``path`` starts at the folder of the document.

    It may be one line of text: ``"afm.txt, size=5um, height_unit=nm, tip_radius=10nm"``.
    """

    path: NonEmpty = setting(help="file with a map or a line scan")
    instrument: Literal["stylus", "optical", "afm"] | None = setting(
        None, help="kind of instrument, if the file does not state it; an optical one has the transfer of a lens"
    )
    tip_radius: Length | None = setting(None, help="radius of the tip, if the file does not state it")
    resolution: Length | None = setting(None, help="lateral resolution, if the file does not state it")
    noise: Length | None = setting(None, help="rms noise of the heights, if the file does not state it")
    short_cutoff: Length | None = setting(None, help="wavelength below which waves have been filtered")
    axis: Axis = setting("x", help="axis of a map along which its lines run")
    prepare: tuple[Step, ...] = ()

    @model_validator(mode="before")
    @classmethod
    def _from_line(cls, value: Any) -> Any:
        return cls.from_text(value) if isinstance(value, str) else value

    @classmethod
    def from_text(cls, line: str) -> dict[str, Any]:
        """Path and keys of one ``line`` of text."""
        keys = "|".join(key for key in cls.model_fields if key not in ("path", "prepare"))
        path, *given = re.split(rf",\s*(?=(?:{keys})\s*=)", line)
        pairs = (part.partition("=") for part in given)
        return {"path": path.strip(), **{key.strip(): text.strip() for key, _, text in pairs}}

    def scan(self, folder: Path) -> Any:
        """The ``Scan`` in the file, whose relative path starts at ``folder``, after its preparation
        and with what is known of the instrument.

        Raises
        ------
        InputError
            If a line scan is to be prepared, or its lines are to run along y.
        """
        held: Any = self._read(folder)
        if isinstance(held, Profile) and (self.prepare or self.axis != "x"):
            key = "prepare" if self.prepare else "axis"
            raise InputError(f"{key} of the scan {self.path} must be left out: the file holds a line scan, no map.")
        for step in self.prepare:
            held = prepared(held, step)
        keys = ("tip_radius", "resolution", "noise", "short_cutoff", "axis")
        known = {key: value for key, value in self.given().items() if key in keys}
        if self.instrument is not None:
            known["kind"] = self.instrument
        return home("surfaces.scans:Scan").of(held, name=self.path, **known)

    def _read(self, folder: Path) -> Surface | Profile:
        """What is in the file; errors name the keys of this table in place of options."""
        with speaking("kept"):
            try:
                return read(folder / self.path, **self.reading())
            except FileFormatError as error:
                told, subject = str(error), error.subject

        def named(found: re.Match[str]) -> str:
            example, key = found.groups()
            if key not in FileReading.model_fields:
                return found[0]
            return f"{key}={_EXAMPLES[key]}" if example else key

        raise FileFormatError(re.sub(r"\{(give_)?(\w+)\}", named, told), subject=subject)


_EXAMPLES = {"size": "20um", "height_unit": "nm", "lateral_unit": "um", "z_scale": "100nm"}
"""Values of keys of a scan in messages."""


class LineScanFile(FileSurface):
    """A line scan from a file, or a line that the preparation steps take of a map."""

    kind: Literal["file"] = "file"
    path: NonEmpty = setting(help="file with a line scan")


class GeneratedSurface(AnySurface):
    """What all generated surfaces have: a grid."""

    points: Points = setting(help="number of points along x and y")
    size: Size = setting(help='physical size, such as "20 um x 10 um"')


AMPLITUDES = MappingProxyType(
    {"rms_height": power_laws.RmsHeight, "rms_slope": power_laws.RmsSlope, "plateau": power_laws.PlateauPSD}
)
"""Keys of which a spectrum has exactly one, and what they stand for."""


class _OneAmplitude(Settings):
    """Exactly one amplitude: an rms height, an rms slope or the plateau of the spectrum."""

    @model_validator(mode="after")
    def _one_amplitude(self) -> _OneAmplitude:
        given = [key for key in AMPLITUDES if getattr(self, key) is not None]
        if len(given) != 1:
            raise InputError(
                f" must give exactly one of {', '.join(AMPLITUDES)}, but gives {' and '.join(given) or 'none'}."
            )
        return self


def tabulated(
    *,
    wavelengths: Annotated[tuple[Length, ...], "wavelengths of a table, descending, with commas between"],
    psd: Annotated[tuple[Psd, ...], "spectrum C at the wavelengths of a table, with commas between"],
) -> spectra.TabulatedSpectrum:
    """Isotropic spectrum C at some ``wavelengths``, in descending order; straight in between on
    logarithmic scales."""
    return spectra.TabulatedSpectrum([2.0 * math.pi / length for length in wavelengths], psd)


@checked
def spectrum_of_scan_files(
    *,
    scans: Annotated[
        tuple[Any, ...], "files with scans of one surface, one each, such as afm.txt,size=5um,height_unit=nm"
    ],
    corner: Annotated[Literal["auto", "rounded", "sharp"], "kind of roll-off; by default the likelier one"] = "auto",
    shortest_wavelength: Annotated[
        Length | None, "where the spectrum ends; by default the shortest wave that a scan shows reliably"
    ] = None,
) -> Spectrum:
    """The one spectrum of many ``scans`` of one surface, maps and lines, of any instrument, size
    and spacing."""
    found: Any = home("surfaces.scans:Scans")(scans).spectrum(corner=corner)
    made: Spectrum = found if shortest_wavelength is None else found.extended(shortest_wavelength)
    return made


SPECTRA: Mapping[str, Callable[..., Any]] = MappingProxyType(
    {
        "exponential": autocorrelation.ExponentialAutocorrelation,
        "gaussian": autocorrelation.GaussianAutocorrelation,
        "self_affine": spectra.SelfAffine,
        "two_slopes": spectra.TwoSlopes,
        "table": tabulated,
        "measured": spectra.spectrum_of,
        "scans": spectrum_of_scan_files,
    }
)
"""What makes each kind of spectrum."""

HEIGHTS: Mapping[str, Callable[..., Any]] = MappingProxyType(
    {
        "moments": non_gaussian.HeightMoments,
        "measured": non_gaussian.HeightsOf,
        "two_levels": non_gaussian.TwoLevels,
        "weibull": non_gaussian.Weibull,
    }
)
"""What makes each kind of distribution of heights."""

SURFACES: Mapping[str, Callable[..., Surface]] = MappingProxyType(
    {
        "rough": gaussian.gaussian,
        "digital_filter": digital_filter.digital_filter,
        "translated": non_gaussian.translated,
        "rank_ordered": non_gaussian.rank_ordered,
        "from_line_scan": surface_of_profile,
        "bimodal": bimodal.bimodal,
        "two_process": bimodal.two_process,
        "particles": bimodal.particles,
        "weierstrass_mandelbrot": shapes.weierstrass_mandelbrot,
        "weierstrass_mandelbrot_profile": shapes.weierstrass_mandelbrot_profile,
        "sphere": shapes.sphere,
        "elliptic_paraboloid": shapes.elliptic_paraboloid,
        "cylinder": shapes.cylinder,
        "cone": shapes.cone,
        "wedge": shapes.wedge,
        "power_law": shapes.power_law,
        "flat_punch": shapes.flat_punch,
        "sinusoid": shapes.sinusoid,
        "bisinusoid": shapes.bisinusoid,
        "flat": shapes.flat,
        "laser_bumps": shapes.laser_bumps,
        "dimples": shapes.dimples,
        "grooves": shapes.grooves,
    }
)
"""What makes each kind of generated surface."""


def _amplitude_table() -> type[_OneAmplitude]:
    """The three amplitudes, with what their types declare of their one value."""
    keys = {key: parameters(kind)[0] for key, kind in AMPLITUDES.items()}
    fields: dict[str, Any] = {key: (Optional[p.annotation], setting(None, help=p.help)) for key, p in keys.items()}  # noqa: UP045
    return create_model("OneAmplitude", __base__=_OneAmplitude, __module__=__name__, **fields)


def _tables(kinds: Mapping[str, Callable[..., Any]], base: type[Settings], types: Mapping[Any, Any]) -> dict[str, Any]:
    """The table of each of the ``kinds``."""
    with_amplitude, amplitudes = _amplitude_table(), (spectra.SelfAffine, spectra.TwoSlopes)
    return {
        kind: table_of(made, with_amplitude if made in amplitudes else base, f"kind={kind}", tables=types)
        for kind, made in kinds.items()
    }


SPECTRUM_TABLES = MappingProxyType(
    _tables(SPECTRA, Settings, {Surface: FileSurface, Amplitude: None, tuple[Any, ...]: tuple[ScanFile, ...]})
)
HEIGHTS_TABLES = MappingProxyType(_tables(HEIGHTS, Settings, {Surface: FileSurface}))

if TYPE_CHECKING:
    SpectrumTable: TypeAlias = Any
    HeightsTable: TypeAlias = Any
    Generated: TypeAlias = Any
    SurfaceTable: TypeAlias = Any
else:
    SpectrumTable = Annotated[Union[tuple(SPECTRUM_TABLES.values())], Field(discriminator="kind")]  # noqa: UP007
    HeightsTable = Annotated[Union[tuple(HEIGHTS_TABLES.values())], Field(discriminator="kind")]  # noqa: UP007

SURFACE_TABLES: Mapping[str, type[GeneratedSurface]] = MappingProxyType(
    _tables(SURFACES, GeneratedSurface, {Spectrum: SpectrumTable, Marginal: HeightsTable, Profile: LineScanFile})
)
"""The table of each kind of generated surface."""

if not TYPE_CHECKING:
    Generated = Annotated[Union[tuple(SURFACE_TABLES.values())], Field(discriminator="kind")]  # noqa: UP007
    SurfaceTable = Annotated[Union[(FileSurface, *SURFACE_TABLES.values())], Field(discriminator="kind")]
