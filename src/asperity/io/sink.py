"""HDF5 files under which the disk may run full."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import h5netcdf


class Sink(io.RawIOBase):
    """A file that keeps the first error of writing for ``check`` and goes on without raising it.

    A full disk under an open HDF5 file otherwise ends the whole process when the library closes it.
    """

    def __init__(self, path: Path) -> None:
        self._file = path.open("w+b", buffering=0)
        self._failed: OSError | None = None

    def check(self) -> None:
        """Raise the error that writing has met."""
        if self._failed is not None:
            raise self._failed

    def readable(self) -> bool:
        """Files of HDF5 are read while they are written."""
        return True

    def writable(self) -> bool:
        """Yes."""
        return True

    def seekable(self) -> bool:
        """Yes."""
        return True

    def seek(self, offset: int, whence: int = 0, /) -> int:
        """Go to ``offset``."""
        return self._file.seek(offset, whence)

    def tell(self) -> int:
        """Where the file stands."""
        return self._file.tell()

    def readinto(self, buffer: Any, /) -> int:
        """Read into ``buffer``."""
        return self._file.readinto(buffer) or 0

    def truncate(self, size: int | None = None, /) -> int:
        """Cut at ``size``; an error is kept."""
        try:
            return self._file.truncate(size)
        except OSError as error:
            self._failed = self._failed or error
            return size or 0

    def write(self, data: Any, /) -> int:
        """Write ``data``; an error is kept, and what follows is dropped."""
        view = memoryview(data)
        done = 0
        while self._failed is None and done < len(view):
            try:
                done += self._file.write(view[done:])
            except OSError as error:
                self._failed = error
        return len(view)

    def close(self) -> None:
        """Close the file."""
        self._file.close()
        super().close()


@contextmanager
def writable(path: Path) -> Iterator[tuple[h5netcdf.File, Sink]]:
    """A new file at ``path`` to be written; an error of the disk is raised only after the library
    has closed it."""
    import h5netcdf

    sink = Sink(path)
    try:
        with h5netcdf.File(sink, "w") as file:
            yield file, sink
    except Exception:
        sink.check()  # an error of the disk comes before the errors that followed from it
        raise
    else:
        sink.check()
    finally:
        sink.close()
