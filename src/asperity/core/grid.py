"""The rectangular grid on which heights, pressures and displacements live."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from . import require
from .arrays import RealArray


@dataclass(frozen=True)
class Grid:
    """Regular grid of ``shape`` (nx, ny) pixels of ``spacing`` (dx, dy) metres; array axis 0 is x,
    axis 1 is y.

    Every node owns one pixel, so the physical size is ``n * d`` per axis for periodic and for other
    maps alike.

    Raises
    ------
    InputError
        If there are not two counts and two spacings, a count is not a whole number >= 1 or a
        spacing not within 1e-41 to 1e40 m.
    """

    shape: tuple[int, int]
    spacing: tuple[float, float]

    def __post_init__(self) -> None:
        nx, ny = require.two(self.shape, "grid shape", "Write (nx, ny).")
        dx, dy = require.two(self.spacing, "grid spacing", "Write (dx, dy) in m.")
        nx, ny = (require.integer(n, 1, f"number of grid points along {a}") for n, a in ((nx, "x"), (ny, "y")))
        dx, dy = (require.magnitude(d, f"grid spacing along {a} (m)") for d, a in ((dx, "x"), (dy, "y")))
        object.__setattr__(self, "shape", (nx, ny))
        object.__setattr__(self, "spacing", (dx, dy))

    @property
    def size(self) -> tuple[float, float]:
        """Physical extent (Lx, Ly) in m."""
        return self.shape[0] * self.spacing[0], self.shape[1] * self.spacing[1]

    @property
    def exchanged(self) -> Grid:
        """The grid with x and y exchanged."""
        return Grid(self.shape[::-1], self.spacing[::-1])

    @property
    def pixels(self) -> tuple[float, ...]:
        """Spacings in m along the axes with more than one point; along x of a single point."""
        return tuple(d for d, n in zip(self.spacing, self.shape, strict=True) if n > 1) or self.spacing[:1]

    @property
    def pixel_area(self) -> float:
        """Area of one pixel in m²."""
        return self.spacing[0] * self.spacing[1]

    @property
    def area(self) -> float:
        """Nominal area in m²."""
        return self.shape[0] * self.shape[1] * self.pixel_area

    @property
    def n_points(self) -> int:
        """Number of pixels nx·ny."""
        return self.shape[0] * self.shape[1]

    def coordinates(self) -> tuple[RealArray, RealArray]:
        """Node coordinates x (nx, 1) and y (1, ny) in m, from 0 at node (0, 0)."""
        (nx, ny), (dx, dy) = self.shape, self.spacing
        return np.arange(nx)[:, None] * dx, np.arange(ny)[None, :] * dy

    def centred_coordinates(self) -> tuple[RealArray, RealArray]:
        """Coordinates x (nx, 1) and y (1, ny) in m, from 0 at node (nx // 2, ny // 2)."""
        x, y = self.coordinates()
        return x - x[self.shape[0] // 2, 0], y - y[0, self.shape[1] // 2]

    def wavevector(self, *, odd: bool = False) -> tuple[RealArray, RealArray]:
        """Wavevector components qx (nx, 1) and qy (1, ny // 2 + 1) in rad/m, in the order of a real
        2-D FFT.

        With ``odd`` zero at the Nyquist wavenumbers of even sizes, whose sign is undefined: for odd
        functions of them.
        """
        (nx, ny), (dx, dy) = self.shape, self.spacing
        qx = 2.0 * np.pi * np.fft.fftfreq(nx, dx)[:, None]
        qy = 2.0 * np.pi * np.fft.rfftfreq(ny, dy)[None, :]
        for q, n in ((qx, nx), (qy, ny)) if odd else ():
            if n % 2 == 0:
                q.flat[n // 2] = 0.0
        return qx, qy

    def wavenumber(self) -> RealArray:
        """Magnitude q of the wavevector, shape (nx, ny // 2 + 1), in rad/m."""
        qx, qy = self.wavevector()
        return np.hypot(qx, qy)
