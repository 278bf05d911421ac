"""A worker process: one task a line on standard input, one answer a line on standard output.

Started as ``python -m asperity.studies.worker``, so that neither the script nor the notebook that
runs a study is imported again. It ends when its input ends, that is with the process that started
it, even amid a task.
"""

from __future__ import annotations

import json
import os
import sys
import threading
from queue import SimpleQueue
from typing import IO

from .executors import call


def main() -> None:
    """Answer tasks until the input ends."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what libraries print must not get between the answers
    lines: SimpleQueue[str] = SimpleQueue()
    threading.Thread(target=_read, args=(sys.stdin, lines), daemon=True).start()
    while True:
        order = json.loads(lines.get())
        answers.write(json.dumps(call(order["function"], order["task"])) + "\n")
        answers.flush()


def _read(source: IO[str], lines: SimpleQueue[str]) -> None:
    for line in source:
        lines.put(line)
    os._exit(0)


if __name__ == "__main__":
    main()
