"""What goes past a soft house limit or keeps a cache, each with its reason. An entry that is not in
use fails."""

from __future__ import annotations

LIMITS: dict[str, dict[str, str]] = {
    "function lines": {
        "sweep": (
            "what a kernel calls is compiled once more in each of its callers: in nine functions it took "
            "four times as long"
        ),
        "rise": "what a kernel calls is compiled once more in each of its callers",
        "fall": "what a kernel calls is compiled once more in each of its callers",
        "at_points": "what a kernel calls is compiled once more in each of its callers",
        "found_of": "findings in turn, each a condition and its words, which fill most of the lines",
        "RollingWork.compute": "findings in turn, each a condition and its words, which fill most of the lines",
        "SlidingStartWork.compute": "findings in turn, each a condition and its words, which fill most of the lines",
    },
    "parameters": {
        "app": "one for each option of the command line",
        "indentation": "independent keyword-only choices of the user, each with a default",
        "Scan.__init__": "independent keyword-only facts of a scan and its instrument, each with a default",
        "Indentation.of": "the same choices as those of the function",
        "Preview.__init__": "a map on a page, and keyword-only tools and places that it may have",
        "Profile.__init__": "independent keyword-only facts of a line scan, each with a default",
        "StressPlanes.__init__": (
            "independent keyword-only choices of the user, and the stress that a result knows beside its tractions"
        ),
        "compliant_block": "a body, its size, push and interface, and keyword-only choices, each with a default",
        "cylinder_in_bore": "two bodies, three numbers of the fit, and keyword-only choices, each with a default",
        "stamp_contact": "a stamp, its two bodies and boundary, one of two loads, and the points touched",
        "predict": "independent keyword-only choices of the user, each with a default",
        "uncertainty": "independent keyword-only choices of the user, each with a default",
        "read": "independent keyword-only choices of the user, each with a default",
        "filter_waves": "independent keyword-only choices of the user, each with a default",
        "fitted_solid": "three measured columns, and independent keyword-only choices of the user",
        "rectangle": "a point, a rectangle and the body it moves on, and keyword-only depth and time",
        "pixel_kernel": "a grid and the body it moves on, and keyword-only depth and time",
        "finished": "what a solve ends with, and who asks: a history, a step of time or a sliding contact",
        "slide": "independent keyword-only choices of the user, each with a default",
        "hertz_pass": "independent keyword-only choices of the user, each with a default",
        "hertz_steps": "the same choices as those of the pass",
        "sliding_pass": "independent keyword-only choices of the user, each with a default",
        "sliding_steps": "the same choices as those of the pass",
        "survey": "a compiled pass takes its arrays and numbers one by one",
        "survey_capped": "a compiled pass takes its arrays and numbers one by one",
        "mark_free": "a compiled pass takes its arrays and numbers one by one",
        "fill_free": "a compiled pass takes its arrays and numbers one by one",
        "violation": "a compiled pass takes its arrays and numbers one by one",
        "mark_free_elastic": "a compiled pass takes its arrays and numbers one by one",
        "scatter_change": "a compiled pass takes its arrays and numbers one by one",
        "gather_products": "a compiled pass takes its arrays and numbers one by one",
        "update_direction": "a compiled pass takes its arrays and numbers one by one",
        "update_solution": "a compiled pass takes its arrays and numbers one by one",
        "add_clipped": "a compiled pass takes its arrays and numbers one by one",
        "rescale": "a compiled pass takes its arrays and numbers one by one",
        "sweep": "a compiled pass takes its arrays and numbers one by one",
        "rise": "a compiled pass takes its arrays and numbers one by one",
        "fall": "a compiled pass takes its arrays and numbers one by one",
        "local_stiffness": "a compiled pass takes its arrays and numbers one by one",
        "_between": "a compiled pass takes its arrays and numbers one by one",
        "_reciprocals": "a compiled pass takes its arrays and numbers one by one",
        "overlaps": "a compiled pass takes its arrays and numbers one by one",
        "corrected": "a compiled pass takes its arrays and numbers one by one",
        "fall_corrected": "a compiled pass takes its arrays and numbers one by one",
        "at_points": "a compiled pass takes its arrays and numbers one by one",
        "_down": "a compiled pass takes its arrays and numbers one by one",
        "press": "a compiled pass takes its arrays and numbers one by one",
        "entering_levels": "a compiled pass takes its arrays and numbers one by one",
        "subtract_deflections": "a compiled pass takes its arrays and numbers one by one",
        "coupled_product": "a compiled pass takes its arrays and numbers one by one",
        "factorise_tensors": "a compiled pass takes its arrays and numbers one by one",
        "vector_deflections": "a compiled pass takes its arrays and numbers one by one",
        "_invariant": "a compiled pass takes its arrays and numbers one by one",
        "ContactProblem.__init__": "the fields of a problem, of which all but two have a default",
        "execute": "independent keyword-only choices of the callers, each with a default",
        "assemble": "gathers what the separate stages of a solve produced, in one place",
        "Prepared.__init__": "the choices of solve, for all steps of a history",
        "compare": "independent keyword-only choices of the user, each with a default",
        "roll": "independent keyword-only choices of the user, each with a default",
        "roll_rough": "independent keyword-only choices of the user, each with a default",
        "slide_in_time": "independent keyword-only choices of the user, each with a default",
        "creep_curve": "independent keyword-only choices of the user, each with a default",
        "interface_forces": "a compiled pass takes its arrays and numbers one by one",
        "retarded": "a compiled pass takes its arrays and numbers one by one",
        "advance": "a compiled pass takes its arrays and numbers one by one",
        "curvature": "a compiled pass takes its arrays and numbers one by one",
        "integrated": "phases, start and times of a motion, and three choices of the method, each a keyword",
        "move_block": "independent keyword-only choices of the user, all with a default",
        "sweep_block": "independent keyword-only choices of the user, most with a default",
        "bifurcation": "independent keyword-only choices of the user, most with a default",
        "stress": "independent keyword-only choices of the user, each with a default",
        "stress_planes": "independent keyword-only choices of the user, each with a default",
        "save_gaussian": "independent keyword-only choices of the user, most with a default",
        "save_endless": "independent keyword-only choices of the user, each with a default",
        "bimodal": "two textures, their patches, and what joins them, each a keyword",
        "particles": "independent keyword-only numbers of the particles, most with a default",
        "rank_ordered": "independent keyword-only choices of the user, most with a default",
        "translated": "independent keyword-only choices of the user",
        "digital_filter": "independent keyword-only choices of the user, most with a default",
        "endless": "independent keyword-only choices of the user, most with a default",
        "laser_bumps": "the constants of the formula, each a keyword",
        "weierstrass_mandelbrot": "the constants of the published formula, each a keyword",
        "weierstrass_mandelbrot_profile": "the constants of the published formula, each a keyword",
        "worn": "independent keyword-only choices of the user, each with a default",
        "worn_by_rolling": "what wears, rolls and how far, and independent keyword-only choices with defaults",
        "fretted": "independent keyword-only choices of the user, each with a default",
    },
}
"""Reason by limit and place of the definition in its module (``Class.method``), whatever module
that is. A reason is why splitting would read worse; "it is long" is none."""

