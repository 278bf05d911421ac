"""
The slope of a surface depends on the microscope
================================================

On a self-affine surface there is always a finer scale. The rms slope follows the sampling interval,
and the real area of contact follows the slope; the rms height does not change.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# A surface with Hurst exponent 0.7 that is rough down to its pixel of 20 nm, and what coarser
# instruments see of it: every second, fourth, … point.
H = 0.7
spectrum = asp.generate.SelfAffine(
    amplitude=asp.generate.RmsHeight(20e-9), hurst=H, rolloff_wavelength=2e-6, shortest_wavelength=40e-9
)
fine = asp.generate.gaussian(asp.Grid((512, 512), (20e-9, 20e-9)), spectrum, seed=2)
study = asp.roughness.sampling_interval_study(fine)
interval = study.length

# %%
# What is expected of such a spectrum: the mean square difference of neighbours, divided by their
# distance. Well below the roll-off it follows the power 2H - 2 of the distance: no instrument finds
# *the* slope.
expected = [
    asp.roughness.expected_difference_moments(
        spectrum.psd, float(step), shortest_wavelength=40e-9, longest_wavelength=1e-3, bends=[2e-6]
    )[0]
    for step in interval
]

# %%
# Press what each instrument has seen. The area under one load is nearly inverse to the slope, so
# their product stays.
product, area = [], []
for every in (2, 4, 8, 16):
    seen = asp.Surface(fine.heights[::every, ::every], every * fine.dx, periodic=True)
    result = asp.solve(asp.ContactProblem(seen, asp.material("silicon")), asp.MeanPressure(200e6))
    area.append(result.area_fraction_corrected)
    product.append(area[-1] * asp.roughness.rms_slope(seen))
print("area times rms slope:", *(f"{value:.4f}" for value in product))

figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
axes[0].loglog(interval * 1e9, np.sqrt(study.mean["m2_x"]), "o", label="slope of a profile, measured")
axes[0].loglog(interval * 1e9, np.sqrt(expected), "k", label="expected of the spectrum")
axes[0].loglog(interval * 1e9, 0.2 * (interval / interval[0]) ** (H - 1), "k:", label="power H - 1")
axes[0].set(xlabel="sampling interval (nm)", ylabel="rms slope")
axes[0].legend()
axes[1].semilogx(fine.dx * 1e9 * np.array([2, 4, 8, 16]), 100 * np.array(area), "o-")
axes[1].set(xlabel="sampling interval (nm)", ylabel="real area at 200 MPa (% of nominal)", ylim=(0, None))
for ax in axes:
    ax.set_xticks(interval * 1e9, [f"{1e9 * step:.0f}" for step in interval])
    ax.set_xticks([], minor=True)
axes[0].set_yticks([0.05, 0.1, 0.2], ["0.05", "0.1", "0.2"])
axes[0].set_yticks([], minor=True)
plt.show()
