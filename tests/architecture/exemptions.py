"""What goes past a soft house limit or keeps a cache, each with its reason. An entry that is not in use fails."""

from __future__ import annotations

LIMITS: dict[str, dict[str, str]] = {
    "function lines": {
        "assemble": "one line for each field of the result",
        "sweep": "what a kernel calls is compiled once more in each of its callers: in nine functions it took four times as long",
    },
    "parameters": {
        "app": "one for each option of the command line",
        "filter_waves": "independent keyword-only choices of the user, each with a default",
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
        "subtract_deflections": "a compiled pass takes its arrays and numbers one by one",
        "coupled_product": "a compiled pass takes its arrays and numbers one by one",
        "factorise_tensors": "a compiled pass takes its arrays and numbers one by one",
        "vector_deflections": "a compiled pass takes its arrays and numbers one by one",
        "_invariants": "a compiled pass takes its arrays and numbers one by one",
        "_tangential": "a compiled pass takes its arrays and numbers one by one",
        "_invariant": "a compiled pass takes its arrays and numbers one by one",
        "execute": "independent keyword-only choices of the callers, each with a default",
        "assemble": "gathers what the separate stages of a solve produced, in one place",
        "Prepared.__init__": "the choices of solve, for all steps of a history",
        "compare": "independent keyword-only choices of the user, each with a default",
        "roll": "independent keyword-only choices of the user, each with a default",
        "roll_rough": "independent keyword-only choices of the user, each with a default",
        "creep_curve": "independent keyword-only choices of the user, each with a default",
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
    },
}
"""Reason by limit and place of the definition in its module (``Class.method``), whatever module that is. A reason is why splitting would read worse; "it is long" is none."""

CACHES: dict[str, str] = {
    "asperity.core.parameters._objects": "the annotations of a function never change; reading them takes 50 µs, and every generator that is called needs them",
    "asperity.core.quadrature._rule": "Gauss nodes and weights by their number: 96 take 3 ms, nine tenths of the time of a theory's curve",
    "asperity.core.parameters.parameters": "a declaration never changes; reading it takes 50 µs, and every theory that is made needs it",
    "asperity.core.settings.json_schema": "follows from the table; it takes 0.18 s for a document, and every document that is refused needs it",
    "asperity.run.document.document_model": "follows from the parts, which do not change; building it takes 20 ms, and every case of a study is checked by it",
    "asperity.parts.registry.parts": "installed packages do not change; looking them up takes 10 ms, and every document needs its parts",
    "asperity.core.units._factor": "the value of a unit never changes; pint takes 50 µs to find it, and a campaign calls it 10⁵ times",
    "asperity.core.units._registry": "pint's registry takes a tenth of a second to build and does not change afterwards",
}
"""Reason by dotted name of the cached function."""