CACHES: dict[str, str] = {
    "asperity.theories.rough.predictor.predictor": (
        "the tables do not change; reading and fitting them takes 20 ms, and each of a sweep of predictions needs them"
    ),
    "asperity.theories.rough.predictor_stress.stresses": (
        "the tables do not change; reading and fitting them takes 50 ms, and each of a sweep of predictions needs them"
    ),
    "asperity.core.engine.blocks._compile_beside": "one process for all engines of a process, started at most once",
    "asperity.contact.solvers.active_set.spline_model.octaves": (
        "follows from the grid; 30 µs, and every grid of a solve, of 10 ms at 256², asks four times"
    ),
    "asperity.core.parameters._objects": (
        "the annotations of a function never change; reading them takes 50 µs, and every generator that "
        "is called needs them"
    ),
    "asperity.core.quadrature.rule": (
        "Gauss nodes and weights by their number: 96 take 3 ms, nine tenths of the time of a theory's curve"
    ),
    "asperity.core.parameters.parameters": (
        "a declaration never changes; reading it takes 50 µs, and every theory that is made needs it"
    ),
    "asperity.core.settings.json_schema": (
        "follows from the table; it takes 0.18 s for a document, and every document that is refused needs it"
    ),
    "asperity.run.document.document_model": (
        "follows from the parts, which do not change; building it takes 20 ms, and every case of a study "
        "is checked by it"
    ),
    "asperity.solids.library.kinds": (
        "the annotations of a class never change; reading them takes 0.2 ms, and each of 44 records needs "
        "them, a quarter of the time of `asperity materials`"
    ),
    "asperity.io.codec._columns": "the fields of a type do not change; a file of a history asks for them in every step",
    "asperity.io.codec._hints": (
        "the types of the fields of a type do not change; looking them up takes 0.1 ms, which a file of a "
        "history does in every step"
    ),
    "asperity.io.description._version": (
        "installed packages do not change; reading a version takes 0.7 ms, and every case of a study and "
        "every file needs four"
    ),
    "asperity.parts.registry.parts": (
        "installed packages do not change; looking them up takes 10 ms, and every document needs its parts"
    ),
    "asperity.solids.compliance.creep._layered_creep": (
        "follows from the bodies; a fit may take a second, and every solve of a history that is continued needs it"
    ),
    "asperity.contact.operators.convolution.octaves_of": (
        "follow from the body; 3 to 10 ms for 32 sublayers, and every solve of such a body needs them"
    ),
    "asperity.contact.solvers.active_set.spline_model._fit": (
        "follows from body, boundary and grid; 1 ms, and every solve, of 10 ms at 256², needs it on four or five grids"
    ),
    "asperity.contact.solvers.active_set.spline_model._levels": (
        "follow from body, boundary and grid; 0.3 ms, and every grid of a solve, of 10 ms at 256², asks twice"
    ),
    "asperity.contact.solvers.active_set.spline_model._samples": (
        "follows from the grid; 0.8 ms, and every solve, of 10 ms at 256², needs it on four or five grids"
    ),
    "asperity.core.engine.spline_levels.layout": (
        "follows from the shape; it takes 0.03 ms, and every solve needs it on four or five grids"
    ),
    "asperity.core.engine.vectors._layout": (
        "follows from the shape alone; it takes 0.1 ms, and every solve needs it on four or five grids"
    ),
    "asperity.core.engine.cpu._keep_freed_memory": "the allocator of a process is told once",
    "asperity.core.units._factor": (
        "the value of a unit never changes; pint takes 50 µs to find it, and a campaign calls it 10⁵ times"
    ),
    "asperity.theories.subsurface.shakedown._cylinder": (
        "follows from the friction alone; it takes a second, and every case of a study of passes asks for it"
    ),
    "asperity.core.units.dimension": (
        "follows from the unit; the unit of an expression is sought among the 25 of the package, each of which takes "
        "20 µs"
    ),
    "asperity.theories.rough.bush_gibson_keogh._log_ellipse": (
        "one table of ellipses, which takes 5 ms to build and does not change"
    ),
    "asperity.theories.rough.bush_gibson_keogh._log_moment": (
        "four tables of moments of the normal distribution, which take 0.1 s to build and do not change"
    ),
    "asperity.core.units._registry": (
        "pint's registry takes a tenth of a second to build and does not change afterwards"
    ),
}
"""Reason by dotted name of the cached function."""
