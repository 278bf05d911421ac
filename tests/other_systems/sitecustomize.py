"""Takes from an interpreter what Windows does not have, and refuses what Windows refuses.

Python imports this module at its start if its folder is on the path. No modules ``fcntl``,
``resource`` and the like; no copies of processes, groups of processes and their signals; no links
that follow none; no file that is open, or mapped into memory, can be renamed, replaced or removed;
no name with a character that Windows keeps for itself can be written.
"""

from __future__ import annotations

import ctypes
import importlib.abc
import importlib.util
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

MODULES = {"fcntl", "resource", "pwd", "grp", "termios", "tty", "pty", "syslog"}
FUNCTIONS = {
    *("forkpty", "killpg", "getpgid", "setsid", "nice", "getuid", "geteuid", "getgid", "fchmod", "mkfifo"),
    *("sysconf", "sysconf_names", "sched_getaffinity", "O_NOFOLLOW", "O_NONBLOCK"),
}
SIGNALS = {"SIGKILL", "SIGHUP", "SIGUSR1", "SIGUSR2", "SIGALRM"}
RESERVED = set('<>:"|?*')


class Absent(importlib.abc.MetaPathFinder):
    """Finds none of the ``MODULES``."""

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> None:
        if name in MODULES:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)


def lies_in(path: str, folder: str) -> bool:
    return path == folder or path.startswith(folder + os.sep)


def used(path: str) -> bool:
    """Whether this process has ``path``, or a file in it, open or mapped into memory."""
    full = str(Path(path).absolute())
    for number in list(Path("/proc/self/fd").iterdir()):
        try:
            target = number.readlink()
        except OSError:  # that of the listing itself
            continue
        if lies_in(str(target), full) and not target.is_dir():
            return True
    with Path("/proc/self/maps").open(encoding="utf-8", errors="replace") as maps:
        return any(lies_in(fields[5].strip(), full) for line in maps if len(fields := line.split(maxsplit=5)) == 6)


def refuse(event: str, arguments: tuple[Any, ...]) -> None:
    """Refuse an ``event`` as Windows would."""
    if event in ("os.rename", "os.remove", "os.rmdir"):
        ends = arguments[:2] if event == "os.rename" else arguments[:1]
        for path in map(os.fsdecode, ends):
            if used(path):
                raise PermissionError(13, "the file is used by a process", path)
    elif event in ("open", "os.mkdir") and isinstance(arguments[0], str | bytes | os.PathLike):
        path = os.fsdecode(arguments[0])
        writes = event == "os.mkdir" or (isinstance(arguments[1], str) and set(arguments[1]) & set("wax+"))
        if writes and set(path) & RESERVED:
            raise OSError(22, "the name has a character that no file can have", path)


def link(source: Any, target: Any, *, follow_symlinks: bool = True, made: Any = os.link, **folders: Any) -> None:
    if folders or not follow_symlinks:
        raise NotImplementedError("link: follow_symlinks unavailable on this platform")
    made(source, target)


class Library(ctypes.CDLL):
    """A library; that of the process itself has no functions of the system."""

    def __getattr__(self, name: str) -> Any:
        if self._name is None and name.startswith("rename"):
            raise AttributeError(name)
        return super().__getattr__(name)


def kill(process: subprocess.Popen[Any]) -> None:
    process.send_signal(9)


def fork() -> int:
    """What knows its system does not call this; there is no copy in any case."""
    raise OSError(38, "there are no copies of processes")


found = importlib.util.find_spec
importlib.util.find_spec = lambda name, package=None: None if name in MODULES else found(name, package)
sys.meta_path.insert(0, Absent())
for module in MODULES & sys.modules.keys():
    del sys.modules[module]
for holder, names in ((os, FUNCTIONS), (signal, SIGNALS)):
    for name in names:
        if hasattr(holder, name):
            delattr(holder, name)
os.link, os.fork, ctypes.CDLL = link, fork, Library
subprocess.Popen.kill = kill
sys.addaudithook(refuse)
