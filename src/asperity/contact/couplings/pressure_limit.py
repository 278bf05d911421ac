"""A limit of the pressure that does not change with depth, or none: what is beyond it stays as a permanent indentation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.arrays import RealArray
from ..law import InterfaceLaw, work_density
from .protocol import Contact, Coupling, Exchange, Memory, Posed, Share


def added_indentation(contact: Contact) -> RealArray:
    """Permanent indentation (nx, ny) in m that ``contact`` adds: the overlap of the bodies where the pressure is at its limit."""
    if contact.qp.elastic:
        return np.zeros_like(contact.qp.profile)
    p = contact.pressure
    return np.where((p > 0.0) & (p >= contact.cap), np.maximum(contact.overlap, 0.0), 0.0)


def indentation_before(posed: Posed, memory: Memory) -> RealArray:
    """Permanent indentation (nx, ny) in m in the ``memory`` of the interface."""
    return memory["indentation"] if "indentation" in memory else np.zeros_like(posed.profile)


def indented(law: InterfaceLaw, memory: Memory, contact: Contact) -> Memory:
    """Indentation (m), left out where there is none, and plastic work (J) since the virgin surface, after ``contact``; ``memory`` is what they were before."""
    if contact.qp.elastic:
        return {"work": np.zeros(()), **memory}
    first = indentation_before(contact.posed, memory)
    last = first + added_indentation(contact)
    work = float(work_density(law, first, last).sum()) * contact.posed.operator.grid.pixel_area
    return {"indentation": last, "work": np.asarray(float(memory.get("work", 0.0)) + work)}


@dataclass(frozen=True)
class ConstantHardness(Coupling):
    """Limit of the pressure that does not change with depth, or none at all: passive."""

    law: InterfaceLaw
    name: ClassVar[str] = "hardness"
    feedback: ClassVar[bool] = False
    remedy: ClassVar[str] = ""

    @property
    def bounds(self) -> bool:
        """Whether it limits the pressure everywhere."""
        return bool(np.all(np.isfinite(self.law.pressure_cap())))

    @property
    def cap(self) -> RealArray | float:
        """The limit."""
        return self.law.pressure_cap()

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """The indentation so far, (nx, ny) in m; of no points where there is none."""
        before = memory.get("indentation", np.zeros(0))
        return Exchange(before, before, note=memory)

    def share(self, exchange: Exchange) -> Share:
        """The limit, and the indentation before the step, if there is one, as a lift."""
        return Share(lift=exchange.x if exchange.x.any() else 0.0, cap=self.law.pressure_cap())

    def end(self, exchange: Exchange, contact: Contact) -> tuple[Memory, None]:
        """Indentation and work."""
        return indented(self.law, exchange.note, contact), None
