"""Rows of the agreement matrix: theories of wear."""

from __future__ import annotations

import math

import numpy as np
from agreement.matrix import ROUNDING, Agreement, apart, make
from worn_rings import Coating, Rings, worn, worn_sphere

from asperity.theories.wear.running_in import punch_rates

E, R, LOAD, K = 1e11, 3e-3, 10.0, 1e-15
"""Contact modulus (Pa), radius (m), load (N) and wear coefficient (m²/N)."""

DISTANCES = np.array([1.0, 10.0, 100.0])


def energy(_: float) -> float:
    """Dissipated energy, at one coefficient of friction."""
    law = make("dissipated-energy", 4e-14, 0.7)
    archard = make("archard", law.coefficient, LOAD, 1e-6).at_distance(DISTANCES)
    return apart(law.at_energy(0.7 * LOAD * DISTANCES).volume, archard.volume)


def one_material(_: float) -> float:
    """A composite of twice the same."""
    surface, pad = make("worn-composite", K, K, 0.3), make("archard", K, LOAD, 1e-6)
    found = surface.at_pressure(pad.pressure)
    return max(apart(found.pressure_1, pad.pressure), apart(found.rate * 10.0, pad.at_distance(10.0).depth))


def small_scar(radius: float) -> float:
    """Cap over its approximation."""
    cap = make("worn-cap", R).at_scar(radius)
    return apart(cap.approximate, cap.volume)


def worn_pin(_: float) -> float:
    """Scar of a pin, and the cap of that scar."""
    pin = make("pin-on-disk", R, LOAD, 1e-2, K, 0.0).at_distance(DISTANCES)
    cap = make("worn-cap", R).at_scar(pin.scar_radius)
    return max(apart(cap.volume, pin.pin_volume), apart(cap.depth, pin.pin_depth))


def elastic_pin(modulus: float) -> float:
    """Contact radius beside the geometric scar after 1 m, and depth."""
    sphere = make("wearing-sphere", modulus, R, LOAD, K).at_distance(1.0)
    pin = make("pin-on-disk", R, LOAD, 1e-2, K, 0.0).at_distance(1.0)
    return max(apart(sphere.radius, pin.scar_radius), apart(sphere.depth, pin.pin_depth))


def unworn(distance: float) -> float:
    """Contact radius and mean pressure."""
    sphere = make("wearing-sphere", E, R, LOAD, K).at_distance(distance)
    hertz = make("hertz", E, R).at_load(LOAD)
    return max(apart(sphere.radius, hertz.radius), apart(sphere.mean_pressure, hertz.mean_pressure))


def unworn_cylinder(distance: float) -> float:
    """Half-width and mean pressure."""
    cylinder = make("wearing-cylinder", E, R, 2e4, K).at_distance(distance)
    hertz = make("hertz-line", E, R).at_load(2e4)
    return max(apart(cylinder.half_width, hertz.radius), apart(cylinder.mean_pressure, hertz.mean_pressure))


def sphere_on_rings(distance: float) -> float:
    """Depth at the centre."""
    theory = make("wearing-sphere", E, R, LOAD, K).at_distance(distance)
    rings = worn_sphere(E, R, LOAD, Coating(K, K), distance, 1.1 * float(theory.radius), 150)
    return apart(theory.depth, rings.depth[0])


def coated_on_rings(distance: float) -> float:
    """Depth at the centre."""
    theory = make("wearing-coated-sphere", E, R, LOAD, K, 10.0 * K, 1e-6).at_distance(distance)
    law = Coating(K, 10.0 * K, 1e-6)
    rings = worn_sphere(E, R, LOAD, law, distance, 1.1 * float(theory.radius), 150)
    return apart(theory.depth, rings.depth[0])


def equal_coating(distance: float) -> float:
    """Coating and substrate that wear alike: radius and depth."""
    coated = make("wearing-coated-sphere", E, R, LOAD, K, K, 1e-6).at_distance(distance)
    plain = make("wearing-sphere", E, R, LOAD, K).at_distance(distance)
    return max(apart(coated.radius, plain.radius), apart(coated.depth, plain.depth))


def equal_solids(_: float) -> float:
    """Decay of waves from a tenth of the thickness to ten times."""
    waves = 1e-6 * np.geomspace(0.1, 10.0, 5)
    coated = [make("wearing-coated-wave", 2e11, 2e11, 1e-6, wave, K).decay_distance for wave in waves]
    return apart(coated, [make("wearing-wave", 2e11 / 0.91, wave, K).decay_distance for wave in waves])


