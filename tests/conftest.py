"""Set-up shared by all tests."""

from __future__ import annotations

import hashlib
import io
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import IO

import matplotlib.figure
import pytest
import reference_data
from hypothesis import settings
from matplotlib.lines import Line2D
from matplotlib.text import Text
from PIL import Image

matplotlib.use("Agg")

RENDER = matplotlib.figure.Figure.savefig
PIXEL = io.BytesIO()
Image.new("RGB", (1, 1)).save(PIXEL, "png")

IN_CI = os.environ.get("CI", "").lower() in {"1", "true"}

settings.register_profile("default", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True, print_blob=True)
settings.load_profile("ci" if IN_CI else "default")


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Folder of measured topographies, which lies beside the repository and not in it."""
    folder = Path(__file__).parents[2] / "shared" / "data"
    if folder.is_dir():
        return folder
    message = f"the measured topographies are not at {folder}"
    if IN_CI and not os.environ.get("ASPERITY_WITHOUT_SCANS"):
        pytest.fail(f"{message}; CI must provide them, or say ASPERITY_WITHOUT_SCANS=1")
    pytest.skip(message)


@pytest.fixture(scope="session")
def reference() -> Callable[[str], list[reference_data.Row]]:
    """Reader of tests/reference/<name>.csv; ``from reference_data import reference`` serves in parametrisations."""
    return reference_data.reference


@pytest.fixture(scope="module")
def unrendered() -> Iterator[None]:
    """Figures are composed, but their file is one pixel with a digest of what they hold: rendering takes most of the time."""

    def save(figure: matplotlib.figure.Figure, file: str | Path | IO[bytes], **_: object) -> None:
        held = hashlib.sha256()
        for artist in figure.findobj():
            held.update(repr((type(artist), artist.get_label(), getattr(artist, "get_array", str)())).encode())
            held.update(repr(artist.get_text() if isinstance(artist, Text) else "").encode())
            held.update(repr(artist.get_xydata() if isinstance(artist, Line2D) else "").encode())
        content = PIXEL.getvalue() + held.digest()
        if isinstance(file, str | Path):
            Path(file).write_bytes(content)
        else:
            file.write(content)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(matplotlib.figure.Figure, "savefig", save)
        yield


@pytest.fixture
def rendered(monkeypatch: pytest.MonkeyPatch) -> None:
    """Figures are rendered after all."""
    monkeypatch.setattr(matplotlib.figure.Figure, "savefig", RENDER)
