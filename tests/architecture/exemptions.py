"""What goes past a soft house limit or keeps a cache, each with its reason. An entry that is not in use fails."""

from __future__ import annotations

LIMITS: dict[str, dict[str, str]] = {
    "file lines": {},
    "function lines": {
        "asperity.core.engine.kernels.survey_capped": "one pass over memory for all sums; splitting it would read the fields twice",
        "asperity.contact.assemble.assemble": "one line for each field of the result",
        "asperity.contact.wet.solve_wet": "one line for each field of the result; no loop and no nesting",
        "asperity.studies.compare.compare": "one line for each field of the comparison; no loop and no nesting",
        "asperity.contact.solve.solve": "one call per stage, laid out by the formatter; no loop and no nesting",
        "asperity.contact.solvers.conjugate_gradient._conjugate_step": (
            "one iteration in the order of the paper; its parts share seven arrays"
        ),
        "asperity.surfaces.surface.Surface.__init__": "one check for each way a height map can be unusable",
    },
    "parameters": {
        "asperity.core.engine.kernels.survey": "a compiled pass takes its arrays and numbers one by one",
        "asperity.core.engine.kernels.survey_capped": "a compiled pass takes its arrays and numbers one by one",
        "asperity.core.engine.kernels.mark_face": "a compiled pass takes its arrays and numbers one by one",
        "asperity.core.engine.kernels.fill_face": "a compiled pass takes its arrays and numbers one by one",
        "asperity.core.engine.kernels.violation": "a compiled pass takes its arrays and numbers one by one",
        "asperity.core.engine.kernels.mark_elastic": "a compiled pass takes its arrays and numbers one by one",
        "asperity.core.engine.face_kernels.lay_change": "a compiled pass takes its arrays and numbers one by one",
        "asperity.core.engine.face_kernels.gather": "a compiled pass takes its arrays and numbers one by one",
        "asperity.core.engine.face_kernels.direct": "a compiled pass takes its arrays and numbers one by one",
        "asperity.core.engine.face_kernels.advance": "a compiled pass takes its arrays and numbers one by one",
        "asperity.core.engine.face_kernels.move": "a compiled pass takes its arrays and numbers one by one",
        "asperity.core.engine.face_kernels.scale": "a compiled pass takes its arrays and numbers one by one",
        "asperity.core.engine.cell_kernels.stiffen": "a compiled pass takes its arrays and numbers one by one",
        "asperity.core.engine.cell_kernels.deflect": "a compiled pass takes its arrays and numbers one by one",
        "asperity.core.engine.cell_kernels.relieve": "a compiled pass takes its arrays and numbers one by one",
        "asperity.cli.contact.contact": "one group of options each, in the order of the help",
        "asperity.report.write.write_report": "independent keyword-only parts of a report, each with a default",
        "asperity.contact.assemble.assemble": "gathers what the separate stages of a solve produced, in one place",
        "asperity.contact.path.solve_path": "the choices of solve, for a sequence of controls",
        "asperity.contact.path.steps": "the choices of solve, for a sequence of controls",
        "asperity.contact.solve.solve": "independent keyword-only choices of the user, each with a default",
        "asperity.contact.sliding.solve_sliding": "the choices of solve, with friction and its direction",
        "asperity.contact.wet.solve_wet": "the choices of solve, with a film, friction and when to stop",
        "asperity.studies.compare.compare": "independent keyword-only choices of the user, each with a default",
        "asperity.stress.compute.stress": "independent keyword-only choices of the user, each with a default",
        "asperity.stress.compute.stress_planes": "independent keyword-only choices of the user, each with a default",
        "asperity.io.disk_surface.save_gaussian": "independent keyword-only choices of the user, most with a default",
        "asperity.io.tiles.save_endless": "independent keyword-only choices of the user, each with a default",
        "asperity.surfaces.generate.bimodal.bimodal": "two textures, their patches, and what joins them, each a keyword",
        "asperity.surfaces.generate.bimodal.particles": "independent keyword-only numbers of the particles, most with a default",
        "asperity.surfaces.generate.rank_ordered.rank_ordered": "independent keyword-only choices of the user, most with a default",
        "asperity.surfaces.generate.translation.translated": "independent keyword-only choices of the user",
        "asperity.surfaces.generate.digital_filter.digital_filter": "independent keyword-only choices of the user, most with a default",
        "asperity.surfaces.generate.digital_filter.endless": "independent keyword-only choices of the user, most with a default",
        "asperity.surfaces.generate.textures.laser_bumps": "the constants of the formula, each a keyword",
        "asperity.surfaces.generate.weierstrass.weierstrass_mandelbrot": "the constants of the published formula, each a keyword",
        "asperity.surfaces.generate.weierstrass.weierstrass_mandelbrot_profile": "the constants of the published formula, each a keyword",
    },
    "public methods": {
        "asperity.core.engine.cpu_face.CpuFace": "the passes of the protocol",
        "asperity.core.engine.generic_face.ArrayFace": "the passes of the protocol",
        "asperity.core.engine.protocol.Face": "one method per pass over a working set; the solver is written once against them",
        "asperity.core.engine.protocol.Engine": "one method per pass over memory; the solver is written once against them",
        "asperity.core.engine.cpu.CpuEngine": "the passes of the protocol",
        "asperity.core.engine.generic.ArrayEngine": "the passes of the protocol",
    },
}
"""Reason by limit and dotted name. It says why splitting would read worse; "it is long" is none."""

CACHES: dict[str, str] = {
    "asperity.core.units._factor": "the value of a unit never changes; pint takes 50 µs to find it, and a campaign asks 10⁵ times",
    "asperity.core.units._registry": "pint's registry takes a tenth of a second to build and does not change afterwards",
}
"""Reason by dotted name of the cached function."""
