"""Layered bodies of the reference tables, and random ones."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st
from reference_data import Row

import asperity as asp
from asperity.physics.stress.regions import Plane, planes


def body_of(row: Row) -> asp.Layered:
    """Body of a row."""
    layers = [
        asp.Layer(asp.Elastic(row[f"E{k}"], row[f"nu{k}"]), row[f"h{k}"]) for k in range(1, int(row["n_layers"]) + 1)
    ]
    return asp.Layered(layers, asp.RigidBase() if row["base"] == "rigid" else asp.Elastic(row["E_sub"], row["nu_sub"]))


def plane_of(row: Row, body: asp.Layered, depth: float) -> Plane:
    """Plane at ``depth`` in the region that the row names (1 is the outermost)."""
    (plane,) = (p for p in planes(body, [depth]) if p.region.index == int(row["region"]) - 1)
    return plane


@st.composite
def layered_bodies(draw: st.DrawFn, *, contrast: float = 1e3) -> asp.Layered:
    """One to four layers of moduli within ``contrast`` of 1, any Poisson's ratio, thicknesses 0.05
    to 3, any base."""
    modulus = st.floats(-1.0, 1.0).map(lambda v: float(contrast**v))
    solid = st.builds(asp.Elastic, modulus, st.sampled_from([0.0, 0.1, 0.3, 0.45, 0.5]))
    layer = st.builds(asp.Layer, solid, st.floats(np.log(0.05), np.log(3.0)).map(lambda v: float(np.exp(v))))
    layers = draw(st.lists(layer, min_size=1, max_size=4))
    return asp.Layered(layers, draw(st.one_of(solid, st.just(asp.RigidBase()))))
