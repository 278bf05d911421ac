"""Motion on rough interfaces: normal compliance, vibration, stick-slip, sliding blocks. A module is imported on first use of one of its names.

The stub beside this file lists the names and their modules, for type checkers too.
"""

from __future__ import annotations

from ...core.late import late_package

__getattr__, __dir__, _HOME = late_package(__name__, __file__)
__all__ = sorted(_HOME)
