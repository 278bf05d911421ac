"""What wet contacts hold in files of format 2."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from ...io.description import rebuild
from .coupling import Menisci
from .film import wetting

if TYPE_CHECKING:
    from ...io.format2 import Older


def older(at: Older) -> tuple[Menisci, None] | None:
    """The menisci of a contact or step, whose memory is stored; None without a film."""
    film, numbers = at.problem.film, at.values.get("film_menisci", at.values.get("menisci"))
    if film is None or numbers is None:
        return None
    stands = wetting(at.values["gap"], at.values["pressure"] > 0.0, film, wraps=at.problem.boundary.wraps)
    return Menisci(film, stands, **{name: rebuild(value) for name, value in json.loads(numbers).items()}), None
