"""
Roughness parameters: the same Sq, another surface
==================================================

Two surfaces with one rms height can look and work very differently. ISO 25178-2 has parameters that
tell them apart.
"""

import matplotlib.pyplot as plt

import asperity as asp

# %%
# A Gaussian surface, as turned or blasted, and a plateau with valleys, as honed: both with rms
# height 50 nm, and the same correlation length of 2 µm.
g = asp.generate
grid = asp.Grid((256, 256), (0.125e-6, 0.125e-6))
correlation = g.GaussianAutocorrelation(50e-9, 2e-6)
surfaces = {
    "Gaussian": g.rank_ordered(grid, correlation, g.HeightMoments(skewness=0.0, kurtosis=3.0), seed=1),
    "plateau with valleys": g.rank_ordered(grid, correlation, g.HeightMoments(skewness=-1.5, kurtosis=6.0), seed=1),
}
found = {name: asp.characterise(surface) for name, surface in surfaces.items()}

# %%
# Skewness Ssk is negative where valleys are deep and peaks are cut; the reduced peak height Spk is
# what wears off first, the reduced valley depth Svk is what holds the oil. Sq does not see the
# difference.
for name, values in found.items():
    h, f = values.heights, values.functional
    print(f"{name}: Sq {1e9 * h.Sq:.1f} nm, Sa {1e9 * h.Sa:.1f} nm, Ssk {h.Ssk:.2f}, Sku {h.Sku:.2f}, "
          f"Spk {1e9 * f.Spk:.0f} nm, Svk {1e9 * f.Svk:.0f} nm")  # fmt: skip

figure, axes = plt.subplots(1, 3, figsize=(14, 4), layout="constrained")
for ax, (name, surface) in zip(axes, surfaces.items(), strict=False):
    surface.plot("heights", ax).set_title(name)
for name, surface in surfaces.items():
    curve = asp.roughness.material_ratio_curve(surface)
    axes[2].plot(100 * curve.ratios, 1e9 * curve.heights, label=name)
axes[2].set(xlabel="material ratio (%)", ylabel="height (nm)")
axes[2].legend()

# %%
# Every parameter knows its unit and its definition.
for quantity, value in list(found["Gaussian"].values())[:8]:
    print(f"{quantity.name} = {value:.4g} {quantity.unit}: {quantity.label}")
plt.show()
