"""
How thick must a coating be?
============================

A coating much thinner than a contact is not felt, one much thicker hides what is below. In between,
pressure and approach go over from one limit to the other.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# A ball of 100 µm on a coated half-space, under a fixed force. Without the coating, and with an
# endless one, Hertz holds: with the modulus of the substrate, and with that of the coating.
substrate, force, radius = asp.Elastic(200e9, 0.3, name="substrate"), 20e-3, 100e-6
coatings = {"four times stiffer": asp.Elastic(800e9, 0.3), "four times softer": asp.Elastic(50e9, 0.3)}
hertz = asp.theories.HertzPoint(asp.solids.contact_modulus(substrate), radius).at_load(force)
thickness = hertz.radius * np.geomspace(0.01, 100, 13)


def largest_pressure(body, width):
    grid = asp.Grid((64, 64), (width / 64, width / 64))
    ball = asp.generate.sphere(grid, radius=radius)
    return asp.solve(asp.ContactProblem(ball, body, boundary=asp.Free()), asp.Force(force)).max_pressure


# %%
# The floor is the thickness up to which the pressure stays within 5 % of the way from its value
# without a coating, the ceiling that from which it is within 5 % of its value for an endless
# coating.
figure, ax = plt.subplots(figsize=(7, 4.5), layout="constrained")
curves, bounds = {}, {}
for name, coating in coatings.items():
    ends = [
        asp.theories.HertzPoint(asp.solids.contact_modulus(body), radius).at_load(force)
        for body in (substrate, coating)
    ]
    width = 2.6 * max(end.radius for end in ends)
    p = np.array([largest_pressure(asp.Layered([asp.Layer(coating, t)], substrate), width) for t in thickness])
    way = (p - ends[0].max_pressure) / (ends[1].max_pressure - ends[0].max_pressure)
    curves[name], bounds[name] = way, np.interp([0.05, 0.95], way, thickness / hertz.radius)
    (line,) = ax.semilogx(thickness / hertz.radius, p / hertz.max_pressure, "o-", label=name)
    for end in ends:
        ax.axhline(end.max_pressure / hertz.max_pressure, color=line.get_color(), ls=":")
    print(f"{name}: floor {bounds[name][0]:.2f} a, ceiling {bounds[name][1]:.1f} a")
ax.set(
    xlabel="coating thickness / contact radius a on the bare substrate",
    ylabel="largest pressure / that without coating",
)
ax.legend()
plt.show()
