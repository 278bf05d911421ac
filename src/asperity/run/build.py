"""From the text of a problem document to the objects that are solved: one case."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from ..contact.boundary import Boundary, Free, FreeLine, Periodic
from ..contact.controls import Approach, Control, Force, MeanGap, MeanPressure, Step, as_step
from ..contact.history import Ramped, ramps
from ..contact.law import Hardness, HardWall, InterfaceLaw
from ..contact.problem import ContactProblem, Flat, Physics
from ..contact.solve import default_solver, sticks
from ..contact.solvers.by_name import solver_by_name
from ..contact.solvers.protocol import Solver
from ..core import units
from ..core.citations import citation_keys
from ..core.engine import CpuEngine, Engine
from ..core.engine.gpu import GpuEngine
from ..core.errors import AsperityError, InputError
from ..core.grid import Grid
from ..core.registry import role
from ..core.settings import Settings, json_schema, problems
from ..core.status import is_large, require_memory, room_text
from ..io.schemas.bodies import (
    BESIDE,
    CONDUCTS,
    BodyTable,
    GradedTable,
    LayerTable,
    LinearHardeningTable,
    MaterialTable,
    SwiftTable,
    body_from_text,
)
from ..io.schemas.problem import (
    EFFECTIVE,
    FROM_BODY,
    NONE,
    SURFACE,
    ControlTable,
    HardnessTable,
    LawTable,
    PerLength,
    ProblemDocument,
)
from ..io.schemas.relaxation import (
    ArrheniusTable,
    KelvinVoigtTable,
    MaxwellTable,
    MeasuredTable,
    PowerLawTable,
    PronyTable,
    Relaxing,
    StandardLinearTable,
)
from ..io.schemas.surfaces import (
    AMPLITUDES,
    FileSurface,
    GeneratedSurface,
    LineScanFile,
    ScanFile,
    SurfaceTable,
    arguments_of,
    prepared,
)
from ..parts.part import Part
from ..parts.registry import parts
from ..solids.elastic import Conduction, Elastic, Hardening, Rigid, Strength, yield_pressure
from ..solids.layers import (
    Body,
    Bonded,
    ExponentialGrading,
    Frictionless,
    Grading,
    Interface,
    Layer,
    Layered,
    LinearGrading,
    PowerGrading,
    RigidBase,
    graded,
    surface_material,
    unknown_strengths,
)
from ..solids.library import material
from ..solids.moduli_file import fitted_file
from ..solids.plasticity import LinearHardening, Swift, Voce
from ..solids.strength import flow_stress
from ..solids.viscoelastic import Arrhenius, TemperatureShift, Viscoelastic, WilliamsLandelFerry
from ..surfaces.formats import checked_size
from ..surfaces.pair import on_common_grid, turned_over
from ..surfaces.profile import Profile
from ..surfaces.read import read, read_map
from ..surfaces.surface import Surface, lines_too


@dataclass(frozen=True, eq=False)
class Case:
    """What a ``document`` describes.

    Attributes
    ----------
    document
        The document.
    problem
        Surfaces, bodies, boundary and law.
    control, path
        The load, and the steps that end with it; empty for a single load.
    solver
        Method with its settings.
    asks
        What is asked of each part, by its name.
    parts
        The parts that are known.
    """

    document: ProblemDocument
    problem: ContactProblem
    control: Control
    path: tuple[Step | Control, ...]
    solver: Solver
    asks: Mapping[str, Any]
    parts: tuple[Part, ...]

    @property
    def threads(self) -> int | None:
        """Number of threads that the document states."""
        return self.document.solver.threads

    def engine(self, threads: int | None = None) -> Engine:
        """Machine that the document states; on the CPU with so many ``threads`` instead of those of
        the document."""
        if self.document.solver.machine == "gpu":
            return GpuEngine()
        return CpuEngine(threads or self.threads)

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers that its numbers will rest on."""
        asked = [part for part in self.parts if part.name in self.asks]
        planned = {key for part in asked for key in part.at_work.citations(self.asks[part.name], self.problem)}
        return tuple(sorted({*citation_keys(self.solver), *planned}))

    def under(self, document: ProblemDocument) -> Case:
        """The same case with the load of ``document``, which differs in nothing else."""
        control, path = build_course(document, self.asks, self.parts, self.problem.surface.size[1])
        return replace(self, document=document, control=control, path=path)


@contextmanager
def _about(key: str) -> Iterator[None]:
    """Context whose errors are about the table ``key`` of the document."""
    try:
        yield
    except AsperityError as error:
        error.place = error.place or key
        raise


