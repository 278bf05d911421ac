"""Adhesion: laws of attraction, branches and jumps, loops of approach and separation.

The laws are ``ExponentialAdhesion``, ``DugdaleAdhesion``, ``LinearAdhesion``,
``VanDerWaalsAdhesion``, ``LennardJonesAdhesion``, a ``CustomAdhesion`` of one's own, and
``JKRAdhesion`` of no range; ``work_of_adhesion`` is from surface energies. ``adhesion_loop`` and
``adhesion_cycle`` approach and part, ``adhesive_branch`` and ``adhesive_jumps`` follow all
equilibria, ``energy_bound`` is a bound of the energy, and ``AdhesiveContact`` is what a result
holds.
"""

from .core.late import late_names

late_names(__name__, __file__)
