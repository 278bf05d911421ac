"""Ramps by their earlier place."""

from __future__ import annotations

from .history import Ramped, ramps

__all__ = ["Ramped", "ramps"]