def build(
    document: ProblemDocument,
    base_folder: str | Path = ".",
    known: tuple[Part, ...] = (),
    *,
    surfaces: Callable[[SurfaceTable, SurfaceTable | None, Path], tuple[Surface, Surface | None]] | None = None,
) -> Case:
    """Objects described by ``document``; its relative file paths start at ``base_folder``;
    ``known`` parts, by default the installed ones; ``surfaces`` makes other surfaces than those of
    the document.

    Raises
    ------
    InputError
        If a file cannot be read, a material is unknown, or the parts do not fit together.
    """
    folder = Path(base_folder)
    with _about("body"):
        body = build_body(document.body, folder)
    with _about("counter_body"):
        counter_body = build_body(document.counter_body, folder)
    with _about("surface"):
        surface, counter_surface = (surfaces or build_surfaces)(document.surface, document.counter_surface, folder)
    boundary: Boundary = Free() if document.boundary.kind == "free" else Periodic()
    if document.boundary.kind == "line":
        datum = document.boundary.datum
        boundary = FreeLine(None if datum is None else units.parse(datum, "length", "boundary.datum"))
    with _about("law"):
        law = build_law(document.law, (body, counter_body))
    problem = ContactProblem(
        surface,
        body,
        Flat() if counter_surface is None else counter_surface,
        counter_body,
        boundary,
        law,
    )
    known, asks = known or parts(), dict[str, Any]()
    for part in known:
        with _about(part.table):
            if part.settings_in(document) is not None and (ask := part.asked(document, folder)) is not None:
                asks[part.name] = ask
    asked = [part for part in known if part.name in asks]
    joined: dict[str, Any] = {}
    own: list[Physics] = []
    for part in asked:
        given = dict(part.coupling(asks[part.name]))
        own += given.pop("physics", ())
        joined |= given
    problem = replace(problem, physics=tuple(own), **joined)
    for part in asked:
        with _about(part.table):
            part.at_work.check(asks[part.name], problem)
    for part in asked:
        problem = part.at_work.altered(asks[part.name], problem)
    control, path = build_course(document, asks, known, surface.size[1])
    solver = default_solver(problem, sticks=sticks(problem, [as_step(item) for item in path], None))
    table = document.solver
    method, precision = table.method or solver.name, table.precision
    if table.given("threads", "machine"):  # what it leaves out is the default of the method, or of this problem
        usual = solver.tolerance if method == solver.name else None
        tolerance = usual if table.tolerance is None else table.tolerance
        solver = solver_by_name(method, tolerance, table.max_iterations, precision=precision)
    return Case(document, problem, control, path, solver, asks, known)


def build_law(table: LawTable, bodies: tuple[Body, ...]) -> InterfaceLaw:
    """Law that ``table`` names; a hardness from the body is that of the softer one at its surface,
    or 2.8 Y where only a yield stress is known.

    Where that body is coated it is the effective hardness, which follows the indentation, or by the
    word ``SURFACE``, and where the strength of a deeper part is not known, that of its top layer.
    """
    if not isinstance(table, HardnessTable):
        return HardWall()
    if table.hardness not in (FROM_BODY, SURFACE, EFFECTIVE):
        return Hardness(_known(table.hardness))
    tops = [
        (yield_pressure(solid.strength).value, body) for body in bodies if (solid := surface_material(body)) is not None
    ]
    known = [(hardness, body) for hardness, body in tops if hardness is not None]
    if not known:
        coated = " (of a coated body the top layer counts)" if any(isinstance(b, Layered) for b in bodies) else ""
        raise InputError(
            "hardness must be known for at least one body to be taken from it, but neither states one, nor a "
            f"yield stress{coated}. "
            "Give it as a pressure, such as {law.hardness=5 GPa}."
        )
    hardness, softer = min(known, key=lambda item: item[0])
    by_depth = table.hardness == EFFECTIVE or (table.hardness == FROM_BODY and not unknown_strengths(softer))
    coated_softer = by_depth and isinstance(softer, Layered) and softer.reduced.layers
    made: InterfaceLaw = role("layered_hardness")(softer) if coated_softer else Hardness(hardness)
    return made


