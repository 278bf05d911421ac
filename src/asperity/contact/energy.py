"""Energy balance by its earlier name."""

from __future__ import annotations

from .history import EnergyBalance, HistoryResult

__all__ = ["EnergyBalance", "energy_balance"]


def energy_balance(path: HistoryResult) -> EnergyBalance:
    """Energies along ``path``, see ``HistoryResult.energies``."""
    return path.energies
