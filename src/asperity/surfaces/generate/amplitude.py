"""How the amplitude of a spectrum is given: alternatives, of which a spectrum takes one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from ...core import require
from ...core.errors import InputError
from ...core.units import show


@dataclass(frozen=True)
class RmsHeight:
    """Amplitude of a spectrum given by the rms height (m) of the surface, about its mean."""

    value: float

    def __post_init__(self) -> None:
        require.positive(self.value, "rms height (m)")


@dataclass(frozen=True)
class RmsSlope:
    """Amplitude of a spectrum given by the rms gradient sqrt(<|∇h|²>) of the surface (spectral, dimensionless)."""

    value: float

    def __post_init__(self) -> None:
        require.positive(self.value, "rms slope")


@dataclass(frozen=True)
class PlateauPSD:
    """Amplitude of a spectrum given by its plateau C0 (m⁴)."""

    value: float

    def __post_init__(self) -> None:
        require.positive(self.value, "plateau of the power spectrum (m^4)")


Amplitude: TypeAlias = RmsHeight | RmsSlope | PlateauPSD


def require_amplitude(amplitude: object, what: str) -> None:
    """Refuse what is not an ``Amplitude``; ``what`` names the spectrum.

    Raises
    ------
    InputError
        As said.
    """
    if not isinstance(amplitude, (RmsHeight, RmsSlope, PlateauPSD)):
        raise InputError(
            f"amplitude of a {what} spectrum must be an RmsHeight, RmsSlope or PlateauPSD, "
            f"but is {amplitude!r}. Write for example RmsHeight(1e-9)."
        )


def amplitude_text(amplitude: Amplitude) -> str:
    """Words and number of ``amplitude`` for the history of a surface."""
    if isinstance(amplitude, RmsHeight):
        return f"rms height {show(amplitude.value, 'm')}"
    name, unit = ("rms slope", "") if isinstance(amplitude, RmsSlope) else ("plateau", " m^4")
    return f"{name} {amplitude.value:.4g}{unit}"