def build_course(
    document: ProblemDocument, asks: Mapping[str, Any], known: tuple[Part, ...], length: float
) -> tuple[Control, tuple[Step | Control, ...]]:
    """The last control of ``document``, and the steps to it, with what the ``known`` parts that are
    asked for add; none for one load.

    Forces per length are those of a line contact of this ``length`` in m.
    """
    table = document.control.path
    if table is None:
        found: tuple[Step | Control, ...] = (build_control(document.control, length),)
    else:
        kinds: dict[str, tuple[Ramped, str]] = {
            "mean_pressure": (MeanPressure, "pressure"),
            "force": (Force, "force"),
            "approach": (Approach, "length"),
            "mean_gap": (MeanGap, "length"),
        }
        name = next(key for key in kinds if getattr(table, key) is not None)
        kind, quantity = kinds[name]
        points = [
            0.0 if text == NONE else units.parse(text, quantity, f"control.path.{name}") * _per_length(text, length)
            for text in getattr(table, name)
        ]
        found = ramps(kind, points, steps=table.steps)
    alone = found if table is None else ()
    for part in known:
        if part.name in asks:
            with _about(part.table):
                found = part.at_work.course(asks[part.name], found)
    return as_step(found[-1]).normal, () if found == alone else found


def build_control(table: ControlTable, length: float = 1.0) -> Control:
    """The one control that ``table`` gives.

    Raises
    ------
    InputError
        If it gives a load path.
    """
    if table.path is not None:
        raise InputError(
            "control must be one load or position here, but is a load path. Give control.mean_pressure, "
            "force, approach or mean_gap."
        )
    if table.mean_pressure is not None:
        return MeanPressure(_known(table.mean_pressure))
    if table.force is not None:
        return Force(units.parse(table.force, "force", "control.force") * _per_length(table.force, length))
    if table.approach is not None:
        return Approach(units.parse(table.approach, "length", "control.approach"))
    assert table.mean_gap is not None
    return MeanGap(units.parse(table.mean_gap, "length", "control.mean_gap"))


def _per_length(force: float | str, length: float) -> float:
    return length if isinstance(force, PerLength) else 1.0


# Bodies.


def build_body(table: BodyTable, folder: Path) -> Body:
    """Body that ``table`` names or describes; the path of its materials file starts at
    ``folder``."""
    library = None if table.materials_file is None else folder / table.materials_file
    if table.base is not None:
        layers = [layer for part in table.layers for layer in _layers(part, library, folder)]
        base = RigidBase() if table.base.rigid else build_material(table.base, library, folder)
        return Layered(layers, base, table.name or "")
    return Rigid() if table.rigid else build_material(table, library, folder)


def body_of_text(text: str, what: str) -> Body:
    """Body from its one line of text, such as ``"DLC"`` or ``"E=140GPa,nu=0.25,H=15GPa"``; ``what``
    names it in messages.

    Raises
    ------
    InputError
        If it is not understood.
    """
    try:
        table = BodyTable.model_validate(body_from_text(text))
    except InputError as error:
        raise InputError(f"{what}{error}") from None
    except ValidationError as error:
        raise InputError(f"{what}: {'; '.join(problems(error, json_schema(BodyTable), {}))}") from None
    return build_body(table, Path())


def _layers(table: LayerTable | GradedTable, library: Path | None, folder: Path) -> tuple[Layer, ...]:
    thickness = units.parse(table.thickness, "length", "thickness")
    interface: Interface = Frictionless() if table.interface == "frictionless" else Bonded()
    if isinstance(table, LayerTable):
        return (Layer(build_material(table, library, folder), thickness, interface),)
    top, bottom = (build_material(part, library, folder) for part in (table.top, table.bottom))
    grading: Grading = LinearGrading() if table.kind == "linear" else ExponentialGrading()
    if table.exponent is not None:
        grading = PowerGrading(table.exponent)
    return graded(top, bottom, thickness, grading=grading, sublayers=table.sublayers, interface=interface)


# Surfaces: read or generated by the function of their kind, then prepared step by step.


_GRID = (
    "kind",
    "points",
    "size",
    "prepare",
    "mirror",
    "place",
)  # keys of a surface that are no arguments of its generator


def build_surface(table: SurfaceTable, folder: Path) -> Surface:
    """Surface of ``table`` after its preparation steps; a relative file path starts at ``folder``.
    A line scan is a strip."""
    if isinstance(table, FileSurface):
        surface = read_map(folder / table.path, **table.reading())  # a line scan is a strip of grooves
    else:
        surface = build_generated(table, folder)
    for step in table.prepare:
        surface = prepared(surface, step)
    return surface


