"""The console of the answers, for whatever reads them."""

from __future__ import annotations

import os
import sys

from rich.console import Console


class Answers(Console):
    """Console that falls silent when its reader has gone, as in ``asperity materials | head``."""

    def on_broken_pipe(self) -> None:
        """Drop the rest of the text; the exit code stays that of the work and not that of the reader."""
        self.quiet = True
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)
