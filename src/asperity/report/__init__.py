"""Layer 5: one HTML file that tells everything about a result, or about a surface."""

from .roughness import write_roughness_report
from .write import write_report

__all__ = ["write_report", "write_roughness_report"]
