"""
Plastic flow below a rough coated surface
=========================================

A rough surface with a hard film is pressed against a rigid flat and let go. Plastic strain grows
below the asperities, in the film and in the softer base under it; what stays is an imprint and
residual stress, which pulls at the film. The volume method finds plastic strain and pressure
together.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# A film of 200 nm with four times the yield stress of the steel below; 48 x 48 points, 0.2 µm
# apart.
film = asp.Elastic(300e9, 0.25, asp.Strength(yield_stress=1.6e9))
steel = asp.Elastic(200e9, 0.3, asp.Strength(hardening=asp.plasticity.Swift(400e6, 0.002, 0.2)))
body = asp.Layered([asp.Layer(film, 200e-9)], steel)
grid = asp.Grid((48, 48), (0.2e-6, 0.2e-6))
spectrum = asp.generate.GaussianAutocorrelation(20e-9, 1.2e-6)
surface = asp.generate.gaussian(grid, spectrum, seed=4)
law = asp.PlasticFlow([asp.plasticity.plastic_solid(film), asp.plasticity.plastic_solid(steel)], cells=16)

# %%
# Two steps to a mean pressure of 150 MPa, then the load is taken off; and the elastic contact
# beside it.
pressures = [75e6, 150e6]
history = asp.History([*map(asp.MeanPressure, pressures), asp.Unloaded()])
path = asp.solve(asp.ContactProblem(surface, body, plastic_flow=law), history)
loaded, off = path.steps[1:]
elastic = asp.solve(asp.ContactProblem(surface, body), asp.MeanPressure(pressures[-1]))
share, elastic_share = (float(result.contact.mean()) for result in (loaded, elastic))
flow = off.require_plastic_flow()
for name, zone in zip(("film", "steel"), flow.zones, strict=True):
    print(
        f"{name}: plastic strain up to {100.0 * zone.largest_strain:.2f} %, {1e9 * zone.top:.0f} to "
        f"{1e9 * zone.bottom:.0f} nm deep"
    )
print(
    f"real area {100.0 * share:.2f} %, elastic {100.0 * elastic_share:.2f} %; deepest imprint "
    f"{1e9 * flow.displacement.max():.2f} nm"
)

# %%
# A cut through the largest plastic strain.
zone = max(flow.zones, key=lambda zone: zone.largest_strain)
row = int(zone.place[1] / grid.spacing[1])
x, depth = 1e6 * np.arange(49) * grid.spacing[0], 1e9 * flow.flowed.edges
strain = np.where(flow.accumulated[:, :, row] > 0.0, 100.0 * flow.accumulated[:, :, row], np.nan)
stress = flow.stress()[:, 0, :, row] / 1e6

figure, (left, right) = plt.subplots(2, 1, figsize=(7.0, 5.4), layout="constrained")
for ax, values, colours, top, label in (
    (left, strain, "viridis", float(np.nanmax(strain)), "plastic strain (%)"),
    (right, stress, "RdBu_r", float(np.abs(stress).max()), "residual stress σxx (MPa)"),
):
    low = 0.0 if colours == "viridis" else -top
    shown = ax.pcolormesh(x, depth, values, cmap=colours, vmin=low, vmax=top)
    ax.axhline(200.0, color="black", linewidth=0.8)
    ax.set(ylim=(depth[-1], 0.0), xlabel="x (µm)", ylabel="depth (nm)")
    figure.colorbar(shown, ax=ax, label=label)
plt.show()
