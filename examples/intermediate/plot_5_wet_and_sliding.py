"""
Static friction of a wet contact
================================

Menisci pull, and what they pull is carried by the solid contact, which resists sliding. So the
coefficient of friction seen from outside grows as the load gets lighter.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# A slider of alumina-titanium carbide on a disk with 1.5 nm of lubricant. The friction of the dry
# contact is 0.3. The bodies are unlike, so that the shear traction changes the pressure: menisci,
# shear and pressure are solved together.
surface = asp.generate.gaussian(
    asp.Grid((96, 96), (40e-9, 40e-9)), asp.generate.GaussianAutocorrelation(2e-9, 0.5e-6), seed=3
)
film = asp.LiquidFilm.of(asp.liquid("PFPE"), 1.5e-9)
problem = asp.ContactProblem(
    surface,
    asp.material("glass ceramics"),
    counter_body=asp.material("Al2O3-TiC"),
    film=film,
    friction=asp.Coulomb(0.3),
)
loads = np.geomspace(2e6, 100e6, 6)
path = asp.solve(problem, asp.History([asp.MeanPressure(float(load)) for load in loads]))

# %%
# With the load W and the pull F of the menisci the friction is μ (W + F), and its coefficient μ
# (1 + F/W).
pull = np.array([step.menisci.relative_meniscus_force for step in path.steps])
static = np.array([step.menisci.static_friction for step in path.steps])
figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
axes[0].semilogx(loads / 1e6, static, "o-", label="wet")
axes[0].axhline(0.3, color="k", ls="--", label="dry")
axes[0].set(xlabel="mean pressure of the load (MPa)", ylabel="static friction coefficient", ylim=(0, None))
axes[0].legend()
path.steps[0].plot("menisci", axes[1])
for load, step in zip(loads, path.steps, strict=True):
    print(f"{load / 1e6:6.1f} MPa: friction {step.menisci.static_friction:.3f}, {step.menisci.wetting.regime}, "
          f"solved in {step.certificate.rounds} rounds")  # fmt: skip
plt.show()
