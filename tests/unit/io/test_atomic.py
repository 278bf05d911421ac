"""Output appears whole or not at all."""

from __future__ import annotations

import errno
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from refusals import refused

from asperity.core.errors import InputError, OutputError
from asperity.io.atomic import atomic_file, atomic_folder, require_new_files


def names(folder: Path) -> set[str]:
    return {entry.name for entry in folder.iterdir()}


def test_file_appears_only_at_the_end(tmp_path: Path) -> None:
    with atomic_file(tmp_path / "a.txt") as partial:
        partial.write_text("new")
        assert partial.suffix == ".txt"
        assert partial.parent == tmp_path
        assert not (tmp_path / "a.txt").exists()
    assert (tmp_path / "a.txt").read_text() == "new"
    assert names(tmp_path) == {"a.txt"}


@pytest.mark.parametrize("failure", [KeyboardInterrupt, SystemExit, ValueError, MemoryError])
def test_failure_leaves_the_old_file_and_nothing_else(tmp_path: Path, failure: type[BaseException]) -> None:
    target = tmp_path / "a.txt"
    target.write_text("old")

    def write() -> None:
        with atomic_file(target, overwrite=True) as partial:
            partial.write_text("half")
            raise failure

    with pytest.raises(failure):
        write()
    assert target.read_text() == "old"
    assert names(tmp_path) == {"a.txt"}


def test_existing_file_is_kept_unless_overwritten(tmp_path: Path) -> None:
    target = tmp_path / "a.txt"
    target.write_text("old")
    with refused(OutputError, "output file", "a.txt"), atomic_file(target):
        pytest.fail("the body must not run")
    with atomic_file(target, overwrite=True) as partial:
        partial.write_text("new")
    assert target.read_text() == "new"


def test_file_made_meanwhile_is_not_overwritten(tmp_path: Path) -> None:
    target = tmp_path / "a.txt"
    with refused(OutputError, "output file"), atomic_file(target) as partial:
        partial.write_text("mine")
        target.write_text("theirs")
    assert target.read_text() == "theirs"
    assert names(tmp_path) == {"a.txt"}


def test_file_needs_a_folder_and_is_none(tmp_path: Path) -> None:
    with refused(OutputError, "output file"), atomic_file(tmp_path / "none" / "a.txt"):
        pytest.fail("the body must not run")
    with refused(OutputError, "output file"), atomic_file(tmp_path, overwrite=True):
        pytest.fail("the body must not run")


def test_full_disk_is_one_sentence_and_other_errors_pass(tmp_path: Path) -> None:
    with refused(OutputError, str(tmp_path / "a"), os.strerror(errno.ENOSPC)), atomic_file(tmp_path / "a"):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    with pytest.raises(InputError, match="unrelated"), atomic_file(tmp_path / "a"):
        raise InputError("unrelated")
    assert names(tmp_path) == set()


def test_a_failure_inside_a_new_folder_names_the_folder_that_was_asked_for(tmp_path: Path) -> None:
    with pytest.raises(OutputError) as raised, atomic_folder(tmp_path / "run") as folder, atomic_file(folder / "a.nc"):
        raise OSError(errno.ENOSPC, "No space left on device")
    assert raised.value.subject == str(tmp_path / "run" / "a.nc")
    assert ".partial" not in str(raised.value)


def test_folder_appears_only_at_the_end_with_its_parents(tmp_path: Path) -> None:
    target = tmp_path / "deep" / "run"
    with atomic_folder(target) as partial:
        (partial / "plots").mkdir()
        (partial / "plots" / "a.png").write_text("a")
        assert not target.exists()
    assert (target / "plots" / "a.png").read_text() == "a"
    assert names(target.parent) == {"run"}
    assert target.stat().st_mode == (tmp_path / "deep").stat().st_mode


@pytest.mark.parametrize("failure", [KeyboardInterrupt, OSError])
def test_failed_folder_leaves_nothing(tmp_path: Path, failure: type[BaseException]) -> None:
    def write() -> None:
        with atomic_folder(tmp_path / "run") as partial:
            (partial / "a").write_text("half")
            raise failure

    with pytest.raises(OutputError if failure is OSError else failure):
        write()
    assert names(tmp_path) == set()


def test_overwriting_a_folder_keeps_files_of_other_names(tmp_path: Path) -> None:
    target = tmp_path / "run"
    (target / "plots").mkdir(parents=True)
    (target / "plots" / "a.png").write_text("old")
    (target / "notes.txt").write_text("mine")
    with refused(OutputError, "output folder"), atomic_folder(target):
        pytest.fail("the body must not run")
    with atomic_folder(target, overwrite=True) as partial:
        (partial / "plots").mkdir()
        (partial / "plots" / "a.png").write_text("new")
    assert (target / "plots" / "a.png").read_text() == "new"
    assert (target / "notes.txt").read_text() == "mine"
    assert names(tmp_path) == {"run"}


