"""The pressure of a fluid that flows through the gap and acts on both bodies: what is given."""

from __future__ import annotations

from dataclasses import dataclass

from ...core import require
from ...core.errors import InputError
from .flow import DRIVEN, WAYS, Driven, Way
from .fluids import Fluid, IdealGas


@dataclass(frozen=True)
class FluidPressure:
    """A fluid that flows through the gap between two pressures, and whose pressure acts on both
    bodies.

    The load is the force on the back of the bodies: it is borne by the touching surfaces and the
    fluid between the others. Pressures are those of ``leakage``. Closed pools hold the pressure of
    the fluid around them.

    Parameters
    ----------
    fluid
        ``ViscousLiquid(viscosity)`` or ``IdealGas(viscosity, mean_free_path)``.
    inlet, outlet
        Pressures in Pa where the fluid enters and leaves.
    way
        ``"x"`` or ``"y"``, along which the pressure falls over the length of the grid.
    driven
        ``"sides"``, ``"gradient"`` or ``"auto"``, as of ``leakage``. Under a mean gradient the
        bodies bear the mean of inlet and outlet and what the flow changes in it, not the part that
        falls steadily, which would not repeat with them. Between two sides of a surface that
        repeats, so do the sides.
    back
        Pressure in Pa of a fluid on the back of the bodies, beside the load: the outlet's, where
        they stand in it.

    Raises
    ------
    InputError
        If the inlet is not above the outlet, or another value is out of range.
    """

    fluid: Fluid
    inlet: float
    outlet: float = 0.0
    way: Way = "x"
    driven: Driven = "auto"
    back: float = 0.0

    def __post_init__(self) -> None:
        require.one_of(self.way, WAYS, "direction of flow")
        require.one_of(self.driven, DRIVEN, "way of driving the flow")
        if not isinstance(self.fluid, Fluid):
            raise InputError(
                f"fluid that presses must be a ViscousLiquid or IdealGas, but is {type(self.fluid).__name__}."
            )
        require.finite(self.back, "pressure on the back (Pa)")
        require.finite(self.outlet, "pressure at the outlet (Pa)")
        if not require.finite(self.inlet, "pressure at the inlet (Pa)") > self.outlet:
            raise InputError(
                f"pressure at the inlet must be above that at the outlet, {self.outlet:g} Pa, but is {self.inlet:g} Pa."
            )
        if isinstance(self.fluid, IdealGas) and self.outlet < 0.0:
            raise InputError(f"pressure of a gas must be at least zero, but is {self.outlet:g} Pa.")

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers behind it."""
        return (*self.fluid.citation_keys, "Dapp2012")
