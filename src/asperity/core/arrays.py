"""Names for the array types used in signatures."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

RealArray: TypeAlias = NDArray[np.floating[Any]]
"""Real floating-point array, SI values."""

ComplexArray: TypeAlias = NDArray[np.complexfloating[Any, Any]]
"""Complex array, usually a half spectrum of shape (nx, ny // 2 + 1)."""

BoolArray: TypeAlias = NDArray[np.bool_]
"""Boolean array, for masks and contact maps."""