def build_line_scan(table: LineScanFile, folder: Path) -> Profile:
    """Line scan of ``table`` after its preparation steps, one of which may take it of a map.

    Raises
    ------
    InputError
        If the file holds a map of which none takes a line.
    """
    found = read(folder / table.path, **table.reading())
    for step in table.prepare:
        found = lines_too(step.makes)(found, **arguments_of(step))
    if isinstance(found, Profile):
        return found
    if found.shape[1] > 1:
        raise InputError(
            f"file for the spectrum of a line scan must hold one, but {table.path} holds a map of {found.shape[0]} x "
            f"{found.shape[1]} points. A surface with the spectrum of a map is of the kind rough with the spectrum "
            "measured; in a document the step slice takes one line of a map.",
            subject="file for the spectrum of a line scan",
        )
    return found.row(0)


def build_surfaces(table: SurfaceTable, counter: SurfaceTable | None, folder: Path) -> tuple[Surface, Surface | None]:
    """Surface and counter surface, the latter turned over and placed, so that it lies in the frame
    of the first."""
    surface = build_surface(table, folder)
    if counter is None:
        return surface, None
    other = build_surface(counter, folder)
    if counter.mirror not in (None, "none"):
        other = turned_over(other, axis=str(counter.mirror))
    if counter.place is None:
        return surface, other
    place = counter.place.given()
    pair = on_common_grid(
        surface, other, shift=place.get("shift", (0.0, 0.0)), angle=place.get("angle", 0.0), spacing=place.get("pixel")
    )
    return pair.surface, pair.counter_surface


def build_generated(table: Any, folder: Path, **more: Any) -> Surface:
    """Surface that ``table`` describes, before its preparation; ``more`` arguments go to the
    generator.

    Relative paths of measured surfaces start at ``folder``.
    """
    arguments = {key: build_part(value, folder) for key, value in table.given(*_GRID).items()}
    grid = table_grid(table)
    needed = BYTES_OF_A_POINT * grid.n_points
    require_memory(needed, "points of the surface", "{} x {}".format(*grid.shape), "give fewer points")
    made: Surface = table.makes(grid=grid, **arguments, **more)
    doubts = [item for value in arguments.values() for item in getattr(value, "findings", ())]
    return replace(made, origin=replace(made.origin, findings=(*made.origin.findings, *doubts))) if doubts else made


BYTES_OF_A_POINT = 100.0
"""Memory of a point of a generated surface: noise, spectrum and what transforms and solvers take of
them, at the least."""


def table_grid(table: GeneratedSurface) -> Grid:
    """Grid of a generated surface."""
    (nx, ny), (length_x, length_y) = table.points, checked_size(table.size, "a generated surface", table.points)
    return Grid((nx, ny), (length_x / nx, length_y / ny))


def stated_points(table: SurfaceTable) -> int:
    """Number of points of the grid of a surface as far as its ``table`` states it; 0 where only the
    file does."""
    found = 0 if isinstance(table, FileSurface) else math.prod(table.points)
    for step in table.prepare:
        found = math.prod(step.points) if step.step == "resample" else found
    return found


def large_grid(points: int) -> str:
    """What a grid of so many ``points`` takes, if that is much of the free memory; else empty.

    Raises
    ------
    InputError
        If it does not fit.
    """
    needed = BYTES_OF_A_POINT * points
    require_memory(needed, "points of the surface", f"{points:.3g}", "give fewer points ({resample})")
    return f"The grid of {points:.3g} points needs about {room_text(needed)}." if is_large(needed) else ""


def build_part(value: Any, folder: Path) -> Any:
    """Spectrum or distribution of heights for its table, surface, line scan or scan for that of a
    file, anything else as it is."""
    if type(value) is tuple:
        return tuple(build_part(item, folder) for item in value)
    if not isinstance(value, Settings):
        return value
    if isinstance(value, ScanFile):
        return value.scan(folder)
    if isinstance(value, FileSurface):
        return build_line_scan(value, folder) if isinstance(value, LineScanFile) else build_surface(value, folder)
    arguments = {key: build_part(item, folder) for key, item in value.given("kind").items()}
    for key, amplitude in AMPLITUDES.items():
        if key in arguments and "amplitude" in inspect.signature(value.makes).parameters:
            arguments["amplitude"] = amplitude(arguments.pop(key))
    return value.makes(**arguments)


# Materials: from the library, of elastic constants, or viscoelastic.


