"""The program ``asperity``, also ``python -m asperity``: the command line."""

import sys

from .cli.interrupt import INTERRUPTED, SENTENCE


def run() -> None:
    """Run the program with the arguments of the process; never returns.

    An interrupt while libraries are imported ends as one during the work.
    """
    try:
        from .cli.main import run as command_line

        command_line()
    except KeyboardInterrupt:
        sys.stderr.write(f"asperity: {SENTENCE}\n")
        sys.exit(INTERRUPTED)


if __name__ == "__main__":
    run()
