"""Names by which results give what their physics have found: for type checkers and editors alone.
Each physics declares its own, in ``names_found``."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..physics.adhesion.names_found import AttractionFound
    from ..physics.friction.names_found import FrictionFound
    from ..physics.menisci.names_found import FilmFound
    from ..physics.plastic_flow.names_found import FlowFound
    from ..physics.sealing.names_found import FluidFound
    from ..physics.viscoelastic.names_found import CreepFound

    class ResultNames(FilmFound, FrictionFound, AttractionFound, FlowFound, CreepFound, FluidFound):
        """What each coupling has found."""

else:

    class ResultNames:
        """Nothing while a program runs."""
