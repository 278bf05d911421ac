"""Small result files of format 1, written with asperity before result files had groups (see README.md)."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np

import asperity as asp

folder = Path(sys.argv[1])
x = np.arange(12)[:, None] / 12
y = np.arange(8)[None, :] / 8
heights = 1e-9 * (np.cos(2 * np.pi * x) + 0.7 * np.cos(4 * np.pi * y) + 0.2 * np.cos(2 * np.pi * (3 * x + y)))
origin = asp.Surface(heights, 1e-8).origin.continued("three cosines")
surface = asp.Surface(heights, 2e-8, 1e-8, periodic=True, origin=origin)
film = asp.Elastic(2e11, 0.25, asp.Strength(hardness=4e9), name="film")
disk = asp.Layered([asp.Layer(film, 4e-9)], asp.Elastic(1e11, 0.3, name="base"))
problem = asp.ContactProblem(surface, disk, law=asp.Hardness(4e9))

plain = asp.solve(problem, asp.MeanPressure(3e8))
asp.save(plain, folder / "contact.nc", document="# a document")
liquid = asp.LiquidFilm(surface_tension=0.025, thickness=0.3e-9, meniscus_height=0.6e-9, viscosity=0.1)
wet = asp.solve_wet(problem, asp.MeanPressure(1e8), liquid, friction=asp.Friction(0.2, 1e-3))
asp.save_wet(wet, folder / "wet.nc")
path = asp.solve_path(problem, asp.ramps(asp.MeanPressure, [4e8, 0.0], steps=2))
asp.save_path(path, folder / "path.nc")
field = asp.stress(plain, [0.0, 4e-9, 1e-8], friction=0.3, displacement=True)
asp.save_stress(field, folder / "stress.nc")
facts = {
    "contact": {
        name: getattr(plain, name) for name in ("mean_pressure", "area_fraction", "approach", "offset", "n_spots")
    },
    "wet": {
        name: getattr(wet, name)
        for name in ("external_force", "meniscus_force", "static_friction", "n_menisci", "rounds")
    },
    "path": {"max_pressure": [result.max_pressure for result in path.results]},
    "stress": {"von_mises": float(field.von_mises.max()), "depth": field.depth.tolist()},
}
(folder / "facts.json").write_text(json.dumps(facts, indent=1) + "\n", encoding="utf-8")
