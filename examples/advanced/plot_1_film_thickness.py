"""
Meniscus force against the thickness of a film
==============================================

One asperity in a film is pulled with a force that does not depend on how thick the film is. A rough
surface is pulled harder by a thicker film, which reaches more asperities, until liquid fills the
gap.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

lubricant, body = asp.liquid("PFPE"), asp.material("glass ceramics")
films = np.array([1.0, 1.5, 2.0, 3.0, 4.0]) * 1e-9


def pull(surface, control, thickness, boundary):
    """Meniscus force in N."""
    film = asp.LiquidFilm.of(lubricant, thickness)
    return asp.solve(asp.ContactProblem(surface, body, film=film, boundary=boundary), control).menisci.meniscus_force


# %%
# **One asperity.** A paraboloid of radius 1 µm that just touches the other body through a film of
# thickness h: the meniscus has the area 2πRh and the suction 2γ/h, so its force is 4πRγ whatever
# the film.
asperity = asp.generate.sphere(asp.Grid((128, 128), (2e-9, 2e-9)), radius=1e-6)
single = np.array([pull(asperity, asp.Approach(1e-13), film, asp.Free()) for film in films])
closed_form = 4 * np.pi * 1e-6 * lubricant.surface_tension

# %%
# **Many asperities**, of three roughnesses, under 5 MPa. No film pulls harder than 2γ/h on the
# whole area (dashed). The smoothest surface comes near that limit: it is flooded, and would stick.
# Roughness is what keeps smooth disks apart.
grid, load = asp.Grid((96, 96), (40e-9, 40e-9)), asp.MeanPressure(5e6)
rough = {}
for rms in (1e-9, 2e-9, 3e-9):
    surface = asp.generate.gaussian(grid, asp.generate.GaussianAutocorrelation(rms, 0.5e-6), seed=1)
    rough[rms] = np.array([pull(surface, load, film, asp.Periodic()) for film in films]) / (load.value * grid.area)

figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
axes[0].plot(films * 1e9, single * 1e9, "o", label="solution")
axes[0].axhline(closed_form * 1e9, color="k", lw=1, label="4πRγ")
axes[0].set(xlabel="film thickness (nm)", ylabel="force of one meniscus (nN)", ylim=(0, 400))
axes[0].legend(loc="lower left")
for rms, values in rough.items():
    axes[1].plot(films * 1e9, values, "o-", label=f"rms height {1e9 * rms:.0f} nm")
axes[1].plot(films * 1e9, 2 * lubricant.surface_tension / films / load.value, "k--", label="2γ/h on the whole area")
axes[1].set(xlabel="film thickness (nm)", ylabel="meniscus force / load", ylim=(0, 8))
axes[1].legend()
plt.show()
