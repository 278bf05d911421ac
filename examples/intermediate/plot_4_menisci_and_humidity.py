"""
Menisci and the humidity of the air
===================================

In moist air water condenses around the contacts and pulls the surfaces together. Kelvin's law gives
the height of the menisci, the gap between the deformed surfaces their area.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# Silicon, 3 nm rough, under 3 MPa. Film and menisci are in equilibrium with the vapour; what the
# menisci pull is part of the load, so that contact and menisci are solved together.
surface = asp.generate.gaussian(
    asp.Grid((128, 128), (40e-9, 40e-9)), asp.generate.GaussianAutocorrelation(3e-9, 0.5e-6), seed=1
)
humidity = np.array([0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9])
results = []
for share in humidity:
    film = asp.LiquidFilm.at_humidity(asp.liquid("water"), share, contact_angles=np.radians((60.0, 60.0)))
    problem = asp.ContactProblem(surface, asp.material("silicon"), film=film)
    results.append(asp.solve(problem, asp.MeanPressure(3e6)))
menisci = [result.menisci for result in results]

# %%
# The suction follows from Kelvin's and Laplace's laws, Δp = (RT/V) ln(1/humidity), and falls with
# the humidity, while the menisci grow. Around a single paraboloid both balance, and the force does
# not depend on the humidity; it rises where menisci spread over the ridges between the summits.
suction = np.array([found.suction for found in menisci])
area = np.array([found.meniscus_area_fraction for found in menisci])
pull = np.array([found.relative_meniscus_force for found in menisci])
figure, axes = plt.subplots(1, 3, figsize=(13, 3.8), layout="constrained")
axes[0].plot(100 * humidity, suction / 1e6, "o-")
axes[0].set(xlabel="relative humidity (%)", ylabel="suction in the menisci (MPa)", ylim=(0, None))
axes[1].plot(100 * humidity, 100 * area, "o-")
axes[1].set(xlabel="relative humidity (%)", ylabel="area of the menisci (% of nominal)", ylim=(0, None))
axes[2].plot(100 * humidity, pull, "o-")
axes[2].set(xlabel="relative humidity (%)", ylabel="meniscus force / load", ylim=(0, None))

# %%
# The menisci at 90 % humidity. Where the gap is low enough but no film reaches, no meniscus forms.
# Below some 50 % the Kelvin radius is only a few molecules wide, and the law is stretched.
results[-1].plot("menisci")
print(f"at 90 %: {menisci[-1].n_menisci} menisci, {1e9 * menisci[-1].meniscus_height:.1f} nm high")
plt.show()
