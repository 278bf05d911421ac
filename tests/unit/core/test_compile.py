"""Compiled passes on disk, of processes that compile one function at once."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

PASS = """
from asperity.core.engine.compile import passes


@passes()
def doubled(values):
    return values + values
"""

COMPILED_AT_ONCE = """
import sys, time
from pathlib import Path
import numpy as np
from summing import doubled

kind, here, saving = sys.argv[1], Path.cwd(), []
files = doubled._cache._cache_file
load, save = files._load_index, files.save


def read():
    index = load()
    if saving:  # the other process, too, has read the index before this one writes it
        (here / f"{kind}.read").touch()
        while len(list(here.glob("*.read"))) < 2:
            time.sleep(0.01)
    return index


def saved(key, data):
    saving.append(key)
    save(key, data)


files._load_index, files.save = read, saved
print(doubled(np.ones(3, kind)))
"""

READ = """
import numpy as np
from summing import doubled

for kind in ("float64", "float32"):
    values = doubled(np.ones(3, kind))
    assert values.dtype == kind and values.tolist() == [2.0, 2.0, 2.0]
"""


def test_processes_that_compile_at_once_find_no_code_of_the_other(tmp_path: Path) -> None:
    (tmp_path / "summing.py").write_text(PASS)
    paths = os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])
    variables = {**os.environ, "PYTHONPATH": paths, "NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    running = [
        subprocess.Popen([sys.executable, "-c", COMPILED_AT_ONCE, kind], env=variables, cwd=tmp_path)
        for kind in ("float64", "float32")
    ]
    assert [process.wait(timeout=300) for process in running] == [0, 0]
    files = [path.name for path in (tmp_path / "cache").rglob("*.nbc")]
    assert len(files) == 2, "each process has written a file of its own"
    read = subprocess.run([sys.executable, "-c", READ], env=variables, cwd=tmp_path, capture_output=True, text=True)
    assert read.returncode == 0, read.stderr
