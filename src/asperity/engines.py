"""Engines: libraries of arrays and transforms, for the processor or a GPU.

``CpuEngine`` is the default; ``GpuEngine`` works on a device by CuPy, and ``ArrayEngine`` with any
library of the array-API standard.
"""

from .core.late import late_names

late_names(__name__, __file__)
