"""Sealing: flow through the gap, leak rates, throats, flow factors.

``leakage`` takes a contact, a ``ViscousLiquid`` or an ``IdealGas`` and two pressures, and gives a
``Leakage``; ``flow_through`` and ``flow_tensor`` take any gap. ``closing_load`` finds where the gap
closes, ``tabulated_flow_factors`` the factors of Patir and Cheng for codes of mixed
lubrication.
"""

from .core.late import late_names

late_names(__name__, __file__)
