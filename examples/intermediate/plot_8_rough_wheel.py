"""
Creep of a rough, coated roller
===============================

A driven roller creeps: the more force it transmits, the more of its contact slips at the trailing
edge. Carter's curve is that of a smooth one; here a soft layer and roughness, which moves through
the contact with the material, come into it.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# Steel rollers of a relative radius of 20 mm under 100 N per mm of length, in plane strain.
R, mu, points = 20e-3, 0.2, 96
steel = asp.material("steel")
E_star = asp.solids.contact_modulus(steel, steel)
a = np.sqrt(4.0 * 1e5 * R / (np.pi * E_star))
dx = 3.0 * a / points
x = (np.arange(points) - 0.5 * (points - 1)) * dx
shape = asp.Surface(-(x[:, None] ** 2) / (2.0 * R), dx, 1.0)


def rollers(body):
    return asp.ContactProblem(shape, body, counter_body=body, boundary=asp.FreeLine(), friction=asp.Coulomb(mu))


# %%
# Creep-force curves: plain rollers, with Carter beside them, and such with half a contact width of
# a soft layer.
load, creepages = asp.Force(1e5), np.linspace(0.1, 1.4, 8) * mu * a / R
soft = asp.Layered([asp.Layer(asp.Elastic(70e9, 0.3), 0.5 * a)], base=steel)
plain, layered = (asp.rolling.creep_curve(rollers(body), load, creepages) for body in (steel, soft))
carter = plain.theory("carter")

# %%
# Roughness of 0.1 µm comes again after 1.3 contact widths. Forces fluctuate; their means are the
# curve.
n, wave = 80, np.arange(3, 20)
phase = np.random.default_rng(5).uniform(0.0, 2.0 * np.pi, wave.size)
heights = np.sin(2.0 * np.pi * wave * np.arange(n)[:, None] / n + phase) @ wave**-1.3
rough = asp.Surface(0.1e-6 / heights.std() * heights[:, None], dx, 1.0)
rolled = asp.rolling.roll_rough(rollers(steel), load, asp.rolling.Creepage(creepages[2]), rough)
mean, spread = rolled.mean("force_x"), rolled.deviation("force_x")
share = rolled.mean("contact_area") / (2.0 * a)
print(f"contact on {100 * share:.0f} % of the width, {mean / plain.longitudinal_force[2]:.3f} of the smooth force")

# %%
# The curve depends on where the contact sticks, hardly on the roughness within it.
_, (left, right) = plt.subplots(1, 2, figsize=(8.0, 3.4))
for curve, label in ((plain, "steel"), (layered, "soft layer")):
    left.plot(1e3 * creepages, curve.longitudinal_force / curve.friction_limit, ".-", label=label)
left.plot(1e3 * creepages, carter.force_x / plain.friction_limit, "k--", label="Carter (1926)")
left.errorbar(1e3 * creepages[2], mean / plain.friction_limit, spread / plain.friction_limit, fmt="s", label="rough")
left.set(xlabel="creepage (‰)", ylabel="force / limit of the friction", ylim=(0.0, 1.1))
left.legend()
right.plot(1e3 * rolled.distance, rolled.force_x / rolled.friction_limit)
right.set(xlabel="distance rolled (mm)", ylabel="force of the rough roller / limit")
plt.tight_layout()
plt.show()
