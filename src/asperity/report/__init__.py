"""Layer 5: one HTML file that tells everything about a result."""

from .write import write_report

__all__ = ["write_report"]
