"""Set-up shared by all tests."""

from __future__ import annotations

import hashlib
import importlib
import io
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import IO, Any

import matplotlib.figure
import numpy as np
import pytest
import reference_data
from hypothesis import settings
from matplotlib.artist import Artist
from matplotlib.axis import Axis
from matplotlib.lines import Line2D
from matplotlib.text import Text
from matplotlib.transforms import Bbox
from numpy.typing import NDArray
from PIL import Image

from asperity.plots import picture

matplotlib.use("Agg")

RENDER = matplotlib.figure.Figure.savefig
PNG, CONTENT = picture.png, picture.content_of
PIXEL = io.BytesIO()
Image.new("RGB", (1, 1)).save(PIXEL, "png")

IN_CI = os.environ.get("CI", "").lower() in {"1", "true"}

settings.register_profile("default", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True, print_blob=True)
settings.load_profile("ci" if IN_CI else "default")


def pytest_sessionstart(session: pytest.Session) -> None:
    """The kernels are compiled once, not by every worker."""
    if getattr(session.config.option, "numprocesses", None) and not hasattr(session.config, "workerinput"):
        from compile_kernels import compile_all

        compile_all()


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
    """Reader of tests/reference/<name>.csv; ``from reference_data import reference`` serves in
    parametrisations."""
    return reference_data.reference


def artists(artist: Artist) -> Iterator[Artist]:
    """``artist`` and all within it but the ticks of axes, which are made only when they are asked
    for."""
    yield artist
    for part in [artist.label] if isinstance(artist, Axis) else artist.get_children():
        yield from artists(part)


@pytest.fixture(scope="module")
def unrendered() -> Iterator[None]:
    """Figures are composed, but their file is a few pixels that are a digest of what they hold:
    rendering takes most of the time."""

    def digest(figure: matplotlib.figure.Figure) -> bytes:
        held = hashlib.sha256()
        for artist in artists(figure):
            held.update(repr((type(artist), artist.get_label(), getattr(artist, "get_array", str)())).encode())
            held.update(repr(artist.get_text() if isinstance(artist, Text) else "").encode())
            held.update(repr(artist.get_xydata() if isinstance(artist, Line2D) else "").encode())
        return held.digest()

    def content(figure: matplotlib.figure.Figure) -> tuple[NDArray[np.uint8], Bbox]:
        return np.frombuffer(digest(figure)[:30], np.uint8).reshape(1, 10, 3), Bbox.unit()

    def save(figure: matplotlib.figure.Figure, file: str | Path | IO[bytes], **_: object) -> None:
        content = PIXEL.getvalue() + digest(figure)
        if isinstance(file, str | Path):
            Path(file).write_bytes(content)
        else:
            file.write(content)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(matplotlib.figure.Figure, "savefig", save)
        patch.setattr(picture, "content_of", content)
        yield


DRAWING = ("plots.picture", "plots.contact", "physics.stress.figures", "plots.comparison", "plots.notebook")
"""Modules of asperity that make pictures by the function ``png`` of ``plots.picture``."""


def make_pictures_by(png: Callable[..., bytes], patch: pytest.MonkeyPatch) -> None:
    for name in DRAWING:
        patch.setattr(importlib.import_module(f"asperity.{name}"), "png", png)


@pytest.fixture(scope="module")
def undrawn(unrendered: None) -> Iterator[None]:
    """Pictures are one pixel and not even composed: for tests that ask for no more than the names
    of their files."""

    def pixel(draw: object, size: object, **_: Any) -> bytes:
        return PIXEL.getvalue()

    with pytest.MonkeyPatch.context() as patch:
        make_pictures_by(pixel, patch)
        yield


@pytest.fixture
def rendered(monkeypatch: pytest.MonkeyPatch) -> None:
    """Figures are composed and rendered after all."""
    monkeypatch.setattr(matplotlib.figure.Figure, "savefig", RENDER)
    monkeypatch.setattr(picture, "content_of", CONTENT)
    make_pictures_by(PNG, monkeypatch)