def test_empty_folder_is_used_and_a_file_is_not(tmp_path: Path) -> None:
    (tmp_path / "run").mkdir()
    with atomic_folder(tmp_path / "run") as partial:
        (partial / "a").write_text("a")
    assert names(tmp_path / "run") == {"a"}
    (tmp_path / "file").write_text("")
    for path in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(OutputError), atomic_folder(path, overwrite=True):
            pytest.fail("the body must not run")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes")
def test_a_pipe_or_device_is_never_replaced(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    with refused(OutputError, "output file"), atomic_file(tmp_path / "pipe", overwrite=True):
        pass
    assert (tmp_path / "pipe").is_fifo()


def test_modes_and_links_survive(tmp_path: Path) -> None:
    """Of a file that is replaced the mode, of a link the link; of a folder what is not replaced,
    with its modes."""
    target, link = tmp_path / "a.txt", tmp_path / "link.txt"
    target.write_text("old")
    target.chmod(0o604)
    link.symlink_to(target)
    with atomic_file(link, overwrite=True) as partial:
        partial.write_text("new")
    assert link.is_symlink()
    assert target.read_text() == "new"
    assert target.stat().st_mode & 0o777 == 0o604
    folder, other = tmp_path / "run", tmp_path / "other"
    (folder / "plots").mkdir(parents=True)
    (folder / "plots" / "mine.txt").write_text("mine")
    (folder / "r.txt").write_text("old")
    (folder / "r.txt").chmod(0o600)
    (folder / "to").symlink_to("r.txt")
    folder.chmod(0o750)
    other.symlink_to(folder)
    with atomic_folder(other, overwrite=True) as partial:
        (partial / "r.txt").write_text("new")
    assert other.is_symlink()
    assert folder.stat().st_mode & 0o777 == 0o750
    assert (folder / "to").is_symlink()
    assert (folder / "r.txt").read_text() == "new"
    assert (folder / "r.txt").stat().st_mode & 0o777 == 0o600
    assert (folder / "plots" / "mine.txt").read_text() == "mine"
    assert names(tmp_path) == {"a.txt", "link.txt", "run", "other"}


@pytest.mark.parametrize("at_once", [True, False])
def test_a_kill_leaves_one_whole_folder_and_the_next_run_clears_up(tmp_path: Path, at_once: bool) -> None:
    """Killed at any of its system calls that rename or link, a run leaves the files of one run; the
    next removes the rest."""
    script = (
        "import os, sys\nfrom pathlib import Path\nfrom asperity.io import atomic\n"
        "if sys.argv[3] == '0':\n    atomic.ctypes.CDLL = lambda name: None\n"
        "left = int(sys.argv[2])\n"
        "def hook(event, args):\n"
        "    global left\n"
        "    if event in ('os.rename', 'os.link', 'os.mkdir', 'shutil.rmtree', 'os.remove'):\n"
        "        left -= 1\n"
        "        if left < 0:\n            os.kill(os.getpid(), 9)\n"
        "with atomic.atomic_folder(sys.argv[1], overwrite=True) as new:\n"
        "    (new / 'plots').mkdir()\n"
        "    for name in ('problem', 'result', 'plots/a'):\n        (new / name).write_text('new')\n"
        "    sys.addaudithook(hook)\n"
    )
    folder = tmp_path / "run"
    for killed_at in range(14):
        shutil.rmtree(folder, ignore_errors=True)
        (folder / "plots").mkdir(parents=True)
        for name in ("problem", "result", "plots/a", "notes"):
            (folder / name).write_text("old")
        done = subprocess.run([sys.executable, "-c", script, folder, str(killed_at), str(int(at_once))], check=False)
        found = (
            {(folder / name).read_text() for name in ("problem", "result", "plots/a")} if folder.exists() else {"old"}
        )
        assert len(found) == 1, killed_at
        with atomic_folder(folder, overwrite=True):
            pass
        assert names(tmp_path) == {"run"}
        assert (folder / "notes").read_text() == "old"
        if done.returncode == 0:
            break
    assert done.returncode == 0
    assert killed_at > 3


def test_inputs_are_no_outputs(tmp_path: Path) -> None:
    (tmp_path / "r.nc").write_text("result")
    (tmp_path / "link.nc").symlink_to(tmp_path / "r.nc")
    for name in ("r.nc", "link.nc"):
        with refused(OutputError, "output file"):
            require_new_files([tmp_path / name], overwrite=True, inputs=[tmp_path / "r.nc"])
    with refused(OutputError, "output files"):
        require_new_files([tmp_path / "a", tmp_path / ".." / tmp_path.name / "a"], overwrite=True)
    for make in (atomic_file, atomic_folder):
        too_long = tmp_path / ("ü" * 200)
        with refused(OutputError, str(too_long), os.strerror(errno.ENAMETOOLONG)), make(too_long):
            pass
    with atomic_file(tmp_path / ("ü" * 120)) as partial:
        partial.write_text("long, but possible")
