from .core.engine import CpuEngine
from .core.engine.array_api import ArrayEngine
from .core.engine.gpu import GpuEngine

__all__ = ["ArrayEngine", "CpuEngine", "GpuEngine"]
