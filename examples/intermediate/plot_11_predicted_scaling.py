"""
Scaling laws of coated surfaces, predicted
==========================================

Area, largest pressure and menisci of a rough coated surface in the groups without dimension of Peng
(2001, figs 3.14 to 3.20), from the table of solved contacts: some hundred of them in a few seconds.
His own solutions are marked.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# Lengths are those of his surfaces, but only groups matter: X = p β/(E₂ σ), E₁/E₂, h/β, and the
# pixel and the side over β, which an exponential autocorrelation needs too.
E, sigma, beta = 100e9, 1e-9, 0.5e-6
rough = asp.generate.ExponentialAutocorrelation(sigma, beta)
grid = asp.Grid((256, 256), (20e-6 / 256, 20e-6 / 256))
film = asp.LiquidFilm(surface_tension=10e-3, thickness=sigma)
ratios, loads, thicknesses = (0.5, 1.0, 2.0), np.geomspace(1e-3, 0.5, 24), np.geomspace(0.03, 20.0, 24)


def predicted(X, ratio, thickness):
    """Dry contact, and the share of the area that menisci as high as the rms height cover."""
    coating = asp.Layer(asp.Elastic(ratio * E, 0.3), thickness * beta)
    coated = asp.Layered([coating], base=asp.Elastic(E, 0.3))
    load = asp.MeanPressure(X * E * sigma / beta)
    wet = asp.predict(rough, coated, load, grid=grid, pull=(film.suction, film.thickness))
    return asp.predict(rough, coated, load, grid=grid), wet.pull_pressure.value / film.suction


# %%
# A stiffer coating carries the load on less area with more pressure. The band is where one surface
# of 40 β lies in 19 of 20 cases; only short waves feel a coating thinner than a tenth of β.
figure, axes = plt.subplots(2, 2, figsize=(9, 7), layout="constrained")
published = {0.5: ([2e-3], [2.29e-3]), 1.0: ([2e-3, 4e-3], [1.215e-3, 2.34e-3]), 2.0: ([2e-3], [6.31e-4])}
areas = {}
for ratio, colour in zip(ratios, ("C0", "C1", "C2"), strict=True):
    dry, menisci = zip(*(predicted(X, ratio, 2.0) for X in loads), strict=True)
    areas[ratio] = np.array([one.area_fraction_pixels.value for one in dry])
    low, high = np.array([one.peak_pressure.band for one in dry]).T * beta / (E * sigma)
    axes[0, 0].loglog(loads, areas[ratio], color=colour, label=f"E₁/E₂ = {ratio:g}")
    axes[0, 0].plot(*published[ratio], "o", color=colour)
    axes[0, 1].loglog(loads, [one.peak_pressure.value * beta / (E * sigma) for one in dry], color=colour)
    axes[0, 1].fill_between(loads, low, high, color=colour, alpha=0.2)
    axes[1, 0].loglog(loads, menisci, color=colour)
    over = [predicted(4e-3, ratio, thickness)[0].area_fraction_pixels.value / 4e-3 for thickness in thicknesses]
    axes[1, 1].semilogx(thicknesses, over, color=colour)
axes[0, 0].set(xlabel="X = p β/(E₂ σ)", ylabel="counted area / nominal area")
axes[0, 1].set(xlabel="X = p β/(E₂ σ)", ylabel="largest pressure × β/(E₂ σ)")
axes[1, 0].set(xlabel="X = p β/(E₂ σ)", ylabel="area of menisci / nominal area")
axes[1, 1].set(xlabel="h/β", ylabel="counted area/(nominal area X), X = 0.004")
axes[0, 0].legend()
plt.show()
