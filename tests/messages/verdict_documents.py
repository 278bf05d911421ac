"""Problem documents of every kind, whose verdicts are written down in verdicts.txt: one that is
right, and what is changed in it."""

from __future__ import annotations

from typing import Any

ROUGH: dict[str, Any] = {
    "kind": "rough",
    "points": [32, 32],
    "size": "10 um",
    "seed": 1,
    "spectrum": {"kind": "gaussian", "rms_height": "10 nm", "correlation_length": "2 um"},
}
SPHERE: dict[str, Any] = {"kind": "sphere", "points": [24, 24], "size": "10 um", "radius": "20 um"}
STEEL = "E=200GPa,nu=0.3,H=2GPa,name=hard steel"
PLAIN: dict[str, Any] = {"version": 2, "surface": ROUGH, "body": STEEL, "control": {"mean_pressure": "5 MPa"}}
BALL = PLAIN | {"surface": SPHERE, "boundary": {"kind": "free"}, "control": {"force": "2 mN"}}
SOFT = BALL | {"body": "E=1GPa,nu=0.3,Y=40MPa,name=polymer"}
COATED = PLAIN | {"body": "E=400GPa,nu=0.2,H=20GPa,name=carbide:1um/E=200GPa,nu=0.3,Y=700MPa,name=base steel"}
STICKY = SOFT | {"adhesion": {"work": "50 mJ/m**2", "range": "100 nm"}, "control": {"approach": "20 nm"}}
RUBBER = BALL | {"body": "E=3MPa+297MPa@1ms,nu=0.5", "control": {"force": "20 uN"}}
WET = PLAIN | {"film": {"liquid": "water", "humidity": "60 %"}}
UNFED = PLAIN | {"film": {"liquid": "water", "thickness": "2 nm", "feedback": False}}
SLIDE = PLAIN | {"friction": {"coefficient": 0.3}, "shear": {"shift": "0.4 nm"}}
LEAKING = PLAIN | {"body": "E=100GPa,nu=0.3", "control": {"mean_pressure": "20 MPa"}, "sealing": {}}
WEARS = PLAIN | {
    "body": "E=400GPa,nu=0.2,H=20GPa,name=carbide{kw=1e-7mm^3/Nm}:20nm/"
    "E=200GPa,nu=0.3,H=7GPa,name=base steel{kw=1e-6mm^3/Nm}",
    "wear": {"distance": "0.1 m"},
}
DOWN = {"path": {"mean_pressure": ["20 MPa", "0 MPa"], "steps": 3}}

