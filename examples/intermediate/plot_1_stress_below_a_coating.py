"""
Stress below a coating
======================

A hard coating carries the contact, but what breaks is often the interface below it. The stresses
inside coating and substrate follow from the pressures of the solved contact, exactly and plane by
plane.
"""

import matplotlib.pyplot as plt

import asperity as asp

# %%
# A rough slider, 200 nm of titanium nitride on steel. Friction 0.3 drags the surface along +x.
spectrum = asp.generate.GaussianAutocorrelation(3e-9, 0.8e-6)
surface = asp.generate.gaussian(asp.Grid((128, 128), (25e-9, 25e-9)), spectrum, seed=4)
coated = asp.Layered([asp.Layer(asp.material("TiN"), 200e-9)], base=asp.material("bearing steel"))
result = asp.solve(asp.ContactProblem(surface, coated), asp.MeanPressure(200e6))

# %%
# A vertical section through the highest pressure. The von Mises stress jumps at the interface,
# where a stiff solid is bent with a compliant one; the shear stress does not jump, and is what the
# bond has to hold.
depths = asp.stresses.depths_through(coated, deepest=0.8e-6, per_region=12)
section = asp.stress(result, depths, on=asp.stresses.Section(y="pressure"), friction=0.3)
figure, axes = plt.subplots(2, 1, figsize=(9, 5.5), layout="constrained")
section.plot("von_mises", axes[0])
section.plot("shear_xz", axes[1])

# %%
# Shear and tension at the interface itself, over its whole area, decide whether the coating stays
# on.
field = asp.stress(result, [0.0, 200e-9, 1e-6], friction=0.3)
interface = field.interfaces[0]
print(
    f"interface: largest shear {interface.shear.max() / 1e9:.2f} GPa, largest pull {interface.peel.max() / 1e9:.3f} GPa"
)
for name in ("TiN", "bearing steel"):
    print(f"{name}: von Mises stress up to {field.within(name).von_mises.max() / 1e9:.2f} GPa")

# %%
# Equilibrium is a check that needs no theory: the mean normal stress of every plane is the nominal
# pressure, and its mean shear stress the friction. Both are negative: tension is positive, and the
# surface faces -z.
for number, plane in enumerate(field.planes):
    normal, shear = field.normal_zz[number].mean(), field.shear_xz[number].mean()
    print(f"{1e9 * plane.depth:5.0f} nm: mean normal stress {normal / 1e6:.3f} MPa, shear stress {shear / 1e6:.3f} MPa")
plt.show()
