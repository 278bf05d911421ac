"""Bad input of every kind, whose messages are written down in messages.txt."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from cli.conftest import BODY, LOAD
from contact_cases import elastic, rough

import asperity as asp

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
    (*BODY, *LOAD, "--resample", "many"),
    (*BODY, *LOAD, "--humidity", "60"),
    (*BODY, "--pressure", "50mpa"),
    (*BODY, *LOAD, "--taper", "0.9"),
    (*BODY, *LOAD, "--mirror", "x"),
    (*BODY, *LOAD, "--materials-file", "none.toml", "--body", "DLC"),
)
"""Options of ``asperity contact`` on a matrix of stated size."""

INFO: tuple[tuple[str, ...], ...] = (
    (),
    ("--size", "1e-299um"),
    ("--size", "8um"),
    ("--size", "8"),
    ("--size", "8um", "--height-unit", "kg"),
    ("--size", "8um", "--height-unit", "nm", "--channel", "Phase"),
    ("--size", "8um", "--height-unit", "nm", "--z-scale", "5nm"),
)
"""Options of ``asperity info`` on a matrix that states neither size nor unit."""

FILES: Mapping[str, bytes | None] = {
    "none.txt": None,
    "empty.txt": b"",
    "noise.di": b"\x00\x01\x02 not a topography \xff" * 40,
    "noise.xyzzy": b"certainly not a topography" * 8,
    "ragged.txt": b"1 2 3\n4 5\n",
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
    "a solver by its name": lambda: asp.solve(_problem(), asp.MeanPressure(0.1), solver="nnls"),  # type: ignore[arg-type]
    "an unknown choice on failure": lambda: asp.solve(_problem(), asp.MeanPressure(0.1), on_failure="ignore"),  # type: ignore[call-overload]
    "an operator of another grid": lambda: asp.solve(
        _problem(),
        asp.MeanPressure(0.1),
        operator=asp.prepare_operator(_problem().compliance, asp.Grid((8, 8), (1.0, 1.0)), asp.Periodic()),
    ),
    "a pressure above the hardness": lambda: asp.solve(_problem(law=asp.Hardness(1.0)), asp.MeanPressure(2.0)),
    "tolerance -1": lambda: asp.solvers.ActiveSet(tolerance=-1.0),
    "no iterations": lambda: asp.solvers.ActiveSet(max_iterations=0),
}
"""Calls of the library, by what is wrong."""