DOCUMENTS: dict[str, dict[str, Any]] = {
    "elastic, hardness known": PLAIN,
    "elastic, far above the hardness": PLAIN | {"control": {"mean_pressure": "200 MPa"}},
    "elastic, only the yield stress known": SOFT,
    "elastic, above 2.8 Y": SOFT | {"control": {"force": "20 mN"}},
    "strength unknown": PLAIN | {"body": "E=200GPa,nu=0.3"},
    "strength of the counter body unknown": PLAIN | {"counter_body": "E=70GPa,nu=0.2,name=glass"},
    "rubber does not yield": RUBBER | {"body": "E=3MPa,nu=0.5"},
    "both bodies of known strength": PLAIN | {"counter_body": "E=70GPa,nu=0.2,H=5GPa,name=glass"},
    "limited, elastic": PLAIN
    | {"law": {"kind": "hardness", "hardness": "from body"}, "control": {"mean_pressure": "0.1 MPa"}},
    "limited, plastic": PLAIN
    | {"law": {"kind": "hardness", "hardness": "from body"}, "control": {"mean_pressure": "200 MPa"}},
    "limited, path that ends unloaded": PLAIN | {"law": {"kind": "hardness", "hardness": "from body"}, "control": DOWN},
    "elastic path that ends unloaded": PLAIN | {"control": DOWN},
    "path that is loaded again": PLAIN
    | {"control": {"path": {"mean_pressure": ["10 MPa", "1 MPa", "5 MPa"], "steps": 2}}},
    "path to a position and back": BALL | {"control": {"path": {"approach": ["20 nm", "5 nm"], "steps": 2}}},
    "nearly full contact": PLAIN | {"body": "E=1MPa,nu=0.3,name=gel"},
    "load beyond linear elasticity": PLAIN | {"body": "E=10MPa,nu=0.3,name=gel"},
    "steep surface": PLAIN
    | {"surface": ROUGH | {"spectrum": {"kind": "gaussian", "rms_height": "1 um", "correlation_length": "2 um"}}},
    "unresolved asperities": PLAIN
    | {"surface": ROUGH | {"spectrum": {"kind": "gaussian", "rms_height": "10 nm", "correlation_length": "0.4 um"}}},
    "few contact pixels": PLAIN | {"control": {"mean_pressure": "20 kPa"}},
    "contact wide against the period": BALL | {"boundary": {"kind": "periodic"}, "control": {"force": "200 mN"}},
    "unresolved layer": COATED
    | {"body": "E=400GPa,nu=0.2,H=20GPa,name=carbide:5nm/E=200GPa,nu=0.3,Y=700MPa,name=base steel"},
    "unresolved layer with stresses": COATED
    | {"body": "E=400GPa,nu=0.2,H=20GPa,name=carbide:5nm/E=200GPa,nu=0.3,Y=700MPa,name=base steel", "stress": {}},
    "coated, elastic": COATED,
    "coated, limited by the coating": COATED | {"law": {"kind": "hardness", "hardness": "from body"}},
    "stresses, yields below": COATED | {"stress": {}, "control": {"mean_pressure": "50 MPa"}},
    "stresses, holds": COATED | {"stress": {}, "control": {"mean_pressure": "0.05 MPa"}},
    "stresses, strength unknown": PLAIN | {"body": "E=200GPa,nu=0.3", "stress": {}},
    "stresses under friction, tension against a strength": COATED
    | {"stress": {"tensile_strength": "500 MPa"}, "friction": {"coefficient": 0.3}},
    "stresses of a path at its peak": COATED | {"stress": {}, "control": DOWN},
    "stresses of a path at its end": COATED
    | {"stress": {"step": "last"}, "control": {"path": {"mean_pressure": ["20 MPa", "5 MPa"], "steps": 2}}},
    "stress at a step by its number": COATED | {"stress": {"step": 2}, "control": DOWN},
    "adhesion": STICKY,
    "adhesion, separation": STICKY | {"adhesion": STICKY["adhesion"] | {"retract": "60 nm", "steps": 12}},
    "menisci": WET,
    "menisci without feedback": UNFED,
    "menisci that grow": WET | {"meniscus_growth": {"feed": "vapour"}},
    "menisci under friction": WET | {"friction": {"coefficient": 0.3}},
    "stick and slip": SLIDE,
    "gross sliding": SLIDE | {"shear": {"shift": "4 nm"}},
    "creep in a hold": RUBBER | {"viscoelastic": {"hold": "60 ms", "steps": 4}},
    "relaxation at a held position": RUBBER
    | {"control": {"approach": "0.3 um"}, "viscoelastic": {"hold": "60 ms", "steps": 4}},
    "sliding over rubber": RUBBER
    | {"body": "rigid", "counter_body": "E=3MPa+3MPa@0.1s,nu=0.5", "hysteresis": {"speed": "20 um/s"}},
    "rolling": BALL
    | {
        "surface": SPHERE | {"size": "1.6 mm", "radius": "50 mm"},
        "counter_body": STEEL,
        "control": {"force": "500 N"},
        "friction": {"coefficient": 0.3},
        "rolling": {"longitudinal": "0.1 %", "spin": "0.3 rad/m"},
    },
    "current and heat through a plated joint": PLAIN
    | {
        "body": "gold:200nm/nickel",
        "counter_body": "copper",
        "law": {"kind": "hardness", "hardness": "1 GPa"},
        "conductance": {"flow": "both", "voltage": "150 mV", "film_resistance": "1e-13 ohm*m^2"},
    },
    "heat through a joint loaded and unloaded": PLAIN | {"body": "nickel", "control": DOWN, "conductance": {}},
    "a sliding contact that is allowed to get hot": PLAIN
    | {
        "body": "mild steel",
        "counter_body": "zirconia",
        "law": {"kind": "hardness", "hardness": "1 GPa"},
        "heating": {"speed": "1 m/s", "friction": 0.3, "allowed": "500 K"},
    },
    "a sliding contact too hot on a rigid body": PLAIN
    | {
        "body": "mild steel",
        "control": DOWN,
        "heating": {"speed": "100 m/s", "friction": 0.5, "allowed": "294 K", "moving": "body", "step": "last"},
    },
    "a sliding contact beyond the limits": PLAIN
    | {"body": "mild steel", "heating": {"speed": "300 m/s", "friction": 0.5, "moving": "body"}},
    "what decides a coated contact": PLAIN
    | {"body": "E=300GPa,nu=0.2,Y=8GPa,name=film:1um/E=200GPa,nu=0.3,Y=1GPa,name=base", "sensitivities": {}},
    "a contact whose heights are hardly known": PLAIN
    | {"body": "E=200GPa,nu=0.3,Y=1GPa,name=base", "uncertainty": {"height_scale": 0.5, "moduli": 0.05}},
    "a coating that is worn through": WEARS | {"wear": {"distance": "4 m", "until_bare": True}},
    "a coating that lasts": WEARS | {"wear": {"distance": "0.1 m"}},
    "a base that stops yielding as it wears": WEARS
    | {"stress": {}, "control": {"mean_pressure": "200 MPa"}, "wear": {"distance": "0.1 m"}},
    "a wheel that wears as it rolls": BALL
    | {
        "body": "mild steel{kw=1e-7mm^3/Nm}",
        "friction": {"coefficient": 0.3},
        "rolling": {"longitudinal": 0.001},
        "wear": {"distance": "1 m", "track_body": "1 mm", "allowed_depth": "1 um"},
    },
    "a surface worn too deep": WEARS | {"wear": {"distance": "0.1 m", "allowed_depth": "1 nm", "wears": "body"}},
    "a disk that wears as a track": WEARS
    | {
        "counter_body": "mild steel{kw=1e-4mm^3/Nm}",
        "wear": {"distance": "0.1 m", "track_counter_body": "60 mm", "allowed_depth": "1 um"},
    },
    "surfaces that fret": WEARS
    | {
        "body": "mild steel{kw=1e-5mm^3/Nm}",
        "friction": {"coefficient": 0.3},
        "wear": {"cycles": 10, "shift": "20 nm", "quarter": 2},
    },
    "a seal that leaks": LEAKING,
    "a seal that is tight enough": LEAKING | {"sealing": {"allowed_rate": "1 mm^3/s"}},
    "a seal that is not tight": LEAKING | {"sealing": {"fluid": "helium", "allowed_throughput": "1e-12 mbar*l/s"}},
    "a seal that is tight within the pixels only": LEAKING
    | {"control": {"mean_pressure": "200 MPa"}, "sealing": {"allowed_rate": "4.05e-10 mm^3/s"}},
    "a seal with a throat of a pixel": LEAKING | {"control": {"mean_pressure": "320 MPa"}},
    "a seal that closes": LEAKING | {"control": {"mean_pressure": "1 GPa"}, "sealing": {"allowed_rate": "1 mm^3/s"}},
    "a seal loaded until it closes": LEAKING
    | {"control": {"path": {"mean_pressure": ["20 MPa", "100 MPa", "1 GPa"], "steps": 1}}},
    "flow factors": PLAIN | {"flow_factors": {"points": 3, "realisations": 2}},
    "plastic flow in the volume": SOFT | {"plastic_flow": {"steps": 2, "cells": 4}, "control": {"force": "20 mN"}},
    "a load at which it becomes plastic": PLAIN
    | {"law": {"kind": "hardness", "hardness": "from body"}, "plastic_load": {}},
    "indentation beside the contact": SOFT
    | {"indentation": {"depth": "200 nm", "radius": "10 um", "steps": 4, "unloading_steps": 6, "elements": 6}},
    "vibration": PLAIN
    | {
        "body": "E=1GPa,nu=0.3",
        "control": {"mean_pressure": "1 MPa"},
        "friction": {"coefficient": 0.3, "speed": "1 mm/s"},
        "dynamics": {"mass": "1 kg", "base": "10 mm x 10 mm", "height": "5 mm", "stiffness": "200 N/mm"},
    },
    "not converged": PLAIN | {"solver": {"max_iterations": 1}},
    "path not converged": PLAIN | {"control": DOWN, "solver": {"max_iterations": 1}},
    "line contact": BALL
    | {
        "surface": {"kind": "cylinder", "points": [64, 1], "size": "10 um x 1 m", "radius": "20 um"},
        "boundary": {"kind": "line"},
        "control": {"force": "10 kN"},
    },
}
"""By what they are."""
