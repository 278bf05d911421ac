"""Text from outside, read with a limit."""

from __future__ import annotations

from pathlib import Path

from .errors import FileFormatError

LARGEST = 4 * 2**20
"""Bytes of a document or materials file; the largest of this package have a few thousand."""


def require_file(path: str | Path, what: str) -> Path:
    """``path`` of an ordinary file; ``what`` it is called in messages.

    Raises
    ------
    FileFormatError
        If it is missing, a folder, pipe or device, or no possible name.
    """
    file = Path(path)
    try:
        file.stat()
    except FileNotFoundError:
        raise FileFormatError(f"{what} must exist, but {file} does not; check the path.") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise FileFormatError(f"{what} must be readable, but {file} is not: {reason}.") from None
    if not file.is_file():
        kind = "folder; name the file in it" if file.is_dir() else "pipe or device"
        raise FileFormatError(f"{what} must be a file, but {file} is a {kind}.")
    return file


def read_text(path: str | Path, what: str) -> str:
    """Content of the text file at ``path`` in UTF-8; errors as of ``require_file``.

    Raises
    ------
    FileFormatError
        If it is unreadable, no text in UTF-8, or larger than ``LARGEST``.
    """
    file = require_file(path, what)
    try:
        with file.open("rb") as source:
            content = source.read(LARGEST + 1)
    except OSError as error:
        raise FileFormatError(f"{what} must be readable, but {file} is not: {error.strerror}.") from None
    if len(content) > LARGEST:
        raise FileFormatError(f"{what} must have at most {LARGEST // 2**20} MiB, but {file} is larger.")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise FileFormatError(f"{what} must be text in UTF-8, but {file} is not; save it as UTF-8.") from None
