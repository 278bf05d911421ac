"""The stresses that are asked for of a contact: sections, profiles and maxima, from planes that need not fit in memory together."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from ..core.arrays import RealArray
from ..core.citations import citation_keys
from ..core.progress import NoProgress, Progress
from .compute import stress_planes
from .cuts import cut, wanted_lines
from .field import StressField
from .maxima import InterfaceMaxima, Maxima, RegionMaxima
from .regions import planes
from .request import Contact, StressRequest
from .survey_depths import line_depths, survey_depths, wants_lines
from .yielding import YieldReport, first_yield


@dataclass(frozen=True, eq=False)
class SurveyedSection:
    """A vertical plane: its stresses, and the ``quantities`` that it is to show."""

    field: StressField
    quantities: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class StressSurvey:
    """What was asked for, and found.

    ``depths`` are those of all planes, on which the maxima and the onset of yield rest. Sections and profiles end where
    the contact is no longer felt, or as asked; the interfaces below that are planes, too.
    """

    request: StressRequest
    result: Contact
    depths: RealArray
    sections: tuple[SurveyedSection, ...]
    profiles: tuple[StressField, ...]
    maxima: tuple[RegionMaxima, ...]
    interfaces: tuple[InterfaceMaxima, ...]
    yielding: YieldReport
    citation_keys: tuple[str, ...]
    threads: int | None = None

    def planes(self, depths: Iterable[float]) -> Iterator[StressField]:
        """Whole planes at ``depths`` in m, one by one, computed anew."""
        return _planes(self.request, self.result, depths, self.threads)


def survey(
    request: StressRequest,
    result: Contact,
    *,
    lines: bool = True,
    threads: int | None = None,
    progress: Progress = NoProgress(),
) -> StressSurvey:
    """Compute the stresses of ``request`` in the contact ``result``.

    The planes are computed once for the maxima, and a second time where sections or profiles go through these.

    Parameters
    ----------
    request, result
        What is wanted, and of what contact.
    lines
        Whether to keep sections and profiles, or only the maxima on the same planes.
    threads
        Number of threads.
    progress
        Told after each plane: the number of planes done, and as error the share of all that is left.

    Raises
    ------
    InputError
        As of ``stress``.
    """
    depths = survey_depths(request, result)
    maxima = Maxima(threads)
    shown = line_depths(request, result) if lines and wants_lines(request) else np.zeros(0)
    body = getattr(result.problem, request.of)
    tracked = _Tracked(progress, sum(len(planes(body, d)) for d in (depths, shown) if d.size))
    found = tracked.planes(_planes(request, result, depths, threads))
    report = first_yield(maxima.watching(found), request.criterion)
    wanted = wanted_lines(request, result, maxima.drawn) if shown.size else {}
    again = tracked.planes(_planes(request, result, shown, threads)) if wanted else iter(())
    named = list(zip(wanted.values(), cut(again, list(wanted), result), strict=True))
    return StressSurvey(
        request,
        result,
        depths,
        tuple(SurveyedSection(field, quantities) for quantities, field in named if len(field.dims) == 2),
        tuple(field for _, field in named if len(field.dims) == 1),
        maxima.regions(),
        maxima.interfaces(),
        report,
        citation_keys(maxima, request),
        threads,
    )


def _planes(
    request: StressRequest, result: Contact, depths: Iterable[float], threads: int | None
) -> Iterator[StressField]:
    return stress_planes(
        result,
        [float(depth) for depth in depths],
        friction=request.friction,
        direction=request.direction,
        of=request.of,
        dtype=request.dtype,
        threads=threads,
    )


class _Tracked:
    """Counts planes and tells the progress."""

    def __init__(self, progress: Progress, total: int) -> None:
        self._progress, self._total, self._done = progress, total, 0

    def planes(self, fields: Iterator[StressField]) -> Iterator[StressField]:
        """The same ``fields``."""
        for field in fields:
            yield field
            self._done += 1
            self._progress.update(self._done, 1.0 - self._done / self._total, 0.0)
