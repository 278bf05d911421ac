"""Animated pictures of an outcome: the plastic zones of the steps of its history."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ..core.errors import InputError
from ..physics.indentation.part import PREFIX as INDENTED
from ..physics.indentation.part_passes import PREFIX as PASSED
from ..physics.plastic_flow.figures import Cut, save_cuts, step_label
from ..physics.plastic_flow.part import PREFIX as FLOW
from ..physics.plastic_flow.work_values import picture_of
from ..run.execute import Outcome


def save_plastic_animation(outcome: Outcome, path: str | Path, *, overwrite: bool = False) -> Path:
    """Write the plastic zones of every step of ``outcome`` as an animated picture (.gif, .png or
    .webp).

    Those of the volume below the rough contact, or where it has none of this, those of its repeated
    passes or of its indentation.

    Raises
    ------
    InputError
        If the outcome has no history with plastic flow, or the suffix is another.
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    return save_cuts(plastic_cuts(outcome), path, overwrite=overwrite)


def save_animation(outcome: Outcome, path: str | Path, *, overwrite: bool = False) -> Path:
    """The animation of what goes on in the ``outcome``: wear, where something wears, else the
    plastic zones; errors as for either."""
    if "wear" not in outcome.found:
        return save_plastic_animation(outcome, path, overwrite=overwrite)
    from .animation_wear import save_wear_animation

    return save_wear_animation(outcome, path, overwrite=overwrite)


def plastic_cuts(outcome: Outcome) -> tuple[Cut, ...]:
    """The cut through the largest plastic strain after every step of ``outcome``; errors as for
    ``save_plastic_animation``."""
    found = outcome.found
    if FLOW in found and outcome.path is not None and len(outcome.path.steps) > 1:
        facts: Mapping[str, Any] = found[FLOW].detail
        shown, row, made = picture_of(FLOW, found[FLOW].values, facts).cut, int(facts["row"]), []
        for number, step in enumerate(outcome.path.steps, start=1):
            strain = np.zeros_like(shown.strain)  # all steps have the depth cells of the last
            accumulated = step.require_plastic_flow().accumulated
            if accumulated.size:
                strain[:, : accumulated.shape[0]] = accumulated[:, :, row].T
            made.append(replace(shown, strain=strain, label=step_label(number, step.approach, step.force)))
        return tuple(made)
    for name in (PASSED, INDENTED):
        run = found[name].detail.run if name in found else None
        if run is not None:
            shown = picture_of(name, found[name].values, found[name].detail.facts).cut
            frames = zip(run.strains, run.labels, strict=True)
            return tuple(replace(shown, strain=strain, label=label) for strain, label in frames)
    raise InputError(
        "outcome of an animation must have a history with plastic flow, but has none. Run a problem with "
        "{plastic_flow.active=true} and steps, {passes.count} or {indentation.depth}; a file keeps no steps "
        "of these two.",
        subject="outcome of an animation",
    )
