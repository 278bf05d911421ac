"""What the parts of a problem refuse, beside the tables of the form that it is about, while these
are filled in."""

from __future__ import annotations

import asyncio
import re

from nicegui import background_tasks, ui

from ..core.words import label_of
from .draft import Keys
from .layout import failure
from .session import Session

PAUSE = 0.5
"""Seconds without a change after which the document is looked at."""

BODIES = "Bodies: "
"""Beginning of the names of fields of the page of bodies in what is advised."""


class Refused:
    """Places beside the tables of a page for what is wrong with them.

    ``of_bodies`` is whether the page has the bodies, which take what is to be done there, too.
    """

    def __init__(self, session: Session, *, of_bodies: bool = False) -> None:
        self.session, self.of_bodies, self.turn = session, of_bodies, 0
        self.slots: dict[str, ui.element] = {}
        self.client = ui.context.client
        ui.timer(0.01, self.look, once=True)

    def slot(self, name: str) -> None:
        """Here stands what the table ``name`` is refused for; of an empty name, what is about no
        other table of the page."""
        self.slots[name] = ui.element("div").classes("refused").props(f'data-refused="{name}" role="status"')

    def later(self, keys: Keys = ()) -> None:
        """Look at the document when it has not changed for a while."""
        background_tasks.create(self.look())

    async def look(self) -> None:
        """Show what the document would be refused for now."""
        self.turn += 1
        turn = self.turn
        await asyncio.sleep(PAUSE)
        if turn != self.turn or self.client.is_deleted:
            return
        missing = self.session.draft.problems()
        found = [(self.place_of(text), text) for text in missing]
        if not missing:
            where = str(self.session.folder)
            answer = await self.session.helper.call("refused", table=dict(self.session.draft.table), folder=where)
            found = [(place, text) for place, text in answer.get("refused", ())]
            if "error" in answer and not answer.get("cancelled"):
                found.append(("", answer["error"]))
        if turn != self.turn or self.client.is_deleted:
            return
        for name, slot in self.slots.items():
            slot.clear()
            texts = [text for place, text in found if self.shown_at(name, place, text, known=not missing)]
            with slot:
                for text in dict.fromkeys(texts):
                    failure(self.session.said(text))

    def shown_at(self, name: str, place: str, text: str, *, known: bool) -> bool:
        """Whether what is about the table ``place`` stands at the slot ``name``; ``known`` is
        whether the document is complete otherwise."""
        if self.of_bodies and name == "body" and BODIES in text:
            return True
        table = place.partition(".")[0]
        return table == name if table in self.slots else known and not name and not self.of_bodies

    def place_of(self, text: str) -> str:
        """Table of the page with whose name the ``text`` begins; empty if there is none."""
        begun = (name for name in self.slots if name and re.match(rf"{re.escape(label_of(name))}\b", text))
        return max(begun, key=len, default="-")
