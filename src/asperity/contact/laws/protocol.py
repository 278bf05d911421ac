"""What an interface law must say to the normal contact problem."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

from ...core.arrays import RealArray


@runtime_checkable
class InterfaceLaw(Protocol):
    """Law of the interface; frictionless and without adhesion it is a bound on the pressure."""

    @property
    def name(self) -> str:
        """Name for reports and documents."""

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers the law rests on."""

    def pressure_cap(self) -> float | RealArray:
        """Largest pressure the interface bears, in Pa: a number, an (nx, ny) array, or infinity."""
