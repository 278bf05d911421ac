"""Layer 6: self-contained HTML reports of results and of surfaces."""

from .roughness import write_roughness_report
from .write import write_report

__all__ = ["write_report", "write_roughness_report"]
