"""Bad input of every kind, whose messages are written down in messages.txt."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from cli.conftest import BODY, LOAD
from contact_cases import elastic, rough
from study_cases import plan

import asperity as asp

SEAL: dict[str, Any] = {
    "version": 2,
    "surface": {"kind": "bisinusoid", "points": [16, 16], "size": "1 um", "amplitude": "1 nm", "wavelength": "1 um"},
    "body": "E=100GPa,nu=0.3",
    "control": {"mean_pressure": "1 MPa"},
    "sealing": {},
}
"""A contact that leaks."""

WEARS = {key: value for key, value in SEAL.items() if key != "sealing"} | {"wear": {"distance": "1 m"}}
"""A contact that is to wear, but has no coefficient."""

ROLLS = WEARS | {"friction": {"coefficient": 0.3}, "rolling": {"longitudinal": 0.01}}
"""The same, as it rolls."""

FLOWS = ("--body", "E=200GPa,nu=0.3,Y=400MPa")
RUBBER = ("--body", "E=1GPa+1GPa@1s,nu=0.4,name=rubber")
ON_RUBBER = ("--body", "rigid", "--counter", RUBBER[1], *LOAD, "--sliding-speed", "1mm/s")
STRESS: tuple[tuple[str, ...], ...] = (
    ("--friction", "-0.1"),
    ("--direction", "90"),
    ("--depths", "1nm,5"),
    ("--depths", "1nm,"),
    ("--section", "middle"),
    ("--section", "x=max,y=max"),
    ("--section", "y=5"),
    ("--section", "y=99um"),
    ("--profile", "x=1kg"),
    ("--deepest", "0nm"),
    ("--criterion", "hope"),
    ("--tensile-strength", "1"),
    ("--stress-in", "counter"),
    ("--stress-in", "air"),
    ("--stress-precision", "half"),
)
"""Options of stresses."""

PREPARATION: tuple[tuple[str, ...], ...] = (
    ("--short-cutoff", "1"),
    ("--short-cutoff", "2nm"),
    ("--tip-radius", "-1nm"),
    ("--remove-tip", "1m"),
    ("--remove-tip", "10nm", "--tip-opening", "190deg"),
    ("--tip-opening", "40deg"),
    ("--mask-uncertain",),
    ("--remove-tip", "10nm", "--estimate-tip", "5x5"),
    ("--estimate-tip", "4x5"),
    ("--level", "21"),
    ("--line-correct", "z"),
    ("--despike", "0"),
    ("--counter-shift", "1um,0um"),
    ("--common-grid",),
)
"""Options of the steps between the file and the contact."""

CONTACT: tuple[tuple[str, ...], ...] = (
    (*BODY, "--pressure", "50"),
    (*BODY, "--pressure", "50 nm"),
    (*BODY, "--pressure", "50 kPq"),
    (*BODY, "--pressure", "0 kPa"),
    (
        *BODY,
        "--load=-1mN",
    ),
    (*BODY, "--approach", "-3nm"),
    (*BODY, "--mean-gap", "1 Pa"),
    BODY,
    (*BODY, *LOAD, "--load", "1mN"),
    (*BODY, "--path", "0,0"),
    (*BODY, "--path", "1MPa,2"),
    (*BODY, "--path", "1MPa,2nm"),
    (*BODY, "--path", "1MPa,1MPa"),
    (*BODY, "--path", "1MPa", "--path-steps", "0"),
    (*BODY, *LOAD, "--path-steps", "3"),
    ("--body", "E=1GPa,nu=0.3", *LOAD, "--hardness", "effective"),
    (*BODY, *LOAD, "--plastic-load"),
    (*BODY, *LOAD, "--shift", "5nm"),
    (*BODY, *LOAD, "--friction", "0.3", "--shift", "5"),
    (*BODY, *LOAD, "--friction", "0.3", "--shift", "5nm", "--tangential-force", "1mN"),
    (*BODY, *LOAD, "--friction", "0.3", "--cycles", "2"),
    (*BODY, *LOAD, "--friction", "0.3", "--twist", "1deg"),
    (*BODY, *LOAD, "--friction", "0.3", "--step", "5deg,1nm"),
    (*BODY, *LOAD, "--friction", "0.3", "--tangential-force", "1N"),
    (*BODY, *LOAD, "--friction=-0.3", "--shift", "5nm"),
    (*BODY, *LOAD, "--friction-law", "tresca", "--shift", "5nm"),
    (*BODY, *LOAD, "--friction", "0.3", "--friction-strength", "1MPa"),
    (*BODY, *LOAD, "--hold", "1s"),
    (*RUBBER, *LOAD, "--hold", "1m"),
    (*RUBBER, *LOAD, "--ramp", "1s,2s"),
    (*RUBBER, *LOAD, "--repeat", "2"),
    (*RUBBER, *LOAD, "--temperature", "310K"),
    (*RUBBER, *LOAD, "--oscillation-amplitude", "1nm"),
    (*RUBBER, *LOAD, "--slowest", "1mm/s"),
    (*RUBBER, *LOAD, "--sliding-speed", "1mm/s"),
    (*RUBBER, *LOAD, "--sliding-distance", "1mm"),
    (*ON_RUBBER, "--steps-per-pixel", "3"),
    (*ON_RUBBER, "--sliding-distance", "1nm"),
    (*ON_RUBBER, "--sliding-distance", "1km"),
    (*ON_RUBBER, "--slowest", "1m/s", "--fastest", "1mm/s"),
    (*ON_RUBBER, "--speed-points", "3"),
    (*ON_RUBBER, "--adhesion", "50mJ/m**2", "--adhesion-law", "jkr"),
    ("--body", "moduli=none.csv,nu=0.3", *LOAD),
    ("--body", "E=1GPa,power=0.1,shortest=1e-300s,longest=1e300s,nu=0.3", *LOAD),
    (*BODY, *LOAD, "--tolerance", "2"),
    (*BODY, *LOAD, "--load", "1mN"),
    (*BODY, "--pressure", "6GPa", "--hardness", "body"),
    (*BODY, "--load", "1N", "--hardness", "5GPa"),
    LOAD,
    ("--body", "E=-1GPa,nu=0.3", *LOAD),
    ("--body", "E=1GPa,nu=0.6", *LOAD),
    ("--body", "E=1GPa,nu=-1", *LOAD),
    ("--body", "E=1GPa,nu=soft", *LOAD),
    ("--body", "E=1GPa", *LOAD),
    ("--body", "E=1GPa,nu=0.3,Q=2", *LOAD),
    ("--body", "unobtainium", *LOAD),
    ("--body", "rigid", *LOAD),
    (*BODY, *LOAD, "--hardness", "5"),
    (*BODY, *LOAD, "--hardness", "layers"),
    ("--body", "E=1GPa,nu=0.3", *LOAD, "--hardness", "body"),
    (*BODY, *LOAD, "--boundary", "open"),
    (*BODY, *LOAD, "--boundary", "line"),
    ("--body", "DLC:5/steel", *LOAD),
    ("--body", "DLC:5nm/CrX/steel", *LOAD),
    ("--body", "DLC:5nm/steel/Cr:2nm", *LOAD),
    ("--body", "DLC:5nm", *LOAD),
    ("--body", "DLC:5kg/steel", *LOAD),
    ("--body", "DLC:5nm/stel", *LOAD),
    (*BODY, "--counter", "DLC:-5nm/steel", *LOAD),
    (*BODY, "--counter-body", "DLC/steel", *LOAD),
    ("--body", "E=1GPa,nu=0.7:1nm/rigid", *LOAD),
    ("--body", "DLC:5nm/E=1GPa", *LOAD),
    ("--body", "PDMS:1um/steel", *LOAD, "--hardness", "body"),
    (*BODY, *LOAD, "--precision", "half"),
    (*BODY, *LOAD, "--solver", "magic"),
    (*BODY, *LOAD, "--tolerance", "0"),
    (*BODY, *LOAD, "--threads", "0"),
    (*BODY, *LOAD, "--level", "cubic"),
    (*BODY, *LOAD, "--fill", "magic"),
    (*BODY, *LOAD, "--crop", "1um"),
    (*BODY, *LOAD, "--crop", "2um:1um,"),
    (*BODY, *LOAD, "--crop", "0:1,"),
    (*BODY, *LOAD, "--crop", "0um:99um,"),
    (*BODY, *LOAD, "--mask", "circle 1um,1um,1um"),
    (*BODY, *LOAD, "--mask", "rectangle 2um:1um"),
    (*BODY, *LOAD, "--mask", "ellipse 1um,1um,1um,0um"),
    (*BODY, *LOAD, "--mask", "rectangle 9um:10um"),
    (*BODY, *LOAD, "--mask", "rectangle 0um:8um"),
    (*BODY, *LOAD, "--mask-invert"),
    (*BODY, *LOAD, "--resample", "many"),
    (*BODY, *LOAD, "--humidity", "60"),
    (*BODY, *LOAD, "--humidity", "60%"),
    (*BODY, "--pressure", "50mpa"),
    (*BODY, *LOAD, "--taper", "0.9"),
    (*BODY, *LOAD, "--mirror", "x"),
    (*BODY, *LOAD, "--materials-file", "none.toml", "--body", "DLC"),
    ("--body", "DLC:5nm~/steel", *LOAD, "--friction", "0.1"),
    ("--body", "DLC:5nm/rigid", *LOAD, "--depths", "1um"),
    ("--body", "steel", *LOAD, "--plastic"),
    ("--body", "steel", *LOAD, "--indent", "1nm", "--indenter-radius", "1um"),
    (*FLOWS, *LOAD, "--plastic", "--hardness", "1GPa"),
    (*FLOWS, *LOAD, "--indent", "1um", "--indenter-radius", "1um"),
    (*FLOWS, *LOAD, "--indent", "1nm", "--indent-in", "counter_body"),
    (*FLOWS, *LOAD, "--indenter-radius", "1um"),
    (*FLOWS, *LOAD, "--passes", "2"),
    (*FLOWS, *LOAD, "--pass-peak", "1GPa"),
    (*FLOWS, *LOAD, "--passes", "2", "--pass-peak", "1GPa", "--pass-in", "counter_body"),
    (*FLOWS, *LOAD, "--passes", "2", "--pass-peak", "500GPa", "--pass-radius", "1um"),
    (*FLOWS, *LOAD, "--passes", "2", "--pass-peak", "1GPa", "--pass-radius", "1um", "--pass-track", "1mm"),
    ("--body", "steel", *LOAD, "--passes", "2", "--pass-peak", "1GPa"),
    *((*BODY, *LOAD, *options) for options in (*STRESS, *PREPARATION)),
    (*BODY, *LOAD, "--boundary", "free", "--with", "deciding_waves"),
    ("--body", "DLC:5nm/steel", *LOAD, "--periodise", "--with", "deciding_waves"),
)
"""Options of ``asperity contact`` on a matrix of stated size."""

COMPARE: tuple[tuple[str, ...], ...] = (
    (*BODY, "--pressures", "5"),
    (*BODY, "--pressures", "1MPa..2nm"),
    (*BODY, "--pressures", "1MPa,0Pa"),
    (*BODY, "--loads", "5"),
    (*BODY, "--pressures", "1MPa..2MPa", "--loads", "1"),
    (*BODY, "--work", "5 Pa"),
    (*BODY, "--from", "a.toml"),
    (*BODY, "--line", "y=middle", "--pressures", "1MPa"),
)
"""Options of ``asperity compare`` on a matrix of stated size."""

FILM: tuple[tuple[str, ...], ...] = (
    ("--film", "2nm"),
    ("--liquid", "water"),
    ("--liquid", "water", "--humidity", "120%"),
    ("--liquid", "watr", "--film", "1nm"),
    ("--liquid", "PFPE", "--humidity", "50%"),
    ("--surface-tension", "30mN/m", "--humidity", "50%"),
    ("--liquid", "water", "--humidity", "50%", "--meniscus-height", "1nm"),
    ("--liquid", "water", "--film", "1nm", "--contact-angle", "1deg,2deg,3deg"),
    ("--liquid", "water", "--film", "1nm", "--contact-angle", "120deg,80deg"),
    ("--liquid", "PFPE", "--film", "1nm", "--speed", "1mm/s"),
    ("--growth-feed", "vapour"),
    ("--liquid", "water", "--film", "1nm", "--growth-feed", "vapour"),
    ("--surface-tension", "30mN/m", "--film", "1nm", "--growth-feed", "flooded"),
)
"""Options of a liquid film."""

_HERTZ = ("hertz", "--E-star", "115GPa", "--radius")
THEORY: tuple[tuple[str, ...], ...] = (
    (),
    ("gw",),
    ("hertz", "--radius", "5mm", "--load", "1N"),
    (*_HERTZ, "5s", "--load", "1N"),
    (*_HERTZ, "5 furlongz", "--load", "1N"),
    (*_HERTZ, "5mm", "--load", "-1N"),
    (*_HERTZ, "5mm", "--load", "1N..2N..3N"),
    (*_HERTZ, "5mm"),
    (*_HERTZ, "5mm", "--load", "1N", "--approach", "1nm"),
    ("nayak", "--m0", "1nm**2", "--m2", "1", "--m4", "1um**-2"),
    ("mccool", "--surface", "rough.txt", "--body", "DLC", "--m0", "1nm**2"),
)
"""Words after ``asperity theory``."""

SCANNED = ("rough", "--seed", "3", "--spectrum", "scans")
GENERATE: tuple[tuple[str, ...], ...] = (
    ("sphere", "--radius", "-3um"),
    ("sphere", "--radius", "1um", "--exact"),
    ("rough", "--seed", "3", "--spectrum", "white"),
    ("rough", "--seed", "3", "--spectrum", "exponential", "--correlation-length", "1um"),
    ("dimples", "--pitch", "4um", "--radius", "1um", "--depth", "1nm"),
    ("from-line-scan", "--seed", "3", "--file", "rough.txt", "--height-unit", "nm", "--lateral-unit", "nm"),
    (*SCANNED,),
    (*SCANNED, "--scans", "none.txt"),
    (*SCANNED, "--scans", "rough.txt,size=8um x 6um,height_unit=nm"),
    (*SCANNED, "--scans", "rough.txt,size=8um x 6um,height_unit=K"),
    (*SCANNED, "--scans", "line_scan.txt,lateral_unit=um,height_unit=nm,axis=y"),
    (*SCANNED, "--scans", "line_scan.txt"),
)
"""Words after ``asperity generate``, before the grid and the file."""

INFO: tuple[tuple[str, ...], ...] = (
    (),
    ("--size", "1e-299um"),
    ("--size", "8um"),
    ("--size", "8"),
    ("--size", "8um", "--height-unit", "kg"),
    ("--size", "8um", "--height-unit", "nm", "--channel", "Phase"),
    ("--size", "8um", "--height-unit", "nm", "--z-scale", "5nm"),
    ("--size", "8um x 6um", "--height-unit", "nm", "--report", "page.pdf"),
    ("--size", "8um x 6um", "--height-unit", "nm", "--plot", "map.jpg"),
    ("--size", "8um x 6um", "--height-unit", "nm", "--level", "cubic"),
    ("--size", "8um x 6um", "--height-unit", "nm", "--lambda-c", "1mm"),
    ("--size", "8um x 6um", "--height-unit", "nm", "--one-surface", "--full"),
    ("--size", "8um x 6um", "--height-unit", "nm", "--one-surface"),
    ("--size", "8um x 6um", "--height-unit", "nm", "--one-surface", "--pressure", "1MPa"),
    ("--size", "8um x 6um", "--height-unit", "nm", "--pressure", "1MPa"),
)
"""Options of ``asperity info`` on a matrix that states neither size nor unit."""

FILES: Mapping[str, bytes | None] = {
    "none.txt": None,
    "empty.txt": b"",
    "noise.di": b"\x00\x01\x02 not a topography \xff" * 40,
    "cut.mdt": b"\x01\xb0\x93\xff" + bytes(29),
    "noise.xyzzy": b"certainly not a topography" * 8,
    "ragged.txt": b"1 2 3\n4 5\n",
    "line_scan.txt": b"0.0 1\n0.5 2\n1.0 1\n1.5 0\n",
    "line_of_heights.txt": b"1\n2\n1\n0\n",
    "words_in_a_row.csv": b"1;2;3\n4;hole;6\n7;8;9\n",
    "commas_of_two_meanings.csv": b"0,123,0,456\n0,234,0,067\n0,345,0,678\n",
    "head_of_another_format.csv": b"DSAA\n4,3\n1,2,3,4\n5,6,7,9\n9,8,7,6\n5,4,3,1\n",
    "heads_of_columns.csv": b"a,b,c,d,e\n1,2,3,4\n5,6,7,9\n9,8,7,6\n5,4,3,1\n",
    "coordinates.csv": b"0,.5,1,1.5,2\n.5,5,1,3,7\n1,4,1,5,9\n1.5,2,6,5,3\n2,5,8,9,7\n",
    "coordinates_of_unknown_unit.csv": b"x (um),y (nm),z (nm)\n0,0,1\n0,1,2\n1,0,3\n1,1,5\n",
    "infinite.txt": b"1 2 3\n4 inf 6\n7 8 9\n",
    "all_nan.txt": b"nan nan\nnan nan\n",
    "one.txt": b"5\n",
    "noise_twice_a_square.di": bytes(range(256)) * 8,
    "one.npy": b"\x93NUMPY\x01\x00 truncated",
}
"""Contents of files that are no surfaces; None for a file that does not exist."""


def _problem(**keys: object) -> asp.ContactProblem:
    arguments = {"surface": rough((4, 4)), "body": elastic(1.0)} | keys
    return asp.ContactProblem(**arguments)  # type: ignore[arg-type]


def _solved() -> asp.ContactResult:
    return asp.solve(_problem(), asp.MeanPressure(0.1))


def _holed() -> asp.Surface:
    heights = rough((6, 6)).heights.copy()
    heights[2, 3] = np.nan
    return asp.Surface(heights, 1.0)


GRID = asp.Grid((16, 16), (1.0, 1.0))


def _spectrum(shortest: float) -> asp.generate.SelfAffine:
    return asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(1.0), hurst=0.8, rolloff_wavelength=8.0, shortest_wavelength=shortest
    )


SAMPLES = {"seed": 1, "samples": 3, "random": [{"path": "surface.seed", "distribution": "seed"}]}


def _asked(name: str, *, radius: float, E_star: float, **values: float) -> object:
    return asp.theories.evaluate(asp.theories.theory(name)(E_star, radius), **values)


def _read(name: str, content: str, **scales: object) -> asp.Surface:
    Path(name).write_text(content)
    return asp.read(name, height_unit="nm", **scales)  # type: ignore[arg-type]


def _materials(content: str) -> object:
    Path("own.toml").write_text(content)
    return asp.solids.materials(Path("own.toml"))


def _axis(path: str, values: list[object]) -> dict[str, object]:
    return {"path": path, "values": values}


def _scan(points: int = 400, **more: Any) -> asp.Profile:
    return asp.Profile(1e-9 * np.random.default_rng(1).standard_normal(points), 1e-6, **more)


def _two_columns(**units: Any) -> object:
    Path("trace.txt").write_text("0 1\n1 2\n2 4\n")
    return asp.read("trace.txt", **units)


def _relaxation(time: list[float], modulus: list[float]) -> object:
    return asp.viscoelasticity.fitted_relaxation(time, modulus, poisson_ratio=0.4)


def _creep(time: list[float], compliance: list[float], *, fluid: bool = False) -> object:
    return asp.viscoelasticity.fitted_creep(time, compliance, poisson_ratio=0.4, fluid=fluid)


def _coated_joint() -> asp.ContactProblem:
    coated = asp.Layered([asp.Layer(asp.material("DLC"), 1e-8)], asp.material("nickel"))
    return asp.ContactProblem(rough((16, 16)), coated, counter_body=asp.material("copper"))


def _hot_joint(boundary: asp.Periodic | asp.Free = asp.Periodic()) -> asp.ContactProblem:
    zirconia, copper = asp.material("zirconia"), asp.material("copper")
    return asp.ContactProblem(rough((16, 16)), zirconia, counter_body=copper, boundary=boundary)


def _source(source: asp.theories.EllipticSource | asp.theories.BandSource, thickness: float = 0.0):
    layers = (asp.theories.HeatLayer(1.0, 1e-6, thickness),) if thickness else ()
    return asp.theories.MovingSource(source, asp.theories.HeatConductor(46.0, 1.2e-5, layers), 1.0)


def _pressed(inlet: float) -> asp.ContactProblem:
    fluid = asp.sealing.FluidPressure(asp.sealing.ViscousLiquid(1e-3), inlet)
    return asp.ContactProblem(rough((16, 16)), asp.material("nickel"), fluid_pressure=fluid)


CALLS: Mapping[str, Callable[[], object]] = {
    "MeanPressure(0.0)": lambda: asp.MeanPressure(0.0),
    "MeanPressure('50 MPa')": lambda: asp.MeanPressure("50 MPa"),  # type: ignore[arg-type]
    "Coulomb('0.3')": lambda: asp.Coulomb("0.3"),  # type: ignore[arg-type]
    "stress(result, 5e-9)": lambda: asp.stress(_solved(), 5e-9),  # type: ignore[arg-type]
    "stress(problem, [0.0])": lambda: asp.stress(_problem(), [0.0]),  # type: ignore[arg-type]
    "stress(..., friction='0.3')": lambda: asp.stress(_solved(), [0.0], friction="0.3"),  # type: ignore[arg-type]
    "generate.gaussian((256, 256), ...)": lambda: asp.generate.gaussian((256, 256), None, seed=1),  # type: ignore[arg-type]
    "Force(-1.0)": lambda: asp.Force(-1.0),
    "Approach(nan)": lambda: asp.Approach(np.nan),
    "MeanGap(inf)": lambda: asp.MeanGap(np.inf),
    "Elastic(0.0, 0.3)": lambda: asp.Elastic(0.0, 0.3),
    "Elastic(1e9, 0.51)": lambda: asp.Elastic(1e9, 0.51),
    "Elastic(1e9, -1.0)": lambda: asp.Elastic(1e9, -1.0),
    "Hardness('1 GPa')": lambda: asp.Hardness("1 GPa"),  # type: ignore[arg-type]
    "Hardness(True)": lambda: asp.Hardness(True),
    "Grid((0, 4), (1.0, 1.0))": lambda: asp.Grid((0, 4), (1.0, 1.0)),
    "Grid((4, 4), (1.0, 0.0))": lambda: asp.Grid((4, 4), (1.0, 0.0)),
    "Surface of one dimension": lambda: asp.Surface(np.zeros(4), 1.0),
    "Surface of text": lambda: asp.Surface(np.array([["a", "b"]]), 1.0),
    "Surface of no width": lambda: asp.Surface(np.zeros((4, 4)), 0.0),
    "material('unobtainium')": lambda: asp.material("unobtainium"),
    "liquid('wter')": lambda: asp.liquid("wter"),
    "two rigid bodies": lambda: _problem(body=asp.Rigid()),
    "a surface with missing points": lambda: _problem(surface=_holed()),
    "a counter surface with missing points": lambda: _problem(surface=rough((6, 6)), counter_surface=_holed()),
    "surfaces on two grids": lambda: _problem(counter_surface=rough((4, 5))),
    "an array as surface": lambda: _problem(surface=np.zeros((4, 4))),
    "text as body": lambda: _problem(body="steel"),
    "text as boundary": lambda: _problem(boundary="periodic"),
    "text as law": lambda: _problem(law="hard wall"),
    "no counter body": lambda: _problem(counter_body=None),
    "a hardness map of another shape": lambda: _problem(law=asp.Hardness(np.ones((3, 4)))),
    "a number as control": lambda: asp.solve(_problem(), 50e3),  # type: ignore[arg-type]
    "text as control": lambda: asp.solve(_problem(), "50 kPa"),  # type: ignore[arg-type]
    "a keyword of another function": lambda: asp.solve(_problem(), asp.MeanPressure(1.0), threads=2),  # type: ignore[call-overload]
    "a solver by its name": lambda: asp.solve(_problem(), asp.MeanPressure(0.1), solver="nnls"),  # type: ignore[arg-type]
    "an unknown choice on failure": lambda: asp.solve(_problem(), asp.MeanPressure(0.1), on_failure="ignore"),  # type: ignore[call-overload]
    "an operator of another grid": lambda: asp.solve(
        _problem(),
        asp.MeanPressure(0.1),
        operator=asp.solvers.prepare_operator(_problem().compliance, asp.Grid((8, 8), (1.0, 1.0)), asp.Periodic()),
    ),
    "a pressure above the hardness": lambda: asp.solve(_problem(law=asp.Hardness(1.0)), asp.MeanPressure(2.0)),
    "tolerance -1": lambda: asp.solvers.ActiveSet(tolerance=-1.0),
    "no iterations": lambda: asp.solvers.ActiveSet(max_iterations=0),
    "a history of nothing": lambda: asp.History([]),
    "a history of a control": lambda: asp.History(asp.MeanPressure(0.1)),  # type: ignore[arg-type]
    "a history of a number": lambda: asp.History(0.1),  # type: ignore[arg-type]
    "a number in a history": lambda: asp.History([asp.MeanPressure(0.1), 0.2]),  # type: ignore[list-item]
    "ramps to nowhere": lambda: asp.contact.ramps(asp.Force, [0.0]),
    "a ramp that stands": lambda: asp.contact.ramps(asp.Force, [1.0, 1.0]),
    "a ramp of no control": lambda: asp.contact.ramps("force", [1.0]),  # type: ignore[arg-type]
    "two iterations": lambda: asp.solve(
        _problem(surface=rough((32, 32))),
        asp.MeanPressure(0.05),
        solver=asp.solvers.ConjugateGradient(max_iterations=2),
    ),
    "a second step above the hardness": lambda: asp.solve(
        _problem(law=asp.Hardness(1.0)), asp.History([asp.MeanPressure(0.1), asp.MeanPressure(2.0)])
    ),
    "a position that no load reaches": lambda: asp.solve(
        asp.ContactProblem(
            asp.generate.sphere(asp.Grid((24, 16), (1e-6, 1.25e-6)), radius=1e-3),
            asp.Elastic(135e9, 0.3),
            boundary=asp.Free(),
            law=asp.Hardness(200e6),
        ),
        asp.MeanGap(1e-18),
    ),
    "a flat that yields as a whole": lambda: asp.plasticity.plastic_load(
        _problem(surface=asp.Surface(np.zeros((8, 8)), 1.0, periodic=True), law=asp.Hardness(0.4))
    ),
    "a film of no thickness": lambda: asp.LiquidFilm(thickness=0.0, surface_tension=0.03),
    "an exact meniscus that is not concave": lambda: asp.theories.ExactMeniscus(1e-6, 0.07, 1.5).at_filling_angle(1.7),
    "vapour in which no meniscus grows": lambda: asp.theories.VapourGrowth(1e-6, 0.07, 1.8e-5, 0.5, start=1e-7),
    "a meniscus below the film": lambda: asp.LiquidFilm(thickness=2e-9, surface_tension=0.03, meniscus_height=1e-9),
    "a liquid that does not wet": lambda: asp.LiquidFilm(
        thickness=1e-9, surface_tension=0.03, contact_angles=(2.0, 2.0)
    ),
    "a layer of text": lambda: asp.Layer("DLC", 1e-9),  # type: ignore[arg-type]
    "a layer of negative thickness": lambda: asp.Layer(elastic(1.0), -1e-9),
    "an interface of text": lambda: asp.Layer(elastic(1.0), 1.0, "bonded"),  # type: ignore[arg-type]
    "a layer for a list": lambda: asp.Layered(asp.Layer(elastic(1.0), 1.0), elastic(1.0)),  # type: ignore[arg-type]
    "a rigid base": lambda: asp.Layered([], asp.Rigid()),  # type: ignore[arg-type]
    "a grading of text": lambda: asp.solids.graded(elastic(1.0), elastic(2.0), 1.0, grading="linear"),  # type: ignore[arg-type]
    "no depths": lambda: asp.stress(_solved(), []),
    "a depth above the surface": lambda: asp.stress(_solved(), [-1.0]),
    "stresses in a rigid body": lambda: asp.stress(_solved(), [0.0], of="counter_body"),
    "stresses in a third body": lambda: asp.stress(_solved(), [0.0], of="third"),
    "stresses on text": lambda: asp.stress(_solved(), [0.0], on="x"),  # type: ignore[arg-type]
    "sliding in no direction": lambda: asp.stress(_solved(), [0.0], friction=0.3, direction=(0.0, 0.0)),
    "a section beyond the surface": lambda: asp.stress(_solved(), [0.0], on=asp.stresses.Section(y=1e3)),
    "no strength": lambda: asp.stresses.load_at_yield(
        lambda load: asp.stress(asp.solve(_problem(), asp.MeanPressure(load)), [0.0]), 0.1
    ),
    "a theory by another name": lambda: asp.theories.theory("herz"),
    "a theory asked nothing": lambda: _asked("hertz", radius=1.0, E_star=1.0),
    "a theory asked what it does not know": lambda: _asked("hertz", radius=1.0, E_star=1.0, pressure=1e6),
    "a theory asked a negative load": lambda: _asked("hertz", radius=1.0, E_star=1.0, load=-1.0),
    "a pressure beyond what a theory is evaluated for": lambda: asp.theories.GreenwoodWilliamson(
        1e11, 1e13, 1e-6, 1e-9
    ).at_pressure([1e6, 1e20]),
    "a concave tip": lambda: asp.theories.PowerLawIndenter(1.0, 1.0, 0.5),
    "a contact wider than the sphere": lambda: asp.theories.SphericalIndenter(1.0, 1.0).at_radius(1.0),
    "kurtosis that no heights have": lambda: asp.generate.HeightMoments(2.0, 3.0),
    "kurtosis of two heights": lambda: asp.generate.HeightMoments(1.0, 2.0, system="pearson"),
    "kurtosis near two heights": lambda: asp.generate.HeightMoments(1.0, 2.0),
    "a wave that does not fit": lambda: asp.generate.sinusoid(GRID, amplitude=0.1, wavelength=5.0),
    "a wave shorter than two pixels": lambda: asp.generate.sinusoid(GRID, amplitude=0.1, wavelength=1.0),
    "a sphere that ends on the grid": lambda: asp.generate.sphere(GRID, radius=1.0, exact=True),
    "grooves that do not fit": lambda: asp.generate.grooves(GRID, pitch=5.0, width=1.0, depth=0.1),
    "grooves wider than their pitch": lambda: asp.generate.grooves(GRID, pitch=8.0, width=9.0, depth=0.1),
    "a surface of waves shorter than two pixels": lambda: asp.generate.gaussian(GRID, _spectrum(shortest=1.0), seed=1),
    "wavelengths in disorder": lambda: _spectrum(shortest=9.0),
    "an amplitude without a kind": lambda: asp.generate.SelfAffine(
        amplitude=1e-9, hurst=0.8, rolloff_wavelength=8.0, shortest_wavelength=2.0
    ),
    "a spectrum in descending order": lambda: asp.generate.TabulatedSpectrum([2.0, 1.0], [1.0, 2.0]),
    "a spectrum of a plane": lambda: asp.generate.spectrum_of(asp.Surface(np.zeros((8, 8)), 1.0)),
    "no cut-off": lambda: asp.surfaces.filtered(rough((32, 32))),
    "a cut-off of three pixels": lambda: asp.surfaces.filtered(rough((32, 32)), short=3.0),
    "a cut-off in the wrong unit": lambda: asp.surfaces.filtered(rough((32, 32)), long=1e3),
    "cut-offs in disorder": lambda: asp.surfaces.filtered(rough((32, 32)), short=20.0, long=10.0),
    "a tip of an even number of pixels": lambda: asp.surfaces.MeasuredTip(np.zeros((3, 4)), 1.0),
    "a tip above its apex": lambda: asp.surfaces.MeasuredTip(np.ones((3, 3)), 1.0),
    "a tip of other pixels": lambda: asp.surfaces.scanned(
        rough((8, 8)), asp.surfaces.MeasuredTip(np.zeros((3, 3)), 2.0)
    ),
    "a tip on which no point is certain": lambda: asp.surfaces.reconstructed(
        asp.Surface(np.eye(4), 1.0), asp.surfaces.ParabolicTip(4.0), mask_uncertain=True
    ),
    "an even number of pixels of a tip to estimate": lambda: asp.surfaces.estimated_tip(rough((8, 8)), (4, 3)),
    "a tip wider than what is around the peaks": lambda: asp.surfaces.estimated_tip(
        asp.Surface(np.eye(8), 1.0), (7, 7)
    ),
    "a relaxation of columns of different length": lambda: _relaxation([1.0, 2.0], [2.0]),
    "a relaxation before time zero": lambda: _relaxation([-1.0, 2.0], [2.0, 1.0]),
    "a relaxation to a negative modulus": lambda: _relaxation([1.0, 2.0], [2.0, -1.0]),
    "a relaxation that rises": lambda: _relaxation([1.0, 2.0], [1.0, 2.0]),
    "a creep that falls": lambda: _creep([1.0, 2.0], [2.0, 1.0]),
    "a creep from nothing": lambda: _creep([1.0, 2.0], [1.0, 2.0], fluid=True),
    "a plane through a line": lambda: asp.levelled(asp.Surface(np.ones((1, 8)), 1.0)),
    "a crop that ends before its start": lambda: asp.surfaces.cropped(rough((8, 8)), x=(2.0, 1.0)),
    "a crop beyond the surface": lambda: asp.surfaces.cropped(rough((8, 8)), x=(0.0, 99.0)),
    "a mask without regions": lambda: asp.surfaces.masked(rough((8, 8)), []),
    "a mask of everything": lambda: asp.surfaces.masked(rough((8, 8)), [asp.surfaces.Rectangle(x=(0.0, 99.0))]),
    "a mask beyond the surface": lambda: asp.surfaces.masked(rough((8, 8)), [asp.surfaces.Rectangle(x=(98.0, 99.0))]),
    "a mask of a word": lambda: asp.surfaces.masked(rough((8, 8)), ["left half"]),  # type: ignore[list-item]
    "an ellipse on a line scan": lambda: asp.surfaces.masked(
        rough((8, 8)).row(0), [asp.surfaces.Ellipse((1.0, 1.0), (1.0, 1.0))]
    ),
    "a rectangle without ends": lambda: asp.surfaces.Rectangle(),
    "a polygon of two corners": lambda: asp.surfaces.Polygon((0.0, 1.0), (0.0, 1.0)),
    "a line in both directions": lambda: asp.surfaces.sliced(rough((8, 8)), x=0.0, y=0.0),
    "an even window": lambda: asp.surfaces.despiked(rough((8, 8)), window=4),
    "surfaces that do not overlap": lambda: asp.surfaces.on_common_grid(
        asp.Surface(np.eye(8), 1.0), asp.Surface(np.eye(8), 1.0), shift=(25.0, 0.0)
    ),
    "a theory to compare by another name": lambda: asp.compare(rough((8, 8)), elastic(1.0), 1e-3, theories=["gw"]),
    "a name for a list": lambda: asp.compare(rough((8, 8)), elastic(1.0), 1e-3, theories="persson"),
    "a matrix with a unit of lengths": lambda: asp.read("rough.txt", lateral_unit="um", height_unit="nm"),
    "a text with an unknown delimiter": lambda: asp.read("rough.txt", delimiter="pipe"),
    "a text with an unknown encoding": lambda: asp.read("rough.txt", encoding="klingon"),
    "a text in another encoding": lambda: _read("micro.txt", "\u00b5\n1 2\n3 4\n", encoding="ascii"),
    "a text with axes of another name": lambda: asp.read("rough.txt", axes="all"),  # type: ignore[arg-type]
    "points in no order": lambda: _read("points.txt", "0 0 1\n1 0.1 1\n2.7 0.4 1\n3 1.3 2\n", size=(1.0, 1.0)),
    "points on the same node": lambda: _read("points.txt", 2 * "0 0 1\n0 1 1\n1 0 1\n1 1 1\n", size=(1.0, 1.0)),
    "points of unknown unit": lambda: _read("points.txt", "0 0 1\n0 1 1\n1 0 1\n1 1 1\n"),
    "a map of unknown unit": lambda: asp.read("rough.txt", size=(1.0, 1.0)),
    "a map of no width": lambda: asp.read("rough.txt", size=(1.0, 0.0), height_unit="nm"),
    "a scale of grey for a matrix": lambda: asp.read("rough.txt", size=(1.0, 1.0), height_unit="nm", z_scale=1.0),
    "a material file of another kind": lambda: _materials('[steel]\nE = "1 GPa"'),
    "a material without its modulus": lambda: _materials("[material.X]\npoisson_ratio = 0.3"),
    "a material with a density": lambda: _materials("[material.X]\ndensity = 1"),
    "a modulus without unit": lambda: _materials("[material.X]\nyoungs_modulus = 1e9\npoisson_ratio = 0.3"),
    "a study of nothing": lambda: plan(),
    "two axes of one value": lambda: plan(axes=[_axis("surface.seed", [1]), _axis("surface.seed", [1])]),
    "two axes of the control": lambda: plan(
        axes=[_axis("control.mean_pressure", ["1 MPa"]), _axis("control.force", ["1 N"])]
    ),
    "an axis of another unit": lambda: plan(axes=[_axis("control.force", ["1 m"])]),
    "an axis of negative forces": lambda: plan(axes=[_axis("control.force", ["-1 N"])]),
    "an axis by half": lambda: plan(axes=[{"path": "body.layers.0.thickness", "first": "1 nm"}]),
    "an axis of no values": lambda: plan(axes=[_axis("surface.seed", [])]),
    "a stop without a width": lambda: plan(monte_carlo=SAMPLES | {"stop": {"quantity": "max_pressure"}}),
    "no random scalars": lambda: plan(monte_carlo=SAMPLES | {"random": []}),
    "half a range": lambda: plan(sensitivity={"parameters": [{"path": "control.mean_pressure", "low": "1 MPa"}]}),
    "two kinds of study": lambda: plan(monte_carlo=SAMPLES, sensitivity={"parameters": ["control.mean_pressure"]}),
    "no quantities": lambda: plan(axes=[_axis("surface.seed", [1])], quantities=[]),
    "a critical thickness of the base": lambda: plan(
        critical_thickness={"layer": "body.base", "values": ["1 nm", "2 nm"]}
    ),
    "an axis of unknown path": lambda: plan(axes=[_axis("surface.seeds", [1])]),
    "an unknown quantity": lambda: plan(axes=[_axis("surface.seed", [1])], quantities=["area"]),
    "a quantity without its table": lambda: plan(axes=[_axis("surface.seed", [1])], quantities=["max_von_mises"]),
    "levels that fall": lambda: plan(convergence={"of": "grid", "levels": [64, 32, 16]}),
    "two levels": lambda: plan(convergence={"of": "grid", "levels": [16, 32]}),
    "a number that is no seed": lambda: plan(
        monte_carlo=SAMPLES | {"random": [{"path": "control.mean_pressure", "distribution": "seed"}]}
    ),
    "a map as a profile": lambda: asp.Profile(np.zeros((3, 2)), 1e-6),
    "a profile without points": lambda: asp.Profile([np.nan, np.nan], 1e-6),
    "a profile across its lay": lambda: asp.Profile([0.0, 1e-9], 1e-6, lay_angle=2.0),
    "a profile of unknown lay": lambda: _scan().across_lay(),
    "an overhang": lambda: asp.Profile.from_points([*range(20), 18.5, 21, 22], np.zeros(23)),
    "two heights at one place": lambda: asp.Profile.from_points([0.0, 1.0, 1.0], np.zeros(3)),
    "a profile for an area": lambda: asp.characterise(_scan()),  # type: ignore[arg-type]
    "a profile in a problem": lambda: asp.ContactProblem(_scan(), asp.Elastic(1e9, 0.3)),  # type: ignore[arg-type]
    "a line scan in a file of maps": lambda: asp.files.save_surface(_scan(), "trace.gsf"),
    "a document beside a line scan": lambda: asp.save(_scan(), "trace.nc", document=""),
    "a line scan saved as text": lambda: asp.save(_scan(), "trace.txt"),
    "a row that is not there": lambda: asp.Surface(np.zeros((4, 3)), 1e-6).row(3),
    "an instrument of no size": lambda: asp.surfaces.Instrument("stylus", tip_radius=0.0),
    "two columns without units": lambda: _two_columns(height_unit="nm"),
    "two columns in kg": lambda: _two_columns(height_unit="kg", lateral_unit="um"),
    "cut-offs the wrong way": lambda: asp.roughness.components(_scan(), long=1e-5, short=2e-5),
    "a trace shorter than a section": lambda: asp.roughness.components(_scan(), long=3e-4),
    "settings by RSm of the new standard": lambda: asp.roughness.settings_class(RSm=1e-4),
    "settings by nothing": lambda: asp.roughness.settings_class(),
    "settings of a rock": lambda: asp.roughness.settings_class(RSm=1.0, standard="ISO 4288"),
    "a spectrum of few modes": lambda: asp.roughness.isotropic_spectrum(_scan(30)),
    "a spectrum of a flat profile": lambda: asp.roughness.isotropic_spectrum(asp.Profile(np.zeros(99), 1e-6)),
    "an alias without a sum": lambda: asp.roughness.alias_factor(1.0, 1e5, 1e-6),
    "peaks of a flat profile": lambda: asp.roughness.summits_of_peaks(
        asp.roughness.profile_peaks(asp.Profile(np.zeros(9), 1e-6)), 1e-18
    ),
    "a closed profile with a datum": lambda: asp.contact.line_problem(
        _scan(periodic=True), asp.Elastic(1e9, 0.3), datum=1.0
    ),
    "current through a contact of unknown resistivity": lambda: asp.conductance.conductance(_solved()),
    "heat through a coating of unknown conductivity": lambda: asp.conductance.conductance(
        asp.solve(_coated_joint(), asp.MeanPressure(1e7)), "thermal"
    ),
    "conductance of neither": lambda: asp.conductance.conductance(_solved(), "magnetic"),  # type: ignore[arg-type]
    "a resistivity of zero": lambda: asp.solids.Conduction(electrical_resistivity=0.0),
    "a band of heat at rest": lambda: asp.theories.JaegerBand(1e9, 1e-5, 46.0, 1.2e-5).at_speed(0.0),
    "a band of heat in time": lambda: _source(asp.theories.BandSource(1e-5)).temperature(0.0, time=1.0),
    "a band of heat on a layer": lambda: _source(asp.theories.BandSource(1e-5), thickness=1e-6),
    "heat through a film too thin to be summed": lambda: _source(asp.theories.disc_source(1e-3), thickness=1e-6),
    "heat below a layer": lambda: _source(asp.theories.disc_source(1e-5), thickness=1e-6).temperature(0.0, depth=1e-6),
    "heat before it began": lambda: _source(asp.theories.disc_source(1e-5)).temperature(0.0, time=0.0),
    "heat without a half-space": lambda: asp.theories.HeatConductor(46.0, 1.2e-5, sink_depth=0.0),
    "heat below its sink": lambda: asp.theories.HeatConductor(46.0, 1.2e-5, sink_depth=1.0).below(2.0, 1.0, 0.0),
    "a flash of negative speed": lambda: asp.theories.BlokFlash(0.3, 1.0, 1e-5, 46.0, 46.0, 1.2e-5).at_speed(-1.0),
    "a film that generates": lambda: asp.conductance.ConductingInterface(film_resistance=-1e-12),
    "flash temperature without friction": lambda: asp.heating.flash_temperature(
        asp.solve(_hot_joint(), asp.MeanPressure(1e7)), asp.heating.Motion.of(1.0)
    ),
    "flash temperature of a negative friction": lambda: asp.heating.flash_temperature(
        asp.solve(_hot_joint(), asp.MeanPressure(1e7)), asp.heating.Motion.of(1.0), -0.1
    ),
    "flash temperature of an unknown heat capacity": lambda: asp.heating.flash_temperature(
        asp.solve(_coated_joint(), asp.MeanPressure(1e7)), asp.heating.Motion.of(1.0), 0.1
    ),
    "flash temperature in a free contact over a sink": lambda: asp.heating.flash_temperature(
        asp.solve(_hot_joint(asp.Free()), asp.MeanPressure(1e7)),
        asp.heating.Motion.of(1.0),
        0.1,
        asp.heating.HeatedInterface(sink=(1e-3, 1e-3)),
    ),
    "flash temperature with a bond too many": lambda: asp.heating.flash_temperature(
        asp.solve(_hot_joint(), asp.MeanPressure(1e7)),
        asp.heating.Motion.of(1.0),
        0.1,
        asp.heating.HeatedInterface(bonds=((1e-7,), ())),
    ),
    "flash temperature with Joule heat of unknown resistivity": lambda: asp.heating.flash_temperature(
        asp.solve(_hot_joint(), asp.MeanPressure(1e7)), asp.heating.Motion.of(1.0), 0.1, voltage=0.1
    ),
    "motion backwards": lambda: asp.heating.Motion.of(-1.0),
    "motion of both": lambda: asp.heating.Motion.of(1.0, "both"),  # type: ignore[arg-type]
    "rolling without rolling": lambda: asp.heating.Motion.of(1.0, rolling=1.0),
    "a heated interface that generates": lambda: asp.heating.HeatedInterface((-1.0, 0.0)),
    "a heat sink at the surface": lambda: asp.heating.HeatedInterface(sink=(0.0, 1.0)),
    "bodies colder than nothing": lambda: asp.heating.HeatedInterface(bulk=(-1.0, 1.0)),
    "wear of an unknown coefficient": lambda: asp.wear.of_layers(asp.material("nickel")),
    "wear of a rigid body": lambda: asp.wear.of_layers(asp.Rigid()),
    "wear coefficient below zero": lambda: asp.Strength(wear_coefficient=-1.0),
    "wear of nobody": lambda: asp.wear.Sides(),
    "wear of two tracks": lambda: asp.wear.Sides(
        asp.wear.archard(1e-15), asp.wear.archard(1e-15), body_track=1.0, counter_track=1.0
    ),
    "wear without an end": lambda: asp.wear.WearLaw(((1e-6, 1e-15),)),
    "wear by energy without friction": lambda: asp.wear.dissipated_energy(1e-15, 0.0),
    "a parameter that a contact has not": lambda: asp.sensitivities.sensitivities(
        asp.solve(_hot_joint(), asp.MeanPressure(1e7)), to="body.layers[0].thickness"
    ),
    "sensitivities of a count": lambda: asp.sensitivities.sensitivities(
        asp.solve(_hot_joint(), asp.MeanPressure(1e7)), "n_spots"
    ),
    "sensitivities of a stiffness at held approach": lambda: asp.sensitivities.sensitivities(
        asp.solve(_hot_joint(), asp.MeanPressure(1e7)), "stiffness", held="approach"
    ),
    "an uncertainty of nothing": lambda: asp.sensitivities.uncertainty(asp.solve(_hot_joint(), asp.MeanPressure(1e7))),
    "two samples of an uncertainty": lambda: asp.sensitivities.uncertainty(
        asp.solve(_hot_joint(), asp.MeanPressure(1e7)), "mean_gap", {"force": 0.1}, samples=2
    ),
    "load at yield without a strength": lambda: asp.sensitivities.yield_load(
        asp.solve(asp.ContactProblem(rough((16, 16)), asp.Elastic(1e9, 0.3)), asp.MeanPressure(1e6)),
        asp.sensitivities.StressNorm(0, (1e-6,)),
    ),
    "a norm of the stress above the surface": lambda: asp.sensitivities.StressNorm(0, (-0.1,)),
    "a norm of the stress in no layer": lambda: asp.sensitivities.sensitivities(
        asp.solve(_coated_joint(), asp.MeanPressure(1e7)), asp.sensitivities.StressNorm(5, (0.5,))
    ),
    "wear over no distance": lambda: asp.wear.worn(_hot_joint(), asp.MeanPressure(1e7), 0.0, asp.wear.archard(1e-15)),
    "wear over distances that fall": lambda: asp.wear.worn(
        _hot_joint(), asp.MeanPressure(1e7), [2.0, 1.0], asp.wear.archard(1e-15)
    ),
    "wear by a number": lambda: asp.wear.worn(_hot_joint(), asp.MeanPressure(1e7), 1.0, 1e-15),  # type: ignore[arg-type]
    "wear of adhesive surfaces": lambda: asp.wear.worn(
        _hot_joint().with_physics(adhesion=asp.adhesion.ExponentialAdhesion(0.05, 1e-9)),
        asp.MeanPressure(1e7),
        1.0,
        asp.wear.archard(1e-15),
    ),
    "steps of wear of third order": lambda: asp.wear.WearSteps(order=3),  # type: ignore[arg-type]
    "explicit steps of wear of second order": lambda: asp.wear.WearSteps(order=2, method="explicit"),
    "fretting without friction": lambda: asp.wear.fretted(
        _hot_joint(), asp.MeanPressure(1e7), asp.friction.Shift(1e-9), 3, asp.wear.archard(1e-15)
    ),
    "fretting without a shift": lambda: asp.wear.fretted(
        _hot_joint().with_physics(friction=asp.Coulomb(0.3)),
        asp.MeanPressure(1e7),
        asp.friction.Shift(),
        3,
        asp.wear.archard(1e-15),
    ),
    "wear in a document without a coefficient": lambda: asp.run(WEARS),
    "wear in a document of one without a coefficient": lambda: asp.run(
        WEARS | {"wear": {"distance": "1 m", "wears": "counter_body", "coefficient_body": "1e-6 mm^3/Nm"}}
    ),
    "wear in a document on a track that does not wear": lambda: asp.run(
        WEARS | {"wear": {"distance": "1 m", "coefficient_body": "1e-6 mm^3/Nm", "track_counter_body": "60 mm"}}
    ),
    "wear in a document by energy without friction": lambda: asp.run(
        WEARS | {"wear": {"distance": "1 m", "law": "energy"}}
    ),
    "wear in a document beside a shift": lambda: asp.run(
        WEARS | {"friction": {"coefficient": 0.3}, "shear": {"shift": "1 nm"}}
    ),
    "wear in a document until what is not coated is bare": lambda: asp.run(
        WEARS | {"wear": {"distance": "1 m", "coefficient_body": "1e-6 mm^3/Nm", "until_bare": True}}
    ),
    "wear in a document beyond the load": lambda: asp.run(
        WEARS | {"wear": {"distance": "1 m", "coefficient_body": "1e-6 mm^3/Nm", "step": 3}}
    ),
    "wear in a document of two tracks": lambda: asp.run(
        WEARS | {"wear": {"distance": "1 m", "track_body": "1 m", "track_counter_body": "1 m"}}
    ),
    "wear in a document that rolls once around what is not known": lambda: asp.run(
        ROLLS | {"wear": {"distance": "1 m", "coefficient_body": "1e-6 mm^3/Nm"}}
    ),
    "wear in a document that rolls and frets": lambda: asp.run(ROLLS | {"wear": {"cycles": 3, "shift": "1 um"}}),
    "wear in a document of a rough wheel": lambda: asp.run(
        ROLLS | {"rolling": {"longitudinal": 0.01, "roughness_file": "rough.nc"}}
    ),
    "wear by rolling along a track": lambda: asp.wear.worn_by_rolling(
        _hot_joint(),
        asp.MeanPressure(1e7),
        asp.rolling.Creepage(0.01),
        1.0,
        asp.wear.Sides(asp.wear.archard(1e-15), body_track=1.0),
        1.0,
    ),
    "stresses of a friction below zero as it wears": lambda: asp.wear.worn(
        _hot_joint(), asp.MeanPressure(1e7), 1.0, asp.wear.archard(1e-15)
    ).stressed(-0.1),
    "an animation of wear that is none": lambda: asp.report.save_wear_animation(
        asp.run({key: value for key, value in WEARS.items() if key != "wear"}), "none.gif"
    ),
    "a heat capacity of zero": lambda: asp.solids.Conduction(volumetric_heat_capacity=0.0),
    "leakage along one point": lambda: asp.run(
        SEAL
        | {"surface": {"kind": "cylinder", "points": [1, 16], "size": "1 um x 8 um", "radius": "9 um", "axis": "x"}}
    ),
    "a mean gradient along what does not repeat": lambda: asp.run(
        SEAL | {"boundary": {"kind": "free"}, "control": {"force": "1 mN"}, "sealing": {"driven": "gradient"}}
    ),
    "a leak at a step that is not there": lambda: asp.run(SEAL | {"sealing": {"step": 3}}),
    "a leak at a step beyond the path": lambda: asp.run(
        SEAL | {"control": {"path": {"mean_pressure": ["1 MPa", "2 MPa"], "steps": 1}}, "sealing": {"step": 7}}
    ),
    "closing load without a mean pressure": lambda: asp.run(
        SEAL | {"boundary": {"kind": "free"}, "control": {"force": "1 mN"}, "sealing": {"closing": True}}
    ),
    "flow factors of a contact that does not repeat": lambda: asp.run(
        {**SEAL, "boundary": {"kind": "free"}, "control": {"force": "1 mN"}, "sealing": None, "flow_factors": {}}
    ),
    "flow factors of a flat surface": lambda: asp.run(
        {**SEAL, "surface": {"kind": "flat", "points": [8, 8], "size": "1 um"}, "sealing": None, "flow_factors": {}}
    ),
    "flow factors at no separation": lambda: asp.sealing.tabulated_flow_factors(_solved().problem, ()),
    "flow factors of a negative separation": lambda: asp.sealing.tabulated_flow_factors(_solved().problem, (-1.0,)),
    "flow factors of summits that melt": lambda: asp.sealing.tabulated_flow_factors(
        _solved().problem,
        (3.0,),
        overlap="melted",  # type: ignore[arg-type]
    ),
    "a leak uphill": lambda: asp.sealing.leakage(_solved(), asp.sealing.ViscousLiquid(1e-3), 1e5, 2e5),
    "a leak of a gas below vacuum": lambda: asp.sealing.leakage(
        _solved(), asp.sealing.IdealGas(1.8e-5, 6.8e-8), 1e5, -1e4
    ),
    "a leak along z": lambda: asp.sealing.leakage(
        _solved(),
        asp.sealing.ViscousLiquid(1e-3),
        1e5,
        way="z",  # type: ignore[arg-type]
    ),
    "a liquid without viscosity": lambda: asp.sealing.ViscousLiquid(0.0),
    "a gas that is thrown back by more than all": lambda: asp.sealing.IdealGas(1.8e-5, 6.8e-8, 1.5),
    "a gap of another grid": lambda: asp.sealing.flow_through(np.ones((4, 4)), asp.Grid((4, 5), (1e-6, 1e-6))),
    "a gap that is negative": lambda: asp.sealing.flow_through(-np.ones((4, 4)), asp.Grid((4, 4), (1e-6, 1e-6))),
    "closing loads in the wrong order": lambda: asp.sealing.closing_load(_solved().problem, (2e6, 1e6)),
    "closing loads at which all is closed": lambda: asp.sealing.closing_load(_solved().problem, (1e3, 2e3)),
    "fits of Patir and Cheng that do not exist": lambda: asp.theories.PatirCheng(1e-6, 2.0),
    "obstacles that meet": lambda: asp.theories.ObstacleArray().at_covered(0.8),
    "a flange inside out": lambda: asp.theories.AnnularGap(1e-6, 1e-3, 2e-2, 1e-2),
    "gaps and other shares": lambda: asp.theories.EffectiveMedium([1e-6, 2e-6], [1.0]),
    "a medium without gaps": lambda: asp.theories.EffectiveMedium([0.0]),
    "gas against its pressure": lambda: asp.theories.ParallelGap(1e-6, 1e-5, 1e-2, 1e-3).at_inlet(1e5, 2e5),
    "a fluid that lifts the bodies off": lambda: asp.solve(_pressed(1e9), asp.MeanPressure(1e8)),
    "a fluid that presses and is none": lambda: asp.sealing.FluidPressure(1e-3, 2e5),  # type: ignore[arg-type]
    "a fluid that presses backwards": lambda: asp.sealing.FluidPressure(asp.sealing.ViscousLiquid(1e-3), 1e5, 2e5),
    "a fluid that presses beside adhesion": lambda: _pressed(1e6).with_physics(
        adhesion=asp.ExponentialAdhesion(0.05, 1e-9)
    ),
    "a contact without a fluid that presses": lambda: _solved().require_fluid(),
    "an axis too long": lambda: plan(
        axes=[{"path": "control.mean_pressure", "first": "1 MPa", "last": "2 MPa", "count": 1_000_000_000}]
    ),
}
"""Calls of the library, by what is wrong."""
