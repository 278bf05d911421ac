"""The program ``asperity``, also ``python -m asperity``: the command line."""

import os
import sys

from .cli.interrupt import INTERRUPTED, SENTENCE

ONE_THREAD = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
"""Variables that give products of small matrices one thread, where they are not set: transforms and
compiled passes take nearly all of the time, and the idle threads of BLAS keep processors busy that
these or other programs wait for (twice the time of a history with friction beside a full load)."""


def run() -> None:
    """Run the program with the arguments of the process; never returns.

    An interrupt while libraries are imported ends as one during the work.
    """
    for name in ONE_THREAD:
        os.environ.setdefault(name, "1")
    try:
        from .cli.main import run as command_line

        command_line()
    except KeyboardInterrupt:
        sys.stderr.write(f"asperity: {SENTENCE}\n")
        sys.exit(INTERRUPTED)


if __name__ == "__main__":
    run()
