"""Names by which problems give their physics and histories their energies: for type checkers and
editors alone. Each physics declares its own, in ``names``."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..physics.adhesion.names import AttractionEnergies, AttractionGiven, AttractionKeyword
    from ..physics.friction.names import FrictionEnergies, FrictionGiven, FrictionKeyword
    from ..physics.menisci.names import FilmEnergies, FilmGiven, FilmKeyword
    from ..physics.plastic_flow.names import FlowGiven, FlowKeyword
    from ..physics.sealing.names import FluidEnergies, FluidGiven, FluidKeyword
    from ..physics.viscoelastic.names import CreepEnergies

    class Keywords(FilmKeyword, FrictionKeyword, AttractionKeyword, FlowKeyword, FluidKeyword, total=False):
        """Physics of a ``ContactProblem`` by keyword."""

    class ProblemNames(FilmGiven, FrictionGiven, AttractionGiven, FlowGiven, FluidGiven):
        """What was given for each keyword."""

    class EnergyNames(FilmEnergies, FrictionEnergies, AttractionEnergies, CreepEnergies, FluidEnergies):
        """What each physics adds to the energies of a history."""

else:
    Keywords = dict

    class ProblemNames:
        """Nothing while a program runs."""

    class EnergyNames:
        """Nothing while a program runs."""
