"""How a command ends that is interrupted (Ctrl-C), whatever has been imported by then."""

from __future__ import annotations

INTERRUPTED = 130
"""Exit code: 128 and the number of SIGINT, as of shells."""

SENTENCE = "Interrupted: the work was stopped and nothing is half-written."
