"""
Generate a rough surface
========================

Many engineering surfaces are rough on many scales. A self-affine spectrum describes them with four
numbers: a height or slope, the Hurst exponent, and the longest and the shortest wavelength.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# Here the rms slope is prescribed, because it decides how much of a surface touches. Equal seeds
# give equal surfaces.
grid = asp.Grid((256, 256), (50e-9, 50e-9))  # points and pixel, m
spectrum = asp.generate.SelfAffine(
    amplitude=asp.generate.RmsSlope(0.1), hurst=0.8, rolloff_wavelength=2e-6, shortest_wavelength=0.4e-6
)
surface = asp.generate.gaussian(grid, spectrum, seed=3)
found = asp.characterise(surface)
print(f"rms height {1e9 * found.heights.Sq:.2f} nm, rms slope {found.hybrid.Sdq:.4f}")

# %%
# The spectrum is flat below the wavenumber 2π/2 µm of the roll-off, falls as q to the power of -2 -
# 2H above it, and ends at 2π/0.4 µm. One realisation scatters about it, most at small wavenumbers:
# few waves of that length fit into the map.
measured = asp.roughness.radial_spectrum(asp.roughness.power_spectrum(surface))
inside = measured.q < 2 * np.pi / 0.4e-6
q = np.geomspace(measured.q[0], 2 * np.pi / 0.4e-6, 200)
figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
surface.plot("heights", axes[0])
axes[1].loglog(measured.q[inside] / 1e6, measured.psd[inside] * 1e36, "o", ms=4, label="this surface")
axes[1].loglog(q / 1e6, spectrum.psd(q) * 1e36, "k", label="prescribed")
axes[1].set(xlabel="wavenumber q (rad/µm)", ylabel="power spectrum C (nm⁴)")
axes[1].legend()

# %%
# The mean square height is the integral of qC/2π, and long waves make it; the mean square slope is
# the integral of q³C/2π, and short waves make it. With more short waves the height stays and the
# slope grows.
slopes = {}
for shortest in (1e-6, 0.5e-6, 0.25e-6):
    finer = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(10e-9), hurst=0.8, rolloff_wavelength=2e-6, shortest_wavelength=shortest
    )
    rough = asp.generate.gaussian(grid, finer, seed=3, variant="fixed")
    slopes[shortest] = asp.roughness.rms_slope(rough)
    print(f"waves down to {1e6 * shortest:.2f} µm: rms height {1e9 * asp.roughness.rms_height(rough):.2f} nm, "
          f"rms slope {slopes[shortest]:.3f}")  # fmt: skip
plt.show()
