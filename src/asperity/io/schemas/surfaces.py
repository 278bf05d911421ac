"""Where a surface comes from: a file, or a declared function of ``asperity.generate`` by the name of its kind."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any, Literal, Optional, TypeAlias, Union

from pydantic import Field, create_model, model_validator

from ...core.errors import InputError
from ...core.parameters import parameters
from ...core.settings import Settings, setting, table_of
from ...core.values import Angle, Length, NonEmpty, Points, Psd, SignedLength, Size
from ...surfaces import generate
from ...surfaces.generate.gaussian import Spectrum
from ...surfaces.generate.non_gaussian import Marginal
from ...surfaces.generate.power_laws import Amplitude
from ...surfaces.surface import Surface
from .preparation import Step
from .values import Channel, HeightUnit


class Place(Settings):
    """Where a counter surface lies: ``shift`` of its middle from that of the surface, ``angle`` from +x towards +y.

    Both surfaces are resampled on one grid that covers their overlap, with the finer pixel or the given one.
    """

    shift: tuple[SignedLength, SignedLength] | None = None
    angle: Angle | None = None
    pixel: tuple[Length, Length] | None = None


class AnySurface(Settings):
    """What all surfaces have: preparation steps, and for a counter surface how it is turned over and where it lies.

    ``mirror`` is ``"x"`` or ``"y"`` for a map measured facing its own body, and ``"none"`` for one that is already
    in the lateral frame of the other surface. With ``place`` the two need not have the same grid.
    """

    prepare: tuple[Step, ...] = ()
    mirror: Literal["x", "y", "none"] | None = None
    place: Place | None = None


class FileSurface(AnySurface):
    """Heights from a file; a relative ``path`` starts at the folder of the document."""

    kind: Literal["file"]
    path: NonEmpty = setting(help="file with the measured heights; levelled and filled")
    channel: Channel | None = setting(None, help="name or number of the channel")
    size: Size | None = setting(None, help='physical size, such as "20 um x 10 um", if the file does not state it')
    height_unit: HeightUnit | None = setting(None, help="unit of the heights, if the file does not state it: nm, um, …")
    z_scale: Length | None = setting(None, help="height of the full grey scale of a picture")


class GeneratedSurface(AnySurface):
    """What all generated surfaces have: a grid."""

    points: Points = setting(help="number of points along x and y")
    size: Size = setting(help='physical size, such as "20 um x 10 um"')


AMPLITUDES = MappingProxyType(
    {"rms_height": generate.RmsHeight, "rms_slope": generate.RmsSlope, "plateau": generate.PlateauPSD}
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
) -> generate.TabulatedSpectrum:
    """Isotropic spectrum C at some ``wavelengths``, in descending order; straight in between on logarithmic scales."""
    return generate.TabulatedSpectrum([2.0 * math.pi / length for length in wavelengths], psd)


SPECTRA: Mapping[str, Callable[..., Any]] = MappingProxyType(
    {
        "exponential": generate.ExponentialAutocorrelation,
        "gaussian": generate.GaussianAutocorrelation,
        "self_affine": generate.SelfAffine,
        "two_slopes": generate.TwoSlopes,
        "table": tabulated,
        "measured": generate.spectrum_of,
    }
)
"""What makes each kind of spectrum."""

HEIGHTS: Mapping[str, Callable[..., Any]] = MappingProxyType(
    {"moments": generate.HeightMoments, "measured": generate.HeightsOf, "two_levels": generate.TwoLevels}
)
"""What makes each kind of distribution of heights."""

SURFACES: Mapping[str, Callable[..., Surface]] = MappingProxyType(
    {
        "rough": generate.gaussian,
        "digital_filter": generate.digital_filter,
        "translated": generate.translated,
        "rank_ordered": generate.rank_ordered,
        "bimodal": generate.bimodal,
        "two_process": generate.two_process,
        "particles": generate.particles,
        "weierstrass_mandelbrot": generate.weierstrass_mandelbrot,
        "weierstrass_mandelbrot_profile": generate.weierstrass_mandelbrot_profile,
        "sphere": generate.sphere,
        "elliptic_paraboloid": generate.elliptic_paraboloid,
        "cylinder": generate.cylinder,
        "cone": generate.cone,
        "wedge": generate.wedge,
        "power_law": generate.power_law,
        "flat_punch": generate.flat_punch,
        "sinusoid": generate.sinusoid,
        "bisinusoid": generate.bisinusoid,
        "flat": generate.flat,
        "laser_bumps": generate.laser_bumps,
        "dimples": generate.dimples,
        "grooves": generate.grooves,
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
    with_amplitude, amplitudes = _amplitude_table(), (generate.SelfAffine, generate.TwoSlopes)
    return {
        kind: table_of(made, with_amplitude if made in amplitudes else base, f"kind={kind}", tables=types)
        for kind, made in kinds.items()
    }


SPECTRUM_TABLES = MappingProxyType(_tables(SPECTRA, Settings, {Surface: FileSurface, Amplitude: None}))
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
    _tables(SURFACES, GeneratedSurface, {Spectrum: SpectrumTable, Marginal: HeightsTable})
)
"""The table of each kind of generated surface."""

if not TYPE_CHECKING:
    Generated = Annotated[Union[tuple(SURFACE_TABLES.values())], Field(discriminator="kind")]  # noqa: UP007
    SurfaceTable = Annotated[Union[(FileSurface, *SURFACE_TABLES.values())], Field(discriminator="kind")]
