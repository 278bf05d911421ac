"""
Check the solver against Hertz
==============================

A ball on a flat has an exact solution (Hertz 1882). Comparing with it is the quickest way to trust
a solver, and to learn how many pixels a contact needs.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# A steel ball of radius 1 mm is pressed on glass with 1 N. The boundary is free, since there is one
# ball and not a lattice.
steel, glass = asp.material("steel"), asp.material("glass")
hertz = asp.theories.HertzPoint(E_star=asp.solids.contact_modulus(steel, glass), radius=1e-3)
exact = hertz.at_load(1.0)


def pressed(points):
    grid = asp.Grid((points, points), (60e-6 / points, 60e-6 / points))
    ball = asp.generate.sphere(grid, radius=1e-3)
    return asp.solve(asp.ContactProblem(ball, steel, counter_body=glass, boundary=asp.Free()), asp.Force(1.0))


result = pressed(128)
for name, ours, theirs in (("radius", np.sqrt(result.contact_area / np.pi), exact.radius),
                           ("approach", result.approach, exact.approach)):  # fmt: skip
    print(f"{name}: {1e6 * ours:.4f} µm, Hertz {1e6 * theirs:.4f} µm")
print(f"largest pressure: {result.max_pressure / 1e9:.4f} GPa, Hertz {exact.max_pressure / 1e9:.4f} GPa")

# %%
# The pressure on the middle row follows Hertz' half ellipse. The largest pressure has an error of
# second order in the pixel size; the area only one of first order, because its rim is known to
# within a part of a pixel.
counts = np.array([16, 32, 64, 128])
results = [*(pressed(int(points)) for points in counts[:-1]), result]
errors = {
    "area": [abs(found.contact_area / exact.area - 1) for found in results],
    "largest pressure": [abs(found.max_pressure / exact.max_pressure - 1) for found in results],
}
figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
x = result.problem.grid.centred_coordinates()[0].ravel()
axes[0].plot(x * 1e6, result.pressure[:, 64] / 1e9, ".", label="128 × 128 points")
axes[0].plot(x * 1e6, hertz.pressure(x, 1.0) / 1e9, "k", lw=1, label="Hertz")
axes[0].set(xlabel="x (µm)", ylabel="pressure (GPa)")
axes[0].legend()
for name, values in errors.items():
    axes[1].loglog(counts, values, "o-", label=name)
axes[1].set_xticks(counts, counts, minor=False)
axes[1].set_xticks([], minor=True)
axes[1].set(xlabel="points along each side", ylabel="relative error")
axes[1].legend()
plt.show()