def build_material(table: MaterialTable, library: Path | None, folder: Path) -> Elastic:
    """Material of ``table``; names are looked up in the file ``library`` too, and paths of files
    start at ``folder``."""
    if table.material is not None:
        found = material(table.material, library=library)
        given = [key for key in BESIDE if getattr(table, key) is not None]
        kept = tuple(source for source in found.sources if source.partition(":")[0] not in given)
        sources = (*kept, *(f"{key}: user" for key in given))
        strength, conduction = build_strength(table, found), _conduction(table, found.conduction)
        return replace(found, strength=strength, conduction=conduction, sources=sources) if given else found
    assert table.poisson_ratio is not None
    strength = build_strength(table, None)
    more: dict[str, Any] = {"strength": strength, "name": table.name or "", "sources": ("user",)}
    more["conduction"] = _conduction(table, Conduction())
    if table.relaxation is not None:
        return viscoelastic(table.relaxation, float(table.poisson_ratio), folder, **more)
    return Elastic(_known(table.youngs_modulus), table.poisson_ratio, **more)


def _conduction(table: MaterialTable, known: Conduction) -> Conduction:
    """What conducts by ``table``, in place of what is ``known`` of its material."""
    return replace(known, **{key: float(getattr(table, key)) for key in CONDUCTS if getattr(table, key) is not None})


def build_strength(table: MaterialTable, known: Elastic | None) -> Strength:
    """Strength that ``table`` gives, in place of what is ``known`` of its material; a hardening
    begins at the yield stress, or at that of the hardness."""
    before = Strength() if known is None else known.strength
    given = table.yield_stress is not None
    strength = Strength(
        before.hardness if table.hardness is None else float(table.hardness),
        _known(table.yield_stress) if given else before.yield_stress,
        None if given or table.hardening is not None else before.hardening,
        before.kinematic if table.kinematic is None else float(table.kinematic),
        before.recall if table.recall is None else float(table.recall),
        before.wear_coefficient if table.wear_coefficient is None else float(table.wear_coefficient),
    )
    if table.hardening is None:
        return strength
    first, flow = flow_stress(strength).value, table.hardening
    if math.isnan(first):
        raise InputError(
            "yield stress must be given together with a hardening, but is not known. Give yield_stress (Y in "
            "the text of a body).",
            subject="yield stress",
        )
    hardening: Hardening
    if isinstance(flow, LinearHardeningTable):
        hardening = LinearHardening(first, float(flow.modulus))
    elif isinstance(flow, SwiftTable):
        modulus = known.youngs_modulus if known else _known(table.youngs_modulus)
        strain = first / modulus if flow.reference_strain is None else float(flow.reference_strain)
        hardening = Swift(first, strain, float(flow.exponent))
    else:
        hardening = Voce(first, float(flow.gain), float(flow.rate))
    return replace(strength, yield_stress=first, hardening=hardening)


def viscoelastic(table: Relaxing, nu: float, folder: Path, **more: Any) -> Viscoelastic:
    """Viscoelastic material that relaxes as ``table`` says, of Poisson's ratio ``nu``; ``more`` are
    fields of it."""
    shift: TemperatureShift | None = None
    if isinstance(table.shift, ArrheniusTable):
        shift = Arrhenius(float(table.shift.reference), float(table.shift.activation_energy))
    elif table.shift is not None:
        shift = WilliamsLandelFerry(float(table.shift.reference), float(table.shift.c1), float(table.shift.c2))
    more |= {"elastic_bulk": table.elastic_bulk, "shift": shift}
    if isinstance(table, PronyTable):
        terms = tuple((float(e), float(t)) for e, t in zip(table.moduli, table.times, strict=True))
        return Viscoelastic.prony(float(table.relaxed), terms, nu, **more)
    if isinstance(table, StandardLinearTable):
        return Viscoelastic.standard_linear(
            float(table.relaxed), float(table.instantaneous), float(table.time), nu, **more
        )
    if isinstance(table, MaxwellTable):
        return Viscoelastic.maxwell(float(table.modulus), float(table.time), nu, **more)
    if isinstance(table, KelvinVoigtTable):
        ratio = float(table.instantaneous)
        return Viscoelastic.kelvin_voigt(float(table.relaxed), float(table.time), nu, instantaneous=ratio, **more)
    if isinstance(table, PowerLawTable):
        ends = {"shortest": float(table.shortest), "longest": float(table.longest)}
        return Viscoelastic.power_law(float(table.coefficient), float(table.exponent), nu, **ends, **more)
    if not isinstance(table, MeasuredTable):
        raise InputError(f"relaxation must be one of the kinds of documents, but is {table!r}.")
    more["sources"] = (*more.get("sources", ()), f"relaxation: {table.moduli_file}")
    asked = {"poisson_ratio": nu, "per_decade": table.per_decade, "fluid": table.fluid}
    return fitted_file(folder / table.moduli_file, **asked, **more).solid


def _known(value: float | str | None) -> float:
    return math.nan if value is None else float(value)
