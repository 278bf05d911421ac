"""Names by which results give what their physics have found, with their types: for type checkers
and editors alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..physics.adhesion.answer import AdhesiveContact
    from ..physics.friction.answer import StickSlip
    from ..physics.friction.sliding import GrossSliding
    from ..physics.menisci.coupling import Menisci
    from ..physics.plastic_flow.answer import PlasticBody
    from ..physics.viscoelastic.moments import Creeping


class ResultNames:
    """What each coupling has found."""

    if TYPE_CHECKING:
        menisci: Menisci | None
        adhesion: AdhesiveContact | None
        plastic_flow: PlasticBody | None
        sliding: GrossSliding | None
        stick_slip: StickSlip | None
        creep: Creeping | None
        require_menisci: Callable[[], Menisci]
        require_adhesion: Callable[[], AdhesiveContact]
        require_stick_slip: Callable[[], StickSlip]
        require_plastic_flow: Callable[[], PlasticBody]
