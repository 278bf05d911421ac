"""
Stiction when a disk drive starts
=================================

A slider rests on a lubricated disk. Menisci around the contacts pull it down, so that the motor
feels a friction far above the one of sliding: the static friction comes from the wet contact, and
the start of the motion from a block that is held by its suspension.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp
from asperity import dynamics as dyn

# %%
# A disk with a film of perfluoropolyether, pressed with the mean pressure of a slider.
grid = asp.Grid((128, 128), (50e-9, 50e-9))
disk = asp.generate.gaussian(grid, asp.generate.GaussianAutocorrelation(2e-9, 0.6e-6), seed=5)
pressure, dry = asp.MeanPressure(30e3), 0.2
thicknesses = np.array([0.5, 1.0, 1.5, 2.0]) * 1e-9
static = []
for thickness in thicknesses:
    film = asp.LiquidFilm.of(asp.liquid("PFPE"), thickness)
    wet = asp.ContactProblem(disk, asp.material("Ni-P"), film=film, friction=asp.Coulomb(dry, coupled=False))
    static.append(asp.solve(wet, pressure).menisci.static_friction)
    print(f"{thickness * 1e9:.1f} nm: static friction {static[-1]:.2f}, dry {dry}")

# %%
# The suspension (2 kN/m) holds a slider of 10 mg under 30 mN, the disk starts at 1 mm/s. While the
# slider rests the static friction holds; once it slips the menisci break, and the kinetic friction
# is that of the dry contacts.
mass, stiffness, load, speed = 10e-6, 2e3, 30e-3, 1e-3
starts = [
    dyn.BeltOscillator(dyn.StaticKinetic(mu, dry), mass, stiffness, load, speed, damping=0.02).move(0.12)
    for mu in static
]
for thickness, motion in zip(thicknesses, starts, strict=True):
    slips = [event.time for event in motion.events if event.kind == "slip"]
    print(f"{thickness * 1e9:.1f} nm: {len(slips)} slips, the first after {1e3 * slips[0]:.1f} ms")

# %%
# The force on the suspension. A thick film lets the slider stick again and again; the motor must
# overcome the first peak.
figure, axes = plt.subplots(1, 2, figsize=(11, 3.8), layout="constrained")
axes[0].plot(1e9 * thicknesses, static, "o-")
axes[0].set(xlabel="film thickness (nm)", ylabel="static friction / load")
for place in (0, 2, 3):
    label = f"{1e9 * thicknesses[place]:.1f} nm"
    axes[1].plot(1e3 * starts[place].time, starts[place]["spring_force"] / load, linewidth=0.8, label=label)
axes[1].set(xlabel="time (ms)", ylabel="suspension force / load")
axes[1].legend()
plt.show()
