"""Layered bodies of tests: from rows of reference tables, and random ones."""

from __future__ import annotations

from hypothesis import strategies as st
from reference_data import Row

import asperity as asp


def elastic(modulus: float | str, nu: float | str) -> asp.Elastic:
    """Material of a table cell."""
    return asp.Elastic(float(modulus), float(nu))


def layered(row: Row) -> asp.Layered:
    """Body of the layer columns of a reference table."""
    layers = [
        asp.Layer(elastic(row[f"E{k}"], row[f"nu{k}"]), float(row[f"h{k}"])) for k in range(1, int(row["n_layers"]) + 1)
    ]
    return asp.Layered(layers, asp.RigidBase() if row["base"] == "rigid" else elastic(row["E_sub"], row["nu_sub"]))


def on_half_space(ratio: float, thickness: float, *, nu: float = 0.3, nu_base: float = 0.3) -> asp.Layered:
    """One layer of modulus ``ratio`` on a base of modulus 1."""
    return asp.Layered([asp.Layer(elastic(ratio, nu), thickness)], elastic(1.0, nu_base))


MODULI = st.floats(-6.0, 6.0).map(lambda exponent: 10.0**exponent)
RATIOS = st.floats(0.0, 0.5)
THICKNESSES = st.floats(-4.0, 2.0).map(lambda exponent: 10.0**exponent)
MATERIALS = st.builds(asp.Elastic, MODULI, RATIOS)


def stacks(
    *,
    most: int = 5,
    moduli: st.SearchStrategy[float] = MODULI,
    thicknesses: st.SearchStrategy[float] = THICKNESSES,
    interfaces: st.SearchStrategy[object] = st.sampled_from([asp.solids.Bonded(), asp.Frictionless()]),
    rigid: bool = True,
) -> st.SearchStrategy[asp.Layered]:
    """Random bodies of up to ``most`` layers."""
    materials = st.builds(asp.Elastic, moduli, RATIOS)
    layer = st.builds(asp.Layer, materials, thicknesses, interfaces)
    base = st.one_of(materials, st.just(asp.RigidBase())) if rigid else materials
    return st.builds(asp.Layered, st.lists(layer, min_size=1, max_size=most), base)