def thick_coating(thickness: float) -> float:
    """A wave of 10 µm on a coating of the modulus."""
    coated = make("wearing-coated-wave", 4e11, 2e11, thickness, 1e-5, K)
    return apart(coated.decay_distance, make("wearing-wave", 4e11 / 0.91, 1e-5, K).decay_distance)


def thin_coating(thickness: float) -> float:
    """A wave of 10 µm on its base."""
    coated = make("wearing-coated-wave", 4e11, 2e11, thickness, 1e-5, K)
    return apart(coated.decay_distance, make("wearing-wave", 2e11 / 0.91, 1e-5, K).decay_distance)


def punch_on_rings(steps: float) -> float:
    """Pressure at the centre after 1 a/(k E*), in so many implicit steps."""
    rings = Rings(1.0 - (1.0 - np.linspace(0.0, 1.0, 161)) ** 1.5, 1.0)
    found = worn(rings, np.zeros(160), math.pi, Coating(1.0, 1.0), 1.0, 1.0, 1.0 / steps)
    return apart(found.pressure[0], make("wearing-punch", 1.0, 1.0, 1.0).at_distance(1.0).centre)


def spacing(mode: float) -> float:
    """Between this mode and the next."""
    return apart(np.diff(punch_rates(int(mode) + 1))[-1], 0.5 * math.pi)


WEAR = (
    Agreement(
        "dissipated-energy",
        "archard",
        "no threshold",
        energy,
        (),
        ROUNDING,
        "at one coefficient of friction the energy is in proportion to load and distance",
    ),
    Agreement("worn-composite", "archard", "one material", one_material, (), ROUNDING, "both wear at one pressure"),
    Agreement(
        "worn-cap",
        "π a⁴/4R",
        "scar to zero",
        small_scar,
        (1e-3, 1e-4, 1e-5),
        1e-5,
        "the approximation is low by a²/3R²",
    ),
    Agreement("pin-on-disk", "worn-cap", "disk does not wear", worn_pin, (), ROUNDING, "the same cap"),
    Agreement(
        "wearing-sphere",
        "pin-on-disk",
        "modulus to infinity",
        elastic_pin,
        (1e11, 1e12, 1e14),
        1e-3,
        "elastic displacements go as one over the modulus; the cap departs from a paraboloid by (a/R)² = 7e-4",
    ),
    Agreement(
        "wearing-sphere",
        "hertz",
        "distance to zero",
        unworn,
        (1e-2, 1e-4, 1e-6),
        1e-5,
        "the area grows in proportion to the distance",
    ),
    Agreement(
        "wearing-sphere",
        "rings of even pressure",
        "distance to infinity",
        sphere_on_rings,
        (1.0, 10.0, 100.0),
        5e-4,
        "the pressure becomes uniform; 150 rings, backward Euler steps",
    ),
    Agreement(
        "wearing-cylinder",
        "hertz-line",
        "distance to zero",
        unworn_cylinder,
        (1e-2, 1e-4, 1e-6),
        1e-5,
        "the width grows in proportion to the distance",
    ),
    Agreement(
        "wearing-coated-sphere",
        "rings of even pressure",
        "distance to infinity",
        coated_on_rings,
        (10.0, 100.0, 1000.0),
        1e-3,
        "the pressure becomes uniform on core and ring each; 150 rings, backward Euler steps",
    ),
    Agreement(
        "wearing-coated-sphere",
        "wearing-sphere",
        "coefficients alike, distance to infinity",
        equal_coating,
        (1e1, 1e3, 1e5),
        1e-3,
        "elastic displacements are left out of the worn volume after break-through",
    ),
    Agreement("wearing-coated-wave", "wearing-wave", "one solid", equal_solids, (), ROUNDING, "the same half-space"),
    Agreement(
        "wearing-coated-wave",
        "wearing-wave",
        "thickness to infinity",
        thick_coating,
        (2e-6, 1e-5, 2e-5),
        1e-6,
        "the base is felt as exp(-2qh) times a square of qh",
    ),
    Agreement(
        "wearing-coated-wave",
        "wearing-wave",
        "thickness to zero",
        thin_coating,
        (1e-7, 1e-9, 1e-11),
        1e-5,
        "in proportion to the thickness over the wavelength",
    ),
    Agreement(
        "wearing-punch",
        "rings of even pressure",
        "steps to infinity",
        punch_on_rings,
        (10.0, 40.0, 160.0),
        2e-3,
        "backward Euler steps err in proportion to their size; 160 rings",
    ),
    Agreement(
        "wearing-punch",
        "π/2 between rates",
        "mode to infinity",
        spacing,
        (1.0, 10.0, 90.0),
        2e-5,
        "the spacing is π/2 + 0.155/n²",
    ),
)
