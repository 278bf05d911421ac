"""Contact of grooves without end whose section is a line scan."""

from __future__ import annotations

from ..core.errors import InputError
from ..solids.elastic import Rigid
from ..solids.layers import Body
from ..surfaces.prepare.level import require_complete
from ..surfaces.profile import Profile
from ..surfaces.surface import strip
from .boundary import FreeLine, Periodic
from .problem import ContactProblem


def line_problem(
    profile: Profile,
    body: Body,
    *,
    counter_body: Body = Rigid(),
    length: float = 1.0,
    datum: float | None = None,
) -> ContactProblem:
    """Problem of the line contact of ``profile``: plane strain, grooves without end along y.

    A closed profile repeats in x; any other lies alone, and has no absolute displacement: its
    approach is counted from a line at the ``datum``. Give further physics with ``with_physics``.
    Raises InputError if points are missing, the length is not positive, or a closed profile has a
    datum.

    Parameters
    ----------
    profile
        Line scan, levelled and complete; a trace at a known angle to its grooves is turned across
        them (``Profile.across_lay``), one without is taken to run across them.
    body, counter_body
        The body that has the profile, and the smooth one; rigid by default.
    length
        Length in m along y that forces and areas belong to.
    datum
        Distance in m at which the displacement is called zero, at least the length of the profile
        (see ``FreeLine``).
    """
    surface = strip(profile, length)
    require_complete(surface, "pressed")
    if profile.periodic and datum is not None:
        raise InputError(
            "datum of a line contact must be left out for a closed profile, whose mean displacement is defined."
        )
    boundary = Periodic() if profile.periodic else FreeLine(datum)
    return ContactProblem(surface, body, counter_body=counter_body, boundary=boundary)
