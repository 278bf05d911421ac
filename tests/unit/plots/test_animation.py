"""Animated pictures: all frames are in the file, and what is refused."""

from __future__ import annotations

from pathlib import Path

import pytest
from PIL import Image
from refusals import refused

from asperity import dynamics as dyn
from asperity.core.errors import InputError, OutputError
from asperity.physics.dynamics.figures import save_animation


@pytest.fixture(scope="module")
def run() -> dyn.BlockRun:
    law = dyn.NormalCompliance.amontons(2.8e18, 2.0, friction=0.3).damped(0.03, 500.0, 5e4)
    block = dyn.SlidingBlock(law, mass=1.0, length=0.1, width=0.02, height=0.05, load=100.0, stiffness=2e5, speed=1e-3)
    return dyn.move_block(block, 1e-3)


@pytest.mark.parametrize("suffix", [".gif", ".png", ".webp"])
def test_every_frame_is_in_the_file(run: dyn.BlockRun, tmp_path: Path, suffix: str) -> None:
    written = save_animation(run, tmp_path / f"block{suffix}", count=4)
    with Image.open(written) as picture:
        assert getattr(picture, "n_frames", 1) == 4
        assert min(picture.size) > 100


def test_what_is_refused(run: dyn.BlockRun, tmp_path: Path) -> None:
    with refused(InputError, "path of the animation", "a.mp4"):
        save_animation(run, tmp_path / "a.mp4")
    with refused(InputError, "frames of an animation", "1"):
        save_animation(run, tmp_path / "a.gif", count=1)
    (tmp_path / "a.gif").write_bytes(b"kept")
    with pytest.raises(OutputError):
        save_animation(run, tmp_path / "a.gif", count=2)
    assert (tmp_path / "a.gif").read_bytes() == b"kept"
