"""``python -m judge --count 10000`` in ``tests/`` judges as many random problems and writes the
tables of ``docs/develop/judge.md``."""

from __future__ import annotations

import argparse
import os
import sys
from datetime import datetime, time
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("ASPERITY_THREADS", "1")

from judge.judge import Verdict, all_judged, table

PAGE = Path(__file__).parents[2] / "docs" / "develop" / "judge.md"
MARK = "<!-- written by python -m judge -->\n"


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m judge", description=__doc__)
    parser.add_argument("--count", type=int, default=10000, help="number of problems")
    parser.add_argument("--first", type=int, default=0, help="seed of the first one")
    parser.add_argument("--processes", type=int, default=1, help="processes that solve at a time")
    parser.add_argument("--until", type=time.fromisoformat, help="time of day such as 22:30 after which none is begun")
    parser.add_argument("--keep", action="store_true", help="leave the page as it is, and print the tables")
    asked = parser.parse_args()
    verdicts: list[Verdict] = []
    for each in all_judged(range(asked.first, asked.first + asked.count), asked.processes):
        verdicts.append(each)
        if each.outcome != "right":
            sys.stdout.write(f"{each.seed} {each.kind} {each.outcome}: {each.cause}\n")
            sys.stdout.flush()
        if asked.until is not None and datetime.now().time() >= asked.until:
            break
    text = f"Problems of the seeds {verdicts[0].seed} to {verdicts[-1].seed}:\n\n{table(verdicts)}"
    if asked.keep:
        sys.stdout.write(text)
        return
    before = PAGE.read_text(encoding="utf-8").split(MARK)[0]
    PAGE.write_text(f"{before}{MARK}\n{text}", encoding="utf-8")


if __name__ == "__main__":
    main()
